//! A drawing as PNG, rasterised from its SVG text.

use kurbo::Affine;
use tiny_skia::{Pixmap, Transform};

use super::picture_painter;
use super::tree_painter;
use crate::drawing::{Drawing, Layer, Mark, Page, Paint, Unit};
use crate::error::Error;
use crate::export::SvgOptions;

/// Default resolution of drawings in millimetres, in dots per inch.
const PRINT_DPI: f64 = 300.0;
/// CSS pixels per inch.
const CSS_DPI: f64 = 96.0;
const MM_PER_INCH: f64 = 25.4;
/// Most pixels of a picture, which take a gigabyte of memory.
const MAX_PIXELS: f64 = 268_435_456.0;
/// Most pixels per side.
const MAX_SIDE_PIXELS: f64 = 65_535.0;

/// Resolution of a raster.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum Resolution {
    /// One pixel per px of the drawing, or 300 per inch for drawings in millimetres.
    #[default]
    Natural,
    /// Pixels per inch; a px of the drawing is 1/96 inch.
    Dpi(f64),
    /// Width in pixels; the height keeps the aspect ratio.
    Width(u32),
}

/// Options of PNG.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct PngOptions {
    /// Resolution. Default: natural.
    pub resolution: Resolution,
}

impl PngOptions {
    /// Options with a given resolution.
    #[must_use]
    pub const fn of_resolution(resolution: Resolution) -> Self {
        Self { resolution }
    }
}

/// A drawing as pixels, row by row from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Pixels {
    /// Pixels per row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Four bytes per pixel: red, green, blue (not premultiplied) and alpha.
    pub rgba: Vec<u8>,
    /// Pixels per inch.
    pub dpi: f64,
}

impl Pixels {
    /// The same pixels on white paper, all opaque.
    #[must_use]
    pub fn on_white(&self) -> Self {
        let mut rgba = self.rgba.clone();
        for pixel in rgba.chunks_exact_mut(4) {
            if let [red, green, blue, alpha] = pixel {
                let clear = 255 - u32::from(*alpha);
                for channel in [red, green, blue] {
                    *channel = ((u32::from(*channel) * u32::from(*alpha) + 255 * clear + 127) / 255) as u8;
                }
                *alpha = 255;
            }
        }
        Self { rgba, ..*self }
    }
}

impl Drawing {
    /// Writes the drawing as a PNG file, transparent where the page has no background.
    ///
    /// # Errors
    /// If the picture has no pixels or exceeds the size limits, or if the drawing has more paths than the
    /// rasteriser accepts.
    pub fn to_png(&self, options: &PngOptions) -> Result<Vec<u8>, Error> {
        self.to_pixels(options)?.encode(&self.page)
    }

    /// Rasterises the drawing to the pixels of its PNG file.
    ///
    /// # Errors
    /// As [`Drawing::to_png`].
    pub fn to_pixels(&self, options: &PngOptions) -> Result<Pixels, Error> {
        let (mut pixmap, dpi) = canvas(&self.page, options)?;
        let to = self.page.fill(&pixmap);
        self.paint(&mut pixmap, to)?;
        let (width, height) = (pixmap.width(), pixmap.height());
        Ok(Pixels { width, height, rgba: pixmap.take_demultiplied(), dpi })
    }

    /// Whether any mark shows a picture.
    pub(crate) fn shows_pictures(&self) -> bool {
        self.layers.iter().any(|layer| layer.marks.iter().any(|mark| matches!(mark.paint, Paint::Image(_))))
    }

    /// Paints the drawing: marks that show pictures from their pixels, and all marks between them from their
    /// SVG text. `to` transforms user units to pixels.
    pub(crate) fn paint(&self, pixmap: &mut Pixmap, to: Affine) -> Result<(), Error> {
        let shows = |mark: &Mark| matches!(mark.paint, Paint::Image(_));
        if !self.shows_pictures() {
            return self.rasterise(pixmap, to);
        }
        let empty = |background| Self::new("", Page { background, ..self.page }, Vec::new());
        let mut next = empty(self.page.background);
        let mut known = picture_painter::CopyCache::default();
        for layer in &self.layers {
            for marks in layer.marks.chunk_by(|a, b| shows(a) == shows(b)) {
                if !marks.first().is_some_and(shows) {
                    next.layers.push(Layer { marks: marks.to_vec(), pen: layer.pen.clone(), ..*layer });
                    continue;
                }
                std::mem::replace(&mut next, empty(None)).rasterise(pixmap, to)?;
                let scale = transform(to);
                for mark in marks {
                    if let Paint::Image(image) = &mark.paint {
                        picture_painter::paint(pixmap, &mark.path, image, scale, &mut known);
                    }
                }
            }
        }
        next.rasterise(pixmap, to)
    }

