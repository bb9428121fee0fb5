//! Argument structs of the options that several commands share, and the parsers of their values.
//!
//! Doc comments of the arguments are the help text of the program.
//!
//! Files, in reading order:
//! - [`draw_args`]: all options of `ligne draw`, and `HowArgs`, the options shared with other commands.
//! - [`framing_args`] and [`section_args`]: camera, sections and exploded views.
//! - [`step_args`]: reading STEP files.
//! - [`dxf_args`], `print_args` and [`web_args`]: DXF, PDF and web output.
//! - [`batch_args`]: several models or views in one call, and watching.
//! - [`contact_sheet_args`]: contact sheets of views or moments.
//! - [`values`]: value types and their parsers.
//! - [`style_keys`]: lists of the style keys for `--set`.

pub(crate) mod batch_args;
pub(crate) mod contact_sheet_args;
pub(crate) mod draw_args;
pub(crate) mod dxf_args;
pub(crate) mod framing_args;
#[cfg(feature = "pdf")]
pub(crate) mod print_args;
pub(crate) mod section_args;
pub(crate) mod step_args;
pub(crate) mod style_keys;
pub(crate) mod values;
pub(crate) mod web_args;
