//! Dimensions on technical sheets equal distances of the model, to half a unit of their last decimal.

use std::fs;

use glam::DVec3;
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::page::{ComposedPage, PageFile};

use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::sheet_models::{item_texts, obj_text, page_item, temp_folder};
use crate::library::support::scenes::solids::Solid;

/// A plate: a row of square cells with a round hole in each. Lengths have three decimals.
struct Plate {
    side: f64,
    thick: f64,
    radii: Vec<f64>,
    solid: Solid,
}

/// Number of corners of a hole.
const HOLE_CORNERS: u32 = 48;

impl Plate {
    /// Returns a random plate at a random place, parallel to two random axes.
    fn random(dice: &mut Dice) -> Self {
        let thousandths =
            |low: f64, high: f64, dice: &mut Dice| (dice.between(low, high) * 1000.0).round() / 1000.0;
        let side = thousandths(8.0, 60.0, dice);
        let thick = thousandths(0.5, 25.0, dice);
        let radii: Vec<f64> =
            (0..=dice.below(3)).map(|_| (dice.between(0.1, 0.45) * side * 2000.0).round() / 2000.0).collect();
        let place = DVec3::from_array([(); 3].map(|()| thousandths(-300.0, 300.0, dice)));
        let axes = [[0, 1, 2], [1, 2, 0], [2, 0, 1]][dice.below(3)];
        let mut solid = Solid::default();
        for (cell, radius) in radii.iter().enumerate() {
            add_cell(&mut solid, (side, cell), *radius, thick);
        }
        let count = radii.len() as f64;
        add_walls(&mut solid, [count * side, side, thick]);
        let turned = |p: DVec3| {
            let mut at = [0.0; 3];
            axes.iter().zip(p.to_array()).for_each(|(axis, x)| at[*axis] = x);
            place + DVec3::from_array(at)
        };
        Self { side, thick, radii, solid: solid.moved(turned) }
    }

    /// Returns its length, height and thickness.
    fn sizes(&self) -> [f64; 3] {
        [self.radii.len() as f64 * self.side, self.side, self.thick]
    }
}

