//! [`FaceCrossings`]: lines where faces pass through others, and facets cut along them.
//!
//! Of two facets that pass through each other, neither covers the other. Cut where they meet, each half is
//! entirely in front or behind, and a painting order exists.

use glam::DVec2;
use rustc_hash::FxHashMap;

use super::facet::Facet;
use crate::images::tolerances;
use crate::lines::{FeatureLines, LineKind};
use crate::mesh::Mesh;
use crate::view::{Frame, View};

/// Shortest cut through a facet, px.
const MIN_CUT_PX: f64 = 0.05;

/// Largest number of cuts of a face. A face with more crossings has no useful painting order.
const MAX_CUTS_PER_FACE: usize = 256;

/// Lines on the page where faces pass through others.
#[derive(Debug, Default)]
pub(crate) struct FaceCrossings {
    of_face: FxHashMap<u32, Vec<[DVec2; 2]>>,
}

impl FaceCrossings {
    /// Collects the crossings among the lines of a view.
    pub(crate) fn of(mesh: &Mesh, view: &View, lines: &FeatureLines) -> Self {
        let mut of_face: FxHashMap<u32, Vec<[DVec2; 2]>> = FxHashMap::default();
        for segment in lines.segments.iter().filter(|segment| segment.kind == LineKind::Intersection) {
            let ends = segment.ends.map(|end| view.frame.image_from_local(lines.position(mesh, end)));
            if ends.iter().all(|end| end.is_finite()) {
                for face in segment.hosts {
                    of_face.entry(face).or_default().push(ends.map(glam::DVec3::truncate));
                }
            }
        }
        Self { of_face }
    }

    /// Cuts a facet of a face at the crossings of the face.
    pub(crate) fn cut(&self, face: u32, facet: Facet, frame: &Frame, px: f64) -> Vec<Facet> {
        let mut pieces = vec![facet];
        for ends in self.of_face.get(&face).into_iter().flatten().take(MAX_CUTS_PER_FACE) {
            pieces = pieces.into_iter().flat_map(|piece| cut_along(piece, *ends, frame, px)).collect();
        }
        pieces
    }
}

/// Cuts a facet along the line through a segment, if the segment passes through it.
fn cut_along(facet: Facet, [from, to]: [DVec2; 2], frame: &Frame, px: f64) -> Vec<Facet> {
    let length = (to - from).length();
    let way = (to - from) / length;
    // Position of the corners along the line (x) and across it (y).
    let line = CrossingLine { from, direction: way, length, px };
    let at = facet.corners.map(|corner| line.at(corner.image.truncate()));
    if length.is_nan() || length <= 0.0 || !line.passes(at) {
        return vec![facet];
    }
    let [positive_count, negative_count] =
        [1.0, -1.0].map(|side| at.iter().filter(|at| at.y * side > 0.0).count());
    let side = if positive_count == 1 { 1.0 } else { -1.0 };
    let alone = at.iter().position(|at| at.y * side > 0.0);
    let Some(alone) = alone.filter(|_| positive_count > 0 && negative_count > 0) else {
        let along = (0..3).find(|k| at[*k].y == 0.0 && at[(k + 1) % 3].y == 0.0);
        return along.map_or_else(|| vec![facet], |side| line.walled(&facet, side, frame));
    };
    // Rotated so that the corner alone on its side comes first.
    let (turned, at) = (facet.turned(alone), [0, 1, 2].map(|k| at[(alone + k) % 3].y));
    let share = |to: usize| at[0] / (at[0] - at[to]);
    // Facets that have the new side, with the index of that side.
    let (mut pieces, sided) = if at[1] == 0.0 {
        let [rest, tip] = turned.cut_on_page(2, 1.0 - share(2), frame);
        (Vec::new(), [(rest, 1), (tip, 2)])
    } else if at[2] == 0.0 {
        let [tip, rest] = turned.cut_on_page(0, share(1), frame);
        (Vec::new(), [(tip, 1), (rest, 2)])
    } else {
        // From (a, b, c): first (a, m, c) and (m, b, c), then the former is cut on its side from c to a.
        let [first_part, second_part] = turned.cut_on_page(0, share(1), frame);
        let [rest, tip] = first_part.cut_on_page(2, 1.0 - share(2), frame);
        (vec![second_part], [(rest, 1), (tip, 2)])
    };
    pieces.extend(sided.into_iter().flat_map(|(piece, side)| line.walled(&piece, side, frame)));
    pieces
}

/// Line with a segment on it.
#[derive(Debug, Clone, Copy)]
struct CrossingLine {
    from: DVec2,
    /// Unit vector along the line.
    direction: DVec2,
    /// Length of the segment.
    length: f64,
    px: f64,
}

impl CrossingLine {
    /// Position of a point along the line (x) and across it (y).
    fn at(&self, p: DVec2) -> DVec2 {
        let offset = self.direction.perp_dot(p - self.from);
        let snapped_offset =
            if offset.abs() <= tolerances::MAX_LINE_DISTANCE_PX * self.px { 0.0 } else { offset };
        DVec2::new(self.direction.dot(p - self.from), snapped_offset)
    }

    /// Whether the segment passes through a facet with these corners, or along one of its sides.
    fn passes(&self, corners: [DVec2; 3]) -> bool {
        // Start and end of the facet along the line.
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            if a.y == 0.0 {
                (low, high) = (low.min(a.x), high.max(a.x));
            }
            if a.y * b.y < 0.0 {
                let at = a.x + (b.x - a.x) * a.y / (a.y - b.y);
                (low, high) = (low.min(at), high.max(at));
            }
        }
        high.min(self.length) - low.max(0.0) > MIN_CUT_PX * self.px
    }

    /// Marks a side of a facet that lies on the line as cut. The facet is divided so that each piece lies on
    /// the segment or off it.
    fn walled(&self, facet: &Facet, side: usize, frame: &Frame) -> Vec<Facet> {
        let [a, b] =
            [side, (side + 1) % 3].map(|k| self.direction.dot(facet.corners[k].image.truncate() - self.from));
        let min_cut = MIN_CUT_PX * self.px;
        let mut cuts: Vec<f64> = [0.0, self.length]
            .into_iter()
            .filter(|end| end - a.min(b) > min_cut && a.max(b) - end > min_cut)
            .map(|end| (end - a) / (b - a))
            .collect();
        cuts.sort_by(f64::total_cmp);
        let is_on_way = |from: f64, to: f64| {
            let middle = a + (b - a) * f64::midpoint(from, to);
            middle > 0.0 && middle < self.length
        };
        let (mut pieces, mut remaining, mut begin) = (Vec::new(), facet.turned(side), 0.0);
        for cut in cuts {
            let [piece, next] = remaining.cut_on_page(0, (cut - begin) / (1.0 - begin), frame);
            pieces.push(piece.with_parted(0, is_on_way(begin, cut)));
            (remaining, begin) = (next, cut);
        }
        pieces.push(remaining.with_parted(0, is_on_way(begin, 1.0)));
        pieces
    }
}
