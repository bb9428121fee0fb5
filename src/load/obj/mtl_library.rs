//! Reads MTL libraries: materials by name.

use crate::colour::srgb::Colour;
use crate::load::text_cursor::{Cursor, decode, utf8};
use crate::scene::Material;
use crate::scene::Warnings;
use crate::scene::Wrap;
use crate::scene::material::{Gloss, Placing};
use crate::scene::model_folder::{ModelFolder, stays_inside};

/// Gloss exponent of a material that has `Ks` but no `Ns`.
const DEFAULT_GLOSS_EXPONENT: f32 = 40.0;

/// Location of a library, and the files around it.
#[derive(Clone, Copy)]
pub(crate) struct LibraryLocation<'a> {
    /// Folder relative to the model, empty or ending with a slash.
    pub folder: &'a str,
    /// Files in the model's folder; `None` if the model is not a file.
    pub files: Option<&'a ModelFolder>,
}

/// Adds the materials of a library. Colours are interpreted as sRGB, as most programs do.
pub(crate) fn parse(
    bytes: &[u8],
    place: LibraryLocation,
    materials: &mut Vec<Material>,
    warnings: &mut Warnings,
) {
    let text = utf8(bytes);
    let mut cursor = Cursor::new(&text);
    let mut current: Option<Material> = None;
    // `d` takes precedence: `Tr` is inverted in some files.
    let mut has_dissolve = false;
    while !cursor.at_end() {
        cursor.skip_space();
        let keyword = cursor.word();
        cursor.skip_blanks();
        if keyword == b"newmtl" {
            materials.extend(current.take());
            has_dissolve = false;
            let name = decode(cursor.rest_of_line()).into_owned();
            current = Some(Material { name, ..Material::default() });
            continue;
        }
        let Some(material) = &mut current else {
            cursor.rest_of_line();
            continue;
        };
        match keyword {
            b"Kd" => {
                if let Some([r, g, b]) = channels(&mut cursor) {
                    material.colour = Colour { r, g, b, ..material.colour };
                }
            }
            b"Ks" => {
                if let Some(of) = channels(&mut cursor) {
                    let strength = f32::from(of.into_iter().max().unwrap_or_default()) / 255.0;
                    let exponent = material.gloss.map_or(DEFAULT_GLOSS_EXPONENT, |gloss| gloss.exponent);
                    material.gloss = Some(Gloss { exponent, strength });
                }
            }
            b"Ns" => {
                if let Some(exponent) = cursor.number().filter(|exponent| exponent.is_finite()) {
                    let strength = material.gloss.map_or(1.0, |gloss| gloss.strength);
                    material.gloss = Some(Gloss { exponent: exponent as f32, strength });
                }
            }
            b"Ke" => {
                if let Some([r, g, b]) = channels(&mut cursor) {
                    material.emissive = Colour::rgb(r, g, b);
                }
            }
            b"d" => {
                if cursor.peek() == b'-' && cursor.peek_on(1) == b'h' {
                    cursor.word();
                    cursor.skip_blanks();
                }
                if let Some(opacity) = cursor.number() {
                    material.colour.a = byte(opacity);
                    has_dissolve = true;
                }
            }
            b"Tr" if !has_dissolve => {
                if let Some(clear) = cursor.number() {
                    material.colour.a = byte(1.0 - clear);
                }
            }
            b"map_Kd" => {
                let statement = cursor.rest_of_line();
                if let Some(path) = texture_path(statement, place, &material.name, warnings) {
                    material.texture = Some(path);
                    let texture = texture(statement);
                    (material.placing, material.wrap) = (texture.placing, texture.wrap);
                }
            }
            b"map_d" => {
                if let Some(path) = texture_path(cursor.rest_of_line(), place, &material.name, warnings) {
                    material.opacity_map = Some(path);
                }
            }
            _ => {}
        }
        cursor.rest_of_line();
    }
    materials.extend(current);
}

