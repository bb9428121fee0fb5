//! The models in `examples/models` are valid: closed, facing outwards, without degenerate triangles, and
//! named.

use std::collections::{BTreeMap, BTreeSet};

use crate::library::support::readers::example_files::{
    Coordinates, FilePart, example_bytes, read_obj, read_ply, read_stl, weld_points,
};

#[allow(dead_code)]
#[path = "../../../examples/make_stress/scenes.rs"]
mod scenes;

fn minus(a: Coordinates, b: Coordinates) -> Coordinates {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: Coordinates, b: Coordinates) -> Coordinates {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Coordinates, b: Coordinates) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Number of occurrences of each directed edge.
fn directed_edges(part: &FilePart) -> BTreeMap<(usize, usize), usize> {
    let mut edges = BTreeMap::new();
    for [a, b, c] in &part.faces {
        for edge in [(*a, *b), (*b, *c), (*c, *a)] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    edges
}

/// Faces of each connected component, by union-find.
fn components(part: &FilePart) -> Vec<Vec<[usize; 3]>> {
    let mut leader: Vec<usize> = (0..part.points.len()).collect();
    fn root(leader: &mut [usize], mut id: usize) -> usize {
        while leader[id] != id {
            leader[id] = leader[leader[id]];
            id = leader[id];
        }
        id
    }
    for face in &part.faces {
        let [a, b, c] = face.map(|corner| root(&mut leader, corner));
        leader[b] = a;
        let c = root(&mut leader, c);
        leader[c] = a;
    }
    let mut pieces: BTreeMap<usize, Vec<[usize; 3]>> = BTreeMap::new();
    for face in &part.faces {
        pieces.entry(root(&mut leader, face[0])).or_default().push(*face);
    }
    pieces.into_values().collect()
}

/// Six times the signed volume between the faces and a point.
fn volume_times_six(part: &FilePart, faces: &[[usize; 3]], origin: Coordinates) -> f64 {
    let corner = |id: usize| minus(part.points[id], origin);
    faces.iter().map(|[a, b, c]| dot(corner(*a), cross(corner(*b), corner(*c)))).sum()
}

fn assert_no_flat_triangles(part: &FilePart) {
    for face in &part.faces {
        let [a, b, c] = face.map(|corner| part.points[corner]);
        let [u, v, w] = [minus(b, a), minus(c, b), minus(a, c)];
        let longest = [u, v, w].map(|side| dot(side, side)).into_iter().fold(0.0, f64::max);
        let area = cross(u, v);
        // A triangle counts as degenerate if its height is less than a thousandth of its longest side.
        assert!(dot(area, area).sqrt() > 1e-3 * longest, "flat triangle {a:?} {b:?} {c:?} in {}", part.name);
    }
}

/// Asserts that each edge has two faces of opposite direction, every component faces outwards, and no
/// triangle is degenerate.
pub(crate) fn assert_solid(part: &FilePart) {
    assert!(!part.faces.is_empty(), "{} is empty", part.name);
    let edges = directed_edges(part);
    for ((a, b), count) in &edges {
        assert_eq!((*count, edges.get(&(*b, *a))), (1, Some(&1)), "edge {a} {b} of {}", part.name);
    }
    for faces in components(part) {
        assert!(
            volume_times_six(part, &faces, part.points[faces[0][0]]) > 0.0,
            "a piece of {} is inside out",
            part.name
        );
    }
    assert_no_flat_triangles(part);
}

#[test]
fn teapot_parts_have_the_expected_borders() {
    let parts = read_obj("teapot.obj");
    let names: Vec<&str> = parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["body", "lid", "handle", "spout"]);
    for (part, borders) in parts.iter().zip([1, 1, 2, 2]) {
        let edges = directed_edges(part);
        assert!(edges.values().all(|count| *count == 1), "{} is not turned one way", part.name);
        let open: BTreeMap<usize, usize> =
            edges.keys().filter(|(a, b)| !edges.contains_key(&(*b, *a))).copied().collect();
        let mut left: BTreeSet<usize> = open.keys().copied().collect();
        let mut loops = 0;
        while let Some(first) = left.pop_first() {
            loops += 1;
            let mut at = open[&first];
            while at != first {
                assert!(left.remove(&at), "the borders of {} branch", part.name);
                at = open[&at];
            }
        }
        assert_eq!(loops, borders, "borders of {}", part.name);
        // Measured from the centre of the borders, as if caps closed them.
        let middle = std::array::from_fn(|k| {
            open.keys().map(|&id| part.points[id][k]).sum::<f64>() / open.len() as f64
        });
        assert!(volume_times_six(part, &part.faces, middle) > 0.0, "{} is inside out", part.name);
        assert_no_flat_triangles(part);
    }
    let triangles: usize = parts.iter().map(|part| part.faces.len()).sum();
    assert!((6000..10_000).contains(&triangles), "{triangles} triangles");
}

