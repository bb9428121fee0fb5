//! Creases are chains of sharp edges that stand out from the noise around them; tested on solids with known
//! edges, with and without noise.

use crate::library::support::readers::shared_folder;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::solids::{Solid, cuboid, tube};
use glam::DVec3;
use ligne::mesh::{EdgeMark, Mesh, Soup};
use ligne::scene::Scene;
use ligne::surface::HardEdges;

pub(crate) const CREASE_DEG: f64 = 40.0;

pub(crate) fn mesh(solid: Solid) -> Mesh {
    Mesh::build(Soup { positions: solid.positions, triangles: solid.triangles, ..Soup::default() })
}

pub(crate) fn find(mesh: &Mesh) -> HardEdges {
    HardEdges::find(mesh, CREASE_DEG)
}

/// Returns the ends of the hard edges.
pub(crate) fn ends(mesh: &Mesh, hard: &HardEdges) -> Vec<[DVec3; 2]> {
    let of = |e: usize| mesh.edges.vertices[e].map(|v| mesh.positions[v as usize] + mesh.origin);
    (0..mesh.edges.len()).filter(|e| hard.is_hard(*e)).map(of).collect()
}

/// A pseudo-random number from −1 to 1 that depends only on the position.
fn position_noise(p: DVec3) -> f64 {
    let bits = p.to_array().map(|x| ((x * 4096.0).round() as i64) as u64);
    let seed = bits.iter().fold(7u64, |h, b| (h ^ b).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29));
    Dice::new(seed).between(-1.0, 1.0)
}

/// A box from −1 to 1 with sides of `n` by `n` squares.
fn fine_box(n: i32) -> Solid {
    let mut solid = Solid::default();
    let step = |i: i32| 2.0 * f64::from(i) / f64::from(n) - 1.0;
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let first = solid.positions.len() as u32;
                for (i, j) in [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)] {
                    let mut p = [0.0; 3];
                    p[axis] = side;
                    p[(axis + 1) % 3] = side * step(i);
                    p[(axis + 2) % 3] = step(j);
                    solid.positions.push(DVec3::from_array(p));
                }
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| first + k);
                solid.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    solid
}

