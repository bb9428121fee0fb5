//! Argument structs of the options that several commands share, and the parsers of their values.
//!
//! Doc comments of the arguments are the help text of the program.
//!
//! Files, in reading order:
//! - [`draw_args`] holds all options of `ligne draw`, and `HowArgs`, which other commands flatten.
//! - [`framing_args`] and [`section_and_explode_args`]: view.
//! - [`step_args`] holds STEP files.
//! - [`dxf_args`], `print_args` and [`web_args`]: output.
//! - [`batch_args`] holds several models.
//! - [`contact_sheet_args`] holds sheets.
//!
//! [`values`] holds value types, and [`style_keys`] the keys after `--set`.

pub(crate) mod batch_args;
pub(crate) mod contact_sheet_args;
pub(crate) mod draw_args;
pub(crate) mod dxf_args;
pub(crate) mod framing_args;
#[cfg(feature = "pdf")]
pub(crate) mod print_args;
pub(crate) mod section_and_explode_args;
pub(crate) mod step_args;
pub(crate) mod style_keys;
pub(crate) mod values;
pub(crate) mod web_args;
