//! Texts, lines and balloons on technical sheets do not overlap: generated sheets are checked on the finished
//! page.
//!
//! Each sheet has 1 to 80 parts, a size from A4 to A1, either projection method, and random sections,
//! details, dimensions, balloons, notes and long title block texts. A sheet that does not fit must be
//! rejected. `LIGNE_KEEP_SHEETS=FOLDER` keeps the page files and models.

use std::fs;

use ligne::drawing::Paint;
use ligne::kurbo::{Affine, BezPath, PathEl, Point, Rect, Shape, flatten};
use ligne::page::{ComposedPage, PageFile};

use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::sheet_models::{
    block, drilled_plate, obj_text, placed_marks, temp_folder,
};

/// Number of sheets in a normal run; the long run has `NIGHTLY_SHEET_COUNT`.
const SHEET_COUNT: u64 = 12;
const NIGHTLY_SHEET_COUNT: u64 = 100;

/// A line of a mark, or a side of a filled mark.
struct Stroke {
    item: String,
    ends: [Point; 2],
    half: f64,
}

struct Text {
    item: String,
    words: String,
    path: BezPath,
    rect: Rect,
    /// Rotation of the page that makes the text horizontal, and the bounding box of the text after it.
    upright: Affine,
    turned: Rect,
}

impl Text {
    fn new(item: &str, words: String, path: BezPath, place: Affine) -> Self {
        let [a, b, ..] = place.as_coeffs();
        let upright = Affine::rotate(-ligne::geometry::numbers::portable_math::atan2(b, a));
        let (rect, turned) = (path.bounding_box(), (upright * path.clone()).bounding_box());
        Self { item: item.to_owned(), words, path, rect, upright, turned }
    }

    fn lies_on(&self, other: &Self) -> bool {
        let own = |one: &Self, other: &Self| {
            let both = one.turned.intersect((one.upright * other.path.clone()).bounding_box());
            both.width() > 0.05 && both.height() > 0.05
        };
        own(self, other) && own(other, self)
    }
}

/// The contents of a page: texts, other lines, and centres of balloons.
struct PageContents {
    texts: Vec<Text>,
    strokes: Vec<Stroke>,
    balloons: Vec<Point>,
}

fn page_contents(composed: &ComposedPage) -> PageContents {
    let mut found = PageContents { texts: Vec::new(), strokes: Vec::new(), balloons: Vec::new() };
    for item in &composed.composition.items {
        for (place, mark) in placed_marks(item) {
            let path = place * mark.path.clone();
            if let Some(text) = &mark.provenance.text {
                let words = text.words.to_string();
                found.texts.push(Text::new(&item.name, words, path, place * text.place));
                continue;
            }
            let half = if let Paint::Stroke(stroke) = &mark.paint { stroke.width / 2.0 } else { 0.0 };
            let own = path.bounding_box();
            let is_round =
                half > 0.0 && (own.width() - 8.0).abs() < 0.01 && (own.height() - 8.0).abs() < 0.01;
            if item.name == "balloons" && is_round && path.elements().len() > 3 {
                found.balloons.push(own.center());
            }
            let (mut start, mut last) = (Point::ZERO, Point::ZERO);
            let mut add = |a: Point, b: Point| {
                found.strokes.push(Stroke { item: item.name.clone(), ends: [a, b], half });
            };
            flatten(path.iter(), 0.02, |element| match element {
                PathEl::MoveTo(p) => (start, last) = (p, p),
                PathEl::LineTo(p) => {
                    add(last, p);
                    last = p;
                }
                PathEl::ClosePath => {
                    add(last, start);
                    last = start;
                }
                _ => {}
            });
        }
    }
    found
}

