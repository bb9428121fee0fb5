//! What a page file tells of a comic page: [`ComicPage`], its panels, and the letters in them.

use std::path::PathBuf;

use serde::Deserialize;
use toml::Spanned;

use crate::colour::srgb::Colour;
use crate::page::figure::figure_style::file;
use crate::page::figure::{Aim, Models};
use crate::page::layout::Reading;
use crate::page::mm_length::Mm;
use crate::page::page_size::Size;
use crate::page::page_source::Source;
use crate::page::print_inks::{PrintKeys, Spots};

/// What a page file tells of a comic page.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ComicPage {
    /// What viewers call it. Default: the name of the file.
    pub title: Option<String>,
    /// How large it is when it is cut. Default: A4.
    pub size: Spanned<Size>,
    /// Whether it lies on its longer side. Default: no.
    pub landscape: bool,
    /// Whether it is two pages side by side. Default: no.
    pub spread: bool,
    /// How far what is printed reaches beyond the cut. Default: 0.
    pub bleed: Spanned<Mm>,
    /// How far letters stay from the cut. Default: 5 mm.
    pub safe: Spanned<Mm>,
    /// From the cut to the panels. Default: 12 mm.
    pub margin: Spanned<Mm>,
    /// `ltr` or `rtl`: in which direction it is read. Default: ltr.
    pub reading: ReadingKey,
    /// Colour of the paper. Default: white.
    pub background: Colour,
    /// How panels part it. Default: `1`, one panel.
    pub layout: Spanned<String>,
    /// Between panels: one length, or one between columns and one between rows. Default: 4 mm.
    pub gutter: Spanned<Gutter>,
    /// Width of the lines around panels; 0 for none. Default: 0.6 mm.
    pub border: Spanned<Mm>,
    /// How far these lines stray, as drawn by a hand. Default: 0.
    pub hand: Spanned<Mm>,
    /// The style of the panels. Default: comic.
    pub style: Spanned<String>,
    /// Changes to it, `KEY=VALUE` each.
    pub set: Vec<Spanned<String>>,
    /// Inks of PDF: `screen`, `k` or `cmyk`. Default: screen.
    pub ink: Option<Spanned<String>>,
    /// The ICC profile of the press.
    pub icc: Option<Spanned<String>>,
    /// All inks of a place together, percent of one.
    pub ink_limit: Option<Spanned<f64>>,
    /// A colour that is printed with an ink of its own, or several.
    pub spot: Option<Spanned<Spots>>,
    /// How letters are set.
    pub lettering: LetteringKeys,
    /// The panels, in reading order.
    pub panel: Vec<Spanned<PanelKeys>>,
}

/// In which direction a page is read.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ReadingKey {
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

/// What is between panels.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(untagged, expecting = "this is not a gutter; write one length, or [between columns, between rows]")]
pub enum Gutter {
    /// Everywhere.
    All(Mm),
    /// Between columns, and between rows.
    Each([Mm; 2]),
}

/// How letters are set.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LetteringKeys {
    /// A font that comes with the program, or the file of one. Default: comic.
    pub font: Spanned<String>,
    /// The em of the letters. Default: 3.4 mm.
    pub size: Spanned<Mm>,
    /// Whether all letters are capitals. Default: yes.
    pub upper_case: bool,
    /// The language, as two letters of ISO 639-1, that words are parted in. Default: none, words stay whole.
    pub language: Option<String>,
    /// Width of the lines around balloons. Default: 0.4 mm.
    pub line: Spanned<Mm>,
    /// Colour of letters and lines. Default: black.
    #[serde(alias = "color")]
    pub colour: Colour,
    /// Colour of balloons. Default: white.
    pub fill: Colour,
}

/// A panel.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PanelKeys {
    /// What its layers are called by. Default: `panel-1` and so on.
    pub name: Option<Spanned<String>>,
    /// Its place, where it is none of the layout: left, top, width and height from the corner of the cut page.
    pub at: Option<Spanned<[Mm; 4]>>,
    /// Whether it lies over others. Default: no.
    pub inset: bool,
    /// Whether it reaches to the edge of what is printed, where it is at the rim of the layout. Default: no.
    pub bleed: bool,
    /// Width of the line around it; 0 for none. Default: that of the page.
    pub border: Option<Spanned<Mm>>,
    /// The model or models in it.
    pub model: Models,
    /// From where they are seen. Default: from the front, right and above.
    pub camera: Option<Spanned<Aim>>,
    /// The style. Default: that of the page.
    pub style: Option<Spanned<String>>,
    /// Changes to it, behind those of the page.
    pub set: Vec<Spanned<String>>,
    /// Its colour, or `none`. Default: that of the style.
    pub background: Option<Spanned<String>>,
    /// The moment of animations, in seconds.
    pub time: Option<Spanned<f64>>,
    /// Which animation plays.
    pub animation: Option<Spanned<String>>,
    /// Parts that are drawn over the line around the panel.
    #[serde(rename = "break")]
    pub breaking: Vec<Spanned<String>>,
    /// Parts that no balloon covers.
    pub keep: Vec<Spanned<String>>,
    /// Balloons and captions, in reading order.
    pub balloon: Vec<BalloonKeys>,
    /// Sound effects.
    pub sound: Vec<SoundKeys>,
}

