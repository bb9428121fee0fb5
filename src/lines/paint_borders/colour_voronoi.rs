//! [`borders`]: borders inside a triangle between the palette colours nearest to its interpolated colour.
//!
//! The colour is linear over the triangle. As in a Voronoi diagram, each palette colour has a convex cell. A
//! border is the part of the bisector of two colours that is nearer to no third one. Points on a side depend
//! on that side alone, so that neighbouring triangles agree.

use crate::colour::oklab::Oklab;
use crate::lines::tolerances;

/// Border: its ends in barycentric weights of the triangle, and the indices of the colours on its sides.
pub(crate) type ColourBorder = ([[f64; 3]; 2], [u8; 2]);

/// Borders in a triangle with the given corner colours. Sides run from the earlier corner to the later one.
pub(crate) fn borders(corners: [Oklab; 3], palette: &[Oklab]) -> Vec<ColourBorder> {
    // Squared distance of each colour from a corner's colour, without the common term. It is linear between
    // corners.
    let far = |colour: &Oklab| {
        corners.map(|own| {
            (0..3)
                .map(|k| f64::from(colour[k]) * (f64::from(colour[k]) - 2.0 * f64::from(own[k])))
                .sum::<f64>()
        })
    };
    let far: Vec<[f64; 3]> = palette.iter().map(far).collect();
    let most = |of: &[f64; 3]| of[0].max(of[1]).max(of[2]);
    let least = |of: &[f64; 3]| of[0].min(of[1]).min(of[2]);
    let bound = far.iter().map(most).fold(f64::INFINITY, f64::min);
    let near: Vec<usize> = (0..far.len()).filter(|k| least(&far[*k]) <= bound).collect();
    let mut found = Vec::new();
    for (n, &i) in near.iter().enumerate() {
        for &j in &near[n + 1..] {
            let others = near.iter().copied().filter(|k| *k != i && *k != j);
            found.extend(between(&far, i, j, others).map(|ends| (ends, [i as u8, j as u8])));
        }
    }
    found
}

/// Border between two cells, if they have one.
fn between(
    far: &[[f64; 3]],
    i: usize,
    j: usize,
    others: impl Iterator<Item = usize>,
) -> Option<[[f64; 3]; 2]> {
    let lead = [0, 1, 2].map(|k| far[i][k] - far[j][k]);
    let on_side = |[a, b]: [usize; 2]| {
        if (lead[a] >= 0.0) == (lead[b] >= 0.0) {
            return None;
        }
        let part = lead[a] / (lead[a] - lead[b]);
        let mut weights = [0.0; 3];
        weights[a] = 1.0 - part;
        weights[b] = part;
        Some(weights)
    };
    let mut crossed = [[0, 1], [0, 2], [1, 2]].into_iter().filter_map(on_side);
    let ends = [crossed.next()?, crossed.next()?];
    // The part that is nearer to no other colour.
    let mut range = [(0.0, None), (1.0, None)];
    for k in others {
        let ahead = ends.map(|at| (0..3).map(|c| (far[k][c] - far[i][c]) * at[c]).sum::<f64>());
        match (ahead[0] >= 0.0, ahead[1] >= 0.0) {
            (true, true) => {}
            (false, false) => return None,
            (starts, _) => {
                let at = ahead[0] / (ahead[0] - ahead[1]);
                let end = usize::from(starts);
                if (at > range[end].0) != starts {
                    range[end] = (at, Some(k));
                }
            }
        }
    }
    if range[0].0 >= range[1].0 {
        return None;
    }
    let end = |n: usize| match range[n].1 {
        None => Some(ends[n]),
        Some(k) => meeting(far, [i, j, k]),
    };
    Some([end(0)?, end(1)?])
}

