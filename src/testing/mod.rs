//! Approval tests of drawings: approved SVG files are kept next to the tests of a Rust project.
//!
//! ```no_run
//! use ligne::testing::assert_drawing;
//! use ligne::{Camera, Scene, Style, render};
//!
//! #[test]
//! fn the_lid_looks_as_it_did() {
//!     let scene = Scene::open("models/lid.glb").unwrap();
//!     let drawing = render(&scene, &Camera::three_quarter().fit(&scene), &Style::default()).unwrap();
//!     // Compared with tests/drawings/lid.svg; written there by `LIGNE_BLESS=1 cargo test`.
//!     assert_drawing!(drawing, "lid");
//! }
//! ```
//!
//! 1. The drawing is written as SVG. A file with equal bytes passes.
//! 2. Otherwise [`crate::diff`] compares both files. If it finds no difference, the test passes.
//! 3. If the drawings differ, the test panics with the differences and with the paths of two files: the new
//!    drawing and a picture of the difference.
//! 4. If the environment variable `LIGNE_BLESS` is set to anything but `0`, the new drawing replaces the
//!    approved one. This has no effect while `CI` is set, because people approve drawings.

use std::hash::BuildHasher;
use std::path::{Path, PathBuf};

use rustc_hash::FxBuildHasher;

use crate::diff::{self, Diff, DiffOptions, Picture, Tolerances, View};
use crate::drawing::Drawing;
use crate::error::Error;
use crate::export::SvgOptions;

pub use super::assert_drawing;

/// Environment variable that approves changed drawings.
pub const BLESS: &str = "LIGNE_BLESS";

/// Most lines of a failure message.
const MAX_FAILURE_LINES: usize = 30;

/// Asserts that a [`Drawing`] equals its approved version: `assert_drawing!(drawing, "name")`.
///
/// The approved drawing is `tests/drawings/NAME.svg` of the crate under test. Another folder can be given by
/// `assert_drawing!(drawing, "name", folder = "tests/golden")`. A last argument `tolerance = "0.1px"` has the
/// same form as in `ligne diff --tolerance`. See [`self`].
#[macro_export]
macro_rules! assert_drawing {
    ($drawing:expr, $name:expr $(,)?) => {
        $crate::testing::assert_drawing!($drawing, $name, folder = "tests/drawings")
    };
    ($drawing:expr, $name:expr, tolerance = $tolerance:expr $(,)?) => {
        $crate::testing::assert_drawing!($drawing, $name, folder = "tests/drawings", tolerance = $tolerance)
    };
    ($drawing:expr, $name:expr, folder = $folder:expr $(,)?) => {
        $crate::testing::assert_drawing!($drawing, $name, folder = $folder, tolerance = "")
    };
    ($drawing:expr, $name:expr, folder = $folder:expr, tolerance = $tolerance:expr $(,)?) => {{
        let folder = ::std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join($folder);
        if let ::std::result::Result::Err(difference) = $crate::testing::check(
            &$drawing,
            $name,
            &folder,
            $tolerance,
            &$crate::testing::Approval::of_environment(),
        ) {
            ::std::panic!("{difference}");
        }
    }};
}

/// Handling of drawings that differ from their approved version.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Approval {
    /// The test fails.
    None,
    /// The new drawing replaces the approved one.
    Bless,
    /// The test fails and explains why nothing is approved on a build server.
    Refused,
}

impl Approval {
    /// Reads the environment variables `LIGNE_BLESS` and `CI`.
    #[must_use]
    pub fn of_environment() -> Self {
        let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty() && value != "0");
        match (set(BLESS), set("CI")) {
            (false, _) => Self::None,
            (true, false) => Self::Bless,
            (true, true) => Self::Refused,
        }
    }
}

/// Compares a drawing with `NAME.svg` in a folder, or approves it. Called by [`assert_drawing!`].
///
/// # Errors
/// A description of the differences, with the paths of files to inspect.
pub fn check(
    drawing: &Drawing,
    name: &str,
    folder: &Path,
    tolerance: &str,
    approval: &Approval,
) -> Result<(), String> {
    let approved = folder.join(format!("{name}.svg"));
    let actual_svg = drawing.to_svg(&SvgOptions::default());
    let approved_text = std::fs::read_to_string(&approved);
    let difference = match &approved_text {
        Ok(approved_text) if *approved_text == actual_svg => return Ok(()),
        Ok(approved_text) => compare(approved_text, &actual_svg, tolerance)
            .map_err(|error| error.in_file(&approved).to_string())?,
        Err(_) => None,
    };
    if difference.as_ref().is_some_and(Diff::is_same) && *approval != Approval::Bless {
        return Ok(());
    }
    if *approval == Approval::Bless {
        let written = std::fs::create_dir_all(approved.parent().unwrap_or(folder))
            .and_then(|()| std::fs::write(&approved, actual_svg));
        return written.map_err(|error| format!("{}: cannot write: {error}", approved.display()));
    }
    let advice = match approval {
        Approval::Refused => format!("{BLESS} has no effect while CI is set"),
        _ => format!("check the drawing; if the change is intended, approve it with {BLESS}=1"),
    };
    let mut failure_text = match &difference {
        None => format!("`{name}` has no approved drawing {}\n", approved.display()),
        Some(diff) => {
            let lines = diff.lines();
            let more = lines.len().saturating_sub(MAX_FAILURE_LINES);
            let mut text = format!("`{name}` differs from {}: {}\n", approved.display(), diff.summary());
            lines.iter().take(MAX_FAILURE_LINES).for_each(|line| text += &format!("  {line}\n"));
            if more > 0 {
                text += &format!("  and {more} more lines\n");
            }
            text
        }
    };
    let picture = difference.map(|diff| diff.picture(View::Over).to_svg(&SvgOptions::default()));
    for (what, text) in [("actual", Some(actual_svg)), ("diff", picture)] {
        if let Some(text) = text {
            let path = review_path(&approved, name, what);
            match std::fs::write(&path, text) {
                Ok(()) => failure_text += &format!("{what:<10} {}\n", path.display()),
                Err(error) => {
                    failure_text += &format!("{what:<10} cannot be written to {}: {error}\n", path.display())
                }
            }
        }
    }
    Err(failure_text + &advice)
}

/// Compares two files with a tolerance as text.
fn compare(known: &str, drawn: &str, tolerance: &str) -> Result<Option<Diff>, Error> {
    let tolerances = match tolerance {
        "" => Tolerances::default(),
        text => Tolerances::parse(text)?,
    };
    let options = DiffOptions { tolerances, ..DiffOptions::default() };
    Ok(Some(diff::compare(&Picture::from_svg(known)?, &Picture::from_svg(drawn)?, &options)))
}

/// Path of a file for inspection in the temporary folder. The name contains a hash of the approved path, so
/// that parallel tests do not overwrite each other's files.
fn review_path(approved: &Path, name: &str, what: &str) -> PathBuf {
    let flat: String = name.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    let place = FxBuildHasher.hash_one(approved);
    std::env::temp_dir().join(format!("ligne-{flat}-{place:016x}.{what}.svg"))
}
