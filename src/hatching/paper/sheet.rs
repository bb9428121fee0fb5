//! [`paper`] and [`tooth`]: the sheet of paper, behind the model and over it.
//!
//! Source: Lake et al. 2000, section 3.3 and figure 6: the paper's texture lies behind the model and shows
//! through the ink.
//!
//! If the sheet is a picture, its hollows are darker than the rest and take less ink. There the paper is laid
//! over ink and paint. Where nothing is drawn, that changes nothing.

use std::sync::Arc;

use kurbo::{Affine, BezPath, Rect, Shape};

use super::grain::{Grain, grain, specks};
use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;
use crate::drawing::{
    ImagePaint, ImagePiece, Layer, LayerKind, Length, Mark, Page, Paint, PieceContent, Provenance,
};

/// Sheet of paper.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Paper {
    /// Picture of the paper, tiled over the page. Default: none, a plain colour.
    pub picture: Option<Arc<Picture>>,
    /// Width of one tile. Default: one px for each pixel.
    pub width: Option<Length>,
    /// Visibility of the grain, 0 to 1. Default: 0.
    pub grain: f64,
    /// How strongly the paper shows through ink and paint, 0 to 1. Default: 0.
    pub tooth: f64,
}

/// The layer behind the model: the picture, and the grain over it. `None` if the sheet is plain.
#[must_use]
pub(crate) fn paper(page: &Page, sheet: &Paper, seed: u64) -> Option<Layer> {
    let mut marks = Vec::new();
    if let Some(picture) = &sheet.picture {
        // A plain fill below the tiles hides the seams between them.
        marks.push(mark(whole(page), Paint::Fill(SheetStatistics::of(picture).colour)));
        marks.push(mark(whole(page), Paint::Image(tiled(Arc::clone(picture), page, sheet.width))));
    }
    if sheet.grain > 0.0 {
        marks.extend(grain(page, &grains(sheet.grain, seed)).into_iter().flat_map(|layer| layer.marks));
    }
    // The picture must stay below the grain.
    let ordered = sheet.picture.is_some();
    (!marks.is_empty()).then_some(Layer { kind: LayerKind::Paper, pen: None, ordered, marks })
}

/// The layer of paper that shows through everything drawn on it. `None` if there is none.
#[must_use]
pub(crate) fn tooth(page: &Page, sheet: &Paper, seed: u64) -> Option<Layer> {
    if sheet.tooth.is_nan() || sheet.tooth <= 0.0 {
        return None;
    }
    let over = match &sheet.picture {
        Some(picture) => {
            let hollows = hollows(picture, sheet.tooth)?;
            mark(whole(page), Paint::Image(tiled(Arc::new(hollows), page, sheet.width)))
        }
        None => {
            // A different seed from the grain behind, so that the specks differ.
            let options = Grain { density: TOOTH_SPECKS_PER_100_PX_SQUARE, ..grains(sheet.grain, !seed) };
            let path: BezPath = specks(page, &options)?.into_iter().flatten().collect();
            let colour = page.background.unwrap_or(Colour::WHITE);
            mark(path, Paint::Fill(Colour { a: (sheet.tooth.min(1.0) * 255.0).round() as u8, ..colour }))
        }
    };
    Some(Layer { kind: LayerKind::Tooth, pen: None, ordered: false, marks: vec![over] })
}

/// Number of specks of bare paper over the ink in a square of 100 px.
const TOOTH_SPECKS_PER_100_PX_SQUARE: f64 = 90.0;

/// Approximate greatest number of tiles on a page. Smaller tiles are enlarged.
const MAX_TILES: f64 = 1024.0;

/// The grain of a sheet at a given visibility, 0 to 1.
fn grains(shows: f64, seed: u64) -> Grain {
    let usual = Grain::default();
    let contrast = usual.contrast * (2.0 * shows).min(1.0);
    Grain { density: usual.density * (1.0 + 2.0 * shows), contrast, seed }
}

fn mark(path: BezPath, paint: Paint) -> Mark {
    Mark { path, paint, provenance: Provenance { classes: vec!["grain"], ..Provenance::default() } }
}

fn whole(page: &Page) -> BezPath {
    Rect::new(0.0, 0.0, page.width, page.height).to_path(0.1)
}

/// A picture tiled from the upper left corner of the page.
fn tiled(picture: Arc<Picture>, page: &Page, width: Option<Length>) -> ImagePaint {
    let wanted_width = width.unwrap_or(Length::px(picture.width as f64)).in_unit(page.unit);
    let shape = picture.height as f64 / picture.width as f64;
    let least = (page.width * page.height / (MAX_TILES * shape)).sqrt();
    let least = least.max(page.width / MAX_TILES).max(page.height / (MAX_TILES * shape));
    let width = if wanted_width > least { wanted_width } else { least };
    let (scale, height) = (width / picture.width as f64, width * shape);
    let [columns, rows] =
        [page.width / width, page.height / height].map(|count| count.ceil().clamp(1.0, MAX_TILES) as u32);
    let piece = |number: u32| {
        let (x, y) = (f64::from(number % columns) * width, f64::from(number / columns) * height);
        let tile = Rect::new(x, y, (x + width).min(page.width), (y + height).min(page.height));
        let shows = PieceContent::Pixels(Affine::translate((x, y)) * Affine::scale(scale));
        ImagePiece { outline: tile.to_path(0.1), shows }
    };
    ImagePaint { pieces: (0..columns * rows).map(piece).collect(), picture }
}

