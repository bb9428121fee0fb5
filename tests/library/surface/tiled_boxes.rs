//! Boxes of separately triangulated tiles, or stitched by degenerate triangles, are drawn as plain boxes.

use std::collections::BTreeMap;

use super::seams::{add_tile, count_open_and_sharp_edges, mesh};
use crate::library::support::pipeline::{exact_options, orthographic, perspective, run_stages, scene};
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::solids::{Solid, cuboid};
use glam::DVec3;
use kurbo::Point;
use ligne::lines::LineKind;

/// A unit box with two tiles on each side. Each side is divided at a different place.
fn box_of_tiles() -> Solid {
    let mut solid = Solid::default();
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    let sides =
        [(x, y, z), (y, z, x), (z, x, y), (y, x, DVec3::ZERO), (z, y, DVec3::ZERO), (x, z, DVec3::ZERO)];
    for (k, (u, v, corner)) in sides.into_iter().enumerate() {
        let part = 0.3 + 0.07 * k as f64;
        add_tile(&mut solid, corner, u * part, v);
        add_tile(&mut solid, corner + u * part, u * (1.0 - part), v);
    }
    solid
}

/// A unit box whose sides divide each edge at different points, joined there by degenerate triangles: two
/// along each edge. They overlap if `upon` is set, and are adjacent otherwise.
fn stitched_box(upon: bool) -> Solid {
    let mut solid = Solid { triangles: Vec::new(), ..cuboid(DVec3::ZERO, DVec3::ONE) };
    let sides = [[0u32, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut stitches = BTreeMap::new();
    for side in sides {
        let at = |positions: &[DVec3], v: u32| positions[v as usize];
        let middle = solid.positions.len() as u32;
        solid.positions.push(side.iter().map(|v| at(&solid.positions, *v)).sum::<DVec3>() / 4.0);
        for k in 0..4 {
            let (from, to) = (side[k], side[(k + 1) % 4]);
            let [low, high] = [from.min(to), from.max(to)];
            let near = solid.positions.len() as u32;
            let is_first = !stitches.contains_key(&[low, high]);
            let near = *stitches.entry([low, high]).or_insert(near);
            let far = near + 1;
            if is_first {
                let [a, b] = [low, high].map(|v| at(&solid.positions, v));
                solid.positions.extend([a.lerp(b, 0.25), a.lerp(b, 0.75)]);
                let needles = if upon {
                    [[low, high, far], [low, near, high]]
                } else {
                    [[low, near, far], [near, high, far]]
                };
                let turned = |[a, b, c]: [u32; 3]| if from == low { [a, b, c] } else { [c, b, a] };
                solid.triangles.extend(needles.map(turned));
            }
            let own = if is_first { far } else { near };
            solid.triangles.extend([[from, own, middle], [own, to, middle]]);
        }
    }
    solid
}

/// Returns the distinct end points of lines, rounded to a hundredth of a px.
fn rounded_end_points(lines: &[[Point; 2]]) -> Vec<[i64; 2]> {
    let mut ends: Vec<[i64; 2]> =
        lines.iter().flatten().map(|p| [p.x, p.y].map(|c| (c * 100.0).round() as i64)).collect();
    ends.sort_unstable();
    ends.dedup();
    ends
}

/// Asserts that a solid is drawn as the unit box from random directions.
fn assert_drawn_as_a_box(solid: &Solid) {
    let mut dice = Dice::new(5);
    for k in 0..12 {
        let way = dice.direction() * 6.0;
        let middle = DVec3::splat(0.5);
        let camera = if k % 2 == 0 {
            perspective(middle + way, middle, 30.0)
        } else {
            orthographic(middle + way, middle, 2.5)
        };
        let length = |lines: &[[Point; 2]]| lines.iter().map(|[a, b]| a.distance(*b)).sum::<f64>();
        let drawn = |solid: Solid| {
            let drawn = run_stages(&scene([solid]), &camera, &exact_options());
            assert!(drawn.visible_segments_of_kind(LineKind::Border).is_empty());
            [drawn.visible_segments(), drawn.silhouette_segments()]
        };
        let ([own, outline], [plain, plain_outline]) =
            (drawn(solid.clone()), drawn(cuboid(DVec3::ZERO, DVec3::ONE)));
        for (own, plain) in [(&own, &plain), (&outline, &plain_outline)] {
            assert!((length(own) - length(plain)).abs() < 1e-6, "{} and {}", length(own), length(plain));
        }
        assert!(rounded_end_points(&plain).iter().all(|end| rounded_end_points(&own).contains(end)));
    }
}

#[test]
fn a_box_of_tiles_is_drawn_as_a_box() {
    let tiles = box_of_tiles();
    assert_eq!(count_open_and_sharp_edges(&mesh(&tiles), 45.0)[0], 0, "every edge has two faces");
    assert_drawn_as_a_box(&tiles);
}

#[test]
fn a_box_stitched_by_zero_area_triangles_is_drawn_as_a_box() {
    for upon in [false, true] {
        let stitched = stitched_box(upon);
        assert_eq!(mesh(&stitched).cleaning.degenerate, 24);
        assert_drawn_as_a_box(&stitched);
    }
}
