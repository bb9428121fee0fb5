//! Pages for printing: two views with a balloon, and the comic page of the examples, with several inks and
//! standards.
//!
//! `cargo run --example print -- FOLDER [PROFILE.icc]`: CMYK and PDF/X-4 need the ICC profile of a press.

use std::path::PathBuf;
use std::sync::Arc;

use ligne::drawing::{
    Cap, Composition, Drawing, Join, Layer, LayerKind, Mark, Page, Paint, PlacedDrawing, PrintBoxes,
    Provenance, StrokePaint,
};
use ligne::export::{Inks, PdfOptions, PngOptions, Resolution, Standard, SvgOptions, to_pdf};
use ligne::kurbo::{Affine, Ellipse, Point, Rect, Shape};
use ligne::page::PageFile;
use ligne::text::{Font, Setting, TextBlock};
use ligne::{Camera, Colour, Error, Scene, Style, render};

const RED: Colour = Colour::rgb(228, 0, 43);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1);
    let folder = PathBuf::from(args.next().unwrap_or_else(|| ".".to_owned()));
    let profile: Option<Arc<[u8]>> = args.next().map(std::fs::read).transpose()?.map(Arc::from);
    let pages = [
        page("A page", "Stop! The gears are loose again, and nobody has told the engineer.")?,
        page("Another", "Phew…")?,
    ];
    let save =
        |name: &str, pages: &[Composition], options: &PdfOptions| -> Result<(), Box<dyn std::error::Error>> {
            std::fs::write(folder.join(name), to_pdf(pages, options)?)?;
            Ok(())
        };
    let write = |name: &str, options: &PdfOptions| save(name, &pages, options);
    let composed = PageFile::open("examples/pages/comic.toml")?.compose()?;
    let comic: Vec<Composition> = composed.into_iter().map(|page| page.composition).collect();
    for page in &comic {
        std::fs::write(folder.join("comic.svg"), page.to_svg(&SvgOptions::default()))?;
        std::fs::write(
            folder.join("comic.png"),
            page.to_png(&PngOptions::of_resolution(Resolution::Dpi(96.0)))?,
        )?;
    }
    let plain = PdfOptions::default();
    write("screen.pdf", &plain)?;
    let archive = plain.clone().with_standard(Standard::A2b);
    write("archive.pdf", &archive)?;
    save("comic-archive.pdf", &comic, &archive)?;
    let black = plain.clone().with_inks(Inks::K).with_marks();
    save("comic-k.pdf", &comic, &black)?;
    write("k.pdf", &black)?;
    write("spot.pdf", &black.clone().with_spot(RED, "PANTONE 185 C"))?;
    write("outlined.pdf", &black.clone().outlined())?;
    write("dots.pdf", &black.clone().with_screen(45.0, 45.0))?;
    if let Some(profile) = profile {
        write("x4-k.pdf", &black.with_profile(Arc::clone(&profile)).with_standard(Standard::X4))?;
        let four = plain.with_inks(Inks::Cmyk(profile)).with_ink_limit(240.0).with_marks();
        write("x4.pdf", &four.clone().with_standard(Standard::X4).with_spot(RED, "PANTONE 185 C"))?;
        write("cmyk.pdf", &four)?;
        let sound = Colour::rgb(232, 65, 47);
        let press = four.clone().with_standard(Standard::X4).with_spot(sound, "PANTONE 185 C");
        save("comic-x4.pdf", &comic, &press)?;
        save("comic-dots.pdf", &comic, &four.clone().with_screen(60.0, 45.0))?;
        write("cmyk-dots.pdf", &four.with_screen(45.0, 45.0))?;
    }
    Ok(())
}

/// Page of 120 x 80 mm with 3 mm of bleed: two framed views of a gear, and a balloon.
fn page(title: &str, words: &str) -> Result<Composition, Error> {
    let scene = Scene::open("examples/models/gear.obj")?;
    let (width, height, bleed) = (120.0, 80.0, 3.0);
    let whole = Rect::new(0.0, 0.0, width + 2.0 * bleed, height + 2.0 * bleed);
    let trim = whole.inset(-bleed);
    let sheet =
        Page { background: Some(Colour::rgb(255, 246, 214)), ..Page::mm(whole.width(), whole.height()) };
    let mut items = Vec::new();
    for (number, style) in ["toon", "ink"].into_iter().enumerate() {
        let camera = Camera::three_quarter().fit(&scene);
        let drawing = render(&scene, &camera, &Style::load(style)?)?;
        let frame = Rect::new(8.0, 8.0, 62.0, 78.0) + ligne::kurbo::Vec2::new(56.0 * number as f64, 0.0);
        // The drawing is slightly larger than its frame.
        let scale = frame.height() / drawing.page.height * 1.2;
        let middle = Affine::translate((-drawing.page.width / 2.0, -drawing.page.height / 2.0));
        let place = Affine::translate(frame.center().to_vec2()) * Affine::scale(scale) * middle;
        items.push(PlacedDrawing {
            name: format!("panel-{}", number + 1),
            drawing,
            place,
            clip: Some(frame.to_path(0.01)),
        });
        items.push(PlacedDrawing {
            name: format!("frame-{}", number + 1),
            drawing: frame_of(frame, sheet),
            place: Affine::IDENTITY,
            clip: None,
        });
    }
    items.push(PlacedDrawing {
        name: "balloon".to_owned(),
        drawing: balloon(words, sheet)?,
        place: Affine::IDENTITY,
        clip: None,
    });
    let mut page = Composition::new(title, sheet, items);
    page.boxes = Some(PrintBoxes { trim, bleed: whole });
    Ok(page)
}

fn frame_of(frame: Rect, sheet: Page) -> Drawing {
    let mark = Mark { path: frame.to_path(0.01), paint: pen(0.6), provenance: Provenance::default() };
    drawing("frame", sheet, vec![mark])
}

fn balloon(words: &str, sheet: Page) -> Result<Drawing, Error> {
    let setting = Setting::new(Font::named("comic")?).with_em(4.2).upper_case().in_language("en");
    let (block, radii) = TextBlock::in_ellipse(words, &setting, 0.75)?;
    let middle = Point::new(62.0, 22.0);
    let around = Ellipse::new(middle, (radii.x + 2.0, radii.y + 1.5), 0.0).to_path(0.01);
    let mut marks = vec![
        Mark { path: around.clone(), paint: Paint::Fill(Colour::WHITE), provenance: Provenance::default() },
        Mark { path: around, paint: pen(0.4), provenance: Provenance::default() },
    ];
    marks.extend(block.marks(middle - block.bounds().center().to_vec2(), Colour::BLACK));
    let shout = TextBlock::unbroken("CRACK! Ω", &Setting::new(Font::named("comic")?).with_em(9.0))?;
    marks.extend(shout.marks(Point::new(70.0, 66.0), RED));
    Ok(drawing("balloon", sheet, marks))
}

fn pen(width: f64) -> Paint {
    let colour = Colour::BLACK;
    Paint::Stroke(StrokePaint {
        width,
        colour,
        cap: Cap::Butt,
        join: Join::Miter,
        dash: Vec::new(),
        dash_offset: 0.0,
    })
}

fn drawing(title: &str, sheet: Page, marks: Vec<Mark>) -> Drawing {
    let layer = Layer { kind: LayerKind::Lines, pen: None, ordered: true, marks };
    Drawing::new(title, Page { background: None, ..sheet }, vec![layer])
}
