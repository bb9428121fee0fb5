//! Narrow fillets in few steps are drawn as one line along their middle; solids with known fillets are the
//! reference.

use std::f64::consts::TAU;

use glam::DVec3;
use kurbo::Point;
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::lines::{LineKind, LineOptions};
use ligne::mesh::{EdgeMark, Mesh, Soup};
use ligne::scene::Camera;
use ligne::surface::Patches;

use crate::library::support::pipeline::{Stages, orthographic, run_stages, scene};
use crate::library::support::scenes::profile_bars::bar;
use crate::library::support::scenes::solids::Solid;

fn patches(solid: Solid) -> (Mesh, Patches) {
    let soup = Soup { positions: solid.positions, triangles: solid.triangles, ..Soup::default() };
    let mesh = Mesh::build(soup);
    let patches = Patches::new(&mesh, 40.0, false);
    (mesh, patches)
}

/// Returns the ends of the middle edges of narrow fillets.
fn middle_edges(solid: Solid) -> Vec<[DVec3; 2]> {
    let (mesh, patches) = patches(solid);
    let ends = |edge: usize| mesh.edges.vertices[edge].map(|v| mesh.positions[v as usize] + mesh.origin);
    patches.fillet_centres.iter().map(ends).collect()
}

/// A plate with one corner rounded in `steps` steps. The profile begins with the fillet.
fn plate(steps: u32, radius: f64) -> Vec<[f64; 2]> {
    let mut profile: Vec<[f64; 2]> = (0..=steps)
        .map(|k| TAU / 4.0 * f64::from(k) / f64::from(steps))
        .map(|turn| [3.0 - radius + radius * cos(turn), 1.0 - radius + radius * sin(turn)])
        .collect();
    profile.extend([[-3.0, 1.0], [-3.0, -1.0], [3.0, -1.0]]);
    profile
}

/// Returns the profile corners (by index) along which a bar has the middle line of a narrow fillet.
fn middle_line_corners(profile: &[[f64; 2]]) -> Vec<usize> {
    let found = middle_edges(bar(profile));
    let is_at = |p: DVec3, [x, y]: [f64; 2]| (p.x - x).abs().max((p.y - y).abs()) < 1e-9;
    let has = |k: &usize| found.iter().any(|ends| ends.iter().all(|end| is_at(*end, profile[*k])));
    (0..profile.len()).filter(has).collect()
}

#[test]
fn a_narrow_fillet_is_one_line_in_its_middle() {
    // With two steps the middle is a crease anyway. Odd numbers have no middle edge, so the edge nearer to
    // the wider surface is used.
    assert_eq!(
        [2, 3, 4, 5].map(|steps| middle_line_corners(&plate(steps, 0.3))),
        [vec![], vec![2], vec![2], vec![3]]
    );
}

#[test]
fn edges_hidden_by_the_file_are_not_drawn() {
    let hidden = |solid: Solid| {
        let edge_marks = vec![[EdgeMark::Hidden; 3]; solid.triangles.len()];
        let mesh = Mesh::build(Soup {
            positions: solid.positions,
            triangles: solid.triangles,
            edge_marks,
            ..Soup::default()
        });
        let patches = Patches::new(&mesh, 40.0, false);
        patches.hard.count() + patches.fillet_centres.iter().count()
    };
    assert_eq!(hidden(bar(&plate(4, 0.3))), 0, "a narrow rounding");
    let low = 1.0 - 0.5 / 3f64.sqrt();
    let chamfered = [[-3.0, -1.0], [3.0, -1.0], [3.0, low], [2.5, 1.0], [-2.5, 1.0], [-3.0, low]];
    assert_eq!(hidden(bar(&chamfered)), 0, "chamfers");
}

#[test]
fn wide_or_finely_stepped_fillets_have_no_middle_line() {
    assert!(middle_line_corners(&plate(4, 1.2)).is_empty(), "as wide as what it joins");
    assert!(middle_line_corners(&plate(8, 0.3)).is_empty(), "eight steps");
}

#[test]
fn steps_of_unequal_width_are_no_fillet() {
    let mut profile = plate(4, 0.3);
    profile[1] = [2.99, 0.77];
    assert!(middle_line_corners(&profile).is_empty());
}

