//! Pages of several drawings as PDF, for screens, presses and archives.
//!
//! ```
//! use ligne::drawing::{Composition, Drawing, Item, Page, Unit};
//! use ligne::export::{Inks, PdfOptions, to_pdf};
//! use ligne::kurbo::Affine;
//!
//! let page = Page { width: 80.0, height: 60.0, unit: Unit::Mm, background: None };
//! let drawing = Drawing::new("panel", page, Vec::new());
//! let item = Item { name: "panel-1".to_owned(), drawing, place: Affine::IDENTITY, clip: None };
//! let options = PdfOptions::default().with_inks(Inks::K).with_marks();
//! let bytes = to_pdf(&[Composition::new("a page", page, vec![item])], &options)?;
//! assert!(bytes.starts_with(b"%PDF"));
//! # Ok::<(), ligne::Error>(())
//! ```

use std::collections::BTreeSet;

use kurbo::Affine;
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::OverprintMode;
use pdf_writer::{Filter, Finish, Name, Pdf, Ref, TextStr};
use rayon::prelude::*;

use super::SvgOptions;
use super::number::Decimals;
use super::pdf::{CHUNK, DEFLATE_LEVEL, group_name};
use super::pdf_content::{Press, Writer, pattern_name, picture_name, spot_name, state_name};
use super::pdf_fonts::{Fonts, OBJECTS_PER_FONT, font_name};
use super::pdf_inks::{Ink, Plates, srgb_profile};
use super::pdf_options::{PdfOptions, Standard};
use super::pdf_paints::{write_gradient, write_picture};
use super::pdf_pictures::Crops;
use super::pdf_sheet::{ALL_INKS, Sheet};
use super::pdf_standard::{id, write_info, write_intent, xmp};
use super::pictures::matrix;
use crate::drawing::{Composition, Drawing, Gradient, Item, LayerKind, Mark, OutlinePaint, Paint, Unit};
use crate::error::Error;
use crate::math::colour::Colour;

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const INFO: Ref = Ref::new(3);
const RESOURCES: Ref = Ref::new(4);
const XMP: Ref = Ref::new(5);
const PROFILE: Ref = Ref::new(6);
const FIRST_FREE: i32 = 7;

/// Decimals of matrices.
const FINE: u8 = 6;

