//! Texts on technical sheets: long titles, notes, parts lists, other scripts, centre lines of sections, and
//! details.

use std::fs;

use ligne::kurbo::{Rect, Shape};
use ligne::page::{ComposedPage, PageFile};

use crate::library::support::scenes::sheet_models::{
    block, drawn_bounds, drilled_plate, item_texts, obj_text, page_item, placed_marks, temp_folder,
};
use crate::library::support::scenes::solids::Solid;

/// Composes a sheet of these parts with these keys.
fn sheet(name: &str, parts: &[(String, Solid)], keys: &str) -> Result<ComposedPage, ligne::Error> {
    let folder = temp_folder(name);
    fs::write(folder.join("model.obj"), obj_text(parts)).expect("written");
    let text = format!("[page]\nkind = 'sheet'\nmodel = {{ file = 'model.obj', up = 'z' }}\n{keys}");
    let composed = PageFile::from_text(&text, folder.join("sheet.toml"))?.compose();
    fs::remove_dir_all(&folder).expect("removed");
    Ok(composed?.into_iter().next().expect("a page"))
}

fn plate() -> Vec<(String, Solid)> {
    vec![("plate".into(), block([0.0; 3], [90.0, 50.0, 8.0]))]
}

/// Returns the texts of an item with their bounding boxes and capital heights.
fn texts(composed: &ComposedPage, name: &str) -> Vec<(String, Rect, f64)> {
    let own = placed_marks(page_item(composed, name)).filter_map(|(place, mark)| {
        let text = mark.provenance.text.as_ref()?;
        let [a, b, ..] = (place * text.place).as_coeffs();
        let capitals = (a * a + b * b).sqrt() * text.font.cap_height;
        Some((text.words.to_string(), (place * mark.path.clone()).bounding_box(), capitals))
    });
    own.collect()
}

fn rects_are_disjoint(a: Rect, b: Rect) -> bool {
    let both = a.intersect(b);
    both.width() <= 0.0 || both.height() <= 0.0
}

const LONG_TITLE: &str =
    "Intermediate gearbox support with flanged connection to the main frame, left-hand variant";

#[test]
fn long_title_block_texts_wrap_without_overlap() {
    for size in ["A4", "A2"] {
        let keys = format!(
            "size = '{size}'\nviews = ['front']\n[page.title]\ntitle = '{LONG_TITLE}'\nsubtitle = '{LONG_TITLE}'\nowner = '{LONG_TITLE}'\n\
             department = '{LONG_TITLE}'\nreference = '{LONG_TITLE}'\nstatus = '{LONG_TITLE}'\ncreator = '{LONG_TITLE}'\ntolerances = '{LONG_TITLE} {LONG_TITLE}'\n\
             number = '{}'\n",
            "N-0123456789".repeat(8)
        );
        let composed = sheet(&format!("long-{size}"), &plate(), &keys).expect("a sheet");
        let texts = texts(&composed, "title-block");
        let whole: Vec<&str> = texts.iter().map(|(words, ..)| words.as_str()).collect();
        // No text is cut off.
        assert!(whole.join(" ").matches("left-hand").count() >= 9, "{whole:?}");
        for (k, (words, rect, capitals)) in texts.iter().enumerate() {
            assert!(*capitals > 1.8 - 1e-9, "{words}: {capitals}");
            assert!(texts[..k].iter().all(|(_, other, _)| rects_are_disjoint(*rect, *other)), "{words}");
        }
        let block = drawn_bounds(page_item(&composed, "title-block"));
        assert!(texts.iter().all(|(_, rect, _)| block.contains_rect(*rect)));
        assert!(rects_are_disjoint(drawn_bounds(page_item(&composed, "front")), block));
    }
    let endless =
        format!("size = 'A4'\nviews = ['front']\n[page.title]\nowner = '{}'\n", "word ".repeat(350));
    let error = sheet("endless", &plate(), &endless).expect_err("too long");
    assert!(
        error.to_string().contains("`owner`") && error.to_string().contains("sheet.toml: line"),
        "{error}"
    );
}

#[test]
fn notes_and_centring_marks_do_not_overlap_tables() {
    for size in ["A4", "A3"] {
        for list in ["", "parts_list = true\n"] {
            let keys = format!(
                "size = '{size}'\nviews = ['front', 'iso']\nnotes = ['1. Remove burrs.', '2. Paint.']\n{list}"
            );
            let composed = sheet("notes", &plate(), &keys).expect("a sheet");
            let mut tables = vec![drawn_bounds(page_item(&composed, "title-block"))];
            if !list.is_empty() {
                tables.push(drawn_bounds(page_item(&composed, "parts-list")));
            }
            let notes = texts(&composed, "notes");
            assert!(notes.iter().any(|(words, ..)| words == "2. Paint."));
            for (words, rect, _) in &notes {
                assert!(tables.iter().all(|table| rects_are_disjoint(*rect, *table)), "{size}: {words}");
            }
            for (_, mark) in placed_marks(page_item(&composed, "frame")) {
                let own = mark.path.bounding_box();
                let is_mark = own.width().min(own.height()) == 0.0;
                let inside =
                    |table: &Rect| rects_are_disjoint(own.inflate(0.1, 0.1), table.inflate(-0.2, -0.2));
                assert!(!is_mark || tables.iter().all(inside), "{size}: {own:?}");
            }
        }
    }
}

