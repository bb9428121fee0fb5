//! The letters of a panel: balloons that are placed automatically, captions and sound effects.
//!
//! 1. Sound effects are drawn where the page file puts them, and become obstacles.
//! 2. For each balloon, the part that its tail points at is found, and its text is set in several aspect
//!    ratios.
//! 3. `page::balloon_placement` finds a place for all balloons together. If there is none, the letters are
//!    made smaller in steps.
//! 4. Balloons and their letters are painted in reading order.
//!
//! Files, in reading order: `balloon`, a text in an outline with a tail; `tail_target`, the point that a
//! tail points at; `sound_effect`, letters along an arc.

mod balloon;
mod sound_effect;
mod tail_target;

use kurbo::{Affine, Point, Rect};
use toml::Spanned;

use super::comic_keys::{BalloonKeys, BalloonKind, LetteringKeys, PanelKeys, SoundKeys};
use super::panel_drawing::PanelScene;
use super::panel_outlines::{PageBoxes, PanelOutline};
use crate::drawing::{Drawing, Layer, LayerKind, Mark, Page, PlacedDrawing, Unit};
use crate::error::Error;
use crate::page::balloon_placement::{self, PlacedBalloon, PlacementArea, PlacementRequest};
use crate::page::layout::{ConvexPolygon, Reading};
use crate::page::mm_length::Mm;
use crate::page::page_source::PageSource;
use crate::scene::warnings::add_new;
use crate::text::{Font, Setting};
use balloon::{Balloon, BalloonPaint};
use tail_target::TailTarget;

/// Letter sizes that are tried until all balloons fit, as shares of the requested size.
const LETTER_SIZE_FACTORS: [f64; 5] = [1.0, 0.92, 0.85, 0.78, 0.7];

/// Aspect ratios (height by width) of balloons, preferred first.
const BALLOON_ASPECTS: [f64; 3] = [0.62, 0.9, 1.3];

/// Gap from a balloon to the panel border, other balloons and faces, in ems.
const BALLOON_GAP_EM: f64 = 0.45;

/// Maximum number of balloons in a panel.
const MAX_BALLOONS: usize = 50;

/// Maximum number of letters in a balloon.
const MAX_LETTERS: usize = 1000;

/// Sets the letters of all panels of a page.
pub(crate) struct Lettering<'a> {
    keys: &'a LetteringKeys,
    reading: Reading,
    setting: Setting,
    source: &'a PageSource,
}

/// The keys of a balloon, and the target of its tail.
struct BalloonSpec<'a> {
    keys: &'a BalloonKeys,
    target: Option<TailTarget>,
}

impl<'a> Lettering<'a> {
    /// Reads the font of the page.
    ///
    /// # Errors
    /// Returns an error if there is no such font, or the letter size is not above 0.
    pub(crate) fn new(
        keys: &'a LetteringKeys,
        reading: Reading,
        source: &'a PageSource,
    ) -> Result<Self, Error> {
        let mut setting = Setting::new(font(&keys.font, source)?).with_leading(1.1);
        setting.upper_case = keys.upper_case;
        setting.language.clone_from(&keys.language);
        Ok(Self { keys, reading, setting: setting.with_em(positive_length(&keys.size, source)?), source })
    }

