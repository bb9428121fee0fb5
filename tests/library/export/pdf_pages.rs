//! PDF files contain the page, the layers and the ink of the drawing, read with an independent reader.

use ligne::colour::srgb::Colour;
use ligne::drawing::{Mark, Page, Provenance, Unit};

use super::svg_and_png::{Random, drawing, mark, stroke};
use crate::library::support::readers::pdf_reader::split_pdf_streams;

#[test]
fn pdf_has_the_page_the_layers_and_the_ink_of_the_drawing() {
    let mut drawing = drawing(vec![
        mark("M10 20L30.25 40", stroke(2.0, Colour::BLACK), &["contour"], None),
        mark("M1 2L3 4", stroke(2.0, Colour { a: 51, ..Colour::BLACK }), &["contour"], None),
    ]);
    drawing.title = "Büro (a)".to_owned();
    drawing.page.background = Some(Colour::WHITE);
    drawing.layers[0].pen = Some("1 0.5 mm #000000".to_owned());
    let pdf = drawing.to_pdf();
    assert_eq!(pdf, drawing.to_pdf());
    let (content, rest) = split_pdf_streams(&pdf);
    assert_eq!(
        content.replace('\n', " "),
        "q .75 0 0 -.75 0 60 cm 4 M /OC /L0 BDC /A255 gs 1 1 1 rg 0 0 100 80 re f EMC \
         /OC /L1 BDC /A255 gs 2 w 1 J 1 j 0 0 0 RG [] 0 d 10 20 m 30.25 40 l S \
         /A51 gs 0 0 0 RG 1 2 m 3 4 l S EMC Q "
    );
    for wanted in ["/MediaBox [0 0 75 60]", "(paper)", "(1 0.5 mm #000000)", "/CA 0.2", "/OCGs [5 0 R 6 0 R]"]
    {
        assert!(rest.contains(wanted), "no {wanted} in {rest}");
    }
    assert!(!rest.contains("Date"), "{rest}");
}

#[test]
fn pdf_pages_have_the_size_of_the_paper() {
    let mut drawing = drawing(Vec::new());
    drawing.layers.clear();
    drawing.page = Page { width: 210.0, height: 297.0, unit: Unit::Mm, background: None };
    let text = split_pdf_streams(&drawing.to_pdf()).1;
    let (_, sides) = text.split_once("/MediaBox [0 0 ").expect("the page has a size");
    let sides: Vec<f64> =
        sides.split([' ', ']']).take(2).map(|side| side.parse().expect("a number")).collect();
    // A4 in points, within single precision.
    assert!((sides[0] - 595.275_59).abs() < 1e-3 && (sides[1] - 841.889_76).abs() < 1e-3, "{sides:?}");
    drawing.page = Page { width: 38_400.0, height: 100.0, unit: Unit::Px, background: None };
    let (_, rest) = split_pdf_streams(&drawing.to_pdf());
    assert!(rest.contains("/MediaBox [0 0 14400 37.5]") && rest.contains("/UserUnit 2"), "{rest}");
}

#[test]
fn pdf_bytes_do_not_depend_on_thread_count() {
    let mut random = Random(5);
    let marks: Vec<Mark> = (0..5000)
        .map(|i| Mark {
            path: random.path(),
            paint: stroke(f64::from(i % 3), Colour::BLACK),
            provenance: Provenance::default(),
        })
        .collect();
    let drawing = drawing(marks);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| drawing.to_pdf())
    };
    let pdf = on(1);
    assert_eq!(pdf, on(3));
    let (content, _) = split_pdf_streams(&pdf);
    assert_eq!(content.lines().filter(|line| *line == "S").count(), 5000);
    assert_eq!((content.matches("BDC").count(), content.matches("EMC").count()), (1, 1));
}
