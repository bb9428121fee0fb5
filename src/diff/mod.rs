//! Differences between two drawings. Pixels decide whether the drawings are the same; geometry describes the
//! differences.
//!
//! Any SVG can be compared. Two drawings are the same if they look the same within the tolerance and have the
//! same labels. The order, grouping, splitting and joining of paths, the kind of curve command and the format
//! of numbers make no difference.
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
//! 1. `read` turns a file into shapes in px, each with ink and label. It refuses files that would take
//!    unbounded time.
//! 2. `matching` sets equal shapes aside. The others become chains: polylines, joined where they were
//!    split.
//! 3. `matching` computes the intervals of each chain within tolerance of the other drawing. This is the
//!    directed Hausdorff distance, cut off at the tolerance. Chains with uncovered intervals are paired.
//! 4. `changes` turns the events of chains into one finding per mark.
//! 5. `raster_check` rasterises both drawings. If they look the same, findings about their look are
//!    dropped. If they look different and geometry found nothing, the place becomes a finding.
//! 6. `causes` explains many findings by one sentence, such as a moved part.
//!
//! Folders, in reading order: `shapes` the data compared; `markup` XML and CSS in bounded time; `read`
//! SVG to shapes; `curves` chains, distances, indexes; `findings` the result; `matching`, `changes`,
//! `raster_check`, `causes` as above; `report` text, JSON, Markdown and overlay; `canonical` one form
//! for any SVG file. `comparison` runs the steps.

mod canonical;
mod causes;
mod changes;
mod comparison;
mod curves;
mod findings;
mod markup;
mod matching;
mod raster_check;
mod read;
mod report;
mod shapes;
mod tolerances;

pub use canonical::canonical_document::canonical_svg;
pub use findings::finding::{Cause, Change, Diff, Finding, FindingBox, Stage, Verdict};
pub use findings::ink_totals::{Measure, Totals};
pub use findings::pixel_count::PixelDiff;
pub use report::overlay::View;
pub use shapes::ignore_options::Ignore;
pub use shapes::label::Label;
pub use shapes::picture::{Picture, ShapeKind};
pub use shapes::tolerance_table::Tolerances;

/// Options of a comparison.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct DiffOptions {
    /// Largest distance between marks that count as equal. Default: twice the written precision.
    pub tolerances: Tolerances,
    /// Whether to count the pixels that differ as well, at one pixel per px. Default: no.
    pub pixels: bool,
    /// Aspects to ignore. Default: none.
    pub ignore: Ignore,
    /// Whether one finding may stand for all marks of a large drawing whose camera changed. This takes a
    /// tenth of the time; see [`Diff::is_brief`]. Default: no.
    pub brief: bool,
}

impl DiffOptions {
    /// Sets the tolerances.
    #[must_use]
    pub fn within(self, tolerances: Tolerances) -> Self {
        Self { tolerances, ..self }
    }

    /// Sets the aspects to ignore.
    #[must_use]
    pub fn ignoring(self, ignore: Ignore) -> Self {
        Self { ignore, ..self }
    }

    /// Allows one finding for all marks of a large drawing whose camera changed.
    #[must_use]
    pub fn in_brief(self) -> Self {
        Self { brief: true, ..self }
    }

    /// Also compares pixels.
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
    comparison::compare(before, after, options)
}