    /// The letters of a panel as a drawing of the whole page; `None` if it has none.
    ///
    /// # Errors
    /// Returns an error at the line of a balloon whose text cannot be set, whose tail points at no part, or
    /// that does not fit.
    pub(crate) fn letter(
        &self,
        shape: &PanelOutline,
        scene: Option<&PanelScene>,
        sheet: &PageBoxes,
        warnings: &mut Vec<String>,
    ) -> Result<Option<PlacedDrawing>, Error> {
        let Some(keys) = shape.keys.map(Spanned::get_ref) else { return Ok(None) };
        if keys.balloon.is_empty() && keys.sound.is_empty() {
            return Ok(None);
        }
        let bounds = shape.outline.bounds();
        let mut marks = Vec::new();
        let mut obstacles = Vec::new();
        for sound in &keys.sound {
            let (sound_marks, hull) = self.sound(sound, bounds, warnings)?;
            marks.extend(sound_marks);
            obstacles.push(hull);
        }
        marks.extend(self.balloons(shape, keys, (scene, obstacles), sheet, warnings)?);
        let Rect { x1: width, y1: height, .. } = sheet.bleed;
        let page = Page { width, height, unit: Unit::Mm, background: None };
        let name = format!("{}-letters", shape.name);
        // Balloons and their words overlap in the order of the page file.
        let layers = vec![Layer { kind: LayerKind::Callouts, pen: None, ordered: false, marks }];
        let drawing = Drawing::new(&name, page, layers);
        Ok(Some(PlacedDrawing { name, drawing, place: Affine::IDENTITY, clip: None }))
    }

    /// The marks of a sound effect, and the hull of its letters. `bounds` is the bounding box of the panel.
    fn sound(
        &self,
        keys: &SoundKeys,
        bounds: Rect,
        warnings: &mut Vec<String>,
    ) -> Result<(Vec<Mark>, ConvexPolygon), Error> {
        let font = match &keys.font {
            Some(name) => font(name, self.source)?,
            None => self.setting.font.clone(),
        };
        let size = keys.size.as_ref().map_or(Ok(12.0), |size| positive_length(size, self.source))?;
        let line = keys.line.as_ref().map_or(Ok(size / 10.0), |line| positive_length(line, self.source))?;
        within_panel(&keys.at, self.source)?;
        let (turns, is_angle) = ([&keys.rotate, &keys.arc], |turn: &f64| (-360.0..=360.0).contains(turn));
        let advice = "write degrees from -360 to 360";
        self.source.check(turns, is_angle, "this is not an angle for letters", advice)?;
        let stretch = keys.stretch.as_ref().map_or(1.0, |stretch| *stretch.get_ref());
        let (is_stretch, advice) = (|n: &f64| (0.01..=100.0).contains(n), "write a number from 0.01 to 100");
        self.source.check(&keys.stretch, is_stretch, "this is not a stretch of letters", advice)?;
        let mut setting = Setting::new(font).with_capitals(size);
        setting.upper_case = self.keys.upper_case;
        let outlines = sound_effect::sound_outlines(keys.text.get_ref(), &setting, keys, stretch, bounds);
        let (letters, fallbacks) = outlines.map_err(|error| self.source.about(&keys.text.span(), error))?;
        add_new(warnings, fallbacks);
        let colours = [keys.fill.unwrap_or(self.keys.fill), keys.colour.unwrap_or(self.keys.colour)];
        Ok(sound_effect::paint_letters(letters, colours, line))
    }

