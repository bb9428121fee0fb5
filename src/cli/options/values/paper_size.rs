//! Paper sizes, margins and scales as written in options: `1000x1000`, `A4`, `210x297mm`, `10mm`, `1:2`.

use crate::drawing::{Length, Page, Unit};
use crate::error::Error;
use crate::page::page_size::PageSize;

/// Maximum side length, user units. Rejects typing errors.
const MAX_SIDE_UNITS: f64 = 1e6;

/// Names of the sheets of drawings, among the sizes of pages.
pub(crate) const SHEET_NAMES: [&str; 10] =
    ["A0", "A1", "A2", "A3", "A4", "A5", "A6", "Letter", "Legal", "Tabloid"];

/// A width and a height, in user units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PaperSize {
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl PaperSize {
    fn new(width: f64, height: f64) -> Result<Self, String> {
        if [width, height].into_iter().all(|side| side > 0.0 && side <= MAX_SIDE_UNITS) {
            Ok(Self { width, height })
        } else {
            Err(format!("sides must be above 0 and at most {MAX_SIDE_UNITS}"))
        }
    }

    /// The size in landscape orientation.
    pub(crate) fn landscape(self) -> Self {
        Self { width: self.width.max(self.height), height: self.width.min(self.height) }
    }
}

/// Reads `1000x800` or `1000`, in px.
pub(crate) fn size_px(text: &str) -> Result<PaperSize, String> {
    let side = |text: &str| {
        let text = text.trim().trim_end_matches("px");
        text.parse::<f64>().map_err(|_| "write WIDTHxHEIGHT in px, such as 1000x800".to_owned())
    };
    match text.split_once(['x', 'X', '×']) {
        // The x in `800px` is not a separator.
        Some((width, height)) if !width.trim_end().ends_with(['p', 'P']) => {
            PaperSize::new(side(width)?, side(height.trim_start())?)
        }
        _ => side(text).and_then(|side| PaperSize::new(side, side)),
    }
}

/// Reads `A4`, `Letter` or `210x297mm`, in mm.
pub(crate) fn page_mm(text: &str) -> Result<PaperSize, String> {
    let is_sheet = SHEET_NAMES.iter().any(|name| name.eq_ignore_ascii_case(text.trim()));
    if let Some(PageSize { width, height }) = PageSize::named(text).filter(|_| is_sheet) {
        return PaperSize::new(width, height);
    }
    let wrong = || format!("write one of {}, or WIDTHxHEIGHT such as 210x297mm", SHEET_NAMES.join(", "));
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(wrong)?;
    let height = PageLength::parse(height).ok_or_else(wrong)?;
    let mut width = PageLength::parse(width).ok_or_else(wrong)?;
    // A unit after the height applies to both sides.
    if width.unit_left_out && !height.unit_left_out {
        width = PageLength::parse(&format!("{}{}", width.length.value, unit_of(text))).ok_or_else(wrong)?;
    }
    PaperSize::new(width.in_unit(Unit::Mm), height.in_unit(Unit::Mm))
}

fn unit_of(text: &str) -> &str {
    text.rfind(|c: char| !c.is_ascii_alphabetic()).map_or("", |i| text.get(i + 1..).unwrap_or(""))
}

/// Length whose default unit is the unit of the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PageLength {
    length: Length,
    unit_left_out: bool,
}

impl PageLength {
    fn parse(text: &str) -> Option<Self> {
        let length = Length::parse(text)?;
        Some(Self { length, unit_left_out: !text.trim().ends_with(|c: char| c.is_ascii_alphabetic()) })
    }

    /// The length in user units.
    fn in_unit(self, unit: Unit) -> f64 {
        if self.unit_left_out { self.length.value } else { self.length.in_unit(unit) }
    }
}

/// Reads `10mm`, `0.5in`, or `10` in the unit of the page.
pub(crate) fn margin(text: &str) -> Result<PageLength, String> {
    PageLength::parse(text)
        .filter(|margin| margin.length.value >= 0.0)
        .ok_or_else(|| "write a length such as 10mm".to_owned())
}

/// Reads `1:2` or `0.5`: length on paper per length of the model.
pub(crate) fn scale(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|n| n.is_finite() && *n > 0.0);
    let ratio = match text.split_once(':') {
        Some((paper, model)) => number(paper).zip(number(model)).map(|(paper, model)| paper / model),
        None => number(text),
    };
    ratio.filter(|r| r.is_finite() && *r > 0.0).ok_or_else(|| "write a scale such as 1:2 or 5:1".to_owned())
}

