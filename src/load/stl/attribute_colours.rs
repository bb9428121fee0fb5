//! Colours of binary STL: two conventions that put 15 bits of colour into the "attribute byte count" of a
//! triangle.
//!
//! | convention | recognised by | bit 15 | bits 10-14 | bits 5-9 | bits 0-4 |
//! | --- | --- | --- | --- | --- | --- |
//! | VisCAM, SolidView | no `COLOR=` | 1: the triangle has this colour; 0: none | red | green | blue |
//! | Materialise Magics | `COLOR=` in the header | 0: the triangle has this colour; 1: the part's | blue | green | red |
//!
//! In Magics, `COLOR=` is followed by red, green, blue and alpha of the part, one byte each. A following
//! `MATERIAL=` has three such colours: diffuse, specular and ambient. The diffuse one is then the part's
//! colour.
//!
//! `MeshLab` writes the header of Magics, but sets bit 15 on triangles that have their own colour. Its header
//! has grey colours and a blank in place of the comma; bit 15 then has the meaning of `VisCAM`.
//!
//! Source: "Colour STL file format", rapid prototyping mailing list, rp-ml 2001/0608 (M. Joppe, VisCAM) and
//! 2003/1450, for both conventions; Wikipedia, "STL (file format)", section "Colour in binary STL", for
//! `MATERIAL=`; VCGlib, `export_stl.h`, for `MeshLab`.

use crate::colour::srgb::Colour;
use crate::load::triangle_colours;
use crate::scene::{Geometry, Scene};

/// Start of the header that `MeshLab` writes.
const MESHLAB_HEADER: &[u8] = b"COLOR=\x7f\x7f\x7f MATERIAL=\x7f\x7f\x7f \x7f\x7f\x7f \x7f\x7f\x7f";

const BIT_15: u16 = 1 << 15;

/// Whether a header contains the colour of the part.
pub(crate) fn has_part_colour(header: &[u8]) -> bool {
    part_colour(header).is_some()
}

/// Colours the triangles of a binary file; `attributes` has one entry per triangle.
pub(crate) fn paint(header: &[u8], attributes: &[u16], geometry: &mut Geometry, scene: &mut Scene) {
    let is_marked = |attribute: &u16| attribute & BIT_15 != 0;
    let own = |attribute: u16, [red, green, blue]: [u32; 3]| {
        // Scale five bits to eight, so that 31 becomes 255.
        let channel = |shift: u32| ((u32::from(attribute >> shift & 31) * 255 + 15) / 31) as u8;
        Colour::rgb(channel(red), channel(green), channel(blue))
    };
    let viscam = |attribute: &u16| is_marked(attribute).then(|| own(*attribute, [10, 5, 0]));
    let magics = |attribute: u16| own(attribute, [0, 5, 10]);
    let colours: Vec<Option<Colour>> = match part_colour(header) {
        Some(part) if header.starts_with(MESHLAB_HEADER) => {
            attributes.iter().map(|a| Some(if is_marked(a) { magics(*a) } else { part })).collect()
        }
        // Some programs leave all attributes 0, which would make every triangle black.
        Some(part) if attributes.iter().all(|a| *a == 0) => vec![Some(part); attributes.len()],
        Some(part) => attributes.iter().map(|a| Some(if is_marked(a) { part } else { magics(*a) })).collect(),
        None => {
            if !attributes.iter().any(is_marked) {
                return;
            }
            // Neither a colour nor 0: the attributes have another meaning.
            let strange = attributes.iter().filter(|a| !is_marked(a) && **a != 0).count();
            if strange > 0 {
                scene.warnings.note(format!(
                    "colours left out: the attributes of {strange} of {} triangles are neither 0 nor a colour of VisCAM",
                    attributes.len()
                ));
                return;
            }
            attributes.iter().map(viscam).collect()
        }
    };
    triangle_colours::paint(geometry, &colours, &mut scene.materials);
}

