//! Units of length of models.

/// Name of each unit, and its length in mm: millimetres, centimetres, metres, inches and feet.
pub(crate) const LENGTH_UNITS_MM: [(&str, f64); 5] =
    [("mm", 1.0), ("cm", 10.0), ("m", 1000.0), ("in", 25.4), ("ft", 304.8)];
