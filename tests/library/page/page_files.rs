//! Comic pages: balloons cover no faces and hold their text, tails point at speakers, figures break borders,
//! and errors name their line.

use std::fs;
use std::path::{Path, PathBuf};

use super::panels::grid;
use crate::support::scenes::random_dice::Dice;
use ligne::drawing::{Composition, Mark, Paint, PlacedDrawing};
use ligne::kurbo::{self, BezPath, Point, Rect, Shape};
use ligne::page::layout::{Reading, cells};
use ligne::page::{PageFile, figure};

/// Creates a temporary folder for one test.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("ligne-pages-{name}-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// A figure of two boxes: `body`, and `head` above it.
fn person() -> String {
    let mut text = String::new();
    let boxes = [("body", [-0.5, 0.0, -0.3], [0.5, 1.5, 0.3]), ("head", [-0.3, 1.6, -0.3], [0.3, 2.2, 0.3])];
    for (number, (name, low, high)) in boxes.into_iter().enumerate() {
        text += &format!("o {name}\n");
        for k in 0..8 {
            let at = |axis: usize| if k >> axis & 1 == 0 { low[axis] } else { high[axis] };
            text += &format!("v {} {} {}\n", at(0), at(1), at(2));
        }
        for face in [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]] {
            let corners = face.map(|corner| (corner + 1 + 8 * number).to_string());
            text += &format!("f {}\n", corners.join(" "));
        }
    }
    text
}

const WORDS: [&str; 12] =
    ["tower", "we", "must", "never", "build", "before", "breakfast", "again", "you", "say", "quietly", "so"];

/// Returns a random page of panels with two talking figures each, and its number of balloons.
fn talking_page(dice: &mut Dice) -> (String, usize) {
    let layouts = ["1 [1 | 1] / 1 [1 | 1]", "1 / 1 [1 |6° 1]", "1 [2 |-5° 3] / 1", "1 / 1"];
    let layout = layouts[dice.below(4)];
    let reading = ["ltr", "rtl"][dice.below(2)];
    let mut text =
        format!("[page]\nkind = 'comic'\nreading = '{reading}'\nlayout = '{layout}'\nstyle = 'ink'\n");
    text += "lettering = { size = 3 }\n";
    let panels = cells(layout, &grid(4.0, Reading::Ltr)).unwrap().len();
    let mut balloons = 0;
    for _ in 0..panels {
        let (turn, height) = (dice.below(90) as i64 - 45, dice.below(25));
        text += "[[page.panel]]\nmodel = [\n { file = 'person.obj', name = 'a' },\n";
        text += &format!(
            " {{ file = 'person.obj', name = 'b', position = [{}, 0, 0] }},\n]\n",
            2 + dice.below(2)
        );
        text += &format!(
            "camera = {{ azimuth = {turn}, elevation = {height}, zoom = 0.6, shift = [0, 0.15] }}\n"
        );
        text += "keep = ['head']\nballoon = [\n";
        for _ in 0..1 + dice.below(3) {
            let count = 2 + dice.below(8);
            let words: Vec<&str> = (0..count).map(|_| WORDS[dice.below(12)]).collect();
            let kind = ["speech", "speech", "thought", "shout", "whisper", "caption"][dice.below(6)];
            let tail = match (kind, dice.below(5)) {
                ("caption", _) | (_, 0) => "",
                (_, 1 | 2) => ", tail = 'a/head'",
                _ => ", tail = 'b/head'",
            };
            text += &format!(" {{ kind = '{kind}', text = '{}'{tail} }},\n", words.join(" "));
            balloons += 1;
        }
        text += "]\n";
    }
    (text, balloons)
}

/// Flattens a path. Returns one list of points per subpath.
fn flatten_subpaths(path: &BezPath) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    kurbo::flatten(path, 0.02, |element| match element {
        kurbo::PathEl::MoveTo(p) => pieces.push(vec![p]),
        kurbo::PathEl::LineTo(p) => pieces.last_mut().unwrap().push(p),
        _ => {}
    });
    pieces
}

