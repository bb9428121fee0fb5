//! A page on its sheet of paper: boxes, crop marks and registration marks.

use kurbo::{Affine, Circle, Line, Rect, Shape};

use super::content_stream::ContentWriter;
use super::pdf_streams::{MAX_SIDE_POINTS, POINTS_PER_MM, POINTS_PER_PX};
use crate::drawing::{Composition, Unit};
use crate::error::Error;
use crate::export::encoding::decimals::Decimals;

/// Distance of crop marks from the trimmed page in mm, unless the bleed is wider.
const CROP_GAP_MM: f64 = 3.0;
/// Length of crop marks in mm.
const CROP_LENGTH_MM: f64 = 5.0;
/// Line width of all printer's marks in mm.
const MARK_WIDTH_MM: f64 = 0.1;

/// Radius of the circle of registration marks in mm. Their lines are four times as long.
const REGISTRATION_RADIUS_MM: f64 = 1.25;

/// Paper left outside the marks in mm.
const PAPER_MARGIN_MM: f64 = 1.0;

/// Name of the colour space of all inks.
pub(crate) const ALL_INKS: &str = "All";

/// A page on its sheet; boxes in page units, y down.
pub(crate) struct PrintedPage {
    pub media: Rect,
    pub trim: Rect,
    pub bleed: Rect,
    /// Whether bleed and trim boxes are written.
    pub has_boxes: bool,
    /// Points per page unit.
    pub scale: f64,
    pub user_unit: f64,
    /// Page units per mm.
    pub mm: f64,
    /// Outer end of the crop marks, measured from the trimmed page.
    reach: f64,
}

impl PrintedPage {
    /// Places a page on its sheet, with room for printer's marks if `marks`.
    ///
    /// # Errors
    /// If the page has no size or its boxes are not nested.
    pub(crate) fn new(page: &Composition, marks: bool) -> Result<Self, Error> {
        let (width, height) = (page.page.width, page.page.height);
        if !(width.is_finite() && height.is_finite() && width > 0.0 && height > 0.0) {
            return Err(
                Error::new(format!("a page of {width} x {height} is not possible")).remedy("give it a size")
            );
        }
        let (per_unit, mm) = match page.page.unit {
            Unit::Px => (POINTS_PER_PX, POINTS_PER_MM / POINTS_PER_PX),
            Unit::Mm => (POINTS_PER_MM, 1.0),
        };
        let whole = Rect::new(0.0, 0.0, width, height);
        let (trim, bleed) = page.boxes.map_or((whole, whole), |boxes| (boxes.trim, boxes.bleed));
        let holds = |outer: Rect, inner: Rect| {
            let numbers = [inner.x0, inner.y0, inner.x1, inner.y1].iter().all(|x| x.is_finite());
            numbers && inner.width() > 0.0 && inner.height() > 0.0 && outer.union(inner) == outer
        };
        if !holds(bleed, trim) || !holds(whole, bleed) {
            return Err(Error::new("the trimmed page is not within its bleed, or that not within the page")
                .remedy("make the page larger or its bleed smaller"));
        }
        let beyond =
            (trim.x0 - bleed.x0).max(trim.y0 - bleed.y0).max(bleed.x1 - trim.x1).max(bleed.y1 - trim.y1);
        let reach = beyond.max(CROP_GAP_MM * mm) + CROP_LENGTH_MM * mm;
        let margin = reach + PAPER_MARGIN_MM * mm;
        let media = if marks { whole.union(trim.inflate(margin, margin)) } else { whole };
        let user_unit = (media.width().max(media.height()) * per_unit / MAX_SIDE_POINTS).max(1.0);
        let has_boxes = page.boxes.is_some() || marks;
        Ok(Self { media, trim, bleed, has_boxes, scale: per_unit / user_unit, user_unit, mm, reach })
    }

    /// Transform from page units to paper units, y up.
    pub(crate) fn matrix(&self) -> Affine {
        let s = self.scale;
        Affine::new([s, 0.0, 0.0, -s, -self.media.x0 * s, self.media.y1 * s])
    }

    /// A box in paper units.
    pub(crate) fn on_paper(&self, rect: Rect) -> pdf_writer::Rect {
        let rect = self.matrix().transform_rect_bbox(rect);
        let [x0, y0, x1, y1] = [rect.x0, rect.y0, rect.x1, rect.y1].map(|x| x as f32);
        pdf_writer::Rect::new(x0, y0, x1, y1)
    }

    /// Content stream of the printer's marks in all inks, in page units.
    pub(crate) fn paint_marks(&self, decimals: Decimals) -> Vec<u8> {
        let mut writer = ContentWriter::new(decimals, 0, None);
        writer.operator(format!("q\n/{ALL_INKS} CS\n1 SCN\n/A255 gs\n0 J").as_bytes());
        writer.value(decimals, MARK_WIDTH_MM * self.mm);
        writer.operator(b"w");
        let circle = |center: (f64, f64)| {
            Circle::new(center, REGISTRATION_RADIUS_MM * self.mm).to_path(0.01 * self.mm)
        };
        let lines = self.lines().into_iter().map(|line| line.to_path(0.0));
        for path in lines.chain(self.registers().map(circle)) {
            writer.path_with(path.elements(), b"S");
        }
        writer.operator(b"Q");
        writer.out
    }

    /// Centres of the registration marks, next to the middles of the four sides.
    fn registers(&self) -> [(f64, f64); 4] {
        let (middle, out) = (self.trim.center(), self.reach - 2.0 * REGISTRATION_RADIUS_MM * self.mm);
        let Rect { x0, y0, x1, y1 } = self.trim;
        [(middle.x, y0 - out), (x1 + out, middle.y), (middle.x, y1 + out), (x0 - out, middle.y)]
    }

    /// Lines of crop marks and registration marks.
    fn lines(&self) -> Vec<Line> {
        let Rect { x0, y0, x1, y1 } = self.trim;
        let (near, far) = (self.reach - CROP_LENGTH_MM * self.mm, self.reach);
        let mut lines = Vec::new();
        for x in [x0, x1] {
            lines.push(Line::new((x, y0 - near), (x, y0 - far)));
            lines.push(Line::new((x, y1 + near), (x, y1 + far)));
        }
        for y in [y0, y1] {
            lines.push(Line::new((x0 - near, y), (x0 - far, y)));
            lines.push(Line::new((x1 + near, y), (x1 + far, y)));
        }
        let arm = 2.0 * REGISTRATION_RADIUS_MM * self.mm;
        for (x, y) in self.registers() {
            lines.push(Line::new((x - arm, y), (x + arm, y)));
            lines.push(Line::new((x, y - arm), (x, y + arm)));
        }
        lines
    }
}
