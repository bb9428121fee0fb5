//! Running union of the hidden parameter ranges of a segment, kept as one range.
//!
//! The visibility tests add one hidden range per triangle. Once the union contains the whole segment, the
//! remaining triangles are skipped. Only one range is kept, so the union may be shorter than the true one:
//! this costs time but never changes the result.

/// Empty range, the start value of the union.
pub(crate) const NO_INTERVAL: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

/// Union of the running range `run` and the range `found` if they meet, otherwise the longer one.
#[inline]
pub(crate) fn join_or_longer(run: (f64, f64), found: (f64, f64)) -> (f64, f64) {
    if found.0 <= run.1 && found.1 >= run.0 {
        (run.0.min(found.0), run.1.max(found.1))
    } else if found.1 - found.0 > run.1 - run.0 {
        found
    } else {
        run
    }
}