/// Returns the distance between a point and a segment.
fn distance(p: Point, [a, b]: [Point; 2]) -> f64 {
    let way = b - a;
    let share = ((p - a).dot(way) / way.hypot2().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (a + way * share - p).hypot()
}

/// Whether a segment enters a rectangle.
fn enters(rect: Rect, [a, b]: [Point; 2]) -> bool {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (p, d, low, high) in [(a.x, b.x - a.x, rect.x0, rect.x1), (a.y, b.y - a.y, rect.y0, rect.y1)] {
        if d.abs() < 1e-12 {
            if p < low || p > high {
                return false;
            }
            continue;
        }
        let (one, other) = ((low - p) / d, (high - p) / d);
        from = from.max(one.min(other));
        to = to.min(one.max(other));
    }
    from <= to
}

/// Returns the faults of a page.
fn faults(composed: &ComposedPage) -> Vec<String> {
    let PageContents { texts, strokes, balloons } = page_contents(composed);
    let page = composed.composition.page;
    let space = Rect::new(20.0, 10.0, page.width - 10.0, page.height - 10.0);
    let mut faults = Vec::new();
    for (k, text) in texts.iter().enumerate() {
        for other in &texts[..k] {
            if text.lies_on(other) {
                faults.push(format!("`{}` lies on `{}`", text.words, other.words));
            }
        }
        for stroke in &strokes {
            let near = text.rect.inflate(2.0, 2.0);
            let wide = stroke.half - 0.05;
            if enters(near, stroke.ends)
                && enters(text.turned.inflate(wide, wide), stroke.ends.map(|p| text.upright * p))
            {
                faults.push(format!(
                    "a line of {} runs through `{}` of {}",
                    stroke.item, text.words, text.item
                ));
            }
        }
        if text.item != "frame" && !space.contains_rect(text.rect) {
            faults.push(format!("`{}` lies outside the frame", text.words));
        }
    }
    for (k, centre) in balloons.iter().enumerate() {
        if balloons[..k].iter().any(|other| (*other - *centre).hypot() < 8.0) {
            faults.push(format!("balloons overlap at {centre:?}"));
        }
        for stroke in strokes.iter().filter(|stroke| distance(*centre, stroke.ends) < 3.9 + stroke.half) {
            // Its own circle is 4 mm from its centre, and its leader starts there.
            let far = distance(*centre, stroke.ends);
            if stroke.item != "balloons" || far < 3.85 {
                faults.push(format!("a line of {} runs through a balloon at {centre:?}", stroke.item));
            }
        }
        for text in texts.iter().filter(|text| text.item != "balloons") {
            let x = (text.rect.x0 - centre.x).max(centre.x - text.rect.x1).max(0.0);
            let y = (text.rect.y0 - centre.y).max(centre.y - text.rect.y1).max(0.0);
            if x * x + y * y < 16.0 {
                faults.push(format!("a balloon lies on `{}`", text.words));
            }
        }
    }
    faults.dedup();
    faults
}

/// Returns the page file and the model of a random sheet.
fn random_sheet(seed: u64) -> (String, String) {
    let mut dice = Dice::new(9000 + seed);
    let count = [1, 1, 2, 3, 5, 8, 12, 20, 40, 80][dice.below(10)];
    let size = ["A4", "A3", "A3", "A2", "A1"][dice.below(5)];
    let [w, d, h] = [dice.between(20.0, 160.0), dice.between(20.0, 90.0), dice.between(3.0, 20.0)];
    let columns = 1 + dice.below(4);
    let column = w / columns as f64;
    let holes: Vec<([f64; 2], f64)> = (0..columns)
        .map(|n| {
            let radius = dice.between(1.5, (0.35 * column.min(d)).max(1.6));
            let x = column * (n as f64 + 0.5) + dice.between(-0.1, 0.1) * column;
            ([x, d / 2.0 + dice.between(-0.1, 0.1) * d], radius.min(0.38 * column.min(d)))
        })
        .collect();
    let mut parts = vec![("plate".to_owned(), drilled_plate([w, d, h], &holes))];
    for k in 1..count {
        let (x, y) = (dice.between(0.0, w - 6.0), dice.between(0.0, d - 6.0));
        let high = h + dice.between(4.0, 30.0);
        let name = format!("part-{}{}", (b'a' + (k / 26) as u8) as char, (b'a' + (k % 26) as u8) as char);
        parts.push((name, block([x, y, h], [x + dice.between(2.0, 6.0), y + dice.between(2.0, 6.0), high])));
    }
    let views = [
        "['front', 'top']",
        "['front', 'top', 'left']",
        "['front', 'top', 'iso']",
        "['front', 'top', 'left', 'iso']",
        "['top', 'right', 'iso']",
        "['front']",
    ][dice.below(6)];
    let mut text = format!(
        "[page]\nkind = 'sheet'\nmodel = {{ file = 'model.obj', up = 'z' }}\nsize = '{size}'\nviews = {views}\n"
    );
    text += &format!("projection = '{}'\n", ["first", "third"][dice.below(2)]);
    text += &format!("hidden = {}\n", dice.below(2) == 0);
    text += &format!("dimensions = '{}'\n", ["none", "overall", "auto", "auto"][dice.below(4)]);
    if count > 1 && dice.below(4) > 0 {
        text += "parts_list = true\n";
        if dice.below(3) == 0 && views.contains("top") {
            text += "balloons = 'top'\n";
        }
    }
    let notes: Vec<String> =
        (0..dice.below(4)).map(|k| format!("'{}. Remove burrs, break sharp edges (R0.2).'", k + 1)).collect();
    text += &format!("notes = [{}]\n", notes.join(", "));
    let is_seen = |view: &str| views.contains(view);
    for _ in 0..dice.below(3) {
        let plane = ["x=", "y=", "z="][dice.below(3)];
        text += &format!("[[page.section]]\nplane = '{plane}{:.0}%'\n", dice.between(15.0, 85.0));
    }
    for _ in 0..dice.below(3) {
        let of = if is_seen("top") { "top" } else { "front" };
        let [x, y] = holes[0].0;
        let radius = dice.between(3.0, 12.0);
        text += &format!("[[page.detail]]\nof = '{of}'\nat = [{x}, {y}, {h}]\nradius = {radius:.1}\n");
    }
    for _ in 0..dice.below(4) {
        let of = if is_seen("top") && dice.below(2) == 0 {
            "top"
        } else if is_seen("front") {
            "front"
        } else {
            "top"
        };
        let mut place = || {
            format!("[{:.1}, {:.1}, {:.1}]", dice.between(0.0, w), dice.between(0.0, d), dice.between(0.0, h))
        };
        let (from, to) = (place(), place());
        let measure = ["horizontal", "vertical", "aligned", "aligned"][dice.below(4)];
        text +=
            &format!("[[page.dimension]]\nof = '{of}'\nfrom = {from}\nto = {to}\nmeasure = '{measure}'\n");
    }
    let long = "Intermediate gearbox support with flanged connection to the main frame, left-hand variant";
    text += &format!("[page.title]\ntitle = '{}'\n", if dice.below(2) == 0 { long } else { "Support" });
    text += &format!(
        "department = '{}'\n",
        if dice.below(3) == 0 {
            "Mechanical design of special machines, group for gearboxes"
        } else {
            "Design"
        }
    );
    text +=
        &format!("owner = '{}'\nnumber = 'T-{seed}'\n", if dice.below(3) == 0 { long } else { "Workshop" });
    (text, obj_text(&parts))
}

/// Checks sheets. Returns the number of drawn sheets, and the faults.
fn check_sheets(seeds: std::ops::Range<u64>) -> (usize, Vec<String>) {
    let mut drawn = 0;
    let mut wrong = Vec::new();
    for seed in seeds {
        let folder = temp_folder(&format!("layout-{seed}"));
        let (text, model) = random_sheet(seed);
        if let Ok(kept) = std::env::var("LIGNE_KEEP_SHEETS") {
            let kept = std::path::Path::new(&kept).join(seed.to_string());
            fs::create_dir_all(&kept).expect("a folder");
            fs::write(kept.join("model.obj"), &model).expect("written");
            fs::write(kept.join("sheet.toml"), &text).expect("written");
        }
        fs::write(folder.join("model.obj"), model).expect("written");
        let composed = PageFile::from_text(&text, folder.join("sheet.toml")).expect("a page").compose();
        fs::remove_dir_all(&folder).expect("removed");
        match composed {
            Ok(composed) => {
                drawn += 1;
                wrong.extend(faults(&composed[0]).into_iter().map(|fault| format!("sheet {seed}: {fault}")));
            }
            Err(error) => {
                let message = error.to_string();
                eprintln!("sheet {seed}: {message}");
                let is_refused = ["fit", "no free place", "the cut runs beside"]
                    .iter()
                    .any(|known| message.contains(known));
                if !is_refused {
                    wrong.push(format!("sheet {seed}: {message}"));
                }
            }
        }
    }
    (drawn, wrong)
}

#[test]
fn texts_lines_and_balloons_on_a_sheet_do_not_overlap() {
    let (drawn, wrong) = check_sheets(0..SHEET_COUNT);
    assert!(wrong.is_empty(), "{} faults:\n{}", wrong.len(), wrong.join("\n"));
    assert!(drawn as u64 * 4 >= SHEET_COUNT * 3, "{drawn} of {SHEET_COUNT} were drawn");
}

#[test]
#[ignore = "100 sheets, minutes"]
fn texts_lines_and_balloons_on_100_sheets_do_not_overlap() {
    let (drawn, wrong) = check_sheets(0..NIGHTLY_SHEET_COUNT);
    eprintln!(
        "{drawn} of {NIGHTLY_SHEET_COUNT} sheets were drawn, the others refused; {} faults",
        wrong.len()
    );
    assert!(wrong.is_empty(), "{} faults:\n{}", wrong.len(), wrong.join("\n"));
    assert!(drawn as u64 * 4 >= NIGHTLY_SHEET_COUNT * 3, "{drawn} of {NIGHTLY_SHEET_COUNT} were drawn");
}
