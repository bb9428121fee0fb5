//! Reference for cast shadows: one ray from each point through every triangle.

use glam::DVec3;
use ligne::light::Caster;
use ligne::mesh::{FaceId, Mesh};
use ligne::shadows::Shadows;

use crate::library::support::scenes::random_dice::Dice;

/// The direction from a point towards a light, not normalised.
fn light_direction(caster: &Caster, point: DVec3) -> DVec3 {
    match *caster {
        Caster::Directional { towards } => towards,
        Caster::Point { position } => position - point,
    }
}

/// The centroid of a face.
pub(crate) fn face_centroid(mesh: &Mesh, face: u32) -> DVec3 {
    let [a, b, c] = mesh.corners(FaceId(face));
    (a + b + c) / 3.0
}

/// Whether a triangle other than `face` blocks the ray from a point of `face` to a light.
fn is_blocked(mesh: &Mesh, caster: &Caster, face: u32, p: DVec3) -> bool {
    let (along, most) = match caster {
        Caster::Directional { towards } => (*towards, f64::INFINITY),
        Caster::Point { position } => (*position - p, 1.0),
    };
    let least = 2e-6 * mesh.extents.diagonal / along.length();
    (0..mesh.triangles.len() as u32).filter(|f| *f != face).any(|f| {
        let [a, b, c] = mesh.corners(FaceId(f));
        let (u, v) = (b - a, c - a);
        let h = along.cross(v);
        let det = u.dot(h);
        if det.abs() < 1e-14 {
            return false;
        }
        let s = (p - a).dot(h) / det;
        let q = (p - a).cross(u);
        let r = along.dot(q) / det;
        let t = v.dot(q) / det;
        s >= 0.0 && r >= 0.0 && s + r <= 1.0 && t > least && t < most
    })
}

/// Whether a point is in shadow; `None` if rays from four points at the distance `reach` disagree.
fn stable_shadow_state(mesh: &Mesh, caster: &Caster, face: u32, p: DVec3, reach: f64) -> Option<bool> {
    let answer = is_blocked(mesh, caster, face, p);
    let [a, b, c] = mesh.corners(FaceId(face));
    let along = (b - a).normalize() * reach;
    let across = (b - a).cross(c - a).normalize().cross(along);
    let around = [along, -along, across, -across];
    around.iter().all(|d| is_blocked(mesh, caster, face, p + *d) == answer).then_some(answer)
}

/// Whether a point lies on a face, with the tolerance `slack` at its sides.
fn is_on_face(mesh: &Mesh, face: u32, p: DVec3, slack: f64) -> bool {
    let [a, b, c] = mesh.corners(FaceId(face));
    let normal = (b - a).cross(c - a).normalize();
    [(a, b), (b, c), (c, a)].iter().all(|(a, b)| normal.cross(*b - *a).normalize().dot(p - *a) >= -slack)
        && (p - a).dot(normal).abs() <= 5e-7 * mesh.extents.diagonal
}

/// Two directional and two point lights, three of them random.
pub(crate) fn test_lights(mesh: &Mesh, dice: &mut Dice) -> Vec<Caster> {
    let mut sun = dice.direction();
    sun.z = sun.z.abs() + 0.3;
    vec![
        Caster::Directional { towards: sun },
        Caster::Point { position: mesh.extents.middle + dice.direction() * mesh.extents.diagonal },
        Caster::Point { position: mesh.extents.middle + dice.point(0.2) * mesh.extents.diagonal },
        Caster::Directional { towards: DVec3::Z },
    ]
}

/// A random point on a face.
fn random_face_point(mesh: &Mesh, face: u32, dice: &mut Dice) -> DVec3 {
    let [a, b, c] = mesh.corners(FaceId(face));
    let (u, v) = (dice.between(0.0, 1.0), dice.between(0.0, 1.0));
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    a + (b - a) * u + (c - a) * v
}

/// For each part 1 if its normals point outward, and -1 if it is inside out.
fn outward_signs(mesh: &Mesh) -> Vec<f64> {
    let parts = mesh.face_part.iter().map(|p| p.index() + 1).max().unwrap_or(0);
    let mut volumes = vec![0.0; parts];
    for (face, part) in mesh.face_part.iter().enumerate() {
        let [a, b, c] = mesh.corners(FaceId(face as u32));
        volumes[part.index()] += a.dot(b.cross(c));
    }
    volumes.into_iter().map(f64::signum).collect()
}

