//! Technical sheets: sizes from the standards, aligned views, sections, centre lines and error messages.

use std::fs;

use ligne::drawing::{Mark, Paint, PlacedDrawing};
use ligne::kurbo::{Point, Rect, Shape};
use ligne::page::{ComposedPage, PageFile};

use crate::library::support::scenes::sheet_models::{
    block, drawn_bounds, item_texts, obj_text, page_item, placed_marks, temp_folder,
};
use crate::library::support::scenes::solids::Solid;

/// Composes a sheet with these keys, of a stepped block of 60 x 30 x 40.
fn sheet(name: &str, keys: &str) -> Result<ComposedPage, ligne::Error> {
    let folder = temp_folder(name);
    let mut step = block([0.0, 0.0, 0.0], [60.0, 30.0, 20.0]);
    step.add(block([0.0, 0.0, 20.0], [25.0, 30.0, 40.0]));
    fs::write(folder.join("step.obj"), obj_text(&[("step".into(), step)])).expect("written");
    let text = format!("[page]\nkind = 'sheet'\nmodel = {{ file = 'step.obj', up = 'z' }}\n{keys}");
    let composed = PageFile::from_text(&text, folder.join("sheet.toml"))?.compose()?;
    fs::remove_dir_all(&folder).expect("removed");
    Ok(composed.into_iter().next().expect("a page"))
}

pub(crate) fn width(mark: &Mark) -> f64 {
    match &mark.paint {
        Paint::Stroke(stroke) => stroke.width,
        _ => 0.0,
    }
}

fn rects_are_near(a: Rect, b: Rect) -> bool {
    [a.x0 - b.x0, a.y0 - b.y0, a.x1 - b.x1, a.y1 - b.y1].into_iter().all(|d| d.abs() < 0.01)
}

/// Whether a stroke with this width has this bounding box.
fn has_stroke(item: &PlacedDrawing, wide: f64, rect: Rect) -> bool {
    placed_marks(item).any(|(_, mark)| width(mark) == wide && rects_are_near(mark.path.bounding_box(), rect))
}

#[test]
fn frames_and_title_blocks_follow_iso_5457_and_iso_7200() {
    for (name, w, h) in [
        ("A4", 210.0, 297.0),
        ("A3", 420.0, 297.0),
        ("A2", 594.0, 420.0),
        ("A1", 841.0, 594.0),
        ("A0", 1189.0, 841.0),
    ] {
        let composed = sheet(name, &format!("size = '{name}'\nviews = ['front']\n")).expect("a sheet");
        let page = composed.composition.page;
        assert_eq!([page.width, page.height], [w, h], "{name}");
        let frame = page_item(&composed, "frame");
        // ISO 5457, 4.2 and 4.4: margins of 20 mm on the left and 10 mm elsewhere, a frame 0.7 mm wide, and
        // zones in a band of 5 mm.
        assert!(has_stroke(frame, 0.7, Rect::new(20.0, 10.0, w - 10.0, h - 10.0)), "{name}");
        assert!(has_stroke(frame, 0.35, Rect::new(15.0, 5.0, w - 5.0, h - 5.0)), "{name}");
        // Centring marks on both axes of the sheet, from the outer border of the zones to 10 mm inside the
        // frame.
        let (x, y) = (w / 2.0, h / 2.0);
        for mark in [
            Rect::new(15.0, y, 30.0, y),
            Rect::new(w - 20.0, y, w - 5.0, y),
            Rect::new(x, 5.0, x, 20.0),
            // They stop at the title block, which spans the full width of an A4 sheet.
            Rect::new(x, if name == "A4" { h - 10.0 } else { h - 20.0 }, x, h - 5.0),
        ] {
            assert!(has_stroke(frame, 0.7, mark), "{name}: {mark:?}");
        }
        // Trimming marks of 10 x 5 mm at the corners.
        for (px, py) in [(0.0, 0.0), (w, 0.0), (0.0, h), (w, h)] {
            for (a, b) in [(10.0, 5.0), (5.0, 10.0)] {
                let corner =
                    Point::new(if px > 0.0 { w - a } else { 0.0 }, if py > 0.0 { h - b } else { 0.0 });
                let own = Rect::from_origin_size(corner, (a, b));
                assert!(
                    placed_marks(frame).any(|(_, m)| rects_are_near(m.path.bounding_box(), own)),
                    "{name}: {own:?}"
                );
            }
        }
        // Zones of 50 mm, starting at the middle.
        for k in 0..2 {
            let line = x + 50.0 * f64::from(k);
            assert!(has_stroke(frame, 0.35, Rect::new(line, 5.0, line, 10.0)), "{name}");
        }
        // ISO 7200: the title block is 180 mm wide, in the lower right corner.
        let title = drawn_bounds(page_item(&composed, "title-block"));
        assert!(
            rects_are_near(title, Rect::new(w - 190.0, title.y0, w - 10.0, h - 10.0)),
            "{name}: {title:?}"
        );
        let letters = item_texts(frame);
        assert!(letters.contains(&"A".to_owned()) && !letters.iter().any(|c| c == "I" || c == "O"));
    }
}

