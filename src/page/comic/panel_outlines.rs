//! [`PanelOutline`]: the outlines of the panels of a page.
//!
//! 1. Bleed, trim, margin and safe area give the boxes of the page.
//! 2. The layout divides the frame inside the margin into panels. Panels with bleed extend to the printed
//!    area.
//! 3. Panels with explicit positions follow. They must not overlap others unless they are insets.

use kurbo::{Point, Rect};
use toml::Spanned;

use super::comic_keys::{ComicPage, Gutter, PanelKeys};
use crate::error::Error;
use crate::page::layout::grammar::MAX_PANELS;
use crate::page::layout::{ConvexPolygon, LayoutGrid, cells};
use crate::page::mm_length::Mm;
use crate::page::page_size::PageSize;
use crate::page::page_source::PageSource;
use crate::page::tolerances::MAX_PANEL_OVERLAP_MM2;

/// The boxes of a page, mm. The printed area starts at the origin.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PageBoxes {
    /// The page after trimming.
    pub trim: Rect,
    /// The printed area.
    pub bleed: Rect,
    /// The safe area for letters.
    pub safe: Rect,
    /// The area that the layout divides into panels.
    frame: Rect,
}

/// A panel on the page.
#[derive(Debug, Clone)]
pub(crate) struct PanelOutline<'a> {
    /// Name of its layers.
    pub name: String,
    /// The keys of the panel; `None` if the page file has none for it.
    pub keys: Option<&'a Spanned<PanelKeys>>,
    /// The outline of the panel.
    pub outline: ConvexPolygon,
}

impl PageBoxes {
    /// The boxes of a page.
    ///
    /// # Errors
    /// Returns an error if a length is negative, or a margin leaves no space.
    pub(crate) fn of(page: &ComicPage, source: &PageSource) -> Result<Self, Error> {
        let lengths = [&page.bleed, &page.safe, &page.margin, &page.border, &page.hand, &page.lettering.line];
        source.check(lengths, |Mm(mm)| *mm >= 0.0, "this length is below 0", "write 0 or more")?;
        let Mm(bleed) = *page.bleed.get_ref();
        let mut size = *page.size.get_ref();
        if page.landscape {
            size = size.landscape();
        }
        if page.spread {
            size = PageSize { width: size.width * 2.0, ..size };
        }
        let trim = Rect::new(bleed, bleed, bleed + size.width, bleed + size.height);
        let within = |length: &Spanned<Mm>, what: &str| {
            let found = trim.inset(-length.get_ref().0);
            if found.width() < 5.0 || found.height() < 5.0 || found.x1 < found.x0 || found.y1 < found.y0 {
                let message =
                    format!("this {what} leaves no room on a page of {} x {} mm", size.width, size.height);
                return Err(source.fault(&length.span(), &message, "make it smaller, or the page larger"));
            }
            Ok(found)
        };
        let frame = within(&page.margin, "margin")?;
        let safe = within(&page.safe, "safe area")?;
        Ok(Self { trim, bleed: trim.inset(bleed), safe, frame })
    }
}

