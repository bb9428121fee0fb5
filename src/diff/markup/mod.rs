//! XML and CSS of an SVG file, read in time and memory in proportion to the length of the file.
//!
//! 1. [`tag_limits`] counts tags, attributes, namespaces and entities before the file is parsed.
//! 2. [`input_limits`] parses the XML and refuses references that multiply or nest too deeply.
//! 3. [`css_sheet`] reads the CSS rules of `style` elements, word by word with [`css_reader`].
//! 4. [`cascade`] applies the rules to each element while the document is traversed.
//! 5. [`inline_style`] writes the resulting declarations as one `style` attribute.
//!
//! Also: [`sheet_inlining`] a file with its style sheets replaced by `style` attributes; [`number_scan`]
//! decimals and range of the numbers of an attribute.

pub(crate) mod cascade;
mod css_reader;
pub(crate) mod css_sheet;
pub(crate) mod inline_style;
pub(crate) mod input_limits;
pub(crate) mod number_scan;
pub(crate) mod sheet_inlining;
mod tag_limits;