/// Three channels, or one for all.
fn channels(cursor: &mut Cursor) -> Option<[u8; 3]> {
    let r = cursor.number()?;
    let mut next = || {
        cursor.skip_blanks();
        cursor.number()
    };
    let g = next().unwrap_or(r);
    let b = next().unwrap_or(g);
    Some([r, g, b].map(byte))
}

fn byte(channel: f64) -> u8 {
    (channel.clamp(0.0, 1.0) * 255.0).round() as u8
}

/// Path of a texture statement's file, relative to the model; `None`, with a warning, if it is outside the
/// model's folder.
///
/// Many libraries contain absolute paths of another machine, or names in another letter case. A file of that
/// name next to the model is used instead.
fn texture_path(
    statement: &[u8],
    place: LibraryLocation,
    material: &str,
    warnings: &mut Warnings,
) -> Option<String> {
    let name = texture(statement).name;
    if name.is_empty() {
        return None;
    }
    let path = format!("{}{}", place.folder, name.replace('\\', "/"));
    let is_inside = stays_inside(&path) && !name.starts_with(['/', '\\']);
    if let Some(files) = place.files.filter(|files| !(is_inside && files.has(&path)))
        && let Some(found) = files.find(place.folder, &name)
    {
        warnings
            .missing_file(format!("texture {name} of material `{material}` is not there; {found} is used"));
        return Some(found);
    }
    if is_inside {
        return Some(path);
    }
    warnings.missing_file(format!(
        "texture {name} of material `{material}` lies outside the model's folder, where no file has its name; it is left out"
    ));
    None
}

/// A texture statement.
struct TextureStatement {
    /// File name, which may contain blanks.
    name: String,
    placing: Placing,
    wrap: [Wrap; 2],
}