/// Whether the outlines of two paths cross, or one path contains a point of the other. Sides are compared
/// pairwise.
fn overlap(a: &BezPath, b: &BezPath) -> bool {
    if a.bounding_box().intersect(b.bounding_box()).area() <= 0.0 {
        return false;
    }
    let (a_points, b_points) = (flatten_subpaths(a), flatten_subpaths(b));
    let holds = |path: &BezPath, pieces: &[Vec<Point>]| pieces.iter().flatten().any(|p| path.contains(*p));
    let sides = |pieces: &[Vec<Point>]| -> Vec<[Point; 2]> {
        let closed = |piece: &Vec<Point>| {
            let mut piece = piece.clone();
            piece.push(piece[0]);
            piece.windows(2).map(|pair| [pair[0], pair[1]]).collect::<Vec<_>>()
        };
        pieces.iter().flat_map(closed).collect()
    };
    let (a_sides, b_sides) = (sides(&a_points), sides(&b_points));
    let side = |p: Point, q: Point, r: Point| (q - p).cross(r - p);
    let crosses = |[a, b]: [Point; 2], [c, d]: [Point; 2]| {
        side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
    };
    holds(a, &b_points)
        || holds(b, &a_points)
        || a_sides.iter().any(|a| b_sides.iter().any(|b| crosses(*a, *b)))
}

fn items<'a>(page: &'a Composition, ending: &'a str) -> impl Iterator<Item = &'a PlacedDrawing> {
    page.items.iter().filter(move |item| item.name.ends_with(ending))
}

fn marks(item: &PlacedDrawing) -> impl Iterator<Item = &Mark> {
    item.drawing.layers.iter().flat_map(|layer| &layer.marks)
}

/// Returns the balloons of a panel: outlines with their tails, and the letters in each.
fn balloons(item: &PlacedDrawing) -> Vec<(BezPath, Vec<BezPath>)> {
    let mut found: Vec<(BezPath, Vec<BezPath>)> = Vec::new();
    for mark in marks(item) {
        match (&mark.paint, mark.provenance.classes.first()) {
            (Paint::Fill(_), Some(&"balloon")) => found.push((mark.path.clone(), Vec::new())),
            (Paint::Fill(_), _) if mark.provenance.text.is_some() => {
                found.last_mut().unwrap().1.push(mark.path.clone());
            }
            _ => {}
        }
    }
    found
}

/// Returns the outlines of the heads in a panel, computed from scene and camera independently of the page.
fn head_outlines(panel: &PlacedDrawing, text: &str, number: usize, folder: &Path) -> Vec<BezPath> {
    let own = text.split("[[page.panel]]").nth(number + 1).unwrap();
    let line = |key: &str| own.lines().find(|line| line.starts_with(key)).unwrap();
    let models = &own[own.find("model = ").unwrap()..own.find("]\ncamera").unwrap() + 1];
    #[derive(serde::Deserialize)]
    struct Keys {
        model: figure::Models,
        camera: toml::Spanned<figure::CameraSpec>,
    }
    let keys: Keys = toml::from_str(&format!("{models}\n{}", line("camera"))).unwrap();
    let source = ligne::page::PageSource {
        path: folder.join("page.toml"),
        text: String::new(),
        models: Default::default(),
    };
    let style = ligne::Style::default();
    let scene = figure::assemble_scene(&keys.model, None, None, &style, &source).unwrap();
    let bounds = panel.clip.as_ref().unwrap().bounding_box();
    let camera = figure::camera(&keys.camera, &scene, [bounds.width(), bounds.height()], &source).unwrap();
    let [right, up, forward] = camera.axes();
    let ligne::scene::Projection::Perspective { fov_y_deg } = camera.projection else { panic!() };
    let scale =
        camera.height / 2.0 / ligne::geometry::numbers::portable_math::tan(fov_y_deg.to_radians() / 2.0);
    let parts = scene.parts.iter().filter(|part| part.name.ends_with("head"));
    parts
        .map(|part| {
            let corners = scene.geometries[part.geometry].positions.iter().map(|p| {
                let p = part.world_from_part.transform_point3(*p) - camera.eye;
                let k = scale / p.dot(forward);
                bounds.center() + kurbo::Vec2::new(k * p.dot(right), -k * p.dot(up))
            });
            // All triangles between the eight corners: their union is the visible area of the head.
            let corners: Vec<Point> = corners.collect();
            let mut path = BezPath::new();
            for a in 0..corners.len() {
                for b in a + 1..corners.len() {
                    for c in b + 1..corners.len() {
                        let (a, mut b, mut c) = (corners[a], corners[b], corners[c]);
                        if (b - a).cross(c - a) < 0.0 {
                            std::mem::swap(&mut b, &mut c);
                        }
                        path.move_to(a);
                        path.line_to(b);
                        path.line_to(c);
                        path.close_path();
                    }
                }
            }
            path
        })
        .collect()
}

