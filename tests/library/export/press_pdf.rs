//! PDF for printing presses: boxes, marks, separations, overprint, layers, fonts, halftone screens and
//! standards, as written in the file.

use kurbo::{Affine, BezPath, Point, Rect, Shape};
use ligne::colour::pixel_picture::Picture;
use ligne::colour::srgb::Colour;
use ligne::drawing::{
    Cap, Composition, Drawing, Gradient, ImagePaint, ImagePiece, Join, Layer, LayerKind, Mark, Page, Paint,
    PieceContent, PlacedDrawing, PrintBoxes, Provenance, StrokePaint, Unit,
};
use ligne::export::{Inks, PdfOptions, Standard, to_pdf};
use ligne::kurbo;
use ligne::text::{Font, Setting, TextBlock};

use crate::library::support::readers::pdf_reader::split_pdf_streams;

const RED: Colour = Colour::rgb(228, 0, 43);

fn stroke(colour: Colour) -> Paint {
    Paint::Stroke(StrokePaint {
        width: 1.0,
        colour,
        cap: Cap::Butt,
        join: Join::Miter,
        dash: Vec::new(),
        dash_offset: 0.0,
    })
}

fn mark(data: &str, paint: Paint) -> Mark {
    Mark { path: BezPath::from_svg(data).unwrap(), paint, provenance: Provenance::default() }
}

fn sheet(width: f64, height: f64) -> Page {
    Page { width, height, unit: Unit::Mm, background: None }
}

fn item(name: &str, marks: Vec<Mark>) -> PlacedDrawing {
    let layer = Layer { kind: LayerKind::Lines, pen: None, ordered: true, marks };
    let drawing = Drawing::new(name, sheet(100.0, 60.0), vec![layer]);
    PlacedDrawing { name: name.to_owned(), drawing, place: Affine::IDENTITY, clip: None }
}

fn page(items: Vec<PlacedDrawing>) -> Composition {
    Composition::new("A page", sheet(106.0, 66.0), items)
}

fn write_and_take_apart(marks: Vec<Mark>, options: &PdfOptions) -> (String, String) {
    split_pdf_streams(&to_pdf(&[page(vec![item("a", marks)])], options).unwrap())
}

fn black_only() -> PdfOptions {
    PdfOptions::default().with_inks(Inks::K)
}

/// Page box of the file by name, in points.
fn page_box(rest: &str, name: &str) -> Vec<f64> {
    let inner = rest.split(&format!("/{name} [")).nth(1).unwrap_or_else(|| panic!("no {name} in {rest}"));
    inner.split(']').next().unwrap().split(' ').map(|x| x.parse().unwrap()).collect()
}

#[test]
fn pdf_boxes_and_crop_marks_follow_trim_and_bleed() {
    let mut composed = page(vec![item("a", vec![mark("M0 0L10 10", stroke(Colour::BLACK))])]);
    let (trim, bleed) = (Rect::new(3.0, 3.0, 103.0, 63.0), Rect::new(0.0, 0.0, 106.0, 66.0));
    composed.boxes = Some(PrintBoxes { trim, bleed });
    let near = |found: Vec<f64>, mm: [f64; 4]| {
        for (found, wanted) in found.iter().zip(mm) {
            assert!((found - wanted * 72.0 / 25.4).abs() < 1e-3, "{found} is not {wanted} mm");
        }
    };
    let (content, rest) = split_pdf_streams(&to_pdf(&[composed.clone()], &black_only()).unwrap());
    near(page_box(&rest, "MediaBox"), [0.0, 0.0, 106.0, 66.0]);
    near(page_box(&rest, "TrimBox"), [3.0, 3.0, 103.0, 63.0]);
    near(page_box(&rest, "BleedBox"), [0.0, 0.0, 106.0, 66.0]);
    assert!(!content.contains("/All"));
    // Crop marks start at the bleed, are 5 mm long with 1 mm of margin, and print on all plates.
    let (content, rest) =
        split_pdf_streams(&to_pdf(&[composed.clone()], &black_only().with_marks()).unwrap());
    near(page_box(&rest, "MediaBox"), [0.0, 0.0, 118.0, 78.0]);
    near(page_box(&rest, "TrimBox"), [9.0, 9.0, 109.0, 69.0]);
    near(page_box(&rest, "BleedBox"), [6.0, 6.0, 112.0, 72.0]);
    assert!(rest.contains("/All [/Separation /All /DeviceGray"), "{rest}");
    let marks = content.split("/All CS").nth(1).unwrap();
    assert!(marks.contains("3 0 m\n3 -5 l\nS") && marks.contains("106 63 m\n111 63 l\nS"), "{marks}");
    assert_eq!(marks.matches(" c\n").count(), 16, "four circles");
    // No mark lies inside the bleed.
    for line in marks.lines().filter(|line| line.ends_with(" m") || line.ends_with(" l")) {
        let numbers: Vec<f64> = line.split(' ').filter_map(|x| x.parse().ok()).collect();
        assert!(!bleed.inset(-1e-6).contains(Point::new(numbers[0], numbers[1])), "{line}");
    }
    composed.boxes = Some(PrintBoxes { trim: bleed.inflate(1.0, 1.0), bleed });
    let error = to_pdf(&[composed], &black_only()).unwrap_err().to_string();
    assert!(error.contains("within its bleed"), "{error}");
}

