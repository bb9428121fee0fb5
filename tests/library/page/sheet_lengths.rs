//! Dimensions on technical sheets: automatic hole dimensions without overlaps, named points, rounding, and
//! pictorial views.

use std::fs;

use ligne::kurbo::{Rect, Shape};
use ligne::page::{ComposedPage, PageFile};

use crate::library::support::scenes::sheet_models::{
    block, drawn_bounds, item_texts, obj_text, page_item, placed_marks, temp_folder,
};
use crate::library::support::scenes::solids::Solid;

/// A plate of 80 x 50 x 10 as OBJ with z up, with two holes of diameter 8 mm and one of 20 mm.
fn plate() -> String {
    use ligne::geometry::numbers::portable_math::{cos, sin};
    let mut plate = Solid::default();
    let holes = [([15.0, 10.0], 4.0), ([65.0, 10.0], 4.0), ([40.0, 30.0], 10.0)];
    let corner = |x: f64, y: f64, z: f64| glam::DVec3::new(x, y, z);
    // Each hole is in a separate box; the boxes side by side make up the plate.
    for ([x, y], radius, [x0, x1, y0, y1]) in [
        (holes[0].0, holes[0].1, [0.0, 27.5, 0.0, 20.0]),
        (holes[1].0, holes[1].1, [52.5, 80.0, 0.0, 20.0]),
        (holes[2].0, holes[2].1, [0.0, 80.0, 20.0, 50.0]),
    ] {
        let first = plate.positions.len() as u32;
        let count = 48u32;
        for k in 0..count {
            let turn = std::f64::consts::TAU * (f64::from(k) + 0.5) / f64::from(count);
            let (c, s) = (cos(turn), sin(turn));
            let far = |d: f64, low: f64, high: f64, at: f64| match d {
                d if d > 1e-12 => (high - at) / d,
                d if d < -1e-12 => (low - at) / d,
                _ => f64::INFINITY,
            };
            let out = far(c, x0, x1, x).min(far(s, y0, y1, y));
            for z in [0.0, 10.0] {
                plate.positions.push(corner(x + radius * c, y + radius * s, z));
                plate.positions.push(corner(x + out * c, y + out * s, z));
            }
        }
        for k in 0..count {
            let [a, b] = [first + 4 * k, first + 4 * ((k + 1) % count)];
            let mut quad = |a: u32, b: u32, c: u32, d: u32| plate.triangles.extend([[a, b, c], [a, c, d]]);
            // The wall of the hole, and the faces below and above.
            quad(b, a, a + 2, b + 2);
            quad(a + 2, a + 3, b + 3, b + 2);
            quad(b, b + 1, a + 1, a);
        }
    }
    // The strip between the small holes, and the outer walls.
    let mut quad = |points: [[f64; 3]; 4]| {
        let first = plate.positions.len() as u32;
        plate.positions.extend(points.map(glam::DVec3::from));
        plate.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    };
    for z in [0.0, 10.0] {
        let strip = [[27.5, 0.0, z], [52.5, 0.0, z], [52.5, 20.0, z], [27.5, 20.0, z]];
        quad(if z > 0.0 { strip } else { [strip[0], strip[3], strip[2], strip[1]] });
    }
    for [[a, b], [c, d]] in [
        [[0.0, 0.0], [80.0, 0.0]],
        [[80.0, 0.0], [80.0, 50.0]],
        [[80.0, 50.0], [0.0, 50.0]],
        [[0.0, 50.0], [0.0, 0.0]],
    ] {
        quad([[a, b, 0.0], [c, d, 0.0], [c, d, 10.0], [a, b, 10.0]]);
    }
    obj_text(&[("plate".into(), plate)])
}

fn sheet_of_plate(name: &str, keys: &str) -> Result<ComposedPage, ligne::Error> {
    let folder = temp_folder(name);
    fs::write(folder.join("plate.obj"), plate()).expect("written");
    let text = format!("[page]\nkind = 'sheet'\nmodel = {{ file = 'plate.obj', up = 'z' }}\n{keys}");
    let composed = PageFile::from_text(&text, folder.join("sheet.toml"))?.compose()?;
    fs::remove_dir_all(&folder).expect("removed");
    Ok(composed.into_iter().next().expect("a page"))
}