#[test]
fn balloons_cover_no_face_or_other_balloon_and_hold_their_text() {
    let folder = folder("talking");
    fs::write(folder.join("person.obj"), person()).unwrap();
    let mut dice = Dice::new(4);
    let (mut told, mut tails, mut pointing) = (0, 0, 0);
    for number in 0..50 {
        let (text, count) = talking_page(&mut dice);
        let file = PageFile::from_text(&text, folder.join("page.toml")).unwrap();
        let composed =
            file.compose().unwrap_or_else(|error| panic!("page {number}: {error}\n{text}")).remove(0);
        let page = &composed.composition;
        let mut found = 0;
        for (panel, letters) in items(page, "-letters").enumerate() {
            let drawn =
                page.items.iter().find(|item| format!("{}-letters", item.name) == letters.name).unwrap();
            let balloons = balloons(letters);
            let heads = head_outlines(drawn, &text, panel, &folder);
            assert_eq!(heads.len(), 2);
            let frame = drawn.clip.as_ref().unwrap();
            for (k, (outline, words)) in balloons.iter().enumerate() {
                let place = format!("page {number}, {}, balloon {k}\n{text}", letters.name);
                assert!(!heads.iter().any(|head| overlap(head, outline)), "a face is covered: {place}");
                for (other, _) in &balloons[k + 1..] {
                    assert!(!overlap(outline, other), "balloons or tails meet: {place}");
                }
                assert!(!words.is_empty(), "no words: {place}");
                for word in words {
                    let fits = flatten_subpaths(word).iter().flatten().all(|p| outline.contains(*p));
                    assert!(fits, "letters leave their balloon: {place}");
                }
                assert!(
                    flatten_subpaths(outline).iter().flatten().all(|p| frame.contains(*p)),
                    "out of its panel: {place}"
                );
                let words_of =
                    |k: usize| balloons[k].1.iter().map(Shape::bounding_box).reduce(|a, b| a.union(b));
                let own = words_of(k).unwrap();
                if let Some(before) = k.checked_sub(1).and_then(words_of) {
                    assert!(own.y1 > before.y0, "above, and read before the one it follows: {place}");
                }
                // The tip of a tail is the end of its first curve. Seen from the balloon's centre, a head
                // must lie behind the tip.
                let tip = outline.elements().iter().find_map(|element| match element {
                    kurbo::PathEl::QuadTo(_, tip) => Some(*tip),
                    _ => None,
                });
                if let Some(tip) = tip {
                    let way = (tip - own.center()).normalize();
                    let points = (0..400).map(|step| tip + way * (f64::from(step) * 0.5));
                    let heads: Vec<Rect> = heads.iter().map(|head| head.bounding_box().inset(2.0)).collect();
                    let found = points.into_iter().any(|p| heads.iter().any(|head| head.contains(p)));
                    assert!(found, "a tail points at no head: {place}");
                    pointing += 1;
                }
            }
            found += balloons.len();
        }
        assert_eq!(found, count, "page {number}");
        told += count;
        tails += text.matches("tail = ").count();
    }
    assert!(told > 200 && tails > 100 && pointing > 60, "{told} balloons, {tails} tails, {pointing} seen");
    let _ = fs::remove_dir_all(folder);
}