    /// Paints a drawing without pictures over the existing pixels.
    fn rasterise(&self, pixmap: &mut Pixmap, to: Affine) -> Result<(), Error> {
        rasterise(self.to_svg(&SvgOptions::default()), &self.page, pixmap, to)
    }
}

/// Paints the SVG text of a page over the existing pixels; `to` transforms page units to pixels.
pub(crate) fn rasterise(svg: String, page: &Page, pixmap: &mut Pixmap, to: Affine) -> Result<(), Error> {
    let tree = usvg::Tree::from_str(&svg, &usvg::Options::default()).map_err(|error| {
        Error::new(format!("the drawing cannot be rasterised: {error}")).remedy("write SVG instead")
    })?;
    drop(svg);
    let size = [tree.size().width(), tree.size().height()].map(f64::from);
    let [across, down] = [page.width / size[0], page.height / size[1]];
    let to = to * Affine::scale_non_uniform(across, down);
    tree_painter::render(&tree, transform(to), &mut pixmap.as_mut());
    Ok(())
}

/// A transform as a type of the rasteriser.
pub(crate) fn transform(affine: Affine) -> Transform {
    let [a, b, c, d, x, y] = affine.as_coeffs().map(|value| value as f32);
    Transform::from_row(a, b, c, d, x, y)
}

/// Empty pixels for a page, and pixels per inch.
pub(crate) fn canvas(page: &Page, options: &PngOptions) -> Result<(Pixmap, f64), Error> {
    let (width, height, dpi) = page.pixels(options)?;
    let pixmap = Pixmap::new(width, height)
        .ok_or_else(|| Error::new(format!("not enough memory for {width} x {height} pixels")))?;
    Ok((pixmap, dpi))
}

impl Page {
    /// Transform from page units to the pixels that the page fills.
    pub(crate) fn fill(&self, pixmap: &Pixmap) -> Affine {
        Affine::scale_non_uniform(
            f64::from(pixmap.width()) / self.width,
            f64::from(pixmap.height()) / self.height,
        )
    }

    /// Width and height in pixels, and pixels per inch.
    fn pixels(&self, options: &PngOptions) -> Result<(u32, u32, f64), Error> {
        let (per_inch, natural) = match self.unit {
            Unit::Px => (CSS_DPI, CSS_DPI),
            Unit::Mm => (MM_PER_INCH, PRINT_DPI),
        };
        let dpi = match options.resolution {
            Resolution::Natural => natural,
            Resolution::Dpi(dpi) => dpi,
            Resolution::Width(pixels) => f64::from(pixels) / self.width * per_inch,
        };
        let width = (self.width / per_inch * dpi).round();
        let height = (self.height / per_inch * dpi).round();
        let sides = width.max(height);
        if !(width >= 1.0 && height >= 1.0 && sides <= MAX_SIDE_PIXELS && width * height <= MAX_PIXELS) {
            return Err(Error::new(format!("a picture of {width} x {height} pixels is not possible"))
                .remedy(
                    "choose 1 to 65535 pixels per side and at most 268 million in total, or another --dpi",
                ));
        }
        Ok((width as u32, height as u32, dpi))
    }
}

impl Pixels {
    /// Encodes the file, without an alpha channel if the paper is opaque.
    pub(crate) fn encode(self, page: &Page) -> Result<Vec<u8>, Error> {
        let opaque = page.background.is_some_and(|colour| colour.a == 255);
        encode([self.width, self.height], self.rgba, opaque, self.dpi)
            .map_err(|error| Error::new(format!("cannot write PNG: {error}")))
    }
}

/// Encodes the file, without an alpha channel if every pixel is opaque.
fn encode(
    [width, height]: [u32; 2],
    mut pixels: Vec<u8>,
    opaque: bool,
    dpi: f64,
) -> Result<Vec<u8>, png::EncodingError> {
    if opaque {
        let mut to = 0;
        for from in (0..pixels.len()).step_by(4) {
            pixels.copy_within(from..from + 3, to);
            to += 3;
        }
        pixels.truncate(to);
    }
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(if opaque { png::ColorType::Rgb } else { png::ColorType::Rgba });
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    let per_metre = (dpi / MM_PER_INCH * 1000.0).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(file)
}
