//! [`StyleSheet`]: a style sheet as serde reads it, with the tables `[page]` and `[pen]`.

use std::path::PathBuf;
use std::sync::Arc;

use serde::de::Visitor;
use serde::{Deserialize, Deserializer};

use super::fills_table::FillsTable;
use super::hatching_table::HatchingTable;
use crate::chains::ChainOptions;
use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;
use crate::drawing::{Cap, Join, Length, Unit};
use crate::error::Error;
use crate::geometry::numbers::checked_number::some_fraction;
use crate::hatching::Paper;
use crate::light::LightOptions;
use crate::lines::{LineKind, LineOptions};
use crate::motion::MotionOptions;
use crate::scene::GlassOptions;
use crate::strokes::pens::pen::dash;
use crate::strokes::{
    BrushChange, Condition, HandChange, Ink, LayerOptions, Pen, PenChange, Rule, StrokeOptions, SwellChange,
};
use crate::style::files::brush_file::read_brush;
use crate::style::files::picture_file::read_picture;
use crate::style::{SheetKeys, Style};

/// A style sheet; every key is optional.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct StyleSheet {
    /// The sheet that this one extends: a built-in name, or a path relative to this sheet.
    pub extends: Option<String>,
    seed: u64,
    page: PageTable,
    pub lines: LineOptions,
    chain: ChainOptions,
    pen: PenTable,
    rule: Vec<Rule>,
    layers: LayerOptions,
    light: LightOptions,
    pub fills: FillsTable,
    hatching: HatchingTable,
    glass: GlassOptions,
    motion: MotionOptions,
}

/// The table `[page]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct PageTable {
    #[serde(deserialize_with = "colour_or_none")]
    background: Option<Colour>,
    #[serde(deserialize_with = "some_fraction")]
    grain: Option<f64>,
    /// Path of a picture of the paper; empty for none.
    paper: PathBuf,
    #[serde(skip)]
    picture: Option<Arc<Picture>>,
    #[serde(deserialize_with = "positive_length")]
    paper_width: Option<Length>,
    #[serde(deserialize_with = "some_fraction")]
    tooth: Option<f64>,
}

impl Default for PageTable {
    fn default() -> Self {
        let background = Some(Colour::WHITE);
        let (paper, picture, paper_width) = (PathBuf::new(), None, None);
        Self { background, grain: None, paper, picture, paper_width, tooth: None }
    }
}

/// The table `[pen]`: the fields of the default pen, and a table for each named pen.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct PenTable {
    width: Option<Length>,
    #[serde(alias = "color")]
    colour: Option<Ink>,
    cap: Option<Cap>,
    join: Option<Join>,
    #[serde(deserialize_with = "dash")]
    dash: Option<Vec<Length>>,
    #[serde(deserialize_with = "some_fraction")]
    opacity: Option<f64>,
    #[serde(deserialize_with = "some_fraction")]
    fade: Option<f64>,
    swell: SwellChange,
    hand: HandChange,
    halo: Option<Length>,
    brush: Option<BrushChange>,

    contour: PenChange,
    border: PenChange,
    crease: PenChange,
    material: PenChange,
    intersection: PenChange,
    suggestive: PenChange,
    ridge: PenChange,
    valley: PenChange,
    isophote: PenChange,
    artist: PenChange,
    image: PenChange,
    wire: PenChange,
    motion: PenChange,

    thin: PenChange,
    thick: PenChange,
    silhouette: PenChange,
    hidden: PenChange,
}

impl StyleSheet {
    /// Reads the picture of the paper.
    pub(crate) fn read_paper(&mut self) -> Result<(), Error> {
        let page = &mut self.page;
        if !page.paper.as_os_str().is_empty() {
            page.picture =
                Some(Arc::new(read_picture(&page.paper, "of the paper", "give a PNG, JPEG or WebP")?));
        }
        Ok(())
    }

    /// Reads the files of all brushes.
    pub(crate) fn read_brushes(&mut self) -> Result<(), Error> {
        self.pen
            .brushes()
            .chain(self.rule.iter_mut().map(|rule| &mut rule.pen.brush))
            .flatten()
            .try_for_each(read_brush)
    }

