//! A drawing as PDF: one page of vectors, with an optional-content layer for each layer of the drawing.
//!
//! Source: ISO 32000-1 (PDF 1.7), section 8.11 (optional content, which viewers show as layers). Coordinates
//! stay in user units with y down, under one matrix.

use std::collections::BTreeSet;

use crate::parallel::prelude::*;
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, TextStr};

use super::content_stream::{ContentWriter, pattern_name, picture_name, state_name};
use super::paint_objects::{write_gradient, write_picture};
use super::picture_crops::Crops;
use super::soft_masks::SoftMask;
use crate::drawing::{Drawing, Gradient, LayerKind, Mark, OutlinePaint, Paint, Unit};
use crate::export::SvgOptions;
use crate::export::encoding::decimals::Decimals;

/// Points (1/72 inch) per px.
pub(crate) const POINTS_PER_PX: f64 = 0.75;
/// Points per millimetre.
pub(crate) const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// Longest side of a page that all viewers show, in points.
pub(crate) const MAX_SIDE_POINTS: f64 = 14_400.0;

/// Marks per stream. A fixed number, so that the bytes do not depend on the number of threads.
pub(crate) const MARKS_PER_STREAM: usize = 2048;

/// Compression level of zlib, 0 to 10. This fast level makes files at most a tenth larger than the slowest.
pub(crate) const DEFLATE_LEVEL: u8 = 4;

/// Fixed object numbers.
const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const INFO: Ref = Ref::new(4);
/// First object number that is assigned in order.
const FIRST_FREE: i32 = 5;

/// A layer of the document and its marks.
struct PageLayer<'a> {
    label: String,
    marks: &'a [Mark],
}

impl Drawing {
    /// Writes the drawing as a PDF file of one page of the same size; a px is 1/96 inch. The same drawing
    /// gives the same bytes, because neither dates nor random numbers are written.
    ///
    /// Pages longer than 200 inches use a larger unit of user space.
    #[must_use]
    pub fn to_pdf(&self) -> Vec<u8> {
        let per_unit = match self.page.unit {
            Unit::Px => POINTS_PER_PX,
            Unit::Mm => POINTS_PER_MM,
        };
        let longest = self.page.width.max(self.page.height) * per_unit;
        let user_unit = (longest / MAX_SIDE_POINTS).max(1.0);
        let scale = per_unit / user_unit;
        let groups = self.groups();
        let pictures = Crops::of(self);
        let streams = self.streams(&groups, &pictures, scale);

        let mut next = FIRST_FREE;
        let mut take = |count: usize| -> Vec<Ref> {
            let first = next;
            next += count as i32;
            (first..next).map(Ref::new).collect()
        };
        let (group_ids, stream_ids) = (take(groups.len()), take(streams.len()));
        let opacities = self.opacities();
        let state_ids = take(opacities.len());
        let (picture_ids, mask_ids) = (take(pictures.list.len()), take(pictures.list.len()));
        let gradients = self.gradients();
        let (pattern_ids, function_ids) = (take(gradients.len()), take(gradients.len()));
        let masks = SoftMask::all(self, &pictures, 0);
        let (mask_state_ids, form_ids) = (take(masks.len()), take(masks.len()));

        let mut pdf = Pdf::new();
        write_catalog(&mut pdf, &group_ids);
        pdf.pages(PAGES).kids([PAGE]).count(1);
        let mut page = pdf.page(PAGE);
        page.parent(PAGES);
        page.media_box(Rect::new(
            0.0,
            0.0,
            (self.page.width * scale) as f32,
            (self.page.height * scale) as f32,
        ));
        if user_unit > 1.0 {
            page.insert(Name(b"UserUnit")).primitive(user_unit as f32);
        }
        page.contents_array(stream_ids.iter().copied());
        let mut resources = page.resources();
        let mut states = resources.ext_g_states();
        for (opacity, id) in opacities.iter().zip(&state_ids) {
            states.pair(Name(state_name((*opacity, false)).as_bytes()), *id);
        }
        for (mask, id) in masks.iter().zip(&mask_state_ids) {
            states.pair(Name(mask.name.as_bytes()), *id);
        }
        states.finish();
        if !gradients.is_empty() {
            let mut patterns = resources.patterns();
            for (number, id) in pattern_ids.iter().enumerate() {
                patterns.pair(Name(pattern_name(number).as_bytes()), *id);
            }
            patterns.finish();
        }
        let mut properties = resources.insert(Name(b"Properties")).dict();
        for (index, id) in group_ids.iter().enumerate() {
            properties.pair(Name(group_name(index).as_bytes()), *id);
        }
        properties.finish();
        if !picture_ids.is_empty() {
            let mut objects = resources.x_objects();
            for (number, id) in picture_ids.iter().enumerate() {
                objects.pair(Name(picture_name(number).as_bytes()), *id);
            }
            objects.finish();
        }
        resources.finish();
        page.finish();

        for (opacity, id) in opacities.iter().zip(&state_ids) {
            let alpha = f32::from(*opacity) / 255.0;
            pdf.ext_graphics(*id).stroking_alpha(alpha).non_stroking_alpha(alpha);
        }
        for ((gradient, id), function) in gradients.iter().zip(&pattern_ids).zip(&function_ids) {
            // The matrix of a pattern is relative to the page, not to the current matrix of the content.
            let matrix = [scale, 0.0, 0.0, -scale, 0.0, self.page.height * scale].map(|x| x as f32);
            write_gradient(&mut pdf, gradient, matrix, [*id, *function], None);
        }
        for (group, id) in groups.iter().zip(&group_ids) {
            let mut entry = pdf.indirect(*id).dict();
            entry.pair(Name(b"Type"), Name(b"OCG")).pair(Name(b"Name"), TextStr(&group.label));
        }
        for (stream, id) in streams.iter().zip(&stream_ids) {
            pdf.stream(*id, stream).filter(Filter::FlateDecode);
        }
        for (picture, (id, mask)) in pictures.list.iter().zip(picture_ids.iter().zip(&mask_ids)) {
            write_picture(&mut pdf, picture, [*id, *mask], None);
        }
        for (mask, (state, form)) in masks.iter().zip(mask_state_ids.iter().zip(&form_ids)) {
            mask.write(&mut pdf, [*state, *form], &picture_ids);
        }
        let mut info = pdf.document_info(INFO);
        if !self.title.is_empty() {
            info.title(TextStr(&self.title));
        }
        info.creator(TextStr(concat!("ligne ", env!("CARGO_PKG_VERSION"))));
        info.finish();
        pdf.finish()
    }

