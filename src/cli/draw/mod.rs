//! `ligne draw`: drawings of one model, of many models, or on a contact sheet.
//!
//! Files, in reading order:
//! - [`model_drawing`]: draws one model from one or several views and encodes each output.
//! - [`web_output`]: adds titles and hotspots to SVG.
//! - [`batch`]: draws several models or views, in shards, resumed or watched.
//! - [`contact_sheet`]: puts small captioned drawings on one sheet.

pub(crate) mod batch;
pub(crate) mod contact_sheet;
pub(crate) mod model_drawing;
mod web_output;
