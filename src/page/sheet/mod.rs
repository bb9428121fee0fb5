//! Technical sheets: a model in views that stand as the standards have it, in a frame with a title block and a parts list.
//!
//! [`keys`] is what is told, `plan` which views there are and of what, `arrange` where they stand and how large, `notes` what is
//! written beside them.

mod arrange;
mod balloon_anchors;
pub mod balloons;
pub mod block;
mod centre;
mod dimension;
mod exploded;
pub mod frame;
mod ink;
pub mod keys;
pub mod list;
mod list_file;
mod measures;
pub mod method;
mod notes;
mod pack;
mod places;
mod plan;
mod precision;
mod rounds;
pub mod rows;
mod scales;
mod sight;
mod true_length;
mod values;

use std::path::PathBuf;

use kurbo::{Affine, Rect, Shape};

pub use block::TitleKeys;
pub use keys::SheetPage;
pub use method::Method;

use super::composed::Composed;
use super::figure;
use super::size::Size;
use super::source::Source;
use crate::drawing::{Composition, Item, Page, Unit};
use crate::error::Error;
use crate::math::colour::Colour;
use crate::render::Prepared;
use crate::text::Font;
use arrange::arrange;
use ink::Ink;
use keys::ListKeys;
use measures::Measures;
use plan::{Plan, Set, read_scale};

/// Between the frame and what is drawn, mm.
const INSET: f64 = 4.0;

/// Height of notes, and how wide they are, mm.
const NOTES: [f64; 2] = [3.5, 90.0];

impl SheetPage {
    /// The files it is made from.
    #[must_use]
    pub fn inputs(&self, source: &Source) -> Vec<PathBuf> {
        let style = self.style.as_ref().and_then(|style| figure::look::file(style, source));
        let list = match self.parts_list.as_ref().map(toml::Spanned::get_ref) {
            Some(ListKeys::File(path)) => Some(source.beside(path)),
            _ => None,
        };
        self.model.files(source).chain(style).chain(list).collect()
    }

    /// Whether it has a parts list.
    pub(super) fn has_parts_list(&self) -> bool {
        self.parts_list.as_ref().is_some_and(|list| *list.get_ref() != ListKeys::Named(false))
    }

    /// Its size as it lies.
    #[must_use]
    pub fn lying(&self) -> Size {
        let size = self.size.unwrap_or(Size { width: 420.0, height: 297.0 });
        let is_small = size.width.max(size.height) <= 297.0;
        if is_small { size } else { size.lying() }
    }
}

/// The name of a size of the A series.
fn size_name(size: Size) -> &'static str {
    let is_it = |name: &&str| Size::parse(name).is_some_and(|known| known == size || known.lying() == size);
    Size::names().find(is_it).unwrap_or("")
}

