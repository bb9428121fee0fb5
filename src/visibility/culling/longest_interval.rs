//! The longest range of a segment that ranges found one after the other make up.

/// A range of parameters without any.
pub(crate) const NO_RUN: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

/// Two ranges as one where they meet, the longer one where they do not.
#[inline]
pub(crate) fn longer(run: (f64, f64), found: (f64, f64)) -> (f64, f64) {
    if found.0 <= run.1 && found.1 >= run.0 {
        (run.0.min(found.0), run.1.max(found.1))
    } else if found.1 - found.0 > run.1 - run.0 {
        found
    } else {
        run
    }
}