    /// The placed balloons of a panel.
    fn balloons(
        &self,
        shape: &PanelOutline,
        keys: &PanelKeys,
        (scene, obstacles): (Option<&PanelScene>, Vec<ConvexPolygon>),
        sheet: &PageBoxes,
        warnings: &mut Vec<String>,
    ) -> Result<Vec<Mark>, Error> {
        if keys.balloon.is_empty() {
            return Ok(Vec::new());
        }
        if let Some(extra) = keys.balloon.get(MAX_BALLOONS) {
            let message = format!("a panel can hold at most {MAX_BALLOONS} balloons");
            return Err(self.source.fault(&extra.text.span(), &message, "spread them over several panels"));
        }
        for keys in &keys.balloon {
            keys.at.as_ref().map_or(Ok(()), |at| within_panel(at, self.source))?;
            let letters = keys.text.get_ref().chars().count();
            if letters > MAX_LETTERS {
                let message = format!("a text of {letters} letters is too long for a balloon");
                let advice = format!("write at most {MAX_LETTERS}, or part it among several balloons");
                return Err(self.source.fault(&keys.text.span(), &message, &advice));
            }
        }
        let balloon_specs: Vec<BalloonSpec> = keys
            .balloon
            .iter()
            .map(|keys| Ok(BalloonSpec { keys, target: self.target(keys, shape, scene)? }))
            .collect::<Result<_, Error>>()?;
        let mut protected_hulls = Vec::new();
        for glob in &keys.keep {
            let Some(panel_scene) = scene else {
                return Err(self.source.fault(
                    &glob.span(),
                    "there is no model in this panel",
                    "leave out `keep`",
                ));
            };
            let visible_parts = panel_scene.part_bounds(glob, self.source)?;
            let clipped_to_panel = |hull| ConvexPolygon(hull).common(&shape.outline);
            protected_hulls.extend(
                visible_parts
                    .into_iter()
                    .map(|part_box| clipped_to_panel(part_box.hull))
                    .filter(|hull| !hull.0.is_empty()),
            );
        }
        protected_hulls.extend(balloon_specs.iter().filter_map(|told| told.target.as_ref()?.face.clone()));
        let parts: Vec<&str> =
            balloon_specs.iter().filter_map(|told| Some(told.target.as_ref()?.part.as_str())).collect();
        let cover = scene.map(|seen| seen.coverage(&parts));
        let mut unplaced_balloon = 0;
        for size in LETTER_SIZE_FACTORS {
            let balloons: Vec<Vec<Balloon>> =
                balloon_specs.iter().map(|told| self.set(told, size)).collect::<Result<_, _>>()?;
            let gap = BALLOON_GAP_EM * self.setting.em() * size;
            let placement_area = PlacementArea {
                outline: shape.outline.inset(gap).common(&ConvexPolygon::from(sheet.safe)),
                protected: protected_hulls.clone(),
                obstacles: obstacles.clone(),
                cover: cover.clone(),
                gap,
                reading: self.reading,
            };
            let requests: Vec<PlacementRequest> = balloons
                .iter()
                .zip(&balloon_specs)
                .map(|(shapes, told)| placement_request(shapes, told, shape))
                .collect();
            match balloon_placement::place_balloons(&requests, &placement_area) {
                Ok(placed_balloons) => {
                    if size < 1.0 {
                        let percent = (size * 100.0).round();
                        warnings.push(format!(
                            "{}: letters are set at {percent} % of their size, so that all balloons fit",
                            shape.name
                        ));
                    }
                    return Ok(self.painted(&balloons, &balloon_specs, &placed_balloons, warnings));
                }
                Err(number) => unplaced_balloon = unplaced_balloon.max(number),
            }
        }
        let text = balloon_specs.get(unplaced_balloon).map_or(0..0, |told| told.keys.text.span());
        let advice =
            "shorten the text, make letters smaller or the panel larger, or give its place: at = [0.5, 0.2]";
        Err(self.source.fault(&text, "there is no room in the panel for this balloon", advice))
    }

    /// The target of a balloon's tail, if it has a tail.
    fn target(
        &self,
        keys: &BalloonKeys,
        shape: &PanelOutline,
        scene: Option<&PanelScene>,
    ) -> Result<Option<TailTarget>, Error> {
        let Some(glob) = &keys.tail else { return Ok(None) };
        if keys.kind == BalloonKind::Caption {
            return Err(self.source.fault(
                &glob.span(),
                "a caption cannot have a tail",
                "leave it out, or choose another kind",
            ));
        }
        let Some(seen) = scene else {
            return Err(self.source.fault(
                &glob.span(),
                "there is no model in this panel",
                "leave out the tail",
            ));
        };
        let visible_parts = seen.part_bounds(glob, self.source)?;
        match TailTarget::of(&visible_parts, &shape.outline) {
            Some(target) => Ok(Some(target)),
            None => {
                let message = format!("the part `{}` is not in the picture of this panel", glob.get_ref());
                Err(self.source.fault(
                    &glob.span(),
                    &message,
                    "move the camera, or let the tail point elsewhere",
                ))
            }
        }
    }