    /// Layers of the document, back to front, with the paper first.
    fn groups(&self) -> Vec<PageLayer<'_>> {
        let paper =
            self.page.background.map(|_| PageLayer { label: LayerKind::Paper.id().to_owned(), marks: &[] });
        let layers =
            self.layers.iter().map(|layer| PageLayer { label: self.names(layer).1, marks: &layer.marks });
        paper.into_iter().chain(layers).collect()
    }

    /// The page's content as consecutive compressed streams, written in parallel.
    fn streams(&self, groups: &[PageLayer], pictures: &Crops, scale: f64) -> Vec<Vec<u8>> {
        let decimals = Decimals::new(SvgOptions::default().decimals(self.page.unit));
        let fine = Decimals::new(6);
        let pieces: Vec<(usize, &[Mark], bool, bool)> = groups
            .iter()
            .enumerate()
            .flat_map(|(index, group)| {
                let count = group.marks.len().div_ceil(MARKS_PER_STREAM).max(1);
                let mut chunks = group.marks.chunks(MARKS_PER_STREAM);
                (0..count).map(move |k| (index, chunks.next().unwrap_or_default(), k == 0, k + 1 == count))
            })
            .collect();
        let last = pieces.len().saturating_sub(1);
        // Number of gradients before each piece.
        let graded =
            |marks: &[Mark]| marks.iter().filter(|mark| matches!(mark.paint, Paint::Gradient(_))).count();
        let before: Vec<usize> = pieces
            .iter()
            .scan(0, |sum, (_, marks, ..)| Some(std::mem::replace(sum, *sum + graded(marks))))
            .collect();
        pieces
            .par_iter()
            .zip(&before)
            .enumerate()
            .map(|(at, ((index, marks, opens, closes), before))| {
                let mut writer = ContentWriter::new(decimals, *before, None);
                if at == 0 {
                    let top = fine.text(self.page.height * scale);
                    let scale = fine.text(scale);
                    // The miter limit of SVG.
                    let matrix = format!("q {scale} 0 0 -{scale} 0 {top} cm 4 M\n");
                    writer.out.extend_from_slice(matrix.as_bytes());
                }
                if *opens {
                    let begin = format!("/OC /{} BDC\n", group_name(*index));
                    writer.out.extend_from_slice(begin.as_bytes());
                }
                if let (0, Some(colour)) = (at, self.page.background) {
                    writer.set_state(colour);
                    writer.set_fill(colour);
                    let (width, height) = (fine.text(self.page.width), fine.text(self.page.height));
                    writer.out.extend_from_slice(format!("0 0 {width} {height} re f\n").as_bytes());
                }
                marks.iter().for_each(|mark| writer.mark(mark, pictures));
                if *closes {
                    writer.out.extend_from_slice(b"EMC\n");
                }
                if at == last {
                    writer.out.extend_from_slice(b"Q\n");
                }
                compress_to_vec_zlib(&writer.out, DEFLATE_LEVEL)
            })
            .collect()
    }

    /// Gradients of all marks.
    pub(crate) fn gradients<'a>(&'a self) -> Vec<&'a Gradient> {
        let marks = self.layers.iter().flat_map(|layer| &layer.marks);
        // Marks without a path are not painted, but their gradients are counted.
        let of = |mark: &'a Mark| match &mark.paint {
            Paint::Gradient(gradient) => Some(gradient),
            _ => None,
        };
        marks.filter_map(of).collect()
    }

    /// All opacities in use, 0 to 255. Each needs a graphics state.
    fn opacities(&self) -> BTreeSet<u8> {
        let marks = self.layers.iter().flat_map(|layer| &layer.marks);
        let of_marks = marks.map(|mark| match &mark.paint {
            Paint::Stroke(stroke) => stroke.colour.a,
            Paint::Gradient(gradient) => gradient.stops.first().map_or(255, |(_, colour)| colour.a),
            Paint::Fill(colour) | Paint::Outline(OutlinePaint { colour, .. }) => colour.a,
            Paint::Image(_) => 255,
        });
        of_marks.chain(self.page.background.map(|colour| colour.a)).collect()
    }
}

/// Writes the document catalog with the pages and the layers. Layers are listed from front to back, as in
/// drawing programs.
fn write_catalog(pdf: &mut Pdf, groups: &[Ref]) {
    let mut catalog = pdf.catalog(CATALOG);
    catalog.pages(PAGES);
    if groups.is_empty() {
        return;
    }
    let mut properties = catalog.insert(Name(b"OCProperties")).dict();
    properties.insert(Name(b"OCGs")).array().items(groups.iter().copied());
    let mut shown = properties.insert(Name(b"D")).dict();
    shown.pair(Name(b"Name"), TextStr("layers"));
    shown.insert(Name(b"Order")).array().items(groups.iter().rev().copied());
}

/// Name of a layer in the page's resources.
pub(crate) fn group_name(index: usize) -> String {
    format!("L{index}")
}
