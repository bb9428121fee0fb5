//! [`Style`]: style sheets in TOML, the options of every stage.
//!
//! 1. `sheet_loader` follows `extends` from sheet to sheet and merges their tables, then the changes of the
//!    command line.
//! 2. `toml_reader` deserialises a table with the position of each error; `tables` has the structs of the
//!    keys.
//! 3. `files` reads the brushes, tiles and pictures that the keys name.
//! 4. `sheet_errors` writes an error with its line, a caret and advice from `keys`, the table of all keys
//!    (see [`StyleKey`]).
//!
//! Further files: `key_spelling`, American spelling; `unitless_lengths`, a warning about numbers without a
//! unit.
//!
//! ```
//! use ligne::Style;
//!
//! let mut style = Style::load("pencil")?;
//! style.set("pen.width", 1.2)?.set("hatching.enabled", false)?;
//! let error = style.set("pen.widht", 1.2).unwrap_err();
//! assert!(error.to_string().contains("did you mean `width`?"), "{error}");
//! # Ok::<(), ligne::Error>(())
//! ```

mod files;
mod key_spelling;
pub(crate) mod keys;
pub(crate) mod sheet_errors;
mod sheet_loader;
mod tables;
pub(crate) mod toml_reader;
#[cfg(feature = "page")]
mod unitless_lengths;

pub use keys::{KeyType, StyleKey};
// Types of the public interface that other areas define.
pub use crate::lines::LineKind;
pub use crate::strokes::{Ink, LineInfo, Pen};
#[cfg(feature = "page")]
pub(crate) use sheet_loader::placed_change;
#[cfg(feature = "page")]
pub(crate) use unitless_lengths::unitless_length_warning;

use crate::chains::ChainOptions;
use crate::colour::srgb::Colour;
use crate::error::Error;
use crate::hatching::{HatchOptions, Paper, Pattern};
use crate::light::{LightOptions, ShadeOptions, ToneOptions};
use crate::lines::LineOptions;
use crate::motion::MotionOptions;
use crate::regions::RegionOptions;
use crate::scene::{GlassOptions, TextureOptions};
use crate::strokes::{PenChoice, StrokeOptions};

/// The options of all stages.
#[derive(Debug, Clone, PartialEq)]
pub struct Style {
    /// Background colour; `None` for transparent. Default: white.
    pub(crate) background: Option<Colour>,
    /// Paper texture. Default: plain.
    pub(crate) paper: Paper,
    /// Kinds of lines to find and draw.
    pub(crate) lines: LineOptions,
    /// Linking, tidying, smoothing and fitting of lines.
    pub(crate) chain: ChainOptions,
    /// Pens, and the rules that choose them.
    pub(crate) stroke: StrokeOptions,
    /// Lights.
    pub(crate) light: LightOptions,
    /// Tones of surfaces and their colours.
    pub(crate) tones: ToneOptions,
    /// How material textures are painted.
    pub(crate) textures: TextureOptions,
    /// Patterns over tones.
    pub(crate) patterns: Vec<Pattern>,
    /// Whether and how regions of tones are painted.
    pub(crate) region: RegionOptions,
    /// Tone bins of hatched surfaces.
    pub(crate) shade: ShadeOptions,
    /// Whether and how surfaces are hatched.
    pub(crate) hatch: HatchOptions,
    /// Treatment of transparent materials.
    pub(crate) glass: GlassOptions,
    /// Bodies with motion lines, and how these are drawn.
    pub(crate) motion: MotionOptions,
    /// Random seed for hand-drawn effects. The same seed gives the same drawing. Default: 0.
    pub(crate) seed: u64,
    /// The keys that the style was made from, for [`Style::set`].
    pub(crate) keys: SheetKeys,
}

/// Merged keys of the sheets and changes of a style. Ignored when styles are compared, because different
/// sheets can describe the same style.
#[derive(Debug, Clone, Default)]
pub(crate) struct SheetKeys(pub toml::Table);

impl PartialEq for SheetKeys {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Default for Style {
    /// The style `ink`.
    fn default() -> Self {
        Self::preset("ink").unwrap_or_else(|| tables::style_sheet::StyleSheet::default().into_style())
    }
}

/// The built-in sheets by name: the files `styles/NAME.toml`.
const BUILT_IN: [(&str, &str); 24] = [
    ("blueprint", include_str!("../../styles/blueprint.toml")),
    ("comic", include_str!("../../styles/comic.toml")),
    ("comic-flats", include_str!("../../styles/comic-flats.toml")),
    ("engraving", include_str!("../../styles/engraving.toml")),
    ("flat", include_str!("../../styles/flat.toml")),
    ("gooch", include_str!("../../styles/gooch.toml")),
    ("gradient", include_str!("../../styles/gradient.toml")),
    ("ink", include_str!("../../styles/ink.toml")),
    ("noir", include_str!("../../styles/noir.toml")),
    ("patent", include_str!("../../styles/patent.toml")),
    ("pen", include_str!("../../styles/pen.toml")),
    ("pencil", include_str!("../../styles/pencil.toml")),
    ("pencil-object", include_str!("../../styles/pencil-object.toml")),
    ("pencil-plain", include_str!("../../styles/pencil-plain.toml")),
    ("plotter", include_str!("../../styles/plotter.toml")),
    ("rim", include_str!("../../styles/rim.toml")),
    ("sketch", include_str!("../../styles/sketch.toml")),
    ("stipple", include_str!("../../styles/stipple.toml")),
    ("suggestive", include_str!("../../styles/suggestive.toml")),
    ("technical", include_str!("../../styles/technical.toml")),
    ("toon", include_str!("../../styles/toon.toml")),
    ("toon-highlight", include_str!("../../styles/toon-highlight.toml")),
    ("toon-three", include_str!("../../styles/toon-three.toml")),
    ("woodcut", include_str!("../../styles/woodcut.toml")),
];

impl Style {
    /// A built-in style by name.
    #[must_use]
    pub fn preset(name: &str) -> Option<Self> {
        Self::sheet_text(name)?;
        Self::load(name).ok()
    }

