//! Creases of animated meshes against closed-form fold angles: at rest, folded by a pose with hysteresis, and
//! with hidden parts.

use std::collections::BTreeSet;

use glam::DVec3;
use ligne::animate::{Animator, FrameSpec};
use ligne::animation::{Playing, Rigged};
use ligne::drawing::{Drawing, Page, Unit};
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::{Camera, Style};
use serde_json::json;

use crate::library::support::readers::shared_folder;
use crate::library::support::scenes::pointer_board::{PointerFile, add_accessor};

const PAGE_SIDE_PX: f64 = 300.0;

/// Two squares with a common side. The right one is folded by `stored` degrees at rest, by `folded` degrees
/// at 1 s, and by `stored` degrees again at 3 s. In between its corners move in straight lines, so it
/// shrinks.
fn folded_sheet(name: &str, stored: f64, folded: f64) -> PointerFile {
    let corners = |degrees: f64| {
        let (c, s) = (cos(degrees.to_radians()) as f32, sin(degrees.to_radians()) as f32);
        let [a, b, d, e] = [[-1., 0., 0.], [0., 0., 0.], [0., 1., 0.], [-1., 1., 0.]];
        let (f, g) = ([c, 0., s], [c, 1., s]);
        [a, b, d, a, d, e, b, f, g, b, g, d].concat()
    };
    PointerFile::new(name, &[("/nodes/0/weights", "LINEAR", &[0.0, 1.0, 0.0])], |file| {
        let rest = corners(stored);
        let moves: Vec<f32> = corners(folded).iter().zip(&rest).map(|(to, from)| to - from).collect();
        let [position, target] = [rest, moves].map(|numbers| add_accessor(file, 3, &numbers));
        file["meshes"][0]["primitives"][0] =
            json!({"attributes": {"POSITION": position}, "targets": [{"POSITION": target}]});
    })
}

fn draw_frame(animator: &Animator, time: f64) -> Drawing {
    // The camera sees the front of both squares.
    let from = Camera {
        eye: DVec3::new(-1.0, 1.2, 2.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        ..Camera::three_quarter()
    };
    let camera = from.with_frame(PAGE_SIDE_PX, PAGE_SIDE_PX).fit(animator.rest());
    let page = Page { width: PAGE_SIDE_PX, height: PAGE_SIDE_PX, unit: Unit::Px, background: None };
    animator.draw(&FrameSpec { playing: vec![Playing::all(0, time)], camera, page }).unwrap().0
}

/// Number of marks of class `crease`.
fn crease_count(drawing: &Drawing) -> usize {
    let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
    marks.filter(|mark| mark.provenance.classes.contains(&"crease")).count()
}

#[test]
fn creases_at_rest_stay_creases_in_poses() {
    let (board, style) = (folded_sheet("crease", 60.0, 90.0), Style::default());
    let rigged = Rigged::open(&board.0).unwrap();
    let animator = Animator::new(&rigged, &style);
    for time in [0.0, 0.5, 1.0] {
        assert_eq!(crease_count(&draw_frame(&animator, time)), 1, "{time}");
    }
}

#[test]
fn folds_of_poses_are_creases_with_hysteresis() {
    let (board, style) = (folded_sheet("fold", 0.0, 90.0), Style::default());
    let rigged = Rigged::open(&board.0).unwrap();
    let animator = Animator::new(&rigged, &style);
    // The moving corner goes in a straight line from (1, 0) to (0, 1). At time t it is at (1 - t, t).
    let time = |degrees: f64| {
        let (s, c) = (sin(degrees.to_radians()), cos(degrees.to_radians()));
        s / (s + c)
    };
    // While the fold closes, the crease appears at 45 degrees. While it opens, the crease lasts until 35
    // degrees.
    for (degrees, closing, opening) in [(30.0, 0, 0), (36.0, 0, 1), (44.0, 0, 1), (46.0, 1, 1), (80.0, 1, 1)]
    {
        assert_eq!(crease_count(&draw_frame(&animator, time(degrees))), closing, "{degrees}");
        assert_eq!(
            crease_count(&draw_frame(&animator, 3.0 - 2.0 * time(degrees))),
            opening,
            "{degrees}, opening"
        );
    }
}

#[test]
fn creases_of_skinned_models_persist_between_frames() {
    for name in ["animated/Fox.glb", "animated/CesiumMan.glb"] {
        let Some(path) = shared_folder::find(name) else { continue };
        let (rigged, style) = (Rigged::open(&path).unwrap(), Style::default());
        let animator = Animator::new(&rigged, &style);
        let named = |time: f64| -> BTreeSet<u64> {
            let drawing = draw_frame(&animator, time);
            let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
            let creases = marks.filter(|mark| mark.provenance.classes.contains(&"crease"));
            creases.map(|mark| mark.provenance.identity).collect()
        };
        let [from, to] = rigged.rig.clips[0].span();
        let middle = from + (to - from) / 2.0;
        let (a, b) = (named(middle), named(middle + 1.0 / 24.0));
        let lost = a.symmetric_difference(&b).count();
        assert!(lost * 2 <= a.len() + b.len(), "{name}: {lost} of {} and {}", a.len(), b.len());
    }
}

#[test]
fn hiding_another_part_does_not_change_creases() {
    // The second part is hidden from 1 s on, while the sheet opens. At 2.06 s the fold is 41 degrees, which
    // would be a crease at rest. At 2.3 s it is 28 degrees.
    let with = |name: &str, hides: bool| {
        let shows = "/nodes/1/extensions/KHR_node_visibility/visible";
        let board = folded_sheet(name, 0.0, 90.0);
        let mut file: serde_json::Value = serde_json::from_slice(&std::fs::read(&board.0).unwrap()).unwrap();
        let shown = add_accessor(&mut file, 1, &[1.0, if hides { 0.0 } else { 1.0 }, 1.0]);
        let times = file["animations"][0]["samplers"][0]["input"].clone();
        let clip = &mut file["animations"][0];
        let sampler = json!({"input": times, "output": shown, "interpolation": "STEP"});
        clip["samplers"].as_array_mut().unwrap().push(sampler);
        clip["channels"].as_array_mut().unwrap().push(json!({"sampler": 1, "target": {"path": "pointer",
            "extensions": {"KHR_animation_pointer": {"pointer": shows}}}}));
        std::fs::write(&board.0, file.to_string()).unwrap();
        let rigged = Rigged::open(&board.0).unwrap();
        let style = Style::default();
        let animator = Animator::new(&rigged, &style);
        let parts = rigged.posed(&[Playing::all(0, 1.0)]).unwrap().parts.len();
        (parts, [1.0, 2.06, 2.3].map(|time| crease_count(&draw_frame(&animator, time))))
    };
    assert_eq!(with("all", false), (2, [1, 1, 0]));
    assert_eq!(with("less", true), (1, [1, 1, 0]));
}
