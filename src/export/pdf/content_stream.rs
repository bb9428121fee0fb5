//! Content stream of PDF: painting operators for marks, with graphics state written only where it changes.
//!
//! Source: ISO 32000-1, tables 57 (graphics state), 59 (path construction), 60 (path painting).

use kurbo::{Affine, PathEl, Point};

use super::fonts::Fonts;
use super::picture_crops::Crops;
use crate::colour::srgb::Colour;
use crate::drawing::{
    Cap, ImagePaint, ImagePiece, Join, Mark, OutlinePaint, Paint, PieceContent, StrokePaint,
};
use crate::export::encoding::decimals::Decimals;
use crate::export::encoding::embedded_pictures::matrix;
use crate::export::pdf::press::halftone_screen::Screen;
use crate::export::pdf::press::ink_plates::{Plates, PressInk};

/// Decimals of widths and dashes, as in SVG.
const WIDTH_DECIMALS: u8 = 3;
/// Decimals of colour channels.
const CHANNEL_DECIMALS: u8 = 4;

/// Inks and fonts for printing marks.
#[derive(Clone, Copy)]
pub(crate) struct PressSettings<'a> {
    pub plates: &'a Plates,
    /// `None` if letters are written as outlines.
    pub fonts: Option<&'a Fonts>,
    /// Number of the drawing's first picture in the document.
    pub first_picture: usize,
    /// Halftone settings for fills, if any.
    pub dots: Option<HalftoneDots>,
}

/// Halftone settings for the fills of one drawing.
#[derive(Clone, Copy)]
pub(crate) struct HalftoneDots {
    pub screen: Screen,
    /// Transform from drawing units to page units.
    pub place: Affine,
    /// Page units per mm.
    pub mm: f64,
}

/// Writer of marks, one after another.
pub(crate) struct ContentWriter<'a> {
    pub(crate) out: Vec<u8>,
    decimals: Decimals,
    /// The current stroke; unknown at the start.
    stroke: Option<StrokePaint>,
    pub(crate) fill: Option<Colour>,
    /// Current opacity and overprint flag.
    state: Option<(u8, bool)>,
    /// Number of the next gradient.
    patterns: usize,
    /// `None` for RGB colours and letters as outlines.
    pub(crate) press: Option<PressSettings<'a>>,
}

impl<'a> ContentWriter<'a> {
    /// Creates a writer with the given decimals of coordinates. Gradients are numbered from `patterns`.
    pub(crate) fn new(decimals: Decimals, patterns: usize, press: Option<PressSettings<'a>>) -> Self {
        Self { out: Vec::new(), decimals, stroke: None, fill: None, state: None, patterns, press }
    }

    /// Paints a mark that is not a picture.
    pub(crate) fn plain(&mut self, mark: &Mark) {
        self.mark(mark, &Crops::default());
    }

    /// Paints a mark of a drawing with the given pictures.
    pub(crate) fn mark(&mut self, mark: &Mark, pictures: &Crops) {
        if mark.path.elements().is_empty() {
            self.patterns += usize::from(matches!(mark.paint, Paint::Gradient(_)));
            return;
        }
        match &mark.paint {
            Paint::Stroke(stroke) => {
                self.set_state(stroke.colour);
                self.set_stroke(stroke);
                self.path_with(mark.path.elements(), b"S");
            }
            Paint::Gradient(gradient)
                if self.screened(mark, gradient.stops.first().map_or(255, |s| s.1.a)) =>
            {
                self.patterns += 1;
            }
            Paint::Fill(colour) if mark.provenance.text.is_none() && self.screened(mark, colour.a) => {}
            Paint::Gradient(gradient) => {
                self.set_opacity(gradient.stops.first().map_or(255, |(_, colour)| colour.a));
                let name = pattern_name(self.patterns);
                self.patterns += 1;
                self.fill = None;
                self.out.extend_from_slice(format!("/Pattern cs /{name} scn\n").as_bytes());
                self.path_with(mark.path.elements(), b"f");
            }
            Paint::Fill(colour) | Paint::Outline(OutlinePaint { colour, .. }) => {
                self.set_state(*colour);
                self.set_fill(*colour);
                let fonts = self.press.and_then(|press| press.fonts);
                let set = fonts.zip(mark.provenance.text.as_ref());
                if set.is_some_and(|(fonts, run)| fonts.set(&mut self.out, run, self.decimals)) {
                    return;
                }
                self.path_with(mark.path.elements(), b"f");
            }
            Paint::Image(image) if pictures.mask(image).is_some() => {
                let Some((number, ink)) = pictures.mask(image) else { return };
                let first = self.press.map_or(0, |press| press.first_picture);
                self.set_opacity(255);
                let before = (self.stroke.clone(), self.fill, self.state);
                self.out.extend_from_slice(format!("q\n/{} gs\n", mask_name(first, number)).as_bytes());
                self.set_fill(ink);
                self.path(mark.path.elements());
                self.out.extend_from_slice(b"f\nQ\n");
                (self.stroke, self.fill, self.state) = before;
            }
            Paint::Image(image) => {
                self.set_opacity(255);
                self.clipped(mark.path.elements(), |writer| writer.pieces(image, pictures));
            }
        }
    }

