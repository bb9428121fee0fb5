//! [`TileSegments`]: the parts of all segments in each tile, except those behind the occlusion buffer.

use crate::parallel::prelude::*;

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists_from_pairs};
use crate::lines::Role;
use crate::visibility::culling::occlusion_buffer::OcclusionBuffer;
use crate::visibility::occlusion::occlusion_input::TileSegment;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::tiles::tile_grid::TileGrid;

/// Segments per task.
const SEGMENTS_PER_TASK: usize = 1 << 10;

/// Parts of all segments whose visibility is computed.
#[derive(Debug)]
pub(crate) struct TileSegments {
    /// Parts that must be compared with triangles, by tile.
    pub open: CsrLists<TileSegment>,
    /// Parts behind the occlusion buffer; a single one for a segment that is entirely behind it.
    pub behind_buffer: Vec<TileSegment>,
}

/// Parts of the segments of one task; open parts come with their tiles.
#[derive(Default)]
struct TraversedSegments {
    open: Vec<(u32, TileSegment)>,
    behind_buffer: Vec<TileSegment>,
}

impl TileSegments {
    /// Splits all segments at tile borders. Smooth contours are skipped, because they take their visibility
    /// from the mesh contour.
    pub(crate) fn new(segments: &[ImageSegment], grid: &TileGrid, covers: &OcclusionBuffer) -> Self {
        let walked: Vec<TraversedSegments> = (0..segments.len().div_ceil(SEGMENTS_PER_TASK))
            .into_par_iter()
            .with_max_len(1)
            .map(|k| {
                walked(
                    segments,
                    k * SEGMENTS_PER_TASK..((k + 1) * SEGMENTS_PER_TASK).min(segments.len()),
                    grid,
                    covers,
                )
            })
            .collect();
        let pairs = walked.iter().flat_map(|walked| &walked.open).map(|(tile, item)| (*tile as usize, *item));
        let open = csr_lists_from_pairs(grid.len(), pairs);
        let buried = walked.iter().flat_map(|walked| &walked.behind_buffer).copied().collect();
        Self { open, behind_buffer: buried }
    }
}

fn walked(
    segments: &[ImageSegment],
    some: std::ops::Range<usize>,
    grid: &TileGrid,
    covers: &OcclusionBuffer,
) -> TraversedSegments {
    let TraversedSegments { mut open, behind_buffer: mut buried } = TraversedSegments::default();
    for (segment, s) in some.map(|k| (k as u32, &segments[k])).filter(|(_, s)| s.role != Role::SmoothContour)
    {
        let before = (open.len(), buried.len());
        grid.walk(s.a, s.b, |tile, start, end| {
            let item = TileSegment { segment, start, end };
            if covers.hides_segment_part(s, tile, start, end) {
                buried.push(item);
            } else {
                open.push((tile as u32, item));
            }
        });
        if open.len() == before.0 && buried.len() > before.1 {
            buried.truncate(before.1);
            buried.push(TileSegment { segment, start: 0.0, end: 1.0 });
        }
    }
    TraversedSegments { open, behind_buffer: buried }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::geometry::numbers::noise::hash;
    use crate::mesh::{Mesh, Soup};
    use crate::scene::{Camera, UpAxis};
    use crate::view::View;
    use crate::visibility::occlusion::tiled_triangles::TiledTriangles;
    use crate::visibility::view_tolerances::ViewTolerances;

    const FRAME_SIDE: f64 = 200.0;

    fn random_unit(n: u64, axis: u64) -> f64 {
        hash(axis, &[n]) as f64 / u64::MAX as f64
    }

    /// Eight parallel plates, seen from the front.
    fn plates() -> (Mesh, View) {
        let mut soup = Soup::default();
        for plate in 0..8 {
            let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1), -0.1 * f64::from(plate));
            soup.positions.extend((0..4).map(corner));
            soup.triangles.extend([[0, 1, 3], [0, 3, 2]].map(|t: [u32; 3]| t.map(|v| v + 4 * plate)));
        }
        let mesh = Mesh::build(soup);
        let points: Vec<DVec3> = mesh.positions.iter().map(|p| *p + mesh.origin).collect();
        let view = View::new(
            &mesh,
            &Camera::azimuth_elevation(0.0, 0.0, UpAxis::Y)
                .with_frame(FRAME_SIDE, FRAME_SIDE)
                .fit_points(&points, 0.05),
        );
        (mesh, view)
    }

    /// Segments all over the page, with nearness between that of the farthest and of the nearest corner.
    fn segments(view: &View, count: u64) -> Vec<ImageSegment> {
        let depths = || view.points.iter().map(|p| p.z);
        let (far, near) =
            (depths().fold(f64::INFINITY, f64::min), depths().fold(f64::NEG_INFINITY, f64::max));
        let point = |n: u64| {
            DVec3::new(
                random_unit(n, 0) * FRAME_SIDE,
                random_unit(n, 1) * FRAME_SIDE,
                far + (near - far) * random_unit(n, 2),
            )
        };
        let segment = |n: u64| {
            let a = point(2 * n);
            ImageSegment {
                a,
                b: a + (point(2 * n + 1) - a) * random_unit(n, 3).powi(3),
                ends: [0; 2],
                cut: [false; 2],
                hosts: [u32::MAX; 2],
                source: n as u32,
                bounds: false,
                role: if n.is_multiple_of(10) { Role::SmoothContour } else { Role::Line },
            }
        };
        (0..count).map(segment).collect()
    }

    #[test]
    fn tile_segments_split_each_line_by_tile_and_occlusion_buffer() {
        let (mesh, view) = plates();
        let limits = ViewTolerances::new(&view.frame);
        let nearest = view.points.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
        let segments = segments(&view, 3 * SEGMENTS_PER_TASK as u64);
        let grid = TileGrid::new(DVec2::ZERO, DVec2::splat(FRAME_SIDE), 32);
        let found =
            OcclusionBuffer::find(&TiledTriangles { mesh: &mesh, view: &view, grid: &grid, limits: &limits });
        assert!(!found.is_empty());
        for covers in [OcclusionBuffer::none(&grid), found] {
            let TileSegments { open, behind_buffer: buried } = TileSegments::new(&segments, &grid, &covers);
            let mut parts = vec![0.0; segments.len()];
            for tile in 0..grid.len() {
                let mut last = 0;
                for item in open.of(tile) {
                    let s = &segments[item.segment as usize];
                    let middle = s.at((item.start + item.end) / 2.0);
                    assert_eq!(grid.tile(grid.column(middle.x), grid.row(middle.y)), tile);
                    assert!(item.segment >= last && s.role == Role::Line);
                    last = item.segment;
                    parts[item.segment as usize] += item.end - item.start;
                }
            }
            for item in &buried {
                let s = &segments[item.segment as usize];
                assert!(s.at(item.start).z.max(s.at(item.end).z) < nearest);
                parts[item.segment as usize] += item.end - item.start;
            }
            for (s, part) in segments.iter().zip(parts) {
                let wanted = f64::from(u8::from(s.role == Role::Line));
                assert!((part - wanted).abs() < 1e-9, "{part}");
            }
            // With covers, more than half of these lines are entirely hidden by them; without covers, none
            // are.
            let whole = buried.iter().filter(|item| (item.start, item.end) == (0.0, 1.0)).count();
            assert_eq!(whole > segments.len() / 2, !covers.is_empty(), "{whole} of {}", buried.len());
        }
    }
}
