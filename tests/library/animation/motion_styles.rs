//! Motion lines as styles set them: which parts leave them, their number, their pens, and the messages for
//! wrong settings.

use glam::{DAffine3, DVec3};
use kurbo::ParamCurve;
use ligne::animation::deformable_mesh::Influences;
use ligne::animation::rig::{GeometryRig, Skin};
use ligne::animation::{DeformableMesh, NodeProperty, Playing, Rigged};
use ligne::drawing::{Drawing, LayerKind, Paint};
use ligne::{Style, SvgOptions, motion, render};

use crate::library::support::pipeline::orthographic;
use crate::library::support::scenes::moving_boxes::*;
use crate::library::support::scenes::solids::cuboid;

#[test]
fn bodies_below_the_speed_threshold_leave_no_lines() {
    // One box moves at 2 units (200 px) per second, one at half that speed, one not at all.
    let at = |x: f64| unit_cube().moved(|p| p + DVec3::new(0.0, x, 0.0));
    let model = rig_solids(
        vec![at(-2.0), at(0.0), at(2.0)],
        vec![translation_channel(0, DVec3::X * 2.0), translation_channel(1, DVec3::X * 1.0)],
    );
    let parts = |changes: &[&str]| -> Vec<String> {
        let drawing = draw_at(&model, 1.0, &front_camera(), &motion_style(changes));
        let mut names: Vec<String> = motion_lines(&drawing)
            .iter()
            .map(|mark| mark.provenance.part.as_ref().unwrap().to_string())
            .collect();
        names.dedup();
        names
    };
    assert_eq!(parts(&["motion.speed=1.99"]), ["part 0"]);
    assert_eq!(parts(&["motion.speed=0.99"]), ["part 0", "part 1"]);
    assert!(parts(&["motion.speed=2.01"]).is_empty());
    assert_eq!(parts(&["motion.speed=199px"]), ["part 0"]);
    assert_eq!(parts(&["motion.speed=99px"]), ["part 0", "part 1"]);
    assert_eq!(parts(&["motion.speed=53mm"]), Vec::<String>::new());
    // Selection by part or node name, alone and together with a speed.
    assert_eq!(parts(&["motion.parts=part 1"]), ["part 1"]);
    assert_eq!(parts(&["motion.parts=['node 1', '*2']"]), ["part 1"]);
    assert_eq!(parts(&["motion.parts=part 1", "motion.speed=1.5"]), ["part 0", "part 1"]);
    // The default threshold is half the size of the model (5.2 units) per second.
    assert!(parts(&[]).is_empty());
    assert!(parts(&["motion.enabled=false", "motion.speed=1"]).is_empty());
    // The file can mark a node and everything below it.
    let mut told = model.clone();
    told.rig.nodes[1].leaves_lines = true;
    assert!(!motion_lines(&draw_at(&told, 1.0, &front_camera(), &motion_style(&[]))).is_empty());
    // A removed part leaves no lines. Other parts keep theirs.
    let style = motion_style(&["motion.speed=0.5"]);
    let mut scene = posed_scene(&model, 1.0, &style);
    scene.keep_parts(&[], &["part 0".to_owned()]);
    let left = render(&scene, &front_camera(), &style).unwrap();
    assert!(motion_lines(&left).iter().all(|mark| mark.provenance.part.as_deref() == Some("part 1")));
    assert!(!motion_lines(&left).is_empty());
}

/// One skinned part along x. A second joint swings its far half about the origin.
fn arm(upper: f64, lower: f64) -> Rigged {
    let solid = cuboid(DVec3::new(-2.0, -0.2, -0.2), DVec3::new(2.0, 0.2, 0.2));
    let mut model =
        rig_solids(vec![solid.clone()], vec![rotation_channel(1, upper), rotation_channel(2, lower)]);
    let far: Vec<u32> = solid.positions.iter().map(|p| u32::from(p.x > 0.0)).collect();
    let rig = &mut model.rig;
    rig.nodes =
        vec![identity_node("arm", None), identity_node("shoulder", None), identity_node("hand", Some(1))];
    rig.order = vec![0, 1, 2];
    rig.skins = vec![Skin { joints: vec![1, 2], binds: vec![DAffine3::IDENTITY; 2] }];
    let sets = vec![Influences {
        joints: far.iter().map(|joint| [*joint, 1 - *joint, 0, 0]).collect(),
        weights: vec![[0.75, 0.25, 0.0, 0.0]; 8],
    }];
    let body = DeformableMesh { positions: solid.positions, sets, ..DeformableMesh::default() };
    rig.forms = vec![GeometryRig { node: 0, skin: Some(0), bodies: vec![body] }];
    model
}

