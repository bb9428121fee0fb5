//! Documentation generated from the definitions of the parser: `ligne man` and `ligne completions`.
//!
//! Files, in reading order:
//! - [`man_page`]: writes a manual page as roff.
//! - [`command_reference`]: writes the reference of all commands as Markdown.
//! - [`conventions`]: holds their texts on environment variables, files and exit status.
//! - [`completions`]: writes completion scripts for shells.

mod command_reference;
pub(crate) mod completions;
mod conventions;
pub(crate) mod man_page;
