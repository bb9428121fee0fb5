//! Tests of the classification of machined parts, scans and figures on small meshes.

use super::*;
use crate::geometry::numbers::portable_math::sin;
use crate::mesh::{FaceId, Soup};
use glam::DVec3;

/// Lens of two spherical caps that meet at an angle (degrees). Normals are those of the caps, or with
/// `split` false one shared normal per rim vertex.
fn lens(angle_deg: f64, split: bool) -> Mesh {
    const AROUND: u32 = 24;
    const RINGS: u32 = 12;
    let half = ((180.0 - angle_deg) / 2.0).to_radians();
    let mut soup = Soup::default();
    for up in [1.0, -1.0] {
        let first = soup.positions.len() as u32;
        let centre = DVec3::new(0.0, 0.0, -up * cos(half));
        for ring in 0..=RINGS {
            for step in 0..AROUND {
                let (polar, turn) = (
                    half * f64::from(ring) / f64::from(RINGS),
                    std::f64::consts::TAU * (f64::from(step) + 0.5 * f64::from(ring)) / f64::from(AROUND),
                );
                let out = DVec3::new(sin(polar) * cos(turn), sin(polar) * sin(turn), up * cos(polar));
                let is_rim = ring == RINGS;
                let rim = DVec3::new(cos(turn), sin(turn), 0.0);
                let normal = if is_rim && !split { rim } else { out };
                soup.positions.push(if is_rim { rim * sin(half) } else { centre + out });
                soup.normals.push(normal.as_vec3().to_array());
            }
        }
        for ring in 0..RINGS {
            for step in 0..AROUND {
                let at = |ring: u32, step: u32| first + ring * AROUND + step % AROUND;
                let (a, b) = (at(ring, step), at(ring, step + 1));
                let (c, d) = (at(ring + 1, step), at(ring + 1, step + 1));
                for [a, b, c] in [[a, c, b], [b, c, d]] {
                    soup.triangles.push(if up > 0.0 { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    soup.corner_normals = soup.triangles.clone();
    Mesh::build(soup)
}

/// Extruded eight-pointed star, twisted except over its first `straight` rings.
fn twisted_star(straight: u32) -> Mesh {
    star((0..=60u32).map(|ring| 0.04 * f64::from(ring.saturating_sub(straight))))
}

/// Eight-pointed star stacked in rings, each turned by an angle.
fn star(turns: impl Iterator<Item = f64>) -> Mesh {
    const AROUND: u32 = 16;
    let mut soup = Soup::default();
    for (ring, turned) in (0u32..).zip(turns) {
        for step in 0..AROUND {
            let turn = std::f64::consts::TAU * f64::from(step) / f64::from(AROUND) + turned;
            let radius = if step % 2 == 0 { 1.0 } else { 0.6 };
            let z = 0.1 * f64::from(ring);
            soup.positions.push(DVec3::new(radius * cos(turn), radius * sin(turn), z));
            if ring > 0 {
                let at = |ring: u32, step: u32| ring * AROUND + step % AROUND;
                let (a, b) = (at(ring - 1, step), at(ring - 1, step + 1));
                let (c, d) = (at(ring, step), at(ring, step + 1));
                soup.triangles.extend([[a, b, c], [b, d, c]]);
            }
        }
    }
    Mesh::build(soup)
}

#[test]
fn sharp_edges_with_some_flat_ones_mark_a_machined_part() {
    let origins = |straight: u32| Patches::new(&twisted_star(straight), 40.0, false).origins;
    assert!(origins(5).iter().all(|origin| *origin == MeshSource::Constructed));
    // Sharp edges without flat ones are those of a decimated scan.
    assert!(origins(0).iter().all(|origin| *origin == MeshSource::Scanned));
}

/// Rough ground of 20 by 20 squares with heights up to `height`. It is level for `level` squares from one
/// corner. A plate, one square wide and `plate` long, is attached to one side.
fn rough_ground(height: f64, level: u32, plate: f64) -> Mesh {
    const SIDE: u32 = 20;
    let mut soup = Soup::default();
    for i in 0..=SIDE {
        for j in 0..=SIDE {
            let (x, y) = (u64::from(i), u64::from(j));
            let by_chance = ((x + 3).pow(2) * (y + 5).pow(3) * (x + 7) * 131 + x * 577 + y * y * 263) % 1009;
            let z = if i.max(j) <= level && level > 0 { 0.0 } else { height * by_chance as f64 / 1009.0 };
            soup.positions.push(DVec3::new(f64::from(i), f64::from(j), z));
        }
    }
    let at = |i: u32, j: u32| i * (SIDE + 1) + j;
    for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
        let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
        soup.triangles.extend([[a, b, c], [b, d, c]]);
    }
    if plate > 0.0 {
        let (low, high) = (at(SIDE, 3), at(SIDE, 4));
        let far = soup.positions.len() as u32;
        let ends = [low, high].map(|v| soup.positions[v as usize] + DVec3::X * plate);
        soup.positions.extend(ends);
        soup.triangles.extend([[low, far, high], [far, far + 1, high]]);
    }
    Mesh::build(soup)
}

/// Eight-pointed star that is twisted from ring to ring, except at `level` separate rings, so that no
/// planar region is larger than a quad.
fn notched_star(level: u32) -> Mesh {
    star((0..=30).scan(0.0, |turned, ring| {
        *turned += if ring % 2 == 0 && ring < 2 * level { 0.0 } else { 0.06 };
        Some(*turned)
    }))
}

/// Meshes side by side in one part.
fn side_by_side(meshes: &[(&Mesh, f64)]) -> Mesh {
    let mut soup = Soup::default();
    for (k, (mesh, scale)) in meshes.iter().enumerate() {
        let first = soup.positions.len() as u32;
        let away = DVec3::X * (100.0 * k as f64);
        soup.positions.extend(mesh.positions.iter().map(|p| (*p + mesh.origin) * *scale + away));
        soup.triangles.extend(mesh.triangles.iter().map(|t| t.map(|v| v + first)));
    }
    Mesh::build(soup)
}

#[test]
fn flats_of_single_quads_mark_a_sharp_part_as_machined() {
    assert!(is_constructed(&notched_star(4)), "bars that lie askew, each with a quad or two");
    assert!(!is_constructed(&notched_star(0)));
}

#[test]
fn a_planar_region_with_sharp_edges_marks_a_machined_part() {
    // A planar region of 1/25 of the surface. Without it, or with lower heights, the ground is a scan.
    let found = [(1.0, 4), (1.0, 0), (0.6, 4)]
        .map(|(height, level)| is_constructed(&rough_ground(height, level, 0.0)));
    assert_eq!(found, [true, false, false]);
}

#[test]
fn small_components_follow_the_largest_unless_clearly_scanned() {
    let origins = |large: &Mesh, scale: f64, small: &Mesh| {
        let mesh = side_by_side(&[(large, scale), (small, 1.0)]);
        let origins = Patches::new(&mesh, 40.0, false).origins;
        [false, true].map(|is_small| {
            let at = |face: &usize| (mesh.corners(FaceId(*face as u32))[0] + mesh.origin).x;
            let mut own =
                (0..origins.len()).filter(|face| (at(face) > 50.0) == is_small).map(|face| origins[face]);
            let first = own.next().expect("both have faces");
            assert!(own.all(|origin| origin == first));
            first
        })
    };
    let (machined, rough, scan) = (rough_ground(0.6, 6, 0.0), rough_ground(0.8, 0, 0.0), twisted_star(0));
    assert_eq!(origins(&machined, 2.0, &rough), [MeshSource::Constructed; 2]);
    assert_eq!(
        origins(&rough, 2.0, &machined),
        [MeshSource::Scanned, MeshSource::Constructed],
        "the largest stays"
    );
    assert_eq!(origins(&machined, 2.0, &scan), [MeshSource::Constructed, MeshSource::Scanned], "dense");
    // One edge in 200 is sharp.
    let gentle = rough_ground(0.6, 0, 0.0);
    assert_eq!(origins(&machined, 2.0, &gentle), [MeshSource::Constructed, MeshSource::Scanned], "gentle");
}

#[test]
fn creases_of_a_scan_do_not_depend_on_a_machined_neighbour() {
    let hard = |mesh: &Mesh| Patches::new(mesh, 40.0, false).hard.count();
    let (scan, machined) = (twisted_star(0), twisted_star(5));
    let alone = [&scan, &machined].map(hard);
    assert!(alone.iter().all(|count| *count > 0), "{alone:?}");
    assert_eq!(hard(&side_by_side(&[(&scan, 1.0), (&machined, 1.0)])), alone[0] + alone[1]);
}

fn is_constructed(mesh: &Mesh) -> bool {
    let origins = Patches::new(mesh, 40.0, false).origins;
    assert!(origins.iter().all(|origin| *origin == origins[0]));
    origins[0] == MeshSource::Constructed
}

#[test]
fn rough_ground_is_a_scan_unless_flats_or_sharp_edges_are_common() {
    let found = |parts: &[(f64, u32, f64)]| -> Vec<bool> {
        parts
            .iter()
            .map(|(height, level, plate)| is_constructed(&rough_ground(*height, *level, *plate)))
            .collect()
    };
    // A planar region of 1/12 of the surface; most of the surface coplanar with a neighbour; most edges
    // sharp.
    assert_eq!(found(&[(0.6, 6, 0.0), (0.6, 0, 600.0), (6.0, 0, 0.0)]), [true; 3]);
    // No planar region; 1/25 of the surface; a third coplanar with a neighbour; less steep.
    assert_eq!(found(&[(0.6, 0, 0.0), (0.6, 4, 0.0), (0.6, 0, 200.0), (1.2, 0, 0.0)]), [false; 4]);
}

#[test]
fn sharp_parts_with_more_flat_edges_than_noise_are_machined() {
    // One edge in 60 is flat, and no more are nearly flat.
    assert!(is_constructed(&twisted_star(2)));
    assert!(!is_constructed(&twisted_star(0)));
}

#[test]
fn creases_of_round_components_follow_file_normals_and_angle() {
    let hard = |angle_deg: f64, split: bool| {
        let mesh = lens(angle_deg, split);
        let patches = Patches::new(&mesh, 40.0, false);
        assert!(patches.rounded.iter().all(|rounded| *rounded));
        patches.hard.count()
    };
    assert_eq!(hard(52.0, true), 24, "shaded sharp");
    assert_eq!(hard(52.0, false), 0, "shaded smooth");
    assert_eq!(hard(36.0, true), 0, "below the angle of a crease");
    assert_eq!(hard(70.0, false), 24, "sharp by its angle, however shaded");
}
