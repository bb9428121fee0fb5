//! Options, `ligne.toml`, style keys, exit status, and suggestions in errors.

mod advice;
mod config;
mod exit_status;
mod style_keys;