    /// A balloon with its text set, once for each aspect ratio.
    fn set(&self, spec: &BalloonSpec, size: f64) -> Result<Vec<Balloon>, Error> {
        let BalloonSpec { keys, .. } = spec;
        let letter_size =
            keys.size.as_ref().map_or(Ok(self.setting.em()), |size| positive_length(size, self.source))?;
        let setting = self.setting.clone().with_em(letter_size * size);
        let set = |aspect| {
            Balloon::new(keys.text.get_ref(), keys.kind, &setting, aspect)
                .map_err(|error| self.source.about(&keys.text.span(), error))
        };
        BALLOON_ASPECTS.into_iter().map(set).collect()
    }

    /// The marks of the placed balloons and their letters. `placed_balloons` is parallel to `balloons`.
    fn painted(
        &self,
        balloons: &[Vec<Balloon>],
        specs: &[BalloonSpec],
        placed_balloons: &[PlacedBalloon],
        warnings: &mut Vec<String>,
    ) -> Vec<Mark> {
        let mut marks = Vec::new();
        for ((shapes, spec), placed_balloon) in balloons.iter().zip(specs).zip(placed_balloons) {
            let Some(balloon) = shapes.get(placed_balloon.shape) else { continue };
            let fill = spec.keys.fill.unwrap_or(self.keys.fill);
            let ink = BalloonPaint { fill, colour: self.keys.colour, line: self.keys.line.get_ref().0 };
            marks.extend(balloon.marks(placed_balloon.middle, placed_balloon.tip, &ink));
            add_new(warnings, balloon.block.fallbacks.iter().map(ToString::to_string));
        }
        marks
    }
}

/// The placement request of a balloon with its possible shapes.
fn placement_request(shapes: &[Balloon], spec: &BalloonSpec, shape: &PanelOutline) -> PlacementRequest {
    let bounds = shape.outline.bounds();
    let at = spec.keys.at.as_ref().map(|at| {
        let [x, y] = *at.get_ref();
        Point::new(bounds.x0 + x * bounds.width(), bounds.y0 + y * bounds.height())
    });
    let of_first_shape = |measure: fn(&Balloon) -> f64| shapes.first().map_or(0.0, measure);
    PlacementRequest {
        hulls: shapes.iter().map(Balloon::hull).collect(),
        target: spec.target.as_ref().map(|target| (target.hull.clone(), target.aim)),
        at,
        em: of_first_shape(Balloon::em),
        min_tail_length: of_first_shape(Balloon::shortest_tail),
        tail_half_width: of_first_shape(Balloon::foot),
        is_caption: spec.keys.kind == BalloonKind::Caption,
    }
}

/// A bundled font by its name, or a font file relative to the page file.
fn font(name: &Spanned<String>, source: &PageSource) -> Result<Font, Error> {
    let is_name = !name.get_ref().contains(['/', '\\', '.']);
    if !is_name {
        return Font::open(source.existing(name, "font")?);
    }
    let known = Font::names();
    if !known.contains(&name.get_ref().as_str()) {
        return Err(source.unknown(name, "font", &known));
    }
    Font::named(name.get_ref()).map_err(|error| source.about(&name.span(), error))
}

/// Checks that a position is at most half a panel size outside its panel.
fn within_panel(at: &Spanned<[f64; 2]>, source: &PageSource) -> Result<(), Error> {
    if at.get_ref().iter().all(|share| (-0.5..=1.5).contains(share)) {
        return Ok(());
    }
    let advice = "write shares of its width and height, such as [0.5, 0.2]";
    Err(source.fault(&at.span(), "this place is too far from the panel", advice))
}

/// A length above 0, in mm.
fn positive_length(length: &Spanned<Mm>, source: &PageSource) -> Result<f64, Error> {
    let Mm(mm) = *length.get_ref();
    if mm > 0.0 {
        return Ok(mm);
    }
    Err(source.fault(&length.span(), "sizes of letters and lines must be above 0", "write such as \"3.4mm\""))
}
