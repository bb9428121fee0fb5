use super::*;
use crate::geometry::dice::Dice;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::mesh::{EdgeMark, FaceId, Mesh, Soup};

/// Sphere of 12 x 6 quads, each of two triangles, around a point.
fn ball(soup: &mut Soup, middle: DVec3, radius: f64) {
    let first = soup.positions.len() as u32;
    let (around, up) = (12, 6);
    for j in 1..up {
        for i in 0..around {
            let (u, v) = (f64::from(i) / f64::from(around), f64::from(j) / f64::from(up));
            let (turn, tilt) = (u * std::f64::consts::TAU, v * std::f64::consts::PI);
            let at = DVec3::new(sin(tilt) * cos(turn), sin(tilt) * sin(turn), -cos(tilt));
            soup.positions.push(middle + at * radius);
        }
    }
    let poles = soup.positions.len() as u32;
    soup.positions.extend([middle - DVec3::Z * radius, middle + DVec3::Z * radius]);
    let at = |i: u32, j: u32| first + (j - 1) * around + i % around;
    for i in 0..around {
        soup.triangles.push([poles, at(i + 1, 1), at(i, 1)]);
        soup.triangles.push([poles + 1, at(i, up - 1), at(i + 1, up - 1)]);
        for j in 1..up - 1 {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            soup.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
}

fn with_turned_faces(mut soup: Soup, mut turns: impl FnMut(usize) -> bool) -> Soup {
    let turned: Vec<bool> = (0..soup.triangles.len()).map(&mut turns).collect();
    turn_faces(&mut soup, &turned);
    soup
}

/// All contents of a mesh that affect a drawing.
fn mesh_contents(mesh: &Mesh) -> String {
    let Mesh { positions, triangles, face_normals, corner_uvs, corner_colours, edge_marks, edges, .. } = mesh;
    let edges: Vec<_> = (0..edges.len()).map(|e| (edges.vertices[e], edges.faces(e))).collect();
    let normals: Vec<_> = face_normals.iter().map(|n| n.map(|x| x + 0.0)).collect();
    format!(
        "{positions:?} {triangles:?} {normals:?} {corner_uvs:?} {corner_colours:?} {edge_marks:?} {edges:?}"
    )
}

#[test]
fn orientation_of_closed_surfaces_does_not_depend_on_the_winding() {
    let mut dice = Dice::new(11);
    let mut soup = Soup::default();
    for (k, radius) in [(0.0, 1.0), (3.0, 1.2), (3.1, 0.4)] {
        ball(&mut soup, DVec3::new(k, 0.2 * k, 0.1), radius);
    }
    let count = soup.triangles.len();
    soup.triangle_part = (0..count).map(|face| PartId((3 * face / count) as u32)).collect();
    soup.uvs = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    soup.corner_uvs = vec![[0, 1, 2]; count];
    soup.corner_colours = vec![[[0.0; 3], [0.5; 3], [1.0; 3]]; count];
    soup.edge_marks = vec![[EdgeMark::Unmarked, EdgeMark::Hidden, EdgeMark::Hard]; count];
    let right = Mesh::build(soup.clone());
    assert!(right.turned.is_empty());
    let all = Mesh::build(with_turned_faces(soup.clone(), |_| true));
    assert_eq!(mesh_contents(&all), mesh_contents(&right));
    let counts = |mesh: &Mesh| -> Vec<(u32, u64, u64)> {
        mesh.turned.iter().map(|own| (own.part.0, own.faces, own.surfaces)).collect()
    };
    let each = count as u64 / 3;
    assert_eq!(counts(&all), [(0, each, 1), (1, each, 1), (2, each, 1)]);
    let one = Mesh::build(with_turned_faces(soup.clone(), |face| 3 * face / count == 1));
    assert_eq!(mesh_contents(&one), mesh_contents(&right));
    assert_eq!(counts(&one), [(1, each, 1)]);
    for _ in 0..20 {
        let flags: Vec<bool> = (0..count).map(|_| dice.below(2) == 1).collect();
        let some = Mesh::build(with_turned_faces(soup.clone(), |face| flags[face]));
        assert_eq!(mesh_contents(&some), mesh_contents(&right));
        let number = flags.iter().filter(|flag| **flag).count() as u64;
        assert_eq!(some.turned.iter().map(|own| own.faces).sum::<u64>(), number);
    }
}

/// Cosines between the face normals and the directions from the middle.
fn outward_cosines(mesh: &Mesh) -> Vec<f64> {
    let faces = (0..mesh.triangles.len() as u32).map(FaceId);
    let of = |face: FaceId| {
        let [a, b, c] = mesh.corners(face);
        (b - a).cross(c - a).normalize().dot((a + b + c).normalize())
    };
    faces.map(of).collect()
}

#[test]
fn open_surfaces_around_a_volume_are_oriented_outward() {
    let mut soup = Soup::default();
    ball(&mut soup, DVec3::ZERO, 1.0);
    // Three quarters of a sphere, and half of one.
    for least in [-0.6, 0.0] {
        let mut open = soup.clone();
        open.triangles.retain(|t| t.iter().all(|v| soup.positions[*v as usize].z > least - 1e-9));
        for flip in [false, true] {
            let mesh = Mesh::build(with_turned_faces(open.clone(), |_| flip));
            assert!(outward_cosines(&mesh).iter().all(|cosine| *cosine > 0.0));
            assert_eq!(!mesh.turned.is_empty(), flip);
        }
    }
}

#[test]
fn sheets_are_oriented_by_the_majority_of_their_faces() {
    let positions = (0..24).map(|k| DVec3::new(f64::from(k / 2), f64::from(k % 2), 0.0)).collect();
    let mut soup = Soup { positions, ..Soup::default() };
    for k in 0..11 {
        let a = 2 * k;
        soup.triangles.extend([[a, a + 2, a + 1], [a + 1, a + 2, a + 3]]);
    }
    for flip in [false, true] {
        let mesh = Mesh::build(with_turned_faces(soup.clone(), |face| (face == 7) != flip));
        assert!(mesh.face_normals.iter().all(|n| (n[2] > 0.0) != flip));
        assert_eq!(mesh.turned.iter().map(|own| own.faces).collect::<Vec<_>>(), [1]);
    }
}

#[test]
fn moebius_strips_keep_their_winding() {
    let point = |k: u32| {
        let turn = f64::from(k / 2 % 9) / 9.0 * std::f64::consts::TAU;
        let half = turn / 2.0 + if k >= 18 { std::f64::consts::PI } else { 0.0 };
        let across = if k.is_multiple_of(2) { 0.3 } else { -0.3 };
        let out = 1.0 + across * cos(half);
        DVec3::new(out * cos(turn), out * sin(turn), across * sin(half))
    };
    let mut soup = Soup { positions: (0..18).map(point).collect(), ..Soup::default() };
    for k in 0..9 {
        let a = 2 * k;
        let [c, d] = if k == 8 { [1, 0] } else { [a + 2, a + 3] };
        soup.triangles.extend([[a, c, a + 1], [a + 1, c, d]]);
    }
    let mesh = Mesh::build(soup);
    assert!(mesh.turned.is_empty());
    let same = |edge: usize| matches!(mesh.edges.faces(edge), EdgeFaces::Two { same_way: true, .. });
    assert_eq!((0..mesh.edges.len()).filter(|edge| same(*edge)).count(), 1);
}

#[test]
fn solids_that_share_an_edge_are_oriented_separately() {
    let mut soup = Soup::default();
    for shift in [0.0, 1.0] {
        let first = soup.positions.len() as u32;
        let corner =
            |k: u32| DVec3::new(f64::from(k & 1) + shift, f64::from(k >> 1 & 1) + shift, f64::from(k >> 2));
        soup.positions.extend((0..8).map(corner));
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        for [a, b, c, d] in quads.map(|quad| quad.map(|v: u32| v + first)) {
            soup.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let right = Mesh::build(soup.clone());
    assert!(right.turned.is_empty() && right.cleaning.non_manifold == 1);
    let other = Mesh::build(with_turned_faces(soup.clone(), |face| face < 12));
    assert_eq!((mesh_contents(&other), other.turned[0].faces), (mesh_contents(&right), 12));
}