#[test]
fn gear_is_one_solid() {
    let parts = read_obj("gear.obj");
    assert_eq!((parts.len(), parts[0].name.as_str()), (1, "gear"));
    assert_solid(&parts[0]);
    assert_eq!(components(&parts[0]).len(), 1);
    // One bore and six holes: Euler characteristic 2 - 2 * 7.
    let (faces, edges) = (parts[0].faces.len() as i64, directed_edges(&parts[0]).len() as i64 / 2);
    assert_eq!(parts[0].points.len() as i64 - edges + faces, -12);
}

#[test]
fn bracket_is_one_solid() {
    let part = weld_points(&read_stl("bracket.stl"));
    assert_solid(&part);
    assert_eq!(components(&part).len(), 1);
    // Two holes in the base, five in the wall.
    let (faces, edges) = (part.faces.len() as i64, directed_edges(&part).len() as i64 / 2);
    assert_eq!(part.points.len() as i64 - edges + faces, -12);
}

#[test]
fn knot_is_one_solid() {
    let part = read_ply("knot.ply");
    assert_solid(&part);
    let (faces, edges) = (part.faces.len() as i64, directed_edges(&part).len() as i64 / 2);
    assert_eq!(part.points.len() as i64 - edges + faces, 0);
}

#[test]
fn bear_is_one_coarse_solid() {
    let part = read_ply("bear.ply");
    assert_solid(&part);
    assert_eq!(components(&part).len(), 1);
    let (faces, edges) = (part.faces.len() as i64, directed_edges(&part).len() as i64 / 2);
    assert_eq!(part.points.len() as i64 - edges + faces, 2);
    assert!((500..900).contains(&faces), "{faces} faces");
}

#[test]
fn castle_is_made_of_named_solids() {
    let parts = read_obj("castle.obj");
    parts.iter().for_each(assert_solid);
    let names: BTreeSet<&str> = parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names.len(), parts.len(), "names are unique");
    for name in ["keep", "gatehouse", "steps", "wall-front", "tower-south-east-roof", "keep-flag"] {
        assert!(names.contains(name), "no part {name}");
    }
    let library = String::from_utf8(example_bytes("castle.mtl")).unwrap();
    let known: BTreeSet<&str> = library.lines().filter_map(|line| line.strip_prefix("newmtl ")).collect();
    let text = String::from_utf8(example_bytes("castle.obj")).unwrap();
    let used: BTreeSet<&str> = text.lines().filter_map(|line| line.strip_prefix("usemtl ")).collect();
    assert_eq!(known, used);
}

#[test]
fn machines_are_made_of_solids() {
    for (name, count) in
        [("shaft.obj", 8), ("drum.obj", 21), ("elbow.obj", 1), ("bevels.obj", 3), ("goose.obj", 7)]
    {
        let parts = read_obj(name);
        assert_eq!(parts.len(), count, "parts of {name}");
        parts.iter().for_each(|part| assert_solid(&weld_points(part)));
    }
    let elbow = read_obj("elbow.obj").remove(0);
    // A bore and twelve holes.
    assert_eq!(
        elbow.points.len() as i64 - directed_edges(&elbow).len() as i64 / 2 + elbow.faces.len() as i64,
        -24
    );
    let rack = weld_points(&read_stl("rack.stl"));
    assert_solid(&rack);
    assert_eq!(components(&rack).len(), 8);
    let shelf = read_ply("shelf.ply");
    assert_solid(&shelf);
    assert_eq!(components(&shelf).len(), 5);
    assert!(components(&shelf).iter().any(|piece| piece.len() > 4500), "a scan");
}

