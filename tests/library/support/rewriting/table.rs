//! [`Table`]: number of drawings compared per relation, number that differ, and largest difference.

use std::collections::BTreeMap;
use std::fmt;

use super::relations::Relation;
use super::trial::{Outcome, Trial};

#[derive(Debug, Clone, Default)]
pub(crate) struct RelationCounts {
    pub compared: usize,
    /// Different drawings of scenes without rounded bodies.
    pub flat_different: usize,
    /// Different drawings of scenes with rounded bodies.
    pub round_different: usize,
    /// Largest difference of one drawing, px of length.
    pub longest: f64,
}

impl RelationCounts {
    pub(crate) fn different(&self) -> usize {
        self.flat_different + self.round_different
    }
}

#[derive(Debug, Clone, Default)]
pub(crate) struct Table(pub BTreeMap<Relation, RelationCounts>);

impl Table {
    pub(crate) fn of(trials: &[Trial]) -> Self {
        let mut rows: BTreeMap<Relation, RelationCounts> = BTreeMap::new();
        for trial in trials.iter().filter(|trial| !matches!(trial.outcome, Outcome::NotApplicable)) {
            let row = rows.entry(trial.relation).or_default();
            row.compared += 1;
            row.longest = row.longest.max(trial.outcome.length());
            let is_fault = usize::from(trial.outcome.is_failure());
            if trial.model.is_round() {
                row.round_different += is_fault;
            } else {
                row.flat_different += is_fault;
            }
        }
        Self(rows)
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:34} {:>6} {:>10} {:>6} {:>6} {:>11}",
            "relation", "made", "different", "flat", "round", "longest px"
        )?;
        let mut sum = RelationCounts::default();
        for (relation, row) in &self.0 {
            writeln!(
                f,
                "{:34} {:>6} {:>10} {:>6} {:>6} {:>11.1}",
                relation.name(),
                row.compared,
                row.different(),
                row.flat_different,
                row.round_different,
                row.longest
            )?;
            sum.compared += row.compared;
            sum.flat_different += row.flat_different;
            sum.round_different += row.round_different;
        }
        writeln!(
            f,
            "{:34} {:>6} {:>10} {:>6} {:>6}",
            "all",
            sum.compared,
            sum.different(),
            sum.flat_different,
            sum.round_different
        )
    }
}