/// Pages of several drawings as one PDF file: a layer of the document for each drawing of a page, and within it for each of its own.
/// The same pages give the same bytes: no clock and no chance is in them.
///
/// # Errors
/// Returns an error if there is no page, one has no size or boxes that are not within each other, options contradict each other, a
/// profile is none or of another kind, or a standard wants a profile.
pub fn to_pdf(pages: &[Composition], options: &PdfOptions) -> Result<Vec<u8>, Error> {
    let Some(first) = pages.first() else {
        return Err(Error::new("a PDF without pages cannot be written").remedy("give a page"));
    };
    let plates = Plates::new(options)?;
    let profile = intent(&plates, options)?;
    let sheets: Vec<Sheet> =
        pages.iter().map(|page| Sheet::new(page, options.marks)).collect::<Result<_, _>>()?;
    let mut fonts = Fonts::default();
    if !options.outlined {
        drawings(pages)
            .flat_map(marks)
            .filter_map(|mark| mark.provenance.text.as_ref())
            .for_each(|run| fonts.note(run));
        fonts.cut();
    }
    let crops: Vec<Crops> = drawings(pages).map(Crops::of).collect();
    let press = Press { plates: &plates, fonts: Some(&fonts), first_picture: 0 };
    let mut document = Document::new(press);
    for (page, sheet) in pages.iter().zip(&sheets) {
        document.page(page, sheet, &crops, options.marks);
    }
    let streams: Vec<Vec<Vec<u8>>> = document
        .segments
        .iter()
        .map(|page| page.par_iter().map(|segment| segment.write(press)).collect())
        .collect();

    let mut next = FIRST_FREE;
    let mut take = |count: usize| -> Vec<Ref> {
        let first = next;
        next += i32::try_from(count).unwrap_or(i32::MAX - FIRST_FREE);
        (first..next).map(Ref::new).collect()
    };
    let page_ids = take(pages.len());
    let stream_ids: Vec<Vec<Ref>> = streams.iter().map(|page| take(page.len())).collect();
    let group_ids = take(document.groups.len());
    let states: Vec<(u8, bool)> = states(pages, &plates).into_iter().collect();
    let state_ids = take(states.len());
    let pictures: Vec<_> = crops.iter().flat_map(|crops| &crops.list).collect();
    let (picture_ids, mask_ids) = (take(pictures.len()), take(pictures.len()));
    let (pattern_ids, function_ids) = (take(document.gradients.len()), take(document.gradients.len()));
    let font_ids = take(fonts.list.len() * OBJECTS_PER_FONT);

    let mut pdf = Pdf::new();
    if options.standard == Some(Standard::X4) {
        pdf.set_version(1, 6);
    }
    let own_id = id(streams.iter().flatten().map(Vec::as_slice).chain([first.title.as_bytes()]));
    if options.standard.is_some() {
        pdf.set_file_id((own_id.to_vec(), own_id.to_vec()));
    }
    let mut catalog = pdf.catalog(CATALOG);
    catalog.pages(PAGES);
    if let Some(standard) = options.standard {
        catalog.metadata(XMP);
        if let Some((_, _, name)) = &profile {
            write_intent(&mut catalog, standard, name, PROFILE);
        }
    }
    document.write_layers(&mut catalog, &group_ids);
    catalog.finish();
    pdf.pages(PAGES).kids(page_ids.iter().copied()).count(i32::try_from(pages.len()).unwrap_or(i32::MAX));

    let is_clear = states.iter().any(|(opacity, _)| *opacity < 255);
    for ((sheet, id), streams) in sheets.iter().zip(&page_ids).zip(&stream_ids) {
        let mut page = pdf.page(*id);
        page.parent(PAGES).media_box(sheet.on_paper(sheet.media));
        if sheet.has_boxes || options.standard == Some(Standard::X4) {
            page.bleed_box(sheet.on_paper(sheet.bleed)).trim_box(sheet.on_paper(sheet.trim));
        }
        if sheet.user_unit > 1.0 {
            page.insert(Name(b"UserUnit")).primitive(sheet.user_unit as f32);
        }
        if is_clear {
            let mut group = page.group();
            group.transparency();
            if plates.is_press() {
                group.color_space().device_cmyk();
            } else {
                group.color_space().device_rgb();
            }
        }
        page.contents_array(streams.iter().copied());
        page.insert(Name(b"Resources")).primitive(RESOURCES);
    }

    let mut resources = pdf.indirect(RESOURCES).start::<pdf_writer::writers::Resources>();
    let named = |ids: &[Ref], name: fn(usize) -> String| -> Vec<(String, Ref)> {
        ids.iter().enumerate().map(|(number, id)| (name(number), *id)).collect()
    };
    let mut dict = resources.ext_g_states();
    for (state, id) in states.iter().zip(&state_ids) {
        dict.pair(Name(state_name(*state).as_bytes()), *id);
    }
    dict.finish();
    if options.marks || !plates.spots.is_empty() {
        let mut spaces = resources.color_spaces();
        if options.marks {
            let mut all = spaces
                .insert(Name(ALL_INKS.as_bytes()))
                .start::<pdf_writer::writers::ColorSpace>()
                .separation(Name(b"All"));
            all.alternate_color_space().device_gray();
            all.tint_exponential().domain([0.0, 1.0]).c0([1.0]).c1([0.0]).n(1.0);
        }
        for (number, spot) in plates.spots.iter().enumerate() {
            let space =
                spaces.insert(Name(spot_name(number).as_bytes())).start::<pdf_writer::writers::ColorSpace>();
            let mut ink = space.separation(Name(spot.name.as_bytes()));
            match plates.process(spot.colour) {
                Ink::Rgb(channels) => {
                    ink.alternate_color_space().device_rgb();
                    ink.tint_exponential()
                        .domain([0.0, 1.0])
                        .c0([1.0; 3])
                        .c1(channels.map(|x| x as f32))
                        .n(1.0);
                }
                _ => {
                    ink.alternate_color_space().device_cmyk();
                    let inks = plates.seen_as(spot.colour);
                    ink.tint_exponential().domain([0.0, 1.0]).c0([0.0; 4]).c1(inks.map(|x| x as f32)).n(1.0);
                }
            }
        }
        spaces.finish();
    }
    if !pattern_ids.is_empty() {
        let mut dict = resources.patterns();
        for (name, id) in named(&pattern_ids, pattern_name) {
            dict.pair(Name(name.as_bytes()), id);
        }
    }
    let mut dict = resources.insert(Name(b"Properties")).dict();
    for (name, id) in named(&group_ids, group_name) {
        dict.pair(Name(name.as_bytes()), id);
    }
    dict.finish();
    if !picture_ids.is_empty() {
        let mut dict = resources.x_objects();
        for (name, id) in named(&picture_ids, picture_name) {
            dict.pair(Name(name.as_bytes()), id);
        }
    }
    if !font_ids.is_empty() {
        let mut dict = resources.fonts();
        for (number, ids) in font_ids.chunks(OBJECTS_PER_FONT).enumerate() {
            if let Some(id) = ids.first() {
                dict.pair(Name(font_name(number).as_bytes()), *id);
            }
        }
    }
    resources.finish();

    for ((opacity, overprints), id) in states.iter().zip(&state_ids) {
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
    let colours = Some(&plates);
    for ((place, gradient), ids) in document.gradients.iter().zip(pattern_ids.iter().zip(&function_ids)) {
        write_gradient(&mut pdf, gradient, place.as_coeffs().map(|x| x as f32), [*ids.0, *ids.1], colours);
    }
    for (label, id) in document.groups.iter().zip(&group_ids) {
        let mut entry = pdf.indirect(*id).dict();
        entry.pair(Name(b"Type"), Name(b"OCG")).pair(Name(b"Name"), TextStr(&label.label));
    }
    for (stream, id) in streams.iter().flatten().zip(stream_ids.iter().flatten()) {
        pdf.stream(*id, stream).filter(Filter::FlateDecode);
    }
    for (picture, ids) in pictures.iter().zip(picture_ids.iter().zip(&mask_ids)) {
        write_picture(&mut pdf, picture, [*ids.0, *ids.1], colours);
    }
    fonts.write(&mut pdf, &font_ids);
    if let (Some(standard), Some((bytes, channels, _))) = (options.standard, &profile) {
        let packed = compress_to_vec_zlib(bytes, DEFLATE_LEVEL);
        let mut stream = pdf.icc_profile(PROFILE, &packed);
        stream.n(i32::try_from(*channels).unwrap_or(3)).filter(Filter::FlateDecode);
        stream.finish();
        pdf.metadata(XMP, &xmp(&first.title, options, standard, own_id));
    }
    let mut info = pdf.document_info(INFO);
    write_info(
        &mut info,
        if options.standard.is_some() && first.title.is_empty() { "untitled" } else { &first.title },
        options,
    );
    info.finish();
    Ok(pdf.finish())
}

/// What a file says it is made for: the bytes of the profile, its channels and its name; none if no standard wants to know.
fn intent(plates: &Plates, options: &PdfOptions) -> Result<Option<(Vec<u8>, usize, String)>, Error> {
    let Some(standard) = options.standard else { return Ok(None) };
    if let Some((bytes, channels, name)) = &plates.profile {
        return Ok(Some((bytes.to_vec(), *channels, name.clone())));
    }
    match standard {
        Standard::A2b if !plates.is_press() => Ok(srgb_profile().map(|bytes| (bytes, 3, "sRGB".to_owned()))),
        Standard::A2b => Err(Error::new("PDF/A with the inks of a press needs a profile")
            .remedy("give the ICC profile of the press")),
        Standard::X4 => {
            Err(Error::new("PDF/X-4 needs a profile").remedy("give the ICC profile of the press"))
        }
    }
}

/// All drawings of all pages.
fn drawings(pages: &[Composition]) -> impl Iterator<Item = &Drawing> {
    pages.iter().flat_map(|page| page.items.iter().map(|item| &item.drawing))
}

fn marks(drawing: &Drawing) -> impl Iterator<Item = &Mark> {
    drawing.layers.iter().flat_map(|layer| &layer.marks)
}

/// The opacities that are used, with inks below that stay or not.
fn states(pages: &[Composition], plates: &Plates) -> BTreeSet<(u8, bool)> {
    let state = |colour: Colour| (colour.a, plates.overprints(colour));
    let of_mark = |mark: &Mark| -> Vec<(u8, bool)> {
        match &mark.paint {
            Paint::Stroke(stroke) => vec![state(stroke.colour)],
            Paint::Gradient(gradient) => {
                vec![(gradient.stops.first().map_or(255, |(_, colour)| colour.a), false)]
            }
            Paint::Fill(colour) | Paint::Outline(OutlinePaint { colour, .. }) => vec![state(*colour)],
            Paint::Image(_) => Vec::new(),
        }
    };
    let paper = pages.iter().map(|page| &page.page).chain(drawings(pages).map(|drawing| &drawing.page));
    let paper = paper.filter_map(|page| page.background).map(state);
    // Pictures and marks of the printer are opaque.
    drawings(pages).flat_map(marks).flat_map(of_mark).chain(paper).chain([(255, false)]).collect()
}

/// A layer of the document.
struct Group {
    label: String,
    /// The page, and the layer it is within.
    page: usize,
    within: Option<usize>,
}

/// A stretch of the content of a page.
enum Segment<'a> {
    Raw(Vec<u8>),
    Marks {
        marks: &'a [Mark],
        crops: &'a Crops<'a>,
        first_picture: usize,
        first_pattern: usize,
        decimals: Decimals,
    },
}

