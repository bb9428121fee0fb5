//! `KHR_animation_pointer` channels for cameras, lights, materials and visibility, against an independent
//! glTF evaluator.

use std::f64::consts::FRAC_PI_4;

use ligne::animate::{Animator, FrameSpec};
use ligne::animation::{Playing, Rigged};
use ligne::colour::srgb::Colour;
use ligne::drawing::{Page, Unit};
use ligne::scene::{Alpha, LightKind, Projection};
use ligne::{Camera, Scene, Style, SvgOptions, pipeline};
use serde_json::{Value, json};

use crate::library::support::readers::plain_gltf::ReferenceGltf;
use crate::library::support::scenes::pointer_board::PointerFile;

fn open_with_both_readers(board: &PointerFile) -> (Rigged, ReferenceGltf) {
    (Rigged::open(&board.0).unwrap(), ReferenceGltf::open(&board.0))
}

const TIMES_S: [f64; 7] = [-1.0, 0.0, 0.4, 1.0, 1.9, 3.0, 4.0];

fn is_close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-6
}

#[test]
fn animated_lenses_match_an_independent_evaluation() {
    let (yfov, znear) = ("/cameras/0/perspective/yfov", "/cameras/0/perspective/znear");
    let aspect = "/cameras/0/perspective/aspectRatio";
    let (xmag, ymag) = ("/cameras/1/orthographic/xmag", "/cameras/1/orthographic/ymag");
    let board = PointerFile::new(
        "lenses",
        &[
            (yfov, "LINEAR", &[0.5, 1.0, 0.25]),
            (znear, "STEP", &[0.1, 0.5, 2.0]),
            (aspect, "LINEAR", &[1.5, 2.0, 1.0]),
            (xmag, "LINEAR", &[2.0, 4.0, 3.0]),
            (ymag, "CUBICSPLINE", &[0., 1., 0., 0., 2., 0.5, 0.5, 0.5, 0.]),
        ],
        |_| {},
    );
    let (rigged, plain) = open_with_both_readers(&board);
    assert!(rigged.scene.warnings.is_empty(), "{:?}", rigged.scene.warnings.lines());
    for time in TIMES_S {
        let own = |pointer: &str| plain.pointer_value(0, pointer, time)[0];
        let playing = [Playing::all(0, time)];
        let cameras = rigged.cameras(&playing).unwrap();
        assert_eq!(cameras, rigged.posed(&playing).unwrap().cameras);
        let [eye, plan] = [0, 1].map(|number| cameras[number].camera);
        let Projection::Perspective { fov_y_deg } = eye.projection else { panic!("{eye:?}") };
        assert!(is_close(fov_y_deg, own(yfov).to_degrees()), "{time}: {fov_y_deg}");
        assert!(
            is_close(eye.near.unwrap(), own(znear)) && is_close(eye.width / eye.height, own(aspect)),
            "{eye:?}"
        );
        let Projection::Orthographic { height } = plan.projection else { panic!("{plan:?}") };
        assert!(is_close(height, 2.0 * own(ymag)), "{time}: {height}");
        assert!(is_close(plan.width / plan.height, own(xmag) / own(ymag)), "{plan:?}");
    }
    // With weight 0.5 the lens is halfway between rest and the clip. Without a clip the cameras are those of
    // the file.
    let half = rigged.cameras(&[Playing { clip: 0, time: 1.0, weight: 0.5 }]).unwrap()[0].camera.projection;
    let Projection::Perspective { fov_y_deg } = half else { panic!("{half:?}") };
    assert!(is_close(fov_y_deg, 0.75_f64.to_degrees()), "{fov_y_deg}");
    assert_eq!(rigged.posed(&[]).unwrap().cameras, Scene::open(&board.0).unwrap().cameras);
}

