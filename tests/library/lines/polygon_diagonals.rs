//! Diagonals that triangulate a polygon of a file are no creases unless the polygon is folded there; tested
//! on polygons with known sides.

use glam::{DAffine3, DVec3};
use ligne::Scene;
use ligne::edit::section::{Plane, cut};
use ligne::lines::{LineKind, LineOptions, Surface};
use ligne::load::{obj, ply};
use ligne::mesh::{EdgeMark, Mesh};

/// A polygon model: points, and faces as vertex indices.
struct PolygonModel {
    points: Vec<[f64; 3]>,
    faces: Vec<Vec<usize>>,
}

impl PolygonModel {
    fn obj(&self) -> Scene {
        let point = |[x, y, z]: &[f64; 3]| format!("v {x} {y} {z}\n");
        let face = |face: &Vec<usize>| {
            let corners: Vec<String> = face.iter().map(|corner| (corner + 1).to_string()).collect();
            format!("f {}\n", corners.join(" "))
        };
        let text: String = self.points.iter().map(point).chain(self.faces.iter().map(face)).collect();
        obj::read_bytes(text.as_bytes(), "polygons", |_| None).expect("a model")
    }

    fn ply(&self) -> Scene {
        let (points, faces) = (self.points.len(), self.faces.len());
        let mut text = format!(
            "ply\nformat ascii 1.0\nelement vertex {points}\nproperty double x\nproperty double y\nproperty double z\n\
             element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
        );
        self.points.iter().for_each(|[x, y, z]| text += &format!("{x} {y} {z}\n"));
        for face in &self.faces {
            let corners: Vec<String> = face.iter().map(ToString::to_string).collect();
            text += &format!("{} {}\n", face.len(), corners.join(" "));
        }
        ply::read_bytes(text.as_bytes(), "polygons").expect("a model")
    }

    /// Whether a side of a face joins two points.
    fn is_side(&self, a: DVec3, b: DVec3) -> bool {
        let at = |corner: usize| DVec3::from(self.points[corner]);
        let is_one = |p: DVec3, q: DVec3| p.distance(q) < 1e-6;
        self.faces.iter().any(|face| {
            (0..face.len()).any(|k| {
                let (p, q) = (at(face[k]), at(face[(k + 1) % face.len()]));
                (is_one(p, a) && is_one(q, b)) || (is_one(p, b) && is_one(q, a))
            })
        })
    }
}

/// Returns the creases of a scene as pairs of positions, for a crease angle.
fn creases(scene: &Scene, crease_deg: f64) -> Vec<[DVec3; 2]> {
    let options = LineOptions { crease_deg, kinds: vec![LineKind::Crease], ..LineOptions::default() };
    let surface = Surface::new(Mesh::build(scene.to_soup()), &options);
    let mesh = &surface.mesh;
    let at = |v: u32| mesh.positions[v as usize] + mesh.origin;
    (0..mesh.edges.len())
        .filter(|edge| surface.hard.is_hard(*edge))
        .map(|edge| mesh.edges.vertices[edge].map(at))
        .collect()
}

/// A box with one corner of its top lifted.
fn lifted_box(lift: f64) -> PolygonModel {
    let corner = |k: usize| {
        [10.0 * f64::from(u8::from(k % 4 == 1 || k % 4 == 2)), 10.0 * f64::from(u8::from(k % 4 > 1)), 0.0]
    };
    let mut points: Vec<[f64; 3]> = (0..8).map(corner).collect();
    points[4..].iter_mut().for_each(|p| p[2] = 10.0);
    points[6][2] += lift;
    let sides = (0..4).map(|k| vec![k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4]);
    let faces = [vec![3, 2, 1, 0], vec![4, 5, 6, 7]].into_iter().chain(sides).collect();
    PolygonModel { points, faces }
}

