//! Fills as halftone dots in a PDF content stream.

use std::collections::BTreeMap;

use kurbo::{Affine, Point};

use super::content_stream::ContentWriter;
use crate::colour::srgb::Colour;
use crate::drawing::{Gradient, Mark, Paint};
use crate::export::encoding::decimals::Decimals;
use crate::export::encoding::embedded_pictures::matrix;
use crate::export::pdf::press::halftone_screen::{InkTone, diameter, dots as screen_dots, share_of, tone};
use crate::export::pdf::press::ink_plates::PressInk;

/// Decimals of ink channels and of dot diameters.
const INK_DECIMALS: u8 = 4;

/// Dots per path, because viewers are slow with long paths.
const DOTS_PER_PATH: usize = 1000;

/// Classes of marks drawn with a pen, although they are filled.
const PEN_CLASSES: [&str; 3] = ["hatch", "pattern", "grain"];

impl ContentWriter<'_> {
    /// Paints a fill as dots, and returns whether it did. Fills that are not halftoned are left to the
    /// caller.
    pub(crate) fn screened(&mut self, mark: &Mark, opacity: u8) -> bool {
        let Some((press, dots)) = self.press.and_then(|press| Some((press, press.dots?))) else {
            return false;
        };
        // Hatching strokes, pattern dots and grain are not tones.
        if mark.provenance.classes.iter().any(|class| PEN_CLASSES.contains(class)) {
            return false;
        }
        let clear = f64::from(opacity) / 255.0;
        let inks = |colour: Colour| match press.plates.ink(colour) {
            PressInk::Cmyk(inks) => Some(inks.map(|ink| ink * clear)),
            _ => None,
        };
        let gradient = match &mark.paint {
            Paint::Gradient(gradient) => Some(gradient),
            _ => None,
        };
        let colour = match &mark.paint {
            Paint::Fill(colour) => *colour,
            _ => gradient.map_or(Colour::BLACK, Gradient::middle),
        };
        let Some(flat) = inks(colour) else { return false };
        let is_flat = gradient.is_none();
        if is_flat && flat.iter().all(|ink| tone(*ink) != InkTone::Dots) && opacity == 255 {
            return false;
        }
        // An opaque fill removes the inks below it.
        if opacity == 255 {
            self.choose((255, false));
            self.out.extend_from_slice(b"0 0 0 0 k\n");
            self.fill = None;
            self.path_with(mark.path.elements(), b"f");
        }
        self.clipped(mark.path.elements(), |writer| {
            writer.choose((255, true));
            let mut previous_lattice = Affine::IDENTITY;
            // Solid plates first, so that viewers without overprint also show the dots of the other plates.
            let is_solid = |ink: &f64| is_flat && tone(*ink) == InkTone::Solid;
            let solids = flat.iter().enumerate().filter(|(_, ink)| is_solid(ink));
            let rest = flat.iter().enumerate().filter(|(_, ink)| !is_solid(ink));
            for (plate, ink) in solids.chain(rest) {
                if is_flat && tone(*ink) == InkTone::None {
                    continue;
                }
                let mut solid = [0.0; 4];
                if let Some(one) = solid.get_mut(plate) {
                    *one = 1.0;
                }
                // Transform from the lattice to drawing units.
                let lattice = dots.place.inverse() * dots.screen.lattice(plate, dots.mm);
                let outline = lattice.inverse() * &mark.path;
                let ink_at = |at: Point| match gradient {
                    None => *ink,
                    Some(gradient) => {
                        let (line, at) = (gradient.end - gradient.start, lattice * at - gradient.start);
                        let along = if line.hypot2() > 0.0 { line.dot(at) / line.hypot2() } else { 0.5 };
                        inks(gradient.at(along.clamp(0.0, 1.0)))
                            .and_then(|inks| inks.get(plate).copied())
                            .unwrap_or(0.0)
                    }
                };
                let halftone_dots = if is_solid(ink) { None } else { screen_dots(&outline, ink_at) };
                let change = previous_lattice.inverse() * lattice;
                previous_lattice = lattice;
                writer.out.extend_from_slice(format!("{} cm\n", matrix(change, " ")).as_bytes());
                match halftone_dots {
                    Some(halftone_dots) => writer.lay(&halftone_dots, solid),
                    None => {
                        let tint = solid.map(|one| one * ink);
                        tint.into_iter().for_each(|ink| writer.value(Decimals::new(INK_DECIMALS), ink));
                        writer.operator(b"k");
                        writer.path_with(outline.elements(), b"f");
                    }
                }
            }
        });
        true
    }

    /// Paints the dots of an ink. Neighbours in a row are one line with round caps and zero-length dashes at
    /// distance one.
    fn lay(&mut self, dots: &BTreeMap<u8, Vec<(i32, i32)>>, solid: [f64; 4]) {
        solid.into_iter().for_each(|ink| self.value(Decimals::new(INK_DECIMALS), ink));
        self.operator(b"K");
        self.operator(b"1 J [0 1] 0 d");
        for (size, places) in dots {
            self.value(Decimals::new(INK_DECIMALS), diameter(share_of(*size)));
            self.operator(b"w");
            for places in places.chunks(DOTS_PER_PATH) {
                for run in places.chunk_by(|a, b| b.1 == a.1 && b.0 == a.0 + 1) {
                    let ([(x, y), ..], [.., (end, _)]) = (run, run) else { continue };
                    // Half a step more, so that the last dot is included.
                    let end = f64::from(*end) + 0.5;
                    self.out.extend_from_slice(format!("{x} {y} m {end} {y} l\n").as_bytes());
                }
                self.operator(b"S");
            }
        }
    }
}
