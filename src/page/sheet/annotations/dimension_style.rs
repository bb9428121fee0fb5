//! Letter and arrow size of dimensions (ISO 129-1).

/// Height of values, and length of arrow heads, mm.
pub(crate) const VALUE_HEIGHT_MM: f64 = 3.5;
pub(crate) const ARROW_LENGTH_MM: f64 = 3.0;
