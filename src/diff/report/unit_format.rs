//! Numbers in the unit of the drawing, rounded for reports.

use crate::diff::findings::finding::{Diff, FindingBox};
use crate::diff::shapes::ink::trimmed;
use crate::drawing::Unit;

/// The unit of reported lengths.
#[derive(Debug, Clone, Copy)]
pub(crate) struct UnitFormat {
    unit: Unit,
    per_px: f64,
}

impl Diff {
    /// The unit for reporting this comparison.
    pub(crate) fn unit(&self) -> UnitFormat {
        UnitFormat { unit: self.before.unit, per_px: 1.0 / self.before.px_per_unit() }
    }
}

impl UnitFormat {
    pub(crate) fn number(self, px: f64) -> String {
        rounded(px * self.per_px)
    }

    pub(crate) fn length(self, px: f64) -> String {
        format!("{} {}", self.number(px), self.unit.name())
    }

    pub(crate) fn area(self, px2: f64) -> String {
        format!("{} {}²", rounded(px2 * self.per_px * self.per_px), self.unit.name())
    }

    /// A position in words, by the centre of its box.
    pub(crate) fn place(self, place: &FindingBox) -> String {
        let (x, y) = place.middle();
        format!("at ({:.0}, {:.0})", x * self.per_px, y * self.per_px)
    }
}

/// Three significant digits are enough to act on.
fn rounded(value: f64) -> String {
    match value.abs() {
        v if v >= 100.0 => format!("{value:.0}"),
        v if v >= 10.0 => trimmed((value * 10.0).round() / 10.0),
        v if v >= 1.0 => trimmed((value * 100.0).round() / 100.0),
        _ => trimmed(value),
    }
}
