//! Receivers of the shadow of an edge: of all faces behind it, the nearest to the light.
//!
//! In the light's image space edges are straight and faces flat. So a face is behind an edge over an interval
//! of the edge's parameter, with computed ends, and its nearness is linear there. The nearest of several
//! faces is their upper envelope ([`super::upper_envelope`]).

use crate::parallel::prelude::*;
use glam::DVec3;

use super::cast_edges::{self, CastEdge};
use super::light_views::LightView;
use super::upper_envelope::{EdgePart, ReceiverCandidate, envelope};
use crate::geometry::lists::csr_lists::csr_lists;
use crate::lines::Surface;
use crate::mesh::Mesh;
use crate::view::View;
use crate::visibility::occlusion::tiled_triangles::{Occluder, OccluderBounds, TiledTriangles};
use crate::visibility::occlusion::triangle_occlusion::covered;
use crate::visibility::tiles::tile_grid::TileGrid;
use crate::visibility::view_tolerances::ViewTolerances;

/// Largest number of tiles across the image.
const MAX_TILES_ACROSS: u32 = 512;

/// Tiles per task. Fixed, so the result does not depend on the number of threads.
const TILES_PER_TASK: usize = 32;

/// Shadow borders in one view of a light.
pub(crate) struct ShadowBorders<'a> {
    pub light: &'a LightView,
    /// Edges that cast the shadows.
    pub edges: Vec<CastEdge>,
    /// Parts of each edge, with the faces that receive their shadow.
    pub runs: Vec<Vec<EdgePart>>,
}

/// Part of an edge in one tile.
#[derive(Debug, Clone, Copy)]
struct TileEdge {
    edge: u32,
    start: f64,
    end: f64,
}

/// Computes all shadow borders in one view of a light.
pub(crate) fn borders<'a>(surface: &Surface, light: &'a LightView) -> ShadowBorders<'a> {
    let Surface { mesh, .. } = surface;
    let edges = cast_edges::edges(surface, light);
    let candidates = candidates(mesh, &light.view, &edges);
    let limits = ViewTolerances::new(&light.view.frame);
    let first = |k: usize| candidates.partition_point(|(edge, _)| (*edge as usize) < k);
    let runs = (0..edges.len())
        .into_par_iter()
        .with_min_len(64)
        .map(|k| {
            let length = (edges[k].b - edges[k].a).truncate().length();
            let of_edge: Vec<ReceiverCandidate> =
                candidates[first(k)..first(k + 1)].iter().map(|(_, candidate)| *candidate).collect();
            envelope(of_edge, limits.piece / length.max(limits.piece))
        })
        .collect();
    ShadowBorders { light, edges, runs }
}

/// Faces that may receive the shadow of each edge, in the order of the edges.
fn candidates(mesh: &Mesh, view: &View, edges: &[CastEdge]) -> Vec<(u32, ReceiverCandidate)> {
    let Some(first) = edges.first() else { return Vec::new() };
    let limits = &ViewTolerances::new(&view.frame);
    let bounds = (first.a.truncate(), first.a.truncate());
    let (low, high) = edges.iter().fold(bounds, |(low, high), edge| {
        let (a, b) = (edge.a.truncate(), edge.b.truncate());
        (low.min(a).min(b), high.max(a).max(b))
    });
    let across = ((mesh.triangles.len() as f64).sqrt() / 2.0) as u32;
    let grid = &TileGrid::new(low, high, across.clamp(8, MAX_TILES_ACROSS));
    let items = csr_lists(grid.len(), |put| {
        for (k, edge) in edges.iter().enumerate() {
            grid.walk(edge.a, edge.b, |tile, start, end| put(tile, TileEdge { edge: k as u32, start, end }));
        }
    });
    let triangles = TiledTriangles { mesh, view, grid, limits };
    let boxes = triangles.tile_boxes();
    let faces = csr_lists(grid.len(), |put| {
        for (id, tiles) in boxes.iter().enumerate().filter(|(_, tiles)| !tiles.is_empty()) {
            for (tile, _) in grid.tiles_of(*tiles) {
                if !items.of(tile).is_empty() {
                    put(tile, id as u32);
                }
            }
        }
    });
    drop(boxes);
    let found: Vec<Vec<(u32, ReceiverCandidate)>> = (0..grid.len().div_ceil(TILES_PER_TASK))
        .into_par_iter()
        .map(|task| {
            let mut found = Vec::new();
            for tile in task * TILES_PER_TASK..((task + 1) * TILES_PER_TASK).min(grid.len()) {
                let (items, ids) = (items.of(tile), faces.of(tile));
                if items.is_empty() || ids.is_empty() {
                    continue;
                }
                let all: Vec<(OccluderBounds, Occluder)> =
                    ids.iter().map(|id| (triangles.reach(*id), triangles.occluder(*id))).collect();
                for item in items.iter().filter(|item| item.end > item.start) {
                    let tester = ReceiverTest { view, limits, edge: &edges[item.edge as usize] };
                    tester.gather(item, &all, &mut found);
                }
            }
            found
        })
        .collect();
    let mut found = found.concat();
    found.sort_by(|(edge, a), (other, b)| edge.cmp(other).then(a.start.total_cmp(&b.start)));
    found
}

