//! Numbers in the unit of the drawing, rounded for reports.

use kurbo::Vec2;

use crate::diff::findings::finding::{Diff, Finding, FindingBox};
use crate::diff::shapes::ink::trimmed;
use crate::diff::shapes::picture::ShapeKind;
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

    /// Name of the unit.
    pub(crate) fn name(self) -> &'static str {
        self.unit.name()
    }

    /// Length of the lines and area of the fills of some findings.
    pub(crate) fn ink<'a>(self, findings: impl Iterator<Item = &'a Finding>) -> String {
        let (mut length, mut area) = (0.0, 0.0);
        for finding in findings {
            match finding.kind {
                ShapeKind::Line => length += finding.size,
                ShapeKind::Region => area += finding.size,
                ShapeKind::Clip => {}
            }
        }
        let lines = (length > 0.0).then(|| format!("{} of lines", self.length(length)));
        let fills = (area > 0.0).then(|| format!("{} of fills", self.area(area)));
        lines.into_iter().chain(fills).collect::<Vec<_>>().join(", ")
    }

    /// A shift by its directions: `3 right, 4 down`, with `unit` after each number. Directions that round to 0
    /// are left out.
    pub(crate) fn sides(self, shift: Vec2, unit: &str) -> String {
        let side = |value: f64, plus: &str, minus: &str| {
            let number = self.number(value.abs());
            (number != "0").then(|| format!("{number}{unit} {}", if value > 0.0 { plus } else { minus }))
        };
        let sides = side(shift.x, "right", "left").into_iter().chain(side(shift.y, "down", "up"));
        sides.collect::<Vec<_>>().join(", ")
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
