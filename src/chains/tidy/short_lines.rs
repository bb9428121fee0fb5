//! Drops what no illustrator would draw: crumbs, spurs, tiny loops and creases that are noise.

use crate::parallel::prelude::*;
use rustc_hash::FxHashSet;

use super::raw_line::{Degrees, Raw};
use super::removed_lines::{Bin, Reason};
use crate::lines::LineKind;
use crate::surface::Origin;
use crate::visibility::ViewVertexId;

/// A crease of a scan must be this many times longer than a crumb if it turns by a right angle; the
/// fainter, the longer.
const NOISE: f64 = 5.0;

/// A line of any kind that hangs on nothing is a dot if it is shorter than this many tidy lengths.
const DOT: f64 = 0.3;

/// A contour of a scan that hangs on nothing must be this many times longer.
const FLOATING: f64 = 6.0;

/// A contour of a scan that comes out from under something at one of its ends must be this many times longer.
const PARTLY_COVERED: f64 = 2.5;

/// A line shorter than so many tidy lengths has no length in a file: 0.01 px, the last decimal that is written.
const UNWRITTEN: f64 = 0.0025;

/// A line inside must be this many times longer than a crumb where it is as strong as can be; the
/// weaker, the longer.
const INSIDE: f64 = 5.0;

/// Strength that a line inside must reach somewhere.
const INSIDE_PEAK: f64 = 0.25;

/// Leaves out every line that is a crumb.
pub(crate) fn drop_crumbs(raws: &mut Vec<Raw>, degrees: &mut Degrees, tidy: f64, bin: &mut Bin) {
    // All are judged before any goes, so that no order matters.
    let rims = Rims::of(raws);
    let left: &Degrees = degrees;
    let crumbs: Vec<bool> = raws.par_iter().map(|raw| is_crumb(raw, left, &rims, tidy)).collect();
    if !crumbs.contains(&true) {
        return;
    }
    let mut crumb = crumbs.into_iter();
    raws.retain(|raw| {
        let goes = crumb.next().unwrap_or(false);
        if goes {
            bin.put(raw, || Reason::of_crumb(raw, degrees));
            degrees.leave_out(raw);
        }
        !goes
    });
}

/// Where contours begin and end.
struct Rims(FxHashSet<ViewVertexId>);

impl Rims {
    fn of(raws: &[Raw]) -> Self {
        // Only such are asked about.
        if !raws.par_iter().any(is_scanned_crease) {
            return Self(FxHashSet::default());
        }
        let contours = raws
            .iter()
            .filter(|raw| raw.class.kind == LineKind::Contour && !raw.class.hidden && !raw.is_ring());
        Self(contours.flat_map(|raw| raw.ends).collect())
    }

    /// Whether a line goes on as a contour at both its ends, as where one sees the near side of the rim of a hole, or only into it.
    fn holds(&self, raw: &Raw) -> bool {
        !raw.is_ring() && raw.ends.iter().all(|end| self.0.contains(end))
    }
}

/// Whether a line is a crease of a scan that turns too little for its length: it goes, unless contours go on at both
/// its ends.
pub(crate) fn may_be_noise(raw: &Raw, tidy: f64) -> bool {
    is_scanned_crease(raw) && raw.pronounced < NOISE * tidy
}

fn is_scanned_crease(raw: &Raw) -> bool {
    raw.class.origin == Origin::Scanned && raw.class.kind == LineKind::Crease
}

fn is_crumb(raw: &Raw, degrees: &Degrees, rims: &Rims, tidy: f64) -> bool {
    if raw.class.hidden {
        return false;
    }
    let length = raw.length();
    let scanned = raw.class.origin == Origin::Scanned;
    if is_scanned_crease(raw) {
        return may_be_noise(raw, tidy) && !(rims.holds(raw) && length >= tidy);
    }
    if raw.class.kind.is_inside() {
        return raw.line.strength() < INSIDE * tidy || raw.line.peak() < INSIDE_PEAK;
    }
    if length >= FLOATING * tidy {
        return false;
    }
    if length < UNWRITTEN * tidy {
        return true;
    }
    if raw.is_ring() {
        // A loop of two strokes' width is a blot.
        return match raw.class.kind {
            LineKind::Border => scanned,
            _ => raw.smooth && length < 2.0 * tidy,
        };
    }
    let free = raw.ends.map(|end| degrees.is_free(end));
    let ends = [0, 1].map(|side| free[side] || raw.covered[side]);
    if length < DOT * tidy && ends[0] && ends[1] {
        return true;
    }
    // A gap in the outline is worse than a crumb on it.
    if raw.silhouette_part() > 0.5 {
        return false;
    }
    match raw.class.kind {
        LineKind::Contour if raw.smooth => {
            let (floating, free) = (ends[0] && ends[1], free[0] && free[1]);
            let least = match raw.class.origin {
                Origin::Scanned if floating && free => FLOATING * tidy,
                Origin::Scanned | Origin::Modelled if floating => PARTLY_COVERED * tidy,
                _ => tidy,
            };
            // Where it is the last piece of another line, round a corner, that line needs it.
            let spur = [0, 1].map(|side| !ends[side] && degrees.is_junction(raw.ends[side]));
            length < least && ((ends[0] && (ends[1] || spur[1])) || (ends[1] && spur[0]))
        }
        LineKind::Crease => {
            // On exact models only what ends in the middle of a surface is doubtful.
            length < tidy && [0, 1].iter().all(|side| free[*side] && !raw.covered[*side])
        }
        // A slit in a scan is a defect of its mesh; the edge of a sheet that comes out from under another is not.
        LineKind::Border if scanned => {
            let is_whole = !raw.covered[0] && !raw.covered[1];
            free[0] && free[1] && (is_whole || length < PARTLY_COVERED * tidy)
        }
        LineKind::Wire | LineKind::Border | LineKind::Motion => false,
        _ => length < 0.25 * tidy && free[0] && free[1],
    }
}