/// What a balloon says, and how.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BalloonKeys {
    /// What it says.
    pub text: Spanned<String>,
    /// Of which kind it is. Default: speech.
    #[serde(default)]
    pub kind: BalloonKind,
    /// The part that its tail points at. Default: no tail.
    pub tail: Option<Spanned<String>>,
    /// Where its middle is, in shares of the panel. Default: it is placed by itself.
    pub at: Option<Spanned<[f64; 2]>>,
    /// The em of its letters. Default: that of the page.
    pub size: Option<Spanned<Mm>>,
    /// Its colour. Default: that of the page.
    pub fill: Option<Colour>,
}

/// Kinds of balloons.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BalloonKind {
    /// An ellipse with a tail.
    #[default]
    Speech,
    /// A cloud with small ones for a tail.
    Thought,
    /// A burst.
    Shout,
    /// An ellipse of dashes.
    Whisper,
    /// A box without a tail.
    Caption,
}

/// A sound effect.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SoundKeys {
    /// The sound.
    pub text: Spanned<String>,
    /// Where its middle is, in shares of the panel. Default: 0.5, 0.75.
    #[serde(default = "low")]
    pub at: Spanned<[f64; 2]>,
    /// Height of its capitals. Default: 12 mm.
    pub size: Option<Spanned<Mm>>,
    /// Degrees by which it is turned, to the right if above 0. Default: 0.
    #[serde(default = "none")]
    pub rotate: Spanned<f64>,
    /// Degrees of the arc it is bent along, up in its middle if above 0. Default: 0.
    #[serde(default = "none")]
    pub arc: Spanned<f64>,
    /// How much wider than high letters are drawn. Default: 1.
    pub stretch: Option<Spanned<f64>>,
    /// Colour of its letters. Default: white.
    pub fill: Option<Colour>,
    /// Colour of the line around them. Default: that of letters.
    #[serde(alias = "color")]
    pub colour: Option<Colour>,
    /// Width of that line. Default: a tenth of its size.
    pub line: Option<Spanned<Mm>>,
    /// A font that comes with the program, or the file of one. Default: that of the page.
    pub font: Option<Spanned<String>>,
}

fn low() -> Spanned<[f64; 2]> {
    told([0.5, 0.75])
}

fn none() -> Spanned<f64> {
    told(0.0)
}

fn told<T>(value: T) -> Spanned<T> {
    Spanned::new(0..0, value)
}

impl Default for ComicPage {
    fn default() -> Self {
        Self {
            title: None,
            size: told(Size::default()),
            landscape: false,
            spread: false,
            bleed: told(Mm(0.0)),
            safe: told(Mm(5.0)),
            margin: told(Mm(12.0)),
            reading: ReadingKey::Ltr,
            background: Colour::WHITE,
            layout: told("1".to_owned()),
            gutter: told(Gutter::All(Mm(4.0))),
            border: told(Mm(0.6)),
            hand: told(Mm(0.0)),
            style: told("comic".to_owned()),
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
            font: told("comic".to_owned()),
            size: told(Mm(3.4)),
            upper_case: true,
            language: None,
            line: told(Mm(0.4)),
            colour: Colour::BLACK,
            fill: Colour::WHITE,
        }
    }
}

impl ComicPage {
    /// What it tells of its inks.
    #[must_use]
    pub fn print(&self) -> PrintKeys {
        let Self { ink, icc, ink_limit, spot, .. } = self.clone();
        PrintKeys { ink, icc, ink_limit, spot }
    }

    /// The files it is made from.
    #[must_use]
    pub fn inputs(&self, source: &Source) -> Vec<PathBuf> {
        let mut files: Vec<PathBuf> = file(&self.style, source).into_iter().collect();
        files.extend(self.icc.as_ref().map(|icc| source.beside(icc.get_ref())));
        for panel in self.panel.iter().map(Spanned::get_ref) {
            files.extend(panel.model.files(source));
            files.extend(panel.style.as_ref().and_then(|style| file(style, source)));
            files.extend(panel.camera.as_ref().and_then(|aim| aim.get_ref().file(source)));
        }
        files
    }
}
