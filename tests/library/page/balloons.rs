//! Balloons of comic pages: they cover no faces and hold their text, and their tails point at speakers.

use std::fs;
use std::path::Path;

use super::page_files::{folder, items, marks, person};
use super::panels::grid;
use crate::library::support::scenes::random_dice::Dice;
use ligne::drawing::{Paint, PlacedDrawing};
use ligne::kurbo::{self, BezPath, Point, Rect, Shape};
use ligne::page::layout::{Reading, cells};
use ligne::page::{PageFile, figure};

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
