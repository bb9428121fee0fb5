//! Files and messages that the program writes.
//!
//! Files, in reading order:
//! - [`output_files`]: formats and staged files, which are renamed at the end, all or none.
//! - [`numbered_files`]: names such as `frames/%04d.svg`.
//! - [`file_stamp`]: time and size of a file, and waiting until they change.
//! - [`progress`]: the progress bar.
//! - [`number_text`]: numbers as text.
//! - [`exit_status`]: the exit status of an error.

pub(crate) mod exit_status;
pub(crate) mod file_stamp;
pub(crate) mod number_text;
pub(crate) mod numbered_files;
pub(crate) mod output_files;
pub(crate) mod progress;