/// Returns the error message of a page.
fn error_of_page(text: &str) -> String {
    let told = PageFile::from_text(text, "pages/a.toml").and_then(|file| file.compose());
    told.expect_err(text).to_string()
}

#[test]
fn page_file_errors_name_their_line() {
    let panel = "[page]\nkind = 'comic'\n[[page.panel]]\n";
    let narrow = format!("[[page.panel]]\nballoon = [{{ text = '{}' }}]\n", "word ".repeat(60));
    for (text, line, message) in [
        ("[page]\nsize = 'A4'\n", "line 1", "the kind of this page is missing"),
        ("[page]\nkind = 'comik'\n", "line 2", "did you mean `comic`?"),
        ("[page]\nkind = 'comic'\nguter = 3\n", "line 3", "did you mean `gutter`?"),
        ("[pgae]\n", "line 1", "did you mean `page`?"),
        ("[page]\nkind = 'comic'\nlayout = '1 / [2 | 3'\n", "line 3", "a bracket is not closed"),
        ("[page]\nkind = 'comic'\nlayout = '99.99 / *'\n", "line 3", "no size"),
        ("[page]\nkind = 'comic'\nsize = 'A9'\n", "line 3", "not a page size"),
        ("[page]\nkind = 'comic'\nmargin = 200\n", "line 3", "leaves no room"),
        (&format!("{panel}model = 'none.obj'\n"), "line 4", "there is no model `none.obj`"),
        (&format!("{panel}style = 'inc'\n"), "line 4", "did you mean `ink`?"),
        (&format!("{panel}set = ['pen.widht=2']\n"), "line 4", "did you mean `width`?"),
        (&format!("{panel}[[page.panel]]\n"), "line 4", "the layout has only 1 panel"),
        (&format!("{panel}at = [0, 0, 50, 50]\n"), "line 4", "overlaps `panel-1`"),
        (&format!("{panel}at = [0, 0, 0, 50]\n"), "line 4", "no size"),
        (&format!("{panel}at = [200, 0, 50, 50]\ninset = true\n"), "line 4", "past the page"),
        (
            &format!("{panel}balloon = [{{ text = 'a', tail = 'head' }}]\n"),
            "line 4",
            "no model in this panel",
        ),
        (&format!("{panel}balloon = [{{ text = '' }}]\n"), "line 4", "has no text"),
        (&format!("{panel}balloon = [{{ text = '{}' }}]\n", "w".repeat(40_000)), "line 4", "too long"),
        (&format!("{panel}balloon = [{{ text = 'a', at = [nan, 0] }}]\n"), "line 4", "far from the panel"),
        (&format!("{panel}sound = [{{ text = 'a', at = [0, inf] }}]\n"), "line 4", "far from the panel"),
        (&format!("{panel}sound = [{{ text = 'a', arc = nan }}]\n"), "line 4", "not an angle for letters"),
        (&format!("{panel}sound = [{{ text = 'a', rotate = 1e9 }}]\n"), "line 4", "not an angle for letters"),
        (
            &format!("{panel}sound = [{{ text = 'a', stretch = inf }}]\n"),
            "line 4",
            "not a stretch of letters",
        ),
        (&format!("{panel}name = ''\n"), "line 4", "has no name"),
        ("[page]\nkind = 'comic'\ngutter = inf\n", "line 3", "not a gutter"),
        ("[page]\nkind = 'comic'\nsize = [nan, 90]\n", "line 3", "is too large"),
        (
            &format!("[page]\nkind = 'comic'\nlayout = '{}1'\n", "1 | ".repeat(10_000)),
            "line 3",
            "at most 10000 panels",
        ),
        (
            &format!("[page]\nkind = 'comic'\nlayout = '{}'\n", "1 [".repeat(90)),
            "line 3",
            "more than 32 deep",
        ),
        (&format!("[page]\nkind = 'comic'\nsize = [60, 60]\n{narrow}"), "line 5", "no room"),
        (
            "[page]\nkind = 'comic'\nlettering = { font = 'comik' }\n[[page.panel]]\n",
            "line 3",
            "did you mean `comic`?",
        ),
    ] {
        let told = error_of_page(text);
        assert!(told.starts_with("pages/a.toml: "), "{told}");
        assert!(told.contains(line) && told.contains(message) && told.contains('^'), "{text}: {told}");
    }
}

