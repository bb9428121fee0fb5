//! Options, `ligne.toml`, style keys, exit status, and advice in errors.

mod advice;
mod config;
mod exit_status;
mod style_keys;
