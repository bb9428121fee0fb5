//! Plain Gouraud shading as the reference: vertices lit by one light, triangles rasterised with a depth
//! buffer.

use ligne::Camera;
use ligne::glam::{DVec3, Vec3};
use ligne::scene::Projection;

/// Picture of grey values, row by row.
pub fn shaded(positions: &[DVec3], triangles: &[[u32; 3]], camera: &Camera) -> Vec<f32> {
    let [right, up, forward] = camera.axes();
    let (width, height) = (camera.width as usize, camera.height as usize);
    let seen = |p: &DVec3| {
        let offset = *p - camera.eye;
        let depth = offset.dot(forward);
        let scale = match camera.projection {
            Projection::Perspective { fov_y_deg } => {
                camera.height / (2.0 * libm::tan(fov_y_deg.to_radians() / 2.0) * depth)
            }
            Projection::Orthographic { height } => camera.height / height,
        };
        let x = camera.width / 2.0 + offset.dot(right) * scale;
        Vec3::new(x as f32, (camera.height / 2.0 - offset.dot(up) * scale) as f32, -depth as f32)
    };
    let points: Vec<Vec3> = positions.iter().map(seen).collect();
    let mut normals = vec![DVec3::ZERO; positions.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|corner| positions[corner as usize]);
        let normal = (b - a).cross(c - a);
        triangle.iter().for_each(|corner| normals[*corner as usize] += normal);
    }
    let light = (up + right - forward).normalize();
    let greys: Vec<f32> =
        normals.iter().map(|normal| normal.normalize_or_zero().dot(light).max(0.0) as f32).collect();
    let mut depths = vec![f32::NEG_INFINITY; width * height];
    let mut picture = vec![1.0; width * height];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|corner| points[corner as usize]);
        let [i, j, k] = triangle.map(|corner| greys[corner as usize]);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let area = (b - a).truncate().perp_dot((c - a).truncate());
        if area == 0.0 || area.is_nan() {
            continue;
        }
        let columns = low.x.max(0.0) as usize..(high.x.ceil().max(0.0) as usize).min(width);
        for y in low.y.max(0.0) as usize..(high.y.ceil().max(0.0) as usize).min(height) {
            for x in columns.clone() {
                let at = Vec3::new(x as f32 + 0.5, y as f32 + 0.5, 0.0);
                let share = |p: Vec3, q: Vec3| (p - at).truncate().perp_dot((q - at).truncate()) / area;
                let (wa, wb, wc) = (share(b, c), share(c, a), share(a, b));
                let depth = wa * a.z + wb * b.z + wc * c.z;
                let cell = y * width + x;
                if wa >= 0.0 && wb >= 0.0 && wc >= 0.0 && depth > depths[cell] {
                    depths[cell] = depth;
                    picture[cell] = wa * i + wb * j + wc * k;
                }
            }
        }
    }
    picture
}
