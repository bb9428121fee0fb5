//! Comic pages: panels in a layout, each the drawing of a scene, with letters over them.
//!
//! 1. `panel_outlines` computes the boxes of the page and the outline of each panel from its layout.
//! 2. `panel_drawing` draws the scene of each panel (in parallel), its border, and the parts that break out
//!    of the border.
//! 3. `lettering` sets balloons, captions and sound effects, and has `page::balloon_placement`
//!    place the balloons.
//! 4. The page is painted in this order: all panels, parts that break out, letters.
//!
//! Files, in reading order: [`comic_keys`], the keys of a page file; `panel_outlines`; `panel_drawing`;
//! `panel_border`; then the folder `lettering`.

pub(crate) mod comic_keys;
mod lettering;
mod panel_border;
mod panel_drawing;
mod panel_outlines;

use crate::parallel::prelude::*;
use kurbo::Rect;

use super::composed_page::ComposedPage;
use super::page_source::PageSource;
use crate::drawing::{Composition, Page, PrintBoxes, Unit};
use crate::error::Error;
use panel_outlines::PageBoxes;

pub(crate) use comic_keys::ComicPage;

/// Draws a comic page. Panels come first in their order, then parts that break out of borders, then all
/// letters.
///
/// # Errors
/// Returns an error with the line of the wrong key.
pub(crate) fn compose(comic: &ComicPage, source: &PageSource) -> Result<ComposedPage, Error> {
    let sheet = PageBoxes::of(comic, source)?;
    let shapes = panel_outlines::panel_outlines(comic, &sheet, source)?;
    let lettering = lettering::Lettering::new(&comic.lettering, comic.reading.into(), source)?;
    let panels: Vec<panel_drawing::DrawnPanel> = shapes
        .par_iter()
        .map(|shape| panel_drawing::draw_panel(shape, comic, &sheet, source))
        .collect::<Result<_, _>>()?;
    let mut items = Vec::new();
    let (mut over, mut letters) = (Vec::new(), Vec::new());
    let mut warnings = Vec::new();
    for (shape, mut panel) in shapes.iter().zip(panels) {
        items.append(&mut panel.items);
        over.extend(panel.breakout.take());
        // Panels share the style of the page, and would repeat a warning about it.
        panel.warnings.retain(|warning| !warnings.contains(warning));
        warnings.append(&mut panel.warnings);
        letters.extend(lettering.letter(shape, panel.scene.as_ref(), &sheet, &mut warnings)?);
    }
    items.extend(over.into_iter().chain(letters));
    let Rect { x1, y1, .. } = sheet.bleed;
    let page = Page { width: x1, height: y1, unit: Unit::Mm, background: Some(comic.background) };
    let stem =
        || source.path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let title = comic.title.clone().unwrap_or_else(stem);
    let mut composition = Composition::new(title, page, items);
    composition.boxes = Some(PrintBoxes { trim: sheet.trim, bleed: sheet.bleed });
    Ok(ComposedPage { composition, warnings })
}
