//! Letter and arrow size of dimensions (ISO 129-1).

/// Height of values, and length of arrow heads, mm.
pub(crate) const HIGH: f64 = 3.5;
pub(crate) const ARROW: f64 = 3.0;
