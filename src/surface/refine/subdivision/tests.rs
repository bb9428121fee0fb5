//! Tests of subdivision on an icosahedron and on a long prism.

use super::*;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::mesh::Soup;

fn icosahedron() -> Mesh {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let mut positions = Vec::new();
    for (x, y) in [(1.0, golden), (1.0, -golden), (-1.0, golden), (-1.0, -golden)] {
        let p = DVec3::new(x, y, 0.0).normalize();
        positions.extend([p, DVec3::new(p.y, 0.0, p.x), DVec3::new(0.0, p.x, p.y)]);
    }
    // Three vertices at edge distance from each other form a face.
    let near = |a: usize, b: usize| positions[a].distance(positions[b]) < 1.1;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in (b + 1..12).filter(|c| near(a, b) && near(b, *c) && near(*c, a)) {
                let outward = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
                let face = [a as u32, b as u32, c as u32];
                let [a, b, c] = face;
                triangles.push(if outward.dot(positions[a as usize]) > 0.0 { face } else { [a, c, b] });
            }
        }
    }
    Mesh::build(Soup { positions, triangles, ..Soup::default() })
}

#[test]
fn a_refined_icosahedron_is_a_sphere_without_cracks() {
    let mesh = icosahedron();
    let smooth = SmoothNormals::rounded(&mesh);
    // Only one half is refined, so that all patterns occur.
    let wanted = |ends: [DVec3; 2], _: [DVec3; 2]| {
        let half = ends[0].x + ends[1].x + 0.3 * (ends[0].y + ends[1].y) > 0.4;
        if half { ends[0].distance(ends[1]) * 10.0 } else { 0.0 }
    };
    let RefinedMesh { mesh: finer, smooth: normals, hosts, edges, .. } =
        refined(&mesh, &smooth, |_, _| true, wanted).expect("edges are longer than that");
    assert_eq!((mesh.triangles.len(), edges.len()), (20, 30));
    assert!(finer.triangles.len() > 500 && hosts.len() == finer.triangles.len());
    assert_eq!((finer.edges.border_count(), finer.edges.non_manifold_count()), (0, 0));
    let euler = finer.positions.len() as i64 - finer.edges.len() as i64 + finer.triangles.len() as i64;
    assert_eq!(euler, 2);
    for (vertex, normal) in normals.vertices.iter().zip(&normals.normals) {
        let p = finer.positions[*vertex as usize];
        assert!((p.length() - 1.0).abs() < 1e-9 && p.distance(*normal) < 1e-6, "{p} {normal}");
    }
    for face in 0..finer.triangles.len() {
        let [a, b, c] = finer.corners(crate::mesh::FaceId(face as u32));
        assert!((b - a).cross(c - a).dot(a + b + c) > 0.0, "every face keeps its side");
    }
}

/// Long closed prism with six sides. Normals at its ends tilt outward, as those of bevels do.
fn bar(length: f64) -> Mesh {
    let mut positions = vec![DVec3::ZERO, DVec3::new(0.0, 0.0, length)];
    let mut normals = vec![DVec3::NEG_Z, DVec3::Z];
    let mut triangles = Vec::new();
    for k in 0..6u32 {
        let turn = f64::from(k) * std::f64::consts::FRAC_PI_3;
        let out = DVec3::new(cos(turn), sin(turn), 0.0);
        positions.extend([out, out + DVec3::new(0.0, 0.0, length)]);
        normals.extend([out - DVec3::Z, out + DVec3::Z].map(DVec3::normalize));
        let [a, b] = [2 + 2 * k, 2 + 2 * ((k + 1) % 6)];
        triangles.extend([[a, b, a + 1], [b, b + 1, a + 1], [0, b, a], [1, a + 1, b + 1]]);
    }
    let normals = normals.iter().map(|normal| normal.as_vec3().to_array()).collect();
    let corner_normals = triangles.clone();
    Mesh::build(Soup { positions, normals, corner_normals, triangles, ..Soup::default() })
}

#[test]
fn subdivision_does_not_swell_a_bar_at_its_short_sides() {
    // A long prism made of slivers, and one whose faces are wider than the rise of the arcs over its long
    // edges.
    for length in [40.0, 6.0] {
        let mesh = bar(length);
        let smooth = SmoothNormals::new(&mesh, |_| true, |_| false);
        assert!(!smooth.straight.is_empty(), "normals lean out at both its ends");
        let wanted =
            |ends: [DVec3; 2], normals: [DVec3; 2]| EdgeArc::new(ends, normals).height().length() * 100.0;
        let RefinedMesh { mesh: finer, smooth, .. } =
            refined(&mesh, &smooth, |_, _| true, wanted).expect("it is rounder than six sides");
        let widest =
            finer.positions.iter().map(|p| (*p + finer.origin).truncate().length()).fold(0.0, f64::max);
        assert!((1.0..1.1).contains(&widest), "{length}: {widest}");
        // The bound on arcs also holds for the new edges, because contours may cross them.
        for edge in 0..finer.edges.len() {
            let Some(ends) = smooth.across(&finer, edge) else { continue };
            assert!(EdgeArc::over(&finer, &smooth, ends).height().length() < 0.2, "{length}: {edge}");
        }
    }
}

#[test]
fn refined_is_none_if_no_edge_is_split() {
    let mesh = icosahedron();
    assert!(refined(&mesh, &SmoothNormals::rounded(&mesh), |_, _| true, |_, _| 0.0).is_none());
    assert!(refined(&mesh, &SmoothNormals::default(), |_, _| true, |_, _| 2.0).is_none());
}