impl Segment<'_> {
    /// The content, deflated.
    fn write(&self, press: Press) -> Vec<u8> {
        match self {
            Self::Raw(bytes) => compress_to_vec_zlib(bytes, DEFLATE_LEVEL),
            Self::Marks { marks, crops, first_picture, first_pattern, decimals } => {
                let press = Press { first_picture: *first_picture, ..press };
                let mut writer = Writer::new(*decimals, *first_pattern, Some(press));
                marks.iter().for_each(|mark| writer.mark(mark, crops));
                compress_to_vec_zlib(&writer.out, DEFLATE_LEVEL)
            }
        }
    }
}

/// What is gathered of the pages.
struct Document<'a> {
    press: Press<'a>,
    groups: Vec<Group>,
    /// Of each page.
    segments: Vec<Vec<Segment<'a>>>,
    titles: Vec<String>,
    /// Gradients, and from their units to those of the paper.
    gradients: Vec<(Affine, &'a Gradient)>,
    pictures: usize,
    drawings: usize,
}

impl<'a> Document<'a> {
    fn new(press: Press<'a>) -> Self {
        let (groups, segments, titles, gradients) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { press, groups, segments, titles, gradients, pictures: 0, drawings: 0 }
    }

    fn page(&mut self, page: &'a Composition, sheet: &Sheet, crops: &'a [Crops<'a>], marks: bool) {
        let fine = Decimals::new(FINE);
        let decimals = Decimals::new(SvgOptions::default().decimals(page.page.unit));
        self.segments.push(Vec::new());
        self.titles.push(page.title.clone());
        // Miters end where they do in SVG.
        let mut start = format!("q\n{} cm\n4 M\n", matrix(sheet.matrix(), " ")).into_bytes();
        if let Some(colour) = page.page.background {
            let mut writer = Writer::new(decimals, 0, Some(self.press));
            writer.set_state(colour);
            writer.set_fill(colour);
            let bleed = sheet.bleed;
            let sides =
                [bleed.x0, bleed.y0, bleed.width(), bleed.height()].map(|side| fine.text(side)).join(" ");
            writer.out.extend_from_slice(format!("{sides} re f\n").as_bytes());
            start.append(&mut writer.out);
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

    fn raw(&mut self, bytes: Vec<u8>) {
        if let Some(page) = self.segments.last_mut() {
            page.push(Segment::Raw(bytes));
        }
    }

    fn group(&mut self, label: &str, within: Option<usize>) -> usize {
        let page = self.segments.len().saturating_sub(1);
        self.groups.push(Group { label: label.to_owned(), page, within });
        self.groups.len() - 1
    }

    fn item(&mut self, item: &'a Item, sheet: &Sheet, crops: &'a [Crops<'a>], unit: Unit) {
        let drawing = &item.drawing;
        let Some(crops) = crops.get(self.drawings) else { return };
        let first_picture = self.pictures;
        self.drawings += 1;
        self.pictures += crops.list.len();
        let group = self.group(&item.name, None);
        let mut writer =
            Writer::new(Decimals::new(SvgOptions::default().decimals(unit)), 0, Some(self.press));
        writer.out.extend_from_slice(format!("/OC /{} BDC\nq\n", group_name(group)).as_bytes());
        if let Some(clip) = &item.clip {
            // Nothing is seen through a clip that is no path.
            if clip.elements().is_empty() {
                writer.out.extend_from_slice(b"0 0 m\n");
            }
            writer.path(clip.elements());
            writer.out.extend_from_slice(b"W n\n");
        }
        if item.place != Affine::IDENTITY {
            writer.out.extend_from_slice(format!("{} cm\n", matrix(item.place, " ")).as_bytes());
        }
        if let Some(colour) = drawing.page.background {
            let paper = self.group(LayerKind::Paper.id(), Some(group));
            writer.out.extend_from_slice(format!("/OC /{} BDC\n", group_name(paper)).as_bytes());
            writer.set_state(colour);
            writer.set_fill(colour);
            let fine = Decimals::new(FINE);
            let sides = [drawing.page.width, drawing.page.height].map(|side| fine.text(side)).join(" ");
            writer.out.extend_from_slice(format!("0 0 {sides} re f\nEMC\n").as_bytes());
        }
        self.raw(writer.out);
        // Where a drawing is enlarged its coordinates get more decimals.
        let larger = item.place.determinant().abs().sqrt();
        let more = [1.0, 10.0, 100.0].iter().filter(|step| larger > **step).count() as u8;
        let decimals = Decimals::new(SvgOptions::default().decimals(drawing.page.unit) + more);
        for layer in &drawing.layers {
            let inner = self.group(&drawing.names(layer).1, Some(group));
            self.raw(format!("/OC /{} BDC\n", group_name(inner)).into_bytes());
            for marks in layer.marks.chunks(CHUNK) {
                let first_pattern = self.gradients.len();
                let graded = marks.iter().filter_map(|mark| match &mark.paint {
                    Paint::Gradient(gradient) => Some((sheet.matrix() * item.place, gradient)),
                    _ => None,
                });
                self.gradients.extend(graded);
                if let Some(page) = self.segments.last_mut() {
                    page.push(Segment::Marks { marks, crops, first_picture, first_pattern, decimals });
                }
            }
            self.raw(b"EMC\n".to_vec());
        }
        self.raw(b"Q\nEMC\n".to_vec());
    }

    /// Lists the layers as programs show them: by page, the front ones first, those of a drawing under it.
    fn write_layers(&self, catalog: &mut pdf_writer::writers::Catalog, ids: &[Ref]) {
        if ids.is_empty() {
            return;
        }
        let mut properties = catalog.insert(Name(b"OCProperties")).dict();
        properties.insert(Name(b"OCGs")).array().items(ids.iter().copied());
        let mut shown = properties.insert(Name(b"D")).dict();
        shown.pair(Name(b"Name"), TextStr("layers"));
        let mut order = shown.insert(Name(b"Order")).array();
        let several = self.titles.len() > 1;
        for (number, title) in self.titles.iter().enumerate() {
            if several {
                let mut page = order.push().array();
                page.push().primitive(TextStr(title));
                self.write_page_layers(&mut page, number, ids);
            } else {
                self.write_page_layers(&mut order, number, ids);
            }
        }
    }

    fn write_page_layers(&self, list: &mut pdf_writer::Array, page: usize, ids: &[Ref]) {
        let own =
            || self.groups.iter().zip(ids).enumerate().filter(|(_, (group, _))| group.page == page).rev();
        for (number, (_, id)) in own().filter(|(_, (group, _))| group.within.is_none()) {
            list.push().primitive(*id);
            let inner: Vec<Ref> = own()
                .filter(|(_, (group, _))| group.within == Some(number))
                .map(|(_, (_, id))| *id)
                .collect();
            if !inner.is_empty() {
                list.push().array().items(inner);
            }
        }
    }
}
