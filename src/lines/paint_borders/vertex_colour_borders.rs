//! Vertex colour borders: where interpolated vertex colours change from one palette colour to the next.
//!
//! Light is linear between corners, but perceived colour (Oklab) is not. Faces are subdivided until it is
//! linear within a fraction of a px. The decision depends on each side alone, so that neighbours agree. On
//! each piece the borders are those of [`super::colour_voronoi`].

use super::colour_voronoi::{ColourBorder, borders};
use crate::colour::oklab::{Oklab, distance2};
use crate::lines::Lit;
use crate::lines::isophotes::level_tracer::{max_extent, split_triangle};
use crate::scene::paints::vertex_colours::VertexColourPalette;

/// Largest error of borders, px.
const MAX_BORDER_ERROR_PX: f64 = 0.1;

/// Sides shorter than this are not split, px.
const MIN_SIDE_PX: f64 = 0.5;

/// Maximum depth of subdivision.
const MAX_SPLITS: u32 = 6;

/// Bound on the colour range of a piece, relative to the colour distances of its corners.
const MAX_DETOUR_RATIO: f32 = 1.5;

/// Face with colours at its corners.
pub(crate) struct TintedFace<'a> {
    tints: &'a VertexColourPalette,
    /// Light at its corners, ordered by vertex.
    light: [[f64; 3]; 3],
    /// Corners of the face, ordered by vertex.
    order: [usize; 3],
    /// Lengths of its sides, px. Entry k is for the side opposite the k-th corner in that order.
    sides: [f64; 3],
}

#[derive(Clone, Copy)]
struct TintSample {
    weights: [f64; 3],
    look: Oklab,
}

impl<'a> TintedFace<'a> {
    /// A face with the given light at its corners; `px` is a px in user units.
    pub(crate) fn new(
        lit: &Lit,
        face: u32,
        tints: &'a VertexColourPalette,
        light: [[f32; 3]; 3],
        px: f64,
    ) -> Self {
        let vertices = lit.mesh.triangles[face as usize];
        let mut order = [0, 1, 2];
        order.sort_by_key(|k| vertices[*k]);
        let points = order.map(|k| lit.view.points[vertices[k] as usize]);
        let length = |i: usize, j: usize| {
            let way = points[j].truncate() - points[i].truncate();
            let is_cut = way.is_nan() || points[i].z.is_nan() || points[j].z.is_nan();
            // A side that the near plane cuts has unlimited length.
            if is_cut { f64::INFINITY } else { way.length() / px }
        };
        let sides = [length(1, 2), length(2, 0), length(0, 1)];
        Self { tints, light: order.map(|k| light[k].map(f64::from)), order, sides }
    }

    /// Borders on the face, in its barycentric weights.
    pub(crate) fn borders(&self) -> Vec<ColourBorder> {
        let mut found = Vec::new();
        self.cut([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|w| self.node(w)), 0, &mut found);
        let in_place = |ordered: [f64; 3]| {
            let mut weights = [0.0; 3];
            self.order.iter().zip(ordered).for_each(|(k, weight)| weights[*k] = weight);
            weights
        };
        found.iter_mut().for_each(|(ends, _)| *ends = ends.map(in_place));
        found
    }

    fn node(&self, weights: [f64; 3]) -> TintSample {
        // Summed in a fixed order, so that both faces of a side get the same bits.
        let sum = |k: usize| (0..3).map(|c| self.light[c][k] * weights[c]).sum::<f64>();
        TintSample { weights, look: self.tints.looks([sum(0), sum(1), sum(2)]) }
    }

    fn cut(&self, nodes: [TintSample; 3], depth: u32, found: &mut Vec<ColourBorder>) {
        if self.is_one(&nodes) {
            return;
        }
        if depth < MAX_SPLITS {
            let middle = |i: usize, j: usize| self.bend(nodes[i], nodes[j]);
            let middles = [middle(1, 2), middle(2, 0), middle(0, 1)];
            if middles.iter().any(Option::is_some) {
                split_triangle(nodes, middles)
                    .into_iter()
                    .flatten()
                    .for_each(|piece| self.cut(piece, depth + 1, found));
                return;
            }
        }
        let mut nodes = nodes;
        // In the same order from both faces.
        nodes.sort_by(|a, b| order(b, a));
        let within =
            |at: [f64; 3]| [0, 1, 2].map(|k| (0..3).map(|c| nodes[c].weights[k] * at[c]).sum::<f64>());
        let own = borders(nodes.map(|node| node.look), self.tints.palette());
        found.extend(own.into_iter().map(|(ends, parted)| (ends.map(within), parted)));
    }

    /// Midpoint of a side whose colours are so far from linear that borders would move.
    fn bend(&self, a: TintSample, b: TintSample) -> Option<TintSample> {
        let length = max_extent(&self.sides, a.weights, b.weights);
        if length <= MIN_SIDE_PX || a.look == b.look {
            return None;
        }
        let middle = self.node([0, 1, 2].map(|k| f64::midpoint(a.weights[k], b.weights[k])));
        let straight = [0, 1, 2].map(|k| f32::midpoint(a.look[k], b.look[k]));
        let off = f64::from(distance2(middle.look, straight)).sqrt();
        (off * length > MAX_BORDER_ERROR_PX * f64::from(distance2(a.look, b.look)).sqrt()).then_some(middle)
    }

    /// Whether a piece certainly has one nearest colour.
    fn is_one(&self, nodes: &[TintSample; 3]) -> bool {
        let look = nodes[0].look;
        let reach =
            nodes.iter().map(|node| distance2(look, node.look)).fold(0.0, f32::max).sqrt() * MAX_DETOUR_RATIO;
        let mut best = [f32::INFINITY; 2];
        for far in self.tints.palette().iter().map(|colour| distance2(*colour, look).sqrt()) {
            if far < best[0] {
                best = [far, best[0]];
            } else if far < best[1] {
                best[1] = far;
            }
        }
        best[1] - best[0] > 2.0 * reach
    }
}

/// Orders points by their weight at the first corner, then at the second.
fn order(a: &TintSample, b: &TintSample) -> std::cmp::Ordering {
    (0..3).fold(std::cmp::Ordering::Equal, |known, k| known.then(a.weights[k].total_cmp(&b.weights[k])))
}
