//! [`Ahead`]: whether a straight way between two lines leads behind another surface than theirs.

use std::sync::OnceLock;

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};
use kurbo::{Point, Vec2};

use crate::geometry::lists::csr_lists::{grouped, grouped_pairs};
use crate::lines::{FeatureLines, NO_FACE, Role};
use crate::mesh::Mesh;
use crate::view::View;
use crate::visibility::contours::contour_matching::REACH_PX;
use crate::visibility::culling::triangle_blocks::NearTiles;
use crate::visibility::graph::SeenContour;
use crate::visibility::occlusion::occlusion_input::Item;
use crate::visibility::occlusion::tiled_triangles::{Occluder, Triangles};
use crate::visibility::occlusion::triangle_occlusion::hidden_interval;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::tiles::aligned_grid::grid_over;
use crate::visibility::tiles::tile_set::TileSet;
use crate::visibility::view_tolerances::Limits;

/// Tiles along the longer side of the grid that finds triangles: as small as ways are short, as all triangles of a tile are looked at.
const TILES: u32 = 256;
/// Tiles that one task looks at.
const TILES_PER_TASK: usize = 8;
/// A triangle whose box is farther than this (user units) from that of a way hides nothing of it, as with lines.
const BESIDE: f64 = 1e-4;
/// The end of a way is no feature end.
const NO_END: u32 = u32::MAX;

/// What may lie before the lines of a view map.
#[derive(Debug)]
pub struct Ahead<'a> {
    mesh: &'a Mesh,
    pieces: &'a [u32],
    view: &'a View,
    lines: &'a FeatureLines,
    seen: &'a [SeenContour],
    moved: Vec2,
    /// Made when the first ways are asked about.
    near: OnceLock<NearTiles>,
}

/// A straight way through the image between two points of lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Way {
    /// Where it begins and ends, user units on the page.
    pub ends: [Point; 2],
    /// Distances of these points from the eye along the optical axis, world units.
    pub depths: [f64; 2],
    /// Feature segments of the two lines.
    pub segments: [u32; 2],
}

impl<'a> Ahead<'a> {
    /// All surfaces of a `mesh` before the `lines` of a view of it. `pieces` says which connected piece each face is of, and is empty
    /// if there is but one; `seen` is what is seen of the contours of the polyhedron; the map of the lines has been `moved` by so much
    /// on the page since it was made, user units.
    #[must_use]
    pub fn new(
        (mesh, pieces): (&'a Mesh, &'a [u32]),
        view: &'a View,
        lines: &'a FeatureLines,
        seen: &'a [SeenContour],
        moved: Vec2,
    ) -> Self {
        Self { mesh, pieces, view, lines, seen, moved, near: OnceLock::new() }
    }

    /// Of each way, whether it leads behind a surface that is of another piece than the lines that it leads
    /// between, and that is seen there. What hides the way of the lines' own piece does not count, nor what
    /// lies behind that, nor what the way touches; nor what lies before the way where the polyhedron's contour
    /// is seen beside it.
    #[must_use]
    pub fn hides(&self, ways: &[Way]) -> Vec<bool> {
        if self.pieces.is_empty() || ways.is_empty() {
            return vec![false; ways.len()];
        }
        let Self { mesh, view, .. } = self;
        let limits = Limits::new(&view.frame);
        let segments: Vec<ImageSegment> = ways.iter().map(|way| self.image(way)).collect();
        let own: Vec<[u32; 2]> = ways.iter().map(|way| way.segments.map(|s| self.piece(s))).collect();
        let grid = grid_over(segments.iter(), TILES);
        // Ways are few and short: what lies in the tiles that they lead through is numbered by these alone.
        let mut items: Vec<(usize, Item)> = Vec::new();
        for (s, segment) in segments.iter().zip(0..) {
            grid.walk(s.a, s.b, |tile, start, end| items.push((tile, Item { segment, start, end })));
        }
        let wanted = TileSet::new(&grid, items.iter().map(|(tile, _)| *tile));
        let items =
            grouped_pairs(wanted.count(), items.iter().map(|(tile, item)| (wanted.number(*tile), *item)));
        let triangles = Triangles { mesh, view, grid: &grid, limits: &limits };
        let occluders = self.near(&limits).fill(&triangles, &wanted);
        let reach = DVec2::splat(REACH_PX * limits.px);
        let seen = grouped(wanted.count(), |put| {
            for seen in self.seen {
                let [a, b] = seen.ends;
                let tiles = grid.tile_box((a.min(b) - reach).extend(0.0), (a.max(b) + reach).extend(0.0));
                if !tiles.is_empty() && wanted.has_any(tiles) {
                    wanted.within(tiles).for_each(|number| put(number, *seen));
                }
            }
        });
        let found: Vec<Vec<u32>> = (0..wanted.count())
            .into_par_iter()
            .with_min_len(TILES_PER_TASK)
            .map(|tile| {
                let over: Vec<Over> =
                    occluders.of(tile).iter().map(|id| Over::from(triangles.occluder(*id))).collect();
                let around = Around { ahead: self, limits: &limits, over: &over, seen: seen.of(tile) };
                let is_behind = |item: &&Item| {
                    let way = item.segment as usize;
                    around.hides(&segments[way], (item.start, item.end), own[way])
                };
                items.of(tile).iter().filter(is_behind).map(|item| item.segment).collect()
            })
            .collect();
        let mut hidden = vec![false; ways.len()];
        found.iter().flatten().for_each(|way| hidden[*way as usize] = true);
        hidden
    }

