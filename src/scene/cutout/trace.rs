//! [`trace`]: the borders between what is opaque in a mask and what is clear, in the plane of its texels.
//!
//! Source: Lorensen and Cline, "Marching cubes", SIGGRAPH 1987, in two dimensions; cells with two diagonals as Nielson
//! and Hamann, "The asymptotic decider", 1991.

use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};

use super::mask::Mask;
use crate::scene::texels::Traced;

/// How far the pieces of a border lie beside it, texels.
const STRAIGHT: f64 = 1e-3;

/// A picture whose texels part opaque from clear more often than this has no borders.
const MOST_CROSSINGS: usize = 1 << 22;

/// A side between neighbouring texels: the column and row of the first, and whether the second lies below it.
type Side = (u32, u32, bool);

/// Traces the borders of a mask, with what is opaque on their left (x to the right, y upwards); none if there are too many.
pub(super) fn trace(mask: &Mask) -> Option<Traced> {
    let (reach, periods) = (mask.texels.reach(), mask.texels.periods());
    Some(Traced { lines: lines(mask, reach)?, parted: Vec::new(), reach, periods })
}

/// The borders in the cells between so many texels and their neighbours, end to end.
fn lines(mask: &Mask, [columns, rows]: [usize; 2]) -> Option<Vec<Vec<DVec2>>> {
    let mut next: FxHashMap<Side, Side> = FxHashMap::default();
    let mut starts: Vec<Side> = Vec::new();
    let mut above: Vec<f64> = (0..=columns as i64).map(|i| mask.texel(i, 0)).collect();
    for j in 0..rows as u32 {
        let below: Vec<f64> = (0..=columns as i64).map(|i| mask.texel(i, i64::from(j) + 1)).collect();
        for i in 0..columns as u32 {
            let k = i as usize;
            let corners = [above[k], above[k + 1], below[k + 1], below[k]];
            let is_in = corners.map(|value| value > 0.0);
            if is_in == [is_in[0]; 4] {
                continue;
            }
            let sides = [(i, j, false), (i + 1, j, true), (i, j + 1, false), (i, j, true)];
            // Round the cell: where it is left, and where it is entered again.
            let leaves = (0..4).filter(|s| is_in[*s] && !is_in[(*s + 1) % 4]);
            let [a, b, c, d] = corners;
            // The value where bilinear opacity has its saddle.
            let joined = (a * c - b * d) / (a + c - b - d) >= 0.0;
            for leave in leaves {
                let enters = |s: &usize| !is_in[*s % 4] && is_in[(*s + 1) % 4];
                // Where the saddle is opaque the next entry ahead belongs to the other corner.
                let enter = match joined {
                    true => (leave + 1..leave + 4).find(enters),
                    false => (leave + 1..leave + 4).rev().find(enters),
                };
                if let Some(enter) = enter {
                    next.insert(sides[leave], sides[enter % 4]);
                    starts.push(sides[leave]);
                }
            }
        }
        above = below;
        if starts.len() > MOST_CROSSINGS {
            return None;
        }
    }
    let point = |(i, j, down): Side| {
        let (a, b) = (
            mask.texel(i.into(), j.into()),
            mask.texel((i + u32::from(!down)).into(), (j + u32::from(down)).into()),
        );
        let part = a / (a - b);
        DVec2::new(f64::from(i), f64::from(j)) + if down { DVec2::Y } else { DVec2::X } * part
    };
    // Open lines begin where nothing leads to.
    let led_to: FxHashSet<Side> = next.values().copied().collect();
    let (open, closed): (Vec<Side>, Vec<Side>) = starts.into_iter().partition(|side| !led_to.contains(side));
    let mut lines = Vec::new();
    for start in open.into_iter().chain(closed) {
        let mut line = Vec::new();
        let mut at = start;
        while let Some(to) = next.remove(&at) {
            line.push(point(at));
            curve(mask, point(at), point(to), &mut line);
            at = to;
        }
        if !line.is_empty() {
            line.push(point(at));
            lines.push(line);
        }
    }
    Some(lines)
}

