//! Shallow creases: edges of machined parts that turn by less than the crease angle between surfaces that end
//! there. Bars with known profiles are the reference.

use std::f64::consts::TAU;

use glam::DVec3;
use ligne::geometry::numbers::portable_math::{atan2, cos, sin};
use ligne::lines::{FeatureSegment, LineKind, LineOptions};
use ligne::mesh::{Mesh, Soup};
use ligne::surface::Patches;

use crate::library::support::pipeline::{orthographic, run_stages, scene};
use crate::library::support::scenes::profile_bars::{BAR_LENGTH, bar, step_profile};
use crate::library::support::scenes::solids::Solid;

fn mesh(solid: Solid) -> Mesh {
    Mesh::build(Soup { positions: solid.positions, triangles: solid.triangles, ..Soup::default() })
}

/// Returns the profile corners (by index) along which a bar has a crease.
fn crease_corners(profile: &[[f64; 2]], crease_deg: f64) -> Vec<usize> {
    let mesh = mesh(bar(profile));
    let hard = Patches::new(&mesh, crease_deg, false).hard;
    let corner = |edge: &usize| {
        let [from, to] = mesh.edges.vertices[*edge].map(|v| mesh.positions[v as usize] + mesh.origin);
        profile.iter().position(|[x, y]| {
            let is_at = |p: DVec3| (p.x - x).abs().max((p.y - y).abs()) < 1e-9;
            is_at(from) && is_at(to)
        })
    };
    let mut found: Vec<usize> =
        (0..mesh.edges.len()).filter(|edge| hard.is_hard(*edge)).filter_map(|edge| corner(&edge)).collect();
    found.sort_unstable();
    found
}

/// A plate with upper corners cut at 30 degrees.
fn chamfered_profile() -> Vec<[f64; 2]> {
    let low = 1.0 - 0.5 / 3f64.sqrt();
    vec![[-3.0, -1.0], [3.0, -1.0], [3.0, low], [2.5, 1.0], [-2.5, 1.0], [-3.0, low]]
}

#[test]
fn both_edges_of_a_chamfer_are_creases() {
    // The chamfer turns by 30 degrees at both ends and is far too wide to be a facet.
    assert_eq!(crease_corners(&chamfered_profile(), 40.0), [0, 1, 2, 3, 4, 5]);
}

#[test]
fn a_larger_crease_angle_leaves_out_shallow_creases() {
    assert_eq!(crease_corners(&chamfered_profile(), 45.0), [0, 1, 2, 5]);
}

#[test]
fn facets_of_curved_surfaces_have_no_creases_between_them() {
    let cylinder: Vec<[f64; 2]> =
        (0..12).map(|k| TAU * f64::from(k) / 12.0).map(|turn| [cos(turn), sin(turn)]).collect();
    assert_eq!(crease_corners(&cylinder, 40.0), [0; 0], "twelve sides");
    // Half a cylinder: its last facets end at a corner.
    let mut half: Vec<[f64; 2]> =
        (0..=6).map(|k| TAU * f64::from(k) / 12.0).map(|turn| [cos(turn), sin(turn)]).collect();
    half.extend([[-1.0, -1.0], [1.0, -1.0]]);
    assert_eq!(crease_corners(&half, 40.0), [7, 8], "half of them on a block");
}

#[test]
fn coarse_fillets_have_no_shallow_creases() {
    let corner = |steps: u32| {
        (0..=steps)
            .map(move |k| TAU / 4.0 * f64::from(k) / f64::from(steps))
            .map(|turn| [2.0 + cos(turn), 1.0 + sin(turn)])
    };
    for count in [2, 3] {
        let mut profile = vec![[-3.0, -1.0], [3.0, -1.0]];
        profile.extend(corner(count));
        profile.push([-3.0, 2.0]);
        let sharp = if count == 2 { vec![0, 1, 3, 5] } else { vec![0, 1, 6] };
        assert_eq!(crease_corners(&profile, 40.0), sharp, "{count} steps");
    }
    // Half a turn in four facets: 45 degrees between the facets and 22.5 degrees at both ends.
    let turns = [22.5, 45.0, 45.0, 45.0, 22.5];
    let mut profile = step_profile(
        [-3.0, -1.0],
        &[(4.0, turns[0]), (0.8, turns[1]), (0.8, turns[2]), (0.8, turns[3]), (0.8, turns[4]), (4.0, 90.0)],
    );
    profile.dedup_by(|a, b| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < 1e-9);
    assert_eq!(crease_corners(&profile, 40.0), [0, 2, 3, 4, 6], "four steps");
}

#[test]
fn a_ramp_has_a_crease_at_both_its_ends() {
    let profile = [[-4.0, -1.0], [4.0, -1.0], [4.0, 1.5], [1.0, 1.5], [-1.0, 0.4], [-4.0, 0.4]];
    let turn = atan2(1.1, 2.0).to_degrees();
    assert!((20.0..40.0).contains(&turn));
    assert_eq!(crease_corners(&profile, 40.0), [0, 1, 2, 3, 4, 5]);
}

