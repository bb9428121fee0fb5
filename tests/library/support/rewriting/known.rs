//! Accepted differences, each with its reason and upper bounds. All other relations hold for every scene.

use super::relations::Relation;

/// A relation that does not hold for every scene.
pub(crate) struct AcceptedDifference {
    pub relation: Relation,
    /// Maximum number of different drawings in the short run, which always draws the same scenes.
    pub max_in_short_run: usize,
    /// Maximum share of different drawings in the long run.
    pub max_share: f64,
    pub reason: &'static str,
}

const EDGE_ON_REASON: &str = "a face is seen edge-on, or nearer to that than rounding may turn it: which side of it is seen, and which of its lines, \
    which coincide in the image, is in front, is known of the exact file alone (view/edge_on.rs, viewmap/hosted_line.rs)";
const SHORT_ROUND_STRETCH_REASON: &str = "on a rounded surface a stretch shorter than 12 px has the pen of its neighbours, and rounding moves the end of \
    one across that limit (chain/silhouette.rs)";
const SHORT_STRETCH_REASON: &str = "a stretch with background beside it has the pen of its neighbours if it is shorter than 12 px on a rounded surface, or \
    than 4 px on a sharp edge: pens keep their width in a larger picture (chain/silhouette.rs)";
const SHALLOW_CREASE_REASON: &str = "a diagonal of one body lies along a crease of less than 40 degrees of another one, where creases are found at edges of \
    two faces only (shape/hard_edges.rs); or a stretch is shorter than 4 px";
const FAR_COORDINATES_REASON: &str =
    "at a million units the coordinates have seven digits, and the file counts as one in single precision";

const fn accepted(
    relation: Relation,
    in_short_run: usize,
    share: f64,
    why: &'static str,
) -> AcceptedDifference {
    AcceptedDifference { relation, max_in_short_run: in_short_run, max_share: share, reason: why }
}

pub(crate) const ACCEPTED_DIFFERENCES: [AcceptedDifference; 10] = [
    accepted(Relation::ObjSixDecimals, 0, 0.04, EDGE_ON_REASON),
    accepted(Relation::ObjSinglePrecision, 0, 0.04, EDGE_ON_REASON),
    accepted(Relation::Stl, 2, 0.04, EDGE_ON_REASON),
    accepted(Relation::PlySinglePrecision, 0, 0.03, EDGE_ON_REASON),
    accepted(Relation::GlbNested, 1, 0.02, SHORT_ROUND_STRETCH_REASON),
    accepted(Relation::GlbSinglePrecision, 0, 0.03, EDGE_ON_REASON),
    accepted(Relation::MovedFar, 0, 0.04, FAR_COORDINATES_REASON),
    accepted(Relation::VertexInEdge, 0, 0.04, SHALLOW_CREASE_REASON),
    accepted(Relation::VertexInEdgeOneSided, 0, 0.04, SHALLOW_CREASE_REASON),
    accepted(Relation::PictureSize, 1, 0.15, SHORT_STRETCH_REASON),
];

/// The accepted differences of a relation.
pub(crate) fn accepted_difference(relation: Relation) -> Option<&'static AcceptedDifference> {
    ACCEPTED_DIFFERENCES.iter().find(|known| known.relation == relation)
}