    /// Paints the pieces of a picture.
    fn pieces(&mut self, image: &ImagePaint, pictures: &Crops) {
        let first = self.press.map_or(0, |press| press.first_picture);
        self.pieces_with(image, pictures, first, Self::set_fill);
    }

    /// Paints the pieces of a picture. `fill` sets the fill of a piece in one colour.
    fn pieces_with(
        &mut self,
        image: &ImagePaint,
        pictures: &Crops,
        first: usize,
        fill: impl Fn(&mut Self, Colour),
    ) {
        for piece in &image.pieces {
            match piece.shows {
                PieceContent::Pixels(_) => self.pixels(piece, pictures, first),
                PieceContent::Colour(colour) => {
                    fill(self, colour);
                    self.path_with(piece.outline.elements(), b"f");
                }
            }
        }
    }

    /// Paints the opacity of the pieces of a picture: black for transparent, white for opaque.
    pub(crate) fn opacities(&mut self, image: &ImagePaint, pictures: &Crops, first: usize) {
        self.pieces_with(image, pictures, first, |writer, colour| {
            let light = Decimals::new(CHANNEL_DECIMALS).text(f64::from(colour.a) / 255.0);
            writer.out.extend_from_slice(format!("{light} g\n").as_bytes());
        });
    }

    /// Paints a piece that shows pixels.
    fn pixels(&mut self, piece: &ImagePiece, pictures: &Crops, first: usize) {
        let PieceContent::Pixels(transform) = piece.shows else { return };
        let Some((number, crop)) = pictures.shown(piece) else { return };
        let place = matrix(transform * crop.pixels_from_object(), " ");
        let shown = format!("{place} cm\n/{} Do\n", picture_name(first + number));
        self.clipped(piece.outline.elements(), |writer| {
            writer.out.extend_from_slice(shown.as_bytes());
        });
    }

    /// Paints with a path as the clip region.
    pub(crate) fn clipped(&mut self, elements: &[PathEl], paint: impl FnOnce(&mut Self)) {
        let ink = (self.stroke.clone(), self.fill, self.state);
        self.out.extend_from_slice(b"q\n");
        self.path_with(elements, b"W n");
        paint(self);
        self.out.extend_from_slice(b"Q\n");
        (self.stroke, self.fill, self.state) = ink;
    }

    /// Sets the properties of a stroke that differ from the current ones.
    fn set_stroke(&mut self, stroke: &StrokePaint) {
        let old = self.stroke.take();
        let differs =
            |same: fn(&StrokePaint, &StrokePaint) -> bool| !old.as_ref().is_some_and(|old| same(old, stroke));
        let fine = Decimals::new(WIDTH_DECIMALS);
        if differs(|a, b| a.width == b.width) {
            self.value(fine, stroke.width);
            self.operator(b"w");
        }
        if differs(|a, b| a.cap == b.cap) {
            self.operator(match stroke.cap {
                Cap::Butt => b"0 J",
                Cap::Round => b"1 J",
                Cap::Square => b"2 J",
            });
        }
        if differs(|a, b| a.join == b.join) {
            self.operator(match stroke.join {
                Join::Miter => b"0 j",
                Join::Round => b"1 j",
                Join::Bevel => b"2 j",
            });
        }
        if differs(|a, b| a.colour == b.colour) {
            self.colour(stroke.colour, b"RG");
        }
        if differs(|a, b| a.dash == b.dash && a.dash_offset == b.dash_offset) {
            self.out.push(b'[');
            // A dash pattern of zeros would be an error.
            if stroke.dash.iter().any(|length| fine.round(*length) > 0) {
                stroke.dash.iter().for_each(|length| self.value(fine, *length));
            }
            self.out.extend_from_slice(b"] ");
            self.value(fine, stroke.dash_offset);
            self.operator(b"d");
        }
        self.stroke = Some(stroke.clone());
    }

    /// Sets the fill colour.
    pub(crate) fn set_fill(&mut self, colour: Colour) {
        if self.fill != Some(colour) {
            self.colour(colour, b"rg");
            self.fill = Some(colour);
        }
    }