/// The panels of a page: those of the layout in reading order, then those with an explicit position.
///
/// # Errors
/// Returns an error if the layout is invalid, or there are too many panels, or a panel is too small or
/// overlaps others.
pub(crate) fn panel_outlines<'a>(
    page: &'a ComicPage,
    sheet: &PageBoxes,
    source: &PageSource,
) -> Result<Vec<PanelOutline<'a>>, Error> {
    let gutter = match page.gutter.get_ref() {
        Gutter::All(Mm(all)) => [*all, *all],
        Gutter::Each([Mm(across), Mm(down)]) => [*across, *down],
    };
    let is_right = |_: &Gutter| gutter.iter().all(|gutter| *gutter >= 0.0);
    source.check([&page.gutter], is_right, "a gutter cannot be narrower than 0", "write 0 or more")?;
    let grid = LayoutGrid { frame: sheet.frame, gutter, reading: page.reading.into() };
    let cells = cells(page.layout.get_ref(), &grid)
        .map_err(|fault| source.within(&page.layout, &fault.span, &fault.message, &fault.advice))?;
    if let Some(extra) = page.panel.get(MAX_PANELS) {
        let message = format!("a page can hold at most {MAX_PANELS} panels");
        return Err(source.fault(&head_span(source, extra), &message, "spread them over several pages"));
    }
    let (placed, laid): (Vec<_>, Vec<_>) = page.panel.iter().partition(|panel| panel.get_ref().at.is_some());
    if let Some(extra) = laid.get(cells.len()) {
        let message = format!("the layout has only {} panels", cells.len());
        let advice =
            "give the layout a further share, or this panel a place: at = [left, top, width, height]";
        return Err(source.fault(&head_span(source, extra), &message, advice));
    }
    let mut shapes: Vec<PanelOutline> = Vec::new();
    for (number, cell) in cells.iter().enumerate() {
        let keys = laid.get(number).copied();
        let bleeds = keys.is_some_and(|keys| keys.get_ref().bleed);
        let outline = cell.outline(if bleeds { sheet.bleed } else { sheet.frame });
        shapes.push(PanelOutline { name: name(keys, number), keys, outline });
    }
    for keys in placed {
        let Some(at) = &keys.get_ref().at else { continue };
        let [x, y, width, height] = at.get_ref().map(|Mm(mm)| mm);
        let corner = Point::new(sheet.trim.x0 + x, sheet.trim.y0 + y);
        let rect = Rect::from_origin_size(corner, (width, height));
        if !(width >= 2.0 && height >= 2.0) {
            let message = format!("this panel has no size: {width} x {height} mm");
            return Err(source.fault(&at.span(), &message, "write [left, top, width, height]"));
        }
        let lies_on_page = rect.intersect(sheet.bleed).area() >= rect.area() - MAX_PANEL_OVERLAP_MM2;
        let message = "this panel extends past the page";
        source.check([at], |_| lies_on_page, message, "move it, or make it smaller")?;
        let outline = ConvexPolygon::from(rect);
        let over = shapes.iter().find(|other| outline.common(&other.outline).area() > MAX_PANEL_OVERLAP_MM2);
        if let Some(over) = over.filter(|_| !keys.get_ref().inset) {
            let message = format!("this panel overlaps `{}`", over.name);
            return Err(source.fault(
                &at.span(),
                &message,
                "move it, or allow the overlap with inset = true",
            ));
        }
        let number = shapes.len();
        shapes.push(PanelOutline { name: name(Some(keys), number), keys: Some(keys), outline });
    }
    for (number, shape) in shapes.iter().enumerate() {
        let named = shape.keys.and_then(|keys| keys.get_ref().name.as_ref());
        let has_letters = |name: &String| !name.trim().is_empty();
        source.check(named, has_letters, "this panel has no name", "write one, or leave it out")?;
        if let Some(named) = named
            && shapes.iter().take(number).any(|other| other.name == shape.name)
        {
            let message = format!("two panels are called `{}`", shape.name);
            return Err(source.fault(&named.span(), &message, "give each panel its own name"));
        }
    }
    Ok(shapes)
}

/// The span of the first line of a panel in the file.
fn head_span(source: &PageSource, panel: &Spanned<PanelKeys>) -> std::ops::Range<usize> {
    let span = panel.span();
    let text = source.text.get(span.clone()).unwrap_or_default();
    span.start..span.start + text.lines().next().map_or(0, str::len)
}

fn name(keys: Option<&Spanned<PanelKeys>>, number: usize) -> String {
    let own = keys.and_then(|keys| keys.get_ref().name.as_ref());
    own.map_or_else(|| format!("panel-{}", number + 1), |name| name.get_ref().clone())
}
