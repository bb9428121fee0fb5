//! Technical sheets: a model in standard views, in a frame with a title block and a parts list.
//!
//! 1. `keys` holds the keys of the page file; `arrangement` plans the views and the scenes they show.
//! 2. `frame` draws the frame, the title block and the parts list, and thereby fixes the free paper.
//! 3. `arrangement` puts the views on the free paper at the largest scale of the series that fits.
//! 4. `dimensions` collects the lengths and diameters to show; `annotations` finds a place for all texts
//!    and lines of a view.
//! 5. Annotations that reach outside a view enlarge its margin. Steps 3 and 4 repeat until everything fits.
//!
//! Folders, in reading order (imports run from later to earlier ones): `view`; `parts_list`;
//! `part_balloons`; `canvas`, marks in mm and occupied paper; `frame`; `keys`; `lengths`, rounding and
//! number format; `arrangement`; `dimensions`; `annotations`. The file `sheet_layout` repeats steps 3 and 4.
//!
//! Source: ISO 128, ISO 129-1, ISO 5455, ISO 5456-2, ISO 5457, ISO 7200, ISO 7573; cited where they are
//! used.

mod annotations;
mod arrangement;
mod canvas;
mod dimensions;
pub(crate) mod frame;
pub(crate) mod keys;
mod lengths;
pub(crate) mod part_balloons;
pub(crate) mod parts_list;
mod sheet_layout;
pub(crate) mod view;

use std::path::PathBuf;

use kurbo::{Affine, Rect};

pub(crate) use keys::sheet_keys::SheetPage;

use super::composed_page::ComposedPage;
use super::figure;
use super::page_size::PageSize;
use super::page_source::PageSource;
use crate::colour::srgb::Colour;
use crate::drawing::{Composition, Page, PlacedDrawing, Unit};
use crate::error::Error;
use crate::text::Font;
use arrangement::view_plan::ViewPlan;
use canvas::sheet_canvas::SheetCanvas;
use frame::parts_table::PartsTable;
use keys::sheet_keys::ListKeys;
use sheet_layout::SheetLayout;

/// Gap between the frame and the views, mm.
const FRAME_INSET_MM: f64 = 4.0;

/// Clearance around centring marks, mm.
const MARK_CLEARANCE_MM: f64 = 2.0;

impl SheetPage {
    /// The files that the sheet is made from: models, style and parts list.
    #[must_use]
    pub(crate) fn inputs(&self, source: &PageSource) -> Vec<PathBuf> {
        let style = self.style.as_ref().and_then(|style| figure::figure_style::style_file(style, source));
        let list = match self.parts_list.as_ref().map(toml::Spanned::get_ref) {
            Some(ListKeys::File(path)) => Some(source.resolve(path)),
            _ => None,
        };
        self.model.files(source).chain(style).chain(list).collect()
    }

    /// Whether the sheet has a parts list.
    pub(crate) fn has_parts_list(&self) -> bool {
        self.parts_list.as_ref().is_some_and(|list| *list.get_ref() != ListKeys::Named(false))
    }

    /// The size of the sheet, mm. Default: A3. Sizes above A4 are turned to landscape format; smaller ones
    /// keep their orientation.
    #[must_use]
    pub(crate) fn oriented_size(&self) -> PageSize {
        let size = self.size.unwrap_or(PageSize { width: 420.0, height: 297.0 });
        let is_small = size.width.max(size.height) <= 297.0;
        if is_small { size } else { size.landscape() }
    }
}

/// The name of a standard size, or an empty string.
fn size_name(size: PageSize) -> &'static str {
    let is_it =
        |name: &&str| PageSize::parse(name).is_some_and(|known| known == size || known.landscape() == size);
    PageSize::names().find(is_it).unwrap_or("")
}

/// Draws a technical sheet as a composition in mm, with warnings.
///
/// # Errors
/// Returns an error if the model or style cannot be read, a key names something that does not exist, or the
/// views do not fit.
pub(crate) fn compose(sheet: &SheetPage, source: &PageSource) -> Result<ComposedPage, Error> {
    let in_file = |error: Error| error.or_in_file(&source.path);
    compose_sheet(sheet, source).map_err(in_file)
}