#[test]
fn joints_leave_separate_motion_lines() {
    let model = arm(0.0, 60.0);
    let own = motion_style(&["motion.speed=0.9", "motion.over=true"]);
    let scene = posed_scene(&model, 1.0, &own);
    let movers = scene.movers.as_ref().unwrap();
    let chosen: Vec<_> = movers.iter().filter(|mover| mover.chosen).collect();
    assert_eq!(chosen.len(), 1, "the hand alone is fast");
    assert_eq!(chosen[0].trails.len(), 4, "it has four corners");
    let drawing = render(&scene, &front_camera(), &own).unwrap();
    assert!(!motion_lines(&drawing).is_empty());
    // Selection by the name of the joint and of its parent.
    for name in ["hand", "h?nd", "shoulder"] {
        let own = motion_style(&[&format!("motion.parts={name}"), "motion.over=true"]);
        let named = draw_at(&model, 1.0, &front_camera(), &own);
        assert!(!motion_lines(&named).is_empty(), "{name}");
    }
    // Joints that move together share the lines of one body. The outermost joint comes first.
    let model = arm(50.0, 50.0);
    let own = motion_style(&["motion.speed=0.1", "motion.over=true", "motion.lines=3", "chain.tidy=0"]);
    let both = draw_at(&model, 1.0, &orthographic(DVec3::new(3.0, 5.0, 50.0), DVec3::ZERO, 10.0), &own);
    let names: Vec<_> = motion_lines(&both);
    assert!(!names.is_empty() && names.len() <= 6, "{}", names.len());
    let scene = posed_scene(&model, 1.0, &own);
    let above: Vec<Option<usize>> = scene.movers.as_ref().unwrap().iter().map(|m| m.above).collect();
    assert_eq!(above, [None, Some(0)]);
}

#[test]
fn single_motion_lines_can_be_styled() {
    let speed = DVec3::X * 2.0;
    let model = rig_solids(vec![unit_cube()], vec![translation_channel(0, speed)]);
    let list = "[{ start = 6, length = 6, width = 3, colour = '#ff0000' }, { visible = false }, { part = 'other*' }]";
    let own = motion_style(&["motion.lines=2", "motion.over=true", &format!("motion.line={list}")]);
    let scene = posed_scene(&model, 1.0, &own);
    let trails = &scene.movers.as_ref().unwrap()[0].trails;
    assert_eq!(trails.len(), 1, "one of two is not drawn");
    assert_eq!(trails[0].points[0], unit_cube().positions[6] + speed);
    assert_eq!(trails[0].points.len(), 6 * motion::POINTS_PER_SEGMENT + 1);
    let drawing = render(&scene, &front_camera(), &own).unwrap();
    let [mark] = motion_lines(&drawing)[..] else { panic!("one line") };
    let Paint::Stroke(stroke) = &mark.paint else { panic!("{:?}", mark.paint) };
    assert_eq!((stroke.width, stroke.colour), (3.0, ligne::colour::srgb::Colour::rgb(255, 0, 0)));
    // A missing vertex causes a warning.
    let own = motion_style(&["motion.line=[{ start = 99 }]"]);
    let scene = posed_scene(&model, 1.0, &own);
    assert!(
        scene.warnings.lines().iter().any(|line| line.contains("vertex 99")),
        "{:?}",
        scene.warnings.lines()
    );
}