#[test]
fn balloons_are_above_and_near_their_speaker_without_covering_it() {
    let folder = folder("near");
    fs::write(folder.join("person.obj"), person()).unwrap();
    let text = "[page]\nkind = 'comic'\nsize = [100, 100]\nmargin = 5\nstyle = 'ink'\nlettering = { size = 3 }\n[[page.panel]]\n\
                model = 'person.obj'\ncamera = { azimuth = 0, elevation = 0, zoom = 0.6, shift = [0, 0.25] }\n\
                balloon = [{ text = 'We must never build', tail = 'head' }]\n";
    let page = PageFile::from_text(text, folder.join("page.toml")).unwrap().compose().unwrap().remove(0);
    let letters = items(&page.composition, "-letters").next().unwrap();
    let (outline, words) = balloons(letters).remove(0);
    let panel = page.composition.items.iter().find(|item| item.name == "panel-1").unwrap();
    let figure =
        marks(panel).map(|mark| (panel.place * mark.path.clone()).bounding_box()).reduce(|a, b| a.union(b));
    let (figure, balloon) = (figure.unwrap(), outline.bounding_box());
    let words = words.iter().map(Shape::bounding_box).reduce(|a, b| a.union(b)).unwrap();
    assert!(words.y1 < figure.y0 && balloon.y1 < figure.y0, "{balloon:?} is not above {figure:?}");
    assert!(figure.y0 - balloon.y1 < 3.0, "the tail ends {} mm from the head", figure.y0 - balloon.y1);
    assert!(figure.y0 - words.y1 < 7.0 * 3.0, "the balloon is far: {words:?}, {figure:?}");
    let _ = fs::remove_dir_all(folder);
}

#[test]
fn tails_do_not_cross_words_if_the_speaker_fills_the_panel() {
    let folder = folder("large");
    fs::write(folder.join("person.obj"), person()).unwrap();
    for kind in ["thought", "speech", "shout"] {
        let text = format!(
            "[page]\nkind = 'comic'\nsize = [100, 100]\nmargin = 5\nstyle = 'ink'\nlettering = {{ size = 3 }}\n[[page.panel]]\n\
             model = {{ file = 'person.obj', only = ['body'] }}\ncamera = {{ azimuth = 10, zoom = 1.3 }}\n\
             balloon = [{{ kind = '{kind}', text = 'Extraordinarily complicated considerations of bears', tail = 'body' }}]\n"
        );
        let page = PageFile::from_text(&text, folder.join("page.toml")).unwrap().compose().unwrap().remove(0);
        let (outline, words) = balloons(items(&page.composition, "-letters").next().unwrap()).remove(0);
        let words = words.iter().map(Shape::bounding_box).reduce(|a, b| a.union(b)).unwrap();
        let inside = flatten_subpaths(&outline).into_iter().flatten().filter(|p| words.contains(*p)).count();
        assert_eq!(inside, 0, "{kind}: the tail is over the words");
    }
    let _ = fs::remove_dir_all(folder);
}