    /// The names of the built-in styles, in alphabetical order.
    pub fn names() -> impl Iterator<Item = &'static str> {
        BUILT_IN.iter().map(|(name, _)| *name)
    }

    /// The text of a built-in sheet.
    #[must_use]
    pub fn sheet_text(name: &str) -> Option<&'static str> {
        BUILT_IN.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
    }

    /// The description of a built-in style in one line: the first comment of its sheet.
    #[must_use]
    pub fn idea(name: &str) -> Option<&'static str> {
        Some(Self::sheet_text(name)?.lines().next()?.trim_start_matches('#').trim())
    }

    /// Loads a built-in style by name, or a style sheet by path.
    ///
    /// # Errors
    /// Returns an error with the file, the line, the wrong key and the nearest known key.
    pub fn load(name_or_path: &str) -> Result<Self, Error> {
        Self::load_with(name_or_path, &[])
    }

    /// Loads a style by name or path, then applies changes. Each is `KEY=VALUE` with a dotted key such as
    /// `pen.contour.width=2`.
    pub(crate) fn load_with(name_or_path: &str, sets: &[String]) -> Result<Self, Error> {
        sheet_loader::load_style(name_or_path, sets)
    }

    /// Sets a key of the style sheet, as `--set KEY=VALUE` does. Keys are dotted; `ligne styles --keys` lists
    /// them. A list of rules or materials is appended to the present one.
    ///
    /// ```
    /// use ligne::Style;
    ///
    /// let mut style = Style::load("technical")?;
    /// style.set("lines.crease_deg", 20)?.set("pen.thick.width", "0.35mm")?;
    /// assert!(style.set("lines.crease_dg", 20).is_err());
    /// # Ok::<(), ligne::Error>(())
    /// ```
    ///
    /// # Errors
    /// Names the wrong key with the nearest known key, or the wrong value. The style is then unchanged.
    pub fn set(&mut self, key: &str, value: impl std::fmt::Display) -> Result<&mut Self, Error> {
        *self = sheet_loader::changed(self, &format!("{key}={value}"))?;
        Ok(self)
    }

    /// Lets a function change the pen of each line, after all rules of the style. A width of 0 leaves the line
    /// out. The function must give the same pen for the same line, and may be called from several threads.
    ///
    /// ```
    /// use ligne::drawing::Length;
    /// use ligne::style::LineKind;
    /// use ligne::{Camera, Scene, Style, render};
    ///
    /// let scene = Scene::open("examples/models/gear.obj")?;
    /// let style = Style::load("ink")?.with_pens(|line, pen| {
    ///     pen.width = Length::px(if line.kind == LineKind::Contour { 3.0 } else { 1.5 - line.depth });
    ///     pen.opacity = 1.0 - 0.5 * line.light;
    /// });
    /// let drawing = render(&scene, &Camera::three_quarter().fit(&scene), &style)?;
    /// # assert!(drawing.to_svg(&Default::default()).contains("stroke-width=\"3\""));
    /// # Ok::<(), ligne::Error>(())
    /// ```
    #[must_use]
    pub fn with_pens(mut self, choose: impl Fn(&LineInfo, &mut Pen) + Send + Sync + 'static) -> Self {
        self.stroke.choice = Some(PenChoice(std::sync::Arc::new(choose)));
        self
    }

    /// A complete sheet of a style: every key with its value or default, and a line of help. It loads as the
    /// same style. Paths in it are relative to the working folder.
    ///
    /// # Errors
    /// The same as those of [`Style::load`].
    pub fn full_sheet(name_or_path: &str) -> Result<String, Error> {
        Ok(keys::full_sheet::full_sheet(name_or_path, &sheet_loader::all_keys(name_or_path)?))
    }

    /// The style for a page to scale or a DXF file. No point of the model moves by more than 0.02 mm, and
    /// corners on a circle become an arc.
    #[must_use]
    pub fn to_scale(self) -> Self {
        Self { chain: self.chain.drawn_to_scale(), ..self }
    }

    /// Reads the text of a style sheet. Paths that it extends are relative to the working folder.
    ///
    /// ```
    /// let style = ligne::Style::from_toml("extends = 'ink'\nlines.crease_deg = 25")?;
    /// assert_eq!(style, *ligne::Style::load("ink")?.set("lines.crease_deg", 25)?);
    /// # Ok::<(), ligne::Error>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error with the line, the wrong key and the nearest known key.
    pub fn from_toml(text: &str) -> Result<Self, Error> {
        sheet_loader::load_text(text)
    }
}
