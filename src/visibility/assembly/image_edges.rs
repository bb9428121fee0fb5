//! Lines found in the image, added to the view map as visible lines.

use glam::{DVec2, DVec3};
use kurbo::Point;

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};
use crate::geometry::plane::planar_distance::segment_distance_squared;
use crate::lines::image::{ImageLinePiece, ImageLines, ImagePoint};
use crate::lines::{FeatureLines, FeatureSegment, LineKind};
use crate::mesh::Mesh;
use crate::surface::MeshSource;
use crate::view::View;
use crate::visibility::graph::{ViewEdge, ViewMap, ViewVertex, ViewVertexId, ViewVertexKind};
use crate::visibility::tiles::tile_grid::TileGrid;

/// Distance within which an image line duplicates a line of the surface, px of the frame.
const MAX_DUPLICATE_GAP_PX: f64 = 1.5;

/// Largest sampling step along image lines, px.
const SAMPLE_STEP_PX: f64 = 1.0;

/// Shortest remainder of an image line between lines of the surface that is kept, px.
const MIN_REMAINDER_PX: f64 = 6.0;

/// Adds image lines to a view map, and their segments to its feature lines.
///
/// With `drop_duplicates`, only those parts are added that have no visible line of the map next to them.
pub(crate) fn join(
    map: &mut ViewMap,
    lines: &mut FeatureLines,
    image: &ImageLines,
    mesh: &Mesh,
    view: &View,
    drop_duplicates: bool,
) {
    let remainder = drop_duplicates.then(|| rest(map, image, view));
    let image = remainder.as_ref().unwrap_or(image);
    let first_point = mesh.positions.len() + lines.points.len();
    let first_vertex = map.vertices.len() as u32;
    for ImagePoint { position, depth } in &image.points {
        let nearness = view.frame.nearness_of(*depth);
        lines.points.push(view.frame.local_from_image(position.extend(nearness)));
        map.vertices.push(ViewVertex {
            position: Point::new(position.x, position.y),
            depth: *depth,
            strength: 1.0,
            kind: ViewVertexKind::Vertex,
        });
    }
    for piece in &image.pieces {
        let [start, end] = piece.ends.map(|id| ViewVertexId(first_vertex + id));
        map.edges.push(ViewEdge {
            start,
            end,
            kind: LineKind::Image,
            invisibility: 0,
            silhouette: piece.silhouette,
            both_seen: piece.both_seen,
            smooth: true,
            origin: MeshSource::Constructed,
            strength: 180.0,
            part: piece.part,
            material: piece.material,
            segment: lines.segments.len() as u32,
        });
        let ends = piece.ends.map(|id| first_point as u32 + id);
        lines.segments.push(FeatureSegment {
            both_seen: piece.both_seen,
            smooth: true,
            origin: MeshSource::Constructed,
            ..FeatureSegment::without_faces(LineKind::Image, ends, piece.part, piece.material)
        });
    }
}

/// Parts of image lines without a visible line of the map next to them.
fn rest(map: &ViewMap, image: &ImageLines, view: &View) -> ImageLines {
    let px = view.frame.px();
    let drawn = VisibleLines::new(map, view);
    let mut remainder = ImageLines { lines: image.lines, ..ImageLines::default() };
    // Each continuous line is sampled in steps. Runs of steps without a line next to them are kept.
    for line in image.pieces.chunk_by(|a, b| a.line == b.line && a.ends[1] == b.ends[0]) {
        let mut steps: Vec<(ImagePoint, ImagePoint, ImageLinePiece)> = Vec::new();
        for piece in line {
            let [a, b] = piece.ends.map(|id| image.points[id as usize]);
            let count = (a.position.distance(b.position) / (SAMPLE_STEP_PX * px)).ceil().clamp(1.0, 1e4);
            for i in 0..count as usize {
                let at = |k: usize| {
                    let t = k as f64 / count;
                    ImagePoint {
                        position: a.position.lerp(b.position, t),
                        depth: a.depth + (b.depth - a.depth) * t,
                    }
                };
                steps.push((at(i), at(i + 1), *piece));
            }
        }
        let is_new: Vec<bool> = steps
            .iter()
            .map(|(a, b, _)| {
                drawn.distance2(a.position.midpoint(b.position)) > (MAX_DUPLICATE_GAP_PX * px).powi(2)
            })
            .collect();
        let mut at = 0;
        for run in is_new.chunk_by(|a, b| a == b) {
            let run_steps = &steps[at..at + run.len()];
            at += run.len();
            let length: f64 = run_steps.iter().map(|(a, b, _)| a.position.distance(b.position)).sum();
            if run[0] && length >= MIN_REMAINDER_PX * px {
                remainder.points.push(run_steps[0].0);
                for (_, to, piece) in run_steps {
                    let last = (remainder.points.len() - 1) as u32;
                    remainder.points.push(*to);
                    remainder.pieces.push(ImageLinePiece { ends: [last, last + 1], ..*piece });
                }
            }
        }
    }
    remainder
}

/// Visible lines of a map, in a grid for lookup by position.
struct VisibleLines {
    lines: Vec<[Point; 2]>,
    /// Lines that pass through or near each tile of the grid.
    tile_index: Option<(TileGrid, CsrLists<u32>)>,
}

impl VisibleLines {
    fn new(map: &ViewMap, view: &View) -> Self {
        let at = |id: ViewVertexId| map.vertices[id.index()].position;
        let lines: Vec<[Point; 2]> = map
            .edges
            .iter()
            .filter(|edge| edge.invisibility == 0)
            .map(|edge| [at(edge.start), at(edge.end)])
            .collect();
        if lines.is_empty() {
            return Self { lines, tile_index: None };
        }
        let (width, height) = (view.frame.width, view.frame.height);
        let across = (width.max(height) / (4.0 * MAX_DUPLICATE_GAP_PX * view.frame.px())) as u32;
        let grid = TileGrid::new(DVec2::ZERO, DVec2::new(width, height), across.clamp(16, 1024));
        let reach = MAX_DUPLICATE_GAP_PX * view.frame.px();
        let lines_by_tile = csr_lists(grid.len(), |put| {
            for (id, [a, b]) in lines.iter().enumerate() {
                for (dx, dy) in [(0.0, 0.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
                    let moved = |p: &Point| DVec3::new(p.x + dx * reach, p.y + dy * reach, 0.0);
                    grid.walk(moved(a), moved(b), |tile, _, _| put(tile, id as u32));
                }
            }
        });
        Self { lines, tile_index: Some((grid, lines_by_tile)) }
    }

    /// Squared distance to the nearest line; ∞ if none is within reach.
    fn distance2(&self, p: DVec2) -> f64 {
        let Some((grid, lines_by_tile)) = &self.tile_index else { return f64::INFINITY };
        let at = Point::new(p.x, p.y);
        let of = |id: &u32| {
            let [a, b] = self.lines[*id as usize];
            segment_distance_squared(at, a, b)
        };
        lines_by_tile
            .of(grid.tile(grid.column(p.x), grid.row(p.y)))
            .iter()
            .map(of)
            .fold(f64::INFINITY, f64::min)
    }
}
