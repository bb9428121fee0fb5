//! Seams: open edges that lie along each other without common corners are cut at each other's corners.
//!
//! CAD programs tessellate each surface separately, and merged voxels or solids have corners in the middle of
//! sides. A line there would belong to the mesh, not to the object.
//!
//! 1. Open edges of each part are collected.
//! 2. Corners of both sides that nearly coincide are joined.
//! 3. A side is cut at the corners of the other side that lie on it, within tolerance or within the sagitta
//!    of the curve that both sides approximate.
//!
//! Faces get more corners, but no vertex moves.

use crate::mesh::edges::triangle_sides::apex;
use crate::parallel::prelude::*;
use glam::DVec3;

use super::face_split::{FaceCuts, SideCut};
use super::open_edges::{OpenEdge, open_edges};
use super::sagitta::{MIN_SEAM_COSINE, SAGITTA_PER_TWIST, sagitta_height};
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};
use crate::geometry::space::bounds::{Bounds, SearchLine};
use crate::geometry::space::bounds_tree::BoundsTree;
use crate::mesh::soup::Soup;
use crate::mesh::tolerances;
use crate::mesh::{Edges, MeshMetrics, PartId};

/// Maximum number of corners on a border between two corners that both sides share.
const MAX_CORNERS_BETWEEN: usize = 64;

/// A corner that cuts a side must be this many times nearer to it than the face is high, and than to the ends
/// of the side.
const MIN_CLEARANCE_RATIO: f64 = 2.0;

/// Changes that close the seams.
#[derive(Default)]
pub(crate) struct SeamRepairs {
    /// For each vertex the one that replaces it, where corners of both sides differ only by the precision of
    /// the modelling program. Empty if nothing is replaced.
    pub joined: Vec<u32>,
    /// Faces to cut; empty while corners are to be joined.
    pub cuts: Vec<FaceCuts>,
}

/// Finds the seams of a soup. With `corners`, corners that coincide are joined first.
pub(crate) fn find(soup: &Soup, edges: &Edges, extents: &MeshMetrics, corners: bool) -> SeamRepairs {
    let open = open_edges(soup, edges);
    if open.len() < 2 {
        return SeamRepairs::default();
    }
    let seams = SeamSearch::new(soup, &open);
    let joined = if corners { seams.joined(edges, extents) } else { Vec::new() };
    let cuts = if joined.is_empty() { seams.all_cuts(extents) } else { Vec::new() };
    SeamRepairs { joined, cuts }
}

/// Open edges by corner, with the corners in a tree by position.
struct SeamSearch<'a> {
    soup: &'a Soup,
    open: &'a [OpenEdge],
    corners: Vec<u32>,
    /// Corner number of each vertex.
    numbers: Vec<u32>,
    /// The open edges at each corner.
    at: CsrLists<u32>,
    /// Positions of the corners.
    corner_tree: BoundsTree,
}

impl<'a> SeamSearch<'a> {
    fn new(soup: &'a Soup, open: &'a [OpenEdge]) -> Self {
        let mut corners: Vec<u32> = open.iter().flat_map(|edge| edge.ends).collect();
        corners.sort_unstable();
        corners.dedup();
        let mut numbers = vec![u32::MAX; soup.positions.len()];
        (0..).zip(&corners).for_each(|(number, v)| numbers[*v as usize] = number);
        let at = csr_lists(corners.len(), |put| {
            for (k, edge) in (0..).zip(open) {
                edge.ends.iter().for_each(|v| put(numbers[*v as usize] as usize, k));
            }
        });
        let places: Vec<Bounds> = corners.iter().map(|v| Bounds::of([soup.positions[*v as usize]])).collect();
        Self { soup, open, corners, numbers, at, corner_tree: BoundsTree::new(&places) }
    }

    fn place(&self, corner: u32) -> DVec3 {
        self.soup.positions[self.corners[corner as usize] as usize]
    }

    /// For each vertex the one that replaces it; empty if nothing changes.
    fn joined(&self, edges: &Edges, extents: &MeshMetrics) -> Vec<u32> {
        let mates: Vec<Option<u32>> = (0..self.corners.len() as u32)
            .into_par_iter()
            .with_min_len(256)
            .map(|corner| self.mate(corner, edges, extents))
            .collect();
        let mut joined: Vec<u32> = Vec::new();
        for (corner, mate) in (0..).zip(&mates) {
            let Some(mate) = mate.filter(|mate| corner < *mate && mates[*mate as usize] == Some(corner))
            else {
                continue;
            };
            if joined.is_empty() {
                joined = (0..self.soup.positions.len() as u32).collect();
            }
            joined[self.corners[mate as usize] as usize] = self.corners[corner as usize];
        }
        joined
    }

