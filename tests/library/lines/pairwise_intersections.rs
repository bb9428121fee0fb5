//! Intersections of triangles, tested against a brute-force search over all pairs.

use super::intersections::{find, length};
use crate::library::support::readers::mesh_file;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::solids::Solid;
use glam::DVec3;

/// Reference intersection of two triangles: `b` cut by the plane of `a`, then clipped by the sides of `a`.
/// The library uses another method.
fn clip_triangle_pair(a: [DVec3; 3], b: [DVec3; 3]) -> Option<[DVec3; 2]> {
    let normal = |t: [DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]);
    let sides = |t: [DVec3; 3], o: [DVec3; 3]| o.map(|p| normal(t).dot(p - t[0]));
    let straddles = |d: [f64; 3]| d.iter().any(|&x| x < 0.0) && d.iter().any(|&x| x > 0.0);
    let (of_b, of_a) = (sides(a, b), sides(b, a));
    if !straddles(of_b) || !straddles(of_a) {
        return None;
    }
    let mut cut = Vec::new();
    for i in 0..3 {
        let j = (i + 1) % 3;
        if of_b[i] == 0.0 {
            cut.push(b[i]);
        } else if of_b[i] * of_b[j] < 0.0 {
            cut.push(b[i].lerp(b[j], of_b[i] / (of_b[i] - of_b[j])));
        }
    }
    let (p, q) = (cut[0], cut[1]);
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for i in 0..3 {
        let side = normal(a).cross(a[(i + 1) % 3] - a[i]);
        let (at_p, at_q) = (side.dot(p - a[i]), side.dot(q - a[i]));
        let t = at_p / (at_p - at_q);
        if at_p < at_q {
            from = from.max(t);
        } else if at_p > at_q {
            to = to.min(t);
        } else if at_p < 0.0 {
            return None;
        }
    }
    (from < to).then(|| [p.lerp(q, from), p.lerp(q, to)])
}

/// Reference search that tests all pairs of triangles.
fn brute_force(solid: &Solid) -> Vec<([u32; 2], [DVec3; 2])> {
    let bounds = |points: &mut dyn Iterator<Item = DVec3>| {
        points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)))
    };
    let used = &mut solid.triangles.iter().flatten().map(|&v| solid.positions[v as usize]);
    let (low, high) = bounds(used);
    let least = 1e-9 * (high - low).length();
    let corners: Vec<_> = solid.triangles.iter().map(|t| t.map(|v| solid.positions[v as usize])).collect();
    let boxes: Vec<_> = corners.iter().map(|c| bounds(&mut c.iter().copied())).collect();
    let mut found = Vec::new();
    for i in 0..corners.len() {
        for j in i + 1..corners.len() {
            let apart = boxes[i].0.cmpgt(boxes[j].1) | boxes[j].0.cmpgt(boxes[i].1);
            if apart.any() || solid.triangles[i].iter().any(|v| solid.triangles[j].contains(v)) {
                continue;
            }
            if let Some([p, q]) =
                clip_triangle_pair(corners[i], corners[j]).filter(|[p, q]| p.distance(*q) > least)
            {
                found.push(([i as u32, j as u32], [p, q]));
            }
        }
    }
    found
}

fn agrees_with_brute_force(solid: &Solid, nearness: f64) -> Result<usize, String> {
    let (curves, expected) = (find(solid), brute_force(solid));
    let found: Vec<[u32; 2]> = curves.segments.iter().map(|s| s.faces).collect();
    let wanted: Vec<[u32; 2]> = expected.iter().map(|(faces, _)| *faces).collect();
    if found != wanted {
        let missing: Vec<_> = wanted.iter().filter(|f| !found.contains(f)).collect();
        let extra: Vec<_> = found.iter().filter(|f| !wanted.contains(f)).collect();
        return Err(format!("missing {missing:?}, too many {extra:?}"));
    }
    for (segment, (faces, [p, q])) in curves.segments.iter().zip(&expected) {
        let [a, b] = segment.ends.map(|end| curves.points[end as usize]);
        let error = (a.distance(*p).max(b.distance(*q))).min(a.distance(*q).max(b.distance(*p)));
        if error > nearness {
            return Err(format!("{faces:?}: {a} – {b} instead of {p} – {q}"));
        }
    }
    Ok(found.len())
}

/// Random triangles that share no vertices.
fn soup(dice: &mut Dice, most: usize, mut corner: impl FnMut(&mut Dice) -> DVec3) -> Solid {
    let count = 2 + dice.below(most - 2);
    Solid {
        positions: (0..3 * count).map(|_| corner(dice)).collect(),
        triangles: (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
    }
}

/// A random mesh with shared vertices.
fn random_shared_mesh(dice: &mut Dice) -> Solid {
    let count = 4 + dice.below(76);
    let mut triangles: Vec<[u32; 3]> = (0..count).map(|_| [0; 3].map(|_| dice.below(30) as u32)).collect();
    triangles.retain(|[a, b, c]| a != b && b != c && c != a);
    Solid { positions: (0..30).map(|_| dice.point(1.0)).collect(), triangles }
}

/// Checks 200 random solids.
fn check_random_solids(
    mut solid: impl FnMut(&mut Dice) -> Solid,
    check: impl Fn(&Solid) -> Result<(), String>,
) {
    for seed in 0..200 {
        let solid = solid(&mut Dice::new(seed));
        check(&solid).unwrap_or_else(|error| panic!("seed {seed}: {error}\n{solid:?}"));
    }
}

fn check_against_brute_force(solid: &Solid) -> Result<(), String> {
    agrees_with_brute_force(solid, 1e-7).map(|_| ())
}

#[test]
fn soups_agree_with_brute_force() {
    check_random_solids(|dice| soup(dice, 60, |dice| dice.point(1.0)), check_against_brute_force);
}

#[test]
fn soups_with_many_contacts_agree_with_brute_force() {
    let corner = |dice: &mut Dice| DVec3::from([0; 3].map(|_| dice.below(4) as f64));
    check_random_solids(|dice| soup(dice, 40, corner), check_against_brute_force);
}

#[test]
fn random_meshes_with_shared_vertices_agree_with_brute_force() {
    check_random_solids(random_shared_mesh, check_against_brute_force);
}

#[test]
fn order_of_faces_changes_no_curve() {
    let check = |solid: &Solid| {
        let mut reversed = solid.clone();
        reversed.triangles.reverse();
        let (one, other) = (find(solid), find(&reversed));
        let same = (one.segments.len(), one.points.len()) == (other.segments.len(), other.points.len());
        let apart = (length(&one) - length(&other)).abs();
        if same && apart < 1e-9 { Ok(()) } else { Err(format!("{apart} apart")) }
    };
    check_random_solids(|dice| soup(dice, 40, |dice| dice.point(1.0)), check);
}

#[test]
fn shared_models_agree_with_brute_force() {
    for name in ["organic/suzanne.obj", "organic/cow.obj", "organic/teapot.obj", "edge/self-intersecting.obj"]
    {
        let Some(solid) = mesh_file::read_shared_model(name) else { continue };
        let nearness = 1e-6 * solid.positions.iter().fold(0.0_f64, |most, p| most.max(p.length()));
        let count =
            agrees_with_brute_force(&solid, nearness).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(count > 0, "{name} has surfaces that pass through each other");
    }
}
