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

pub use crate::assert_drawing;

/// The variable that approves drawings as they are.
pub const BLESS: &str = "LIGNE_BLESS";

/// Lines of a failure, at most.
const MOST_LINES: usize = 30;

/// Asserts that a [`Drawing`] is as it was approved: `assert_drawing!(drawing, "name")`.
///
/// The approved drawing is `tests/drawings/NAME.svg` of the crate under test, or `NAME.svg` in a folder of its own:
/// `assert_drawing!(drawing, "name", folder = "tests/golden")`. `tolerance = "0.1px"` may be added at the end, as in
/// `ligne diff --tolerance`. See [`self`].
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

/// Whether drawings that differ are approved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Approval {
    /// They fail.
    None,
    /// They are written over the approved ones.
    Bless,
    /// They fail, and it is said why they are not approved: a machine asked.
    Refused,
}

impl Approval {
    /// What the variables `LIGNE_BLESS` and `CI` ask for.
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

/// Compares a drawing with `NAME.svg` in a folder, or approves it; what [`assert_drawing!`] calls.
///
/// # Errors
/// What differs in words, and where to look at it.
pub fn check(
    drawing: &Drawing,
    name: &str,
    folder: &Path,
    tolerance: &str,
    approval: &Approval,
) -> Result<(), String> {
    let approved = folder.join(format!("{name}.svg"));
    let drawn = drawing.to_svg(&SvgOptions::default());
    let known = std::fs::read_to_string(&approved);
    let difference = match &known {
        Ok(known) if *known == drawn => return Ok(()),
        Ok(known) => {
            compare(known, &drawn, tolerance).map_err(|error| error.in_file(&approved).to_string())?
        }
        Err(_) => None,
    };
    if difference.as_ref().is_some_and(Diff::is_same) && *approval != Approval::Bless {
        return Ok(());
    }
    if *approval == Approval::Bless {
        let written = std::fs::create_dir_all(approved.parent().unwrap_or(folder))
            .and_then(|()| std::fs::write(&approved, drawn));
        return written.map_err(|error| format!("{}: cannot write: {error}", approved.display()));
    }
    let advice = match approval {
        Approval::Refused => format!("{BLESS} has no effect while CI is set"),
        _ => format!("check the drawing; if the change is intended, approve it with {BLESS}=1"),
    };
    let mut told = match &difference {
        None => format!("`{name}` has no approved drawing {}\n", approved.display()),
        Some(diff) => {
            let lines = diff.lines();
            let more = lines.len().saturating_sub(MOST_LINES);
            let mut text = format!("`{name}` differs from {}: {}\n", approved.display(), diff.summary());
            lines.iter().take(MOST_LINES).for_each(|line| text += &format!("  {line}\n"));
            if more > 0 {
                text += &format!("  and {more} more lines\n");
            }
            text
        }
    };
    let picture = difference.map(|diff| diff.picture(View::Over).to_svg(&SvgOptions::default()));
    for (what, text) in [("actual", Some(drawn)), ("diff", picture)] {
        if let Some(text) = text {
            let path = beside(&approved, name, what);
            match std::fs::write(&path, text) {
                Ok(()) => told += &format!("{what:<10} {}\n", path.display()),
                Err(error) => {
                    told += &format!("{what:<10} cannot be written to {}: {error}\n", path.display())
                }
            }
        }
    }
    Err(told + &advice)
}

fn compare(known: &str, drawn: &str, tolerance: &str) -> Result<Option<Diff>, Error> {
    let tolerances = match tolerance {
        "" => Tolerances::default(),
        text => Tolerances::parse(text)?,
    };
    let options = DiffOptions { tolerances, ..DiffOptions::default() };
    Ok(Some(diff::compare(&Picture::from_svg(known)?, &Picture::from_svg(drawn)?, &options)))
}

/// Where a file for looking at goes: the temporary folder, so that nothing is left in the project, under a name of the
/// approved drawing's own, so that tests that run side by side do not write over each other's.
fn beside(approved: &Path, name: &str, what: &str) -> PathBuf {
    let flat: String = name.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    let place = FxBuildHasher.hash_one(approved);
    std::env::temp_dir().join(format!("ligne-{flat}-{place:016x}.{what}.svg"))
}
