//! Visibility of each view edge, compared with a ray through every triangle to its midpoint.

use crate::library::support::measures::segment_sets::{
    check_equal_cover, distance, total_length, uncovered_length,
};
use crate::library::support::pipeline::{Stages, exact_options, exact_options_with_hidden, run_stages};
use crate::library::support::references::textbook_camera::TextbookCamera;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::random_scenes::{
    ALL_CAMERA_KINDS, ALL_SCENE_KINDS, random_camera, random_scene,
};
use glam::DVec3;
use ligne::lines::{HiddenLines, LineOptions};
use ligne::mesh::{FaceId, Mesh};
use ligne::scene::{Camera, Scene};
use ligne::view::Frame;
use ligne::visibility::tolerances;

/// The result of one ray to one point.
enum RayResult {
    /// The number of surfaces in front.
    Count(u16),
    /// The ray grazes a border or a depth is at the contact tolerance, so rounding decides.
    Ambiguous,
}

/// Returns the depth difference within which a point touches a face.
fn contact(mesh: &Mesh, face: u32, frame: &Frame, depth: f64) -> f64 {
    mesh.extent(FaceId(face)).contact.max(tolerances::CONTACT_PX * frame.px_at(depth))
}

/// Shoots a ray from the camera to a point of a feature segment.
fn shoot_ray(
    stages: &Stages,
    camera: &Camera,
    eye: &TextbookCamera,
    segment: usize,
    point: DVec3,
) -> RayResult {
    let source = &stages.lines.segments[segment];
    let mesh = &stages.mesh;
    let depth = eye.depth(point);
    // The ray runs from depth 0 to the point at parameter 1. In an orthographic view, hits behind the camera
    // count.
    let from = if eye.perspective { eye.position } else { point - eye.forward * depth };
    let way = point - from;
    let focus = camera.eye.distance(camera.target);
    let near =
        camera.near.or(eye.perspective.then_some(focus * ligne::view::tolerances::CLIP_PLANE_OF_TARGET));
    let near = near.unwrap_or(f64::NEG_INFINITY);
    let frame = Frame::new(camera, DVec3::ZERO);
    let mut count = 0;
    for (face, ids) in mesh.triangles.iter().enumerate() {
        let shares = source.ends.map(|end| ids.contains(&end));
        if source.hosts.contains(&(face as u32))
            || shares == [true; 2]
            || mesh.is_degenerate(FaceId::from(face))
        {
            continue;
        }
        // Möller and Trumbore, "Fast, minimum storage ray-triangle intersection", 1997.
        let [a, b, c] = ids.map(|v| mesh.positions[v as usize]);
        let (e1, e2) = (b - a, c - a);
        let p = way.cross(e2);
        let determinant = e1.dot(p);
        let steep = determinant.abs() / (e1.cross(e2).length() * way.length());
        let s = from - a;
        let u = s.dot(p) / determinant;
        let q = s.cross(e1);
        let v = way.dot(q) / determinant;
        let inside = u.min(v).min(1.0 - u - v);
        let slack = 1e-8 / steep.max(1e-12);
        if inside < -slack {
            continue;
        }
        let hit = e2.dot(q) / determinant * depth;
        let lead = depth - hit;
        let touch = if shares[0] || shares[1] {
            let of_part = tolerances::NEIGHBOUR_OF_PART * mesh.extent(FaceId::from(face)).scale;
            of_part.max(tolerances::NEIGHBOUR_PX * frame.px_at(depth))
        } else {
            contact(mesh, face as u32, &frame, depth)
        };
        if lead < 0.9 * touch || hit < near - 1e-9 {
            continue;
        }
        if inside < slack || lead < 1.1 * touch || hit < near + 1e-9 {
            return RayResult::Ambiguous;
        }
        count += 1;
    }
    RayResult::Count(count)
}

#[derive(Default, Debug)]
struct Tally {
    compared: usize,
    hidden: usize,
    ambiguous: usize,
    crumbs: usize,
}

/// Shorter view edges are artefacts of the contact tolerances where lines pierce surfaces, px. A ray to their
/// middle is itself at the tolerance.
const MIN_EDGE_LENGTH_PX: f64 = 5e-3;

/// Returns the point of the line p–q that is nearest to a line of sight, and its parameter.
fn point_seen_at(eye: &TextbookCamera, image: kurbo::Point, p: DVec3, q: DVec3) -> (DVec3, f64) {
    let (from, to) = (eye.unproject(image, 0.0), eye.unproject(image, 1.0));
    let (ray, way) = (to - from, q - p);
    let across = ray.cross(way);
    let t = (p - from).cross(ray).dot(across) / across.length_squared();
    (p + way * t, t)
}

