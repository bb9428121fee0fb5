//! Embedded pictures of a drawing, each once, with ids for the marks that show them.

use std::sync::Arc;

use crate::parallel::prelude::*;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use kurbo::{Affine, Rect};
use rustc_hash::FxHashMap;

use super::decimals::Decimals;
use super::xml::UniqueIds;
use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;
use crate::drawing::{Drawing, ImagePaint, ImagePiece, Mark, Paint, PieceContent};
use crate::geometry::tolerances::TRIANGLE_BORDER_PX;

/// Decimals of the linear part of a transform.
const TURN_DECIMALS: u8 = 6;
/// Decimals of the shift of a transform.
const SHIFT_DECIMALS: u8 = 3;

/// Pictures of a drawing, each once.
pub(crate) struct EmbeddedPictures<'a> {
    pub list: Vec<&'a Picture>,
    /// Number of a picture, by its address.
    numbers: FxHashMap<usize, usize>,
    /// Ink of each picture shown through a mask; see [`EmbeddedPictures::ink`].
    pub inks: Vec<Option<Colour>>,
}

/// Marks of a drawing that show pictures.
pub(crate) fn marks(drawing: &Drawing) -> impl Iterator<Item = (&Mark, &ImagePaint)> {
    drawing.layers.iter().flat_map(|layer| &layer.marks).filter_map(|mark| match &mark.paint {
        Paint::Image(image) => Some((mark, image)),
        _ => None,
    })
}

impl<'a> EmbeddedPictures<'a> {
    /// Collects the pictures of a drawing and their inks.
    pub(crate) fn of(drawing: &'a Drawing) -> Self {
        let mut pictures = Self { list: Vec::new(), numbers: FxHashMap::default(), inks: Vec::new() };
        for (_, image) in marks(drawing) {
            let picture: &Picture = &image.picture;
            let Self { list, numbers, .. } = &mut pictures;
            numbers.entry(address(&image.picture)).or_insert_with(|| {
                list.iter().position(|known| **known == *picture).unwrap_or_else(|| {
                    list.push(picture);
                    list.len() - 1
                })
            });
        }
        pictures.inks = pictures.list.iter().map(|picture| half_clear_ink(picture)).collect();
        // The document holds each picture once. If any of its marks cannot use a mask, none does.
        let mut overlap = vec![false; pictures.list.len()];
        for (_, image) in marks(drawing) {
            let number = pictures.number(image);
            if let (Some(ink), Some(overlap)) = (pictures.inks.get_mut(number), overlap.get_mut(number)) {
                *ink = ink.filter(|ink| image.pieces.iter().all(|piece| is_of_ink(piece, *ink)));
                *overlap |= pieces_overlap(&image.pieces);
            }
        }
        pictures
            .inks
            .iter_mut()
            .zip(overlap)
            .filter(|(_, overlap)| !overlap)
            .for_each(|(ink, _)| *ink = None);
        pictures
    }

    /// Opaque ink of a picture that is shown through a mask: one colour, half-transparent, with overlapping
    /// pieces. Drawn directly, such pieces would be darker where they overlap.
    pub(crate) fn ink(&self, image: &ImagePaint) -> Option<Colour> {
        self.inks.get(self.number(image)).copied().flatten()
    }

    /// Number of the picture that a mark shows.
    pub(crate) fn number(&self, image: &ImagePaint) -> usize {
        self.numbers.get(&address(&image.picture)).copied().unwrap_or_default()
    }
}

/// Ids of pictures and of the marks that show them.
pub(crate) struct PictureIds<'a> {
    pictures: EmbeddedPictures<'a>,
    ids: Vec<String>,
    /// Ids of marks, by their address.
    marks: FxHashMap<usize, String>,
}

impl<'a> PictureIds<'a> {
    /// Assigns ids to all pictures and to the marks that show them.
    pub(crate) fn of(drawing: &'a Drawing, ids: &mut UniqueIds) -> Self {
        let pictures = EmbeddedPictures::of(drawing);
        let numbered = |name: &str, number: usize| format!("{name}-{}", number + 1);
        let names = (0..pictures.list.len()).map(|number| ids.take(&numbered("picture", number))).collect();
        let shown = marks(drawing).enumerate();
        let marks = shown
            .map(|(number, (mark, _))| {
                (std::ptr::from_ref(mark).addr(), ids.take(&numbered("shown", number)))
            })
            .collect();
        Self { pictures, ids: names, marks }
    }

    /// Whether there are no pictures.
    pub(crate) fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Id of the picture that a mark shows.
    pub(crate) fn picture(&self, image: &ImagePaint) -> &str {
        self.ids.get(self.pictures.number(image)).map_or("", String::as_str)
    }