#[test]
fn animated_lights_match_an_independent_evaluation() {
    let of = |path: &str| format!("/extensions/KHR_lights_punctual/lights/{path}");
    let pointers = [of("1/color"), of("1/intensity"), of("1/range"), of("1/spot/outerConeAngle")];
    let [colour, intensity, range, outer] = pointers.each_ref().map(String::as_str);
    let board = PointerFile::new(
        "lights",
        &[
            (colour, "LINEAR", &[1., 0.5, 0.25, 0., 1., 0., 1., 1., 1.]),
            (intensity, "LINEAR", &[1.0, 8.0, 0.0]),
            (range, "STEP", &[9.0, 5.0, 7.0]),
            (outer, "LINEAR", &[0.7, 0.2, 0.9]),
        ],
        |_| {},
    );
    let (rigged, plain) = open_with_both_readers(&board);
    assert!(rigged.scene.warnings.is_empty(), "{:?}", rigged.scene.warnings.lines());
    for time in TIMES_S {
        let own = |pointer: &str| plain.pointer_value(0, pointer, time);
        let scene = rigged.posed(&[Playing::all(0, time)]).unwrap();
        assert_eq!(scene.lights[0], rigged.scene.lights[0], "nothing moves the sun");
        let spot = &scene.lights[1];
        assert!(spot.colour.iter().zip(own(colour)).all(|(a, b)| is_close(f64::from(*a), b)), "{spot:?}");
        assert!(is_close(spot.intensity, own(intensity)[0]) && is_close(spot.range.unwrap(), own(range)[0]));
        let LightKind::Spot { inner_angle, outer_angle, .. } = spot.kind else { panic!("{spot:?}") };
        assert!(is_close(inner_angle, 0.1) && is_close(outer_angle, own(outer)[0]), "{spot:?}");
    }
    let LightKind::Spot { outer_angle, .. } = rigged.scene.lights[1].kind else { panic!() };
    assert!(is_close(outer_angle, FRAC_PI_4));
}

#[test]
fn animated_materials_match_an_independent_evaluation() {
    let (base, glow) = ("/materials/0/pbrMetallicRoughness/baseColorFactor", "/materials/0/emissiveFactor");
    let (cutoff, faint) = ("/materials/1/alphaCutoff", "/materials/1/pbrMetallicRoughness/baseColorFactor");
    let board = PointerFile::new(
        "materials",
        &[
            (base, "LINEAR", &[0.5, 0.25, 0.125, 1., 1., 0., 0., 1., 0., 0., 1., 0.5]),
            (glow, "STEP", &[0., 0., 0., 0.5, 0.5, 0., 0., 0., 1.]),
            (cutoff, "LINEAR", &[0.25, 0.75, 0.0]),
            (faint, "LINEAR", &[0., 1., 0., 0.5, 0., 1., 0., 0.6, 0., 1., 0., 0.5]),
        ],
        |_| {},
    );
    let (rigged, plain) = open_with_both_readers(&board);
    assert!(rigged.scene.warnings.is_empty(), "{:?}", rigged.scene.warnings.lines());
    for time in TIMES_S {
        let own = |pointer: &str| plain.pointer_value(0, pointer, time);
        let scene = rigged.posed(&[Playing::all(0, time)]).unwrap();
        let linear =
            |v: &[f64], alpha: f32| Colour::from_linear([v[0] as f32, v[1] as f32, v[2] as f32, alpha]);
        assert_eq!(scene.materials[0].colour, linear(&own(base), 1.0), "{time}");
        assert_eq!(scene.materials[0].emissive, linear(&own(glow), 1.0), "{time}");
        let (level, alpha) = (own(cutoff)[0], own(faint)[3]);
        assert_eq!(scene.materials[1].colour, linear(&own(faint), f32::from(u8::from(alpha >= level))));
        match scene.materials[1].alpha {
            Alpha::Mask { cutoff } => assert!(is_close(f64::from(cutoff), level / alpha), "{time}: {cutoff}"),
            other => assert!(other == Alpha::Opaque && level == 0.0, "{time}: {other:?}"),
        }
    }
    assert_eq!(rigged.posed(&[]).unwrap().materials, Scene::open(&board.0).unwrap().materials);
}

/// SVG of a time of clip 0, seen by the first camera of the file: rendered alone, and as a frame of an
/// `Animator`.
fn render_alone_and_as_frame(rigged: &Rigged, style: &str, time: f64) -> [String; 2] {
    let style = Style::load(style).unwrap();
    let playing = vec![Playing::all(0, time)];
    let scene = rigged.posed(&playing).unwrap();
    let camera = Camera { width: 300.0, height: 200.0, ..scene.cameras[0].camera };
    let svg = |drawing: &ligne::drawing::Drawing| drawing.to_svg(&SvgOptions::default());
    let alone = svg(&pipeline::render(&scene, &camera, &style).unwrap());
    let page = Page { width: 300.0, height: 200.0, unit: Unit::Px, background: style.background };
    let animator = Animator::new(rigged, &style);
    let frame = |time: f64| FrameSpec { playing: vec![Playing::all(0, time)], camera, page };
    // A frame drawn earlier must not change the result.
    animator.draw(&frame(2.9)).unwrap();
    [alone, svg(&animator.draw(&frame(time)).unwrap().0)]
}

