//! Resource dictionary of pages: graphics states, spot inks, gradients, layers, pictures and fonts.

use pdf_writer::types::OverprintMode;
use pdf_writer::writers::{ColorSpace, Resources};
use pdf_writer::{Finish, Name, Pdf, Ref};

use super::content_stream::{pattern_name, picture_name, spot_name, state_name};
use super::drawing_page::group_name;
use super::fonts::{OBJECTS_PER_FONT, font_name};
use super::page_boxes::ALL_INKS;
use crate::export::pdf::press::ink_plates::{Plates, PressInk};

/// Object numbers of the named resources.
pub(crate) struct ResourceIds<'a> {
    pub groups: &'a [Ref],
    pub patterns: &'a [Ref],
    pub pictures: &'a [Ref],
    pub fonts: &'a [Ref],
    /// Graphics states that set masks, with their names.
    pub masks: &'a [(&'a str, Ref)],
}

/// Writes the resource dictionary shared by all pages, and the graphics states for opacity and overprint.
pub(crate) fn write_resources(
    pdf: &mut Pdf,
    id: Ref,
    (plates, marks): (&Plates, bool),
    (states, state_ids): (&[(u8, bool)], &[Ref]),
    ids: &ResourceIds,
) {
    let mut resources = pdf.indirect(id).start::<Resources>();
    let named = |ids: &[Ref], name: fn(usize) -> String| -> Vec<(String, Ref)> {
        ids.iter().enumerate().map(|(number, id)| (name(number), *id)).collect()
    };
    let mut dict = resources.ext_g_states();
    for (state, id) in states.iter().zip(state_ids) {
        dict.pair(Name(state_name(*state).as_bytes()), *id);
    }
    for (name, id) in ids.masks {
        dict.pair(Name(name.as_bytes()), *id);
    }
    dict.finish();
    write_spaces(&mut resources, plates, marks);
    if !ids.patterns.is_empty() {
        let mut dict = resources.patterns();
        for (name, id) in named(ids.patterns, pattern_name) {
            dict.pair(Name(name.as_bytes()), id);
        }
    }
    let mut dict = resources.insert(Name(b"Properties")).dict();
    for (name, id) in named(ids.groups, group_name) {
        dict.pair(Name(name.as_bytes()), id);
    }
    dict.finish();
    if !ids.pictures.is_empty() {
        let mut dict = resources.x_objects();
        for (name, id) in named(ids.pictures, picture_name) {
            dict.pair(Name(name.as_bytes()), id);
        }
    }
    if !ids.fonts.is_empty() {
        let mut dict = resources.fonts();
        for (number, ids) in ids.fonts.chunks(OBJECTS_PER_FONT).enumerate() {
            if let Some(id) = ids.first() {
                dict.pair(Name(font_name(number).as_bytes()), *id);
            }
        }
    }
    resources.finish();

    for ((opacity, overprints), id) in states.iter().zip(state_ids) {
        let alpha = f32::from(*opacity) / 255.0;
        let mut state = pdf.ext_graphics(*id);
        state.stroking_alpha(alpha).non_stroking_alpha(alpha);
        if plates.is_press() {
            let mode = if *overprints {
                OverprintMode::IgnoreZeroChannel
            } else {
                OverprintMode::OverrideAllColorants
            };
            state.overprint(*overprints).overprint_fill(*overprints).overprint_mode(mode);
        }
    }
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
