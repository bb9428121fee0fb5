//! Writes a page of several placed drawings, such as a comic page, as a PNG file.
//!
//! Runs of drawings without pictures (raster images) are rasterised together from their SVG text. A drawing
//! with pictures is painted on its own, with the pictures taken from their pixels, and then clipped to its
//! frame.

use kurbo::Affine;
use tiny_skia::{FillRule, Mask, Pixmap, PixmapPaint, Transform};

use super::picture_painter;
use super::png_drawing::{Pixels, PngOptions, canvas, rasterise, transform};
use crate::drawing::{Composition, Page, PlacedDrawing};
use crate::error::Error;
use crate::export::svg::svg_options::SvgOptions;

impl Composition {
    /// Writes the page as a PNG file, transparent where it has no background.
    ///
    /// # Errors
    /// Those of [`crate::drawing::Drawing::to_png`].
    pub fn to_png(&self, options: &PngOptions) -> Result<Vec<u8>, Error> {
        let (mut pixmap, dpi) = canvas(&self.page, options)?;
        let to = self.page.fill(&pixmap);
        let part = |items: &[PlacedDrawing], background| Self {
            items: items.to_vec(),
            ..Self::new("", Page { background, ..self.page }, Vec::new())
        };
        let mut background = self.page.background;
        for items in self.items.chunk_by(|a, b| !a.drawing.shows_pictures() && !b.drawing.shows_pictures()) {
            let part = match items {
                // Pictures are painted from their pixels, not from the SVG text.
                [item] if item.drawing.shows_pictures() => {
                    let paper = part(&[], background.take());
                    rasterise(paper.to_svg(&SvgOptions::default()), &self.page, &mut pixmap, to)?;
                    paint(item, &mut pixmap, to)?;
                    continue;
                }
                items => part(items, background.take()),
            };
            rasterise(part.to_svg(&SvgOptions::default()), &self.page, &mut pixmap, to)?;
        }
        if self.items.is_empty() {
            let svg = part(&[], background).to_svg(&SvgOptions::default());
            rasterise(svg, &self.page, &mut pixmap, to)?;
        }
        let (width, height) = (pixmap.width(), pixmap.height());
        Pixels { width, height, rgba: pixmap.take_demultiplied(), dpi }.encode(&self.page)
    }
}

/// Paints one drawing over the canvas, clipped to its frame. `to` transforms the page to pixels.
fn paint(item: &PlacedDrawing, pixmap: &mut Pixmap, to: Affine) -> Result<(), Error> {
    let (width, height) = (pixmap.width(), pixmap.height());
    let (Some(mut own), Some(mut frame)) = (Pixmap::new(width, height), Mask::new(width, height)) else {
        return Err(Error::new(format!("not enough memory for {width} x {height} pixels")));
    };
    item.drawing.paint(&mut own, to * item.place)?;
    let frame = item.clip.as_ref().map(|clip| {
        if let Some(path) = picture_painter::path(clip) {
            frame.fill_path(&path, FillRule::Winding, true, transform(to));
        }
        frame
    });
    let paint = PixmapPaint::default();
    pixmap.draw_pixmap(0, 0, own.as_ref(), &paint, Transform::identity(), frame.as_ref());
    Ok(())
}
