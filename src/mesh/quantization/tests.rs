use super::*;
use crate::geometry::numbers::portable_math::{acos, cos, sin};
use crate::mesh::{DihedralCosines, Mesh, Soup};

/// Torus with `around` times `along` quads, each cut in two.
fn torus(around: u32, along: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let turn = |k: u32, n: u32| std::f64::consts::TAU * f64::from(k) / f64::from(n);
    let point = |i: u32, j: u32| {
        let (u, v) = (turn(i, around), turn(j, along));
        let r = 1.0 + 0.3 * cos(v);
        DVec3::new(r * cos(u), r * sin(u), 0.3 * sin(v))
    };
    let vertices = (0..around * along).map(|k| point(k / along, k % along)).collect();
    (vertices, grid_triangles(around, along, true))
}

/// Triangles of a grid of vertices. If `closed`, the last row continues in the first, and the last column as
/// well.
fn grid_triangles(rows: u32, columns: u32, closed: bool) -> Vec<[u32; 3]> {
    let open = u32::from(!closed);
    let at = |i: u32, j: u32| i % rows * columns + j % columns;
    let quads = (0..rows - open).flat_map(|i| (0..columns - open).map(move |j| (i, j)));
    quads
        .flat_map(|(i, j)| {
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
            [[a, b, c], [b, d, c]]
        })
        .collect()
}

/// Vertices rounded as by compression, and the length of a step.
fn quantized(vertices: &[DVec3], bits: u32) -> (Vec<DVec3>, f64) {
    let low = vertices.iter().fold(DVec3::INFINITY, |low, p| low.min(*p));
    let high = vertices.iter().fold(DVec3::NEG_INFINITY, |high, p| high.max(*p));
    let step = (high - low).max_element() / f64::from((1 << bits) - 1);
    (vertices.iter().map(|p| low + ((*p - low) / step).round() * step).collect(), step)
}

/// Number of edges that turn by more than an angle.
fn sharp_edge_count(vertices: &[DVec3], triangles: &[[u32; 3]], degrees: f64) -> usize {
    let soup = Soup { positions: vertices.to_vec(), triangles: triangles.to_vec(), ..Soup::default() };
    let mesh = Mesh::build(soup);
    let turns = DihedralCosines::of(&mesh);
    let turn = |edge: usize| acos(f64::from(turns.at(&mesh, edge).clamp(-1.0, 1.0))).to_degrees();
    (0..mesh.edges.len()).filter(|edge| turn(*edge) > degrees).count()
}

fn max_offset(vertices: &[DVec3], from: &[DVec3]) -> f64 {
    vertices.iter().zip(from).map(|(p, q)| (*p - *q).abs().max_element()).fold(0.0, f64::max)
}

#[test]
fn dequantize_smooths_rounding_creases_within_half_a_step() {
    let (truth, triangles) = torus(300, 90);
    let (on_lattice, step) = quantized(&truth, 8);
    assert_eq!(sharp_edge_count(&truth, &triangles, 10.0), 0);
    assert!(sharp_edge_count(&on_lattice, &triangles, 40.0) > 500);
    let mut loose = on_lattice.clone();
    dequantize(&mut loose, &triangles, &[]);
    assert!(max_offset(&loose, &on_lattice) <= 0.5 * step * 1.000_001);
    assert_eq!(sharp_edge_count(&loose, &triangles, 30.0), 0);
    assert!(
        sharp_edge_count(&loose, &triangles, 10.0) * 10 < sharp_edge_count(&on_lattice, &triangles, 10.0)
    );
    // The result is nearer to the original shape than the rounded positions are.
    let off = |of: &[DVec3]| {
        let from = |p: &DVec3| {
            let out = p.truncate().length() - 1.0;
            ((out * out + p.z * p.z).sqrt() - 0.3).abs()
        };
        of.iter().map(from).sum::<f64>()
    };
    assert!(off(&loose) < 0.6 * off(&on_lattice), "{} of {}", off(&loose), off(&on_lattice));
}

#[test]
fn dequantize_keeps_wide_faces_and_surface_borders_unchanged() {
    let (truth, triangles) = torus(12, 8);
    let (on_lattice, _) = quantized(&truth, 12);
    let mut loose = on_lattice.clone();
    dequantize(&mut loose, &triangles, &[]);
    assert_eq!(loose, on_lattice);
    // A fine wave with a border all around.
    let wave = |k: u32| {
        let (x, y) = (f64::from(k / 60), f64::from(k % 60));
        DVec3::new(x, y, 4.0 * sin(0.1 * x + 0.05 * y))
    };
    let truth: Vec<DVec3> = (0..3600).map(wave).collect();
    let (on_lattice, _) = quantized(&truth, 7);
    let mut loose = on_lattice.clone();
    dequantize(&mut loose, &grid_triangles(60, 60, false), &[]);
    let is_end = |k: usize| [k / 60, k % 60].iter().any(|i| *i == 0 || *i == 59);
    assert!((0..3600).filter(|k| is_end(*k)).all(|k| loose[k] == on_lattice[k]));
    assert!((0..3600).any(|k| loose[k] != on_lattice[k]));
    // Vertices on no lattice stay unchanged.
    let mut free = truth.clone();
    dequantize(&mut free, &grid_triangles(60, 60, false), &[]);
    assert_eq!(free, truth);
}