/// A saddle of quads. With `corners` = 6, pairs of quads are merged to hexagons.
fn saddle(corners: usize) -> PolygonModel {
    let across = 7;
    let point = |k: usize| {
        let (x, y) = ((k % across) as f64, (k / across) as f64);
        [5.0 * x, 5.0 * y, 0.2 * (x - 3.0) * (y - 3.0)]
    };
    let at = |x: usize, y: usize| x + across * y;
    let mut faces = Vec::new();
    for y in 0..across - 1 {
        for x in (0..across - 1).step_by(corners / 2 - 1) {
            let right = x + corners / 2 - 1;
            let lower = (x..=right).map(|x| at(x, y));
            faces.push(lower.chain((x..=right).rev().map(|x| at(x, y + 1))).collect());
        }
    }
    PolygonModel { points: (0..across * across).map(point).collect(), faces }
}

#[test]
fn no_crease_runs_along_a_diagonal_of_a_warped_polygon() {
    for (name, model) in [("box", lifted_box(0.6)), ("saddle", saddle(4)), ("hexagons", saddle(6))] {
        for (format, scene) in [("OBJ", model.obj()), ("PLY", model.ply())] {
            let found = creases(&scene, 0.5);
            assert!(!found.is_empty(), "{name} {format}");
            for [a, b] in found {
                assert!(model.is_side(a, b), "{name} {format}: from {a} to {b}");
            }
        }
    }
}

#[test]
fn a_folded_polygon_has_a_crease_where_it_is_folded() {
    // The lifted corner folds the top along its diagonal, by less than 40 degrees or by more.
    let turn = |lift: f64| {
        let (a, b, c) =
            (DVec3::new(10.0, 0.0, 0.0), DVec3::new(10.0, 10.0, lift), DVec3::new(0.0, 10.0, 0.0));
        a.cross(b).angle_between(b.cross(c)).to_degrees()
    };
    for lift in [3.0, 4.0, 5.0, 8.0, 12.0] {
        let model = lifted_box(lift);
        let is_folded = turn(lift) > 40.0;
        for crease_deg in [2.0, 20.0, 40.0] {
            let drawn = creases(&model.obj(), crease_deg).iter().any(|[a, b]| !model.is_side(*a, *b));
            assert_eq!(drawn, is_folded, "{} degrees, creases from {crease_deg}", turn(lift));
        }
    }
}

#[test]
fn triangles_and_quads_with_a_repeated_corner_keep_their_creases() {
    // A roof of 30 degrees: as triangles, and as quads whose last corner is repeated.
    let text = "v 0 0 0\nv 10 0 0\nv 10 5 2.8867513\nv 0 5 2.8867513\nv 10 10 0\nv 0 10 0\n";
    let plain = format!("{text}f 1 2 3\nf 1 3 4\nf 4 3 5\nf 4 5 6\n");
    let twice = format!("{text}f 1 2 3 3\nf 1 3 4 4\nf 4 3 5 5\nf 4 5 6 6\n");
    let found = [plain, twice].map(|text| {
        let scene = obj::read_bytes(text.as_bytes(), "roof", |_| None).expect("a model");
        creases(&scene, 20.0)
    });
    assert_eq!(found[0].len(), 1);
    assert_eq!(found[0], found[1]);
}

#[test]
fn diagonal_marks_survive_cutting_and_mirroring() {
    let model = saddle(4);
    let scene = model.obj();
    let plane = Plane::new(DVec3::new(12.0, 0.0, 0.0), DVec3::X).expect("a direction");
    let halves = cut(scene.clone(), &plane, &[]).scene;
    assert!(
        halves.geometries.iter().any(|g| g.edge_marks.iter().flatten().any(|m| *m == EdgeMark::Diagonal))
    );
    for [a, b] in creases(&halves, 0.5) {
        let way = (b - a).abs();
        assert!(way.x < 1e-6 || way.y < 1e-6, "from {a} to {b}");
    }
    let mut mirrored = scene.clone();
    mirrored.parts[0].world_from_part = DAffine3::from_scale(DVec3::new(1.0, -1.0, 1.0));
    for [a, b] in creases(&mirrored, 0.5) {
        assert!(
            model.is_side(a * DVec3::new(1.0, -1.0, 1.0), b * DVec3::new(1.0, -1.0, 1.0)),
            "from {a} to {b}"
        );
    }
}
