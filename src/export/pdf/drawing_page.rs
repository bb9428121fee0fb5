//! A drawing as PDF: one page of vectors, with an optional-content layer for each layer of the drawing.
//!
//! Source: ISO 32000-1 (PDF 1.7), section 8.11 (optional content, which viewers show as layers). Coordinates
//! stay in user units with y down, under one matrix.

use std::iter;

use crate::parallel::prelude::*;
use kurbo::Affine;
use pdf_writer::{Finish, Name, Pdf, Rect, Ref};

use super::content_stream::{ContentWriter, group_name};
use super::document_content::{DocumentLayer, write_layers};
use super::pdf_streams::{MARKS_PER_STREAM, MAX_SIDE_POINTS, POINTS_PER_MM, POINTS_PER_PX, deflated};
use super::picture_crops::Crops;
use super::resources::{ObjectNumbers, SharedObjects, states};
use crate::drawing::{Drawing, Gradient, LayerKind, Mark, Paint, Unit};
use crate::export::SvgOptions;
use crate::export::encoding::decimals::Decimals;
use crate::export::pdf::press::pdf_options::PdfOptions;
use crate::export::pdf::press::standards::write_info;

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
        let crops = [Crops::of(self)];
        let streams = self.streams(&groups, &crops[0], scale);
        let mut numbers = ObjectNumbers::starting_at(FIRST_FREE);
        let (group_ids, stream_ids) = (numbers.take(groups.len()), numbers.take(streams.len()));
        let states = states(iter::once(self), |_| false);
        let place = Affine::new([scale, 0.0, 0.0, -scale, 0.0, self.page.height * scale]);
        let gradients = self.gradients().into_iter().map(|gradient| (place, gradient)).collect();
        let drawings = (iter::once(self), crops.as_slice());
        let objects = SharedObjects::new(&mut numbers, drawings, states, gradients, (None, None));

        let mut pdf = Pdf::new();
        let mut catalog = pdf.catalog(CATALOG);
        catalog.pages(PAGES);
        let layers: Vec<DocumentLayer> =
            groups.iter().map(|group| DocumentLayer::of_page(&group.label)).collect();
        write_layers(&mut catalog, &layers, &[String::new()], &group_ids);
        catalog.finish();
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
        objects.write_dictionary(page.resources(), &group_ids, false);
        page.finish();
        let labels = groups.iter().map(|group| group.label.as_str());
        objects.write(&mut pdf, labels.zip(&group_ids), streams.iter().zip(&stream_ids));
        let mut info = pdf.document_info(INFO);
        write_info(&mut info, &self.title, &PdfOptions::default());
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
                deflated(&writer.out)
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
}
