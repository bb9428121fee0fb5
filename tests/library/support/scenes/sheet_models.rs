//! Model files for technical sheets, and queries of a composed sheet.

use std::fs;
use std::path::PathBuf;

use ligne::drawing::{Mark, PlacedDrawing};
use ligne::kurbo::{Affine, Rect, Shape};
use ligne::page::ComposedPage;

use super::solids::{Solid, cuboid};

/// A temporary folder for one test.
pub(crate) fn temp_folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("ligne-sheets-{}-{name}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// The text of an OBJ file with one object per named solid.
pub(crate) fn obj_text(parts: &[(String, Solid)]) -> String {
    let mut text = String::new();
    let mut first = 1;
    for (name, solid) in parts {
        text += &format!("o {name}\n");
        for p in &solid.positions {
            text += &format!("v {} {} {}\n", p.x, p.y, p.z);
        }
        for [a, b, c] in &solid.triangles {
            text += &format!("f {} {} {}\n", a + first, b + first, c + first);
        }
        first += solid.positions.len() as u32;
    }
    text
}

/// The axis-aligned box between two corners.
pub(crate) fn block(low: [f64; 3], high: [f64; 3]) -> Solid {
    cuboid(low.into(), high.into())
}

/// The item of a composed page with this name.
pub(crate) fn page_item<'a>(composed: &'a ComposedPage, name: &str) -> &'a PlacedDrawing {
    let found = composed.composition.items.iter().find(|item| item.name == name);
    found.unwrap_or_else(|| panic!("no {name}"))
}

/// The marks of an item, each with the item's placement on the page.
pub(crate) fn placed_marks(item: &PlacedDrawing) -> impl Iterator<Item = (Affine, &Mark)> {
    item.drawing.layers.iter().flat_map(|layer| &layer.marks).map(|mark| (item.place, mark))
}

/// The bounding box of the marks' paths.
pub(crate) fn drawn_bounds(item: &PlacedDrawing) -> Rect {
    let boxes = placed_marks(item).map(|(place, mark)| (place * mark.path.clone()).bounding_box());
    boxes.reduce(|a, b| a.union(b)).expect("something drawn")
}

/// All text labels of an item.
pub(crate) fn item_texts(item: &PlacedDrawing) -> Vec<String> {
    placed_marks(item)
        .filter_map(|(_, mark)| Some(mark.provenance.text.as_ref()?.words.to_string()))
        .collect()
}

/// A plate from the origin, divided into columns along x, each with a through hole.
///
/// `size` is width, depth and height; each hole is given by its centre and radius.
pub(crate) fn drilled_plate(size: [f64; 3], holes: &[([f64; 2], f64)]) -> Solid {
    use libm::{cos, sin};
    let mut plate = Solid::default();
    let [width, depth, height] = size;
    let column = width / holes.len().max(1) as f64;
    let corner = |x: f64, y: f64, z: f64| glam::DVec3::new(x, y, z);
    for (n, ([x, y], radius)) in holes.iter().enumerate() {
        let [x0, x1] = [column * n as f64, column * (n + 1) as f64];
        let first = plate.positions.len() as u32;
        let count = 48u32;
        for k in 0..count {
            let turn = std::f64::consts::TAU * (f64::from(k) + 0.5) / f64::from(count);
            let (c, s) = (cos(turn), sin(turn));
            let far = |d: f64, low: f64, high: f64, at: f64| match d {
                d if d > 1e-12 => (high - at) / d,
                d if d < -1e-12 => (low - at) / d,
                _ => f64::INFINITY,
            };
            let out = far(c, x0, x1, *x).min(far(s, 0.0, depth, *y));
            for z in [0.0, height] {
                plate.positions.push(corner(x + radius * c, y + radius * s, z));
                plate.positions.push(corner(x + out * c, y + out * s, z));
            }
        }
        for k in 0..count {
            let [a, b] = [first + 4 * k, first + 4 * ((k + 1) % count)];
            let mut quad = |a: u32, b: u32, c: u32, d: u32| plate.triangles.extend([[a, b, c], [a, c, d]]);
            quad(b, a, a + 2, b + 2);
            quad(a + 2, a + 3, b + 3, b + 2);
            quad(b, b + 1, a + 1, a);
        }
        // The fan leaves out the triangles at the corners of the column.
        for (cx, cy) in [(x0, 0.0), (x1, 0.0), (x1, depth), (x0, depth)] {
            for (z, up) in [(0.0, false), (height, true)] {
                let on = |p: &&glam::DVec3| {
                    p.z == z && (p.x == cx || (p.x - cx).abs() < 1e-9 || (p.y - cy).abs() < 1e-9)
                };
                let near = |p: &glam::DVec3| (p.x - cx).powi(2) + (p.y - cy).powi(2);
                let own = &plate.positions[first as usize..];
                let side = |along_x: bool| {
                    own.iter()
                        .filter(on)
                        .filter(|p| if along_x { (p.y - cy).abs() < 1e-9 } else { (p.x - cx).abs() < 1e-9 })
                        .copied()
                        .min_by(|a, b| near(a).total_cmp(&near(b)))
                };
                let (Some(a), Some(b)) = (side(true), side(false)) else { continue };
                let start = plate.positions.len() as u32;
                plate.positions.extend([corner(cx, cy, z), a, b]);
                let turns = (a - corner(cx, cy, z)).cross(b - corner(cx, cy, z)).z > 0.0;
                plate.triangles.push(if turns == up {
                    [start, start + 1, start + 2]
                } else {
                    [start, start + 2, start + 1]
                });
            }
        }
    }
    for [[a, b], [c, d]] in [
        [[0.0, 0.0], [width, 0.0]],
        [[width, 0.0], [width, depth]],
        [[width, depth], [0.0, depth]],
        [[0.0, depth], [0.0, 0.0]],
    ] {
        let first = plate.positions.len() as u32;
        plate.positions.extend([
            corner(a, b, 0.0),
            corner(c, d, 0.0),
            corner(c, d, height),
            corner(a, b, height),
        ]);
        plate.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    plate
}
