//! The tables of a style sheet as serde reads them, and their conversion to the options of the stages.
//!
//! Files, in reading order:
//!
//! - `style_sheet`: the whole sheet, the tables `[page]` and `[pen]`.
//! - `fills_table`: the table `[fills]`, tones and their colours.
//! - `highlight_table`: the table `[fills.highlight]`.
//! - `ramp_source`: ramps and tables of tones, as colours or as a picture.
//! - `hatching_table`: the table `[hatching]`.

pub(crate) mod fills_table;
mod hatching_table;
mod highlight_table;
pub(crate) mod ramp_source;
pub(crate) mod style_sheet;