#[test]
fn black_only_pdf_converts_all_colours_and_overprints_black() {
    let gradient = Gradient {
        start: Point::ZERO,
        end: Point::new(9.0, 0.0),
        stops: vec![(0.0, RED), (1.0, Colour::WHITE)],
    };
    let picture = Picture { width: 1, height: 1, pixels: vec![RED] };
    let piece = ImagePiece {
        outline: Rect::new(0.0, 0.0, 1.0, 1.0).to_path(0.1),
        shows: PieceContent::Pixels(Affine::IDENTITY),
    };
    let image = ImagePaint { picture: picture.into(), pieces: vec![piece] };
    let marks = vec![
        mark("M0 0L10 10", stroke(Colour::BLACK)),
        mark("M0 0H3V3Z", Paint::Fill(Colour::rgb(128, 128, 128))),
        mark("M0 0H3V3Z", Paint::Fill(Colour::WHITE)),
        mark("M0 0H3V3Z", Paint::Fill(RED)),
        mark("M0 0H9V3Z", Paint::Gradient(gradient)),
        mark("M0 0H1V1H0Z", Paint::Image(image)),
    ];
    let (content, rest) = write_and_take_apart(marks, &black_only());
    assert!(content.contains("/O255 gs\n1 w\n0 J\n0 j\n0 0 0 1 K\n"), "{content}");
    assert!(content.contains("/A255 gs\n0 0 0 .498 k\n") && content.contains("0 0 0 0 k\n"), "{content}");
    assert!(!content.contains("rg\n") && !content.contains("RG\n"), "{content}");
    assert!(!rest.contains("DeviceRGB") && rest.contains("/DeviceCMYK"), "{rest}");
    assert!(rest.contains("/OP true") && rest.contains("/op true") && rest.contains("/OPM 1"), "{rest}");
    assert!(rest.contains("/OP false"), "white must not stay below: {rest}");
}

#[test]
fn spot_colours_have_separations() {
    let marks = vec![mark("M0 0H3V3Z", Paint::Fill(RED)), mark("M0 0L3 3", stroke(RED))];
    let (content, rest) = write_and_take_apart(marks, &black_only().with_spot(RED, "PANTONE 185 C"));
    assert!(content.contains("/S0 cs 1 scn") && content.contains("/S0 CS 1 SCN"), "{content}");
    assert!(rest.contains("/S0 [/Separation /PANTONE#20185#20C /DeviceCMYK"), "{rest}");
    assert!(!content.contains(" k\n") && !content.contains(" K\n"), "{content}");
}

