//! [`SharedObjects`]: the objects that the pages of a file share, and the resource dictionary that names them.
//!
//! Shared are graphics states, spot inks, gradients, pictures, masks and fonts, and the layers of the document.

use std::collections::BTreeSet;

use kurbo::Affine;
use pdf_writer::types::OverprintMode;
use pdf_writer::writers::{ColorSpace, Resources};
use pdf_writer::{Filter, Finish, Name, Pdf, Ref, TextStr};

use super::content_stream::{group_name, pattern_name, picture_name, spot_name, state_name};
use super::fonts::{Fonts, OBJECTS_PER_FONT, font_name};
use super::page_boxes::ALL_INKS;
use super::paint_objects::{write_gradient, write_picture};
use super::picture_crops::{Crop, Crops};
use super::soft_masks::SoftMask;
use crate::colour::srgb::Colour;
use crate::drawing::{Drawing, Gradient, Mark, OutlinePaint, Paint};
use crate::export::pdf::press::ink_plates::{Plates, PressInk};

/// Object numbers that are assigned in order.
pub(crate) struct ObjectNumbers {
    next: i32,
}

impl ObjectNumbers {
    pub(crate) fn starting_at(next: i32) -> Self {
        Self { next }
    }

    pub(crate) fn take(&mut self, count: usize) -> Vec<Ref> {
        let first = self.next;
        self.next += i32::try_from(count).unwrap_or(i32::MAX - first);
        (first..self.next).map(Ref::new).collect()
    }

    /// Two numbers for each of some things: first one for all, then the other for all.
    fn take_pairs(&mut self, count: usize) -> Vec<[Ref; 2]> {
        let (first, second) = (self.take(count), self.take(count));
        first.into_iter().zip(second).map(|(first, second)| [first, second]).collect()
    }
}

