//! Comic pages: panels in a layout, each the drawing of a scene, with letters over them.

mod border;
pub mod keys;
mod letters;
mod panel;
mod shapes;

use crate::parallel::prelude::*;
use kurbo::Rect;

use super::composed::Composed;
use super::source::Source;
use crate::drawing::{Boxes, Composition, Page, Unit};
use crate::error::Error;
use shapes::Sheet;

pub use keys::ComicPage;

/// Draws a comic page: the panels in their order, then what breaks their borders, then the letters of all.
///
/// # Errors
/// Each names the line of what is wrong.
pub fn compose(comic: &ComicPage, source: &Source) -> Result<Composed, Error> {
    let sheet = Sheet::of(comic, source)?;
    let shapes = shapes::shapes(comic, &sheet, source)?;
    let lettering = letters::Lettering::new(&comic.lettering, comic.reading.into(), source)?;
    let panels: Vec<panel::Drawn> =
        shapes.par_iter().map(|shape| panel::draw(shape, comic, &sheet, source)).collect::<Result<_, _>>()?;
    let mut items = Vec::new();
    let (mut over, mut letters) = (Vec::new(), Vec::new());
    let mut warnings = Vec::new();
    for (shape, mut panel) in shapes.iter().zip(panels) {
        items.append(&mut panel.items);
        over.extend(panel.over.take());
        // Panels share the style of the page, and a warning about it.
        panel.warnings.retain(|warning| !warnings.contains(warning));
        warnings.append(&mut panel.warnings);
        letters.extend(lettering.letter(shape, panel.seen.as_ref(), &sheet, &mut warnings)?);
    }
    items.extend(over.into_iter().chain(letters));
    let Rect { x1, y1, .. } = sheet.bleed;
    let page = Page { width: x1, height: y1, unit: Unit::Mm, background: Some(comic.background) };
    let stem =
        || source.path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let title = comic.title.clone().unwrap_or_else(stem);
    let mut composition = Composition::new(title, page, items);
    composition.boxes = Some(Boxes { trim: sheet.trim, bleed: sheet.bleed });
    Ok(Composed { composition, warnings })
}
