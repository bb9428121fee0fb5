//! Soft masks: opacity of pictures with half-transparent pieces, so that overlapping pieces are not painted
//! twice.
//!
//! Source: ISO 32000-1, sections 11.5.3 (luminosity masks) and 11.6.5.

use pdf_writer::types::MaskType;
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref};

use super::content_stream::{ContentWriter, mask_name, picture_name};
use super::pdf_streams::deflated;
use super::picture_crops::Crops;
use crate::drawing::{Drawing, ImagePaint};
use crate::export::SvgOptions;
use crate::export::encoding::decimals::Decimals;

/// One mask of a drawing.
pub(crate) struct SoftMask<'a> {
    pub name: String,
    image: &'a ImagePaint,
    crops: &'a Crops<'a>,
    first_picture: usize,
    size: [f64; 2],
    decimals: Decimals,
}

impl<'a> SoftMask<'a> {
    /// Masks of a drawing in the order of their numbers.
    pub(crate) fn all(drawing: &Drawing, crops: &'a Crops<'a>, first_picture: usize) -> Vec<Self> {
        let decimals = Decimals::new(SvgOptions::default().decimals(drawing.page.unit) + 1);
        let size = [drawing.page.width, drawing.page.height];
        let of = |(number, image): (usize, &&'a ImagePaint)| Self {
            name: mask_name(first_picture, number),
            image,
            crops,
            first_picture,
            size,
            decimals,
        };
        crops.masked.iter().enumerate().map(of).collect()
    }

    /// Writes the graphics state and its form; `pictures` are the pictures of the whole document.
    pub(crate) fn write(&self, pdf: &mut Pdf, [state, form]: [Ref; 2], pictures: &[Ref]) {
        let mut writer = ContentWriter::new(self.decimals, 0, None);
        writer.opacities(self.image, self.crops, self.first_picture);
        let content = deflated(&writer.out);
        let mut object = pdf.form_xobject(form, &content);
        object.filter(Filter::FlateDecode);
        let [width, height] = self.size.map(|side| side as f32);
        object.bbox(Rect::new(0.0, 0.0, width, height));
        let mut group = object.group();
        group.transparency();
        group.color_space().device_gray();
        group.finish();
        let mut resources = object.resources();
        let mut named = resources.x_objects();
        let own = pictures.iter().enumerate().skip(self.first_picture).take(self.crops.list.len());
        for (number, id) in own {
            named.pair(Name(picture_name(number).as_bytes()), *id);
        }
        named.finish();
        resources.finish();
        object.finish();
        let mut state = pdf.ext_graphics(state);
        let mut mask = state.soft_mask();
        mask.subtype(MaskType::Luminosity).group(form);
    }
}
