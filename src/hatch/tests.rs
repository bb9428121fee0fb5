//! Grounds made of polygons, and what paths cover, for the tests of this room.

use std::collections::BTreeMap;

use kurbo::{BezPath, Point, Shape};

use crate::mesh::{MaterialId, PaintId, PartId};
use crate::region::Look;
use crate::region::ground::{Cell, Ground, Piece};

/// A ground whose cells are polygons in facets, turning from x to y; cell 0 is paper. Polygons that touch
/// share their corners.
pub(super) fn ground(polygons: &[(u32, Vec<Point>)]) -> Ground {
    let look = |bin: usize| Look {
        part: PartId(0),
        material: MaterialId(0),
        paint: PaintId(0),
        tone: 0,
        bin: bin as u16,
        cast: false,
    };
    let mut cells = vec![Cell { look: look(0), facet: 0, area: 0.0 }];
    let bits = |p: Point| (p.x.to_bits(), p.y.to_bits());
    let mut sides: BTreeMap<_, ([Point; 2], [u32; 2])> = BTreeMap::new();
    for (facet, corners) in polygons {
        let cell = cells.len() as u32;
        let pairs = || corners.iter().zip(corners.iter().cycle().skip(1));
        let area = pairs().map(|(a, b)| a.to_vec2().cross(b.to_vec2())).sum::<f64>() / 2.0;
        cells.push(Cell { look: look(cells.len()), facet: *facet, area });
        for (a, b) in pairs() {
            if let Some(known) = sides.get_mut(&(bits(*b), bits(*a))) {
                known.1[1] = cell;
            } else {
                sides.insert((bits(*a), bits(*b)), ([*a, *b], [cell, 0]));
            }
        }
    }
    let facet = |cell: u32| cells[cell as usize].facet;
    let pieces = sides
        .into_values()
        .map(|(ends, sides)| Piece { ends, sides, parts_surfaces: facet(sides[0]) != facet(sides[1]) })
        .collect();
    Ground::of_pieces(cells, pieces)
}

/// The corners of a square.
pub(super) fn square(x: f64, y: f64, side: f64) -> Vec<Point> {
    [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(a, b)| Point::new(x + a, y + b)).to_vec()
}

/// A polygon of many corners around a point.
pub(super) fn round(centre: Point, radius: f64, corners: usize) -> Vec<Point> {
    use crate::math::function::{cos, sin};
    let at = |k: usize| std::f64::consts::TAU * k as f64 / corners as f64;
    (0..corners).map(|k| centre + kurbo::Vec2::new(cos(at(k)), sin(at(k))) * radius).collect()
}

/// The part of a square of the page that a path covers by the nonzero rule, at eight lines of samples
/// a unit.
pub(super) fn covered(path: &BezPath, x: f64, y: f64, side: f64) -> f64 {
    const LINES: f64 = 8.0;
    let size = (side * LINES) as u32;
    let Some(mut pixels) = tiny_skia::Pixmap::new(size, size) else { return f64::NAN };
    let mut out = tiny_skia::PathBuilder::new();
    for element in path.elements() {
        let p = |p: kurbo::Point| (((p.x - x) * LINES) as f32, ((p.y - y) * LINES) as f32);
        match *element {
            kurbo::PathEl::MoveTo(a) => out.move_to(p(a).0, p(a).1),
            kurbo::PathEl::LineTo(a) => out.line_to(p(a).0, p(a).1),
            kurbo::PathEl::QuadTo(a, b) => out.quad_to(p(a).0, p(a).1, p(b).0, p(b).1),
            kurbo::PathEl::CurveTo(a, b, c) => {
                out.cubic_to(p(a).0, p(a).1, p(b).0, p(b).1, p(c).0, p(c).1);
            }
            kurbo::PathEl::ClosePath => out.close(),
        }
    }
    let Some(out) = out.finish() else { return 0.0 };
    let mut paint = tiny_skia::Paint::default();
    paint.set_color_rgba8(0, 0, 0, 255);
    let _ = path.bounding_box();
    let rule = tiny_skia::FillRule::Winding;
    pixels.fill_path(&out, &paint, rule, tiny_skia::Transform::identity(), None);
    let sum: f64 = pixels.data().chunks_exact(4).map(|p| f64::from(p[3])).sum();
    sum / 255.0 / f64::from(size * size)
}