/// Edge that is compared with faces.
struct ReceiverTest<'a> {
    view: &'a View,
    limits: &'a ViewTolerances,
    edge: &'a CastEdge,
}

impl ReceiverTest<'_> {
    /// Adds the faces of a tile that may receive the shadow of a part of the edge.
    fn gather(
        &self,
        item: &TileEdge,
        faces: &[(OccluderBounds, Occluder)],
        found: &mut Vec<(u32, ReceiverCandidate)>,
    ) {
        let edge = self.edge;
        let (p, q) = (edge.at(item.start), edge.at(item.end));
        let (low, high) = (p.min(q) - self.limits.side_offset, p.max(q) + self.limits.side_offset);
        for (reach, face) in faces {
            let b = reach.bounds.map(f64::from);
            if b[0] > high.x || b[1] < low.x || b[2] > high.y || b[3] < low.y {
                continue;
            }
            let shared = edge.vertices.map(|v| face.ids.iter().position(|id| *id == v));
            if edge.hosts.contains(&face.face) || shared.iter().all(Option::is_some) {
                continue;
            }
            self.receive(item, face, shared, |candidate| found.push((item.edge, candidate)));
        }
    }

    /// Reports the parts where a face lies behind the edge, or touches it on its outer side.
    fn receive(
        &self,
        item: &TileEdge,
        face: &Occluder,
        shared: [Option<usize>; 2],
        mut push: impl FnMut(ReceiverCandidate),
    ) {
        let edge = self.edge;
        let corners = &face.corners;
        let (p, q) = (edge.at(item.start).truncate(), edge.at(item.end).truncate());
        let at = |t: f64| if t >= 1.0 { item.end } else { item.start + (item.end - item.start) * t };
        let neighbour = shared[0].is_some() || shared[1].is_some();
        let nearness = |t: f64| nearness(corners, edge.at(t), shared[0].or(shared[1]).unwrap_or(0));
        // Difference in nearness between the edge and the face behind it.
        let depth = |t: f64| edge.at(t).z - nearness(t);
        let step = |q: f64| self.limits.step(q, &face.slack, neighbour, &self.view.frame);
        let is_behind = |t: f64| depth(t) > step(edge.at(t).z);
        let candidate = |start: f64, end: f64, touches: bool| ReceiverCandidate {
            face: face.face,
            start,
            end,
            nearness: [nearness(start), nearness(end)],
            touches,
        };
        // Part of an interval where the face is farther or, without `behind`, nearer. Touching is no reason
        // to cut.
        let part = |start: f64, end: f64, behind: bool| {
            let [at_start, at_end] = [start, end].map(|t| if behind { depth(t) } else { -depth(t) });
            let crossing = start + (end - start) * (at_start / (at_start - at_end));
            (if at_start >= 0.0 { start } else { crossing }, if at_end >= 0.0 { end } else { crossing })
        };
        if let Some((start, end)) = covered(p, q, corners, self.limits) {
            let (start, end) = (at(start), at(end));
            if is_behind(start) || is_behind(end) {
                let (start, end) = part(start, end, true);
                push(candidate(start, end, false));
            }
        }
        if neighbour {
            return;
        }
        // A surface that the edge lies on receives no shadow from it, and hides everything behind.
        let shift = edge.outward * self.limits.side_offset;
        let Some((start, end)) = covered(p + shift, q + shift, corners, self.limits) else { return };
        let (start, end) = (at(start), at(end));
        match (is_behind(start), is_behind(end)) {
            (true, true) => {}
            (false, false) => push(candidate(start, end, true)),
            _ => {
                let (start, end) = part(start, end, false);
                push(candidate(start, end, true));
            }
        }
    }
}

/// Nearness of the plane of a triangle at a point of the image, clamped to the triangle's own range because
/// steep triangles extrapolate badly. Measured from corner `base`, where it is exact.
pub(crate) fn nearness(corners: &[DVec3; 3], at: DVec3, base: usize) -> f64 {
    let [a, b, c] = *corners;
    let (u, v) = (b - a, c - a);
    let area = u.truncate().perp_dot(v.truncate());
    let slope = glam::DVec2::new(u.z * v.y - v.z * u.y, v.z * u.x - u.z * v.x) / area;
    let plane = corners[base].z + slope.dot(at.truncate() - corners[base].truncate());
    plane.clamp(a.z.min(b.z).min(c.z), a.z.max(b.z).max(c.z))
}