/// A plate with a fillet in four steps. The second corner is shifted by `by` along the arc, except between
/// `from` and `to`.
fn uneven_fillet(from: f64, to: f64, by: f64) -> Solid {
    const CHANGE: f64 = 0.6;
    let profile = plate(4, 0.3);
    let mut solid = Solid::default();
    let places = [0.0, from - CHANGE, from, to, to + CHANGE, 6.0];
    let count = profile.len() as u32;
    for (ring, z) in places.into_iter().enumerate() {
        let moved = |(k, [x, y]): (usize, &[f64; 2])| {
            let by = if k == 1 && !(2..4).contains(&ring) { by } else { 0.0 };
            DVec3::new(x - by * sin(TAU / 16.0), y + by * cos(TAU / 16.0), z)
        };
        solid.positions.extend(profile.iter().enumerate().map(moved));
    }
    for (ring, k) in (0..5).flat_map(|ring| (0..count).map(move |k| (ring, k))) {
        let [a, b] = [k, (k + 1) % count].map(|k| ring * count + k);
        solid.triangles.extend([[a, b, a + count], [b, b + count, a + count]]);
    }
    let last = 5 * count;
    for k in 1..count - 1 {
        solid.triangles.extend([[0, k + 1, k], [last, last + k, last + k + 1]]);
    }
    solid
}

#[test]
fn middle_lines_along_a_small_part_of_a_fillet_are_not_drawn() {
    let length = |solid: Solid| middle_edges(solid).iter().map(|[a, b]| a.distance(*b)).sum::<f64>();
    assert_eq!(
        length(uneven_fillet(2.0, 3.6, 0.04)),
        0.0,
        "a quarter of the rounding, longer than it is wide"
    );
    assert!(length(uneven_fillet(0.7, 5.3, 0.04)) > 4.5, "most of it");
    assert!(length(uneven_fillet(2.0, 3.6, 0.0)) > 5.9, "a rounding that is the same all along");
}

/// A tube of straight pieces, each turned by 30 degrees. The first and last pieces are long.
fn bent_tube(pieces: u32) -> Solid {
    const AROUND: u32 = 12;
    let (mut at, mut heading) = (DVec3::ZERO, 0.0f64);
    let mut solid = Solid::default();
    for k in 0..=pieces {
        // Each ring halves the turn between its two pieces.
        let across = heading - if k == 0 || k == pieces { 0.0 } else { TAU / 24.0 };
        let side = DVec3::new(-sin(across), cos(across), 0.0);
        let wider = if k == 0 || k == pieces { 1.0 } else { 1.0 / cos(TAU / 24.0) };
        for step in 0..AROUND {
            let turn = TAU * (f64::from(step) + 0.5) / f64::from(AROUND);
            solid.positions.push(at + side * (cos(turn) * wider) + DVec3::Z * sin(turn));
        }
        let long = if k == 0 || k + 1 == pieces { 20.0 } else { 0.8 };
        at += DVec3::new(cos(heading), sin(heading), 0.0) * long;
        if k + 1 < pieces {
            heading += TAU / 12.0;
        }
    }
    for (ring, step) in (0..pieces).flat_map(|ring| (0..AROUND).map(move |step| (ring, step))) {
        let [a, b] = [step, (step + 1) % AROUND].map(|step| ring * AROUND + step);
        solid.triangles.extend([[a, b, a + AROUND], [b, b + AROUND, a + AROUND]]);
    }
    let last = pieces * AROUND;
    for k in 1..AROUND - 1 {
        solid.triangles.extend([[0, k + 1, k], [last, last + k, last + k + 1]]);
    }
    solid
}

#[test]
fn a_tube_bend_is_no_fillet() {
    assert!(middle_edges(bent_tube(4)).is_empty());
}

/// A box with all edges rounded in `steps` steps.
fn rounded_box(steps: u32) -> Solid {
    let quarter = |k: u32| TAU / 4.0 * f64::from(k) / f64::from(steps);
    // Latitude rings are doubled at the equator and meridians at each quarter turn. The pairs are apart by
    // the straight lengths of the box.
    let around: Vec<[f64; 3]> = (0..4)
        .flat_map(|q| {
            let [x, y] = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]][q];
            (0..=steps).map(move |k| [TAU / 4.0 * q as f64 + quarter(k), x, y])
        })
        .collect();
    let up: Vec<[f64; 2]> = [-1.0, 1.0]
        .into_iter()
        .flat_map(|z| (0..=steps).map(move |k| [quarter(k) - if z < 0.0 { TAU / 4.0 } else { 0.0 }, z]))
        .collect();
    let count = around.len() as u32;
    let mut solid = Solid::default();
    for [latitude, z] in &up {
        for [turn, x, y] in &around {
            let out = DVec3::new(cos(*latitude) * cos(*turn), cos(*latitude) * sin(*turn), sin(*latitude));
            solid.positions.push(0.1 * out + DVec3::new(*x, *y, 0.7 * z));
        }
    }
    for (ring, step) in (0..up.len() as u32 - 1).flat_map(|ring| (0..count).map(move |step| (ring, step))) {
        let [a, b] = [step, (step + 1) % count].map(|step| ring * count + step);
        solid.triangles.extend([[a, b, b + count], [a, b + count, a + count]]);
    }
    let corners = [0, 1, 2, 3].map(|q| q * (steps + 1));
    let last = corners.map(|corner| corner + (up.len() as u32 - 1) * count);
    let [[a, b, c, d], [e, f, g, h]] = [corners, last];
    solid.triangles.extend([[a, c, b], [a, d, c], [e, f, g], [e, g, h]]);
    solid
}

