//! The table of all style keys: type, values, default, unit and one line of help for each.
//!
//! The table is plain text, `table.txt`, so it costs no build time. The deserialisers in `style::tables`
//! and in the option structs stay the source of truth: the tests walk every path that they accept and
//! compare it with the table.
//!
//! 1. [`key_table`] parses the text into [`StyleKey`]s. A section that several tables share, such as the
//!    fields of pens, is written once and expanded for each.
//! 2. [`advice`] finds the key that an unknown word may stand for, and describes how to write the value of
//!    a known key.
//! 3. [`full_sheet`] prints a sheet with every key.
//!
//! `ligne styles --keys`, the completions of `--set`, `docs/reference/style-keys.md` and error messages
//! read this table.

pub(crate) mod advice;
pub(crate) mod full_sheet;
mod key_table;

pub use key_table::{KeyType, StyleKey};
