//! A comparison as text, JSON, Markdown and as a drawing.
//!
//! Files, in reading order: [`unit_format`] numbers in the unit of the drawing; [`text_report`] summary and
//! one line per finding or group of findings; [`json_report`]; [`markdown_report`] tables for a pull request;
//! [`overlay`] old and new marks in colours; [`legend`] the key of the overlay, in single-stroke letters.

mod json_report;
mod legend;
mod markdown_report;
pub(crate) mod overlay;
pub(crate) mod text_report;
pub(crate) mod unit_format;
