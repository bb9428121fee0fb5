//! [`PrintInks`]: the inks that the pages of a file request.
//!
//! One file has one set of inks, so pages that set the same key must agree.

use std::path::PathBuf;

use serde::Deserialize;
use toml::Spanned;

use super::page_source::PageSource;
use crate::colour::srgb::Colour;
use crate::error::Error;

/// Names of ink sets.
const INK_SETS: [&str; 3] = ["screen", "k", "cmyk"];

/// The keys of a page for its inks.
#[derive(Debug, Clone, Default)]
pub(crate) struct PrintKeys {
    /// `screen`, `k` or `cmyk`.
    pub ink: Option<Spanned<String>>,
    /// The ICC profile of the press.
    pub icc: Option<Spanned<String>>,
    /// Maximum total ink at a point, in percent of one ink.
    pub ink_limit: Option<Spanned<f64>>,
    /// Spot colours.
    pub spot: Option<Spanned<SpotColours>>,
}

/// One or more spot colours.
#[derive(Debug, Clone, Deserialize)]
#[serde(
    untagged,
    expecting = "this is not a spot colour; write { name = \"PANTONE 185 C\", colour = \"#e4002b\" }, or a list of these"
)]
pub(crate) enum SpotColours {
    /// One.
    One(SpotKeys),
    /// Several.
    Several(Vec<SpotKeys>),
}

/// A spot colour: a colour that is printed with its own ink.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpotKeys {
    /// Name of the ink, such as `PANTONE 185 C`.
    pub name: String,
    /// The colour on the page that the ink replaces.
    #[serde(alias = "color")]
    pub colour: Colour,
}

/// The inks of all pages of a file. A field is `None` if no page sets it.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct PrintInks {
    /// `screen`, `k` or `cmyk`.
    pub ink: Option<String>,
    /// File of the ICC profile of the press.
    pub icc: Option<PathBuf>,
    /// Maximum total ink at a point, in percent of one ink.
    pub ink_limit: Option<f64>,
    /// Spot colours.
    pub(crate) spots: Vec<SpotKeys>,
}

impl PrintInks {
    /// Adds the inks of a page.
    ///
    /// # Errors
    /// Returns an error if a key is invalid, or differs from that of an earlier page.
    pub(crate) fn add(&mut self, keys: &PrintKeys, source: &PageSource) -> Result<(), Error> {
        if let Some(ink) = &keys.ink {
            let name = ink.get_ref().to_ascii_lowercase();
            if !INK_SETS.contains(&name.as_str()) {
                return Err(source.unknown(ink, "set of inks", &INK_SETS));
            }
            set_once(&mut self.ink, name, ink, source)?;
        }
        if let Some(icc) = &keys.icc {
            set_once(&mut self.icc, source.existing(icc, "ICC profile")?, icc, source)?;
        }
        if let Some(limit) = &keys.ink_limit {
            let advice = "write percent of one ink, from 100 to 400, such as 300";
            let is_limit = |percent: &f64| (100.0..=400.0).contains(percent);
            source.check([limit], is_limit, "this is not an ink limit", advice)?;
            if let Some(ink) = keys.ink.as_ref().filter(|ink| !ink.get_ref().eq_ignore_ascii_case("cmyk")) {
                let message = format!("an ink limit needs four inks, and these are `{}`", ink.get_ref());
                return Err(source.fault(&limit.span(), &message, "leave it out, or write ink = \"cmyk\""));
            }
            set_once(&mut self.ink_limit, *limit.get_ref(), limit, source)?;
        }
        let Some(spots) = &keys.spot else { return Ok(()) };
        let several = match spots.get_ref() {
            SpotColours::One(one) => std::slice::from_ref(one),
            SpotColours::Several(several) => several,
        };
        for spot in several {
            let (has_name, advice) =
                (!spot.name.trim().is_empty(), "write its name, such as name = \"PANTONE 185 C\"");
            source.check([spots], |_| has_name, "a spot colour needs a name", advice)?;
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

/// Sets a value that must be the same for all pages.
fn set_once<T: PartialEq, K>(
    all: &mut Option<T>,
    own: T,
    key: &Spanned<K>,
    source: &PageSource,
) -> Result<(), Error> {
    if all.as_ref().is_some_and(|all| *all != own) {
        let message = "an earlier page has other inks, and one file has one set of inks";
        return Err(source.fault(&key.span(), message, "use the same inks on all pages, or write two files"));
    }
    *all = Some(own);
    Ok(())
}