#[test]
fn drawings_show_animated_colours_lenses_and_lights() {
    let base = "/materials/0/pbrMetallicRoughness/baseColorFactor";
    let flat = |red: f32, blue: f32| [red, 0.0, blue, 1.0];
    let colours = [flat(1.0, 0.0), flat(0.0, 1.0), flat(1.0, 1.0)].concat();
    let board = PointerFile::new("drawn", &[(base, "STEP", &colours)], |_| {});
    let (rigged, _) = open_with_both_readers(&board);
    for (time, colour) in [(0.0, [255, 0, 0]), (1.0, [0, 0, 255]), (3.0, [255, 0, 255])] {
        for svg in render_alone_and_as_frame(&rigged, "flat", time) {
            // The lights of the file darken the colour slightly.
            let is_near = |fill: Colour| {
                [fill.r, fill.g, fill.b].iter().zip(colour).all(|(is, wanted)| is.abs_diff(wanted) < 2)
            };
            assert!(fill_colours(&svg).into_iter().any(is_near), "{time}: no {colour:?} in {svg}");
        }
    }
    let board =
        PointerFile::new("zoomed", &[("/cameras/0/perspective/yfov", "LINEAR", &[0.5, 1.0, 0.5])], |_| {});
    let (rigged, _) = open_with_both_readers(&board);
    let [near, far] = [0.0, 1.0].map(|time| render_alone_and_as_frame(&rigged, "ink", time));
    assert_ne!(near[0], far[0]);
    assert_ne!(near[1], far[1]);
    let pointer = "/extensions/KHR_lights_punctual/lights/1/color";
    let board = PointerFile::new("lit", &[(pointer, "STEP", &[1., 0., 0., 0., 0., 1., 0., 1., 0.])], |_| {});
    let (rigged, _) = open_with_both_readers(&board);
    let [red, blue] = [0.0, 1.0].map(|time| rigged.posed(&[Playing::all(0, time)]).unwrap().lights[1].colour);
    assert_eq!([red, blue], [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
}

/// Fill colours of all paths of an SVG.
fn fill_colours(svg: &str) -> Vec<Colour> {
    let values = svg.split(" fill=\"").skip(1).filter_map(|rest| rest.split('"').next());
    values.filter_map(Colour::parse).collect()
}

#[test]
fn broken_pointers_leave_the_stored_value_and_a_warning() {
    let one = &[1.0, 1.0, 1.0][..];
    for (name, pointer, numbers, expected) in [
        ("camera", "/cameras/7/perspective/yfov", one, "it moves camera 7, but the file has 2"),
        ("kind", "/cameras/1/perspective/yfov", one, "camera 1, which is not perspective"),
        ("width", "/cameras/0/perspective/yfov", &[1.0; 9], "accessor"),
        ("light", "/extensions/KHR_lights_punctual/lights/2/color", &[1.0; 9], "it moves light 2"),
        (
            "cone",
            "/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle",
            one,
            "which is not a spot light",
        ),
        ("colour", "/extensions/KHR_lights_punctual/lights/1/color", &[1.0; 12], "accessor"),
        ("material", "/materials/2/emissiveFactor", &[1.0; 9], "it moves material 2, but the file has 2"),
        ("three", "/materials/0/pbrMetallicRoughness/baseColorFactor", &[1.0; 9], "accessor"),
        ("metal", "/materials/0/pbrMetallicRoughness/metallicFactor", one, "not drawn"),
        ("far", "/cameras/1/orthographic/zfar", one, "not drawn"),
        ("opaque", "/materials/0/alphaCutoff", one, "not drawn"),
        ("none", "/cameras/x/perspective/yfov", one, "not drawn"),
        ("root", "", one, "not drawn"),
    ] {
        let board = PointerFile::new(name, &[(pointer, "LINEAR", numbers)], |_| {});
        let (rigged, _) = open_with_both_readers(&board);
        let lines = rigged.scene.warnings.lines();
        assert!(lines.iter().any(|line| line.contains(expected)), "{name}: {lines:?}");
        let (posed, stored) =
            (rigged.posed(&[Playing::all(0, 1.0)]).unwrap(), Scene::open(&board.0).unwrap());
        assert!(stored.warnings.is_empty());
        assert_eq!((posed.cameras, posed.lights), (stored.cameras, stored.lights), "{name}");
        assert_eq!(posed.materials, stored.materials, "{name}");
    }
    // Values that are invalid for a lens or a light leave the stored value as well.
    let board = PointerFile::new(
        "beyond",
        &[
            ("/cameras/0/perspective/yfov", "LINEAR", &[-1.0, 9.0, 0.0]),
            ("/cameras/1/orthographic/ymag", "LINEAR", &[0.0, 0.0, 0.0]),
            ("/extensions/KHR_lights_punctual/lights/0/intensity", "LINEAR", &[-1.0, -1.0, -1.0]),
        ],
        |_| {},
    );
    let (rigged, _) = open_with_both_readers(&board);
    for time in [0.0, 1.0, 3.0] {
        let scene = rigged.posed(&[Playing::all(0, time)]).unwrap();
        assert_eq!(
            (scene.cameras, scene.lights),
            (rigged.scene.cameras.clone(), rigged.scene.lights.clone())
        );
    }
}

fn hide_node(file: &mut Value, node: usize) {
    file["nodes"][node]["extensions"]["KHR_node_visibility"] = json!({"visible": false});
}

#[test]
fn nodes_hidden_at_rest_are_visible_while_a_clip_shows_them() {
    let shows = "/nodes/1/extensions/KHR_node_visibility/visible";
    let lamp = "/nodes/5/extensions/KHR_node_visibility/visible";
    let moved = [(shows, "STEP", &[0.0, 1.0, 0.0][..]), (lamp, "STEP", &[0.0, 1.0, 0.0])];
    let board = PointerFile::new("shown", &moved, |file| {
        hide_node(file, 1);
        hide_node(file, 5);
    });
    let (rigged, _) = open_with_both_readers(&board);
    let names = |scene: &Scene| scene.parts.iter().map(|part| part.name.clone()).collect::<Vec<_>>();
    let stored = Scene::open(&board.0).unwrap();
    assert_eq!((names(&stored), stored.lights.len()), (vec!["left".to_owned()], 1));
    let rest = rigged.posed(&[]).unwrap();
    assert_eq!((rest.parts, rest.lights), (stored.parts, stored.lights));
    for (time, count) in [(0.0, 1), (0.9, 1), (1.0, 2), (2.9, 2), (3.0, 1)] {
        let scene = rigged.posed(&[Playing::all(0, time)]).unwrap();
        assert_eq!((names(&scene).len(), scene.lights.len()), (count, count), "{time}");
    }
    assert_eq!(names(&rigged.posed(&[Playing::all(0, 1.0)]).unwrap()), ["left", "right"]);
    // Frames contain the node only while the clip shows it. A clip with weight 0 shows nothing.
    let paths =
        |time: f64| render_alone_and_as_frame(&rigged, "ink", time).map(|svg| svg.matches("<path").count());
    assert!(paths(1.0).iter().zip(paths(0.0)).all(|(shown, hidden)| *shown > hidden));
    assert_eq!(paths(0.0), paths(3.0));
    let silent = Playing { clip: 0, time: 1.0, weight: 0.0 };
    assert_eq!(names(&rigged.posed(&[silent]).unwrap()), ["left"]);
    let style = Style::default();
    let camera = Camera::three_quarter().fit(&rigged.scene);
    let page = Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None };
    let still =
        Animator::new(&rigged, &style).draw(&FrameSpec { playing: Vec::new(), camera, page }).unwrap().0;
    let mut marks = still.layers.iter().flat_map(|layer| &layer.marks);
    assert!(marks.all(|mark| mark.provenance.part.as_deref() == Some("left")));
}

#[test]
fn children_of_hidden_nodes_are_shown_with_them() {
    let shows = "/nodes/0/extensions/KHR_node_visibility/visible";
    let board = PointerFile::new("hanging", &[(shows, "STEP", &[0.0, 1.0, 0.0])], |file| {
        hide_node(file, 0);
        file["scenes"][0]["nodes"] = json!([0, 2, 3, 4, 5]);
        file["nodes"][0]["children"] = json!([1]);
    });
    let (rigged, _) = open_with_both_readers(&board);
    let count = |time: f64| rigged.posed(&[Playing::all(0, time)]).unwrap().parts.len();
    assert_eq!([0.0, 1.0, 3.0].map(count), [0, 2, 0]);
    // A child with its own hidden flag stays hidden when the clip shows only its parent.
    let board = PointerFile::new("child", &[(shows, "STEP", &[0.0, 1.0, 0.0])], |file| {
        hide_node(file, 0);
        hide_node(file, 1);
        file["scenes"][0]["nodes"] = json!([0, 2, 3, 4, 5]);
        file["nodes"][0]["children"] = json!([1]);
    });
    let (rigged, _) = open_with_both_readers(&board);
    assert_eq!(rigged.posed(&[Playing::all(0, 1.0)]).unwrap().parts.len(), 1);
}
