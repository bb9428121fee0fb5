//! [`GapOcclusion`]: whether a straight gap between two lines passes behind a surface of another component.

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};
use kurbo::{Point, Vec2};

use crate::geometry::lists::csr_lists::csr_lists;
use crate::lines::{FeatureLines, NO_FACE, Role};
use crate::mesh::Mesh;
use crate::view::View;
use crate::visibility::contours::contour_matching::MAX_MATCH_DISTANCE_PX;
use crate::visibility::graph::VisibleContour;
use crate::visibility::occlusion::occlusion_input::TileSegment;
use crate::visibility::occlusion::tiled_triangles::{Occluder, TiledTriangles};
use crate::visibility::occlusion::triangle_occlusion::hidden_interval;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::tiles::aligned_grid::grid_over;
use crate::visibility::tolerances;
use crate::visibility::view_tolerances::ViewTolerances;

/// Tiles along the longer side of the grid for the lookup of triangles. Tiles are small because gaps are
/// short and every triangle of a tile is compared.
const TILES_ACROSS: u32 = 256;
/// Tiles per task.
const TILES_PER_TASK: usize = 8;
/// Marks an end of a gap, which is not a feature end.
const NO_END: u32 = u32::MAX;

/// Surfaces that may hide gaps between the lines of a view map.
#[derive(Debug)]
pub(crate) struct GapOcclusion<'a> {
    mesh: &'a Mesh,
    pieces: &'a [u32],
    view: &'a View,
    lines: &'a FeatureLines,
    visible_contours: &'a [VisibleContour],
    moved: Vec2,
}

/// Straight gap in the image between two points of lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GapSegment {
    /// Start and end, user units on the page.
    pub ends: [Point; 2],
    /// Depths of the ends along the optical axis, world units.
    pub depths: [f64; 2],
    /// Feature segments of the two lines.
    pub segments: [u32; 2],
}

impl<'a> GapOcclusion<'a> {
    /// Prepares queries against all surfaces of `mesh` in front of the `lines` of a view.
    ///
    /// `pieces` holds the connected component of each face, and is empty if there is only one. `visible_contours` lists
    /// the visible parts of the mesh contour. `moved` is the offset on the page applied to the view map since
    /// it was made, user units.
    #[must_use]
    pub(crate) fn new(
        (mesh, pieces): (&'a Mesh, &'a [u32]),
        view: &'a View,
        lines: &'a FeatureLines,
        contours: &'a [VisibleContour],
        moved: Vec2,
    ) -> Self {
        Self { mesh, pieces, view, lines, visible_contours: contours, moved }
    }

    /// Reports for each gap whether it passes behind a visible surface of another component than its two
    /// lines.
    ///
    /// Surfaces of the lines' own components do not count, nor surfaces behind those, nor surfaces that the
    /// gap touches. A surface in front of the gap does not count either where the mesh contour is visible
    /// next to the gap.
    #[must_use]
    pub(crate) fn occluded_gaps(&self, gaps: &[GapSegment]) -> Vec<bool> {
        if self.pieces.is_empty() || gaps.is_empty() {
            return vec![false; gaps.len()];
        }
        let Self { mesh, view, .. } = self;
        let limits = ViewTolerances::new(&view.frame);
        let segments: Vec<ImageSegment> = gaps.iter().map(|gap| self.image(gap)).collect();
        let own_pieces: Vec<[u32; 2]> =
            gaps.iter().map(|gap_segment| gap_segment.segments.map(|s| self.piece(s))).collect();
        let grid = grid_over(segments.iter(), TILES_ACROSS);
        let items = csr_lists(grid.len(), |put| {
            for (s, segment) in segments.iter().zip(0..) {
                grid.walk(s.a, s.b, |tile, start, end| put(tile, TileSegment { segment, start, end }));
            }
        });
        let triangles = TiledTriangles { mesh, view, grid: &grid, limits: &limits };
        // Gaps are few and short, so only the tiles they pass through are filled.
        let is_wanted = |tile: usize| !items.of(tile).is_empty();
        let wanted: Vec<usize> = (0..grid.len()).filter(|tile| is_wanted(*tile)).collect();
        let mut farthest = vec![f64::INFINITY; grid.len()];
        wanted.iter().for_each(|tile| farthest[*tile] = f64::NEG_INFINITY);
        let occluders = triangles.fill(triangles.tile_boxes(), &farthest);
        let reach = DVec2::splat(MAX_MATCH_DISTANCE_PX * limits.px);
        let contours_by_tile = csr_lists(grid.len(), |put| {
            for contour in self.visible_contours {
                let [a, b] = contour.ends;
                let tiles = grid.tile_box((a.min(b) - reach).extend(0.0), (a.max(b) + reach).extend(0.0));
                let of_contour = grid.tiles_of(tiles).map(|(tile, _)| tile);
                of_contour.filter(|tile| is_wanted(*tile)).for_each(|tile| put(tile, *contour));
            }
        });
        let found: Vec<Vec<u32>> = wanted
            .par_iter()
            .with_min_len(TILES_PER_TASK)
            .map(|&tile| {
                let boxed_occluders: Vec<BoxedOccluder> = occluders
                    .of(tile)
                    .iter()
                    .map(|id| BoxedOccluder::from(triangles.occluder(*id)))
                    .collect();
                let gap_tile = GapTile {
                    gap_occlusion: self,
                    limits: &limits,
                    occluders: &boxed_occluders,
                    visible_contours: contours_by_tile.of(tile),
                };
                let is_behind = |item: &&TileSegment| {
                    let gap_index = item.segment as usize;
                    gap_tile.occludes_gap_part(
                        &segments[gap_index],
                        (item.start, item.end),
                        own_pieces[gap_index],
                    )
                };
                items.of(tile).iter().filter(is_behind).map(|item| item.segment).collect()
            })
            .collect();
        let mut hidden = vec![false; gaps.len()];
        found.iter().flatten().for_each(|gap_id| hidden[*gap_id as usize] = true);
        hidden
    }

