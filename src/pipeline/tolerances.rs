//! Tolerances of the pipeline: corners of tessellated circles, and texture coordinates.

/// Maximum distance of a corner from its tessellated circle, in steps of the file's coordinates.
///
/// Half the diagonal of a cell for rounding, and the same again because the exporting program computed with
/// rounded numbers.
pub(crate) const MAX_CIRCLE_CORNER_STEPS: f64 = 1.5;

/// Minimum area of a face's texture coordinates, as a fraction of its area at the usual scale of its part.
/// Texture coordinates of a smaller area are squeezed into a line, and are ignored.
pub(crate) const MIN_TEXTURE_AREA_SHARE: f64 = 1e-4;
