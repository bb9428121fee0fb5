//! Keys of style sheets on the command line.
//!
//! 1. [`list`] selects keys by pattern and prints them as text or JSON ([`key_listing`]), or as the reference
//!    page ([`key_reference`]).
//! 2. [`settings`] lists the keys that shells complete after `--set`.
//! 3. [`unknown_option`] adds a tip to the error about an unknown option that has the name of a key:
//!    `--hidden` may stand for `--set lines.hidden=…`.

mod key_listing;
mod key_reference;
mod unknown_option;

use std::sync::OnceLock;

pub(crate) use unknown_option::with_tip;

use crate::error::Error;
use crate::error::spelling::british;
use crate::geometry::names::glob::Glob;
use crate::style::StyleKey;
use crate::style::keys::advice::{alternatives, listed};

/// Lists the keys that match a pattern as text or JSON, or returns the reference page. A pattern without `*`
/// and `?` matches any part of a key.
pub(crate) fn list(glob: &str, json: bool, reference: bool) -> Result<String, Error> {
    if reference {
        return Ok(key_reference::page());
    }
    let spelt = british(glob);
    let is_pattern = spelt.contains(['*', '?']);
    let pattern = Glob::new(if is_pattern { spelt.clone() } else { format!("*{spelt}*") });
    let keys: Vec<&StyleKey> = StyleKey::all()
        .iter()
        .filter(|key| pattern.matches(&key.path) || pattern.matches(&key.bare_path()))
        .collect();
    if keys.is_empty() {
        let near = alternatives(&spelt, false);
        let advice = match near[..] {
            [] => "`ligne styles --keys` lists all keys".to_owned(),
            _ => format!("did you mean {}?", listed(&near)),
        };
        return Err(Error::new(format!("no style key matches `{glob}`")).at("--keys").remedy(advice));
    }
    Ok(if json { key_listing::json(&keys) } else { key_listing::text(&keys) })
}

/// Values for shell completion of `--set`: all settable keys, each with `=`.
pub(crate) fn settings() -> &'static [&'static str] {
    static SETTINGS: OnceLock<Vec<&'static str>> = OnceLock::new();
    SETTINGS.get_or_init(|| {
        let settable = StyleKey::all().iter().filter(|key| key.is_settable());
        // The list lives as long as the program, so leaking is intended.
        settable.map(|key| &*format!("{}=", key.path).leak()).collect()
    })
}
