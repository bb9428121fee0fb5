//! Gradients and pictures as PDF objects, in RGB or in press inks.

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::FunctionShadingType;
use pdf_writer::writers::ColorSpace;
use pdf_writer::{Filter, Finish, Pdf, Ref};

use super::pdf_streams::deflated;
use super::picture_crops::Crop;
use crate::colour::srgb::Colour;
use crate::drawing::Gradient;
use crate::export::pdf::press::ink_plates::{Plates, PressInk};

/// A slower level than for page content.
const PICTURE_DEFLATE_LEVEL: u8 = 8;

/// Number of channels of a colour.
fn channels(press: Option<&Plates>) -> usize {
    if press.is_some_and(Plates::is_press) { 4 } else { 3 }
}

/// Channels of a colour with eight bits each.
fn samples(colour: Colour, press: Option<&Plates>) -> Vec<u8> {
    match press.map(|plates| plates.process(colour)) {
        Some(PressInk::Cmyk(inks)) => inks.iter().map(|ink| (ink * 255.0).round() as u8).collect(),
        _ => vec![colour.r, colour.g, colour.b],
    }
}

fn space(space: ColorSpace, press: Option<&Plates>) {
    if press.is_some_and(Plates::is_press) {
        space.device_cmyk();
    } else {
        space.device_rgb();
    }
}

/// Writes a gradient as an axial shading with evenly sampled colours.
pub(crate) fn write_gradient(
    pdf: &mut Pdf,
    gradient: &Gradient,
    matrix: [f32; 6],
    [id, function]: [Ref; 2],
    press: Option<&Plates>,
) {
    let mut pattern = pdf.shading_pattern(id);
    pattern.matrix(matrix);
    let mut shading = pattern.function_shading();
    shading.shading_type(FunctionShadingType::Axial);
    space(shading.color_space(), press);
    let Gradient { start, end, .. } = gradient;
    shading.coords([start.x, start.y, end.x, end.y].map(|x| x as f32));
    shading.function(function).extend([true, true]);
    shading.finish();
    pattern.finish();
    let place = |k: usize| k as f64 / (GRADIENT_SAMPLES - 1) as f64;
    let shades: Vec<u8> = (0..GRADIENT_SAMPLES).flat_map(|k| samples(gradient.at(place(k)), press)).collect();
    let shades = deflated(&shades);
    let mut sampled = pdf.sampled_function(function, &shades);
    sampled.filter(Filter::FlateDecode);
    sampled.domain([0.0, 1.0]).range([0.0, 1.0].repeat(channels(press)));
    sampled.size([GRADIENT_SAMPLES as i32]).bits_per_sample(8);
    sampled.finish();
}

/// Number of samples of a gradient.
const GRADIENT_SAMPLES: usize = 128;

/// Writes a part of a picture as an image object, with a soft mask if it has transparent pixels.
pub(crate) fn write_picture(pdf: &mut Pdf, crop: &Crop, [id, mask]: [Ref; 2], press: Option<&Plates>) {
    let (width, height) = (crop.width as i32, crop.height as i32);
    let deflated = |samples: Vec<u8>| compress_to_vec_zlib(&samples, PICTURE_DEFLATE_LEVEL);
    let opacities = crop.samples(|pixel| [pixel.a]);
    let write_opacities = |pdf: &mut Pdf, id: Ref| {
        let samples = deflated(opacities.clone());
        let mut object = pdf.image_xobject(id, &samples);
        object.filter(Filter::FlateDecode);
        object.width(width).height(height).bits_per_component(8).color_space().device_gray();
    };
    if crop.is_mask {
        write_opacities(pdf, id);
        return;
    }
    let opaque = opacities.iter().all(|opacity| *opacity == 255);
    let colours = crop.samples(|pixel| [pixel]);
    let samples = deflated(colours.into_iter().flat_map(|colour| samples(colour, press)).collect());
    let mut object = pdf.image_xobject(id, &samples);
    object.filter(Filter::FlateDecode);
    object
        .width(width)
        .height(height)
        .bits_per_component(8)
        .interpolate(press.is_none_or(|plates| plates.smooths));
    space(object.color_space(), press);
    if opaque {
        return;
    }
    object.s_mask(mask);
    object.finish();
    write_opacities(pdf, mask);
}