/// Compares every view edge of a drawing with a ray to its midpoint.
fn agrees_with_rays(scene: &Scene, camera: &Camera, tally: &mut Tally) -> Result<(), String> {
    let stages = run_stages(scene, camera, &exact_options_with_hidden());
    let local = Camera {
        eye: camera.eye - stages.mesh.origin,
        target: camera.target - stages.mesh.origin,
        ..*camera
    };
    let eye = TextbookCamera::new(&local);
    for edge in &stages.map.edges {
        let [a, b] = stages.edge_ends(edge);
        // The view edge must lie on its feature segment, where the ray ends.
        let ends = stages.lines.segments[edge.segment as usize].ends;
        let [p, q] = ends.map(|end| stages.lines.position(&stages.mesh, end));
        let (point, t) = point_seen_at(&eye, a.midpoint(b), p, q);
        let deep = eye.depth(point);
        let frame = Frame::new(&local, DVec3::ZERO);
        let of_face = |face| contact(&stages.mesh, face, &frame, deep);
        let contact = (0..stages.mesh.triangles.len() as u32).map(of_face).fold(0.0, f64::max);
        let contact_px = eye.scale * contact / if eye.perspective { deep } else { 1.0 };
        if distance(a, b) < MIN_EDGE_LENGTH_PX.max(10.0 * contact_px) {
            tally.crumbs += 1;
            continue;
        }
        let off = distance(eye.project(point), a.midpoint(b));
        if off > 1e-6 || !(-1e-9..=1.0 + 1e-9).contains(&t) {
            return Err(format!("{edge:?} lies {off} px beside its feature line, at {t}"));
        }
        match shoot_ray(&stages, &local, &eye, edge.segment as usize, point) {
            RayResult::Ambiguous => tally.ambiguous += 1,
            RayResult::Count(count) => {
                tally.compared += 1;
                tally.hidden += usize::from(count > 0);
                if count != edge.invisibility {
                    return Err(format!("{count} surfaces hide {edge:?} from {a} to {b}, at {point}"));
                }
            }
        }
    }
    Ok(())
}

fn check_all_cameras(kind: &str, seeds: std::ops::Range<u64>) {
    let mut tally = Tally::default();
    for seed in seeds {
        for camera_kind in ALL_CAMERA_KINDS {
            let mut dice = Dice::new(seed);
            let scene = random_scene(kind, &mut dice);
            let camera = random_camera(camera_kind, &mut dice);
            if let Err(message) = agrees_with_rays(&scene, &camera, &mut tally) {
                panic!("{kind}, {camera_kind}, seed {seed}: {message}");
            }
        }
    }
    println!("{kind}: {tally:?}");
    assert!(tally.compared > 1000 && tally.hidden > 200, "{tally:?}");
    assert!(tally.crumbs * 5 <= tally.compared, "{tally:?}");
    assert!(tally.ambiguous * 1000 <= tally.compared, "{tally:?}");
}

#[test]
fn boxes_agree_with_rays() {
    check_all_cameras("boxes", 0..8);
}

#[test]
fn tetrahedra_agree_with_rays() {
    check_all_cameras("tetrahedra", 0..8);
}

#[test]
fn spheres_agree_with_rays() {
    check_all_cameras("spheres", 0..4);
}

#[test]
fn tori_agree_with_rays() {
    check_all_cameras("tori", 0..4);
}

#[test]
fn soups_agree_with_rays() {
    check_all_cameras("soup", 0..5);
}

#[test]
fn interpenetrating_boxes_agree_with_rays() {
    check_all_cameras("interpenetrating", 0..8);
}

#[test]
fn mixtures_agree_with_rays() {
    check_all_cameras("mixture", 0..4);
}

#[test]
fn visible_and_hidden_lengths_add_up_to_the_projected_length() {
    for kind in ALL_SCENE_KINDS {
        for camera_kind in ALL_CAMERA_KINDS {
            let mut dice = Dice::new(77);
            let (scene, camera) = (random_scene(kind, &mut dice), random_camera(camera_kind, &mut dice));
            let stages = run_stages(&scene, &camera, &exact_options_with_hidden());
            let origin = stages.mesh.origin;
            let eye = TextbookCamera::new(&camera);
            // Without a near plane on the camera, the view sets one very close to it.
            let near = camera.near.or(stages.view.frame.near);
            let all = [stages.visible_segments(), stages.hidden_segments()].concat();
            let mut drawn = vec![0.0; stages.lines.segments.len()];
            for edge in &stages.map.edges {
                let [a, b] = stages.edge_ends(edge);
                drawn[edge.segment as usize] += distance(a, b);
            }
            for (segment, drawn) in stages.lines.segments.iter().zip(drawn) {
                let [p, q] = segment.ends.map(|end| stages.lines.position(&stages.mesh, end) + origin);
                let whole = eye
                    .clip_segment(p, q, near)
                    .map_or(0.0, |[p, q]| distance(eye.project(p), eye.project(q)));
                assert!(drawn <= whole + 1e-6, "{kind}, {camera_kind}: {drawn} of {whole}, {segment:?}");
                // If two lines run within `DUPLICATE_LINE_PX` of each other, only one is drawn.
                if whole - drawn > 1e-6 * whole.max(1.0) {
                    let image = eye.clip_segment(p, q, near).map(|s| s.map(|p| eye.project(p)));
                    let lost = uncovered_length(image.as_slice(), &all, 1.01 * tolerances::DUPLICATE_LINE_PX);
                    assert!(
                        lost < 4.0 * tolerances::DUPLICATE_LINE_PX,
                        "{kind}, {camera_kind}: {drawn} of {whole}, {lost} lost, {segment:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn counting_invisibility_does_not_change_visible_lines() {
    let mut seen = 0.0;
    for kind in ALL_SCENE_KINDS {
        for camera_kind in ALL_CAMERA_KINDS {
            let mut dice = Dice::new(5);
            let (scene, camera) = (random_scene(kind, &mut dice), random_camera(camera_kind, &mut dice));
            let with = run_stages(&scene, &camera, &exact_options_with_hidden());
            let none = LineOptions { hidden: HiddenLines::None, ..exact_options() };
            let without = run_stages(&scene, &camera, &none);
            let (with, without) = (with.visible_segments(), without.visible_segments());
            seen += total_length(&with);
            if let Err(message) = check_equal_cover(&with, &without, 1e-6, 0.02) {
                panic!("{kind}, {camera_kind}: {message}");
            }
        }
    }
    assert!(seen > 10_000.0, "only {seen} px to see");
}