/// Adds the faces of a cell and the wall of its hole.
fn add_cell(solid: &mut Solid, (side, cell): (f64, usize), radius: f64, thick: f64) {
    let centre = DVec3::new((cell as f64 + 0.5) * side, side / 2.0, 0.0);
    let first = solid.positions.len() as u32;
    for k in 0..HOLE_CORNERS {
        let turn = std::f64::consts::TAU * f64::from(k) / f64::from(HOLE_CORNERS);
        let out = DVec3::new(cos(turn), sin(turn), 0.0);
        let edge = out * (side / 2.0 / out.abs().max_element());
        for z in [DVec3::ZERO, DVec3::Z * thick] {
            solid.positions.extend([centre + out * radius + z, centre + edge + z]);
        }
    }
    for k in 0..HOLE_CORNERS {
        let [a, b] = [first + 4 * k, first + 4 * ((k + 1) % HOLE_CORNERS)];
        for [a, b, c, d] in [[b, a, a + 2, b + 2], [a + 2, a + 3, b + 3, b + 2], [b, b + 1, a + 1, a]] {
            solid.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
}

/// Adds the four walls around a plate.
fn add_walls(solid: &mut Solid, [length, height, thick]: [f64; 3]) {
    let ring = [[0.0, 0.0], [length, 0.0], [length, height], [0.0, height]];
    for k in 0..4 {
        let ([a, b], [c, d]) = (ring[k], ring[(k + 1) % 4]);
        let first = solid.positions.len() as u32;
        solid
            .positions
            .extend([[a, b, 0.0], [c, d, 0.0], [c, d, thick], [a, b, thick]].map(DVec3::from_array));
        solid.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
}

/// Model file names with the length of a millimetre in file units.
const FORMATS: [(&str, f64); 5] =
    [("plate.obj", 1.0), ("six.obj", 1.0), ("plate.stl", 1.0), ("plate.ply", 1.0), ("plate.gltf", 0.001)];

/// Writes a model file. Text formats have double precision or six decimals; the others have single precision.
fn model_file(name: &str, solid: &Solid, scale: f64) -> Vec<u8> {
    let single = || solid.positions.iter().map(|p| (*p * scale).as_vec3());
    let corners = || solid.triangles.iter().flatten();
    match name {
        "plate.obj" => obj_text(&[("plate".into(), solid.clone())]).into_bytes(),
        "six.obj" => {
            let mut text = String::new();
            solid.positions.iter().for_each(|p| text += &format!("v {:.6} {:.6} {:.6}\n", p.x, p.y, p.z));
            let face = |[a, b, c]: &[u32; 3]| format!("f {} {} {}\n", a + 1, b + 1, c + 1);
            text.extend(solid.triangles.iter().map(face));
            text.into_bytes()
        }
        "plate.stl" => {
            let mut bytes = vec![0; 80];
            bytes.extend((solid.triangles.len() as u32).to_le_bytes());
            let points: Vec<glam::Vec3> = single().collect();
            for triangle in &solid.triangles {
                bytes.extend([0; 12]);
                for p in triangle.map(|corner| points[corner as usize]) {
                    bytes.extend(p.to_array().into_iter().flat_map(f32::to_le_bytes));
                }
                bytes.extend([0; 2]);
            }
            bytes
        }
        "plate.ply" => {
            let (points, faces) = (solid.positions.len(), solid.triangles.len());
            let mut bytes = format!(
                "ply\nformat binary_little_endian 1.0\nelement vertex {points}\nproperty float x\nproperty float y\n\
                 property float z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
            )
            .into_bytes();
            single().for_each(|p| bytes.extend(p.to_array().into_iter().flat_map(f32::to_le_bytes)));
            for triangle in &solid.triangles {
                bytes.push(3);
                bytes.extend(triangle.iter().flat_map(|corner| corner.to_le_bytes()));
            }
            bytes
        }
        _ => {
            use base64::Engine;
            let mut bytes: Vec<u8> = single().flat_map(|p| p.to_array()).flat_map(f32::to_le_bytes).collect();
            let points = bytes.len();
            bytes.extend(corners().flat_map(|corner| corner.to_le_bytes()));
            let (low, high) = single()
                .fold((glam::Vec3::INFINITY, glam::Vec3::NEG_INFINITY), |(low, high), p| {
                    (low.min(p), high.max(p))
                });
            let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
            format!(
                r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
                "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
                "accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3","min":{:?},"max":{:?}}},
                {{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],
                "bufferViews":[{{"buffer":0,"byteLength":{points}}},{{"buffer":0,"byteOffset":{points},"byteLength":{}}}],
                "buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{data}"}}]}}"#,
                solid.positions.len(),
                low.to_array(),
                high.to_array(),
                3 * solid.triangles.len(),
                bytes.len() - points,
                bytes.len()
            )
            .into_bytes()
        }
    }
}

/// Units of length in millimetres.
const UNITS: [(&str, f64); 5] = [("mm", 1.0), ("cm", 10.0), ("m", 1000.0), ("in", 25.4), ("ft", 304.8)];

/// Returns the length unit named on a sheet, in millimetres.
fn sheet_unit_mm(composed: &ComposedPage) -> f64 {
    let block = item_texts(page_item(composed, "title-block"));
    let at = block.iter().position(|word| word == "Dimensions in").expect("the unit is named");
    UNITS.iter().find(|(name, _)| *name == block[at + 1]).expect("a unit").1
}

/// Parses a dimension. Returns its value and half a unit of its last decimal, counting at least `decimals`
/// decimals.
fn parse_dimension(word: &str, decimals: usize, has_comma: bool) -> Option<(f64, f64)> {
    let word = word.rsplit(['⌀', 'R']).next()?;
    assert!(!word.contains(if has_comma { '.' } else { ',' }), "{word}");
    let word = word.replace(',', ".");
    let own = word.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    Some((word.parse().ok()?, 0.5 / 10_f64.powi(own.max(decimals) as i32)))
}

