//! Drops short lines that no illustrator would draw: isolated dots, dangling ends, tiny loops and noisy
//! creases.
//!
//! Lengths are in tidy lengths (option `tidy`). The thresholds depend on the kind of line, on whether its
//! ends are free or covered, and on whether the surface is scanned.

use crate::parallel::prelude::*;
use rustc_hash::FxHashSet;

use super::raw_line::{RawLine, VertexDegrees};
use super::removed_lines::{RemovalLog, RemovalReason};
use crate::lines::LineKind;
use crate::surface::MeshSource;
use crate::visibility::ViewVertexId;

/// Minimum weighted length of a scan's crease. A crease that turns by 90 degrees counts in full, a fainter
/// one less.
const MIN_SCAN_CREASE_TIDY_LENGTHS: f64 = 5.0;

/// Maximum length of an isolated line of any kind that counts as a dot.
const MAX_DOT_TIDY_LENGTHS: f64 = 0.3;

/// Minimum length of a scan's contour that touches no other line.
const MIN_FLOATING_TIDY_LENGTHS: f64 = 6.0;

/// Minimum length of a scan's contour that a surface covers at one end.
const MIN_PARTLY_COVERED_TIDY_LENGTHS: f64 = 2.5;

/// Minimum length of a line that has a length in a file: 0.01 px, the last decimal that is written.
const MIN_WRITTEN_TIDY_LENGTHS: f64 = 0.0025;

/// Minimum weighted length of an interior line. A line of full strength counts in full, a weaker one less.
const MIN_INTERIOR_TIDY_LENGTHS: f64 = 5.0;

/// Minimum of an interior line's greatest strength.
const MIN_INTERIOR_PEAK: f64 = 0.25;

/// Drops every line that is too short, and logs it.
pub(crate) fn drop_short_lines(
    raws: &mut Vec<RawLine>,
    degrees: &mut VertexDegrees,
    tidy: f64,
    bin: &mut RemovalLog,
) {
    // All lines are tested before any is dropped, so the result does not depend on their order.
    let rims = ContourEnds::of(raws);
    let left: &VertexDegrees = degrees;
    let crumbs: Vec<bool> = raws.par_iter().map(|raw| is_too_short(raw, left, &rims, tidy)).collect();
    if !crumbs.contains(&true) {
        return;
    }
    let mut crumb = crumbs.into_iter();
    raws.retain(|raw| {
        let goes = crumb.next().unwrap_or(false);
        if goes {
            bin.record(raw, || RemovalReason::of_short_line(raw, degrees));
            degrees.remove_line(raw);
        }
        !goes
    });
}

/// View vertices where visible contours start or end.
struct ContourEnds(FxHashSet<ViewVertexId>);

impl ContourEnds {
    fn of(raws: &[RawLine]) -> Self {
        // Only scanned creases are looked up.
        if !raws.par_iter().any(is_scanned_crease) {
            return Self(FxHashSet::default());
        }
        let contours = raws
            .iter()
            .filter(|raw| raw.class.kind == LineKind::Contour && !raw.class.hidden && !raw.is_ring());
        Self(contours.flat_map(|raw| raw.ends).collect())
    }

    /// Whether contours continue a line at both its ends, as at the rim of a hole.
    fn meet_both_ends(&self, raw: &RawLine) -> bool {
        !raw.is_ring() && raw.ends.iter().all(|end| self.0.contains(end))
    }
}

/// Whether a line is a scan's crease that turns too little for its length.
pub(crate) fn may_be_noise(raw: &RawLine, tidy: f64) -> bool {
    is_scanned_crease(raw) && raw.pronounced < MIN_SCAN_CREASE_TIDY_LENGTHS * tidy
}

fn is_scanned_crease(raw: &RawLine) -> bool {
    raw.class.origin == MeshSource::Scanned && raw.class.kind == LineKind::Crease
}

fn is_too_short(raw: &RawLine, degrees: &VertexDegrees, rims: &ContourEnds, tidy: f64) -> bool {
    if raw.class.hidden {
        return false;
    }
    let length = raw.length();
    let scanned = raw.class.origin == MeshSource::Scanned;
    if is_scanned_crease(raw) {
        return may_be_noise(raw, tidy) && !(rims.meet_both_ends(raw) && length >= tidy);
    }
    if raw.class.kind.is_inside() {
        return raw.line.strength() < MIN_INTERIOR_TIDY_LENGTHS * tidy || raw.line.peak() < MIN_INTERIOR_PEAK;
    }
    if length >= MIN_FLOATING_TIDY_LENGTHS * tidy {
        return false;
    }
    if length < MIN_WRITTEN_TIDY_LENGTHS * tidy {
        return true;
    }
    if raw.is_ring() {
        // A loop of about two stroke widths would look like a blot.
        return match raw.class.kind {
            LineKind::Border => scanned,
            _ => raw.smooth && length < 2.0 * tidy,
        };
    }
    let free = raw.ends.map(|end| degrees.is_free(end));
    let ends = [0, 1].map(|side| free[side] || raw.covered[side]);
    if length < MAX_DOT_TIDY_LENGTHS * tidy && ends[0] && ends[1] {
        return true;
    }
    // A gap in the silhouette is worse than a short line on it.
    if raw.silhouette_part() > 0.5 {
        return false;
    }
    match raw.class.kind {
        LineKind::Contour if raw.smooth => {
            let (floating, free) = (ends[0] && ends[1], free[0] && free[1]);
            let least = match raw.class.origin {
                MeshSource::Scanned if floating && free => MIN_FLOATING_TIDY_LENGTHS * tidy,
                MeshSource::Scanned | MeshSource::Modelled if floating => {
                    MIN_PARTLY_COVERED_TIDY_LENGTHS * tidy
                }
                _ => tidy,
            };
            // A short end of another line, round a corner, is kept.
            let spur = [0, 1].map(|side| !ends[side] && degrees.is_junction(raw.ends[side]));
            length < least && ((ends[0] && (ends[1] || spur[1])) || (ends[1] && spur[0]))
        }
        LineKind::Crease => {
            // On exact models only creases with both ends inside a surface are doubtful.
            length < tidy && [0, 1].iter().all(|side| free[*side] && !raw.covered[*side])
        }
        // A slit in a scan is a mesh defect. The edge of a sheet that emerges from under another is not.
        LineKind::Border if scanned => {
            let is_whole = !raw.covered[0] && !raw.covered[1];
            free[0] && free[1] && (is_whole || length < MIN_PARTLY_COVERED_TIDY_LENGTHS * tidy)
        }
        LineKind::Wire | LineKind::Border | LineKind::Motion => false,
        _ => length < 0.25 * tidy && free[0] && free[1],
    }
}
