//! Layers and content segments of all pages, collected before the file is written.

use kurbo::{Affine, Rect, Shape};
use pdf_writer::{Name, Ref, TextStr};

use super::content_stream::{ContentWriter, HalftoneDots, PressSettings, group_name};
use super::page_boxes::PrintedPage;
use super::pdf_streams::{MARKS_PER_STREAM, deflated};
use super::picture_crops::Crops;
use crate::colour::srgb::Colour;
use crate::drawing::{Composition, Gradient, LayerKind, Mark, Paint, PlacedDrawing, Provenance, Unit};
use crate::export::SvgOptions;
use crate::export::encoding::decimals::Decimals;
use crate::export::encoding::embedded_pictures::matrix;
use crate::export::pdf::press::halftone_screen::Screen;

/// Decimals of matrices.
const MATRIX_DECIMALS: u8 = 6;

/// A layer of the document.
pub(crate) struct DocumentLayer {
    pub label: String,
    /// Index of the page, and index of the enclosing layer.
    page: usize,
    within: Option<usize>,
}

/// A segment of the content of a page.
pub(crate) enum ContentSegment<'a> {
    Raw(Vec<u8>),
    Marks {
        dots: Option<HalftoneDots>,
        marks: &'a [Mark],
        crops: &'a Crops<'a>,
        first_picture: usize,
        first_pattern: usize,
        decimals: Decimals,
    },
}

impl ContentSegment<'_> {
    /// Writes the segment as deflated content.
    pub(crate) fn write(&self, press: PressSettings) -> Vec<u8> {
        match self {
            Self::Raw(bytes) => deflated(bytes),
            Self::Marks { dots, marks, crops, first_picture, first_pattern, decimals } => {
                let press = PressSettings { first_picture: *first_picture, dots: *dots, ..press };
                let mut writer = ContentWriter::new(*decimals, *first_pattern, Some(press));
                marks.iter().for_each(|mark| writer.mark(mark, crops));
                deflated(&writer.out)
            }
        }
    }
}

/// Collected content of all pages.
pub(crate) struct DocumentContent<'a> {
    press: PressSettings<'a>,
    screen: Option<Screen>,
    pub groups: Vec<DocumentLayer>,
    /// Segments of each page.
    pub segments: Vec<Vec<ContentSegment<'a>>>,
    pub titles: Vec<String>,
    /// Gradients, each with the transform from its units to the paper.
    pub gradients: Vec<(Affine, &'a Gradient)>,
    pictures: usize,
    drawings: usize,
}

impl<'a> DocumentContent<'a> {
    pub(crate) fn new(press: PressSettings<'a>, screen: Option<Screen>) -> Self {
        let (groups, segments, titles, gradients) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { press, screen, groups, segments, titles, gradients, pictures: 0, drawings: 0 }
    }