/// A view from above a corner that shows three sides of a box.
fn from_a_corner() -> Camera {
    orthographic(DVec3::new(6.0, 8.0, 7.0), DVec3::ZERO, 4.5)
}

/// The image of that corner.
fn nearest_corner_image() -> Point {
    let camera = from_a_corner();
    let forward = (camera.target - camera.eye).normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let at = DVec3::new(1.05, 1.05, 0.75);
    let [x, y] = [at.dot(right), at.dot(right.cross(forward))].map(|x| x * 1000.0 / 4.5);
    Point::new(500.0 + x, 500.0 - y)
}

fn lengths(drawn: &Stages, kind: LineKind) -> f64 {
    drawn.visible_segments_of_kind(kind).iter().map(|[a, b]| a.distance(*b)).sum()
}

#[test]
fn a_filleted_box_has_edge_lines_and_the_fine_outline() {
    for steps in [3, 4, 5] {
        let (_, patches) = patches(rounded_box(steps));
        assert_eq!((patches.hard.count(), patches.fillet_centres.iter().count()), (0, 12), "{steps} steps");
        let model = scene([rounded_box(steps)]);
        let drawn = run_stages(&model, &from_a_corner(), &LineOptions::default());
        // Three meet at the corner nearest to the camera. Others near the outline may be visible as well.
        let meets = |ends: &&[Point; 2]| ends.iter().any(|end| end.distance(nearest_corner_image()) < 60.0);
        let edges = drawn.visible_segments_of_kind(LineKind::Crease);
        assert_eq!(edges.iter().filter(meets).count(), 3, "{steps} steps: {edges:?}");
        let fine = run_stages(&scene([rounded_box(8)]), &from_a_corner(), &LineOptions::default());
        assert!(fine.visible_segments_of_kind(LineKind::Crease).is_empty());
        let [coarse, fine] = [&drawn, &fine].map(|drawn| lengths(drawn, LineKind::Contour));
        assert!((coarse / fine - 1.0).abs() < 0.02, "{steps} steps: {coarse} px for {fine} px");
    }
}

/// A drum with an upper rim rounded in four steps.
fn drum(sides: u32) -> Solid {
    let mut profile = vec![[0.0, -1.0], [1.0, -1.0]];
    profile
        .extend((0..=4).map(|k| TAU / 16.0 * f64::from(k)).map(|t| [0.9 + 0.1 * cos(t), 0.9 + 0.1 * sin(t)]));
    let mut solid = Solid::default();
    for [radius, height] in &profile[1..] {
        let turns = (0..sides).map(|k| TAU * f64::from(k) / f64::from(sides));
        solid.positions.extend(turns.map(|turn| DVec3::new(radius * cos(turn), *height, radius * sin(turn))));
    }
    let rings = profile.len() as u32 - 1;
    for (ring, step) in (0..rings - 1).flat_map(|ring| (0..sides).map(move |step| (ring, step))) {
        let [a, b] = [step, (step + 1) % sides].map(|step| ring * sides + step);
        solid.triangles.extend([[a, b + sides, b], [a, a + sides, b + sides]]);
    }
    let last = (rings - 1) * sides;
    for k in 1..sides - 1 {
        solid.triangles.extend([[0, k, k + 1], [last, last + k + 1, last + k]]);
    }
    solid
}

#[test]
fn a_filleted_rim_has_one_closed_middle_line() {
    let found = middle_edges(drum(24));
    assert_eq!(found.len(), 24);
    let height = 0.9 + 0.1 * sin(TAU / 8.0);
    assert!(found.iter().flatten().all(|end| (end.y - height).abs() < 1e-9));
}