#[test]
fn motion_lines_are_black_and_1_px_wide_and_may_taper() {
    let model = rig_solids(vec![unit_cube()], vec![translation_channel(0, DVec3::X * 2.0)]);
    let plain = draw_at(&model, 1.0, &front_camera(), &motion_style(&["motion.over=true"]));
    for mark in motion_lines(&plain) {
        let Paint::Stroke(stroke) = &mark.paint else { panic!("{:?}", mark.paint) };
        assert_eq!((stroke.width, stroke.colour), (1.0, ligne::colour::srgb::Colour::BLACK));
    }
    let tapered = draw_at(
        &model,
        1.0,
        &front_camera(),
        &motion_style(&["motion.lines=1", "motion.line=[{ start = 6 }]", "motion.taper=1", "motion.width=4"]),
    );
    for mark in motion_lines(&tapered) {
        let Paint::Outline(outline) = &mark.paint else { panic!("{:?}", mark.paint) };
        assert!(outline.width > 0.5 && outline.width < 3.0, "{}", outline.width);
        let [start, end] = motion_line_ends(mark, TRAIL_LEFT);
        let wide = |at: f64| {
            let near = mark.path.segments().flat_map(|s| (0..=50).map(move |k| s.eval(f64::from(k) / 50.0)));
            near.filter(|p| (p.x - at).abs() < 3.0).map(|p| (p.y - start.y).abs()).fold(0.0, f64::max)
        };
        let [near, far] = [wide(start.x - 8.0), wide(end.x + 8.0)];
        assert!(far < 0.3 && near > far + 0.5, "{near} {far} {start:?} {end:?}");
    }
    assert!(!motion_lines(&tapered).is_empty());
    // A pen rule for motion lines changes their pen. A rule for all kinds does not.
    let ruled =
        draw_at(&model, 1.0, &front_camera(), &motion_style(&["pen.motion.dash=[4, 2]", "pen.width=9"]));
    let strokes: Vec<_> = motion_lines(&ruled)
        .iter()
        .map(|mark| match &mark.paint {
            Paint::Stroke(stroke) => (stroke.width, stroke.dash.is_empty()),
            other => panic!("{other:?}"),
        })
        .collect();
    assert!(strokes.iter().all(|(width, _)| *width == 1.0) && strokes.iter().any(|(_, solid)| !solid));
}

#[test]
fn motion_lines_do_not_change_other_layers() {
    let model = Rigged::open("examples/models/brick.glb").unwrap();
    let camera = model.scene.cameras[0].camera;
    for name in ["ink", "toon", "comic"] {
        let load = |sets: &[&str]| {
            let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
            Style::load_with(name, &sets).unwrap()
        };
        let with = draw_at(&model, 1.0, &camera, &load(&["motion.enabled=true"]));
        let without = draw_at(&model, 1.0, &camera, &load(&[]));
        let kinds: Vec<LayerKind> = with.layers.iter().map(|layer| layer.kind).collect();
        assert!(kinds.contains(&LayerKind::Motion) && kinds.is_sorted(), "{kinds:?}");
        let others: Vec<_> =
            with.layers.iter().filter(|layer| layer.kind != LayerKind::Motion).cloned().collect();
        assert_eq!(others, without.layers);
        // In the file only the brick is marked to leave lines.
        assert!(motion_lines(&with).iter().all(|mark| mark.provenance.part.as_deref() == Some("brick")));
    }
}

