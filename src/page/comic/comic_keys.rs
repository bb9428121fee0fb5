//! [`ComicPage`]: the keys of a comic page in a page file (TOML), of its panels, and of their balloons and
//! sound effects.
//!
//! Keys that may be missing take the default stated with each. Spans locate a key in the file for error
//! messages.

use std::path::PathBuf;

use serde::Deserialize;
use toml::Spanned;

use crate::colour::srgb::Colour;
use crate::page::figure::figure_style::style_file;
use crate::page::figure::{CameraSpec, Models};
use crate::page::layout::Reading;
use crate::page::mm_length::Mm;
use crate::page::page_size::PageSize;
use crate::page::page_source::PageSource;
use crate::page::print_inks::{PrintKeys, SpotColours};

/// A comic page in a page file.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct ComicPage {
    /// Title for viewers. Default: the name of the file.
    pub title: Option<String>,
    /// Size after trimming. Default: A4.
    pub size: Spanned<PageSize>,
    /// Whether the page is in landscape format. Default: no.
    pub landscape: bool,
    /// Whether the page is a double page. Default: no.
    pub spread: bool,
    /// Width of the bleed outside the trim. Default: 0.
    pub bleed: Spanned<Mm>,
    /// Distance of the safe area for letters from the trim. Default: 5 mm.
    pub safe: Spanned<Mm>,
    /// Distance from the trim to the panels. Default: 12 mm.
    pub margin: Spanned<Mm>,
    /// Reading direction, `ltr` or `rtl`. Default: ltr.
    pub reading: ReadingKey,
    /// Colour of the paper. Default: white.
    pub background: Colour,
    /// Layout of the panels, see `page::layout`. Default: `1`, one panel.
    pub layout: Spanned<String>,
    /// Gap between panels: one length, or one between columns and one between rows. Default: 4 mm.
    pub gutter: Spanned<Gutter>,
    /// Line width of panel borders; 0 for none. Default: 0.6 mm.
    pub border: Spanned<Mm>,
    /// Maximum deviation of hand-drawn panel borders. Default: 0.
    pub hand: Spanned<Mm>,
    /// Style of the panels. Default: comic.
    pub style: Spanned<String>,
    /// Changes to the style, each `KEY=VALUE`.
    pub set: Vec<Spanned<String>>,
    /// Inks of the PDF: `screen`, `k` or `cmyk`. Default: screen.
    pub ink: Option<Spanned<String>>,
    /// ICC profile of the press.
    pub icc: Option<Spanned<String>>,
    /// Maximum total ink at a point, in percent of one ink.
    pub ink_limit: Option<Spanned<f64>>,
    /// One or more spot colours.
    pub spot: Option<Spanned<SpotColours>>,
    /// Settings of all letters.
    pub lettering: LetteringKeys,
    /// The panels, in reading order.
    pub panel: Vec<Spanned<PanelKeys>>,
}

/// Reading direction of a page.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum ReadingKey {
    /// From left to right.
    #[default]
    Ltr,
    /// From right to left.
    Rtl,
}

impl From<ReadingKey> for Reading {
    fn from(key: ReadingKey) -> Self {
        match key {
            ReadingKey::Ltr => Self::Ltr,
            ReadingKey::Rtl => Self::Rtl,
        }
    }
}

/// Gaps between panels.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(untagged, expecting = "this is not a gutter; write one length, or [between columns, between rows]")]
pub(crate) enum Gutter {
    /// The same gap everywhere.
    All(Mm),
    /// The gap between columns, and the gap between rows.
    Each([Mm; 2]),
}

/// Settings of all letters of a page.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct LetteringKeys {
    /// Name of a bundled font, or a font file. Default: comic.
    pub font: Spanned<String>,
    /// Em size of the letters. Default: 3.4 mm.
    pub size: Spanned<Mm>,
    /// Whether all letters are upper case. Default: yes.
    pub upper_case: bool,
    /// Language for hyphenation, two letters of ISO 639-1. Default: none, words are not hyphenated.
    pub language: Option<String>,
    /// Line width of balloons. Default: 0.4 mm.
    pub line: Spanned<Mm>,
    /// Colour of letters and lines. Default: black.
    #[serde(alias = "color")]
    pub colour: Colour,
    /// Fill colour of balloons. Default: white.
    pub fill: Colour,
}

/// A panel of a comic page.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct PanelKeys {
    /// Name of its layers. Default: `panel-1` and so on.
    pub name: Option<Spanned<String>>,
    /// Position outside the layout: left, top, width and height, from the corner of the trimmed page.
    pub at: Option<Spanned<[Mm; 4]>>,
    /// Whether the panel may overlap other panels. Default: no.
    pub inset: bool,
    /// Whether the panel extends into the bleed where it touches the rim of the layout. Default: no.
    pub bleed: bool,
    /// Line width of the border; 0 for none. Default: that of the page.
    pub border: Option<Spanned<Mm>>,
    /// One or more models.
    pub model: Models,
    /// Camera. Default: from the front, right and above.
    pub camera: Option<Spanned<CameraSpec>>,
    /// Style. Default: that of the page.
    pub style: Option<Spanned<String>>,
    /// Changes to the style, applied after those of the page.
    pub set: Vec<Spanned<String>>,
    /// Background colour, or `none`. Default: that of the style.
    pub background: Option<Spanned<String>>,
    /// Time of animations, in seconds.
    pub time: Option<Spanned<f64>>,
    /// Name of the animation.
    pub animation: Option<Spanned<String>>,
    /// Parts that are drawn over the border of the panel.
    #[serde(rename = "break")]
    pub breaking: Vec<Spanned<String>>,
    /// Parts that balloons must not cover.
    pub keep: Vec<Spanned<String>>,
    /// Balloons and captions, in reading order.
    pub balloon: Vec<BalloonKeys>,
    /// Sound effects.
    pub sound: Vec<SoundKeys>,
}

