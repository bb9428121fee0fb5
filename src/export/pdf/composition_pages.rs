//! PDF files of pages with several drawings, for screens, presses and archives.
//!
//! ```
//! use ligne::drawing::{Composition, Drawing, Page, PlacedDrawing, Unit};
//! use ligne::export::{Inks, PdfOptions, to_pdf};
//! use ligne::kurbo::Affine;
//!
//! let page = Page { width: 80.0, height: 60.0, unit: Unit::Mm, background: None };
//! let drawing = Drawing::new("panel", page, Vec::new());
//! let item = PlacedDrawing { name: "panel-1".to_owned(), drawing, place: Affine::IDENTITY, clip: None };
//! let options = PdfOptions::default().with_inks(Inks::K).with_marks();
//! let bytes = to_pdf(&[Composition::new("a page", page, vec![item])], &options)?;
//! assert!(bytes.starts_with(b"%PDF"));
//! # Ok::<(), ligne::Error>(())
//! ```

use std::collections::BTreeSet;

use crate::parallel::prelude::*;
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::{Filter, Finish, Name, Pdf, Ref, TextStr};

use super::content_stream::PressSettings;
use super::document_content::DocumentContent;
use super::drawing_page::DEFLATE_LEVEL;
use super::fonts::{Fonts, OBJECTS_PER_FONT};
use super::page_boxes::PrintedPage;
use super::paint_objects::{write_gradient, write_picture};
use super::picture_crops::Crops;
use super::resources::{ResourceIds, write_resources};
use super::soft_masks::SoftMask;
use crate::colour::srgb::Colour;
use crate::drawing::{Composition, Drawing, Mark, OutlinePaint, Paint};
use crate::error::Error;
use crate::export::pdf::press::halftone_screen::Screen;
use crate::export::pdf::press::ink_plates::{Plates, srgb_profile};
use crate::export::pdf::press::pdf_options::{Inks, PdfOptions, Standard};
use crate::export::pdf::press::standards::{id, write_info, write_intent, xmp};

/// Fixed object numbers.
const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const INFO: Ref = Ref::new(3);
const RESOURCES: Ref = Ref::new(4);
const XMP: Ref = Ref::new(5);
const PROFILE: Ref = Ref::new(6);
/// First object number that is assigned in order.
const FIRST_FREE: i32 = 7;

/// Writes pages of several drawings as one PDF file. Each drawing of a page is a layer, which contains the
/// drawing's own layers. The same pages give the same bytes, because neither the clock nor random numbers are
/// used.
///
/// # Errors
/// If there is no page, a page has no size, or its boxes are not nested. Also if options contradict each
/// other, a profile is invalid or of the wrong kind, or a standard lacks its profile.
pub fn to_pdf(pages: &[Composition], options: &PdfOptions) -> Result<Vec<u8>, Error> {
    let Some(first) = pages.first() else {
        return Err(Error::new("a PDF needs at least one page").remedy("give a page"));
    };
    let plates = Plates::new(options)?;
    let screen = screen(options)?;
    let profile = intent(&plates, options)?;
    let sheets: Vec<PrintedPage> =
        pages.iter().map(|page| PrintedPage::new(page, options.marks)).collect::<Result<_, _>>()?;
    let mut fonts = Fonts::default();
    if !options.outlined {
        drawings(pages)
            .flat_map(marks)
            .filter_map(|mark| mark.provenance.text.as_ref())
            .for_each(|run| fonts.note(run));
        fonts.cut();
    }
    let crops: Vec<Crops> = drawings(pages).map(Crops::of).collect();
    let press = PressSettings { plates: &plates, fonts: Some(&fonts), first_picture: 0, dots: None };
    let mut document = DocumentContent::new(press, screen);
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
    let first_pictures =
        crops.iter().scan(0, |sum, crops| Some(std::mem::replace(sum, *sum + crops.list.len())));
    let masks: Vec<SoftMask> = drawings(pages)
        .zip(&crops)
        .zip(first_pictures)
        .flat_map(|((drawing, crops), first)| SoftMask::all(drawing, crops, first))
        .collect();
    let (mask_state_ids, form_ids) = (take(masks.len()), take(masks.len()));

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

    let mask_states: Vec<(&str, Ref)> =
        masks.iter().zip(&mask_state_ids).map(|(mask, id)| (mask.name.as_str(), *id)).collect();
    let ids = ResourceIds {
        groups: &group_ids,
        patterns: &pattern_ids,
        pictures: &picture_ids,
        fonts: &font_ids,
        masks: &mask_states,
    };
    write_resources(&mut pdf, RESOURCES, (&plates, options.marks), (&states, &state_ids), &ids);
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
    for (mask, ids) in masks.iter().zip(mask_state_ids.iter().zip(&form_ids)) {
        mask.write(&mut pdf, [*ids.0, *ids.1], &picture_ids);
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

/// Output intent of the file: profile bytes, number of channels and name; `None` without a standard.
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

/// The halftone screen after validation.
fn screen(options: &PdfOptions) -> Result<Option<Screen>, Error> {
    let Some(screen) = options.screen else { return Ok(None) };
    if !(screen.lpi.is_finite() && (5.0..=200.0).contains(&screen.lpi) && screen.angle_deg.is_finite()) {
        return Err(Error::new(format!("a screen of {} lines per inch is not possible", screen.lpi))
            .remedy("give 5 to 200 lines per inch"));
    }
    if options.inks == Inks::Screen {
        return Err(Error::new("a screen needs the inks of a press").remedy("choose the inks k or cmyk"));
    }
    Ok(Some(screen))
}

/// All drawings of all pages.
fn drawings(pages: &[Composition]) -> impl Iterator<Item = &Drawing> {
    pages.iter().flat_map(|page| page.items.iter().map(|item| &item.drawing))
}

fn marks(drawing: &Drawing) -> impl Iterator<Item = &Mark> {
    drawing.layers.iter().flat_map(|layer| &layer.marks)
}

/// Opacities used, each with its overprint flag.
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
    // Pictures and printer's marks are opaque.
    drawings(pages)
        .flat_map(marks)
        .flat_map(of_mark)
        .chain(paper)
        .chain([(255, false), (255, plates.is_press())])
        .collect()
}