    /// Collects the content of a page; `crops` holds the pictures of all drawings of all pages.
    pub(crate) fn page(
        &mut self,
        page: &'a Composition,
        sheet: &PrintedPage,
        crops: &'a [Crops<'a>],
        marks: bool,
    ) {
        let decimals = Decimals::new(SvgOptions::default().decimals(page.page.unit));
        self.segments.push(Vec::new());
        self.titles.push(page.title.clone());
        // The miter limit of SVG.
        let mut start = format!("q\n{} cm\n4 M\n", matrix(sheet.matrix(), " ")).into_bytes();
        if let Some(colour) = page.page.background {
            let dots = self.dots(Affine::IDENTITY, sheet);
            start.append(&mut self.paper(sheet.bleed, colour, decimals, dots));
        }
        self.raw(start);
        for item in &page.items {
            self.item(item, sheet, crops, page.page.unit);
        }
        if marks {
            self.raw(sheet.paint_marks(Decimals::new(3)));
        }
        self.raw(b"Q\n".to_vec());
    }

    /// Halftone settings for a drawing at a place of the page.
    fn dots(&self, place: Affine, sheet: &PrintedPage) -> Option<HalftoneDots> {
        self.screen.map(|screen| HalftoneDots { screen, place, mm: sheet.mm })
    }

    /// Paints a rectangle of paper.
    fn paper(&self, rect: Rect, colour: Colour, decimals: Decimals, dots: Option<HalftoneDots>) -> Vec<u8> {
        let mut writer = ContentWriter::new(decimals, 0, Some(PressSettings { dots, ..self.press }));
        let (path, paint) = (rect.to_path(0.0), Paint::Fill(colour));
        writer.plain(&Mark { path, paint, provenance: Provenance::default() });
        writer.out
    }

    /// Adds raw content to the current page.
    fn raw(&mut self, bytes: Vec<u8>) {
        if let Some(page) = self.segments.last_mut() {
            page.push(ContentSegment::Raw(bytes));
        }
    }

    /// Adds a layer and returns its index.
    fn group(&mut self, label: &str, within: Option<usize>) -> usize {
        let page = self.segments.len().saturating_sub(1);
        self.groups.push(DocumentLayer { label: label.to_owned(), page, within });
        self.groups.len() - 1
    }

    /// Collects the content of one drawing of a page.
    fn item(&mut self, item: &'a PlacedDrawing, sheet: &PrintedPage, crops: &'a [Crops<'a>], unit: Unit) {
        let drawing = &item.drawing;
        let Some(crops) = crops.get(self.drawings) else { return };
        let first_picture = self.pictures;
        self.drawings += 1;
        self.pictures += crops.list.len();
        let group = self.group(&item.name, None);
        let mut writer =
            ContentWriter::new(Decimals::new(SvgOptions::default().decimals(unit)), 0, Some(self.press));
        writer.out.extend_from_slice(format!("/OC /{} BDC\nq\n", group_name(group)).as_bytes());
        if let Some(clip) = &item.clip {
            // An empty clip hides everything.
            if clip.elements().is_empty() {
                writer.out.extend_from_slice(b"0 0 m\n");
            }
            writer.path_with(clip.elements(), b"W n");
        }
        if item.place != Affine::IDENTITY {
            writer.out.extend_from_slice(format!("{} cm\n", matrix(item.place, " ")).as_bytes());
        }
        if let Some(colour) = drawing.page.background {
            let paper = self.group(LayerKind::Paper.id(), Some(group));
            writer.out.extend_from_slice(format!("/OC /{} BDC\n", group_name(paper)).as_bytes());
            let dots = self.dots(item.place, sheet);
            let whole = Rect::new(0.0, 0.0, drawing.page.width, drawing.page.height);
            writer.out.append(&mut self.paper(whole, colour, Decimals::new(MATRIX_DECIMALS), dots));
            writer.out.extend_from_slice(b"EMC\n");
        }
        self.raw(writer.out);
        // Coordinates of enlarged drawings get more decimals.
        let larger = item.place.determinant().abs().sqrt();
        let more = [1.0, 10.0, 100.0].iter().filter(|step| larger > **step).count() as u8;
        let decimals = Decimals::new(SvgOptions::default().decimals(drawing.page.unit) + more);
        let dots = self.dots(item.place, sheet);
        for layer in &drawing.layers {
            let inner = self.group(&drawing.names(layer).1, Some(group));
            self.raw(format!("/OC /{} BDC\n", group_name(inner)).into_bytes());
            for marks in layer.marks.chunks(MARKS_PER_STREAM) {
                let first_pattern = self.gradients.len();
                let graded = marks.iter().filter_map(|mark| match &mark.paint {
                    Paint::Gradient(gradient) => Some((sheet.matrix() * item.place, gradient)),
                    _ => None,
                });
                self.gradients.extend(graded);
                if let Some(page) = self.segments.last_mut() {
                    page.push(ContentSegment::Marks {
                        dots,
                        marks,
                        crops,
                        first_picture,
                        first_pattern,
                        decimals,
                    });
                }
            }
            self.raw(b"EMC\n".to_vec());
        }
        self.raw(b"Q\nEMC\n".to_vec());
    }
}

impl DocumentLayer {
    /// A layer of the only page.
    pub(crate) fn of_page(label: &str) -> Self {
        Self { label: label.to_owned(), page: 0, within: None }
    }
}

/// Writes the layer list: by page, front layers first, with the layers of a drawing below it. `titles` are those
/// of the pages.
pub(crate) fn write_layers(
    catalog: &mut pdf_writer::writers::Catalog,
    layers: &[DocumentLayer],
    titles: &[String],
    ids: &[Ref],
) {
    if ids.is_empty() {
        return;
    }
    let mut properties = catalog.insert(Name(b"OCProperties")).dict();
    properties.insert(Name(b"OCGs")).array().items(ids.iter().copied());
    let mut shown = properties.insert(Name(b"D")).dict();
    shown.pair(Name(b"Name"), TextStr("layers"));
    let mut order = shown.insert(Name(b"Order")).array();
    let several = titles.len() > 1;
    for (number, title) in titles.iter().enumerate() {
        if several {
            let mut page = order.push().array();
            page.push().primitive(TextStr(title));
            write_page_layers(&mut page, layers, number, ids);
        } else {
            write_page_layers(&mut order, layers, number, ids);
        }
    }
}

/// Writes the layers of one page, front layers first.
fn write_page_layers(list: &mut pdf_writer::Array, layers: &[DocumentLayer], page: usize, ids: &[Ref]) {
    let own = || layers.iter().zip(ids).enumerate().filter(|(_, (group, _))| group.page == page).rev();
    for (number, (_, id)) in own().filter(|(_, (group, _))| group.within.is_none()) {
        list.push().primitive(*id);
        let inner: Vec<Ref> =
            own().filter(|(_, (group, _))| group.within == Some(number)).map(|(_, (_, id))| *id).collect();
        if !inner.is_empty() {
            list.push().array().items(inner);
        }
    }
}