/// Luminance of a pixel, 0 to 255 (Rec. 709 weights).
fn lightness(colour: Colour) -> f64 {
    0.2126 * f64::from(colour.r) + 0.7152 * f64::from(colour.g) + 0.0722 * f64::from(colour.b)
}

/// Statistics of the pixels of a sheet.
struct SheetStatistics {
    /// The mean colour.
    colour: Colour,
    /// Mean luminance and its standard deviation.
    mean: f64,
    deviation: f64,
}

impl SheetStatistics {
    fn of(picture: &Picture) -> Self {
        let count = picture.pixels.len().max(1) as f64;
        let mean = |value: &dyn Fn(&Colour) -> f64| picture.pixels.iter().map(value).sum::<f64>() / count;
        let [r, g, b] = [mean(&|c| f64::from(c.r)), mean(&|c| f64::from(c.g)), mean(&|c| f64::from(c.b))]
            .map(|channel| channel.round() as u8);
        let light = mean(&|colour| lightness(*colour));
        let deviation = mean(&|colour| (lightness(*colour) - light).powi(2)).sqrt();
        Self { colour: Colour::rgb(r, g, b), mean: light, deviation }
    }
}

/// The picture of a sheet, transparent except where it is darker than the mean. `None` if it has one colour.
fn hollows(picture: &Picture, tooth: f64) -> Option<Picture> {
    let SheetStatistics { mean, deviation, .. } = SheetStatistics::of(picture);
    let depth = |colour: &Colour| ((mean - lightness(*colour)) / (2.0 * deviation)).clamp(0.0, 1.0);
    let pixel =
        |colour: &Colour| Colour { a: (depth(colour) * tooth.min(1.0) * 255.0).round() as u8, ..*colour };
    (deviation > 0.5).then(|| Picture { pixels: picture.pixels.iter().map(pixel).collect(), ..*picture })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Unit;

    const PAGE: Page = Page { width: 100.0, height: 60.0, unit: Unit::Px, background: None };

    /// White, except for every third column.
    fn laid_paper() -> Arc<Picture> {
        let pixel =
            |k: usize| if (k % 9).is_multiple_of(3) { Colour::rgb(200, 190, 180) } else { Colour::WHITE };
        Arc::new(Picture { width: 9, height: 6, pixels: (0..54).map(pixel).collect() })
    }

    fn image_paints(layer: &Layer) -> Vec<&ImagePaint> {
        let image = |mark: &'_ Mark| matches!(mark.paint, Paint::Image(_));
        let marks = layer.marks.iter().filter(|mark| image(mark));
        marks
            .filter_map(|mark| if let Paint::Image(image) = &mark.paint { Some(image) } else { None })
            .collect()
    }

    #[test]
    fn paper_tiles_cover_the_page_once() {
        let narrow = |width: usize, height: usize| {
            let pixels = vec![Colour::WHITE; width * height];
            Arc::new(Picture { width, height, pixels })
        };
        for width in [None, Some(Length::px(31.0)), Some(Length::px(1e-9)), Some(Length::px(1e9))] {
            for picture in [laid_paper(), narrow(1, 9000), narrow(9000, 1)] {
                let sheet = Paper { picture: Some(picture), width, ..Paper::default() };
                let layer = paper(&PAGE, &sheet, 0).unwrap_or_else(|| panic!("a picture"));
                let image = image_paints(&layer)[0];
                let area: f64 = image.pieces.iter().map(|piece| piece.outline.area().abs()).sum();
                assert!((area - 6000.0).abs() < 1e-6 && image.pieces.len() <= 2048, "{width:?} {area}");
            }
        }
    }

    #[test]
    fn tooth_of_a_picture_shows_the_paper_where_it_is_dark() {
        let sheet = Paper { picture: Some(laid_paper()), tooth: 0.5, ..Paper::default() };
        let layer = tooth(&PAGE, &sheet, 0).unwrap_or_else(|| panic!("a tooth"));
        let over = &image_paints(&layer)[0].picture;
        for (own, paper) in over.pixels.iter().zip(&laid_paper().pixels) {
            assert_eq!(Colour { a: 255, ..*own }, *paper);
            assert_eq!(own.a > 60 && own.a <= 128, *paper != Colour::WHITE, "{own:?}");
        }
        let even = Picture { pixels: vec![Colour::WHITE; 54], ..*laid_paper() };
        assert!(tooth(&PAGE, &Paper { picture: Some(Arc::new(even)), ..sheet }, 0).is_none());
    }

    #[test]
    fn tooth_of_plain_paper_has_the_colour_of_the_page() {
        let page = Page { background: Some(Colour::rgb(250, 245, 230)), ..PAGE };
        let sheet = Paper { tooth: 0.4, ..Paper::default() };
        let layer = tooth(&page, &sheet, 7).unwrap_or_else(|| panic!("a tooth"));
        let [mark] = &layer.marks[..] else { panic!("one mark") };
        assert_eq!(mark.paint, Paint::Fill(Colour { r: 250, g: 245, b: 230, a: 102 }));
        assert!(mark.path.elements().len() > 100);
        assert!(tooth(&page, &Paper::default(), 7).is_none() && paper(&page, &Paper::default(), 7).is_none());
    }
}
