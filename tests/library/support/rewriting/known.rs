//! Differences that are known, each with its reason and upper bounds. A relation that is not listed holds for every scene.

use super::relations::Relation;

/// A relation that does not hold for every scene.
pub struct Known {
    pub relation: Relation,
    /// Drawings that may differ in the short run, which draws the same scenes each time.
    pub in_short_run: usize,
    /// The share of drawings that may differ in the long run.
    pub share: f64,
    pub why: &'static str,
}

const JUDGED_ALONE: &str = "bodies touch along an edge: where both have its vertices it is judged by all its faces, else by those of \
    each body, so that contour, crease, border and material change places";
const TANGENT: &str = "a face touches a round body along an edge, at an angle that rounding puts on either side of the limit for contact";
const EDGE_ON: &str = "round bodies are flush in a plane that is seen nearly edge-on, and rounding decides which has the outline";
const NEEDLE: &str = "a face without area lies along the edge that a decal and its wall share";
const SHORT: &str = "the pen of a stretch shorter than about 40 px depends on the size of the picture";

const fn known(relation: Relation, in_short_run: usize, share: f64, why: &'static str) -> Known {
    Known { relation, in_short_run, share, why }
}

pub const KNOWN: [Known; 19] = [
    known(Relation::AllReversed, 0, 0.05, JUDGED_ALONE),
    known(Relation::SomeReversed, 0, 0.05, JUDGED_ALONE),
    known(Relation::ObjSixDecimals, 0, 0.1, TANGENT),
    known(Relation::ObjSinglePrecision, 0, 0.1, TANGENT),
    known(Relation::Stl, 2, 0.15, EDGE_ON),
    known(Relation::PlySinglePrecision, 0, 0.1, TANGENT),
    known(Relation::GlbNested, 2, 0.2, EDGE_ON),
    known(Relation::GlbSinglePrecision, 1, 0.1, TANGENT),
    known(Relation::Turned, 1, 0.05, JUDGED_ALONE),
    known(Relation::Scaled, 0, 0.05, JUDGED_ALONE),
    known(Relation::MovedFar, 0, 0.15, JUDGED_ALONE),
    known(Relation::Mirrored, 0, 0.05, JUDGED_ALONE),
    known(Relation::FacesSplit, 0, 0.1, JUDGED_ALONE),
    known(Relation::VertexInEdge, 3, 0.4, JUDGED_ALONE),
    known(Relation::VertexInEdgeOneSided, 5, 0.3, JUDGED_ALONE),
    known(Relation::OtherDiagonals, 0, 0.06, JUDGED_ALONE),
    known(Relation::FacesWithoutArea, 2, 0.1, NEEDLE),
    known(Relation::OtherOrder, 0, 0.06, JUDGED_ALONE),
    known(Relation::PictureSize, 2, 0.15, SHORT),
];

/// What is known of a relation.
pub fn of(relation: Relation) -> Option<&'static Known> {
    KNOWN.iter().find(|known| known.relation == relation)
}
