//! How well strokes last from frame to frame: `cargo bench --bench coherence -- [STYLE…]`.
//!
//! Neighbouring frames of clips (1/24 s apart) and of turns (half a degree apart) are compared: *kept* is how much of the ink is in
//! strokes that have the same identity in both, by length, *new* how much of it is farther than 3 px from all ink of the frame before,
//! per 1000 px. Both count what comes in sight and goes out of sight.

use std::collections::BTreeMap;

use kurbo::{ParamCurveArclen, PathEl, Point};
use ligne::animate::{Animator, Moment, Timeline, Turntable, reach};
use ligne::drawing::{Drawing, LayerKind, Page, Paint, Unit};
use ligne::glam::DAffine3;
use ligne::kurbo;
use ligne::pose::{Playing, Rigged};
use ligne::{Camera, Style};

const FRAMES: usize = 24;
const DEGREES: f64 = 0.5;
const NEAR_PX: f64 = 3.0;
const STEP_PX: f64 = 2.0;

/// Models, and the clip that plays; none for a turn.
const MODELS: [(&str, Option<&str>); 8] = [
    ("examples/models/crane.glb", Some("lift")),
    ("../shared/models/animated/Fox.glb", Some("Run")),
    ("../shared/models/animated/Knight.glb", None),
    ("../shared/models/animated/CesiumMan.glb", Some("")),
    ("../shared/models/cad/drive.glb", None),
    ("../shared/models/organic/stanford-bunny.obj", None),
    ("../shared/models/scene/castle/building_castle_blue.obj", None),
    ("examples/models/gear.obj", None),
];

/// The ink of a frame: points a few px apart, by identity, and lengths.
#[derive(Default)]
struct Ink {
    lengths: BTreeMap<u64, f64>,
    points: Vec<Point>,
    all: f64,
}

fn main() {
    let given: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let styles =
        if given.is_empty() { vec!["ink".to_owned(), "toon".to_owned(), "sketch".to_owned()] } else { given };
    println!("{:<28} {:<10} {:>9} {:>9} {:>12}", "model", "style", "kept %", "least %", "new per 1000");
    for (file, clip) in MODELS {
        let Ok(rigged) = Rigged::open(file) else {
            println!("{file}: not there, left out");
            continue;
        };
        for style in &styles {
            let sheet = Style::load(style, &[]).expect("a style");
            let frames = frames(&rigged, clip, &sheet);
            let (mut kept, mut new) = (Vec::new(), Vec::new());
            for pair in frames.windows(2) {
                let [before, after] = pair else { continue };
                kept.push(100.0 * share_kept(before, after));
                new.push(1000.0 * share_new(before, after));
            }
            let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
            let least = kept.iter().copied().fold(100.0, f64::min);
            let name = file.rsplit('/').next().unwrap_or(file);
            println!("{name:<28} {style:<10} {:>9.2} {least:>9.2} {:>12.2}", mean(&kept), mean(&new));
        }
    }
}

fn frames(rigged: &Rigged, clip: Option<&str>, style: &Style) -> Vec<Ink> {
    let clip = clip.map(|name| rigged.rig.clip(name).unwrap_or(0));
    let from = clip.map_or(0.0, |clip| rigged.rig.clips[clip].span()[0]);
    let timeline = Timeline::of_frames(FRAMES, from, 24.0).expect("a timeline");
    let steps = (360.0 / DEGREES) as usize;
    let table = clip.is_none().then(|| Turntable::round(&rigged.scene, steps));
    let playing = |frame: usize| -> Vec<Playing> {
        clip.map(|clip| Playing::all(clip, timeline.time(frame))).into_iter().collect()
    };
    let moved = |frame: usize| table.map_or(DAffine3::IDENTITY, |table| table.turn(steps - frame % steps));
    let poses: Vec<_> = timeline.drawn().map(|frame| (playing(frame), moved(frame))).collect();
    let points = reach(rigged, &poses).expect("poses");
    let camera = Camera::three_quarter_of(rigged.scene.up).fit_points(&points, 0.05);
    let page = Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None };
    let animator = Animator::new(rigged, style);
    let of = |frame: usize| {
        let camera = table.map_or(camera, |table| table.camera(&camera, frame));
        let (drawing, _) =
            animator.draw(&Moment { playing: playing(frame), camera, page }).expect("a drawing");
        ink(&drawing)
    };
    timeline.drawn().map(of).collect()
}

fn ink(drawing: &Drawing) -> Ink {
    let mut ink = Ink::default();
    for mark in
        drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Lines).flat_map(|layer| &layer.marks)
    {
        let path = match &mark.paint {
            Paint::Outline(outline) => &outline.axis,
            _ => &mark.path,
        };
        let length: f64 = path.segments().map(|segment| segment.arclen(0.1)).sum();
        *ink.lengths.entry(mark.provenance.identity).or_default() += length;
        ink.all += length;
        let mut last = Point::ZERO;
        kurbo::flatten(path.iter(), 0.1, |element| {
            if let PathEl::LineTo(to) = element {
                let count = (last.distance(to) / STEP_PX).ceil().max(1.0);
                ink.points.extend((0..count as usize).map(|step| last.lerp(to, step as f64 / count)));
            }
            if let PathEl::MoveTo(to) | PathEl::LineTo(to) = element {
                last = to;
            }
        });
    }
    ink
}

fn share_kept(before: &Ink, after: &Ink) -> f64 {
    let common = |(id, length): (&u64, &f64)| match before.lengths.get(id) {
        Some(other) if *id != 0 => length.min(*other),
        _ => 0.0,
    };
    after.lengths.iter().map(common).sum::<f64>() / before.all.min(after.all).max(1e-9)
}

fn share_new(before: &Ink, after: &Ink) -> f64 {
    let cell = |p: Point| [(p.x / NEAR_PX).floor() as i64, (p.y / NEAR_PX).floor() as i64];
    let mut cells: BTreeMap<[i64; 2], Vec<Point>> = BTreeMap::new();
    for point in &before.points {
        cells.entry(cell(*point)).or_default().push(*point);
    }
    let near = |point: &Point| {
        let [x, y] = cell(*point);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
        around.filter_map(|cell| cells.get(&cell)).flatten().any(|other| other.distance(*point) <= NEAR_PX)
    };
    let new = after.points.iter().filter(|point| !near(point)).count();
    new as f64 / after.points.len().max(1) as f64
}