#[test]
fn parts_share_a_row_if_their_shapes_are_equal() {
    let turned = |solid: Solid| solid.moved(|p| glam::DVec3::new(40.0 - p.y, p.x + 7.0, p.z + 3.0));
    let parts: Vec<(String, Solid)> = vec![
        ("bearing.001".into(), block([0.0; 3], [8.0, 6.0, 3.0])),
        ("bearing.002".into(), block([20.0, 0.0, 0.0], [28.0, 6.0, 3.5])),
        ("bearing.003".into(), turned(block([0.0; 3], [8.0, 6.0, 3.0]))),
        ("bearing.004".into(), block([40.0, 0.0, 0.0], [48.02, 6.0, 3.0])),
    ];
    let keys = "views = ['front', 'iso']\nparts_list = true\n";
    let composed = sheet("bearings", &parts, keys).expect("a sheet");
    let told = item_texts(page_item(&composed, "parts-list"));
    // One row for two equal parts, and two rows for one part each.
    assert_eq!(told.iter().filter(|word| word.starts_with("bearing")).count(), 3, "{told:?}");
    assert!(told.contains(&"bearing.002".to_owned()) && told.contains(&"bearing.004".to_owned()), "{told:?}");
}

#[test]
fn long_parts_lists_keep_all_columns_or_are_rejected() {
    let parts = |count: usize| -> Vec<(String, Solid)> {
        let part = |k: usize| {
            let x = 7.0 * k as f64;
            let name = format!("pin {}{}", (b'a' + (k / 26) as u8) as char, (b'a' + (k % 26) as u8) as char);
            (name, block([x, 0.0, 0.0], [x + 4.0, 4.0, 3.0 + 0.1 * k as f64]))
        };
        (0..count).map(part).collect()
    };
    for (size, count) in [("A3", 20), ("A3", 57), ("A2", 80), ("A4", 30)] {
        let keys = format!("size = '{size}'\nviews = ['top']\nparts_list = true\nballoons = 'none'\n");
        let composed = sheet("pins", &parts(count), &keys).expect("a sheet");
        let told = item_texts(page_item(&composed, "parts-list"));
        let columns = told.iter().filter(|word| *word == "Name").count();
        assert_eq!(told.iter().filter(|word| *word == "Material").count(), columns, "{size} {count}");
        assert_eq!(told.iter().filter(|word| word.starts_with("pin ")).count(), count);
        let texts = texts(&composed, "parts-list");
        assert!(texts.iter().all(|(_, _, capitals)| *capitals > 1.8 - 1e-9));
    }
    let keys = "size = 'A4'\nviews = ['top']\nparts_list = true\n";
    let error = sheet("many", &parts(200), keys).expect_err("too many");
    assert!(error.to_string().contains("200 items") && error.to_string().contains("line 6"), "{error}");
}

#[test]
fn unsupported_scripts_are_reported_with_part_file_and_line() {
    let named = |name: &str| {
        vec![
            ("lid".to_owned(), block([0.0; 3], [8.0, 6.0, 3.0])),
            (name.to_owned(), block([9.0, 0.0, 0.0], [12.0, 6.0, 5.0])),
        ]
    };
    let keys = "views = ['front', 'iso']\nparts_list = true\n";
    for name in ["泵体", "مضخة", "pump🔧"] {
        let error = sheet("script", &named(name), keys).expect_err(name).to_string();
        assert!(error.contains(name) && error.contains("sheet.toml: line 5"), "{error}");
    }
    let title = format!("views = ['front']\n[page.title]\ntitle = '{}'\n", "泵体");
    let error = sheet("script-title", &plate(), &title).expect_err("a title").to_string();
    assert!(error.contains("`title`") && error.contains("line 6"), "{error}");
    let composed = sheet("replaced", &named("geh\u{fffd}use"), keys).expect("a sheet");
    assert!(item_texts(page_item(&composed, "parts-list")).contains(&"geh\u{fffd}use".to_owned()));
    assert!(composed.warnings.iter().any(|warning| warning.contains("U+FFFD")), "{:?}", composed.warnings);
}

