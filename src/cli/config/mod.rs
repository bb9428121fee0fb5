//! Options from environment variables and `ligne.toml`, added to the words of a call before parsing.
//!
//! Precedence: option, environment variable, `ligne.toml`, built-in default.
//!
//! Files, in reading order:
//! - [`call_defaults`]: inserts the words.
//! - [`project_config`]: finds and reads `ligne.toml`.
//! - [`toml_options`]: turns the keys of a TOML table into options.
//!
//! Case files of `ligne test` use it, too.

pub(crate) mod call_defaults;
pub(crate) mod project_config;
pub(crate) mod toml_options;
