//! Tests of painting operators.

use kurbo::BezPath;

use super::*;
use crate::drawing::{Drawing, Page, Provenance, Unit};

const PAGE: Page = Page { width: 9.0, height: 9.0, unit: Unit::Px, background: None };

fn content(marks: &[(&str, Paint)]) -> String {
    let mut writer = ContentWriter::new(Decimals::new(2), 0, None);
    for (data, paint) in marks {
        let path = BezPath::from_svg(data).unwrap();
        let mark = Mark { path, paint: paint.clone(), provenance: Provenance::default() };
        let drawing = Drawing::new("", PAGE, vec![]);
        writer.mark(&mark, &Crops::of(&drawing));
    }
    String::from_utf8(writer.out).unwrap().replace('\n', " ")
}

fn stroke_of(width: f64, dash: &[f64]) -> Paint {
    Paint::Stroke(StrokePaint {
        width,
        colour: Colour::rgb(255, 0, 51),
        cap: Cap::Round,
        join: Join::Bevel,
        dash: dash.to_vec(),
        dash_offset: 0.0,
    })
}

#[test]
fn stroke_state_is_written_only_where_it_changes() {
    let lines = [
        ("M0 0L1 2.5", stroke_of(1.5, &[])),
        ("M3 3H4", stroke_of(1.5, &[])),
        ("M5 5H6", stroke_of(2.0, &[4.0, 2.0])),
    ];
    assert_eq!(
        content(&lines),
        "/A255 gs 1.5 w 1 J 2 j 1 0 .2 RG [] 0 d 0 0 m 1 2.5 l S 3 3 m 4 3 l S 2 w [4 2 ] 0 d 5 5 m 6 5 l S "
    );
}

#[test]
fn path_elements_become_pdf_operators() {
    let fill = Paint::Fill(Colour { a: 128, ..Colour::BLACK });
    let ink = "/A128 gs 0 0 0 rg ";
    for (data, operators) in [
        ("M0 0C1 2 3 4 5 6Z", "0 0 m 1 2 3 4 5 6 c h f "),
        ("M0 0Q3 0 3 3", "0 0 m 2 0 3 1 3 3 c f "),
        ("M0 0H3ZQ0 3 3 3", "0 0 m 3 0 l h 0 0 m 0 2 1 3 3 3 c f "),
        ("M1 1M2 2", "1 1 m 1 1 l 2 2 m 2 2 l f "),
    ] {
        assert_eq!(content(&[(data, fill.clone())]), format!("{ink}{operators}"), "{data}");
    }
}