    fn near(&self, limits: &Limits) -> &NearTiles {
        if let Some(near) = self.near.get() {
            return near;
        }
        // A task that waited here for another could be one that the other does meanwhile, and never end: rather is it made twice.
        let made = NearTiles::new(self.mesh, self.view, limits);
        self.near.get_or_init(|| made)
    }

    fn piece(&self, segment: u32) -> u32 {
        let hosts = self.lines.segments.get(segment as usize).map_or([NO_FACE; 2], |s| s.hosts);
        self.pieces.get(hosts[0] as usize).copied().unwrap_or(u32::MAX)
    }

    fn image(&self, way: &Way) -> ImageSegment {
        let point = |k: usize| {
            let at = way.ends[k] - self.moved;
            DVec3::new(at.x, at.y, self.view.frame.nearness_of(way.depths[k]))
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

/// A triangle and its box in the image.
struct Over {
    whole: Occluder,
    low: DVec2,
    high: DVec2,
}

impl From<Occluder> for Over {
    fn from(whole: Occluder) -> Self {
        let [a, b, c] = whole.corners.map(DVec3::truncate);
        Self { whole, low: a.min(b).min(c), high: a.max(b).max(c) }
    }
}

/// What is around a tile of the image.
struct Around<'a> {
    ahead: &'a Ahead<'a>,
    limits: &'a Limits,
    /// The triangles over the tile.
    over: &'a [Over],
    /// Contours of the polyhedron that are seen in it or beside it.
    seen: &'a [SeenContour],
}

impl Around<'_> {
    /// Whether something hides the part of a way in the tile that is of other pieces than its lines'.
    fn hides(&self, way: &ImageSegment, part: (f64, f64), own: [u32; 2]) -> bool {
        let Self { ahead, limits, over, .. } = self;
        let is_own = |over: &Over| own.contains(&ahead.pieces[over.whole.face as usize]);
        let ends = [part.0, part.1].map(|t| way.at(t).truncate());
        let (low, high) = (ends[0].min(ends[1]) - BESIDE, ends[0].max(ends[1]) + BESIDE);
        let meets = |over: &&Over| over.low.cmple(high).all() && over.high.cmpge(low).all();
        over.iter().filter(meets).filter(|over| !is_own(over)).any(|other| {
            let hidden = hidden_interval(way, part, &other.whole, &ahead.view.frame, limits)
                .filter(|hidden| (hidden.end - hidden.start) * way.length() > limits.piece);
            let Some(hidden) = hidden else { return false };
            let middle = way.at((hidden.start + hidden.end) / 2.0).truncate();
            let nearness_of = |over: &Over| nearness(&over.whole.corners, middle);
            let seen = nearness_of(other);
            let is_covered = || over.iter().any(|own| is_own(own) && nearness_of(own) > seen);
            !is_covered() && !self.is_seen_beside(way, middle, own)
        })
    }

    /// Whether a contour of the polyhedron is seen beside a point of a way: it crosses the line that is drawn
    /// there at a right angle to the way, as far to either side as a curve may lie from its contour.
    fn is_seen_beside(&self, way: &ImageSegment, at: DVec2, own: [u32; 2]) -> bool {
        let along = (way.b - way.a).truncate();
        let across = along.perp().normalize_or_zero();
        self.seen.iter().any(|seen| {
            let [from, to] = seen.ends.map(|end| end - at);
            let (before, behind) = (from.dot(along), to.dot(along));
            let crosses = before * behind <= 0.0 && before != behind;
            let away = || from.lerp(to, before / (before - behind)).dot(across).abs();
            crosses && away() <= REACH_PX * self.limits.px && own.contains(&self.ahead.piece(seen.segment))
        })
    }
}

/// Nearness of a triangle at a point of the image; none beside it.
fn nearness([a, b, c]: &[DVec3; 3], point: DVec2) -> Option<f64> {
    let (u, v, p) = ((*b - *a).truncate(), (*c - *a).truncate(), point - a.truncate());
    let area = u.perp_dot(v);
    let (s, t) = (p.perp_dot(v) / area, u.perp_dot(p) / area);
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0).then_some(a.z + s * (b.z - a.z) + t * (c.z - a.z))
}
