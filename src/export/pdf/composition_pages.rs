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
use pdf_writer::{Filter, Finish, Name, Pdf, Ref};

use super::content_stream::PressSettings;
use super::document_content::{DocumentContent, write_layers};
use super::fonts::Fonts;
use super::page_boxes::PrintedPage;
use super::pdf_streams::deflated;
use super::picture_crops::Crops;
use super::resources::{ObjectNumbers, SharedObjects, states};
use crate::drawing::{Composition, Drawing, Mark};
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

    let mut numbers = ObjectNumbers::starting_at(FIRST_FREE);
    let page_ids = numbers.take(pages.len());
    let stream_ids: Vec<Vec<Ref>> = streams.iter().map(|page| numbers.take(page.len())).collect();
    let group_ids = numbers.take(document.groups.len());
    let gradients = std::mem::take(&mut document.gradients);
    let objects = SharedObjects::new(
        &mut numbers,
        (drawings(pages), &crops),
        all_states(pages, &plates),
        gradients,
        (Some(&plates), Some(&fonts)),
    );

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
    write_layers(&mut catalog, &document.groups, &document.titles, &group_ids);
    catalog.finish();
    pdf.pages(PAGES).kids(page_ids.iter().copied()).count(i32::try_from(pages.len()).unwrap_or(i32::MAX));

    let is_clear = objects.is_clear();
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

    objects.write_dictionary(pdf.indirect(RESOURCES).start(), &group_ids, options.marks);
    let labels = document.groups.iter().map(|layer| layer.label.as_str());
    let contents = streams.iter().flatten().zip(stream_ids.iter().flatten());
    objects.write(&mut pdf, labels.zip(&group_ids), contents);
    if let (Some(standard), Some((bytes, channels, _))) = (options.standard, &profile) {
        let packed = deflated(bytes);
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

/// Opacities used, each with its overprint flag. Pictures and printer's marks are opaque.
fn all_states(pages: &[Composition], plates: &Plates) -> BTreeSet<(u8, bool)> {
    let overprints = |colour| plates.overprints(colour);
    let papers = pages.iter().filter_map(|page| page.page.background);
    let papers = papers.map(|colour| (colour.a, overprints(colour)));
    let of_drawings = states(drawings(pages), overprints).into_iter();
    of_drawings.chain(papers).chain([(255, false), (255, plates.is_press())]).collect()
}
