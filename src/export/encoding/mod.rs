//! Encoders for numbers, text and pictures in files.
//!
//! Files, in reading order: `decimals` shortest decimal numbers from fixed-point integers; `xml` escaped
//! text and unique ids; `embedded_pictures` each picture of a drawing once, as PNG in base64; `gzip`
//! compression of `.svgz` files.

pub(crate) mod decimals;
pub(crate) mod embedded_pictures;
#[cfg(feature = "cli")]
pub(crate) mod gzip;
pub(crate) mod xml;
