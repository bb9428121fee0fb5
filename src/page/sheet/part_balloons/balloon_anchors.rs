//! [`find_anchors`]: for each item of the parts list, a point where it is visible in a view.
//!
//! The view is rasterised with a face id per pixel. A two-pass city-block distance transform gives the depth
//! of each pixel inside the visible area of its part. The deepest pixel is the anchor.

use kurbo::Point;

use crate::mesh::Mesh;
use crate::page::sheet::parts_list::parts_list_items::PartsListItem;
use crate::page::sheet::view::sheet_view::SheetView;
use crate::scene::Scene;
use crate::view::View;
use crate::view::raster::{FaceBuffer, PixelGrid};

/// Pixels along the longer side of the rasterised view.
const LONGER_SIDE_PX: f64 = 700.0;

/// For each item a point on the page, well inside the visible area of its most visible part; `None` if no
/// part is visible.
pub(crate) fn find_anchors(sight: &SheetView, scene: &Scene, items: &[PartsListItem]) -> Vec<Option<Point>> {
    let mesh = Mesh::build(scene.to_soup());
    let camera = sight.view_camera();
    let view = View::new(&mesh, &camera);
    let screen = PixelGrid::of_side(&mesh, &view, LONGER_SIDE_PX);
    let buffer = FaceBuffer::new(&screen);
    let (columns, rows) = (screen.columns, screen.rows);
    let part = |pixel: usize| buffer.front(pixel).map(|face| mesh.face_part[face as usize].index());
    let seen: Vec<Option<usize>> = (0..columns * rows).map(part).collect();
    // City-block distance of each pixel to the border of the visible area of its part.
    let mut depth = vec![0_u32; seen.len()];
    let beside = |k: usize, back: bool| {
        let (x, y) = (k % columns, k / columns);
        match back {
            false if x > 0 && y > 0 => Some([k - 1, k - columns]),
            true if x + 1 < columns && y + 1 < rows => Some([k + 1, k + columns]),
            _ => None,
        }
    };
    for back in [false, true] {
        for n in 0..seen.len() {
            let k = if back { seen.len() - 1 - n } else { n };
            let near = beside(k, back).map_or(0, |near| {
                let own = near.iter().map(|near| if seen[*near] == seen[k] { depth[*near] + 1 } else { 1 });
                own.min().unwrap_or(1)
            });
            depth[k] = if back { depth[k].min(near) } else { near };
        }
    }
    let mut counts = vec![0_usize; scene.parts.len()];
    let mut deepest: Vec<Option<usize>> = vec![None; scene.parts.len()];
    for (k, part) in seen.iter().enumerate() {
        let Some(part) = *part else { continue };
        counts[part] += 1;
        if deepest[part].is_none_or(|other| depth[other] < depth[k]) {
            deepest[part] = Some(k);
        }
    }
    let of = |item: &PartsListItem| {
        let best = item.parts.iter().copied().max_by(|a, b| counts[*a].cmp(&counts[*b]).then(b.cmp(a)))?;
        let pixel = deepest[best]?;
        let at = Point::new((pixel % columns) as f64 + 0.5, (pixel / columns) as f64 + 0.5);
        Some(sight.frame_to_page() * (at.to_vec2() / screen.scale()).to_point())
    };
    items.iter().map(of).collect()
}
