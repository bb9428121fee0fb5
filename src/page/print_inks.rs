//! [`Print`]: the inks that page files ask for.

use std::path::PathBuf;

use serde::Deserialize;
use toml::Spanned;

use super::page_source::Source;
use crate::colour::srgb::Colour;
use crate::error::Error;

/// Inks by name.
const INKS: [&str; 3] = ["screen", "k", "cmyk"];

/// What a page tells of its inks.
#[derive(Debug, Clone, Default)]
pub struct PrintKeys {
    /// `screen`, `k` or `cmyk`.
    pub ink: Option<Spanned<String>>,
    /// The ICC profile of the press.
    pub icc: Option<Spanned<String>>,
    /// All inks of a place together, percent of one.
    pub ink_limit: Option<Spanned<f64>>,
    /// Colours with inks of their own.
    pub spot: Option<Spanned<Spots>>,
}

/// One colour with an ink of its own, or several.
#[derive(Debug, Clone, Deserialize)]
#[serde(
    untagged,
    expecting = "this is not a spot colour; write { name = \"PANTONE 185 C\", colour = \"#e4002b\" }, or a list of these"
)]
pub enum Spots {
    /// One.
    One(SpotKeys),
    /// Several.
    Several(Vec<SpotKeys>),
}

/// A colour with an ink of its own.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpotKeys {
    /// The name of the ink, such as `PANTONE 185 C`.
    pub name: String,
    /// The colour on the page that is printed with it.
    #[serde(alias = "color")]
    pub colour: Colour,
}

/// The inks of the pages of a file: what all pages that tell of any agree on. Nothing is told of what is `None`.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Print {
    /// `screen`, `k` or `cmyk`.
    pub ink: Option<String>,
    /// The file of the ICC profile of the press.
    pub icc: Option<PathBuf>,
    /// All inks of a place together, percent of one.
    pub ink_limit: Option<f64>,
    /// Colours with inks of their own.
    pub spots: Vec<SpotKeys>,
}

impl Print {
    /// Adds what a page tells.
    ///
    /// # Errors
    /// At a key that is not what it should be, or that says another thing than a page before.
    pub(crate) fn add(&mut self, keys: &PrintKeys, source: &Source) -> Result<(), Error> {
        if let Some(ink) = &keys.ink {
            let name = ink.get_ref().to_ascii_lowercase();
            if !INKS.contains(&name.as_str()) {
                return Err(source.unknown(ink, "set of inks", &INKS));
            }
            agree(&mut self.ink, name, ink, source)?;
        }
        if let Some(icc) = &keys.icc {
            agree(&mut self.icc, source.existing(icc, "ICC profile")?, icc, source)?;
        }
        if let Some(limit) = &keys.ink_limit {
            if !(100.0..=400.0).contains(limit.get_ref()) {
                let advice = "write percent of one ink, from 100 to 400, such as 300";
                return Err(source.fault(&limit.span(), "this is not an ink limit", advice));
            }
            if let Some(ink) = keys.ink.as_ref().filter(|ink| !ink.get_ref().eq_ignore_ascii_case("cmyk")) {
                let message = format!("an ink limit needs four inks, and these are `{}`", ink.get_ref());
                return Err(source.fault(&limit.span(), &message, "leave it out, or write ink = \"cmyk\""));
            }
            agree(&mut self.ink_limit, *limit.get_ref(), limit, source)?;
        }
        let Some(spots) = &keys.spot else { return Ok(()) };
        let several = match spots.get_ref() {
            Spots::One(one) => std::slice::from_ref(one),
            Spots::Several(several) => several,
        };
        for spot in several {
            if spot.name.trim().is_empty() {
                let advice = "write its name, such as name = \"PANTONE 185 C\"";
                return Err(source.fault(&spots.span(), "a spot colour needs a name", advice));
            }
            let same = self.spots.iter().find(|other| other.colour == spot.colour);
            match same {
                Some(other) if other.name != spot.name => {
                    let message = format!("`{}` already prints as `{}`", spot.colour.hex(), other.name);
                    return Err(source.fault(&spots.span(), &message, "give each colour one ink"));
                }
                Some(_) => {}
                None => self.spots.push(spot.clone()),
            }
        }
        Ok(())
    }
}

/// Takes a value, which is to be the same for all pages.
fn agree<T: PartialEq, K>(
    all: &mut Option<T>,
    own: T,
    key: &Spanned<K>,
    source: &Source,
) -> Result<(), Error> {
    if all.as_ref().is_some_and(|all| *all != own) {
        let message = "an earlier page has other inks, and one file has one set of inks";
        return Err(source.fault(&key.span(), message, "use the same inks on all pages, or write two files"));
    }
    *all = Some(own);
    Ok(())
}
