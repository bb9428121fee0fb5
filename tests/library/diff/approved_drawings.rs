//! `assert_drawing!` approves a drawing, compares later drawings with it, and reports differences.

use std::path::PathBuf;

use kurbo::BezPath;
use ligne::colour::srgb::Colour;
use ligne::drawing::{
    Cap, Drawing, Join, Layer, LayerKind, Mark, Page, Paint, Provenance, StrokePaint, Unit,
};
use ligne::testing::{Approval, assert_drawing, check};

fn drawing(y: f64) -> Drawing {
    let paint = StrokePaint {
        width: 1.0,
        colour: Colour::BLACK,
        cap: Cap::Round,
        join: Join::Round,
        dash: Vec::new(),
        dash_offset: 0.0,
    };
    let line = |path: &str| Mark {
        path: BezPath::from_svg(path).unwrap(),
        paint: Paint::Stroke(paint.clone()),
        provenance: Provenance { classes: vec!["crease"], part: Some("lid".into()), ..Provenance::default() },
    };
    let marks = vec![line("M10 10H90"), line(&format!("M10 {y}H90"))];
    let page = Page { width: 100.0, height: 100.0, unit: Unit::Px, background: Some(Colour::WHITE) };
    Drawing::new("lid", page, vec![Layer { kind: LayerKind::Lines, pen: None, ordered: false, marks }])
}

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("ligne-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

#[test]
fn a_drawing_is_approved_once_and_compared_from_then_on() {
    let folder = folder("approved");
    let check = |y: f64, approval: Approval| check(&drawing(y), "lid", &folder, "", &approval);
    let missing = check(50.0, Approval::None).unwrap_err();
    assert!(missing.contains("no approved drawing") && missing.contains("LIGNE_BLESS=1"), "{missing}");
    assert!(check(50.0, Approval::Refused).unwrap_err().contains("CI is set"));
    assert!(!folder.join("lid.svg").exists());
    check(50.0, Approval::Bless).unwrap();
    check(50.0, Approval::None).unwrap();
    let told = check(51.0, Approval::None).unwrap_err();
    assert!(told.contains("moved      crease of `lid` at (50, 50): by 1 px (1 down)"), "{told}");
    for what in ["actual", "diff"] {
        let line = told.lines().find(|line| line.starts_with(what)).unwrap();
        let path = line.split_once(' ').unwrap().1.trim();
        assert!(std::fs::read_to_string(path).unwrap().contains("<svg"), "{line}");
    }
    check(51.0, Approval::Bless).unwrap();
    check(51.0, Approval::None).unwrap();
}

#[test]
fn drawings_of_the_same_name_are_written_to_different_files() {
    let told = ["here", "there"].map(|place| {
        let folder = folder(place);
        check(&drawing(50.0), "lid", &folder, "", &Approval::None).unwrap_err()
    });
    let actual = |text: &str| text.lines().find(|line| line.starts_with("actual")).unwrap().to_owned();
    assert_ne!(actual(&told[0]), actual(&told[1]));
}

#[test]
fn order_and_differences_within_tolerance_are_accepted() {
    let folder = folder("forgiven");
    check(&drawing(50.0), "lid", &folder, "", &Approval::Bless).unwrap();
    let mut turned = drawing(50.0);
    turned.layers[0].marks.reverse();
    turned.layers[0].marks[0].path = turned.layers[0].marks[0].path.reverse_subpaths();
    check(&turned, "lid", &folder, "", &Approval::None).unwrap();
    assert!(check(&drawing(50.3), "lid", &folder, "0.2px", &Approval::None).is_err());
    check(&drawing(50.3), "lid", &folder, "0.5px", &Approval::None).unwrap();
    assert!(
        check(&drawing(50.3), "lid", &folder, "wide", &Approval::None)
            .unwrap_err()
            .contains("not a tolerance")
    );
}

#[test]
#[should_panic(expected = "no approved drawing")]
fn assert_drawing_panics_without_an_approved_drawing() {
    assert_drawing!(drawing(50.0), "no-such-drawing");
}