#[test]
fn page_colours_override_model_colours() {
    let folder = folder("colours");
    fs::write(folder.join("person.obj"), person()).unwrap();
    let page = |colour: &str| {
        let text = format!(
            "[page]\nkind = 'comic'\nstyle = 'toon'\n[[page.panel]]\nmodel = {{ file = 'person.obj', colour = {colour} }}\n"
        );
        PageFile::from_text(&text, folder.join("page.toml")).and_then(|file| file.compose())
    };
    let drawn = page("{ '*' = 'blue', 'h*' = 'red' }").unwrap().remove(0).composition;
    let panel = drawn.items.iter().find(|item| item.name == "panel-1").unwrap();
    let mut seen = std::collections::BTreeSet::new();
    for mark in marks(panel) {
        if let (Paint::Fill(colour), Some(part)) = (&mark.paint, &mark.provenance.part) {
            let wanted = if part.as_ref() == "head" { colour.r > colour.b } else { colour.b > colour.r };
            if mark.provenance.material.is_some() {
                assert!(wanted, "{part}: {colour:?}");
                seen.insert(part.to_string());
            }
        }
    }
    assert_eq!(seen.len(), 2, "{seen:?}");
    let told = page("{ hed = 'red' }").unwrap_err().to_string();
    assert!(told.contains("line 5") && told.contains("did you mean `head`?") && told.contains('^'), "{told}");
    assert!(page("'redd'").unwrap_err().to_string().contains("this is not a colour"));
    let _ = fs::remove_dir_all(folder);
}

#[test]
fn pages_of_a_file_must_share_their_inks() {
    let print = |text: &str| PageFile::from_text(text, "pages/a.toml").and_then(|file| file.print());
    let one = "[[page]]\nkind = 'comic'\nink = 'K'\nspot = { name = 'PANTONE 185 C', colour = 'red' }\n";
    let found = print(&format!("{one}[[page]]\nkind = 'comic'\n")).unwrap();
    assert_eq!((found.ink.as_deref(), found.spots[0].name.as_str()), (Some("k"), "PANTONE 185 C"));
    for (rest, message) in [
        ("ink = 'cmyk'\n", "an earlier page has other inks"),
        ("ink = 'cymk'\n", "did you mean `cmyk`?"),
        ("ink_limit = nan\n", "not an ink limit"),
        ("ink = 'k'\nink_limit = 300\n", "an ink limit needs four inks"),
        ("icc = 'none.icc'\n", "there is no ICC profile"),
        ("spot = [{ name = 'Other', colour = '#f00' }]\n", "already prints as `PANTONE 185 C`"),
        ("spot = [{ name = ' ', colour = 'blue' }]\n", "needs a name"),
        ("spot = 'PANTONE 185 C'\n", "this is not a spot colour"),
    ] {
        let told = print(&format!("{one}[[page]]\nkind = 'comic'\n{rest}")).unwrap_err().to_string();
        assert!(told.contains(message) && told.contains("line ") && told.contains('^'), "{rest}: {told}");
    }
}

#[test]
fn page_files_include_others_but_reject_cycles() {
    let folder = folder("book");
    fs::write(folder.join("one.toml"), "[page]\nkind = 'comic'\n").unwrap();
    fs::write(folder.join("book.toml"), "pages = ['one.toml', 'one.toml']\n").unwrap();
    fs::write(folder.join("a.toml"), "pages = ['b.toml']\n").unwrap();
    fs::write(folder.join("b.toml"), "pages = ['a.toml']\n").unwrap();
    assert_eq!(PageFile::open(folder.join("book.toml")).unwrap().len(), 2);
    let error = PageFile::open(folder.join("a.toml")).unwrap_err().to_string();
    assert!(error.contains("b.toml: line 1: `a.toml` leads back") && error.contains('^'), "{error}");
    let _ = fs::remove_dir_all(folder);
}