/// A sphere of radius 1: an octahedron whose triangles are split into four, `cuts` times.
fn octasphere(cuts: u32) -> Solid {
    let mut corners: Vec<[DVec3; 3]> = Vec::new();
    for i in 0..8 {
        let sign = |bit: u32| if i >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let [x, y, z] = [DVec3::X * sign(0), DVec3::Y * sign(1), DVec3::Z * sign(2)];
        corners.push(if x.cross(y).dot(z) > 0.0 { [x, y, z] } else { [x, z, y] });
    }
    for _ in 0..cuts {
        let cut = |[a, b, c]: [DVec3; 3]| {
            let [d, e, f] = [(a + b).normalize(), (b + c).normalize(), (c + a).normalize()];
            [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
        };
        corners = corners.into_iter().flat_map(cut).collect();
    }
    Solid {
        triangles: (0..corners.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
        positions: corners.into_iter().flatten().collect(),
    }
}

#[test]
fn solids_of_flat_faces_keep_every_edge() {
    let cube = mesh(cuboid(DVec3::NEG_ONE, DVec3::ONE));
    assert_eq!(find(&cube).count(), 12);
    // All edges turn by exactly a right angle, so none exceeds it.
    assert_eq!(HardEdges::find(&cube, 90.0).count(), 0);

    let tetrahedron = Solid {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    };
    assert_eq!(find(&mesh(tetrahedron)).count(), 6);

    // Two pyramids of twelve sides, base to base. Only the rim is sharp.
    let mut bicone = tube(12, 1, 1.0, 0.0);
    bicone.positions.truncate(24);
    let rim = |i: u32| 2 * (i % 12);
    let tips = [24, 25];
    bicone.positions.extend([DVec3::Z * 0.8, DVec3::NEG_Z * 0.8]);
    bicone.triangles =
        (0..12).flat_map(|i| [[rim(i), rim(i + 1), tips[0]], [rim(i + 1), rim(i), tips[1]]]).collect();
    assert_eq!(find(&mesh(bicone)).count(), 12);
}

#[test]
fn an_l_shaped_prism_keeps_its_edges() {
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let mut prism = Solid::default();
    for z in [0.0, 3.0] {
        prism.positions.extend(outline.map(|[x, y]| DVec3::new(x, y, z)));
    }
    for i in 0..6 {
        let j = (i + 1) % 6;
        prism.triangles.extend([[i, j, j + 6], [i, j + 6, i + 6]]);
    }
    for k in 1..5 {
        prism.triangles.extend([[0, k + 1, k], [6, k + 6, k + 7]]);
    }
    assert_eq!(find(&mesh(prism)).count(), 18);
}

#[test]
fn a_cylinder_of_twelve_sides_has_two_rims() {
    let mut cylinder = tube(12, 1, 1.0, 2.0);
    for (z, side) in [(-2.0, 0), (2.0, 1)] {
        let middle = cylinder.positions.len() as u32;
        cylinder.positions.push(DVec3::Z * z);
        for i in 0..12 {
            let (a, b) = (2 * i + side, 2 * ((i + 1) % 12) + side);
            cylinder.triangles.push(if side == 0 { [b, a, middle] } else { [a, b, middle] });
        }
    }
    let cylinder = mesh(cylinder);
    let hard = find(&cylinder);
    assert_eq!(hard.count(), 24);
    for [a, b] in ends(&cylinder, &hard) {
        assert!((a.z - b.z).abs() < 1e-9, "{a} {b} runs lengthwise");
    }
}

#[test]
fn noise_makes_no_creases() {
    for (cuts, height) in [(3, 0.3), (4, 0.25), (5, 0.22), (6, 0.22), (5, 0.3), (6, 0.3)] {
        // Heights are relative to the edge length.
        let edge = 1.4 / f64::from(1 << cuts);
        let bumpy = mesh(octasphere(cuts).moved(|p| p * (1.0 + height * edge * position_noise(p))));
        let sharp = HardEdges::above(&bumpy, CREASE_DEG).count();
        let hard = find(&bumpy).count();
        println!("{sharp} of {} edges are sharp, {hard} hard", bumpy.edges.len());
        assert!(sharp > 0);
        // If one edge in forty is sharp, noise alone makes a few long lines.
        let most = if height < 0.3 { 0 } else { sharp / 20 };
        assert!(hard <= most, "{hard} of {sharp} sharp edges");
    }
}

#[test]
fn creases_of_a_noisy_box_are_exactly_its_edges() {
    let n = 24;
    // Turns of about seven degrees on the sides, and some of more than forty.
    let noise =
        |p: DVec3| DVec3::new(position_noise(p), position_noise(p * 2.0), position_noise(p * 3.0)) * 0.012;
    let rough = fine_box(n).moved(|p| p + noise(p));
    let rough = mesh(rough);
    let hard = find(&rough);
    let on_edge = |p: &DVec3| p.to_array().iter().filter(|x| x.abs() > 0.97).count() >= 2;
    let along = ends(&rough, &hard).iter().filter(|pair| pair.iter().all(on_edge)).count();
    assert_eq!(along, 12 * n as usize, "edges along the box's own");
    assert_eq!(hard.count(), along, "edges elsewhere");
}

#[test]
fn a_single_sharp_edge_is_a_crease_on_flat_surfaces_only() {
    // A sheet of triangles with one raised edge, which turns by a right angle.
    let sheet = |noise: f64| {
        let mut solid = Solid::default();
        for (i, j) in (0..20).flat_map(|i| (0..20).map(move |j| (i, j))) {
            let p = DVec3::new(f64::from(i), f64::from(j), 0.0);
            let raised = j == 10 && (i == 9 || i == 10);
            solid.positions.push(p + DVec3::Z * (noise * position_noise(p) + if raised { 0.9 } else { 0.0 }));
        }
        for (i, j) in (0..19u32).flat_map(|i| (0..19u32).map(move |j| (i, j))) {
            let [a, b, c, d] = [20 * i + j, 20 * i + 20 + j, 20 * i + 21 + j, 20 * i + j + 1];
            solid.triangles.extend([[a, b, c], [a, c, d]]);
        }
        mesh(solid)
    };
    let (flat, rough) = (sheet(0.0), sheet(0.15));
    assert!(find(&flat).count() > 0);
    assert!(HardEdges::above(&rough, CREASE_DEG).count() > 0);
    assert_eq!(find(&rough).count(), 0);
}

#[test]
fn edge_marks_of_the_file_override_angles() {
    let solid = cuboid(DVec3::NEG_ONE, DVec3::ONE);
    let mut edge_marks = vec![[EdgeMark::Unmarked; 3]; 12];
    // The sides of the first face are 0-2 and 2-3, edges of the cube, and 3-0, a diagonal.
    assert_eq!(solid.triangles[0], [0, 2, 3]);
    edge_marks[0] = [EdgeMark::Hidden, EdgeMark::Contour, EdgeMark::Hard];
    let soup = Soup { positions: solid.positions, triangles: solid.triangles, edge_marks, ..Soup::default() };
    let cube = Mesh::build(soup);
    for hard in [find(&cube), HardEdges::above(&cube, CREASE_DEG)] {
        let is_hard =
            |pair: [u32; 2]| hard.is_hard(cube.edges.vertices.iter().position(|e| *e == pair).unwrap());
        assert_eq!([[0, 2], [2, 3], [0, 3]].map(is_hard), [false, false, true]);
        assert_eq!(hard.count(), 11);
    }
}

#[test]
fn creases_do_not_depend_on_order_or_winding() {
    let noise =
        |p: DVec3| DVec3::new(position_noise(p), position_noise(p * 2.0), position_noise(p * 3.0)) * 0.04;
    let rough = fine_box(12).moved(|p| p + noise(p));
    let listed = |solid: Solid| {
        let mesh = mesh(solid);
        let key = |p: DVec3| p.to_array().map(|x| (x * 1e6).round() as i64);
        let mut list: Vec<_> = ends(&mesh, &find(&mesh))
            .iter()
            .map(|[a, b]| [key(*a).min(key(*b)), key(*a).max(key(*b))])
            .collect();
        list.sort_unstable();
        list
    };
    let wanted = listed(rough.clone());
    assert!(wanted.len() > 100);
    for seed in 0..4 {
        let mut dice = Dice::new(seed);
        let order = dice.shuffled((0..rough.positions.len()).collect());
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(new, old)| place[*old] = new as u32);
        let turned = |t: &[u32; 3], flip: bool| {
            let [a, b, c] = t.map(|v| place[v as usize]);
            if flip { [a, c, b] } else { [b, c, a] }
        };
        // In the last round, faces are wound at random.
        let triangles: Vec<[u32; 3]> =
            rough.triangles.iter().map(|t| turned(t, seed == 3 && dice.below(2) == 0)).collect();
        let positions = order.iter().map(|i| rough.positions[*i]).collect();
        let found = listed(Solid { positions, triangles: dice.shuffled(triangles) });
        assert!(found == wanted, "round {seed}: {} edges instead of {}", found.len(), wanted.len());
    }
}

/// Returns the number of hard edges that no other hard edge continues.
fn isolated_edge_count(mesh: &Mesh, hard: &HardEdges) -> usize {
    let of = |e: &usize| hard.is_hard(*e);
    let mut degrees = vec![0u8; mesh.positions.len()];
    for e in (0..mesh.edges.len()).filter(of) {
        mesh.edges.vertices[e]
            .iter()
            .for_each(|v| degrees[*v as usize] = degrees[*v as usize].saturating_add(1));
    }
    let alone = |e: &usize| mesh.edges.vertices[*e].iter().all(|v| degrees[*v as usize] == 1);
    (0..mesh.edges.len()).filter(of).filter(alone).count()
}

/// Returns the mesh of a shared model, all its sharp edges, and its creases.
fn shared_model_creases(name: &str) -> Option<(Mesh, HardEdges, HardEdges)> {
    let scene = Scene::open(shared_folder::find(name)?).unwrap();
    let mesh = Mesh::build(scene.to_soup());
    let (all, kept) = (HardEdges::above(&mesh, CREASE_DEG), find(&mesh));
    let lost = (0..mesh.edges.len()).filter(|e| all.is_hard(*e) && !kept.is_hard(*e)).count();
    let (before, after) = (isolated_edge_count(&mesh, &all), isolated_edge_count(&mesh, &kept));
    println!(
        "{name}: {} sharp, {} hard, {lost} lost; {before} loose, then {after}",
        all.count(),
        kept.count()
    );
    Some((mesh, all, kept))
}

#[test]
fn machined_models_keep_their_creases() {
    for name in [
        "cad/bracket.obj",
        "cad/drive.obj",
        "cad/gear.stl",
        "mechanical/fandisk.obj",
        "mechanical/featuretype.stl",
        "mechanical/adis16480-casing.stl",
        "features/voxel-knight.glb",
    ] {
        let Some((mesh, all, kept)) = shared_model_creases(name) else { continue };
        let lost = (0..mesh.edges.len()).filter(|e| all.is_hard(*e) && !kept.is_hard(*e)).count();
        assert_eq!(lost, 0, "{name}");
    }
}

#[test]
fn scans_lose_isolated_sharp_edges() {
    for name in ["organic/stanford-bunny.obj", "organic/armadillo.obj", "organic/dragon-202k.ply"] {
        let Some((mesh, all, kept)) = shared_model_creases(name) else { continue };
        let (before, after) = (isolated_edge_count(&mesh, &all), isolated_edge_count(&mesh, &kept));
        assert!(10 * after < before, "{name}: {after} of {before} loose edges are left");
        assert!(kept.count() > 0, "{name} has creases");
    }
}
