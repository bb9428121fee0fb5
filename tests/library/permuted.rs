//! A drawing does not show how the model's file numbers its vertices and in which order it has its faces:
//! not by one byte.

use crate::support::models;
use std::path::{Path, PathBuf};

use crate::support::dice::Dice;
use ligne::export::SvgOptions;
use ligne::render::render;
use ligne::scene::{Camera, Geometry, Scene};
use ligne::stages::mesh::EdgeMark;
use ligne::style::Style;

const STYLES: [&str; 9] =
    ["ink", "technical", "toon", "comic", "pencil", "pen", "suggestive", "engraving", "stipple"];

/// With every digit, so that no difference is rounded away.
fn svg(scene: &Scene, style: &Style) -> String {
    let mut camera = Camera::three_quarter_of(scene.up);
    (camera.width, camera.height) = (300.0, 300.0);
    let options = SvgOptions::default().with_precision(8);
    render(scene, &camera.fit(scene), style).unwrap().to_svg(&options)
}

/// The items in another order: at each place stands what had this number.
fn taken<T: Copy>(items: &[T], order: &[u32]) -> Vec<T> {
    if items.is_empty() { Vec::new() } else { order.iter().map(|k| items[*k as usize]).collect() }
}

fn shuffled_numbers(dice: &mut Dice, count: usize) -> Vec<u32> {
    dice.shuffled((0..count as u32).collect())
}

/// Numbers values anew: the values in their new order, the corners of each triangle with their new numbers.
fn renumbered<T: Copy>(dice: &mut Dice, values: &mut Vec<T>, corners: &mut [u32]) {
    let order = shuffled_numbers(dice, values.len());
    let mut new_id = vec![0; order.len()];
    order.iter().zip(0..).for_each(|(old, new)| new_id[*old as usize] = new);
    *values = taken(values, &order);
    // Corners without a value have no id.
    corners.iter_mut().for_each(|id| *id = new_id.get(*id as usize).copied().unwrap_or(*id));
}

/// What belongs to the corners of each triangle, with another corner in front.
fn turn<T: Copy>(corners: &mut [[T; 3]], turns: &[usize]) {
    for (corners, by) in corners.iter_mut().zip(turns) {
        corners.rotate_left(*by);
    }
}

/// The same shape, numbered in another way: vertices, normals, triangles and wires in another order, other
/// corners of the triangles in front.
fn mixed(geometry: &Geometry, dice: &mut Dice) -> Geometry {
    let mut mixed = geometry.clone();
    let order = shuffled_numbers(dice, geometry.positions.len());
    let mut new_id = vec![0; order.len()];
    order.iter().zip(0..).for_each(|(old, new)| new_id[*old as usize] = new);
    mixed.positions = taken(&geometry.positions, &order);
    mixed.colours = taken(&geometry.colours, &order);
    let corners = mixed.triangles.as_flattened_mut().iter_mut().chain(mixed.wires.as_flattened_mut());
    corners.for_each(|v| *v = new_id[*v as usize]);
    renumbered(dice, &mut mixed.normals, mixed.corner_normals.as_flattened_mut());
    renumbered(dice, &mut mixed.uvs, mixed.corner_uvs.as_flattened_mut());

    let count = geometry.triangles.len();
    let turns: Vec<usize> = (0..count).map(|_| dice.below(3)).collect();
    turn(&mut mixed.triangles, &turns);
    turn(&mut mixed.corner_normals, &turns);
    turn(&mut mixed.corner_uvs, &turns);
    turn(&mut mixed.edge_marks, &turns);
    let order = shuffled_numbers(dice, count);
    mixed.triangles = taken(&mixed.triangles, &order);
    mixed.triangle_material = taken(&mixed.triangle_material, &order);
    mixed.corner_normals = taken(&mixed.corner_normals, &order);
    mixed.corner_uvs = taken(&mixed.corner_uvs, &order);
    mixed.edge_marks = taken(&mixed.edge_marks, &order);
    mixed.wires = dice.shuffled(mixed.wires);
    for wire in &mut mixed.wires {
        wire.rotate_left(dice.below(2));
    }
    mixed
}