    /// All cuts, by face in ascending order.
    fn all_cuts(&self, extents: &MeshMetrics) -> Vec<FaceCuts> {
        let cuts: Vec<Vec<SideCut>> = (0..self.open.len())
            .into_par_iter()
            .with_min_len(256)
            .map(|edge| {
                self.cuts(edge, tolerances::MAX_SEAM_GAP_OF_PART * extents.part(self.open[edge].part).scale)
            })
            .collect();
        let mut faces: Vec<FaceCuts> = Vec::new();
        for (edge, cuts) in self.open.iter().zip(cuts).filter(|(_, cuts)| !cuts.is_empty()) {
            let mut sides: [Vec<SideCut>; 3] = Default::default();
            if let Some(side) =
                self.soup.triangles[edge.face as usize].iter().position(|v| *v == edge.ends[0])
            {
                sides[side] = cuts;
                faces.push((edge.face, sides));
            }
        }
        faces.sort_by_key(|(face, _)| *face);
        faces.dedup_by(|more, first| {
            let same = more.0 == first.0;
            if same {
                first.1.iter_mut().zip(&mut more.1).for_each(|(first_cuts, more)| first_cuts.append(more));
            }
            same
        });
        faces
    }

    /// The nearest corner on the other side of a seam, if it is within the seam tolerance.
    fn mate(&self, corner: u32, edges: &Edges, extents: &MeshMetrics) -> Option<u32> {
        // Corners shared between parts stay unchanged.
        let borders = |of: u32| {
            let edges = self.at.of(of as usize).iter().map(|k| &self.open[*k as usize]);
            edges.filter(|edge| !edge.is_shared)
        };
        let mut own_borders = borders(corner).peekable();
        own_borders.peek()?;
        let scale = own_borders.clone().map(|edge| extents.part(edge.part).scale).fold(0.0, f64::max);
        let (reach, position) = (tolerances::MAX_SEAM_GAP_OF_PART * scale, self.place(corner));
        let mut nearest: Option<(f64, u32)> = None;
        let nearby = SearchLine::new(position, DVec3::ZERO, 1.0, reach);
        for nearby_corner in self.corner_tree.near(|around| nearby.meets(around)) {
            let gap_length = self.place(nearby_corner).distance(position);
            let is_nearer = nearest
                .is_none_or(|(nearest_distance, at)| (gap_length, nearby_corner) < (nearest_distance, at));
            if nearby_corner != corner
                && gap_length <= reach
                && is_nearer
                && borders(nearby_corner).next().is_some()
            {
                nearest = Some((gap_length, nearby_corner));
            }
        }
        let (_, mate_corner) = nearest?;
        let [p, q] = [corner, mate_corner].map(|k| self.corners[k as usize]);
        // Corners connected by an edge lie on both sides of a narrow strip.
        let is_strip = edges.between(p, q).is_some();
        let meets = |a: &OpenEdge, b: &OpenEdge| {
            let end = usize::from(a.ends[1] == p);
            b.ends[1 - end] == q && a.faces_across(b) && a.matches_paint(end as f64, b.paint[1 - end])
        };
        (!is_strip && own_borders.any(|a| borders(mate_corner).any(|b| meets(a, b)))).then_some(mate_corner)
    }

    /// The corners that cut an open edge, in order along it.
    fn cuts(&self, edge: usize, min_gap: f64) -> Vec<SideCut> {
        let open_edge = &self.open[edge];
        let third = apex(self.soup.triangles[open_edge.face as usize], open_edge.ends);
        let start = self.soup.positions[open_edge.ends[0] as usize];
        let opposite = third.map_or(DVec3::ZERO, |v| self.soup.positions[v as usize] - start);
        let height = (opposite - open_edge.along * opposite.dot(open_edge.along)).length();
        // Seen from the opposite corner, a cut must lie between the ends of the side, so that no piece turns
        // over.
        let is_between = |offset: DVec3| {
            let [from, to, at] =
                [-opposite, open_edge.along * open_edge.length - opposite, offset - opposite];
            from.cross(at).dot(open_edge.normal) > 0.0 && at.cross(to).dot(open_edge.normal) > 0.0
        };
        // Where parts touch, all their vertices are on the edge, so no sagitta is needed.
        let sagitta = if open_edge.is_shared { DVec3::ZERO } else { self.sagitta(open_edge) };
        let reach = min_gap.max(sagitta.length()).min(height / MIN_CLEARANCE_RATIO);
        let max_aside = min_gap.max(sagitta.length() / SAGITTA_PER_TWIST);
        let mut cuts: Vec<SideCut> = Vec::new();
        if open_edge.length == 0.0 || reach == 0.0 {
            return cuts;
        }
        let side = SearchLine::new(start, open_edge.along * open_edge.length, 1.0, reach);
        for corner in self.corner_tree.near(|around| side.meets(around)) {
            let vertex = self.corners[corner as usize];
            let from_start = self.place(corner) - start;
            let along = from_start.dot(open_edge.along);
            let off = from_start - open_edge.along * along;
            let off_sagitta = off - off.project_onto_normalized(sagitta.normalize_or_zero());
            let off = off.length();
            let clear =
                along > MIN_CLEARANCE_RATIO * off && open_edge.length - along > MIN_CLEARANCE_RATIO * off;
            let is_own = open_edge.ends.contains(&vertex) || third == Some(vertex);
            if off <= reach
                && off_sagitta.length() <= max_aside
                && clear
                && !is_own
                && is_between(from_start)
                && self.has_seam_partner(open_edge, along / open_edge.length, corner)
            {
                cuts.push((along / open_edge.length, vertex));
            }
        }
        cuts.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        cuts.dedup_by_key(|cut| cut.1);
        cuts
    }