#[test]
fn a_groove_of_alternating_shallow_turns_has_no_creases() {
    // The profile turns down by 30 degrees, up by 30 twice, and down by 30 again.
    let groove = [[2.0, 1.5], [1.134, 1.0], [0.134, 1.0], [-0.732, 1.5]];
    let mut profile = vec![[-4.0, -1.0], [4.0, -1.0], [4.0, 1.5]];
    profile.extend(groove);
    profile.push([-4.0, 1.5]);
    assert_eq!(crease_corners(&profile, 40.0), [0, 1, 2, 7]);
}

/// A disc of ten sides with a conical rim. The facets are very wide: the direction perpendicular to one of
/// their lateral sides leaves the facet at the top or bottom.
fn bevelled_disc() -> Solid {
    const SIDES: u32 = 10;
    let mut solid = Solid::default();
    for (radius, height) in [(1.0, 0.0), (0.8, 0.15)] {
        solid.positions.push(DVec3::new(0.0, 0.0, height));
        let turns = (0..SIDES).map(|k| TAU * f64::from(k) / f64::from(SIDES));
        solid.positions.extend(turns.map(|turn| DVec3::new(radius * cos(turn), radius * sin(turn), height)));
    }
    for k in 0..SIDES {
        let [a, b] = [k + 1, (k + 1) % SIDES + 1];
        let [c, d] = [a, b].map(|v| v + SIDES + 1);
        solid.triangles.extend([[a, b, c], [b, d, c], [b, a, 0], [c, d, SIDES + 1]]);
    }
    solid
}

#[test]
fn a_bevel_has_creases_at_both_rims_only() {
    let mesh = mesh(bevelled_disc());
    let hard = Patches::new(&mesh, 40.0, false).hard;
    let level = |edge: &usize| {
        let [a, b] = mesh.edges.vertices[*edge].map(|v| mesh.positions[v as usize].z);
        (a - b).abs() < 1e-9
    };
    let all: Vec<usize> = (0..mesh.edges.len()).filter(|edge| hard.is_hard(*edge)).collect();
    assert_eq!([all.len(), all.iter().filter(|edge| level(edge)).count()], [20, 20]);
}

/// A roof on a box. The ridge begins above one side of the box and ends inside it. The triangle below its end
/// leaves open whether the ridge is intended as a crease.
fn hipped_roof(ridge: f64) -> Solid {
    let mut solid = Solid::default();
    let corners = [[-1.0, 0.0], [1.0, 0.0], [1.0, 2.5], [-1.0, 2.5]];
    solid.positions.extend(corners.map(|[x, y]| DVec3::new(x, y, 0.0)));
    solid.positions.extend(corners.map(|[x, y]| DVec3::new(x, y, -1.0)));
    // The start of the ridge, its end, and the middles of the far eaves and of the sides.
    let places = [[0.0, 0.0, ridge], [0.0, 2.0, ridge], [0.0, 2.5, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    solid.positions.extend(places.map(DVec3::from_array));
    let [begin, end, far, right, left] = [8, 9, 10, 11, 12];
    solid.triangles.extend([
        [begin, right, end],
        [begin, 1, right],
        [right, 2, end],
        [begin, end, left],
        [begin, left, 0],
        [left, end, 3],
        [end, 2, far],
        [end, far, 3],
        // Down to the box.
        [0, 1, begin],
        [0, 4, 1],
        [1, 4, 5],
        [3, far, 2],
        [3, 2, 7],
        [2, 6, 7],
        [1, 5, right],
        [right, 5, 2],
        [2, 5, 6],
        [0, left, 4],
        [left, 3, 4],
        [3, 7, 4],
        [4, 7, 5],
        [5, 7, 6],
    ]);
    solid
}

#[test]
fn shallow_creases_that_end_inside_a_surface_are_left_out() {
    let mesh = mesh(hipped_roof(0.18));
    let hard = Patches::new(&mesh, 40.0, false).hard;
    let along: Vec<[DVec3; 2]> = (0..mesh.edges.len())
        .filter(|edge| hard.is_hard(*edge))
        .map(|edge| mesh.edges.vertices[edge].map(|v| mesh.positions[v as usize] + mesh.origin))
        .filter(|ends| ends.iter().all(|p| p.z > 0.1))
        .collect();
    assert!(along.is_empty(), "{along:?}");
}

#[test]
fn the_drawing_of_a_chamfered_plate_has_all_its_edges() {
    let plate = scene([bar(&chamfered_profile())]);
    let drawn = run_stages(
        &plate,
        &orthographic(DVec3::new(2.0, 9.0, 12.0), DVec3::new(0.0, 0.0, 3.0), 10.0),
        &LineOptions::default(),
    );
    // The plate has six edges along its length, two of them on the outline.
    let along = |kind: LineKind| {
        let is_along = |s: &&FeatureSegment| {
            let [a, b] = s.ends.map(|v| drawn.mesh.positions[v as usize]);
            s.kind == kind && (a.z - b.z).abs() > 0.9 * BAR_LENGTH
        };
        drawn.lines.segments.iter().filter(is_along).count()
    };
    assert_eq!(along(LineKind::Crease), 4);
    // One of them faces down. Four more are visible at one end of the plate.
    assert_eq!(drawn.visible_segments_of_kind(LineKind::Crease).len(), 3 + 4);
}