/// Sheet of a drawing, with a margin around the frame of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PictureSheet {
    /// Width and height in user units.
    pub(crate) extent: PaperSize,
    /// User unit.
    pub(crate) unit: Unit,
    /// Width of the margin in user units.
    pub(crate) margin: f64,
}

impl PictureSheet {
    /// Sheet with a margin. The default margin is 10 mm on a page in mm and 0 on a picture in px.
    pub(crate) fn new(extent: PaperSize, unit: Unit, margin: Option<PageLength>) -> Result<Self, Error> {
        let margin = match (margin, unit) {
            (Some(margin), unit) => margin.in_unit(unit),
            (None, Unit::Mm) => 10.0,
            (None, Unit::Px) => 0.0,
        };
        let shorter = extent.width.min(extent.height);
        if margin * 2.0 >= shorter {
            let unit = unit.name();
            return Err(Error::new(format!(
                "a margin of {margin} {unit} leaves no room on a page of {shorter} {unit}"
            ))
            .at("--margin")
            .remedy("make it less than half of the page's shorter side"));
        }
        Ok(Self { extent, unit, margin })
    }

    /// Width and height of the frame inside the margin.
    pub(crate) fn frame(&self) -> (f64, f64) {
        (self.extent.width - 2.0 * self.margin, self.extent.height - 2.0 * self.margin)
    }

    /// The page without a background.
    pub(crate) fn page(&self) -> Page {
        Page { width: self.extent.width, height: self.extent.height, unit: self.unit, background: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn extent(width: f64, height: f64) -> Result<PaperSize, String> {
        Ok(PaperSize { width, height })
    }

    #[test]
    fn size_px_parses_sizes_and_rejects_invalid_ones() {
        assert_eq!(size_px("1000x800"), extent(1000.0, 800.0));
        assert_eq!(size_px("640"), extent(640.0, 640.0));
        assert_eq!(size_px("640px"), extent(640.0, 640.0));
        assert_eq!(size_px("640 x 480px"), extent(640.0, 480.0));
        for wrong in ["", "x", "0x10", "10x", "-5", "nan", "inf", "1e9", "10x10x10"] {
            assert!(size_px(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn page_mm_parses_named_and_custom_page_sizes() {
        assert_eq!(page_mm("a4"), extent(210.0, 297.0));
        assert_eq!(page_mm("Letter"), extent(215.9, 279.4));
        assert_eq!(page_mm("210x297mm"), extent(210.0, 297.0));
        assert_eq!(page_mm("100x50"), extent(100.0, 50.0));
        assert_eq!(page_mm("21x29.7cm"), extent(210.0, 297.0));
        assert_eq!(page_mm("20mmx3cm"), extent(20.0, 30.0));
        assert_eq!(page_mm("A3").map(PaperSize::landscape), extent(420.0, 297.0));
        for wrong in ["", "A9", "210", "0x5mm", "5x5furlong"] {
            assert!(page_mm(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn scale_parses_ratios_and_decimals() {
        assert_eq!(scale("1:2"), Ok(0.5));
        assert_eq!(scale("5 : 1"), Ok(5.0));
        assert_eq!(scale("0.25"), Ok(0.25));
        for wrong in ["", "0:1", "1:0", "-1:2", "a:b", "1:2:3"] {
            assert!(scale(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn margin_reduces_the_frame_of_a_picture_sheet() -> Result<(), Error> {
        let sheet = PaperSize { width: 210.0, height: 297.0 };
        assert_eq!(PictureSheet::new(sheet, Unit::Mm, None)?.frame(), (190.0, 277.0));
        assert_eq!(PictureSheet::new(sheet, Unit::Px, None)?.frame(), (210.0, 297.0));
        assert_eq!(PictureSheet::new(sheet, Unit::Mm, margin("1cm").ok())?.margin, 10.0);
        assert_eq!(PictureSheet::new(sheet, Unit::Mm, margin("5").ok())?.margin, 5.0);
        assert!((PictureSheet::new(sheet, Unit::Px, margin("0.1in").ok())?.margin - 9.6).abs() < 1e-12);
        assert!(PictureSheet::new(sheet, Unit::Mm, margin("105mm").ok()).is_err());
        assert!(margin("-1mm").is_err() && margin("wide").is_err());
        Ok(())
    }
}
