//! A scene with rare features of models.
//!
//! It has edge marks, wires, sheets with faces on both sides in two materials, vertex colours and unused
//! vertices.

use glam::{DAffine3, DVec3};
use ligne::mesh::EdgeMark;
use ligne::scene::{Geometry, Material, Part, Scene};

/// Two instances of the sheet side by side.
pub(crate) fn two_sheets() -> Scene {
    let materials = ["front", "back"].map(|name| Material { name: name.into(), ..Default::default() });
    let place = |k: usize| Part {
        name: format!("sheet {k}"),
        geometry: 0,
        world_from_part: DAffine3::from_translation(DVec3::new(2.0 * k as f64, 0.0, k as f64)),
    };
    let parts = (0..2).map(place).collect();
    Scene { geometries: vec![two_sided_sheet()], materials: materials.into(), parts, ..Scene::default() }
}

/// A curved sheet of 6 × 6 quads with faces on both sides.
fn two_sided_sheet() -> Geometry {
    let at = |x: u32, y: u32| y * 7 + x;
    let bend = |x: f64| (x - 3.0) * (x - 3.0) / 9.0;
    let mut sheet = Geometry::default();
    for y in 0..7 {
        for x in 0..7 {
            let (x, y) = (f64::from(x), f64::from(y));
            sheet.positions.push(DVec3::new(x - 3.0, y, bend(x) * bend(y + 1.0)));
            sheet.colours.push([0.1 * x as f32, 0.3, 0.1 * y as f32, 1.0]);
        }
    }
    for y in 0..6 {
        for x in 0..6 {
            let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
            for [a, b, c] in [[a, b, c], [a, c, d]] {
                sheet.triangles.extend([[a, b, c], [c, b, a]]);
                sheet.triangle_material.extend([u32::from(x > 2), u32::from(y > 2)]);
                let mark = if x == 2 { EdgeMark::Hard } else { EdgeMark::Unmarked };
                sheet
                    .edge_marks
                    .extend([[EdgeMark::Unmarked, mark, EdgeMark::Hidden], [EdgeMark::Unmarked; 3]]);
            }
        }
    }
    sheet.positions.extend([DVec3::new(0.0, 3.0, 5.0), DVec3::new(0.0, -0.0, 3.0)]);
    sheet.positions.extend([DVec3::new(-0.0, 0.0, 3.0), DVec3::splat(1e9)]);
    sheet.colours.resize(sheet.positions.len(), [1.0; 4]);
    sheet.wires = vec![[24, 49], [49, 50], [51, 24], [24, 27]];
    sheet
}
