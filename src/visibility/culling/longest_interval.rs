//! Longest range covered by ranges that arrive one after the other.

/// Empty range of parameters.
pub(crate) const NO_INTERVAL: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

/// Union of two ranges if they meet, otherwise the longer one.
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