#[test]
fn helmet_is_one_part_of_four_materials() {
    let parts = read_obj("helmet.obj");
    assert_eq!(parts.len(), 1);
    assert_solid(&parts[0]);
    let text = String::from_utf8(example_bytes("helmet.obj")).unwrap();
    assert_eq!(text.lines().filter(|line| line.starts_with("usemtl ")).count(), 4);
    let library = String::from_utf8(example_bytes("helmet.mtl")).unwrap();
    assert_eq!(library.lines().filter(|line| line.starts_with("newmtl ")).count(), 4);
}

#[test]
fn horn_is_an_open_sheet_with_two_borders_and_solids() {
    let parts = read_obj("horn.obj");
    parts[1..].iter().for_each(assert_solid);
    let edges = directed_edges(&parts[0]);
    assert!(edges.values().all(|count| *count == 1));
    // Mouthpiece and bell: a border of 28 edges each.
    assert_eq!(edges.keys().filter(|(a, b)| !edges.contains_key(&(*b, *a))).count(), 2 * 28);
}

#[test]
fn biplane_has_double_sided_sheets() {
    let parts: Vec<FilePart> = read_obj("biplane.obj").iter().map(weld_points).collect();
    let part = |name: &str| parts.iter().find(|part| part.name == name).unwrap();
    for name in ["fuselage", "cowling", "cowling-paint", "struts", "wheels"] {
        assert_solid(part(name));
    }
    for (name, back) in [("wing-upper", true), ("wing-lower", true), ("fin", true), ("tail-plane", false)] {
        let faces: BTreeSet<[usize; 3]> = part(name).faces.iter().map(|face| lowest_first(*face)).collect();
        let turned = faces.iter().filter(|[a, b, c]| faces.contains(&lowest_first([*c, *b, *a]))).count();
        let (all, expected) = (part(name).faces.len(), if back { faces.len() } else { 0 });
        assert_eq!((turned, 2 * faces.len() / if back { 2 } else { 1 }), (expected, all), "{name}");
        assert_no_flat_triangles(part(name));
    }
}

/// Rotates a face to start at its lowest corner index.
fn lowest_first(mut face: [usize; 3]) -> [usize; 3] {
    let lowest = (0..3).min_by_key(|k| face[*k]).unwrap();
    face.rotate_left(lowest);
    face
}

#[test]
fn stress_scenes_have_the_expected_triangle_counts() {
    let part = |scene: scenes::Triangles| {
        let faces = scene.faces.iter().map(|face| face.map(|corner| corner as usize)).collect();
        FilePart { name: "scene".to_owned(), points: scene.points, faces }
    };
    let city = part(scenes::city(20));
    assert_eq!(city.faces.len(), 12 * 20 * 20);
    assert_solid(&city);
    let sphere = part(scenes::sphere(16));
    assert_eq!(sphere.faces.len(), 12 * 16 * 16);
    assert_solid(&sphere);
    let sponge = part(scenes::menger(2));
    // A Menger sponge of level n has 2 * 20^n + 4 * 8^n visible squares.
    assert_eq!(sponge.faces.len(), 2 * (2 * 400 + 4 * 64));
    let edges = directed_edges(&sponge);
    assert!(edges.iter().all(|((a, b), count)| edges.get(&(*b, *a)) == Some(count)));
    let terrain = part(scenes::terrain(32));
    assert_eq!(terrain.faces.len(), 2 * 32 * 32);
    assert!(terrain.faces.iter().all(|face| {
        let [a, b, c] = face.map(|corner| terrain.points[corner]);
        cross(minus(b, a), minus(c, a))[1] > 0.0
    }));
}

#[test]
fn example_models_are_small_in_total() {
    let names = [
        "teapot.obj",
        "gear.obj",
        "bracket.stl",
        "knot.ply",
        "bear.ply",
        "castle.obj",
        "castle.mtl",
        "pump.glb",
        "drive.glb",
        "shaft.obj",
        "drum.obj",
        "elbow.obj",
        "bevels.obj",
        "horn.obj",
        "goose.obj",
        "biplane.obj",
        "helmet.obj",
        "helmet.mtl",
        "street.glb",
        "crane.glb",
        "brick.glb",
        "shelf.ply",
        "rack.stl",
    ];
    let sum: usize = names.iter().map(|name| example_bytes(name).len()).sum();
    assert!(sum < 3_900_000, "{sum} bytes");
}
