//! Halftone screens: fills as vector dots on one lattice per ink.
//!
//! The dots of an ink are centred on the corners of a square lattice, which is rotated by the ink's angle.
//! Their area gives the tone. The lattice is fixed to the page, so that neighbouring fills of one tone share
//! it. The lattices of cyan, magenta and black are 30° apart, where their moiré is finest; yellow is in
//! between.

use std::collections::BTreeMap;

use kurbo::{Affine, BezPath, PathEl, Point};

use crate::geometry::numbers::portable_math::{acos, cos, sin};

/// Angles of the plates relative to black in degrees: cyan, magenta, yellow, black.
const PLATE_ANGLES_DEG: [f64; 4] = [-30.0, 30.0, -45.0, 0.0];

/// Least amount of ink that counts as solid. Up to one minus this amount, no ink is printed.
const MIN_SOLID_INK: f64 = 0.99;

/// Number of dot sizes.
const DOT_SIZE_STEPS: f64 = 255.0;

/// Flatness of outlines in lattice units.
const FLATNESS_PITCHES: f64 = 0.02;

/// Most dots per fill. More would be finer than any press prints.
const MAX_DOTS_PER_FILL: f64 = 4e6;

/// A halftone screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Screen {
    /// Rows of dots per inch.
    pub lpi: f64,
    /// Angle of the black plate in degrees, anticlockwise.
    pub angle_deg: f64,
}

/// How an amount of ink is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum InkTone {
    None,
    Solid,
    /// As dots of one of [`DOT_SIZE_STEPS`] sizes.
    Dots,
}

/// Classifies an amount of ink, 0 to 1.
pub(crate) fn tone(ink: f64) -> InkTone {
    if ink >= MIN_SOLID_INK {
        InkTone::Solid
    } else if ink <= 1.0 - MIN_SOLID_INK {
        InkTone::None
    } else {
        InkTone::Dots
    }
}

impl Screen {
    /// Transform from the lattice of a plate, with unit spacing, to page units; `mm` is page units per mm.
    pub(crate) fn lattice(&self, plate: usize, mm: f64) -> Affine {
        let turn = PLATE_ANGLES_DEG.get(plate).copied().unwrap_or(0.0);
        let angle = (-(self.angle_deg + turn)).to_radians();
        let pitch = 25.4 / self.lpi * mm;
        let (s, c) = (sin(angle) * pitch, cos(angle) * pitch);
        Affine::new([c, s, -s, c, 0.0, 0.0])
    }
}

/// Diameter of dots that cover a share of a lattice with unit spacing. Dots touch at a share of π/4 and
/// overlap above it.
pub(crate) fn diameter(share: f64) -> f64 {
    let covered = |r: f64| {
        let disc = std::f64::consts::PI * r * r;
        if r <= 0.5 { disc } else { disc - 4.0 * (r * r * acos(0.5 / r) - 0.5 * (r * r - 0.25).sqrt()) }
    };
    let (mut low, mut high) = (0.0, std::f64::consts::FRAC_1_SQRT_2);
    for _ in 0..40 {
        let middle = (low + high) / 2.0;
        if covered(middle) < share { low = middle } else { high = middle }
    }
    low + high
}

/// Dots that are visible inside an outline, by size in steps of 1/255. `outline` is in lattice units, and
/// `share` gives the coverage at a point. `None` if there are too many.
pub(crate) fn dots(outline: &BezPath, share: impl Fn(Point) -> f64) -> Option<BTreeMap<u8, Vec<(i32, i32)>>> {
    let reach = std::f64::consts::FRAC_1_SQRT_2;
    let mut dots: BTreeMap<u8, Vec<(i32, i32)>> = BTreeMap::new();
    for (row, spans) in rows(outline, reach)? {
        let mut last = i64::MIN;
        for (from, to) in spans {
            let (from, to) = ((from.ceil() as i64).max(last.saturating_add(1)), to.floor() as i64);
            for column in from..=to {
                let size = (share(Point::new(column as f64, row as f64)).clamp(0.0, 1.0) * DOT_SIZE_STEPS)
                    .round() as u8;
                if size > 0 {
                    dots.entry(size).or_default().push((column as i32, row as i32));
                }
            }
            last = last.max(to);
        }
    }
    Some(dots)
}

/// Share covered by dots of a size.
pub(crate) fn share_of(size: u8) -> f64 {
    f64::from(size) / DOT_SIZE_STEPS
}