/// Adds points of the border on its way through a cell, where it is a piece of a hyperbola: opacity is bilinear.
fn curve(mask: &Mask, from: DVec2, to: DVec2, line: &mut Vec<DVec2>) {
    let low = ((from + to) / 2.0).floor();
    let (i, j) = (low.x as i64, low.y as i64);
    let [a, b, c, d] = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| mask.texel(i + x, j + y));
    let twist = a - b - c + d;
    // The border is where the product of the distances from the axes is `product`.
    let axes = low - DVec2::new(c - a, b - a) / twist;
    let product = ((b - a) * (c - a) / twist - a) / twist;
    if axes.is_finite() && product.is_finite() && (from.x - axes.x) * (to.x - axes.x) > 0.0 {
        bend(axes, product, from, to, line);
    }
}

/// Adds points of a hyperbola between two of its points until what is left between them is all but straight.
fn bend(axes: DVec2, product: f64, from: DVec2, to: DVec2, line: &mut Vec<DVec2>) {
    let x = ((from.x - axes.x) * (to.x - axes.x)).sqrt().copysign(from.x - axes.x);
    let middle = axes + DVec2::new(x, product / x);
    let way = to - from;
    let off = way.perp_dot(middle - from).abs();
    if off > STRAIGHT * way.length() && way.length_squared() > STRAIGHT * STRAIGHT {
        bend(axes, product, from, middle, line);
        line.push(middle);
        bend(axes, product, middle, to, line);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::material::Wrap;
    use crate::scene::texels::outline::Outline;

    fn outline(mask: &Mask, tolerance: f64) -> Outline {
        Outline::new(&trace(mask).unwrap(), tolerance)
    }

    fn disc(size: usize, radius: f64) -> Vec<u8> {
        let middle = (size as f64 - 1.0) / 2.0;
        let at = |k: usize| DVec2::new((k % size) as f64 - middle, (k / size) as f64 - middle).length();
        (0..size * size).map(|k| (127.5 + 255.0 * (at(k) - radius)).clamp(0.0, 255.0) as u8).collect()
    }

    #[test]
    fn a_round_hole_is_round() {
        let mask = Mask::of_opacities(64, disc(64, 20.3), Wrap::Repeat);
        let outline = outline(&mask, 0.02);
        let middle = DVec2::splat(31.5);
        assert!(outline.segments.len() > 40 && outline.segments.len() < 240, "{}", outline.segments.len());
        for [a, b] in &outline.segments {
            let off = (a.distance(middle) - 20.3).abs().max(((*a + *b) / 2.0).distance(middle) - 20.3);
            assert!(off < 0.1, "{off}");
            // Opaque is outside.
            assert!((*b - *a).perp_dot(middle - *a) < 0.0);
        }
        // Three periods on, the same.
        let far = outline.near(DVec2::splat(192.0), DVec2::splat(256.0)).unwrap();
        assert_eq!(far.len(), outline.segments.len());
    }

    #[test]
    fn borders_go_on_over_the_seam_or_beyond() {
        // The left half is opaque.
        let half = |wrap| Mask::of_opacities(4, [255, 255, 0, 0].repeat(4), wrap);
        let repeated = outline(&half(Wrap::Repeat), 0.1);
        assert_eq!(repeated.segments.len(), 2);
        assert!(repeated.segments.iter().all(|[a, b]| (a.y - b.y).abs() == 4.0));
        let clamped = outline(&half(Wrap::Clamp), 0.1);
        let far = clamped.near(DVec2::new(0.0, 500.0), DVec2::new(3.0, 600.0)).unwrap();
        assert!(far.iter().all(|[a, b]| a.x == 1.5 && b.x == 1.5) && !far.is_empty());
        assert_eq!(outline(&half(Wrap::Mirror), 0.1).segments.len(), 2);
    }

    #[test]
    fn a_picture_of_one_column_has_borders_along_it() {
        let mask = Mask::of_opacities(1, vec![0, 0, 255, 255], Wrap::Clamp);
        let near = outline(&mask, 0.1).near(DVec2::new(-0.3, 0.0), DVec2::new(0.2, 3.0)).unwrap();
        assert!(!near.is_empty() && near.iter().flatten().all(|p| p.y == 1.5));
    }

    #[test]
    fn texture_coordinates_that_run_on_for_ever_are_too_many() {
        let outline = outline(&Mask::of_opacities(4, [255, 255, 0, 0].repeat(4), Wrap::Repeat), 0.1);
        assert!(outline.near(DVec2::new(0.0, 0.0), DVec2::new(9e8, 1e-3)).is_none());
    }
}