fn compose_sheet(sheet: &SheetPage, source: &PageSource) -> Result<ComposedPage, Error> {
    let size = sheet.oriented_size();
    let font = match &sheet.font {
        None => Font::named("technical")?,
        Some(name) => {
            let file = source.resolve(name.get_ref());
            let font = if file.is_file() { Font::open(&file) } else { Font::named(name.get_ref()) };
            font.map_err(|error| source.about(&name.span(), error))?
        }
    };
    let mut plan = ViewPlan::new(sheet, source)?;
    let (items, mut warnings) = items(sheet, &plan, source)?;
    let technical = toml::Spanned::new(0..0, "technical".to_owned());
    let style = sheet.style.as_ref().unwrap_or(&technical);
    warnings.extend(figure::figure_style::unit_warning(style, &sheet.set, source));
    let space = frame::zone_frame::drawing_space(size);
    let block = frame::title_block::TitleBlock::new(&sheet.title, space, &font, source)?;
    let table = PartsTable::new(&items, block.place, space, &font).map_err(|error| {
        sheet.parts_list.as_ref().map_or(error.clone(), |told| source.about(&told.span(), error))
    })?;
    let mut tables = vec![block.place];
    tables.extend(table.as_ref().map(|table| table.place));
    let (written, notes) =
        arrangement::titles_and_notes::write_notes(sheet, (space, &tables), &font, source)?;
    let marks = frame::zone_frame::centring_marks(size, &tables);
    let inner = space.inflate(-FRAME_INSET_MM, -FRAME_INSET_MM);
    let taken: Vec<Rect> = tables
        .iter()
        .chain(&notes)
        .map(|rect| rect.inflate(FRAME_INSET_MM, FRAME_INSET_MM))
        .chain(
            marks
                .iter()
                .map(|[a, b]| Rect::from_points(*a, *b).inflate(MARK_CLEARANCE_MM, MARK_CLEARANCE_MM)),
        )
        .collect();

    let mut laying = SheetLayout::new(sheet, &plan, source)?;
    let laid = laying.settle_layout(&mut plan, (inner, &taken), (&font, &items), source)?;
    let (drawn, told) = laid.views;
    warnings.extend(told);
    let mut ink = SheetCanvas::new(&font, "frame");
    frame::zone_frame::draw_frame(size, &marks, &mut ink)?;
    let mut parts = vec![page_item("frame", ink, size)];
    let mut ink = SheetCanvas::new(&font, "title-block");
    let names = (
        &*view::scale_series::format_scale(laid.scale),
        sheet.projection,
        size_name(size),
        plan.values.unit.name,
    );
    block.draw(names, &mut ink)?;
    parts.push(page_item("title-block", ink, size));
    parts.extend(drawn);
    if let Some(table) = &table {
        let mut ink = SheetCanvas::new(&font, "parts-list");
        table.draw(&mut ink)?;
        parts.push(page_item("parts-list", ink, size));
    }
    let mut written = written;
    let mut balloons = SheetCanvas::new(&font, "balloon");
    for board in laid.boards {
        written.marks.extend(board.ink.marks);
        balloons.marks.extend(board.balloons.marks);
    }
    if plan.balloons.is_some() {
        for (item, anchor) in items.iter().zip(&laid.anchors) {
            if anchor.is_none() && !item.parts.is_empty() {
                warnings.push(format!("item '{}' is not visible in the view with balloons", item.name));
            }
        }
        parts.push(page_item("balloons", balloons, size));
    }
    parts.push(page_item("notes", written, size));
    let page =
        Page { width: size.width, height: size.height, unit: Unit::Mm, background: Some(Colour::WHITE) };
    let name = if sheet.title.title.is_empty() { "sheet" } else { &sheet.title.title };
    let composition = Composition::new(name, page, parts);
    warnings.extend(arrangement::titles_and_notes::unreadable_text_warning(&composition));
    Ok(ComposedPage { composition, warnings })
}

/// The items of the parts list, and warnings about parts that belong to no item.
fn items(
    sheet: &SheetPage,
    plan: &ViewPlan,
    source: &PageSource,
) -> Result<(Vec<parts_list::parts_list_items::PartsListItem>, Vec<String>), Error> {
    if !sheet.has_parts_list() {
        return Ok((Vec::new(), Vec::new()));
    }
    let scene = &plan.sets[0].scene;
    let own = parts_list::parts_list_items::parts_list_items(scene);
    let Some((told, ListKeys::File(path))) = sheet.parts_list.as_ref().map(|told| (told, told.get_ref()))
    else {
        return Ok((own, Vec::new()));
    };
    let path = source.existing(&toml::Spanned::new(told.span(), path.clone()), "parts list")?;
    let (items, left) = parts_list::parts_list_file::read(&path, scene, &own)?;
    let warning = |name: String| format!("part '{name}' is in no row of the parts list");
    Ok((items, left.into_iter().map(warning).collect()))
}

/// A drawing of the whole sheet as an item of the page.
fn page_item(name: &str, ink: SheetCanvas, size: PageSize) -> PlacedDrawing {
    let drawing = ink.drawing(name, size.width, size.height);
    PlacedDrawing { name: name.to_owned(), drawing, place: Affine::IDENTITY, clip: None }
}