    /// Selects the graphics state for a colour: its opacity and its overprint flag.
    pub(crate) fn set_state(&mut self, colour: Colour) {
        let overprints = self.press.is_some_and(|press| press.plates.overprints(colour));
        self.choose((colour.a, overprints));
    }

    /// Selects the graphics state of an opacity, by its [`state_name`].
    fn set_opacity(&mut self, opacity: u8) {
        self.choose((opacity, false));
    }

    /// Selects a graphics state unless it is current.
    pub(crate) fn choose(&mut self, state: (u8, bool)) {
        if self.state != Some(state) {
            self.out.push(b'/');
            self.out.extend_from_slice(state_name(state).as_bytes());
            self.operator(b" gs");
            self.state = Some(state);
        }
    }

    /// Sets a colour. `operator` is the RGB operator `rg` or `RG`.
    fn colour(&mut self, colour: Colour, operator: &[u8]) {
        let fills = operator == b"rg";
        let fine = Decimals::new(CHANNEL_DECIMALS);
        match self.press.map(|press| press.plates.ink(colour)) {
            None => {
                for channel in colour.channels() {
                    self.value(fine, channel);
                }
                self.operator(operator);
            }
            Some(PressInk::Rgb(channels)) => {
                channels.into_iter().for_each(|channel| self.value(fine, channel));
                self.operator(operator);
            }
            Some(PressInk::Cmyk(inks)) => {
                inks.into_iter().for_each(|ink| self.value(fine, ink));
                self.operator(if fills { b"k" } else { b"K" });
            }
            Some(PressInk::Spot(number)) => {
                let (space, tint) = if fills { ("cs", "scn") } else { ("CS", "SCN") };
                self.out.extend_from_slice(format!("/{} {space} 1 {tint}\n", spot_name(number)).as_bytes());
            }
        }
    }

    /// Writes the path construction operators.
    pub(crate) fn path(&mut self, elements: &[PathEl]) {
        let mut pen = Point::ZERO;
        let mut start = Point::ZERO;
        for (index, element) in elements.iter().enumerate() {
            match *element {
                PathEl::MoveTo(to) => {
                    self.points(&[to], b"m");
                    // A subpath of zero length is a dot, and needs a segment for its caps to be drawn.
                    if !matches!(elements.get(index + 1), Some(next) if !matches!(next, PathEl::MoveTo(_))) {
                        self.points(&[to], b"l");
                    }
                    (pen, start) = (to, to);
                }
                PathEl::LineTo(to) => {
                    self.points(&[to], b"l");
                    pen = to;
                }
                PathEl::QuadTo(control, to) => {
                    let (first, second) = (pen.lerp(control, 2.0 / 3.0), to.lerp(control, 2.0 / 3.0));
                    self.points(&[first, second, to], b"c");
                    pen = to;
                }
                PathEl::CurveTo(first, second, to) => {
                    self.points(&[first, second, to], b"c");
                    pen = to;
                }
                PathEl::ClosePath => {
                    self.operator(b"h");
                    pen = start;
                }
            }
        }
    }

    /// Writes a path and the operator that paints it.
    pub(crate) fn path_with(&mut self, elements: &[PathEl], operator: &[u8]) {
        self.path(elements);
        self.operator(operator);
    }

    fn points(&mut self, points: &[Point], operator: &[u8]) {
        for point in points {
            self.value(self.decimals, point.x);
            self.value(self.decimals, point.y);
        }
        self.operator(operator);
    }

    pub(crate) fn value(&mut self, decimals: Decimals, value: f64) {
        decimals.write_operand(&mut self.out, value);
    }

    pub(crate) fn operator(&mut self, operator: &[u8]) {
        self.out.extend_from_slice(operator);
        self.out.push(b'\n');
    }
}

/// Name of a layer in the page's resources.
pub(crate) fn group_name(index: usize) -> String {
    format!("L{index}")
}

/// Name of the graphics state that sets a mask. `first_picture` is the number of the drawing's first picture
/// in the document.
pub(crate) fn mask_name(first_picture: usize, number: usize) -> String {
    format!("M{first_picture}x{number}")
}

/// Name of a picture in the page's resources.
pub(crate) fn picture_name(number: usize) -> String {
    format!("P{number}")
}

/// Name of a gradient, by its number in the order of marks.
pub(crate) fn pattern_name(number: usize) -> String {
    format!("G{number}")
}

/// Name of the colour space of a spot ink.
pub(crate) fn spot_name(number: usize) -> String {
    format!("S{number}")
}

/// Name of the graphics state of an opacity and an overprint flag.
pub(crate) fn state_name((opacity, overprints): (u8, bool)) -> String {
    format!("{}{opacity}", if overprints { 'O' } else { 'A' })
}

#[cfg(test)]
mod tests;