#[test]
fn pdf_drawings_are_placed_and_clipped_layers() {
    let mut first = item("panel-1", vec![mark("M0 0L10 10", stroke(Colour::BLACK))]);
    first.clip = Some(Rect::new(1.0, 2.0, 30.0, 40.0).to_path(0.1));
    first.place = Affine::new([2.0, 0.0, 0.0, 2.0, 5.0, 6.0]);
    first.drawing.page.background = Some(Colour::WHITE);
    let second = item("panel-2", Vec::new());
    let pages = [page(vec![first, second]), page(vec![item("cover", Vec::new())])];
    let bytes = to_pdf(&pages, &PdfOptions::default()).unwrap();
    let (content, rest) = split_pdf_streams(&bytes);
    assert!(
        content.replace('\n', " ").contains(
            "/OC /L0 BDC q 1 2 m 30 2 l 30 40 l 1 40 l h W n 2 0 0 2 5 6 cm /OC /L1 BDC /A255 gs 1 1 1 rg \
             0 0 m 100 0 l 100 60 l 0 60 l h f EMC /OC /L2 BDC /A255 gs 1 w 0 J 0 j 0 0 0 RG [] 0 d 0 0 m 10 10 l S EMC Q EMC"
        ),
        "{content}"
    );
    for name in ["(panel-1)", "(panel-2)", "(cover)", "(paper)", "(lines)"] {
        assert!(rest.contains(name), "no {name} in {rest}");
    }
    assert_eq!(rest.matches("/Type /Page\n").count(), 2, "{rest}");
    let order = rest.split("/Order [").nth(1).unwrap().split(">>").next().unwrap();
    assert_eq!(order.matches("(A page)").count(), 2, "each page lists its layers: {order}");
    assert_eq!(bytes, to_pdf(&pages, &PdfOptions::default()).unwrap(), "the same pages give the same bytes");
    // A clip without area hides everything.
    let mut hidden = item("hidden", Vec::new());
    hidden.clip = Some(BezPath::new());
    assert!(
        split_pdf_streams(&to_pdf(&[page(vec![hidden])], &black_only()).unwrap()).0.contains("0 0 m\nW n")
    );
}

#[test]
fn pdf_text_uses_font_subsets() {
    let setting = Setting::new(Font::named("comic").unwrap()).with_em(5.0);
    let block = TextBlock::unbroken("AV é", &setting).unwrap();
    let marks = block.marks(Point::new(10.0, 20.0), Colour::BLACK);
    let bytes = to_pdf(&[page(vec![item("words", marks.clone())])], &black_only()).unwrap();
    let (content, rest) = split_pdf_streams(&bytes);
    let baseline = 20.0 + block.lines[0].baseline;
    let matrix = format!("5 0 0 5 {} {} Tm", 10.0, (baseline * 1000.0).round() / 1000.0);
    let text: Vec<&str> = content.split("BT\n").nth(1).unwrap().split("ET").next().unwrap().lines().collect();
    assert_eq!(text[0], "/F0 1 Tf");
    assert!(text[1].starts_with("5 0 0 -5 ") && text[1].ends_with(" Tm"), "{} is not {matrix}", text[1]);
    // Kerning moves the V towards the A.
    let shift: f64 = text[2].split('>').nth(1).unwrap().split('<').next().unwrap().parse().unwrap();
    assert!(shift > 10.0, "{}", text[2]);
    assert!(rest.contains("AAAAAA+ComicNeue-Bold") && rest.contains("/Subtype /CIDFontType0C"), "{rest}");
    assert!(content.contains("beginbfchar") && content.contains("<00E9>"), "{content}");
    let part = bytes.len();
    // Text as outlines needs no font.
    let (content, rest) =
        split_pdf_streams(&to_pdf(&[page(vec![item("words", marks)])], &black_only().outlined()).unwrap());
    assert!(!content.contains("BT\n") && !rest.contains("/Font"), "{rest}");
    assert!(part < 12_000, "{part} bytes: the whole font is in it");
}