/// Checks the shadow masks of random surface points against rays.
pub(crate) fn check_points(mesh: &Mesh, shadows: &Shadows, count: usize, dice: &mut Dice) {
    let outward = outward_signs(mesh);
    let asked: Vec<(u32, DVec3)> = (0..count)
        .map(|_| {
            let face = dice.below(mesh.triangles.len()) as u32;
            (face, random_face_point(mesh, face, dice))
        })
        .collect();
    let masks = shadows.shadowed(mesh, &asked);
    let mut sure = 0;
    for ((face, p), mask) in asked.iter().zip(masks) {
        let [a, b, c] = mesh.corners(FaceId(*face));
        for (k, caster) in shadows.casters().iter().enumerate() {
            let Some(blocked) = stable_shadow_state(mesh, caster, *face, *p, 1e-5 * mesh.extents.diagonal)
            else {
                continue;
            };
            // The library does not test faces that are averted from the light.
            let outward = outward[mesh.face_part[*face as usize].index()];
            let attached = (b - a).cross(c - a).dot(light_direction(caster, *p)) * outward <= 0.0;
            let dark = mask >> k & 1 == 1;
            if attached && !dark {
                continue;
            }
            sure += 1;
            assert_eq!(dark, blocked, "light {k}, face {face} at {p}");
        }
    }
    assert!(sure * 3 > count * shadows.casters().len(), "{sure} of {count}");
}

/// Checks that shadow lines lie on their faces and separate light from shadow; returns the number checked.
pub(crate) fn check_lines(mesh: &Mesh, shadows: &Shadows) -> usize {
    let mut checked = 0;
    for segment in &shadows.lines.segments {
        let caster = &shadows.casters()[segment.caster as usize];
        let [p, q] = segment.ends.map(|end| shadows.lines.points[end as usize]);
        let [a, b, c] = mesh.corners(FaceId(segment.face));
        let normal = (b - a).cross(c - a).normalize();
        // At grazing light, a small distance in the light's view is a larger one on the face.
        let fall = normal.dot(light_direction(caster, p).normalize()).abs().max(1e-6);
        let slack = 1e-6 * mesh.extents.diagonal / fall;
        assert!([p, q].iter().all(|p| is_on_face(mesh, segment.face, *p, slack)), "{segment:?} {p} {q}");
        let Some(across) = normal.cross(q - p).try_normalize() else { continue };
        if p.distance(q) < 1e-3 * mesh.extents.diagonal {
            continue;
        }
        // In a narrow strip of shadow, both its borders may lie between the two sample points.
        let parts = |reach: f64| {
            let sides = [1.0, -1.0].map(|side| (p + q) / 2.0 + across * (side * reach));
            if !sides.iter().all(|side| is_on_face(mesh, segment.face, *side, 0.0)) {
                return None;
            }
            let [one, other] =
                sides.map(|side| stable_shadow_state(mesh, caster, segment.face, side, 0.3 * reach));
            Some(one? != other?)
        };
        let found = [1e-4, 1e-5, 2e-6].map(|reach| parts(reach * mesh.extents.diagonal / fall.max(0.1)));
        if found.iter().any(Option::is_some) {
            // The other border of an even narrower strip is close by.
            let beside = || {
                let others =
                    shadows.lines.segments.iter().filter(|s| *s != segment && s.face == segment.face);
                others.filter(|s| s.caster == segment.caster).any(|s| {
                    let [p1, q1] = s.ends.map(|end| shadows.lines.points[end as usize]);
                    let m = (p + q) / 2.0;
                    let along = q1 - p1;
                    let t = ((m - p1).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                    m.distance(p1 + along * t) < 1e-5 * mesh.extents.diagonal / fall
                })
            };
            assert!(
                found.contains(&Some(true)) || beside(),
                "{segment:?} from {p} to {q} parts nothing: {found:?}"
            );
            checked += 1;
        }
    }
    checked
}

/// Checks random segments on a face: their ends differ in shadow if the number of crossed shadow lines is
/// odd.
pub(crate) fn check_crossings(mesh: &Mesh, shadows: &Shadows, count: usize, dice: &mut Dice) {
    let mut crossed = 0;
    for _ in 0..count {
        let face = dice.below(mesh.triangles.len()) as u32;
        let (p, q) = (random_face_point(mesh, face, dice), random_face_point(mesh, face, dice));
        let [a, b, c] = mesh.corners(FaceId(face));
        let normal = (b - a).cross(c - a).normalize();
        for (k, caster) in shadows.casters().iter().enumerate() {
            let sides =
                [p, q].map(|p| stable_shadow_state(mesh, caster, face, p, 1e-5 * mesh.extents.diagonal));
            let [Some(one), Some(other)] = sides else { continue };
            let side = |a: DVec3, b: DVec3, p: DVec3| (b - a).cross(p - a).dot(normal) > 0.0;
            let crossings = shadows
                .lines
                .segments
                .iter()
                .filter(|s| s.face == face && s.caster == k as u32)
                .filter(|s| {
                    let [a, b] = s.ends.map(|end| shadows.lines.points[end as usize]);
                    side(p, q, a) != side(p, q, b) && side(a, b, p) != side(a, b, q)
                })
                .count();
            // Faces of a solid that are averted from the light have no shadow lines.
            assert_eq!(one != other, crossings % 2 == 1, "light {k} on face {face} from {p} to {q}");
            crossed += crossings;
        }
    }
    assert!(crossed > 0);
}