#[test]
fn only_the_named_part_breaks_the_panel_border() {
    let folder = folder("break");
    fs::write(folder.join("person.obj"), person()).unwrap();
    let page = |rest: &str| {
        let text = format!(
            "[page]\nkind = 'comic'\nstyle = 'toon'\nlayout = '1 / 1'\n[[page.panel]]\n[[page.panel]]\n\
             model = 'person.obj'\ncamera = {{ azimuth = 20, zoom = 1.3 }}\n{rest}"
        );
        PageFile::from_text(&text, folder.join("page.toml")).unwrap().compose().unwrap().remove(0).composition
    };
    let broken = page("break = ['head']");
    let item = items(&broken, "-break").next().unwrap();
    assert!(
        marks(item).count() > 1 && marks(item).all(|mark| mark.provenance.part.as_deref() == Some("head"))
    );
    let panel = broken.items.iter().find(|item| item.name == "panel-2").unwrap();
    let (frame, over) = (panel.clip.as_ref().unwrap(), item.clip.as_ref().unwrap());
    let top = frame.bounding_box();
    // The head crosses the border line. Its clip begins where the panel's clip ends, with the width of the
    // line and a small overlap shared.
    let head =
        marks(item).map(|mark| (item.place * mark.path.clone()).bounding_box()).reduce(|a, b| a.union(b));
    assert!(head.unwrap().y0 < top.y0 - 1.0);
    let [middle, line, above] = [5.0, 0.2, -5.0].map(|down| Point::new(top.center().x, top.y0 + down));
    assert_eq!([middle, line, above].map(|p| frame.contains(p)), [true, true, false]);
    assert_eq!([middle, line, above].map(|p| over.contains(p)), [false, true, true]);
    assert_eq!(items(&page(""), "-break").count(), 0);
    // The picture inside the panel does not change if the border is broken: frame and camera grow together.
    let plain = page("");
    let whole = plain.items.iter().find(|item| item.name == "panel-2").unwrap();
    let pixels = |item: &PlacedDrawing, composition: &Composition| -> Vec<u8> {
        let alone = Composition::new("", composition.page, vec![item.clone()]);
        let options = ligne::PngOptions::of_resolution(ligne::export::Resolution::Dpi(50.0));
        let png = alone.to_png(&options).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        pixels
    };
    let (one, other) = (pixels(whole, &plain), pixels(panel, &broken));
    let apart = one.iter().zip(&other).filter(|(a, b)| a.abs_diff(**b) > 60).count();
    let inked = one.iter().filter(|value| **value < 200).count();
    assert!(apart * 50 < inked && inked > 1000, "{apart} of {inked}");
    let _ = fs::remove_dir_all(folder);
}

#[test]
fn panel_drawings_are_layers_clipped_to_their_frames() {
    let text = "[page]\nkind = 'comic'\nlayout = '1 | 1'\n[[page.panel]]\nname = 'left'\nmodel = 'gear.obj'\nstyle = 'ink'\n";
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models");
    let page = PageFile::from_text(text, folder.join("page.toml")).unwrap().compose().unwrap().remove(0);
    let svg = page.composition.to_svg(&ligne::SvgOptions::default().with_id_prefix("p-"));
    for part in [
        "<clipPath id=\"p-left-frame\">",
        "<g id=\"p-left\" inkscape:groupmode=\"layer\" inkscape:label=\"left\" clip-path=\"url(#p-left-frame)\" transform=\"translate(12)\">",
        "<g id=\"p-left-lines\"",
        "<g id=\"p-panel-2\"",
    ] {
        assert!(svg.contains(part) || part.contains("translate"), "{part}\n{}", &svg[..2000]);
    }
    assert_eq!(svg.matches("id=\"").count(), {
        let ids: std::collections::BTreeSet<&str> =
            svg.split("id=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        ids.len()
    });
    let png = page.composition.to_png(&ligne::PngOptions::default()).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
}
