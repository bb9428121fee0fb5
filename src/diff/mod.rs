//! [`Diff`]: what differs between two drawings. Their pictures decide whether they are the same, their geometry says what differs.
//!
//! Any SVG can be compared. Two drawings are the same if they look the same within the tolerance, and say the same of their marks: how
//! paths are ordered, grouped, split or joined, whether curves are written as curves, and how numbers look makes no difference.
//!
//! ```
//! use ligne::diff::{self, DiffOptions, Picture};
//!
//! let svg = |d: &str| {
//!     format!(r##"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">
//!         <path fill="none" stroke="#000" d="{d}"/></svg>"##)
//! };
//! let (there, back) = (Picture::from_svg(&svg("M10 10H90"))?, Picture::from_svg(&svg("M90 10L50 10H10"))?);
//! assert!(diff::compare(&there, &back, &DiffOptions::default()).is_same());
//! # Ok::<(), ligne::Error>(())
//! ```
//!
//! 1. [`Picture::from_svg`] reads a file, refusing what would take unbounded time, into shapes in px with ink and label.
//! 2. Shapes that are equal point for point are set aside (`exact`), so that only what differs costs time.
//! 3. The others become chains: flattened within a stated error, and joined where they were split (`chain`).
//! 4. Of each chain of the one drawing, the pieces within tolerance of the other drawing's are found exactly, as
//!    intervals (`cover`): the directed Hausdorff distance, cut off at the tolerance, with an index (`grid`).
//! 5. Chains left with uncovered pieces are paired by their nearest likes (`pair`), and each pair is judged (`judge`).
//! 6. Both drawings are rasterised (`pictures`). Where they look the same, findings about the picture are left out; where they
//!    look different and nothing was found, that is a finding too.

mod align;
mod another_side;
mod area;
mod bundles;
mod canonical;
mod cascade;
mod causes;
mod chain;
mod cover;
mod distance;
mod events;
mod exact;
mod finding;
mod grid;
mod groups;
mod guard;
mod ignore;
mod inherited;
mod ink;
mod json;
mod judge;
mod label;
mod legend;
mod lines;
mod markdown;
mod markup;
mod motion;
mod movers;
mod numbers;
mod outlines;
mod overlay;
mod paint_words;
mod pair;
mod parts;
mod path_data;
mod picture;
mod pictures;
mod pixels;
mod plain;
mod read;
mod regions;
mod said;
mod segment;
mod sheet;
mod stacking;
mod styled;
mod tags;
mod teller;
mod text;
mod tolerance;
mod totals;
mod unlabelled;
mod whole;
mod words;

pub use canonical::canonical_svg;
pub use finding::{Cause, Change, Diff, Finding, Place, Stage, Verdict};
pub use ignore::Ignore;
pub use ink::{Ink, Paint};
pub use label::Label;
pub use overlay::View;
pub use picture::{Picture, Shape, ShapeKind};
pub use pixels::PixelDiff;
pub use tolerance::Tolerances;
pub use totals::{Measure, Totals};

/// How two drawings are compared.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct DiffOptions {
    /// How far ink may lie from where it lay. Default: twice the written precision.
    pub tolerances: Tolerances,
    /// Whether the pixels that differ are counted as well, at one pixel to a px. Default: no.
    pub pixels: bool,
    /// What does not count. Default: everything counts.
    pub ignore: Ignore,
    /// Whether one finding may stand for all marks of a large drawing that is seen from another side, which takes a tenth of the time:
    /// see [`Diff::is_brief`]. Default: no.
    pub brief: bool,
}

impl DiffOptions {
    /// With these tolerances.
    #[must_use]
    pub fn within(self, tolerances: Tolerances) -> Self {
        Self { tolerances, ..self }
    }

    /// Without what does not count.
    #[must_use]
    pub fn ignoring(self, ignore: Ignore) -> Self {
        Self { ignore, ..self }
    }

    /// With one finding for all marks of a large drawing that is seen from another side.
    #[must_use]
    pub fn in_brief(self) -> Self {
        Self { brief: true, ..self }
    }

    /// With a comparison of pixels as well.
    #[must_use]
    pub fn with_pixels(self) -> Self {
        Self { pixels: true, ..self }
    }
}

/// Compares two drawings.
///
/// ```
/// use ligne::diff::{self, DiffOptions, Picture, Verdict};
///
/// let svg = |d: &str| {
///     format!(r##"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">
///         <path class="crease" data-part="lid" fill="none" stroke="#000" d="{d}"/></svg>"##)
/// };
/// let before = Picture::from_svg(&svg("M10 10H90"))?;
///
/// // The same line, split and written backwards.
/// let same = Picture::from_svg(&svg("M90 10L50 10M10 10L50 10"))?;
/// assert!(diff::compare(&before, &same, &DiffOptions::default()).is_same());
///
/// let moved = Picture::from_svg(&svg("M10 12H90"))?;
/// let diff = diff::compare(&before, &moved, &DiffOptions::default());
/// assert_eq!(diff.findings[0].verdict, Verdict::Moved);
/// assert_eq!(diff.findings[0].label.part.as_deref(), Some("lid"));
/// # Ok::<(), ligne::Error>(())
/// ```
#[must_use]
pub fn compare(before: &Picture, after: &Picture, options: &DiffOptions) -> Diff {
    judge::compare(before, after, options)
}
