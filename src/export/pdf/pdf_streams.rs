//! Units of PDF, and the size and compression of its streams.

use miniz_oxide::deflate::compress_to_vec_zlib;

/// Points (1/72 inch) per px.
pub(crate) const POINTS_PER_PX: f64 = 0.75;
/// Points per millimetre.
pub(crate) const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// Longest side of a page that all viewers show, in points.
pub(crate) const MAX_SIDE_POINTS: f64 = 14_400.0;

/// Marks per stream. A fixed number, so that the bytes do not depend on the number of threads.
pub(crate) const MARKS_PER_STREAM: usize = 2048;

/// Compression level of zlib, 0 to 10. This fast level makes files at most a tenth larger than the slowest.
const DEFLATE_LEVEL: u8 = 4;

/// Compresses content, samples of gradients and profiles.
pub(crate) fn deflated(bytes: &[u8]) -> Vec<u8> {
    compress_to_vec_zlib(bytes, DEFLATE_LEVEL)
}
