//! Frames depend only on their moment, and strokes keep their identity and fade.

use std::collections::{BTreeMap, BTreeSet};

use glam::DAffine3;
use kurbo::Shape;
use ligne::animate::{Animator, FrameSpec, StrokeTrace, Timeline, Turntable, fade, film_points};
use ligne::animation::{Playing, Rigged};
use ligne::drawing::{Drawing, LayerKind, Page, Paint, Unit};
use ligne::motion::FadeBy;
use ligne::pipeline::Renderer;
use ligne::{Camera, Style, SvgOptions};

pub(crate) const PAGE_SIDE_PX: f64 = 300.0;

pub(crate) fn crane() -> Rigged {
    Rigged::open("examples/models/crane.glb").unwrap()
}

fn page() -> Page {
    Page { width: PAGE_SIDE_PX, height: PAGE_SIDE_PX, unit: Unit::Px, background: None }
}

/// Moments of the crane's clip at `fps` frames per second. One camera frames all poses.
pub(crate) fn moments(crane: &Rigged, fps: f64) -> Vec<FrameSpec> {
    let [from, to] = crane.rig.clips[0].span();
    let timeline = Timeline::between(from, to, fps).unwrap();
    let playing = |frame: usize| vec![Playing::all(0, timeline.time(frame))];
    let poses: Vec<_> = timeline.drawn_frames().map(|frame| (playing(frame), DAffine3::IDENTITY)).collect();
    let points = film_points(crane, &poses).unwrap();
    let camera = Camera::three_quarter().with_frame(PAGE_SIDE_PX, PAGE_SIDE_PX).fit_points(&points, 0.05);
    timeline.drawn_frames().map(|frame| FrameSpec { playing: playing(frame), camera, page: page() }).collect()
}

pub(crate) fn drawings(moments: &[FrameSpec], crane: &Rigged, style: &Style) -> Vec<Drawing> {
    let animator = Animator::new(crane, style);
    moments.iter().map(|moment| animator.draw(moment).unwrap().0).collect()
}

/// Stroke length in px by stroke identity.
fn stroke_lengths(drawing: &Drawing) -> BTreeMap<u64, f64> {
    let mut strokes = BTreeMap::new();
    for layer in drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Lines) {
        for mark in &layer.marks {
            *strokes.entry(mark.provenance.identity).or_default() += mark.path.perimeter(0.1);
        }
    }
    strokes
}

#[test]
fn frames_depend_only_on_their_moment() {
    let (crane, style) = (crane(), Style::load("sketch").unwrap());
    let moments = moments(&crane, 2.0);
    let svg = |drawing: &Drawing| drawing.to_svg(&SvgOptions::default());
    let mut animator = Animator::new(&crane, &style);
    let run: Vec<String> = moments.iter().map(|moment| svg(animator.step(moment).unwrap())).collect();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for (moment, text) in moments.iter().zip(&run).rev() {
        let alone = one.install(|| Animator::new(&crane, &style).draw(moment).unwrap().0);
        assert_eq!(svg(&alone), *text);
    }
    assert_eq!(run.iter().collect::<BTreeSet<_>>().len(), run.len(), "something moves in every frame");
}

#[test]
fn frames_from_the_rest_pose_equal_fresh_drawings() {
    let crane = crane();
    for name in ["ink", "toon"] {
        let style = Style::load(name).unwrap();
        for moment in moments(&crane, 1.0) {
            let (followed, report) = Animator::new(&crane, &style).draw(&moment).unwrap();
            let posed = crane.posed(&moment.playing).unwrap();
            let (anew, other) = Renderer::new(&posed, &style).draw(&moment.camera, moment.page).unwrap();
            assert_eq!(report.counts.edges, other.counts.edges);
            let plain = |drawing: &Drawing| {
                let mut drawing = drawing.clone();
                let marks = drawing.layers.iter_mut().flat_map(|layer| &mut layer.marks);
                marks.for_each(|mark| mark.provenance.identity = 0);
                drawing.to_svg(&SvgOptions::default())
            };
            assert_eq!(plain(&followed), plain(&anew), "{name}");
        }
    }
}

#[test]
fn strokes_have_unique_identities_that_persist_between_frames() {
    let (crane, style) = (crane(), Style::load("ink").unwrap());
    let frames: Vec<BTreeMap<u64, f64>> =
        drawings(&moments(&crane, 24.0)[..24], &crane, &style).iter().map(stroke_lengths).collect();
    let (mut kept, mut all) = (0.0, 0.0);
    for pair in frames.windows(2) {
        assert!(!pair[0].contains_key(&0), "a stroke without a name");
        let common = pair[1].iter().filter_map(|(id, length)| Some(length.min(*pair[0].get(id)?)));
        kept += common.sum::<f64>();
        all += pair[0].values().sum::<f64>().min(pair[1].values().sum());
    }
    assert!(kept > 0.97 * all, "{}", kept / all);
    for drawing in drawings(&moments(&crane, 1.0), &crane, &style) {
        let marks = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Lines);
        let names: Vec<u64> =
            marks.flat_map(|layer| &layer.marks).map(|mark| mark.provenance.identity).collect();
        assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len());
    }
}