    fn piece(&self, segment: u32) -> u32 {
        let hosts = self.lines.segments.get(segment as usize).map_or([NO_FACE; 2], |s| s.hosts);
        self.pieces.get(hosts[0] as usize).copied().unwrap_or(u32::MAX)
    }

    fn image(&self, gap: &GapSegment) -> ImageSegment {
        let point = |k: usize| {
            let at = gap.ends[k] - self.moved;
            DVec3::new(at.x, at.y, self.view.frame.nearness_of(gap.depths[k]))
        };
        ImageSegment {
            a: point(0),
            b: point(1),
            ends: [NO_END; 2],
            cut: [false; 2],
            hosts: [NO_FACE; 2],
            source: NO_END,
            bounds: false,
            role: Role::Line,
        }
    }
}

/// Triangle with its bounding box in the image.
struct BoxedOccluder {
    occluder: Occluder,
    low: DVec2,
    high: DVec2,
}

impl From<Occluder> for BoxedOccluder {
    fn from(whole: Occluder) -> Self {
        let [a, b, c] = whole.corners.map(DVec3::truncate);
        Self { occluder: whole, low: a.min(b).min(c), high: a.max(b).max(c) }
    }
}

/// Triangles and contours around one tile of the image.
struct GapTile<'a> {
    gap_occlusion: &'a GapOcclusion<'a>,
    limits: &'a ViewTolerances,
    /// Triangles over the tile.
    occluders: &'a [BoxedOccluder],
    /// Visible parts of the mesh contour in the tile or within the match distance of it.
    visible_contours: &'a [VisibleContour],
}

impl GapTile<'_> {
    /// Whether a triangle of another component hides the part of a gap in the tile.
    fn occludes_gap_part(&self, gap: &ImageSegment, part: (f64, f64), own_pieces: [u32; 2]) -> bool {
        let Self { gap_occlusion: query, limits, occluders: boxes, .. } = self;
        let is_own = |boxed: &BoxedOccluder| own_pieces.contains(&query.pieces[boxed.occluder.face as usize]);
        let ends = [part.0, part.1].map(|t| gap.at(t).truncate());
        let (low, high) = (
            ends[0].min(ends[1]) - tolerances::BOX_MARGIN_UNITS,
            ends[0].max(ends[1]) + tolerances::BOX_MARGIN_UNITS,
        );
        let meets =
            |candidate: &&BoxedOccluder| candidate.low.cmple(high).all() && candidate.high.cmpge(low).all();
        boxes.iter().filter(meets).filter(|over| !is_own(over)).any(|hiding_box| {
            let hidden = hidden_interval(gap, part, &hiding_box.occluder, &query.view.frame, limits)
                .filter(|hidden| (hidden.end - hidden.start) * gap.length() > limits.piece);
            let Some(hidden) = hidden else { return false };
            let middle = gap.at((hidden.start + hidden.end) / 2.0).truncate();
            let nearness_of = |over: &BoxedOccluder| nearness(&over.occluder.corners, middle);
            let hiding_nearness = nearness_of(hiding_box);
            let is_covered =
                || boxes.iter().any(|own_box| is_own(own_box) && nearness_of(own_box) > hiding_nearness);
            !is_covered() && !self.is_contour_visible_near(gap, middle, own_pieces)
        })
    }

    /// Whether the mesh contour is visible next to a point of a gap.
    ///
    /// It is if the contour crosses the normal of the gap there, no farther away than a smooth contour may be
    /// from its mesh contour.
    fn is_contour_visible_near(&self, gap: &ImageSegment, at: DVec2, own_pieces: [u32; 2]) -> bool {
        let along = (gap.b - gap.a).truncate();
        let across = along.perp().normalize_or_zero();
        self.visible_contours.iter().any(|contour| {
            let [from, to] = contour.ends.map(|end| end - at);
            let (before, behind) = (from.dot(along), to.dot(along));
            let crosses = before * behind <= 0.0 && before != behind;
            let away = || from.lerp(to, before / (before - behind)).dot(across).abs();
            crosses
                && away() <= MAX_MATCH_DISTANCE_PX * self.limits.px
                && own_pieces.contains(&self.gap_occlusion.piece(contour.segment))
        })
    }
}

/// Nearness of a triangle at a point of the image; `None` outside the triangle.
fn nearness([a, b, c]: &[DVec3; 3], point: DVec2) -> Option<f64> {
    let (u, v, p) = ((*b - *a).truncate(), (*c - *a).truncate(), point - a.truncate());
    let area = u.perp_dot(v);
    let (s, t) = (p.perp_dot(v) / area, u.perp_dot(p) / area);
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0).then_some(a.z + s * (b.z - a.z) + t * (c.z - a.z))
}