fn mixed_scene(scene: &Scene, dice: &mut Dice) -> Scene {
    let geometries = scene.geometries.iter().map(|geometry| mixed(geometry, dice)).collect();
    Scene { geometries, ..scene.clone() }
}

/// Where two texts part, with some of what is around.
fn first_difference(one: &str, other: &str) -> String {
    let at = one.bytes().zip(other.bytes()).take_while(|(a, b)| a == b).count();
    let around = |text: &str| {
        let bytes = text.as_bytes();
        String::from_utf8_lossy(&bytes[at.saturating_sub(80)..(at + 60).min(bytes.len())]).into_owned()
    };
    format!("at byte {at} of {} and {}:\n{}\n{}", one.len(), other.len(), around(one), around(other))
}

/// Draws a scene and one numbered in another way.
fn same_bytes(scene: &Scene, styles: &[&str], what: &str) {
    let mut dice = Dice::new(31);
    let other = mixed_scene(scene, &mut dice);
    for name in styles {
        let style = Style::preset(name).unwrap();
        let (one, two) = (svg(scene, &style), svg(&other, &style));
        assert!(one.contains("<path"), "{what} in {name}: nothing drawn");
        assert!(one == two, "{what} in {name} differs {}", first_difference(&one, &two));
    }
}

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name)
}

fn example_is_drawn_alike(name: &str) {
    same_bytes(&Scene::open(example(name)).unwrap(), &STYLES, name);
}

#[test]
fn numbering_changes_no_byte_of_the_bear() {
    example_is_drawn_alike("bear.ply");
}

#[test]
fn numbering_changes_no_byte_of_the_knot() {
    example_is_drawn_alike("knot.ply");
}

#[test]
fn numbering_changes_no_byte_of_the_bracket() {
    example_is_drawn_alike("bracket.stl");
}

#[test]
fn numbering_changes_no_byte_of_the_gear_and_the_castle() {
    for name in ["gear.obj", "castle.obj"] {
        same_bytes(&Scene::open(example(name)).unwrap(), &["ink", "toon", "pencil"], name);
    }
}

#[test]
fn numbering_changes_no_byte_of_the_pump() {
    same_bytes(&Scene::open(example("pump.glb")).unwrap(), &["technical", "comic", "stipple"], "pump.glb");
}

/// Models with all that may go wrong: open and twisted surfaces, faces through each other, doubled and
/// without area, textures and colours of vertices, wires, instances.
#[test]
#[ignore = "long: .ci/nightly"]
fn numbering_changes_no_byte_of_shared_models() {
    let lines = ["ink", "suggestive"];
    let few = ["technical", "comic", "pen"];
    for (name, styles) in [
        ("edge/nonmanifold.obj", &STYLES[..]),
        ("edge/degenerate.obj", &STYLES),
        ("edge/coplanar.obj", &STYLES),
        ("edge/primitive-modes.gltf", &STYLES),
        ("edge/soup.stl", &few),
        ("edge/gpu-instancing.glb", &few),
        ("edge/colours-ascii.ply", &["toon"]),
        ("features/BoxVertexColors.glb", &few),
        ("edge/moebius.obj", &lines),
        ("edge/self-intersecting.obj", &lines),
        ("organic/suzanne.obj", &few),
        ("scene/cakeBirthday.glb", &few),
        ("scene/CesiumMilkTruck.glb", &["toon", "pencil"]),
    ] {
        if let Some(path) = models::find(name) {
            same_bytes(&Scene::open(&path).unwrap(), styles, name);
        }
    }
}