#[test]
fn automatic_dimensions_include_holes_without_overlaps() {
    let composed =
        sheet_of_plate("auto", "views = ['front', 'top']\ndimensions = 'auto'\n").expect("a sheet");
    let mut told = item_texts(page_item(&composed, "notes"));
    told.sort();
    // Length, height and depth; the hole diameters, and the hole positions from the left and from below.
    assert_eq!(told, ["10", "10", "15", "2× ⌀8", "30", "40", "50", "65", "80", "⌀20"]);
    // Texts overlap neither each other nor a view.
    let views = ["front", "top"].map(|name| drawn_bounds(page_item(&composed, name)));
    let texts: Vec<Rect> = placed_marks(page_item(&composed, "notes"))
        .filter(|(_, mark)| mark.provenance.text.is_some())
        .map(|(place, mark)| (place * mark.path.clone()).bounding_box())
        .collect();
    let apart = |a: Rect, b: Rect| {
        let both = a.intersect(b);
        both.width() <= 0.0 || both.height() <= 0.0
    };
    for (k, text) in texts.iter().enumerate() {
        assert!(views.iter().all(|view| apart(*view, *text)), "{text:?} {views:?}");
        assert!(texts[..k].iter().all(|other| apart(*other, *text)), "{texts:?}");
    }
    let none = sheet_of_plate("none", "views = ['front']\ndimensions = 'none'\ncentre_lines = false\n");
    assert!(item_texts(page_item(&none.expect("a sheet"), "notes")).is_empty());
}

#[test]
fn dimensions_accept_named_points_and_cylinder_diameters() {
    let keys = "views = ['front', 'top']\noverall = false\ncentre_lines = false\npoints = { corner = [0, 0, 10], hole = [15, 10, 10] }\n\
        [[page.dimension]]\nof = 'top'\nfrom = 'corner'\nto = 'hole'\nmeasure = 'horizontal'\nside = 'above'\n\
        [[page.dimension]]\nof = 'top'\nfrom = 'hole'\nto = 'plate.right'\nmeasure = 'horizontal'\n\
        [[page.dimension]]\nfrom = 'bottom'\nto = 'top'\nmeasure = 'vertical'\n\
        [[page.dimension]]\nof = 'top'\nat = [50, 30, 5]\nmeasure = 'diameter'\n\
        [[page.dimension]]\nof = 'top'\nat = 'hole'\nmeasure = 'radius'\n";
    let composed = sheet_of_plate("named", keys).expect("a sheet");
    let mut told = item_texts(page_item(&composed, "notes"));
    told.sort();
    assert_eq!(told, ["10", "15", "65", "R4", "⌀20"]);
    for (keys, wanted) in [
        ("from = 'cornr'\nto = [0,0,0]", "no place `cornr`"),
        ("from = 'plat.left'\nto = [0,0,0]", "no part `plat`"),
        ("from = [0,0,0]", "no `to`"),
        ("measure = 'diameter'", "no `at`"),
        ("measure = 'diameter'\nat = [0,0,0]", "no cylinder in this view"),
        ("from = [0,0,0]\nto = [1,0,0]\nside = 'beside'", "unknown value `beside`"),
    ] {
        let error =
            sheet_of_plate("named-wrong", &format!("views = ['front']\n[[page.dimension]]\n{keys}\n"));
        let error = error.expect_err(keys);
        assert!(error.to_string().contains(wanted) && error.file.is_some(), "{keys}: {error}");
    }
    let error = sheet_of_plate("set-wrong", "dimensions = 'all'\n").expect_err("wrong");
    assert!(error.to_string().contains("no set of dimensions `all`"), "{error}");
}

/// Composes a sheet of a box at the origin, read as OBJ or as STL in single precision.
fn sheet_of_box(name: &str, size: [f64; 3], format: &str, keys: &str) -> Result<ComposedPage, ligne::Error> {
    let folder = temp_folder(name);
    let solid = block([0.0; 3], size);
    let model = if format == "obj" {
        obj_text(&[("box".into(), solid)]).into_bytes()
    } else {
        let mut bytes = vec![0; 80];
        bytes.extend((solid.triangles.len() as u32).to_le_bytes());
        for triangle in &solid.triangles {
            bytes.extend([0; 12]);
            for corner in triangle {
                let p = solid.positions[*corner as usize].as_vec3().to_array();
                bytes.extend(p.into_iter().flat_map(f32::to_le_bytes));
            }
            bytes.extend([0; 2]);
        }
        bytes
    };
    fs::write(folder.join(format!("box.{format}")), model).expect("written");
    let text = format!("[page]\nkind = 'sheet'\nmodel = {{ file = 'box.{format}', up = 'z' }}\n{keys}");
    let composed = PageFile::from_text(&text, folder.join("sheet.toml"))?.compose();
    fs::remove_dir_all(&folder).expect("removed");
    Ok(composed?.into_iter().next().expect("a page"))
}

/// Returns the dimension texts and the length unit of such a sheet.
fn values_of_box(name: &str, size: [f64; 3], format: &str, keys: &str) -> (Vec<String>, String) {
    let composed = sheet_of_box(name, size, format, keys).expect("a sheet");
    let mut values = item_texts(page_item(&composed, "notes"));
    values.sort();
    let block = item_texts(page_item(&composed, "title-block"));
    let at = block.iter().position(|word| word == "Dimensions in").expect("the unit is named");
    (values, block[at + 1].clone())
}