#[test]
fn motion_lines_do_not_depend_on_thread_count() {
    let model = Rigged::open("examples/models/brick.glb").unwrap();
    let camera = model.scene.cameras[0].camera;
    let own = motion_style(&["motion.speed=0.5", "motion.taper=1"]);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| draw_at(&model, 1.1, &camera, &own).to_svg(&SvgOptions::default()))
    };
    let one = with(1);
    assert!(one.contains(r#"class="motion""#) && one.contains("data-axis"));
    assert_eq!(one, with(2));
    assert_eq!(one, with(7));
}

#[test]
fn motion_lines_without_a_moment_give_a_warning() {
    let own = motion_style(&[]);
    let model = rig_solids(vec![unit_cube()], vec![translation_channel(0, DVec3::X)]);
    let told =
        |drawing: &Drawing| drawing.warnings.iter().any(|warning| warning.text.contains("no motion lines"));
    let still = render(&model.scene, &front_camera(), &own).unwrap();
    assert!(told(&still) && motion_lines(&still).is_empty());
    assert!(!told(&draw_at(&model, 0.0, &front_camera(), &own)));
    assert!(!told(&render(&model.scene, &front_camera(), &Style::default()).unwrap()));
    let none = Rigged::from(model.scene);
    assert!(told(
        &render(&motion::posed(&none, &[], &own.motion, 0).unwrap(), &front_camera(), &own).unwrap()
    ));
}

#[test]
fn invalid_motion_settings_are_refused() {
    for (change, what, remedy) in [
        ("motion.lines=0", "0 is not a count", "a whole number from 1 to 1000"),
        ("motion.segments=2.5", "2.5 is not a count", "a whole number from 1 to 1000"),
        ("motion.rate=0", "0 segments per second", "a number from 0.001 to 10000"),
        ("motion.turn=200", "200 is not an angle", "degrees from 0 to 180"),
        ("motion.taper=2", "2 is not a fraction", "a number from 0 to 1"),
        ("motion.speed=-1", "-1 is not a speed", "model units per second, at least 0"),
        ("motion.speed=fast", "`fast` is not a speed", "such as \"200px\""),
        ("motion.path=way", "unknown value `way`", "known values: vertex, body"),
        ("motion.line=[{ lenght = 3 }]", "unknown key `lenght`", "did you mean `length`?"),
        ("motion.segmnts=3", "unknown key `segmnts`", "did you mean `segments`?"),
        ("motion.line=[{ length = 0 }]", "0 is not a count", "a whole number"),
    ] {
        let error = Style::load_with("ink", &[change.to_owned()]).unwrap_err().to_string();
        assert!(error.contains(&format!("--set {change}")) && error.contains(what), "{change}: {error}");
        assert!(error.contains(remedy), "{change}: {error}");
    }
}

#[test]
fn bodies_scaled_to_zero_leave_no_motion_lines() {
    let moving = translation_channel(0, DVec3::X * 2.0);
    let scales = |values: &[[f64; 3]]| {
        let times: Vec<f64> = (0..values.len()).map(|k| k as f64 * 0.4).collect();
        linear_channel(0, NodeProperty::Scale, &times, values.as_flattened())
    };
    let own = motion_style(&["motion.speed=0.1"]);
    let whole = [1.0; 3];
    let model = rig_solids(vec![unit_cube()], vec![moving.clone(), scales(&[whole, whole, whole])]);
    assert!(!motion_lines(&draw_at(&model, 0.8, &front_camera(), &own)).is_empty());
    for none in [[0.0; 3], [1.0, 0.0, 0.0]] {
        let model = rig_solids(vec![unit_cube()], vec![moving.clone(), scales(&[whole, none, none])]);
        let drawing = draw_at(&model, 0.8, &front_camera(), &own);
        assert!(motion_lines(&drawing).is_empty(), "{none:?}");
    }
}

#[test]
fn moments_without_motion_lines_are_explained() {
    let model = rig_solids(vec![unit_cube()], vec![translation_channel(0, DVec3::X)]);
    let why = |time: f64, changes: &[&str]| {
        let own = motion_style(changes);
        let playing = [Playing::all(0, time)];
        let scene = motion::posed(&model, &playing, &own.motion, own.seed).unwrap();
        motion::no_lines_reason(&model, &playing, &own.motion, &scene)
    };
    let said = |time: f64, changes: &[&str], words: &str| {
        let reason = why(time, changes).unwrap_or_default();
        assert!(reason.starts_with("no motion lines: ") && reason.contains(words), "{changes:?}: {reason}");
    };
    said(0.0, &[], "nothing moves at this moment");
    said(1.0, &["motion.speed=7.5"], "'part 0', goes 1.000 units a second, not more than 7.500");
    said(1.0, &["motion.parts=door"], "motion.parts does not name");
    assert_eq!(why(1.0, &["motion.speed=0.5"]), None);
    assert_eq!(why(1.0, &["motion.enabled=false"]), None);
    // Lines outside the frame.
    let own = motion_style(&["motion.speed=0.5"]);
    let mut aside = front_camera();
    aside.target.y += 90.0;
    aside.eye.y += 90.0;
    let drawing = draw_at(&model, 1.0, &aside, &own);
    assert!(drawing.warnings.iter().any(|warning| warning.text.contains("outside the frame")));
}