#[test]
fn pdf_standards_are_declared_and_need_profiles() {
    let marks = || vec![mark("M0 0L10 10", stroke(Colour::BLACK))];
    let one = || [page(vec![item("a", marks())])];
    let (content, rest) =
        split_pdf_streams(&to_pdf(&one(), &PdfOptions::default().with_standard(Standard::A2b)).unwrap());
    assert!(!content.contains("/Filter") && rest.contains("<pdfaid:part>2</pdfaid:part>"), "{rest}");
    assert!(rest.contains("/S /GTS_PDFA1") && rest.contains("/ID ["), "{rest}");
    assert!(rest.contains("(D:20000101000000") && rest.contains("2000-01-01T00:00:00+00:00"), "{rest}");
    let picture = Picture { width: 1, height: 1, pixels: vec![RED] };
    let piece = ImagePiece {
        outline: Rect::new(0.0, 0.0, 1.0, 1.0).to_path(0.1),
        shows: PieceContent::Pixels(Affine::IDENTITY),
    };
    let image = Paint::Image(ImagePaint { picture: picture.into(), pieces: vec![piece] });
    let image = || vec![mark("M0 0H1V1H0Z", image.clone())];
    assert!(write_and_take_apart(image(), &PdfOptions::default()).1.contains("/Interpolate true"));
    let archived = write_and_take_apart(image(), &PdfOptions::default().with_standard(Standard::A2b)).1;
    assert!(archived.contains("/Interpolate false"), "{archived}");
    let x4 = PdfOptions::default().with_standard(Standard::X4);
    let error = to_pdf(&one(), &x4).unwrap_err().to_string();
    assert!(error.contains("PDF/X-4 needs a profile"), "{error}");
    assert!(
        to_pdf(&one(), &black_only().with_standard(Standard::A2b)).unwrap_err().to_string().contains("PDF/A")
    );
    assert!(to_pdf(&[], &x4).unwrap_err().to_string().contains("at least one page"));
    let mut flat = one();
    flat[0].page.height = 0.0;
    assert!(to_pdf(&flat, &black_only()).unwrap_err().to_string().contains("106 x 0"));
}

#[test]
fn screened_fills_are_halftone_dots_on_the_page_lattice() {
    let grey = Paint::Fill(Colour::rgb(128, 128, 128));
    let options = black_only().with_screen(25.4, 0.0);
    let (content, rest) = write_and_take_apart(vec![mark("M0.5 0.5H20.5V10.5H0.5Z", grey.clone())], &options);
    // Dots of a dashed line, 1 apart. The last dot lies half a step before the end of the line.
    let points = |line: &str| -> Vec<(i64, i64)> {
        let numbers: Vec<f64> = line.split(' ').filter_map(|word| word.parse().ok()).collect();
        let [from, y, to, _] = numbers[..] else { panic!("{line}") };
        (from as i64..=(to - 0.5) as i64).map(|x| (x, y as i64)).collect()
    };
    let lines: Vec<&str> =
        content.lines().filter(|line| line.contains(" m ") && line.ends_with(" l")).collect();
    let mut dots: Vec<(i64, i64)> = lines.iter().flat_map(|line| points(line)).collect();
    let laid = dots.len();
    dots.sort_unstable();
    dots.dedup();
    assert!(lines.len() < 16 && content.contains("1 J [0 1] 0 d"), "{lines:?}");
    // 200 dots have their centres inside, and others overlap the border. No dot occurs twice.
    assert!((200..290).contains(&dots.len()) && laid == dots.len(), "{laid} dots");
    assert!(dots.contains(&(3, 5)) && dots.contains(&(20, 1)) && !dots.contains(&(3, 15)));
    assert!(content.contains("0 0 0 0 k\n.5 .5 m") && content.contains("0 0 0 1 K"), "{content}");
    // Diameter of a dot that covers 127/255 of a lattice cell.
    let width = (4.0 * (127.0 / 255.0) / std::f64::consts::PI).sqrt();
    assert!(
        content.contains(&format!("{width:.4} w").trim_start_matches('0').to_string()),
        "no {width:.4}: {content}"
    );
    assert!(rest.contains("/OP true"));
    // The lattice is fixed to the page, not to the drawing.
    let mut moved = item("a", vec![mark("M0.5 0.5H20.5V10.5H0.5Z", grey)]);
    moved.place = Affine::translate((0.25, 0.0)) * Affine::scale(2.0);
    let content = split_pdf_streams(&to_pdf(&[page(vec![moved])], &options).unwrap()).0;
    assert!(content.contains("\n.5 0 0 .5 -.125 0 cm\n0 0 0 1 K"), "{content}");
    // Lines and black fills are not screened. A gradient has dots of many sizes.
    let gradient = Gradient {
        start: Point::ZERO,
        end: Point::new(20.0, 0.0),
        stops: vec![(0.0, Colour::BLACK), (1.0, Colour::WHITE)],
    };
    let marks = vec![
        mark("M0 0L10 10", stroke(Colour::rgb(128, 128, 128))),
        mark("M0 0H3V3Z", Paint::Fill(Colour::BLACK)),
        mark("M0 0H20V10H0Z", Paint::Gradient(gradient)),
    ];
    let (content, _) = write_and_take_apart(marks, &options);
    assert!(content.contains("0 0 0 .498 K\n") && content.contains("0 0 0 1 k\n0 0 m"), "{content}");
    let sizes = content.lines().filter(|line| line.ends_with(" w")).count();
    assert!((18..25).contains(&sizes), "{sizes} widths");
    let error =
        to_pdf(&[page(Vec::new())], &PdfOptions::default().with_screen(60.0, 45.0)).unwrap_err().to_string();
    assert!(error.contains("inks of a press"), "{error}");
    assert!(
        to_pdf(&[page(Vec::new())], &black_only().with_screen(f64::NAN, 45.0))
            .unwrap_err()
            .to_string()
            .contains("NaN")
    );
}

