//! Argument structs of the options that several commands share, and the parsers of their values.
//!
//! Doc comments of the arguments are the help text of the program.
//!
//! Files, in reading order:
//! - [`draw_args`] holds the options of `ligne draw`, and `HowArgs`, which other commands share. Both are made
//!   of the files below.
//! - [`framing_args`] holds camera and frame.
//! - [`section_and_explode_args`] holds `--section`, `--uncut`, `--explode` and `--explode-part`.
//! - [`step_args`] holds the converter of STEP files.
//! - [`dxf_args`], `print_args` and [`web_args`] hold DXF, PDF and web output.
//! - [`batch_args`] holds several models or views in one call, and watching.
//! - [`contact_sheet_args`] holds contact sheets of views or moments.
//! - [`values`] holds value types and their parsers.
//! - [`style_keys`] lists the style keys for `--set`.

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