/// Point where three cells meet. The result is the same for each of their borders.
fn meeting(far: &[[f64; 3]], mut of: [usize; 3]) -> Option<[f64; 3]> {
    of.sort_unstable();
    let [i, j, k] = of;
    let p = [0, 1, 2].map(|c| far[i][c] - far[j][c]);
    let q = [0, 1, 2].map(|c| far[i][c] - far[k][c]);
    let cross = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    let all: f64 = cross.iter().sum();
    let weights = cross.map(|c| c / all);
    weights
        .iter()
        .all(|w| {
            w.is_finite()
                && (-tolerances::MEETING_WEIGHT_MARGIN..1.0 + tolerances::MEETING_WEIGHT_MARGIN).contains(w)
        })
        .then_some(weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Palette colour nearest to the colour at a point of the triangle.
    fn nearest_palette_colour(corners: [Oklab; 3], palette: &[Oklab], at: [f64; 3]) -> u8 {
        let own: [f64; 3] = [0, 1, 2].map(|k| (0..3).map(|c| f64::from(corners[c][k]) * at[c]).sum::<f64>());
        let far = |colour: &Oklab| (0..3).map(|k| (f64::from(colour[k]) - own[k]).powi(2)).sum::<f64>();
        let best = (0..palette.len()).min_by(|a, b| far(&palette[*a]).total_cmp(&far(&palette[*b])));
        best.unwrap_or_default() as u8
    }

    /// Pseudo-random number from 0 to 1.
    fn random_unit(seed: &mut u64) -> f32 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 40) as f32 / (1u64 << 24) as f32
    }

    #[test]
    fn nearest_colour_changes_exactly_at_colour_borders() {
        let mut seed = 7;
        let mut crossings = 0;
        for _ in 0..60 {
            let mut lab =
                || [random_unit(&mut seed), random_unit(&mut seed) - 0.5, random_unit(&mut seed) - 0.5];
            let palette: Vec<Oklab> = (0..9).map(|_| lab()).collect();
            let corners = [lab(), lab(), lab()];
            let found = borders(corners, &palette);
            for line in 1..20 {
                let w = f64::from(line) / 20.0 + 0.001;
                let at = |t: f64| [w, (1.0 - w) * t, (1.0 - w) * (1.0 - t)];
                let steps = 4000;
                let place = |k: u32| at(f64::from(k) / f64::from(steps));
                let seen: Vec<u8> =
                    (0..=steps).map(|k| nearest_palette_colour(corners, &palette, place(k))).collect();
                let changes: Vec<[u8; 2]> = seen
                    .windows(2)
                    .filter(|p| p[0] != p[1])
                    .map(|p| [p[0].min(p[1]), p[0].max(p[1])])
                    .collect();
                let mut crossed: Vec<(f64, [u8; 2])> = found
                    .iter()
                    .filter(|([a, b], _)| (a[0] > w) != (b[0] > w))
                    .map(|([a, b], parted)| {
                        let part = (w - a[0]) / (b[0] - a[0]);
                        (a[1] + (b[1] - a[1]) * part, *parted)
                    })
                    .collect();
                crossed.sort_by(|a, b| a.0.total_cmp(&b.0));
                let crossed: Vec<[u8; 2]> = crossed.into_iter().map(|(_, parted)| parted).collect();
                assert_eq!(changes, crossed);
                crossings += crossed.len();
            }
        }
        assert!(crossings > 1000, "{crossings}");
    }

    #[test]
    fn colour_borders_meet_in_one_point_and_match_across_shared_sides() {
        let palette = [[0.2, 0.0, 0.0], [0.6, 0.3, 0.0], [0.6, -0.3, 0.0]];
        let corners = [[0.0, 0.0, 0.0], [0.8, 0.5, 0.0], [0.8, -0.5, 0.0]];
        let found = borders(corners, &palette);
        assert_eq!(found.len(), 3);
        let ends: Vec<[u64; 3]> =
            found.iter().flat_map(|(ends, _)| ends.map(|end| end.map(f64::to_bits))).collect();
        assert!(ends.iter().any(|end| ends.iter().filter(|other| *other == end).count() == 3));
        // The same side in a triangle with another third corner.
        let other = borders([corners[0], corners[1], [0.1, 0.9, 0.4]], &palette);
        let on_side = |found: &[ColourBorder]| {
            let all = found.iter().flat_map(|(ends, _)| *ends).filter(|end| end[2] == 0.0);
            all.map(|end| end.map(f64::to_bits)).collect::<Vec<_>>()
        };
        assert_eq!(on_side(&found), on_side(&other));
        assert_eq!(on_side(&found).len(), 1);
    }
}
