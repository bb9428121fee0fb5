//! Hatch regions made of polygons, and the share of an area that ink covers.

use std::collections::BTreeMap;

use kurbo::{BezPath, PathEl, Point};
use ligne::mesh::{MaterialId, PaintId, PartId};
use ligne::regions::hatch_regions::border_piece::BorderPiece;
use ligne::regions::hatch_regions::hatch_map::HatchCell;
use ligne::regions::{HatchRegions, SurfaceLabel};

/// Hatch regions whose cells are polygons, given as facet number and corners.
///
/// Polygons turn from x to y; adjacent ones share their corners. Cell 0 is the paper.
pub(crate) fn polygon_regions(polygons: &[(u32, Vec<Point>)]) -> HatchRegions {
    let look = |bin: usize| SurfaceLabel {
        part: PartId(0),
        material: MaterialId(0),
        paint: PaintId(0),
        tone: 0,
        bin: bin as u16,
        cast: false,
    };
    let mut cells = vec![HatchCell { look: look(0), facet: 0, area: 0.0 }];
    let bits = |p: Point| (p.x.to_bits(), p.y.to_bits());
    let mut sides: BTreeMap<_, ([Point; 2], [u32; 2])> = BTreeMap::new();
    for (facet, corners) in polygons {
        let cell = cells.len() as u32;
        let pairs = || corners.iter().zip(corners.iter().cycle().skip(1));
        let area = pairs().map(|(a, b)| a.to_vec2().cross(b.to_vec2())).sum::<f64>() / 2.0;
        cells.push(HatchCell { look: look(cells.len()), facet: *facet, area });
        for (a, b) in pairs() {
            if let Some(known) = sides.get_mut(&(bits(*b), bits(*a))) {
                known.1[1] = cell;
            } else {
                sides.insert((bits(*a), bits(*b)), ([*a, *b], [cell, 0]));
            }
        }
    }
    let facet = |cell: u32| cells[cell as usize].facet;
    let piece = |(ends, sides): ([Point; 2], [u32; 2])| BorderPiece {
        ends,
        sides,
        parts_surfaces: facet(sides[0]) != facet(sides[1]),
    };
    let pieces = sides.into_values().map(piece).collect();
    HatchRegions::of_pieces(cells, pieces)
}

/// The corners of a square.
pub(crate) fn square(x: f64, y: f64, side: f64) -> Vec<Point> {
    [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(a, b)| Point::new(x + a, y + b)).to_vec()
}

/// Ink coverage of the pixels of a page square, 0 to 1, row by row, at eight pixels per unit.
pub(crate) fn pixel_coverage(paths: &[&BezPath], x: f64, y: f64, side: f64) -> Vec<f64> {
    const PIXELS_PER_UNIT: f64 = 8.0;
    let size = (side * PIXELS_PER_UNIT) as u32;
    let mut pixels = tiny_skia::Pixmap::new(size, size).expect("a picture");
    let mut paint = tiny_skia::Paint::default();
    paint.set_color_rgba8(0, 0, 0, 255);
    for path in paths {
        let at = |p: Point| (((p.x - x) * PIXELS_PER_UNIT) as f32, ((p.y - y) * PIXELS_PER_UNIT) as f32);
        let mut out = tiny_skia::PathBuilder::new();
        for element in path.elements() {
            match *element {
                PathEl::MoveTo(a) => out.move_to(at(a).0, at(a).1),
                PathEl::LineTo(a) => out.line_to(at(a).0, at(a).1),
                PathEl::QuadTo(a, b) => out.quad_to(at(a).0, at(a).1, at(b).0, at(b).1),
                PathEl::CurveTo(a, b, c) => {
                    out.cubic_to(at(a).0, at(a).1, at(b).0, at(b).1, at(c).0, at(c).1);
                }
                PathEl::ClosePath => out.close(),
            }
        }
        if let Some(out) = out.finish() {
            let rule = tiny_skia::FillRule::Winding;
            pixels.fill_path(&out, &paint, rule, tiny_skia::Transform::identity(), None);
        }
    }
    pixels.data().chunks_exact(4).map(|pixel| f64::from(pixel[3]) / 255.0).collect()
}

/// The share of a page square that paths cover.
pub(crate) fn mean_coverage(paths: &[&BezPath], x: f64, y: f64, side: f64) -> f64 {
    let pixels = pixel_coverage(paths, x, y, side);
    pixels.iter().sum::<f64>() / pixels.len() as f64
}
