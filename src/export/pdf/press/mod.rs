//! Settings of the press: inks, halftone screens and standards.
//!
//! Files, in reading order: `pdf_options` all options of PDF; `ink_plates` colours as RGB, CMYK or spot
//! inks; `halftone_screen` dot lattices and dot sizes; `standards` metadata required by PDF/X-4 and
//! PDF/A-2b.

#[cfg(feature = "pdf")]
pub(crate) mod halftone_screen;
#[cfg(feature = "pdf")]
pub(crate) mod ink_plates;
#[cfg(feature = "pdf")]
pub(crate) mod pdf_options;
#[cfg(feature = "pdf")]
pub(crate) mod standards;