/// Ridge of 60 degrees made of fine faces, not aligned with the axes. Each slope has separate vertices along
/// it.
fn ridge() -> (Vec<DVec3>, Vec<[u32; 3]>, Vec<[f32; 3]>) {
    const COLUMNS: u32 = 40;
    const ROWS: u32 = 20;
    let (along, up) = (DVec3::new(0.8, 0.53, 0.28).normalize(), DVec3::new(-0.2, -0.22, 0.95));
    let up = (up - along * along.dot(up)).normalize();
    let (mut vertices, mut triangles, mut normals) = (Vec::new(), Vec::new(), Vec::new());
    for side in [1.0, -1.0] {
        let (low, high) = (sin(30f64.to_radians()), cos(30f64.to_radians()));
        let away = along.cross(up) * side * high - up * low;
        let normal = along.cross(up) * side * low + up * high;
        let first = vertices.len() as u32;
        for k in 0..COLUMNS * ROWS {
            vertices.push(along * f64::from(k / ROWS) + away * f64::from(k % ROWS));
            normals.push(normal.as_vec3().to_array());
        }
        triangles.extend(grid_triangles(COLUMNS, ROWS, false).into_iter().map(|[a, b, c]| {
            let [a, b, c] = [a, b, c].map(|v| v + first);
            if side > 0.0 { [a, c, b] } else { [a, b, c] }
        }));
    }
    (vertices, triangles, normals)
}

#[test]
fn dequantize_keeps_creases_that_normals_mark() {
    let (truth, triangles, normals) = ridge();
    let (on_lattice, _) = quantized(&truth, 7);
    let mut loose = on_lattice.clone();
    dequantize(&mut loose, &triangles, &normals);
    // All 39 edges of the crease keep most of their turn.
    let turned = |of: &[DVec3], least: f64| sharp_edge_count(of, &triangles, least);
    assert_eq!([turned(&truth, 59.9), turned(&truth, 1.0)], [39, 39]);
    assert!(turned(&loose, 45.0) >= 37, "{}", turned(&loose, 45.0));
    assert!(turned(&on_lattice, 20.0) > 400 && turned(&loose, 20.0) < 120);
}

/// Bar with a bevelled corner: two strips, six steps wide each, that turn by 45 degrees, not aligned with the
/// axes.
fn bevel() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (along, up) = (DVec3::new(0.8, 0.53, 0.28).normalize(), DVec3::new(-0.2, -0.22, 0.95));
    let up = (up - along * along.dot(up)).normalize();
    let mut profile = vec![(0.0, 0.0)];
    for (length, degrees) in [(90.0, 0.0), (6.0, -22.5), (6.0, -67.5), (90.0, -90.0f64)] {
        let (x, y) = profile[profile.len() - 1];
        let turn = degrees.to_radians();
        profile.push((x + length * cos(turn), y + length * sin(turn)));
    }
    let at = |k: u32| {
        let (x, y) = profile[k as usize % 5];
        along * f64::from(k / 5 * 40) + along.cross(up) * x + up * y
    };
    ((0..5 * 20).map(at).collect(), grid_triangles(20, 5, false))
}

#[test]
fn dequantize_keeps_the_middle_edge_of_a_narrow_bevel() {
    let (truth, triangles) = bevel();
    let (on_lattice, step) = quantized(&truth, 10);
    assert!((0.5..1.0).contains(&step));
    let mut loose = on_lattice.clone();
    dequantize(&mut loose, &triangles, &[]);
    let moves = |row: usize| (0..20).any(|k| loose[5 * k + row] != on_lattice[5 * k + row]);
    assert_eq!([0, 1, 2, 3, 4].map(moves), [false, false, true, false, false]);
    assert_eq!(sharp_edge_count(&truth, &triangles, 40.0), 19);
    assert!(
        sharp_edge_count(&loose, &triangles, 35.0) >= 17,
        "{}",
        sharp_edge_count(&loose, &triangles, 35.0)
    );
}

