//! Differences that are known, each with the reason and an upper bound.

use super::relations::Relation;

/// A relation that does not hold for every scene.
pub struct Known {
    pub relation: Relation,
    /// The share of drawings that may differ.
    pub share: f64,
    pub why: &'static str,
}

pub const KNOWN: [Known; 0] = [];

/// The share of drawings that may differ under a relation.
pub fn limit(relation: Relation) -> f64 {
    KNOWN.iter().filter(|known| known.relation == relation).map(|known| known.share).sum()
}