/// Objects that the pages share, each with its object numbers.
pub(crate) struct SharedObjects<'a> {
    /// Inks of a press or a screen; `None` for RGB colours.
    plates: Option<&'a Plates>,
    /// Opacities and overprint flags.
    states: Vec<((u8, bool), Ref)>,
    /// Pictures, with the numbers of the picture and its mask.
    pictures: Vec<(&'a Crop<'a>, [Ref; 2])>,
    /// Gradients and their transforms to the paper, with the numbers of the pattern and its function. The matrix
    /// of a pattern is relative to the page, not to the current matrix of the content.
    gradients: Vec<((Affine, &'a Gradient), [Ref; 2])>,
    fonts: Option<&'a Fonts>,
    font_ids: Vec<Ref>,
    /// Masks, with the numbers of the graphics state and its form.
    masks: Vec<(SoftMask<'a>, [Ref; 2])>,
}

impl<'a> SharedObjects<'a> {
    /// Numbers the objects of drawings; `crops` are the pictures of each drawing.
    pub(crate) fn new(
        numbers: &mut ObjectNumbers,
        (drawings, crops): (impl Iterator<Item = &'a Drawing>, &'a [Crops<'a>]),
        states: BTreeSet<(u8, bool)>,
        gradients: Vec<(Affine, &'a Gradient)>,
        (plates, fonts): (Option<&'a Plates>, Option<&'a Fonts>),
    ) -> Self {
        let state_ids = numbers.take(states.len());
        let pictures: Vec<&Crop> = crops.iter().flat_map(|crops| &crops.list).collect();
        let picture_ids = numbers.take_pairs(pictures.len());
        let gradient_ids = numbers.take_pairs(gradients.len());
        let font_ids = numbers.take(fonts.map_or(0, |fonts| fonts.list.len()) * OBJECTS_PER_FONT);
        let first_pictures =
            crops.iter().scan(0, |sum, crops| Some(std::mem::replace(sum, *sum + crops.list.len())));
        let masks: Vec<SoftMask> = drawings
            .zip(crops)
            .zip(first_pictures)
            .flat_map(|((drawing, crops), first)| SoftMask::all(drawing, crops, first))
            .collect();
        let mask_ids = numbers.take_pairs(masks.len());
        Self {
            plates,
            states: states.into_iter().zip(state_ids).collect(),
            pictures: pictures.into_iter().zip(picture_ids).collect(),
            gradients: gradients.into_iter().zip(gradient_ids).collect(),
            fonts,
            font_ids,
            masks: masks.into_iter().zip(mask_ids).collect(),
        }
    }

    /// Whether a mark or a paper is not opaque.
    pub(crate) fn is_clear(&self) -> bool {
        self.states.iter().any(|((opacity, _), _)| *opacity < 255)
    }

    /// Writes the resource dictionary of pages with these layers; `marks` for printer's marks.
    pub(crate) fn write_dictionary(&self, mut resources: Resources, groups: &[Ref], marks: bool) {
        let mut dict = resources.ext_g_states();
        for (state, id) in &self.states {
            dict.pair(Name(state_name(*state).as_bytes()), *id);
        }
        for (mask, [id, _]) in &self.masks {
            dict.pair(Name(mask.name.as_bytes()), *id);
        }
        dict.finish();
        if let Some(plates) = self.plates {
            write_spaces(&mut resources, plates, marks);
        }
        if !self.gradients.is_empty() {
            let mut dict = resources.patterns();
            for (number, (_, [id, _])) in self.gradients.iter().enumerate() {
                dict.pair(Name(pattern_name(number).as_bytes()), *id);
            }
        }
        let mut dict = resources.insert(Name(b"Properties")).dict();
        for (number, id) in groups.iter().enumerate() {
            dict.pair(Name(group_name(number).as_bytes()), *id);
        }
        dict.finish();
        if !self.pictures.is_empty() {
            let mut dict = resources.x_objects();
            for (number, (_, [id, _])) in self.pictures.iter().enumerate() {
                dict.pair(Name(picture_name(number).as_bytes()), *id);
            }
        }
        if !self.font_ids.is_empty() {
            let mut dict = resources.fonts();
            for (number, ids) in self.font_ids.chunks(OBJECTS_PER_FONT).enumerate() {
                if let Some(id) = ids.first() {
                    dict.pair(Name(font_name(number).as_bytes()), *id);
                }
            }
        }
    }

    /// Writes the objects, the names of the layers, and the compressed content of the pages.
    pub(crate) fn write<'b>(
        &self,
        pdf: &mut Pdf,
        layers: impl Iterator<Item = (&'b str, &'b Ref)>,
        streams: impl Iterator<Item = (&'b Vec<u8>, &'b Ref)>,
    ) {
        for ((opacity, overprints), id) in &self.states {
            let alpha = f32::from(*opacity) / 255.0;
            let mut state = pdf.ext_graphics(*id);
            state.stroking_alpha(alpha).non_stroking_alpha(alpha);
            if self.plates.is_some_and(Plates::is_press) {
                let mode = if *overprints {
                    OverprintMode::IgnoreZeroChannel
                } else {
                    OverprintMode::OverrideAllColorants
                };
                state.overprint(*overprints).overprint_fill(*overprints).overprint_mode(mode);
            }
        }
        for ((place, gradient), ids) in &self.gradients {
            write_gradient(pdf, gradient, place.as_coeffs().map(|x| x as f32), *ids, self.plates);
        }
        for (label, id) in layers {
            let mut entry = pdf.indirect(*id).dict();
            entry.pair(Name(b"Type"), Name(b"OCG")).pair(Name(b"Name"), TextStr(label));
        }
        for (stream, id) in streams {
            pdf.stream(*id, stream).filter(Filter::FlateDecode);
        }
        for (picture, ids) in &self.pictures {
            write_picture(pdf, picture, *ids, self.plates);
        }
        let picture_ids: Vec<Ref> = self.pictures.iter().map(|(_, [id, _])| *id).collect();
        for (mask, ids) in &self.masks {
            mask.write(pdf, *ids, &picture_ids);
        }
        if let Some(fonts) = self.fonts {
            fonts.write(pdf, &self.font_ids);
        }
    }
}

/// Opacities of the marks and papers of drawings, 0 to 255, each with its overprint flag.
pub(crate) fn states<'a>(
    drawings: impl Iterator<Item = &'a Drawing>,
    overprints: impl Fn(Colour) -> bool,
) -> BTreeSet<(u8, bool)> {
    let state = |colour: Colour| (colour.a, overprints(colour));
    let of_mark = |mark: &Mark| match &mark.paint {
        Paint::Stroke(stroke) => state(stroke.colour),
        Paint::Gradient(gradient) => (gradient.stops.first().map_or(255, |(_, colour)| colour.a), false),
        Paint::Fill(colour) | Paint::Outline(OutlinePaint { colour, .. }) => state(*colour),
        Paint::Image(_) => (255, false),
    };
    let of_drawing = |drawing: &'a Drawing| {
        let marks = drawing.layers.iter().flat_map(|layer| &layer.marks).map(&of_mark);
        marks.chain(drawing.page.background.map(&state)).collect::<Vec<_>>()
    };
    drawings.flat_map(of_drawing).collect()
}

/// Writes the colour spaces: `All` for printer's marks, and one for each spot ink.
fn write_spaces(resources: &mut Resources, plates: &Plates, marks: bool) {
    if marks || !plates.spots.is_empty() {
        let mut spaces = resources.color_spaces();
        if marks {
            let mut all =
                spaces.insert(Name(ALL_INKS.as_bytes())).start::<ColorSpace>().separation(Name(b"All"));
            all.alternate_color_space().device_gray();
            all.tint_exponential().domain([0.0, 1.0]).c0([1.0]).c1([0.0]).n(1.0);
        }
        for (number, spot) in plates.spots.iter().enumerate() {
            let space = spaces.insert(Name(spot_name(number).as_bytes())).start::<ColorSpace>();
            let mut ink = space.separation(Name(spot.name.as_bytes()));
            match plates.process(spot.colour) {
                PressInk::Rgb(channels) => {
                    ink.alternate_color_space().device_rgb();
                    ink.tint_exponential()
                        .domain([0.0, 1.0])
                        .c0([1.0; 3])
                        .c1(channels.map(|x| x as f32))
                        .n(1.0);
                }
                _ => {
                    ink.alternate_color_space().device_cmyk();
                    let inks = plates.process_equivalent(spot.colour);
                    ink.tint_exponential().domain([0.0, 1.0]).c0([0.0; 4]).c1(inks.map(|x| x as f32)).n(1.0);
                }
            }
        }
        spaces.finish();
    }
}
