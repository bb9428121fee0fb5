//! Cast shadows, tested against closed forms and rays through every triangle.

use crate::library::support::pipeline;
use crate::library::support::pipeline::scene;
use crate::library::support::references::shadow_rays::{
    check_crossings, check_lines, check_points, face_centroid, test_lights,
};
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::random_scenes;
use crate::library::support::scenes::round_solids;
use crate::library::support::scenes::solids::{Solid, cuboid, torus};
use glam::DVec3;
use ligne::light::Caster;
use ligne::lines::{FeatureLines, LineKind, NO_FACE};
use ligne::mesh::Mesh;
use ligne::scene::Scene;
use ligne::shadows::Shadows;

fn mesh(solids: impl IntoIterator<Item = Solid>) -> Mesh {
    Mesh::build(scene(solids).to_soup())
}

/// A horizontal rectangle of two triangles at height `z`.
fn sheet(low: [f64; 2], high: [f64; 2], z: f64) -> Solid {
    let corner = |x: f64, y: f64| DVec3::new(x, y, z);
    Solid {
        positions: vec![
            corner(low[0], low[1]),
            corner(high[0], low[1]),
            corner(high[0], high[1]),
            corner(low[0], high[1]),
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}

/// Returns the shadow lines on the faces of one part: the number of closed loops, their length, and their
/// points in world coordinates. Panics if a point does not join two segments.
fn shadow_loops(mesh: &Mesh, shadows: &Shadows, part: usize) -> (usize, f64, Vec<DVec3>) {
    let lines = &shadows.lines;
    let on_part = |face: u32| mesh.face_part[face as usize].index() == part;
    let chosen: Vec<[u32; 2]> = lines.segments.iter().filter(|s| on_part(s.face)).map(|s| s.ends).collect();
    let mut touching = vec![Vec::new(); lines.points.len()];
    let mut length = 0.0;
    for &[a, b] in &chosen {
        touching[a as usize].push(b);
        touching[b as usize].push(a);
        length += lines.points[a as usize].distance(lines.points[b as usize]);
    }
    let mut count = 0;
    let mut seen = vec![false; touching.len()];
    let mut points = Vec::new();
    for start in 0..touching.len() {
        if touching[start].is_empty() {
            continue;
        }
        assert_eq!(touching[start].len(), 2, "point at {:?}", lines.points[start] + mesh.origin);
        points.push(lines.points[start] + mesh.origin);
        let mut stack = vec![start];
        count += usize::from(!seen[start]);
        while let Some(point) = stack.pop() {
            if !std::mem::replace(&mut seen[point], true) {
                stack.extend(touching[point].iter().map(|p| *p as usize));
            }
        }
    }
    (count, length, points)
}

fn assert_has_corners(points: &[DVec3], corners: &[DVec3]) {
    for corner in corners {
        let nearest = points.iter().map(|p| p.distance(*corner)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "{corner}: {nearest}");
    }
}

fn perimeter(corners: &[DVec3]) -> f64 {
    (0..corners.len()).map(|k| corners[k].distance(corners[(k + 1) % corners.len()])).sum()
}

#[test]
fn the_shadow_of_a_box_is_the_projected_hexagon() {
    for towards in [DVec3::new(1.0, 0.7, 2.0), DVec3::new(-0.3, 0.2, 0.5)] {
        let mesh = mesh([
            sheet([-10.0, -9.0], [9.5, 10.0], 0.0),
            cuboid(DVec3::new(-1.0, -1.0, 0.5), DVec3::new(1.0, 1.0, 2.0)),
        ]);
        let shadows = Shadows::new(&mesh, &[Caster::Directional { towards }]);
        let (count, length, points) = shadow_loops(&mesh, &shadows, 0);
        let fall = |p: DVec3| p - towards * (p.z / towards.z);
        // The contour has all corners except the ones nearest to the light and farthest from it.
        let s = DVec3::new(towards.x.signum(), towards.y.signum(), 0.0);
        let (low, high) = (0.5, 2.0);
        let corner = |x: f64, y: f64, z: f64| fall(DVec3::new(x * s.x, y * s.y, z));
        let hexagon = [
            corner(1.0, -1.0, low),
            corner(1.0, 1.0, low),
            corner(-1.0, 1.0, low),
            corner(-1.0, 1.0, high),
            corner(-1.0, -1.0, high),
            corner(1.0, -1.0, high),
        ];
        assert_eq!(count, 1);
        assert_has_corners(&points, &hexagon);
        assert!((length - perimeter(&hexagon)).abs() < 1e-6, "{length}");
        assert!(points.iter().all(|p| p.z.abs() < 1e-9));
        assert!(shadows.lines.segments.iter().all(|s| s.caster == 0));
    }
}

#[test]
fn a_box_on_the_ground_casts_no_line_along_its_foot() {
    let towards = DVec3::new(1.0, 0.5, 1.0);
    let mesh =
        mesh([sheet([-10.0, -10.0], [10.0, 10.0], 0.0), cuboid(DVec3::ZERO, DVec3::new(1.0, 1.0, 2.0))]);
    let shadows = Shadows::new(&mesh, &[Caster::Directional { towards }]);
    let fall = |p: DVec3| p - towards * (p.z / towards.z);
    // From the foot of one vertical edge around the top to the foot of the other.
    let path = [
        DVec3::new(1.0, 0.0, 0.0),
        fall(DVec3::new(1.0, 0.0, 2.0)),
        fall(DVec3::new(0.0, 0.0, 2.0)),
        fall(DVec3::new(0.0, 1.0, 2.0)),
        DVec3::new(0.0, 1.0, 0.0),
    ];
    let length: f64 = path.windows(2).map(|w| w[0].distance(w[1])).sum();
    let lines = &shadows.lines;
    let points: Vec<DVec3> = lines.points.iter().map(|p| *p + mesh.origin).collect();
    assert_has_corners(&points[..], &path[1..4]);
    for foot in [path[0], path[4]] {
        assert!(points.iter().any(|p| p.distance(foot) < 1e-6), "{foot}");
    }
    let found: f64 = lines
        .segments
        .iter()
        .map(|s| {
            let [a, b] = s.ends.map(|end| points[end as usize]);
            a.distance(b)
        })
        .sum();
    assert!((found - length).abs() < 1e-4, "{found} {length}");
}

#[test]
fn a_point_light_enlarges_shadows() {
    for height in [2.0, 30.0] {
        let light = DVec3::new(0.3, 0.2, height);
        let mesh = mesh([sheet([-12.0, -12.0], [12.0, 12.0], 0.0), sheet([-1.0, -0.5], [1.0, 0.5], 1.0)]);
        let shadows = Shadows::new(&mesh, &[Caster::Point { position: light - mesh.origin }]);
        let (count, length, points) = shadow_loops(&mesh, &shadows, 0);
        let enlarged = |x: f64, y: f64| {
            let p = DVec3::new(x, y, 1.0);
            light + (p - light) * (height / (height - 1.0))
        };
        let corners = [enlarged(-1.0, -0.5), enlarged(1.0, -0.5), enlarged(1.0, 0.5), enlarged(-1.0, 0.5)];
        assert_eq!(count, 1);
        assert_has_corners(&points, &corners);
        assert!((length - perimeter(&corners)).abs() < 1e-6, "{length}");
    }
}

#[test]
fn the_shadow_of_a_ring_has_a_hole() {
    let ring = torus(24, 8, 1.0, 0.2).moved(|p| p + DVec3::Z * 2.0);
    let mesh = mesh([sheet([-10.0, -10.0], [10.0, 10.0], 0.0), ring]);
    let towards = DVec3::new(0.4, 0.1, 1.0);
    let shadows = Shadows::new(&mesh, &[Caster::Directional { towards }]);
    let (count, _, _) = shadow_loops(&mesh, &shadows, 0);
    assert_eq!(count, 2);
    let ground = |x: f64, y: f64| DVec3::new(x, y, 0.0) - mesh.origin;
    let middle = DVec3::new(-0.8, -0.2, 0.0);
    let face = |p: DVec3| u32::from(p.y > p.x);
    let asked: Vec<(u32, DVec3)> =
        [0.0, 1.0, 1.5].iter().map(|r| middle + DVec3::X * *r).map(|p| (face(p), ground(p.x, p.y))).collect();
    assert_eq!(shadows.shadowed(&mesh, &asked), [0, 1, 0]);
}

#[test]
fn convex_solids_and_sheets_cast_no_shadow_on_themselves() {
    let lights = [
        Caster::Directional { towards: DVec3::new(0.3, -0.4, 0.8) },
        Caster::Directional { towards: DVec3::Z },
        Caster::Point { position: DVec3::new(4.0, 1.0, 3.0) },
        Caster::Point { position: DVec3::new(0.01, 0.02, 1.1) },
    ];
    for solid in [
        cuboid(DVec3::splat(-0.5), DVec3::splat(0.5)),
        round_solids::icosphere(2),
        sheet([-1.0, -1.0], [1.0, 1.0], 0.0),
        Solid::default(),
    ] {
        let mesh = mesh([solid]);
        let shadows = Shadows::new(&mesh, &lights);
        assert!(shadows.lines.segments.is_empty(), "{:?}", shadows.lines.segments);
        let middles: Vec<(u32, DVec3)> =
            (0..mesh.triangles.len() as u32).map(|f| (f, face_centroid(&mesh, f))).collect();
        assert!(shadows.shadowed(&mesh, &middles).iter().all(|mask| *mask == 0));
    }
}

#[test]
fn sheets_are_shadowed_on_both_sides_and_averted_solid_faces_are_not() {
    let mesh = mesh([
        cuboid(DVec3::new(-1.0, -1.0, 1.0), DVec3::new(1.0, 1.0, 2.0)),
        sheet([-1.0, -1.0], [1.0, 1.0], 0.0),
        sheet([-1.0, -1.0], [1.0, 1.0], -1.0).moved(|p| DVec3::new(-p.x, p.y, p.z)),
    ]);
    let shadows = Shadows::new(&mesh, &[Caster::Directional { towards: DVec3::Z }]);
    let asked: Vec<(u32, DVec3)> =
        (0..mesh.triangles.len() as u32).map(|f| (f, face_centroid(&mesh, f))).collect();
    for ((face, p), mask) in asked.iter().zip(shadows.shadowed(&mesh, &asked)) {
        // Both sheets lie in the shadow of the box, for either winding.
        assert_eq!(mask, u32::from((p + mesh.origin).z < 0.5), "{face}");
    }
}

#[test]
fn adjacent_sheets_cast_one_shadow_without_a_seam() {
    // Two sheets that touch along x = 0 without a common vertex, above a ground.
    let mesh = mesh([
        sheet([-10.0, -10.0], [10.0, 10.0], 0.0),
        sheet([-1.0, -1.0], [0.0, 1.0], 2.0),
        sheet([0.0, -1.5], [1.0, 1.5], 2.0),
    ]);
    let shadows = Shadows::new(&mesh, &[Caster::Directional { towards: DVec3::new(0.1, 0.2, 1.0) }]);
    let (count, length, _) = shadow_loops(&mesh, &shadows, 0);
    assert_eq!(count, 1);
    assert!((length - 10.0).abs() < 1e-5, "{length}");
}

#[test]
fn lines_are_appended_as_tone_borders_on_their_faces() {
    let mesh = mesh([sheet([-9.0, -9.0], [9.0, 9.0], 0.0), sheet([-1.0, -1.0], [1.0, 1.0], 1.0)]);
    let shadows = Shadows::new(&mesh, &[Caster::Directional { towards: DVec3::Z }]);
    let mut lines = FeatureLines { points: vec![DVec3::ONE], ..FeatureLines::default() };
    shadows.lines.append_to(&mesh, &mut lines);
    assert_eq!(lines.segments.len(), shadows.lines.segments.len());
    assert!(!lines.segments.is_empty());
    for (segment, of) in lines.segments.iter().zip(&shadows.lines.segments) {
        assert_eq!((segment.kind, segment.hosts), (LineKind::Isophote, [of.face, NO_FACE]));
        for (end, own) in segment.ends.iter().zip(of.ends) {
            assert_eq!(lines.position(&mesh, *end), shadows.lines.points[own as usize]);
        }
    }
}

#[test]
fn points_and_lines_agree_with_rays_in_random_scenes() {
    let mut dice = Dice::new(4);
    for kind in ["boxes", "tetrahedra", "interpenetrating", "spheres", "tori", "mixture", "soup"] {
        for _ in 0..3 {
            let mut scene = random_scenes::random_scene(kind, &mut dice);
            let ground = pipeline::scene([sheet([-3.0, -3.0], [3.0, 3.0], -1.6)]);
            scene.geometries.extend(ground.geometries);
            let mut part = ground.parts[0].clone();
            part.geometry = scene.geometries.len() - 1;
            scene.parts.push(part);
            let mesh = Mesh::build(scene.to_soup());
            let shadows = Shadows::new(&mesh, &test_lights(&mesh, &mut dice));
            check_points(&mesh, &shadows, 300, &mut dice);
            let checked = check_lines(&mesh, &shadows);
            println!("{kind}: {checked} of {} lines checked", shadows.lines.segments.len());
            assert!(checked > 3);
        }
    }
}

#[test]
fn shadow_borders_between_separate_boxes_are_complete() {
    let mut dice = Dice::new(12);
    for _ in 0..6 {
        let mut solids = vec![sheet([-4.0, -4.0], [4.0, 4.0], -1.6)];
        for x in [-1.0, 0.0, 1.0] {
            for z in [-1.0, 0.0, 1.0] {
                let turn = dice.turn();
                let half =
                    DVec3::new(dice.between(0.1, 0.25), dice.between(0.1, 0.25), dice.between(0.1, 0.25));
                let place = DVec3::new(x, dice.between(-1.0, 1.0), z);
                solids.push(cuboid(-half, half).moved(|p| turn * p + place));
            }
        }
        let mesh = mesh(solids);
        let mut casters = test_lights(&mesh, &mut dice);
        // Between the boxes, but inside none of them.
        casters[2] = Caster::Point { position: DVec3::new(0.5, dice.between(-1.0, 1.0), 0.5) - mesh.origin };
        let shadows = Shadows::new(&mesh, &casters);
        check_points(&mesh, &shadows, 400, &mut dice);
        check_crossings(&mesh, &shadows, 400, &mut dice);
        assert!(check_lines(&mesh, &shadows) > 10);
    }
}

#[test]
fn cast_shadows_do_not_depend_on_scale_place_or_thread_count() {
    let at = |scale: f64, place: DVec3| {
        let put = |solid: Solid| solid.moved(|p| p * scale + place);
        let mesh = mesh([
            put(sheet([-5.0, -5.0], [5.0, 5.0], 0.0)),
            put(torus(16, 8, 1.0, 0.3).moved(|p| DVec3::new(p.x, p.z, p.y + 2.0))),
            put(cuboid(DVec3::new(1.0, 1.0, 0.5), DVec3::new(2.0, 2.0, 1.0))),
        ]);
        let casters = [
            Caster::Directional { towards: DVec3::new(0.5, 0.3, 1.0) },
            Caster::Point { position: DVec3::new(0.1, -0.3, 4.0) * scale + (place - mesh.origin) },
        ];
        (Shadows::new(&mesh, &casters), mesh)
    };
    let (shadows, mesh) = at(1.0, DVec3::ZERO);
    let length = |shadows: &Shadows| -> f64 {
        let lines = &shadows.lines;
        let of = |ends: [u32; 2]| {
            let [a, b] = ends.map(|end| lines.points[end as usize]);
            a.distance(b)
        };
        lines.segments.iter().map(|s| of(s.ends)).sum()
    };
    assert!(check_lines(&mesh, &shadows) > 20);
    for (scale, place) in [(1e-3, DVec3::ZERO), (1e4, DVec3::ZERO), (1.0, DVec3::new(1e5, -2e5, 3e4))] {
        let (other, _) = at(scale, place);
        assert!((length(&other) / scale - length(&shadows)).abs() < 1e-3, "{scale} {place}");
    }
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    let (alone, _) = one.install(|| at(1.0, DVec3::ZERO));
    assert_eq!(alone.lines, shadows.lines);
}

#[test]
fn self_shadows_of_models_agree_with_rays() {
    let own = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/");
    for name in ["castle.obj", "pump.glb", "gear.obj", "bear.ply"] {
        let scene = Scene::open(std::path::Path::new(own).join(name)).expect("a model");
        let mesh = Mesh::build(scene.to_soup());
        let mut dice = Dice::new(1);
        let casters = [
            Caster::Directional { towards: DVec3::new(0.4, 0.8, 0.6) },
            Caster::Point { position: DVec3::new(0.4, 0.7, -0.5) * mesh.extents.diagonal },
        ];
        let shadows = Shadows::new(&mesh, &casters);
        let lines = &shadows.lines;
        println!("{name}: {} segments, {} points", lines.segments.len(), lines.points.len());
        assert!(lines.points.iter().all(|p| p.is_finite()));
        let most = if mesh.triangles.len() > 20_000 { 60 } else { 200 };
        check_points(&mesh, &shadows, most, &mut dice);
    }
}