    /// Ink of a picture shown through a mask.
    pub(crate) fn ink(&self, image: &ImagePaint) -> Option<Colour> {
        self.pictures.ink(image)
    }

    /// Id of a mark.
    pub(crate) fn mark(&self, mark: &Mark) -> &str {
        self.marks.get(&std::ptr::from_ref(mark).addr()).map_or("", String::as_str)
    }

    /// Writes the definitions of the pictures.
    pub(crate) fn write(&self, out: &mut Vec<u8>) {
        out.extend_from_slice(b"<defs>\n");
        let EmbeddedPictures { list, inks, .. } = &self.pictures;
        let encode = |(picture, ink): (&&Picture, &Option<Colour>)| {
            STANDARD.encode(if ink.is_some() { encode_opacity(picture) } else { encode(picture) })
        };
        let encoded: Vec<String> = list.par_iter().zip(inks).map(encode).collect();
        for ((id, picture), data) in self.ids.iter().zip(&self.pictures.list).zip(encoded) {
            let Picture { width, height, .. } = picture;
            let tag = format!(
                "<image id=\"{id}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
                 xlink:href=\"data:image/png;base64,{data}\"/>\n"
            );
            out.extend_from_slice(tag.as_bytes());
        }
        out.extend_from_slice(b"</defs>\n");
    }
}

/// Address of a picture, which many marks share.
pub(crate) fn address(picture: &Arc<Picture>) -> usize {
    Arc::as_ptr(picture).addr()
}

/// Coefficients of a transform in order, with a separator.
pub(crate) fn matrix(transform: Affine, between: &str) -> String {
    let coefficients = transform.as_coeffs();
    let decimals =
        [TURN_DECIMALS, TURN_DECIMALS, TURN_DECIMALS, TURN_DECIMALS, SHIFT_DECIMALS, SHIFT_DECIMALS];
    let texts =
        coefficients.iter().zip(decimals).map(|(value, decimals)| Decimals::new(decimals).text(*value));
    texts.collect::<Vec<_>>().join(between)
}

/// Opaque colour of a picture with a single colour and some half-transparent pixels.
fn half_clear_ink(picture: &Picture) -> Option<Colour> {
    let first = picture.pixels.first().map(|first| Colour { a: 255, ..*first })?;
    let is_half_clear = picture.pixels.iter().any(|pixel| !matches!(pixel.a, 0 | 255));
    let is_one = picture.pixels.iter().all(|pixel| Colour { a: 255, ..*pixel } == first);
    (is_half_clear && is_one).then_some(first)
}

/// Whether a piece shows pixels, or the ink's colour with any opacity.
fn is_of_ink(piece: &ImagePiece, ink: Colour) -> bool {
    match piece.shows {
        PieceContent::Pixels(_) => true,
        PieceContent::Colour(colour) => Colour { a: 255, ..colour } == ink,
    }
}

/// Whether the bounds of two consecutive pieces overlap by more than an edge.
fn pieces_overlap(pieces: &[ImagePiece]) -> bool {
    let bounds: Vec<Rect> = pieces.iter().map(|piece| piece.outline.control_box()).collect();
    let sides = |common: Rect| common.width().min(common.height());
    bounds.iter().zip(bounds.iter().skip(1)).any(|(a, b)| sides(a.intersect(*b)) > TRIANGLE_BORDER_PX)
}

/// A picture as a PNG file, without an alpha channel if it is opaque.
fn encode(picture: &Picture) -> Vec<u8> {
    let opaque = picture.pixels.iter().all(|pixel| pixel.a == 255);
    let (samples, colour): (Vec<u8>, _) = if opaque {
        (picture.pixels.iter().flat_map(|pixel| [pixel.r, pixel.g, pixel.b]).collect(), png::ColorType::Rgb)
    } else {
        let samples = picture.pixels.iter().flat_map(|pixel| [pixel.r, pixel.g, pixel.b, pixel.a]);
        (samples.collect(), png::ColorType::Rgba)
    };
    encode_samples(picture, &samples, colour)
}

/// Opacity of a picture as a grey PNG file.
fn encode_opacity(picture: &Picture) -> Vec<u8> {
    let samples: Vec<u8> = picture.pixels.iter().map(|pixel| pixel.a).collect();
    encode_samples(picture, &samples, png::ColorType::Grayscale)
}

fn encode_samples(picture: &Picture, samples: &[u8], colour: png::ColorType) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, picture.width as u32, picture.height as u32);
    encoder.set_color(colour);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    encoder.set_filter(png::Filter::Adaptive);
    // Writing to memory can only fail for an invalid size, and the size is that of the pixels.
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(samples));
    if written.is_ok() { file } else { Vec::new() }
}
