//! Bicubic Bézier patches, welded into a triangle mesh with normals.

use glam::DVec3;

use super::solid::Solid;

/// Sixteen control points of a patch, row by row.
pub type Net = [[DVec3; 4]; 4];

/// Cubic Bernstein polynomials and their derivatives.
fn bernstein(t: f64) -> ([f64; 4], [f64; 4]) {
    let s = 1.0 - t;
    (
        [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t],
        [-3.0 * s * s, 3.0 * s * s - 6.0 * s * t, 6.0 * s * t - 3.0 * t * t, 3.0 * t * t],
    )
}

/// Point and unnormalised normal at `u` along the rows and `v` down the columns. The normal is zero at a
/// pole.
fn evaluate(net: &Net, u: f64, v: f64) -> (DVec3, DVec3) {
    let (across, across_slope) = bernstein(u);
    let (down, down_slope) = bernstein(v);
    let blend = |rows: &[f64; 4], columns: &[f64; 4]| -> DVec3 {
        (0..4).flat_map(|i| (0..4).map(move |j| rows[i] * columns[j] * net[i][j])).sum()
    };
    (blend(&down, &across), blend(&down, &across_slope).cross(blend(&down_slope, &across)))
}

/// Mesh of patches with `steps` segments per side, facing along the normals of the patches. Coincident points
/// are welded, and their normals averaged.
pub fn mesh(nets: &[Net], steps: usize) -> (Solid, Vec<DVec3>) {
    let mut soup = Solid::default();
    for net in nets {
        let rows: Vec<Vec<u32>> = (0..=steps)
            .map(|i| {
                let v = i as f64 / steps as f64;
                soup.ring((0..=steps).map(|j| evaluate(net, j as f64 / steps as f64, v).0))
            })
            .collect();
        for i in 0..steps {
            for j in 0..steps {
                let (a, b) = (rows[i][j], rows[i][j + 1]);
                let (c, d) = (rows[i + 1][j + 1], rows[i + 1][j]);
                // The diagonal is mirrored at the centre of the patch, so mirrored halves of the pot have
                // mirrored triangles.
                let pair = if (2 * j < steps) == (2 * i < steps) {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, b, d], [b, c, d]]
                };
                soup.faces.extend(pair.map(|triangle| triangle.to_vec()));
            }
        }
    }
    let mut solid = soup.welded(1e-6);
    // At a pole a row of the patch is a single point, so every second triangle there is degenerate.
    solid.faces.retain(|face| face[0] != face[1] && face[1] != face[2] && face[2] != face[0]);
    let mut normals = vec![DVec3::ZERO; solid.points.len()];
    for face in &solid.faces {
        let [a, b, c] = [0, 1, 2].map(|k| solid.points[face[k] as usize]);
        for (here, ahead, back) in [(0, b - a, c - a), (1, c - b, a - b), (2, a - c, b - c)] {
            let angle = libm::acos(ahead.normalize().dot(back.normalize()).clamp(-1.0, 1.0));
            normals[face[here] as usize] += angle * ahead.cross(back).normalize();
        }
    }
    let exact = exact_normals(nets, steps, &solid);
    let normals =
        normals.iter().zip(exact).map(|(rough, exact)| exact.unwrap_or(rough.normalize())).collect();
    (solid, normals)
}

/// Exact normals of the patches at the points of the mesh; none at poles.
fn exact_normals(nets: &[Net], steps: usize, solid: &Solid) -> Vec<Option<DVec3>> {
    let key = |point: DVec3| (point / 1e-6).round().to_array().map(|value| value as i64);
    let places: std::collections::BTreeMap<_, _> =
        solid.points.iter().enumerate().map(|(id, point)| (key(*point), id)).collect();
    let mut sums = vec![DVec3::ZERO; solid.points.len()];
    for net in nets {
        for (i, j) in (0..=steps).flat_map(|i| (0..=steps).map(move |j| (i, j))) {
            let (point, normal) = evaluate(net, j as f64 / steps as f64, i as f64 / steps as f64);
            if let (Some(&id), true) = (places.get(&key(point)), normal.length() > 1e-9) {
                sums[id] += normal.normalize();
            }
        }
    }
    sums.into_iter().map(DVec3::try_normalize).collect()
}