#[test]
fn dimension_values_are_rounded_alike_in_all_formats() {
    let views = "views = ['front', 'top', 'left']\n";
    for format in ["obj", "stl"] {
        let of = |name: &str, size, keys: &str| {
            values_of_box(&format!("{name}-{format}"), size, format, &format!("{views}{keys}"))
        };
        let told = |values: &[&str], unit: &str| {
            let values: Vec<String> = values.iter().map(|value| (*value).to_owned()).collect();
            (values, unit.to_owned())
        };
        let size = [31.435, 8.725, 12.625];
        assert_eq!(of("ties", size, ""), told(&["12.63", "31.44", "8.73"], "mm"), "{format}");
        assert_eq!(of("comma", size, "decimal_comma = true\n"), told(&["12,63", "31,44", "8,73"], "mm"));
        assert_eq!(of("none", size, "decimals = 0\n"), told(&["13", "31", "9"], "mm"));
        assert_eq!(of("more", size, "decimals = 6\n"), told(&["12.625", "31.435", "8.725"], "mm"));
        let inch = "size = 'A0'\nunit = 'in'\n";
        assert_eq!(of("inch", size, inch), told(&["12.625", "31.435", "8.725"], "in"));
        let millimetres = format!("{inch}dimension_unit = 'mm'\n");
        assert_eq!(of("mm", size, &millimetres), told(&["221.62", "320.68", "798.45"], "mm"));
        assert_eq!(of("cm", size, "dimension_unit = 'cm'\n"), told(&["0.873", "1.263", "3.144"], "cm"));
        assert_eq!(of("m", size, "dimension_unit = 'm'\n"), told(&["0.009", "0.013", "0.031"], "m"));
        let thin = [31.5, 0.003, 0.000_47];
        assert_eq!(of("thin", thin, ""), told(&["0.0005", "0.003", "31.5"], "mm"), "{format}");
    }
    for (keys, wanted) in [
        ("decimals = 10\n", "not a number of decimals"),
        ("decimals = -1\n", "not a number of decimals"),
        ("dimension_unit = 'inch'\n", "no unit `inch`"),
    ] {
        let error = sheet_of_box("wrong-values", [1.0; 3], "obj", keys).expect_err(keys);
        assert!(error.to_string().contains(wanted), "{error}");
    }
}

#[test]
fn pictorial_views_show_true_lengths_or_are_rejected() {
    let size = [70.0, 25.0, 40.0];
    let sheet = |name: &str, keys: &str| {
        let head = "size = 'A4'\ndimensions = 'none'\nviews = ['front', 'iso', 'dimetric', 'trimetric']\n";
        sheet_of_box(name, size, "obj", &format!("{head}{keys}"))
    };
    let detail = "[[page.detail]]\nof = 'iso'\nat = [35, 12, 20]\nradius = 45\n";
    for view in ["iso", "dimetric", "trimetric", "detail-A"] {
        for (to, value) in [("[70, 0, 0]", "70"), ("[0, 25, 0]", "25"), ("[0, 0, 40]", "40")] {
            let keys = format!("{detail}[[page.dimension]]\nof = '{view}'\nfrom = [0, 0, 0]\nto = {to}\n");
            let composed = sheet(&format!("true-{view}-{value}"), &keys).expect("a sheet");
            assert!(item_texts(page_item(&composed, "notes")).contains(&value.to_owned()), "{view} {to}");
        }
    }
    // Vertical lengths are vertical in the isometric view.
    let upright = "[[page.dimension]]\nof = 'iso'\nfrom = [0, 0, 0]\nto = [0, 0, 40]\nmeasure = 'vertical'\n";
    assert!(
        item_texts(page_item(&sheet("upright", upright).expect("a sheet"), "notes"))
            .contains(&"40".to_owned())
    );
    let exploded = "[page.exploded]\n";
    for (keys, wanted) in [
        ("of = 'iso'\nfrom = [0, 0, 0]\nto = [70, 25, 0]", "along the axes of the model"),
        (
            "of = 'trimetric'\nfrom = [0, 0, 0]\nto = [70, 0, 0]\nmeasure = 'horizontal'",
            "along the axes of the model",
        ),
        ("of = 'dimetric'\nfrom = 'left'\nto = 'right'", "along the axes of the model"),
        ("of = 'detail-A'\nfrom = [0, 0, 0]\nto = [0, 25, 40]", "along the axes of the model"),
        ("of = 'exploded'\nfrom = [0, 0, 0]\nto = [70, 0, 0]", "an exploded view has no dimensions"),
        ("of = 'exploded'\nat = [0, 0, 0]\nmeasure = 'diameter'", "an exploded view has no dimensions"),
        ("of = 'front'\nfrom = [0, 0, 0]\nto = [0, 25, 0]", "lie behind each other"),
        ("of = 'front'\nfrom = [0, 0, 0]\nto = [inf, 25, 0]", "this is not a point"),
    ] {
        let error =
            sheet("refused", &format!("{detail}{exploded}[[page.dimension]]\n{keys}\n")).expect_err(keys);
        let text = error.to_string();
        assert!(
            text.contains(wanted) && text.contains("sheet.toml") && text.contains("line "),
            "{keys}: {text}"
        );
    }
}