#[test]
fn dequantize_keeps_coincident_vertices_together() {
    let (truth, triangles) = torus(120, 40);
    // Each face has separate corners.
    let (on_lattice, _) = quantized(&truth, 7);
    let corners: Vec<DVec3> = triangles.as_flattened().iter().map(|v| on_lattice[*v as usize]).collect();
    let own: Vec<[u32; 3]> = (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let mut apart = corners;
    dequantize(&mut apart, &own, &[]);
    let mut shared = on_lattice;
    dequantize(&mut shared, &triangles, &[]);
    let same = triangles.as_flattened().iter().zip(&apart).all(|(v, p)| {
        // The order of positions differs, and with it the rounding of sums.
        shared[*v as usize].abs_diff_eq(*p, 1e-5)
    });
    assert!(same);
    let mut at: std::collections::HashMap<u32, DVec3> = std::collections::HashMap::new();
    let one = triangles.as_flattened().iter().zip(&apart).all(|(v, p)| *at.entry(*v).or_insert(*p) == *p);
    assert!(one, "corners of one place came apart");
}

/// Reference: moves one vertex after the other to its minimum, repeatedly.
fn coordinate_descent(hinges: &[super::hinges::Hinge], free: &[bool]) -> Vec<glam::DVec3> {
    let mut moved = vec![DVec3::ZERO; free.len()];
    let gap = |hinge: &super::hinges::Hinge, moved: &[DVec3]| {
        let shares = hinge.corner_coefficients().map(f64::from);
        hinge
            .corners
            .iter()
            .zip(shares)
            .fold(hinge.gap.as_dvec3(), |gap, (v, share)| gap + moved[*v as usize] * share)
    };
    for _ in 0..400 {
        for v in (0..free.len()).filter(|v| free[*v]) {
            let (mut slope, mut steep) = (DVec3::ZERO, 0.0);
            for hinge in hinges {
                for (corner, share) in hinge.corners.iter().zip(hinge.corner_coefficients()) {
                    if *corner as usize == v {
                        let (share, weight) = (f64::from(share), f64::from(hinge.weight));
                        slope += gap(hinge, &moved) * share * weight;
                        steep += share * share * weight;
                    }
                }
            }
            if steep > 0.0 {
                moved[v] = (moved[v] - slope / steep).clamp(DVec3::NEG_ONE, DVec3::ONE);
            }
        }
    }
    moved
}

fn bending_energy(hinges: &[super::hinges::Hinge], moved: impl Fn(u32) -> DVec3) -> f64 {
    let square = |hinge: &super::hinges::Hinge| {
        let shares = hinge.corner_coefficients().map(f64::from);
        let gap = hinge.corners.iter().zip(shares);
        let gap = gap.fold(hinge.gap.as_dvec3(), |gap, (v, share)| gap + moved(*v) * share);
        f64::from(hinge.weight) * gap.length_squared()
    };
    hinges.iter().map(square).sum()
}

#[test]
fn least_bending_descent_approaches_the_minimum() {
    let (truth, triangles) = torus(16, 8);
    let (places, step) = quantized(&truth, 5);
    let doubts = FaceTilts::of(&places, &triangles, step / 2.0);
    let free = doubts.movable_positions(&triangles, places.len());
    assert!(free.iter().all(|free| *free));
    let edges = Edges::build(places.len(), &triangles);
    let hinges = hinges(&places, (&triangles, &edges), &doubts, (&triangles, &[]), &free);
    assert_eq!(hinges.len(), edges.len());
    let least = coordinate_descent(&hinges, &free);
    let least = bending_energy(&hinges, |v| least[v as usize]);
    let before = bending_energy(&hinges, |_| DVec3::ZERO);
    let left = |steps: usize| {
        let found = least_bending(&hinges, &free, steps);
        (bending_energy(&hinges, |v| found[v as usize].as_dvec3()) - least) / (before - least)
    };
    assert!(
        left(1000).abs() < 1e-3 && left(MAX_DESCENT_STEPS) < 1.0 / 6.0,
        "{} {}",
        left(1000),
        left(MAX_DESCENT_STEPS)
    );
}

#[test]
fn dequantize_does_not_depend_on_the_number_of_threads() {
    let (truth, triangles) = torus(200, 60);
    let on_lattice = quantized(&truth, 8).0;
    let with = |threads: usize| {
        let pool = rayon_core::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let mut loose = on_lattice.clone();
        pool.install(|| dequantize(&mut loose, &triangles, &[]));
        loose
    };
    assert_eq!(with(1), with(5));
}

#[test]
fn dequantize_leaves_invalid_input_unchanged() {
    let on = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(f64::NAN, 0.0, 0.0)];
    for count in 0..4 {
        let mut vertices = on[..count].to_vec();
        dequantize(&mut vertices, &[[0, 1, 2], [2, 1, 7]], &[]);
        assert_eq!(vertices, on[..count]);
    }
    let mut vertices = on.to_vec();
    dequantize(&mut vertices, &[[0, 1, 2]], &[[0.0; 3]; 2]);
    assert_eq!(vertices[..3], on[..3]);
}

#[test]
fn a_lattice_of_ten_bits_is_found_and_others_are_not() {
    let on = |i: u32| DVec3::new(f64::from(i * 7 % 1024), f64::from(i * 5 % 256), 3.0) / 1023.0;
    let vertices: Vec<DVec3> = (0..1024).map(on).collect();
    let step = QuantizationLattice::of(&vertices).map(|lattice| lattice.step);
    assert!(step.is_some_and(|step| (step - 1.0 / 1023.0).abs() < 1e-12));
    let off: Vec<DVec3> = vertices.iter().map(|p| *p * p.x).collect();
    assert_eq!(QuantizationLattice::of(&off), None);
}
