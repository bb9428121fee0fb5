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

const FLUSH: &str = "lines of round bodies that touch others appear or change their pen with rounding";
const NESTED: &str = "nested transforms round more than single precision says";
const COPLANAR: &str = "lines along coplanar or tangent faces depend on how the faces are cut";
const SPLICED: &str = "a vertex in an edge that other bodies touch changes the pen, or the line goes";
const SHORT: &str = "the pen of a stretch shorter than about 40 px depends on the size of the picture";

const fn known(relation: Relation, in_short_run: usize, share: f64, why: &'static str) -> Known {
    Known { relation, in_short_run, share, why }
}

pub const KNOWN: [Known; 19] = [
    known(Relation::AllReversed, 0, 0.05, COPLANAR),
    known(Relation::SomeReversed, 0, 0.05, COPLANAR),
    known(Relation::ObjSixDecimals, 0, 0.1, FLUSH),
    known(Relation::ObjSinglePrecision, 0, 0.1, FLUSH),
    known(Relation::Stl, 2, 0.15, FLUSH),
    known(Relation::PlySinglePrecision, 0, 0.1, FLUSH),
    known(Relation::GlbNested, 3, 0.2, NESTED),
    known(Relation::GlbSinglePrecision, 0, 0.1, FLUSH),
    known(Relation::Turned, 1, 0.05, COPLANAR),
    known(Relation::Scaled, 0, 0.05, COPLANAR),
    known(Relation::MovedFar, 3, 0.15, COPLANAR),
    known(Relation::Mirrored, 0, 0.05, COPLANAR),
    known(Relation::FacesSplit, 1, 0.1, COPLANAR),
    known(Relation::VertexInEdge, 8, 0.4, SPLICED),
    known(Relation::VertexInEdgeOneSided, 7, 0.3, SPLICED),
    known(Relation::OtherDiagonals, 1, 0.06, COPLANAR),
    known(Relation::FacesWithoutArea, 2, 0.1, COPLANAR),
    known(Relation::OtherOrder, 1, 0.06, COPLANAR),
    known(Relation::PictureSize, 2, 0.15, SHORT),
];

/// What is known of a relation.
pub fn of(relation: Relation) -> Option<&'static Known> {
    KNOWN.iter().find(|known| known.relation == relation)
}
