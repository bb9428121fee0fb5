//! [`texel_coverage`]: the visible surface area of each texel of a picture.

use glam::DVec2;

use super::texel_plane::TexelPlane;
use crate::scene::Scene;

/// Maximum texels visited one by one; the area of further triangles is spread over all texels.
const MAX_VISITED_TEXELS: usize = 1 << 26;

/// Surface area of each texel in world units; zero for texels that no triangle shows.
///
/// `triangles` are those that show the picture, as pairs of geometry (ascending) and triangle.
pub(crate) fn texel_coverage(scene: &Scene, triangles: &[[usize; 2]], texels: &TexelPlane) -> Vec<f32> {
    let count = texels.size[0] * texels.size[1];
    let mut shown = vec![0.0_f32; count];
    let mut everywhere = 0.0;
    let mut visits = 0;
    for part in &scene.parts {
        let Some(geometry) = scene.geometries.get(part.geometry) else { continue };
        let first = triangles.partition_point(|[own, _]| *own < part.geometry);
        let own = triangles[first..].iter().take_while(|[own, _]| *own == part.geometry);
        for triangle in own.map(|[_, triangle]| *triangle) {
            let Some(uvs) = geometry.corner_uvs.get(triangle) else { continue };
            let [a, b, c] = uvs.map(|uv| texels.place(*geometry.uvs.get(uv as usize)?));
            let (Some(a), Some(b), Some(c)) = (a, b, c) else { continue };
            let Some(area) = part.area_of(geometry, triangle) else { continue };
            let size = a.max(b).max(c) - a.min(b).min(c) + 2.0;
            let is_large = size.element_product() > 4.0 * count as f64;
            if is_large || visits > MAX_VISITED_TEXELS {
                everywhere += area;
                continue;
            }
            let spans = texel_spans([a, b, c]);
            let touched: i64 = spans.iter().map(|(_, first, last)| last - first + 1).sum();
            visits += touched as usize;
            let each = (area / touched.max(1) as f64) as f32;
            for (row, first, last) in spans {
                (first..=last).for_each(|column| shown[texels.index(column, row)] += each);
            }
        }
    }
    if everywhere > 0.0 {
        let each = (everywhere / count as f64) as f32;
        shown.iter_mut().for_each(|shown| *shown += each);
    }
    shown
}

/// Texels that influence a triangle under bilinear interpolation: row, first and last column.
fn texel_spans(corners: [DVec2; 3]) -> Vec<(i64, i64, i64)> {
    let [a, b, c] = corners;
    let (low, high) = (a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y));
    let rows = (low - 1.0).floor() as i64 + 1..=(high + 1.0).ceil() as i64 - 1;
    rows.filter_map(|row| {
        // Part of the triangle within one texel above and below the row.
        let (top, bottom) = (row as f64 - 1.0, row as f64 + 1.0);
        let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let (p, q) = if p.y <= q.y { (p, q) } else { (q, p) };
            if p.y > bottom || q.y < top {
                continue;
            }
            let at = |y: f64| {
                if q.y > p.y { p.x + (q.x - p.x) * ((y - p.y) / (q.y - p.y)).clamp(0.0, 1.0) } else { p.x }
            };
            let ends = if q.y > p.y { [at(top), at(bottom)] } else { [p.x, q.x] };
            left = left.min(ends[0]).min(ends[1]);
            right = right.max(ends[0]).max(ends[1]);
        }
        (left <= right).then(|| (row, (left - 1.0).floor() as i64 + 1, (right + 1.0).ceil() as i64 - 1))
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texel_spans_cover_the_texels_around_a_triangle() {
        let at = |x: f64, y: f64| texel_spans([DVec2::new(x, y); 3]);
        assert_eq!(at(2.3, 4.6), [(4, 2, 3), (5, 2, 3)]);
        assert_eq!(at(2.0, 4.0), [(4, 2, 2)]);
        let triangle = texel_spans([DVec2::ZERO, DVec2::new(4.0, 0.0), DVec2::new(0.0, 4.0)]);
        assert_eq!(triangle, [(0, 0, 4), (1, 0, 4), (2, 0, 3), (3, 0, 2), (4, 0, 1)]);
    }
}