/// For each lattice row, the stretches where dots of radius `reach` are visible inside an outline, sorted by
/// start.
fn rows(outline: &BezPath, reach: f64) -> Option<BTreeMap<i64, Vec<(f64, f64)>>> {
    let mut spans: BTreeMap<i64, Vec<(f64, f64)>> = BTreeMap::new();
    let mut crossings: BTreeMap<i64, Vec<(f64, i32)>> = BTreeMap::new();
    let mut edges: Vec<(Point, Point)> = Vec::new();
    let (mut start, mut pen) = (Point::ZERO, Point::ZERO);
    kurbo::flatten(outline.elements().iter().copied(), FLATNESS_PITCHES, |element| match element {
        PathEl::MoveTo(p) => {
            edges.push((pen, start));
            (start, pen) = (p, p);
        }
        PathEl::LineTo(p) => {
            edges.push((pen, p));
            pen = p;
        }
        PathEl::ClosePath => {
            edges.push((pen, start));
            pen = start;
        }
        PathEl::QuadTo(..) | PathEl::CurveTo(..) => {}
    });
    edges.push((pen, start));
    let numbers = edges.iter().flat_map(|(a, b)| [a.x, a.y, b.x, b.y]);
    if numbers.clone().any(|x| !x.is_finite() || x.abs() > 1e6) {
        return None;
    }
    for (a, b) in edges {
        if a == b {
            continue;
        }
        let (low, high) = (a.y.min(b.y), a.y.max(b.y));
        let at = |y: f64| a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0);
        for row in (low - reach).ceil() as i64..=(high + reach).floor() as i64 {
            let y = row as f64;
            let (x0, x1) = if low == high { (a.x, b.x) } else { (at(y - reach), at(y + reach)) };
            spans.entry(row).or_default().push((x0.min(x1) - reach, x0.max(x1) + reach));
            if low <= y && y < high {
                crossings.entry(row).or_default().push((at(y), if a.y < b.y { 1 } else { -1 }));
            }
        }
    }
    for (row, mut found) in crossings {
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut turns = 0;
        let inner = spans.entry(row).or_default();
        for pair in found.windows(2) {
            let [(from, turn), (to, _)] = pair else { continue };
            turns += turn;
            if turns != 0 {
                inner.push((*from, *to));
            }
        }
    }
    let length: f64 = spans.values().flatten().map(|(from, to)| to - from).sum();
    if length > MAX_DOTS_PER_FILL {
        return None;
    }
    for inner in spans.values_mut() {
        inner.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    Some(spans)
}

#[cfg(test)]
mod tests {
    use kurbo::{Circle, Rect, Shape};

    use super::*;

    #[test]
    fn halftone_dots_cover_the_share_of_the_tone() {
        for share in [0.02, 0.2, 0.5, 0.7, 0.8, 0.9, 0.98] {
            let radius = diameter(share) / 2.0;
            let steps = 400;
            let inside = (0..steps * steps).filter(|k| {
                let (x, y) = ((k % steps) as f64 + 0.5, (k / steps) as f64 + 0.5);
                let (x, y) = (x / steps as f64 - 0.5, y / steps as f64 - 0.5);
                // A point of a unit square is covered by the dot at its centre or by those of its neighbours.
                let near = |dx: f64, dy: f64| (x - dx).powi(2) + (y - dy).powi(2) <= radius * radius;
                near(0.0, 0.0) || [-1.0, 1.0].iter().any(|step| near(*step, 0.0) || near(0.0, *step))
            });
            let covered = inside.count() as f64 / (steps * steps) as f64;
            assert!((covered - share).abs() < 0.003, "{covered} is not {share}");
        }
        assert!((diameter(1.0) - std::f64::consts::SQRT_2).abs() < 1e-6);
    }

    #[test]
    fn halftone_dots_include_every_visible_dot_and_few_others() {
        let shapes: [BezPath; 3] = [
            Circle::new((3.3, -2.1), 7.7).to_path(1e-4),
            BezPath::from_svg("M0 0L30 1L0 2ZM5 5H20V25H5ZM8 8V20H17V8Z").unwrap(),
            Rect::new(0.2, 0.2, 0.4, 9.0).to_path(1e-4),
        ];
        for shape in shapes {
            let found = dots(&shape, |_| 0.6).unwrap();
            let laid: Vec<(i32, i32)> = found.values().flatten().copied().collect();
            let radius = diameter(0.6) / 2.0;
            let mut vain = 0;
            for (x, y) in (-40..60).flat_map(|x| (-40..60).map(move |y| (x, y))) {
                let middle = Point::new(f64::from(x), f64::from(y));
                let around = (0..64).flat_map(|k| [0.5, 1.0].map(|r| (k, r)));
                let mut points = around.map(|(k, r)| {
                    let angle = f64::from(k) / 64.0 * std::f64::consts::TAU;
                    middle + kurbo::Vec2::new(cos(angle), sin(angle)) * (r * radius)
                });
                let shows = shape.contains(middle) || points.any(|p| shape.contains(p));
                let is_laid = laid.contains(&(x, y));
                assert!(is_laid || !shows, "no dot at {x} {y}");
                vain += usize::from(is_laid && !shows);
            }
            assert!(vain < laid.len() / 2 + 20, "{vain} of {} in vain", laid.len());
            let mut all = laid.clone();
            all.sort_unstable();
            all.dedup();
            assert_eq!(all.len(), laid.len(), "no dot is laid twice");
        }
    }

    #[test]
    fn screen_lattice_has_the_angle_and_spacing_of_its_plate() {
        let screen = Screen { lpi: 50.8, angle_deg: 45.0 };
        let step = |plate: usize| screen.lattice(plate, 1.0) * Point::new(1.0, 0.0);
        for (plate, angle) in [(0, 15.0), (1, 75.0), (2, 0.0), (3, 45.0_f64)] {
            let wanted = kurbo::Vec2::new(cos(angle.to_radians()), -sin(angle.to_radians())) * 0.5;
            assert!((step(plate).to_vec2() - wanted).hypot() < 1e-9, "plate {plate}");
        }
    }
}