/// The text of an OBJ file with its vertices in another order, and the faces of each object likewise.
fn mixed_obj(text: &str, dice: &mut Dice) -> String {
    let vertices: Vec<&str> = text.lines().filter(|line| line.starts_with("v ")).collect();
    let order = shuffled_numbers(dice, vertices.len());
    let mut new_id = vec![0; order.len()];
    order.iter().zip(1..).for_each(|(old, new)| new_id[*old as usize] = new);
    let renamed = |corner: &str| {
        let (vertex, rest) = corner.find('/').map_or((corner, ""), |slash| corner.split_at(slash));
        format!("{}{rest}", new_id[vertex.parse::<usize>().unwrap() - 1])
    };
    let mut mixed: Vec<String> = order.iter().map(|old| vertices[*old as usize].to_owned()).collect();
    let mut faces: Vec<String> = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with("v ")) {
        if let Some(corners) = line.strip_prefix("f ") {
            let corners: Vec<String> = corners.split_whitespace().map(renamed).collect();
            faces.push(format!("f {}", corners.join(" ")));
        } else {
            mixed.append(&mut dice.shuffled(std::mem::take(&mut faces)));
            mixed.push(line.to_owned());
        }
    }
    mixed.append(&mut dice.shuffled(faces));
    mixed.join("\n")
}

#[test]
fn lines_of_an_obj_file_may_stand_in_any_order() {
    for (name, styles) in [("gear.obj", ["technical", "engraving"]), ("teapot.obj", ["suggestive", "comic"])]
    {
        let text = std::fs::read_to_string(example(name)).unwrap();
        let other = mixed_obj(&text, &mut Dice::new(32));
        assert_ne!(text, other);
        let read = |text: &str| ligne::load::obj::read_bytes(text.as_bytes(), "model", |_| None).unwrap();
        let (scene, other) = (read(&text), read(&other));
        for style in styles {
            let style_sheet = Style::preset(style).unwrap();
            let (one, two) = (svg(&scene, &style_sheet), svg(&other, &style_sheet));
            assert!(one == two, "{name} in {style} differs {}", first_difference(&one, &two));
        }
    }
}

/// What the models above do not have: marks of edges, lines without faces, sheets with faces on both sides
/// in two materials, vertices that no face uses.
#[test]
fn numbering_changes_no_byte_of_what_few_models_have() {
    let at = |x: u32, y: u32| y * 7 + x;
    let bend = |x: f64| (x - 3.0) * (x - 3.0) / 9.0;
    let mut sheet = Geometry::default();
    for y in 0..7 {
        for x in 0..7 {
            let (x, y) = (f64::from(x), f64::from(y));
            sheet.positions.push(glam::DVec3::new(x - 3.0, y, bend(x) * bend(y + 1.0)));
            sheet.colours.push([0.1 * x as f32, 0.3, 0.1 * y as f32, 1.0]);
        }
    }
    for y in 0..6 {
        for x in 0..6 {
            let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
            for [a, b, c] in [[a, b, c], [a, c, d]] {
                sheet.triangles.extend([[a, b, c], [c, b, a]]);
                sheet.triangle_material.extend([u32::from(x > 2), u32::from(y > 2)]);
                let mark = if x == 2 { EdgeMark::Hard } else { EdgeMark::Unmarked };
                sheet
                    .edge_marks
                    .extend([[EdgeMark::Unmarked, mark, EdgeMark::Hidden], [EdgeMark::Unmarked; 3]]);
            }
        }
    }
    sheet.positions.extend([glam::DVec3::new(0.0, 3.0, 5.0), glam::DVec3::new(0.0, -0.0, 3.0)]);
    sheet.positions.extend([glam::DVec3::new(-0.0, 0.0, 3.0), glam::DVec3::splat(1e9)]);
    sheet.colours.resize(sheet.positions.len(), [1.0; 4]);
    sheet.wires = vec![[24, 49], [49, 50], [51, 24], [24, 27]];
    let materials =
        ["front", "back"].map(|name| ligne::scene::Material { name: name.into(), ..Default::default() });
    let place = |k: usize| ligne::scene::Part {
        name: format!("sheet {k}"),
        geometry: 0,
        world_from_part: glam::DAffine3::from_translation(glam::DVec3::new(2.0 * k as f64, 0.0, k as f64)),
    };
    let scene = Scene {
        geometries: vec![sheet],
        materials: materials.into(),
        parts: (0..2).map(place).collect(),
        ..Scene::default()
    };
    same_bytes(&scene, &STYLES, "sheets");
}