/// Draws a sheet.
///
/// # Errors
/// If the model or the style cannot be read, a key tells what is not there, or the views do not fit on the sheet.
pub fn compose(sheet: &SheetPage, source: &Source) -> Result<Composed, Error> {
    let size = sheet.lying();
    let font = match &sheet.font {
        None => Font::named("technical")?,
        Some(name) => {
            let file = source.beside(name.get_ref());
            let font = if file.is_file() { Font::open(&file) } else { Font::named(name.get_ref()) };
            font.map_err(|error| source.about(&name.span(), error))?
        }
    };
    let mut plan = Plan::new(sheet, source)?;
    let (items, unlisted) = items(sheet, &plan, source)?;
    let space = frame::space(size);
    let title = block::place(space);
    let (columns, rows, high) = notes::list_size(items.len(), space.height() * 0.3);
    if high > space.height() * 0.6 {
        return Err(Error::new(format!("a list of {} items does not fit on this sheet", items.len()))
            .in_file(&source.path)
            .remedy("choose a larger size, hide parts with `hide`, or leave parts_list out"));
    }
    let list_place = Rect { y0: title.y0 - high, y1: title.y0, ..title };
    let mut taken = vec![title];
    if !items.is_empty() {
        taken.push(list_place);
    }
    let mut written = Ink::new(&font, "note");
    let notes = sheet.notes.join("\n");
    if !notes.trim().is_empty() {
        let corner = kurbo::Point::new(space.x0 + INSET + 12.0, 0.0);
        let height = written.lines(&notes, corner, NOTES[0], NOTES[1])?;
        let top = space.y1 - INSET - 2.0 - height;
        written.marks =
            written.marks.into_iter().map(|mark| mark.moved(kurbo::Vec2::new(0.0, top))).collect();
        taken.push(Rect::new(corner.x, top, corner.x + NOTES[1], space.y1));
    }
    let taken: Vec<Rect> = taken.iter().map(|rect| rect.inflate(INSET, INSET)).collect();
    let told = sheet.scale.as_ref().map(|scale| read_scale(scale, source)).transpose()?;
    let inner = space.inflate(-INSET, -INSET);
    let asked = Asked::of(sheet, source)?;
    let mut scale = None;
    for _ in 0..ROUNDS {
        let unit_mm = plan.unit_mm();
        scale = arrange(&mut plan.views, (inner, &taken), (sheet.projection, unit_mm, told));
        if scale.is_none() {
            break;
        }
        // What stands beside views needs room, which is known once they have their size.
        let measures = asked.measures(sheet, &plan, &mut Ink::new(&font, "note"), source)?;
        let room = measures.room(&plan, &written)?;
        let mut fits = true;
        for (placed, room) in plan.views.iter_mut().zip(room) {
            for (own, needed) in placed.around.iter_mut().zip(room) {
                fits &= needed <= *own + 1e-9;
                *own = own.max(needed);
            }
        }
        if fits {
            break;
        }
    }
    let Some(scale) = scale else {
        let message = "the views do not fit on this sheet";
        let remedy = "choose a larger size, fewer views or another scale";
        return Err(match &sheet.scale {
            Some(told) => source.fault(&told.span(), message, remedy),
            None => Error::new(message).in_file(&source.path).remedy(remedy),
        });
    };

    let (mut drawn, mut warnings) = views(&plan)?;
    warnings.extend(unlisted);
    let mut ink = Ink::new(&font, "frame");
    frame::draw(size, &mut ink)?;
    drawn.insert(0, whole("frame", ink, size));
    let mut ink = Ink::new(&font, "title-block");
    let names = (&*scales::written(scale), sheet.projection, size_name(size), plan.values.unit.name);
    block::draw(title, &sheet.title, names, &mut ink)?;
    drawn.insert(1, whole("title-block", ink, size));
    if !items.is_empty() {
        let mut ink = Ink::new(&font, "parts-list");
        notes::list(list_place, &items, (columns, rows), &mut ink)?;
        drawn.push(whole("parts-list", ink, size));
    }
    if let Some(view) = plan.balloons {
        let sight = &plan.views[view].sight;
        let anchors = balloon_anchors::anchors(sight, &plan.sets[plan.set_of[view]].scene, &items);
        for (item, anchor) in items.iter().zip(&anchors) {
            if anchor.is_none() && !item.parts.is_empty() {
                warnings.push(format!("nothing is seen of item '{}' in the view with balloons", item.name));
            }
        }
        let mut ink = Ink::new(&font, "balloon");
        notes::balloons(sight.rect(), &items, &anchors, &mut ink)?;
        drawn.push(whole("balloons", ink, size));
    }
    annotate(sheet, &plan, scale, (&asked, &mut written), source)?;
    drawn.push(whole("notes", written, size));
    let page =
        Page { width: size.width, height: size.height, unit: Unit::Mm, background: Some(Colour::WHITE) };
    let name = if sheet.title.title.is_empty() { "sheet" } else { &sheet.title.title };
    Ok(Composed { composition: Composition::new(name, page, drawn), warnings })
}