/// Checks one plate in all views, in one file format: each value is a distance of the model, and each
/// requested distance is present.
fn check_plate(round: u64) {
    let mut dice = Dice::new(round);
    let plate = Plate::random(&mut dice);
    let (name, scale) = FORMATS[(round % 5) as usize];
    let (model_unit, model_mm) = UNITS[if name == "plate.gltf" { 2 } else { dice.below(5) }];
    let (unit, _) = UNITS[dice.below(5)];
    let (decimals, has_comma) = (dice.below(5), dice.below(2) == 1);
    let folder = temp_folder(&format!("values-{round}"));
    fs::write(folder.join(name), model_file(name, &plate.solid, scale)).expect("written");
    let points = &plate.solid.positions;
    let low = points.iter().copied().reduce(DVec3::min).expect("points");
    let high = points.iter().copied().reduce(DVec3::max).expect("points");
    let mut text = format!(
        "[page]\nkind = 'sheet'\nsize = 'A0'\nmodel = {{ file = '{name}', up = 'z' }}\nunit = '{model_unit}'\ndimension_unit = '{unit}'\n\
         decimals = {decimals}\ndecimal_comma = {has_comma}\ndimensions = 'auto'\nscale = '{}'\n\
         views = ['front', 'back', 'left', 'right', 'top', 'bottom', 'iso', 'trimetric']\n",
        match model_mm {
            1.0 => "1:2",
            10.0 => "1:20",
            25.4 => "1:50",
            _ => "1:1000",
        }
    );
    // Along each axis in pictorial views, and between opposite sides in the other views.
    let mut asked = Vec::new();
    for view in ["iso", "trimetric"] {
        for axis in 0..3 {
            let (from, mut to) = (low * scale, low * scale);
            to[axis] = high[axis] * scale;
            text += &format!(
                "[[page.dimension]]\nof = '{view}'\nfrom = {:?}\nto = {:?}\n",
                from.to_array(),
                to.to_array()
            );
            asked.push(high[axis] - low[axis]);
        }
    }
    for view in ["back", "left", "right", "bottom"] {
        text += &format!(
            "[[page.dimension]]\nof = '{view}'\nfrom = 'left'\nto = 'right'\nmeasure = 'horizontal'\n"
        );
        text += &format!(
            "[[page.dimension]]\nof = '{view}'\nfrom = 'bottom'\nto = 'top'\nmeasure = 'vertical'\n"
        );
        let [right, up] = if matches!(view, "left" | "right") { [1, 2] } else { [0, 1] };
        let up = if view == "back" { 2 } else { up };
        asked.extend([high[right] - low[right], high[up] - low[up]]);
    }
    asked.extend(plate.sizes());
    asked.extend(plate.radii.iter().map(|radius| 2.0 * radius));
    let sheet = PageFile::from_text(&text, folder.join("sheet.toml")).expect("a page");
    let composed =
        sheet.compose().unwrap_or_else(|error| panic!("{round}: {error}")).into_iter().next().expect("one");
    fs::remove_dir_all(&folder).expect("removed");
    let unit = sheet_unit_mm(&composed);
    let mut known = asked.clone();
    known.extend((0..2 * plate.radii.len()).map(|k| 0.5 * k as f64 * plate.side));
    known.extend(plate.radii.iter().map(|radius| plate.side / 2.0 - radius));
    // Converted as on the sheet: from model units to the unit of the sheet.
    let told: Vec<(f64, f64)> = item_texts(page_item(&composed, "notes"))
        .iter()
        .filter_map(|word| parse_dimension(word, decimals, has_comma))
        .map(|(value, half)| {
            [value, half].map(|x| x * unit / model_mm * if scale < 1.0 { 1000.0 } else { 1.0 })
        })
        .map(|[value, half]| (value, half * (1.0 + 1e-9)))
        .collect();
    let is = |wanted: f64, (value, half): (f64, f64)| (wanted - value).abs() <= half && value > 0.0;
    for own in &told {
        assert!(known.iter().any(|wanted| is(*wanted, *own)), "{round} {name}: {own:?} of {known:?}");
    }
    for wanted in &asked {
        assert!(told.iter().any(|own| is(*wanted, *own)), "{round} {name}: {wanted} in {told:?}");
    }
}

#[test]
fn dimension_values_are_distances_of_the_model() {
    (0..20).for_each(check_plate);
}

#[test]
#[ignore = "long: .ci/nightly"]
fn dimension_values_of_200_parts_are_distances_of_the_model() {
    (0..200).for_each(check_plate);
}