#[test]
fn views_are_aligned_and_share_one_scale() {
    let keys = "views = ['front', 'top', 'left', 'right', 'bottom', 'back', 'iso']\noverall = false\n";
    for method in ["first", "third"] {
        let composed =
            sheet(&format!("line-{method}"), &format!("projection = '{method}'\nsize = 'A2'\n{keys}"));
        let composed = composed.expect("a sheet");
        let of = |name: &str| drawn_bounds(page_item(&composed, name));
        let [front, top, left, right, bottom, back] =
            ["front", "top", "left", "right", "bottom", "back"].map(of);
        let same = |a: f64, b: f64| (a - b).abs() < 0.001;
        for view in [top, bottom] {
            assert!(same(view.x0, front.x0) && same(view.x1, front.x1), "{method}: {view:?} {front:?}");
        }
        for view in [left, right, back] {
            assert!(same(view.y0, front.y0) && same(view.y1, front.y1), "{method}: {view:?} {front:?}");
        }
        let first = method == "first";
        assert_eq!([left.x0 > front.x1, top.y0 > front.y1], [first; 2], "{method}");
        assert_eq!([right.x0 > front.x1, bottom.y0 > front.y1], [!first; 2], "{method}");
        let scale = front.width() / 60.0;
        assert!([0.5, 1.0, 2.0].iter().any(|known| same(scale, *known)), "{scale}");
        assert!(same(front.height(), 40.0 * scale) && same(top.height(), 30.0 * scale));
        // No views overlap.
        let views = [front, top, left, right, bottom, back, of("iso"), of("title-block")];
        for (k, a) in views.iter().enumerate() {
            for b in &views[..k] {
                let both = a.intersect(*b);
                assert!(both.width() <= 0.0 || both.height() <= 0.0, "{method}: {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn given_scales_are_used_or_rejected_if_they_do_not_fit() {
    let told = sheet("told", "scale = '1:2'\nviews = ['front']\n").expect("a sheet");
    assert!((drawn_bounds(page_item(&told, "front")).width() - 30.0).abs() < 0.001);
    assert!(item_texts(page_item(&told, "title-block")).contains(&"1:2".to_owned()));
    let inches = sheet("inches", "scale = '1:10'\nunit = 'in'\nviews = ['front']\n").expect("a sheet");
    assert!((drawn_bounds(page_item(&inches, "front")).width() - 152.4).abs() < 0.001);
    let error = sheet("large", "scale = '10:1'\n").expect_err("too large");
    assert!(error.to_string().contains("do not fit"), "{error}");
}

#[test]
fn dimensions_show_the_true_lengths() {
    let keys = "views = ['front', 'top', 'left']\n\
        [[page.dimension]]\nfrom = [25, 0, 40]\nto = [60, 0, 20]\nmeasure = 'horizontal'\n\
        [[page.dimension]]\nfrom = [0, 0, 0]\nto = [30, 0, 40]\n\
        [[page.dimension]]\nof = 'top'\nfrom = [0, 0, 0]\nto = [0, 30, 0]\nmeasure = 'vertical'\ntext = 'all'\n";
    let composed = sheet("lengths", keys).expect("a sheet");
    let told = item_texts(page_item(&composed, "notes"));
    for value in ["60", "40", "30", "35", "50", "all"] {
        assert!(told.contains(&value.to_owned()), "{value} of {told:?}");
    }
}

#[test]
fn sections_replace_their_view_and_details_are_round() {
    let keys = "views = ['top', 'left']\n[[page.section]]\nplane = 'y=15'\n\
        [[page.detail]]\nof = 'top'\nat = [25, 0, 40]\nradius = 5\n";
    let composed = sheet("section", keys).expect("a sheet");
    let section = page_item(&composed, "section-A");
    let patterns: Vec<&Mark> = placed_marks(section)
        .map(|(_, mark)| mark)
        .filter(|mark| mark.provenance.classes == ["pattern"])
        .collect();
    assert!(!patterns.is_empty());
    let [own, top] = ["section-A", "top"].map(|name| drawn_bounds(page_item(&composed, name)));
    assert!((own.x0 - top.x0).abs() < 0.001 && own.y1 < top.y0);
    let told = item_texts(page_item(&composed, "notes"));
    assert!(told.contains(&"A-A".to_owned()), "{told:?}");
    assert_eq!(told.iter().filter(|word| *word == "A").count(), 2, "{told:?}");
    let detail = page_item(&composed, "detail-B");
    assert!(detail.clip.is_none());
    let scale = top.width() / 60.0;
    let circle = placed_marks(page_item(&composed, "notes")).map(|(_, mark)| mark.path.bounding_box());
    let circle = circle
        .filter(|own| (own.width() - 10.0 * 5.0 * scale).abs() < 0.02)
        .max_by(|a, b| a.x0.total_cmp(&b.x0));
    let circle = circle.expect("a circle");
    // The lines of the detail end at the circle.
    let mut reach = 0.0_f64;
    for (place, mark) in placed_marks(detail) {
        for element in (place * mark.path.clone()).elements() {
            let p = element.end_point().unwrap_or(circle.center());
            reach = reach.max((p - circle.center()).hypot());
        }
    }
    assert!((reach - circle.width() / 2.0).abs() < 0.02, "{reach} {circle:?}");
    assert!(told.iter().any(|word| word.starts_with("B (")), "{told:?}");
}

#[test]
fn cylinder_axes_are_drawn_as_crosses_and_centre_lines() {
    let folder = temp_folder("centre");
    let mut pin = Solid::default();
    // A prism of 48 sides around the z axis: radius 10, from z = 0 to 30.
    for k in 0..48 {
        let angle = std::f64::consts::TAU * f64::from(k) / 48.0;
        let (x, y) = (
            10.0 * ligne::geometry::numbers::portable_math::cos(angle),
            10.0 * ligne::geometry::numbers::portable_math::sin(angle),
        );
        pin.positions.extend([glam::DVec3::new(x, y, 0.0), glam::DVec3::new(x, y, 30.0)]);
    }
    for k in 0..48u32 {
        let [a, b] = [2 * k, 2 * ((k + 1) % 48)];
        pin.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1], [0, b, a], [1, a + 1, b + 1]]);
    }
    fs::write(folder.join("pin.obj"), obj_text(&[("pin".into(), pin)])).expect("written");
    let text = "[page]\nkind = 'sheet'\nmodel = { file = 'pin.obj', up = 'z' }\nviews = ['front', 'top']\noverall = false\n";
    let page = PageFile::from_text(text, folder.join("a.toml")).expect("a page");
    let composed = page.compose().expect("drawn").remove(0);
    fs::remove_dir_all(&folder).expect("removed");
    let [front, top] = ["front", "top"].map(|name| drawn_bounds(page_item(&composed, name)));
    let lines: Vec<Rect> =
        placed_marks(page_item(&composed, "notes")).map(|(_, mark)| mark.path.bounding_box()).collect();
    let middle = front.center().x;
    let axis = Rect::new(middle, front.y0 - 2.5, middle, front.y1 + 2.5);
    assert!(lines.iter().any(|line| rects_are_near(*line, axis)), "{lines:?}");
    let centre = top.center();
    let arm = Rect::new(centre.x, centre.y, top.x1 + 2.5, centre.y);
    assert!(lines.iter().any(|line| rects_are_near(*line, arm)), "{lines:?} {arm:?}");
    assert_eq!(lines.len(), 5);
}

#[test]
fn explosion_of_single_parts_can_be_set() {
    let folder = temp_folder("told-parts");
    let parts = [
        ("plate".into(), block([0.0, 0.0, 0.0], [40.0, 40.0, 5.0])),
        ("lid".into(), block([0.0, 0.0, 5.0], [40.0, 40.0, 10.0])),
    ];
    fs::write(folder.join("two.obj"), obj_text(&parts)).expect("written");
    let proportion = |told: &str| {
        let text = format!(
            "[page]\nkind = 'sheet'\nscale = '1:1'\nviews = ['front']\nmodel = {{ file = 'two.obj', up = 'z' }}\n\
             [page.exploded]\naxis = 'z'\nview = 'front'\n{told}"
        );
        let page =
            PageFile::from_text(&text, folder.join("sheet.toml")).expect("a page").compose().expect("drawn");
        let bounds = drawn_bounds(page_item(&page[0], "exploded"));
        bounds.height() / bounds.width()
    };
    let (found, told) =
        (proportion(""), proportion("[[page.exploded.part]]\nname = 'l?d'\nalong = '-z'\ndistance = 60\n"));
    fs::remove_dir_all(&folder).expect("removed");
    // The lid ends 60 below the top of the plate, which is 40 wide. The box bounds the centre lines of
    // strokes.
    assert!((told - 1.5).abs() < 0.07 && found < 0.5, "{found} {told}");
}

#[test]
fn sheet_errors_name_their_place() {
    for (keys, told) in [
        ("views = ['frnt']\n", "did you mean `front`?"),
        ("vews = ['front']\n", "vews"),
        ("projection = 'second'\n", "second"),
        ("scale = 'big'\n", "this is not a scale"),
        ("unit = 'furlong'\n", "furlong"),
        ("[[page.section]]\nplane = 'w'\n", "this is not a plane"),
        ("[[page.section]]\nplane = 'x=1000'\n", "misses the model"),
        ("[[page.dimension]]\nof = 'back'\nfrom = [0,0,0]\nto = [1,0,0]\n", "no view on this sheet"),
        ("[[page.detail]]\nat = [0,0,0]\nradius = -1\n", "not a radius"),
        ("[page.exploded]\naxis = 'w'\n", "no axis"),
        ("[[page.exploded.part]]\nname = 'wheel'\n", "no part has"),
        ("[[page.exploded.part]]\nname = '*'\nalong = 'w'\n", "no direction"),
        ("[[page.exploded.part]]\nname = '*'\ndistance = inf\n", "not a number"),
        ("[page.title]\nheading = 'a'\n", "heading"),
        ("font = 'none such'\n", "none such"),
    ] {
        let error = sheet("wrong", keys).expect_err(keys);
        assert!(error.to_string().contains(told), "{keys}: {error}");
        assert!(error.file.is_some(), "{keys}: {error}");
    }
    let error =
        PageFile::from_text("[page]\nkind = 'sheet'\n", "a.toml").expect("read").compose().expect_err("none");
    assert!(error.to_string().contains("has no model"), "{error}");
}