    /// Whether an open edge at this corner runs along the given edge, as the other side of a seam.
    fn has_seam_partner(&self, open_edge: &OpenEdge, t: f64, corner: u32) -> bool {
        let vertex = self.corners[corner as usize];
        self.at.of(corner as usize).iter().map(|k| &self.open[*k as usize]).any(|candidate| {
            open_edge.runs_against(candidate)
                && open_edge.matches_paint(t, candidate.paint[usize::from(candidate.ends[1] == vertex)])
                && (!open_edge.folds(candidate) || self.meets_on_both_sides(open_edge, vertex))
        })
    }

    /// Whether the borders of an open edge and of a nearby vertex separate at a common corner and meet again
    /// at another.
    fn meets_on_both_sides(&self, open_edge: &OpenEdge, vertex: u32) -> bool {
        [0, 1].into_iter().all(|end| {
            let outward = if end == 0 { -open_edge.along } else { open_edge.along };
            let own_corners = self.corners_from(open_edge.ends[end], end, outward, open_edge.part);
            // The border on the other side runs in the opposite direction.
            let others = self.corners_from(vertex, 1 - end, outward, open_edge.part);
            own_corners.iter().any(|corner| others.contains(corner))
        })
    }

    /// The corners along a border from a vertex in one direction, including the vertex. The open edges begin
    /// (`end` is 0) or end (1) at these corners.
    fn corners_from(&self, vertex: u32, end: usize, direction: DVec3, part: PartId) -> Vec<u32> {
        let mut found = vec![vertex];
        while let Some(last) = found.last().copied().filter(|_| found.len() < MAX_CORNERS_BETWEEN) {
            let corner = self.numbers[last as usize] as usize;
            let edges = self.at.of(corner).iter().map(|k| &self.open[*k as usize]);
            let continuing_edges = edges.filter(|edge| edge.ends[1 - end] == last && edge.part == part);
            let cosine = |edge: &OpenEdge| edge.along.dot(if end == 0 { -direction } else { direction });
            let next = continuing_edges.max_by(|a, b| cosine(a).total_cmp(&cosine(b)));
            let Some(next) =
                next.filter(|next| cosine(next) > MIN_SEAM_COSINE && !found.contains(&next.ends[end]))
            else {
                break;
            };
            found.push(next.ends[end]);
        }
        found
    }

    /// Largest deviation from an open edge of the curve that it approximates, as a vector.
    ///
    /// The estimate uses the end where the border turns less, because the other end may be a corner of the
    /// curve. The part of that turn that belongs to the next edge is estimated from the turn at the far end
    /// of that edge. A straight side next to a rounded corner therefore stays straight.
    fn sagitta(&self, open_edge: &OpenEdge) -> DVec3 {
        let next = |of: &OpenEdge, end: usize| {
            let corner = self.numbers[of.ends[end] as usize] as usize;
            let goes_on =
                |candidate: &&OpenEdge| candidate.ends[1 - end] == of.ends[end] && candidate.part == of.part;
            let others = self.at.of(corner).iter().map(|k| &self.open[*k as usize]).filter(goes_on);
            others.max_by(|a, b| a.along.dot(of.along).total_cmp(&b.along.dot(of.along)))
        };
        let ends = [0, 1].into_iter().filter_map(|end| Some((end, next(open_edge, end)?)));
        let straighter =
            ends.max_by(|a, b| a.1.along.dot(open_edge.along).total_cmp(&b.1.along.dot(open_edge.along)));
        let Some((end, adjacent)) = straighter else { return DVec3::ZERO };
        let cosine = adjacent.along.dot(open_edge.along);
        if cosine < MIN_SEAM_COSINE {
            return DVec3::ZERO;
        }
        let after = next(adjacent, end).map(|next| (next.along.dot(adjacent.along), next.length));
        let height = sagitta_height(cosine, [open_edge.length, adjacent.length], after);
        (adjacent.along - open_edge.along * cosine).normalize_or_zero() * height
    }
}