/// Colour of the part in a Magics header.
fn part_colour(header: &[u8]) -> Option<Colour> {
    let after = |name: &[u8]| {
        let start = memchr::memmem::find(header, name)? + name.len();
        header.get(start..)
    };
    let [r, g, b, a] = *after(b"COLOR=")?.first_chunk::<4>()?;
    // Programs without transparency write 0, and MeshLab a blank.
    let a = if a == 0 || header.starts_with(MESHLAB_HEADER) { 255 } else { a };
    let diffuse = after(b"MATERIAL=").and_then(|rest| rest.first_chunk::<12>());
    // Twelve blanks or zeros are padding of the header, not a material.
    match diffuse.filter(|colours| **colours != [b' '; 12] && **colours != [0; 12]) {
        Some(&[r, g, b, ..]) => Some(Colour { r, g, b, a }),
        None => Some(Colour { r, g, b, a }),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn header(start: &[u8]) -> Vec<u8> {
        let mut header = start.to_vec();
        header.resize(80, b' ');
        header
    }

    /// Colour of each triangle in a file with these attributes, and the number of warnings.
    fn colours(header: &[u8], attributes: &[u16]) -> (Vec<String>, usize) {
        let mut geometry = Geometry {
            positions: vec![DVec3::ZERO; 3],
            triangles: vec![[0, 1, 2]; attributes.len()],
            ..Geometry::default()
        };
        let mut scene = Scene::default();
        paint(header, attributes, &mut geometry, &mut scene);
        let name = |triangle| {
            let material = geometry.material_of(triangle).map(|id| scene.materials[id as usize].name.clone());
            material.unwrap_or_else(|| "none".to_owned())
        };
        ((0..attributes.len()).map(name).collect(), scene.warnings.lines().len())
    }

    #[test]
    fn viscam_colours_have_red_in_the_high_bits() {
        let plain = header(b"made by hand");
        assert_eq!(colours(&plain, &[0xfc00, 0x83e0, 0x801f, 0]).0, ["#ff0000", "#00ff00", "#0000ff", ""]);
        assert_eq!(colours(&plain, &[0x8000 | 16 << 10]).0, ["#840000"]);
    }

    #[test]
    fn attributes_that_are_not_colours_are_ignored() {
        let plain = header(b"");
        assert_eq!(colours(&plain, &[0, 0, 0]), (vec!["none".to_owned(); 3], 0));
        assert_eq!(colours(&plain, &[1, 2, 0x7fff]), (vec!["none".to_owned(); 3], 0));
        assert_eq!(colours(&plain, &[0xfc00, 2, 0]), (vec!["none".to_owned(); 3], 1));
    }

    #[test]
    fn magics_colours_use_low_bits_for_red_and_bit_15_for_the_part_colour() {
        let magics = header(b"COLOR=\xff\x20\x20\xff,MATERIAL=");
        assert_eq!(colours(&magics, &[0xffff, 0x001f, 0x7c00]).0, ["#ff2020", "#ff0000", "#0000ff"]);
        // If all attributes are zero, they are not colours.
        assert_eq!(colours(&magics, &[0, 0]).0, ["#ff2020"; 2]);
        assert_eq!(colours(&magics, &[0, 0x8000]).0, ["#000000", "#ff2020"]);
        let anywhere = header(b"some part COLOR=\x01\x02\x03\x80");
        assert_eq!(colours(&anywhere, &[0]).0, ["#01020380"]);
        let material = header(b"COLOR=\xff\x20\x20\xff,MATERIAL=\x10\x20\x30\xff\xff\xff\xff\xff\0\0\0\xff");
        assert_eq!(colours(&material, &[0x8000]).0, ["#102030"]);
        // Cut off at the end of the header.
        assert_eq!(colours(&[&[b' '; 72][..], b"COLOR=\x01\x02"].concat(), &[0]).0, ["none"]);
    }

    #[test]
    fn meshlab_sets_bit_15_on_triangles_with_a_colour() {
        let meshlab = header(MESHLAB_HEADER);
        assert_eq!(colours(&meshlab, &[0x801f, 0xfc00, 0]).0, ["#ff0000", "#0000ff", "#7f7f7f"]);
    }
}