/// A balloon or caption.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BalloonKeys {
    /// Text of the balloon.
    pub text: Spanned<String>,
    /// Kind of balloon. Default: speech.
    #[serde(default)]
    pub kind: BalloonKind,
    /// Part that the tail points at. Default: no tail.
    pub tail: Option<Spanned<String>>,
    /// Position of the centre, as shares of the panel's width and height. Default: placed automatically.
    pub at: Option<Spanned<[f64; 2]>>,
    /// Em size of the letters. Default: that of the page.
    pub size: Option<Spanned<Mm>>,
    /// Fill colour. Default: that of the page.
    pub fill: Option<Colour>,
}

/// Kind of balloon.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum BalloonKind {
    /// An ellipse with a tail.
    #[default]
    Speech,
    /// A cloud with a tail of small bubbles.
    Thought,
    /// A burst of spikes.
    Shout,
    /// A dashed ellipse.
    Whisper,
    /// A box without a tail.
    Caption,
}

/// A sound effect.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SoundKeys {
    /// Text of the sound.
    pub text: Spanned<String>,
    /// Position of the centre, as shares of the panel's width and height. Default: 0.5, 0.75.
    #[serde(default = "low")]
    pub at: Spanned<[f64; 2]>,
    /// Height of capitals. Default: 12 mm.
    pub size: Option<Spanned<Mm>>,
    /// Rotation in degrees, clockwise if positive. Default: 0.
    #[serde(default = "none")]
    pub rotate: Spanned<f64>,
    /// Angle of the arc that the text follows, degrees; positive arcs rise in the middle. Default: 0.
    #[serde(default = "none")]
    pub arc: Spanned<f64>,
    /// Horizontal stretch factor of the letters. Default: 1.
    pub stretch: Option<Spanned<f64>>,
    /// Fill colour of the letters. Default: white.
    pub fill: Option<Colour>,
    /// Colour of the outline. Default: that of other letters.
    #[serde(alias = "color")]
    pub colour: Option<Colour>,
    /// Width of the outline. Default: a tenth of the size.
    pub line: Option<Spanned<Mm>>,
    /// Name of a bundled font, or a font file. Default: that of the page.
    pub font: Option<Spanned<String>>,
}

fn low() -> Spanned<[f64; 2]> {
    without_span([0.5, 0.75])
}

fn none() -> Spanned<f64> {
    without_span(0.0)
}

fn without_span<T>(value: T) -> Spanned<T> {
    Spanned::new(0..0, value)
}

impl Default for ComicPage {
    fn default() -> Self {
        Self {
            title: None,
            size: without_span(PageSize::default()),
            landscape: false,
            spread: false,
            bleed: without_span(Mm(0.0)),
            safe: without_span(Mm(5.0)),
            margin: without_span(Mm(12.0)),
            reading: ReadingKey::Ltr,
            background: Colour::WHITE,
            layout: without_span("1".to_owned()),
            gutter: without_span(Gutter::All(Mm(4.0))),
            border: without_span(Mm(0.6)),
            hand: without_span(Mm(0.0)),
            style: without_span("comic".to_owned()),
            set: Vec::new(),
            ink: None,
            icc: None,
            ink_limit: None,
            spot: None,
            lettering: LetteringKeys::default(),
            panel: Vec::new(),
        }
    }
}

impl Default for LetteringKeys {
    fn default() -> Self {
        Self {
            font: without_span("comic".to_owned()),
            size: without_span(Mm(3.4)),
            upper_case: true,
            language: None,
            line: without_span(Mm(0.4)),
            colour: Colour::BLACK,
            fill: Colour::WHITE,
        }
    }
}

impl ComicPage {
    /// The keys that set the inks of the page.
    #[must_use]
    pub(crate) fn print(&self) -> PrintKeys {
        let Self { ink, icc, ink_limit, spot, .. } = self.clone();
        PrintKeys { ink, icc, ink_limit, spot }
    }

    /// The files that the page is made from: models, styles, cameras and the ICC profile.
    #[must_use]
    pub(crate) fn inputs(&self, source: &PageSource) -> Vec<PathBuf> {
        let mut files: Vec<PathBuf> = style_file(&self.style, source).into_iter().collect();
        files.extend(self.icc.as_ref().map(|icc| source.resolve(icc.get_ref())));
        for panel in self.panel.iter().map(Spanned::get_ref) {
            files.extend(panel.model.files(source));
            files.extend(panel.style.as_ref().and_then(|style| style_file(style, source)));
            files.extend(panel.camera.as_ref().and_then(|aim| aim.get_ref().file(source)));
        }
        files
    }
}