/// The items of the parts list, and warnings about parts that are in none.
fn items(sheet: &SheetPage, plan: &Plan, source: &Source) -> Result<(Vec<list::Item>, Vec<String>), Error> {
    if !sheet.has_parts_list() {
        return Ok((Vec::new(), Vec::new()));
    }
    let scene = &plan.sets[0].scene;
    let own = list::items(scene);
    let Some((told, ListKeys::File(path))) = sheet.parts_list.as_ref().map(|told| (told, told.get_ref()))
    else {
        return Ok((own, Vec::new()));
    };
    let path = source.existing(&toml::Spanned::new(told.span(), path.clone()), "parts list")?;
    let (items, left) = list_file::read(&path, scene, &own)?;
    let warning = |name: String| format!("part '{name}' is in no row of the parts list");
    Ok((items, left.into_iter().map(warning).collect()))
}

/// The views, each as an item; details are cut to their circles.
fn views(plan: &Plan) -> Result<(Vec<Item>, Vec<String>), Error> {
    let mut drawn: Vec<(usize, Item)> = Vec::new();
    let mut warnings: Vec<String> = Vec::new();
    for (number, Set { scene, style }) in plan.sets.iter().enumerate() {
        let own: Vec<usize> = (0..plan.views.len()).filter(|view| plan.set_of[*view] == number).collect();
        if own.is_empty() {
            continue;
        }
        let prepared = Prepared::new(scene, style);
        for view in own {
            let (mut item, told) = plan.views[view].sight.item(&prepared)?;
            if plan.circled.iter().any(|circled| circled.shown == view) {
                item.clip = Some(notes::circle_of(&plan.views[view].sight).to_path(1e-3));
            }
            drawn.push((view, item));
            for warning in scene.warnings.lines().into_iter().chain(told) {
                if !warnings.contains(&warning) {
                    warnings.push(warning);
                }
            }
        }
    }
    drawn.sort_by_key(|(view, _)| *view);
    Ok((drawn.into_iter().map(|(_, item)| item).collect(), warnings))
}

/// Room for dimensions changes the scale, and that again the room; hardly ever more than twice.
const ROUNDS: usize = 5;

/// What views are to tell by themselves.
struct Asked {
    overall: bool,
    auto: bool,
}

impl Asked {
    fn of(sheet: &SheetPage, source: &Source) -> Result<Self, Error> {
        let dimensions = match &sheet.dimensions {
            None => "overall",
            Some(told) => match &**told.get_ref() {
                known @ ("none" | "overall" | "auto") => known,
                _ => return Err(source.unknown(told, "set of dimensions", &["none", "overall", "auto"])),
            },
        };
        let overall = sheet.overall.unwrap_or(dimensions != "none");
        Ok(Self { overall, auto: dimensions == "auto" })
    }

    fn measures(
        &self,
        sheet: &SheetPage,
        plan: &Plan,
        ink: &mut Ink,
        source: &Source,
    ) -> Result<Measures, Error> {
        let mut measures = Measures::default();
        if self.overall {
            measures.add_overall(plan, ink)?;
        }
        if self.auto {
            measures.add_rounds(plan, &rounds::rounds(plan), ink)?;
        }
        places::add_told(sheet, plan, &mut measures, ink, source)?;
        Ok(measures)
    }
}

/// All that is written beside views.
fn annotate(
    sheet: &SheetPage,
    plan: &Plan,
    scale: f64,
    (asked, ink): (&Asked, &mut Ink),
    source: &Source,
) -> Result<(), Error> {
    notes::titles(plan, scale, ink)?;
    for cut in &plan.cuts {
        notes::cutting_plane(plan, cut, ink)?;
    }
    for circled in &plan.circled {
        notes::circled(plan, circled, ink)?;
    }
    let is_single = plan.sets[0].scene.parts.len() == 1;
    if sheet.centre_lines.unwrap_or(is_single || asked.auto) {
        centre::centre_lines(plan, ink);
    }
    asked.measures(sheet, plan, ink, source)?.draw(plan, ink)
}

/// What lies on the sheet as a whole.
fn whole(name: &str, ink: Ink, size: Size) -> Item {
    let drawing = ink.drawing(name, size.width, size.height);
    Item { name: name.to_owned(), drawing, place: Affine::IDENTITY, clip: None }
}