/// A post of 48 sides.
fn post([x, y]: [f64; 2], radius: f64, [low, high]: [f64; 2]) -> Solid {
    let mut post = Solid::default();
    for k in 0..48 {
        let angle = std::f64::consts::TAU * f64::from(k) / 48.0;
        let (dx, dy) = (
            radius * ligne::geometry::numbers::portable_math::cos(angle),
            radius * ligne::geometry::numbers::portable_math::sin(angle),
        );
        post.positions
            .extend([glam::DVec3::new(x + dx, y + dy, low), glam::DVec3::new(x + dx, y + dy, high)]);
    }
    for k in 0..48u32 {
        let [a, b] = [2 * k, 2 * ((k + 1) % 48)];
        post.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
        if (1..47).contains(&k) {
            post.triangles.extend([[0, b, a], [1, a + 1, b + 1]]);
        }
    }
    post
}

#[test]
fn sections_show_no_centre_lines_of_removed_parts() {
    let parts = vec![
        ("ground".to_owned(), block([0.0; 3], [60.0, 40.0, 10.0])),
        ("post".to_owned(), post([20.0, 20.0], 6.0, [10.0, 30.0])),
        ("pin".to_owned(), post([45.0, 20.0], 4.0, [10.0, 22.0])),
    ];
    let crosses = |plane: &str, keys: &str| {
        let text = format!(
            "views = ['front', 'top']\ncentre_lines = true\ndimensions = 'none'\n[[page.section]]\nplane = '{plane}'\n{keys}"
        );
        let composed = sheet("cut-away", &parts, &text).expect("a sheet");
        let section = drawn_bounds(page_item(&composed, "section-A"));
        let own = placed_marks(page_item(&composed, "notes")).filter(|(_, mark)| {
            let own = mark.path.bounding_box();
            mark.provenance.text.is_none()
                && mark.path.elements().len() == 2
                && section.contains(own.center())
        });
        own.count()
    };
    assert_eq!(
        [crosses("z=5", ""), crosses("z=10", ""), crosses("z=25", ""), crosses("z=15", "")],
        [0, 0, 8, 8]
    );
    assert_eq!(crosses("z=15", "uncut = ['post']\n"), 8);
    // From the side: the part in front of the plane is removed together with its axis.
    assert_eq!(crosses("x=30", ""), 1);
}

#[test]
fn details_that_miss_the_model_are_reported() {
    let keys = "views = ['front', 'top']\n[[page.detail]]\nof = 'top'\nat = [300, 300, 0]\nradius = 4\n";
    let composed = sheet("missed", &plate(), keys).expect("a sheet");
    let told = |warning: &String| warning.contains("the detail `A` shows nothing");
    assert!(composed.warnings.iter().any(told), "{:?}", composed.warnings);
    let keys = keys.replace("[300, 300, 0]", "[90, 50, 8]");
    let composed = sheet("met", &plate(), &keys).expect("a sheet");
    assert!(composed.warnings.is_empty(), "{:?}", composed.warnings);
}

#[test]
fn flat_contacts_between_materials_have_no_lines() {
    let holes = [([15.0, 22.0], 5.0), ([45.0, 25.0], 8.0), ([75.0, 20.0], 3.0)];
    let lower = drilled_plate([90.0, 45.0, 6.0], &holes);
    let upper = drilled_plate([90.0, 45.0, 4.0], &holes).moved(|p| p + glam::DVec3::Z * 6.0);
    let folder = temp_folder("contact");
    let text = obj_text(&[("lower".into(), lower), ("upper".into(), upper)])
        .replace("o lower\n", "mtllib a.mtl\no lower\nusemtl steel\n")
        .replace("o upper\n", "o upper\nusemtl brass\n");
    fs::write(folder.join("a.mtl"), "newmtl steel\nKd 0.6 0.6 0.7\nnewmtl brass\nKd 0.8 0.7 0.3\n")
        .expect("written");
    fs::write(folder.join("model.obj"), text).expect("written");
    let page = "[page]\nkind = 'sheet'\nmodel = { file = 'model.obj', up = 'z' }\nviews = ['top', 'bottom']\nhidden = true\n\
        dimensions = 'none'\ncentre_lines = false\n";
    let composed =
        PageFile::from_text(page, folder.join("a.toml")).expect("a page").compose().expect("drawn");
    fs::remove_dir_all(&folder).expect("removed");
    for view in ["top", "bottom"] {
        let classes: Vec<_> = placed_marks(page_item(&composed[0], view))
            .map(|(_, mark)| mark.provenance.classes.clone())
            .collect();
        assert!(classes.iter().all(|classes| !classes.contains(&"material")), "{view}: {classes:?}");
    }
}