/// CMYK profile of Ghostscript.
const PRESS: &str = "/usr/share/color/icc/ghostscript/default_cmyk.icc";

#[test]
fn cmyk_inks_follow_the_profile_and_the_ink_limit() {
    let Ok(profile) = std::fs::read(PRESS) else {
        eprintln!("skipped: {PRESS} is absent");
        return;
    };
    let brown = Colour::rgb(40, 20, 5);
    let fills = [brown, RED, Colour::BLACK, Colour::rgb(128, 128, 128)];
    let marks = || fills.iter().map(|colour| mark("M0 0H3V3Z", Paint::Fill(*colour))).collect::<Vec<_>>();
    let inks = |options: &PdfOptions| -> Vec<Vec<f64>> {
        let (content, rest) = write_and_take_apart(marks(), options);
        assert!(!rest.contains("DeviceRGB"), "{rest}");
        let lines = content.lines().filter(|line| line.ends_with(" k"));
        lines.map(|line| line.split(' ').filter_map(|x| x.parse().ok()).collect()).collect()
    };
    let four = PdfOptions::default().with_inks(Inks::Cmyk(profile.into()));
    let found = inks(&four);
    assert_eq!(found.len(), 4);
    assert!(found[1][0] < 0.1 && found[1][1] > 0.8 && found[1][2] > 0.6, "red is {:?}", found[1]);
    assert_eq!(found[2], [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(found[3], [0.0, 0.0, 0.0, 0.498]);
    assert!(found[0].iter().sum::<f64>() > 2.0, "brown is {:?}", found[0]);
    let limited = inks(&four.clone().with_ink_limit(180.0));
    assert!(limited.iter().all(|inks| inks.iter().sum::<f64>() <= 1.8 + 1e-3), "{limited:?}");
    assert_eq!(limited[2..], found[2..], "what is within the limit stays");
    let (_, rest) = write_and_take_apart(marks(), &four.with_standard(Standard::X4));
    for wanted in
        ["PDF/X-4</pdfxid", "/S /GTS_PDFX", "/DestOutputProfile", "/Trapped /False", "/TrimBox", "/N 4"]
    {
        assert!(rest.contains(wanted), "no {wanted} in {rest}");
    }
    assert!(rest.starts_with("%PDF-1.6"));
}
