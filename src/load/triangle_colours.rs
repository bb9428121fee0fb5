//! Colours of single triangles, as in PLY and STL: they become materials, or vertex colours if there are
//! many.

use rustc_hash::FxHashMap;

use crate::colour::oklab::linear_table;
use crate::colour::srgb::Colour;
use crate::scene::{Geometry, Material};

/// Maximum number of colours that become materials: the maximum of a palette in a picture (PNG specification,
/// third edition, 11.2.2). With more, as in scans, material boundaries would cover the drawing with lines.
const MAX_MATERIALS: usize = 256;

/// Colours the triangles of a geometry. Triangles with `None`, or without an entry in `colours`, have no
/// colour.
///
/// Each colour becomes a material, sorted by colour so that the order of the faces does not matter. Triangles
/// without a colour get a default material after those. More than [`MAX_MATERIALS`] colours become vertex
/// colours, with vertices split between colours: these affect fills but not lines.
pub(crate) fn paint(geometry: &mut Geometry, colours: &[Option<Colour>], materials: &mut Vec<Material>) {
    let mut distinct: Vec<Colour> = colours.iter().copied().flatten().collect();
    // Neighbours mostly have the same colour.
    distinct.dedup();
    distinct.sort_unstable();
    distinct.dedup();
    if distinct.len() > MAX_MATERIALS {
        split_vertices(geometry, colours);
        return;
    }
    // If all alpha is 0, it was not set: an invisible model makes no sense.
    let is_clear = distinct.iter().all(|colour| colour.a == 0);
    let first = materials.len();
    materials.extend(distinct.iter().map(|&colour| {
        let name = if colour.a == 255 || is_clear {
            colour.hex()
        } else {
            format!("{}{:02x}", colour.hex(), colour.a)
        };
        let colour = if is_clear { Colour { a: 255, ..colour } } else { colour };
        Material { name, colour, ..Material::default() }
    }));
    let none = materials.len() as u32;
    let of = |triangle: usize| match colours.get(triangle).copied().flatten() {
        Some(colour) => (first + distinct.partition_point(|own| *own < colour)) as u32,
        None => none,
    };
    let of_triangles: Vec<u32> = (0..geometry.triangles.len()).map(of).collect();
    if of_triangles.contains(&none) {
        materials.push(Material::default());
    }
    match of_triangles.first() {
        Some(only) if of_triangles.iter().all(|material| material == only) && geometry.wires.is_empty() => {
            geometry.material = Some(*only);
        }
        _ => geometry.triangle_material = of_triangles,
    }
}

/// Colours each vertex like its triangles, and splits vertices whose triangles have several colours.
fn split_vertices(geometry: &mut Geometry, colours: &[Option<Colour>]) {
    let light = linear_table();
    let light = |channel: u8| light[usize::from(channel)];
    let plain = Material::default().colour;
    let mut of_vertices: Vec<Option<Colour>> = vec![None; geometry.positions.len()];
    let mut split: FxHashMap<(u32, Colour), u32> = FxHashMap::default();
    for (triangle, corners) in geometry.triangles.iter_mut().enumerate() {
        let colour = colours.get(triangle).copied().flatten().unwrap_or(plain);
        for corner in corners {
            let Some(own) = of_vertices.get_mut(*corner as usize) else { continue };
            match own {
                None => *own = Some(colour),
                Some(own) if *own == colour => {}
                Some(_) => {
                    let old = *corner;
                    *corner = *split.entry((old, colour)).or_insert_with(|| {
                        let position = geometry.positions.get(old as usize).copied().unwrap_or_default();
                        geometry.positions.push(position);
                        of_vertices.push(Some(colour));
                        (geometry.positions.len() - 1) as u32
                    });
                }
            }
        }
    }
    geometry.colours = of_vertices
        .into_iter()
        .map(|colour| {
            let Colour { r, g, b, .. } = colour.unwrap_or(plain);
            [light(r), light(g), light(b), 1.0]
        })
        .collect();
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::colour::srgb::linear;

    /// Triangles around one common vertex.
    fn fan(count: u32) -> Geometry {
        let rim = (0..=count).map(|k| DVec3::new(f64::from(k), 1.0, 0.0));
        Geometry {
            positions: [DVec3::ZERO].into_iter().chain(rim).collect(),
            triangles: (0..count).map(|k| [0, k + 1, k + 2]).collect(),
            ..Geometry::default()
        }
    }

    #[test]
    fn each_triangle_colour_becomes_a_material_in_a_fixed_order() {
        let (red, blue) = (Colour::rgb(255, 0, 0), Colour::rgb(0, 0, 255));
        let (mut geometry, mut materials) = (fan(4), Vec::new());
        paint(&mut geometry, &[Some(red), Some(blue), None, Some(red)], &mut materials);
        let names: Vec<_> = materials.iter().map(|own| own.name.as_str()).collect();
        assert_eq!(names, ["#0000ff", "#ff0000", ""]);
        assert_eq!(geometry.triangle_material, [1, 0, 2, 1]);
        assert_eq!(materials[2], Material::default());
        let (mut geometry, mut materials) = (fan(2), Vec::new());
        paint(&mut geometry, &[Some(red), Some(red)], &mut materials);
        assert_eq!((geometry.material, geometry.triangle_material.len(), materials.len()), (Some(0), 0, 1));
    }

    #[test]
    fn triangle_alpha_is_ignored_if_it_is_zero_everywhere() {
        let clear = |a| Some(Colour { a, ..Colour::rgb(255, 0, 0) });
        let mut materials = Vec::new();
        paint(&mut fan(1), &[clear(0)], &mut materials);
        assert_eq!((materials[0].name.as_str(), materials[0].colour.a), ("#ff0000", 255));
        materials.clear();
        paint(&mut fan(1), &[clear(128)], &mut materials);
        assert_eq!((materials[0].name.as_str(), materials[0].colour.a), ("#ff000080", 128));
    }

    #[test]
    fn many_triangle_colours_become_vertex_colours() {
        let (mut geometry, mut materials) = (fan(300), Vec::new());
        let colours: Vec<_> =
            (0..300_u32).map(|k| Some(Colour::rgb((k % 256) as u8, (k / 256) as u8, 0))).collect();
        let before = geometry.clone();
        paint(&mut geometry, &colours, &mut materials);
        assert!(materials.is_empty() && geometry.triangle_material.is_empty());
        assert_eq!(geometry.colours.len(), geometry.positions.len());
        for (k, (old, new)) in before.triangles.iter().zip(&geometry.triangles).enumerate() {
            let place =
                |geometry: &Geometry, corners: &[u32; 3]| corners.map(|c| geometry.positions[c as usize]);
            assert_eq!(place(&before, old), place(&geometry, new));
            let red = linear((k % 256) as f32 / 255.0);
            assert!(new.iter().all(|corner| geometry.colours[*corner as usize][0] == red), "{k}");
        }
    }
}
