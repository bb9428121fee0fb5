//! Findings with one cause become one sentence: renamed parts, other pens, another camera, and holes that
//! moved far.

use ligne::diff::{self, Diff, DiffOptions, Picture, Verdict};

fn compare(before: &str, after: &str) -> Diff {
    let page = |body: &str| {
        let svg = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="500" height="500">{body}</svg>"#);
        Picture::from_svg(&svg).unwrap_or_else(|error| panic!("{error}\n{svg}"))
    };
    diff::compare(&page(before), &page(after), &DiffOptions::default())
}

fn verdicts(diff: &Diff) -> Vec<&'static str> {
    diff.findings.iter().map(|finding| finding.verdict.name()).collect()
}

fn rows(part: &str, third: f64) -> String {
    let line = |y: f64| format!(r##"<path class="crease" d="M30.25 {y}H210" fill="none" stroke="#000"/>"##);
    format!("<g data-part=\"{part}\">{}{}{}</g>", line(50.0), line(80.0), line(third))
}

#[test]
fn a_renamed_part_is_one_finding() {
    let diff = compare(&rows("lid", 120.0), &rows("cover", 120.0));
    assert_eq!(verdicts(&diff), ["relabelled"], "{:#?}", diff.lines());
    assert!(diff.lines()[0].contains("part lid → cover"), "{:#?}", diff.lines());
    // Other findings of the part carry its new name.
    let diff = compare(&rows("lid", 120.0), &rows("cover", 124.0));
    assert_eq!(verdicts(&diff), ["moved", "relabelled"], "{:#?}", diff.lines());
    assert_eq!(diff.findings[0].label.part.as_deref(), Some("cover"));
    // Two parts merged into one are not a rename: their marks are relabelled one by one.
    let two = rows("lid", 120.0) + &rows("rim", 160.0).replace("M30.25", "M230.25").replace("H210", "H410");
    let diff = compare(&two, &two.replace("lid", "one").replace("rim", "one"));
    assert!(diff.of(Verdict::Relabelled).count() > 2, "{:#?}", diff.lines());
}

#[test]
fn a_hole_moved_far_is_one_finding() {
    let part = |x: f64| {
        format!(
            r##"<g data-part="lid" fill="none" stroke="#000"><path class="contour" d="M20 20H480V480H20Z"/>
            <path class="contour" d="M{x} 250a40 40 0 1 0 80 0a40 40 0 1 0 -80 0z"/></g>"##
        )
    };
    for way in [12.0, 25.0, 90.0, 200.0] {
        let diff = compare(&part(60.0), &part(60.0 + way));
        assert_eq!(verdicts(&diff), ["moved"], "{way}: {:#?}", diff.lines());
        assert!(diff.lines()[0].starts_with("moved      contour of `lid`"), "{:#?}", diff.lines());
        assert!((diff.findings[0].largest - way).abs() < 0.01 * way);
    }
}

#[test]
fn a_changed_pen_is_one_finding() {
    let parts = |attribute: &str| -> String {
        let part =
            |i: usize| rows(&format!("part {i}"), 90.0).replace("M30.25", &format!("M{}.25", 30 + 9 * i));
        format!("<g {attribute}>{}</g>", (0..9).map(part).collect::<String>())
    };
    for (new, words) in [
        ("stroke-width=\"2\"", "the pen: width 1 px → 2 px (27 marks of 9 parts)"),
        ("stroke-dasharray=\"6 3\"", "the pen: dash solid → 6 3 (27 marks of 9 parts)"),
        ("stroke-linecap=\"round\"", "the pen: ends butt → round (27 marks of 9 parts)"),
    ] {
        let diff = compare(&parts(""), &parts(new));
        let lines = diff.lines();
        assert!(lines.len() == 1 && lines[0].contains(words), "{new}: {lines:#?}");
    }
}

#[test]
fn coincident_marks_are_restyled_one_by_one() {
    let body = r##"<g data-part="screw" fill="none"><path class="crease" stroke="#000" stroke-dasharray="14 4" d="M50 50H110"/>
        <path class="crease" stroke="#000" d="M110 54V50H50V54z"/></g>"##;
    let diff = compare(body, &body.replace("#000", "#06c"));
    assert_eq!(verdicts(&diff), ["restyled", "restyled"], "{:#?}", diff.lines());
}

#[test]
fn another_camera_is_one_finding() {
    // Each part shifts by a different amount, as parts at different depths do.
    let parts = |turn: f64| -> String {
        let part = |i: usize| {
            let (x, y) = (30.0 + 45.0 * i as f64, 60.0 + 20.0 * (i % 3) as f64);
            let (dx, dy) = (turn * (1.0 + i as f64), turn * (4.0 - i as f64));
            let [a, b] = [0.0, 30.0].map(|step| {
                format!(
                    r##"<path class="crease" d="M{} {}l20 {}"/>"##,
                    x + dx,
                    y + dy + step,
                    5.0 + step / 10.0
                )
            });
            format!("<g data-part=\"part {i}\" fill=\"none\" stroke=\"#000\">{a}{b}</g>")
        };
        (0..9).map(part).collect()
    };
    let diff = compare(&parts(0.0), &parts(0.8));
    let lines = diff.lines();
    assert!(
        lines.len() == 1 && lines[0].contains("seen from another side: 18 marks of 9 parts"),
        "{lines:#?}"
    );
}

#[test]
fn a_shortened_stroke_outline_is_reported_as_shorter() {
    let stroke = |to: f64| {
        format!(
            r##"<path class="stroke" data-part="plate" data-axis="M50 50H250" data-width="1" fill="#333" d="M50 49.5H{to}V50.5H50z"/>"##
        )
    };
    let diff = compare(&stroke(250.0), &stroke(210.0));
    let lines = diff.lines();
    assert!(lines.len() == 1 && lines[0].contains("40 px shorter"), "{lines:#?}");
}