    /// Converts the sheet to a style.
    pub(crate) fn into_style(self) -> Style {
        let mut stroke = self.pen.into_options();
        stroke.rules.extend(self.rule);
        stroke.layers = self.layers;
        let (tones, region, textures, patterns) = self.fills.into_options();
        let (shade, hatch) = self.hatching.into_options();
        Style {
            background: self.page.background,
            paper: Paper {
                picture: self.page.picture,
                width: self.page.paper_width,
                grain: self.page.grain.unwrap_or_default(),
                tooth: self.page.tooth.unwrap_or_default(),
            },
            lines: self.lines,
            chain: self.chain,
            stroke,
            light: self.light,
            tones,
            textures,
            patterns,
            region,
            shade,
            hatch,
            glass: self.glass,
            motion: self.motion,
            seed: self.seed,
            keys: SheetKeys::default(),
        }
    }
}

impl PenTable {
    /// The brushes of all pens, set or not.
    fn brushes(&mut self) -> impl Iterator<Item = &mut Option<BrushChange>> {
        let pens = [
            &mut self.contour,
            &mut self.border,
            &mut self.crease,
            &mut self.material,
            &mut self.intersection,
            &mut self.suggestive,
            &mut self.ridge,
            &mut self.valley,
            &mut self.isophote,
            &mut self.artist,
            &mut self.image,
            &mut self.wire,
            &mut self.motion,
            &mut self.thin,
            &mut self.thick,
            &mut self.silhouette,
            &mut self.hidden,
        ];
        pens.into_iter().map(|pen| &mut pen.brush).chain([&mut self.brush])
    }

    /// The default pen and one rule for each named pen. Later rules win: the kind of line comes first, then
    /// thick or thin, then silhouette, then hidden.
    fn into_options(self) -> StrokeOptions {
        let mut pen = Pen::default();
        let Self { width, colour, cap, join, dash, opacity, fade, swell, hand, halo, brush, .. } = self;
        PenChange { width, colour, cap, join, dash, opacity, fade, swell, hand, halo, brush }.apply(&mut pen);

        let kinds = [
            (LineKind::Contour, self.contour),
            (LineKind::Border, self.border),
            (LineKind::Crease, self.crease),
            (LineKind::Material, self.material),
            (LineKind::Intersection, self.intersection),
            (LineKind::Suggestive, self.suggestive),
            (LineKind::Ridge, self.ridge),
            (LineKind::Valley, self.valley),
            (LineKind::Isophote, self.isophote),
            (LineKind::Artist, self.artist),
            (LineKind::Image, self.image),
            (LineKind::Wire, self.wire),
            (LineKind::Motion, self.motion),
        ];
        let of_kinds = |kinds: Vec<LineKind>| Condition { kinds, ..Condition::default() };
        let seen = |both: bool| Condition { both_seen: Some(both), ..of_kinds(surface_kinds()) };
        let silhouette = Condition { silhouette: Some(true), ..Condition::default() };
        let hidden = || Condition { hidden: Some(true), ..Condition::default() };
        let default_dash = vec![Length::px(6.0), Length::px(4.0)];

        let mut rules: Vec<Rule> =
            kinds.into_iter().map(|(kind, pen)| Rule { when: of_kinds(vec![kind]), pen }).collect();
        rules.push(Rule { when: seen(true), pen: self.thin });
        rules.push(Rule { when: seen(false), pen: self.thick });
        rules.push(Rule { when: silhouette, pen: self.silhouette });
        rules.push(Rule {
            when: hidden(),
            pen: PenChange { dash: Some(default_dash), ..PenChange::default() },
        });
        rules.push(Rule { when: hidden(), pen: self.hidden });
        rules.retain(|rule| rule.pen != PenChange::default());
        StrokeOptions { pen, rules, layers: LayerOptions::default(), choice: None }
    }
}

/// The kinds of line with adjacent surfaces; only these can be thick or thin.
fn surface_kinds() -> Vec<LineKind> {
    LineKind::ALL.into_iter().filter(|kind| !matches!(kind, LineKind::Wire | LineKind::Motion)).collect()
}

/// Parses a length above 0.
fn positive_length<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Length>, D::Error> {
    let length = Length::deserialize(deserializer)?;
    if length.in_unit(Unit::Px) > 0.0 {
        Ok(Some(length))
    } else {
        Err(serde::de::Error::custom("the paper has no width; write a length above 0"))
    }
}

/// Parses a colour or `"none"`.
fn colour_or_none<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Colour>, D::Error> {
    struct ColourOrNone;

    impl Visitor<'_> for ColourOrNone {
        type Value = Option<Colour>;

        fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
            f.write_str("a colour such as \"#ffffff\", or \"none\"")
        }

        fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Self::Value, E> {
            if text == "none" {
                return Ok(None);
            }
            Colour::try_from(text.to_owned()).map(Some).map_err(E::custom)
        }
    }

    deserializer.deserialize_any(ColourOrNone)
}