/// Parses the options of a texture statement and the file name after them.
fn texture(statement: &[u8]) -> TextureStatement {
    let text = decode(statement);
    let mut rest = text.trim();
    let mut own =
        TextureStatement { name: String::new(), placing: Placing::default(), wrap: [Wrap::Repeat; 2] };
    while let Some((option, after)) = rest.split_once(char::is_whitespace).filter(|(o, _)| o.starts_with('-'))
    {
        rest = after.trim_start();
        let (words, numbers) = match option {
            "-blendu" | "-blendv" | "-cc" | "-clamp" | "-imfchan" | "-type" | "-colorspace" => (1, 0),
            "-boost" | "-bm" | "-texres" => (0, 1),
            "-mm" => (0, 2),
            "-o" | "-s" | "-t" => (0, 3),
            // A file whose name begins with a dash.
            _ => return TextureStatement { name: format!("{option} {rest}"), ..own },
        };
        let mut values = Vec::new();
        for i in 0..words + numbers {
            let Some((word, after)) = rest.split_once(char::is_whitespace) else { break };
            // Options take up to three numbers.
            let value = word.parse::<f32>().ok().filter(|value| value.is_finite());
            if i < words || value.is_some() {
                own.wrap = if option == "-clamp" && word == "on" { [Wrap::Clamp; 2] } else { own.wrap };
                values.extend(value);
                rest = after.trim_start();
            }
        }
        let along = |k: usize, other: f32| values.get(k).copied().unwrap_or(other);
        match option {
            "-s" => own.placing.scale = [along(0, 1.0), along(1, 1.0)],
            "-o" => own.placing.offset = [along(0, 0.0), along(1, 0.0)],
            _ => {}
        }
    }
    rest.clone_into(&mut own.name);
    own
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Vec<Material>, Warnings) {
        let (mut materials, mut warnings) = (Vec::new(), Warnings::default());
        let place = LibraryLocation { folder: "maps/", files: None };
        parse(text.as_bytes(), place, &mut materials, &mut warnings);
        (materials, warnings)
    }

    #[test]
    fn mtl_materials_have_colour_opacity_and_emission() {
        let text =
            "# c\r\nnewmtl a b\r\n\tKd 1 0.5 0\r\n d 0.5\r\nTr 0.9\r\nnewmtl c\nTr 0.8\nKe 1 1 0\nKd 0.2\n";
        let (materials, _) = read(text);
        let [first, second] = &materials[..] else { panic!("two") };
        assert_eq!((first.name.as_str(), first.colour), ("a b", Colour { r: 255, g: 128, b: 0, a: 128 }));
        assert_eq!(
            (second.colour, second.emissive),
            (Colour { r: 51, g: 51, b: 51, a: 51 }, Colour::rgb(255, 255, 0))
        );
        assert_eq!(read("newmtl halo\nd -halo 0.5").0[0].colour.a, 128);
    }

    #[test]
    fn mtl_materials_have_gloss() {
        let (materials, _) =
            read("newmtl a\nNs 250\nKs 0.5 0.2 0.1\nnewmtl b\nKs 0 0 0\nnewmtl c\nKd 1 1 1\n");
        let gloss: Vec<_> = materials.iter().map(|material| material.gloss).collect();
        let first = Gloss { exponent: 250.0, strength: 128.0 / 255.0 };
        let second = Gloss { exponent: DEFAULT_GLOSS_EXPONENT, strength: 0.0 };
        assert_eq!(gloss, [Some(first), Some(second), None]);
    }

    #[test]
    fn mtl_libraries_may_begin_with_a_byte_order_mark() {
        let text = "\u{feff}newmtl é\r\nKd 1 0 0\r\n";
        let units = || text.encode_utf16();
        let (little, big) = (units().flat_map(u16::to_le_bytes), units().flat_map(u16::to_be_bytes));
        for bytes in [text.as_bytes().to_vec(), little.collect(), big.collect()] {
            let (mut materials, mut warnings) = (Vec::new(), Warnings::default());
            parse(&bytes, LibraryLocation { folder: "", files: None }, &mut materials, &mut warnings);
            assert_eq!((materials[0].name.as_str(), materials[0].colour), ("é", Colour::rgb(255, 0, 0)));
        }
    }

    #[test]
    fn mtl_textures_may_have_options_and_blanks_in_names() {
        for (statement, wanted) in [
            ("wood.png", "maps/wood.png"),
            ("-s 2 2 1 -o 0.25 0 0 checker board.png", "maps/checker board.png"),
            ("-s 2 a.png", "maps/a.png"),
            ("-clamp on -bm 0.3 -mm 0 1 -blendu off deep\\a.png", "maps/deep/a.png"),
            ("-strange.png", "maps/-strange.png"),
            ("-strange name.png", "maps/-strange name.png"),
        ] {
            let (materials, warnings) = read(&format!("newmtl m\nmap_Kd {statement}\n"));
            assert_eq!(materials[0].texture.as_deref(), Some(wanted));
            assert!(warnings.is_empty());
        }
    }

    #[test]
    fn mtl_texture_options_set_placing_and_wrap() {
        let of = |options: &str| {
            let (materials, _) = read(&format!("newmtl m\nmap_Kd {options} a.png\n"));
            (materials[0].placing, materials[0].wrap)
        };
        assert_eq!(of(""), (Placing::default(), [Wrap::Repeat; 2]));
        let placing = Placing { scale: [2.0, 3.0], offset: [0.25, 0.0] };
        assert_eq!(of("-s 2 3 1 -o 0.25 -clamp on"), (placing, [Wrap::Clamp; 2]));
        assert_eq!(
            of("-clamp off -s 4"),
            (Placing { scale: [4.0, 1.0], offset: [0.0; 2] }, [Wrap::Repeat; 2])
        );
    }

    #[test]
    fn mtl_textures_outside_the_folder_are_left_out() {
        for name in ["../../secret.png", "/etc/passwd", "C:\\secret.png", "a/../../../b.png"] {
            let (materials, warnings) = read(&format!("newmtl m\nmap_Kd {name}\n"));
            assert_eq!(materials[0].texture, None);
            assert!(warnings.lines()[0].contains("outside"), "{name}");
        }
    }

    #[test]
    fn mtl_statements_before_a_material_are_ignored() {
        assert!(read("Kd 1 1 1\nmap_Kd a.png").0.is_empty());
    }
}