#[test]
fn tremor_of_static_parts_does_not_change_between_frames() {
    // The base of the crane does not move. In consecutive frames at least three quarters of its lines must be
    // identical.
    let style = Style::load_with("ink", &["pen.hand.tremor=3".to_owned()]);
    let Ok(style) = style else { panic!("{style:?}") };
    let crane = crane();
    let moments = moments(&crane, 24.0);
    let base = |drawing: &Drawing| {
        let marks = drawing.layers.iter().flat_map(|layer| layer.marks.clone());
        let of_base = marks.filter(|mark| mark.provenance.part.as_deref() == Some("base"));
        of_base.map(|mark| (mark.provenance.identity, mark.path.to_svg())).collect::<BTreeMap<_, _>>()
    };
    let frames: Vec<_> = drawings(&moments[..6], &crane, &style).iter().map(base).collect();
    for pair in frames.windows(2) {
        let same = pair[0].iter().filter(|(id, path)| pair[1].get(id) == Some(path)).count();
        assert!(same * 4 >= pair[0].len() * 3, "{same} of {}", pair[0].len());
    }
}

#[test]
fn appearing_and_disappearing_strokes_fade() {
    let crane = crane();
    // Variable-width outlines and plain strokes, faded by width and by opacity.
    for (sheet, by) in [("ink", FadeBy::Width), ("sketch", FadeBy::Width), ("sketch", FadeBy::Opacity)] {
        let style = Style::load(sheet).unwrap();
        let drawings = drawings(&moments(&crane, 12.0), &crane, &style);
        let traces: Vec<StrokeTrace> = drawings.iter().map(StrokeTrace::of).collect();
        let names: Vec<BTreeMap<u64, f64>> = drawings.iter().map(stroke_lengths).collect();
        const FADE_FRAMES: usize = 3;
        let (mut faded, mut others, mut joined) = (0, 0, 0);
        for frame in 0..drawings.len() {
            let at = |by: isize| frame.checked_add_signed(by).filter(|frame| *frame < drawings.len());
            let pairs = || (1..=FADE_FRAMES as isize).map(|far| [at(-far), at(far)]);
            let around: Vec<_> = pairs().map(|pair| pair.map(|frame| frame.map(|k| &traces[k]))).collect();
            let mut drawing = drawings[frame].clone();
            fade(&mut drawing, &around, by);
            let marks = |drawing: &Drawing| {
                drawing.layers.iter().flat_map(|layer| layer.marks.clone()).collect::<Vec<_>>()
            };
            for (before, after) in marks(&drawings[frame]).into_iter().zip(marks(&drawing)) {
                let name = before.provenance.identity;
                let lacking = pairs()
                    .position(|pair| pair.into_iter().flatten().any(|k| !names[k].contains_key(&name)));
                let share = match (&before.paint, &after.paint, by) {
                    (Paint::Stroke(a), Paint::Stroke(b), FadeBy::Width) => b.width / a.width,
                    (Paint::Outline(a), Paint::Outline(b), FadeBy::Width) => {
                        // The area scales with the width.
                        let area = after.path.area().abs() / before.path.area().abs();
                        assert!(a == b || (area - b.width / a.width).abs() < 0.15, "{area}");
                        b.width / a.width
                    }
                    (Paint::Stroke(a), Paint::Stroke(b), _) => f64::from(b.colour.a) / f64::from(a.colour.a),
                    (Paint::Outline(a), Paint::Outline(b), _) => {
                        f64::from(b.colour.a) / f64::from(a.colour.a)
                    }
                    _ => 1.0,
                };
                let of_four = (share * 4.0).round() as usize;
                assert!((share * 4.0 - of_four as f64).abs() < 0.02 && of_four > 0, "{share}");
                match lacking {
                    // A stroke that continues under another identity fades less.
                    Some(far) if of_four == far + 1 => faded += 1,
                    Some(far) => {
                        assert!(of_four > far + 1, "{of_four} {far}");
                        joined += 1;
                    }
                    None => {
                        assert_eq!(before, after);
                        others += 1;
                    }
                }
            }
        }
        assert!(faded > 20 && others > 2 * faded, "{sheet}: {faded} {joined} {others}");
    }
}

#[test]
fn turntables_frame_the_model_from_all_sides() {
    let rigged = Rigged::open("examples/models/gear.obj").unwrap();
    let table = Turntable::round(&rigged.scene, 8);
    let poses: Vec<_> = (0..8).map(|step| (Vec::new(), table.turn(8 - step))).collect();
    let points = film_points(&rigged, &poses).unwrap();
    let first = Camera::three_quarter_of(rigged.scene.up)
        .with_frame(PAGE_SIDE_PX, PAGE_SIDE_PX)
        .fit_points(&points, 0.05);
    let style = Style::default();
    let animator = Animator::new(&rigged, &style);
    let mut touched = 0.0_f64;
    for step in 0..8 {
        let camera = table.camera(&first, step);
        let (drawing, _) = animator.draw(&FrameSpec { playing: Vec::new(), camera, page: page() }).unwrap();
        let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
        let bounds = marks.map(|mark| mark.path.bounding_box()).reduce(|a, b| a.union(b)).unwrap();
        assert!(
            bounds.x0 > 0.0 && bounds.y0 > 0.0 && bounds.x1 < PAGE_SIDE_PX && bounds.y1 < PAGE_SIDE_PX,
            "{bounds:?}"
        );
        touched = touched.max(bounds.width().max(bounds.height()));
    }
    assert!(touched > 0.85 * PAGE_SIDE_PX, "{touched}");
}
