//! Temporal coherence of strokes: `cargo bench --bench coherence -- [STYLE…]`.
//!
//! Compares neighbouring frames of clips (1/24 s apart) and turntables (half a degree apart):
//!
//! - *kept*: share of all ink, by length, in strokes with the same name in both frames. Hidden ink counts as
//!   lost.
//! - *ceiling*: maximum of *kept* for any naming. Strokes of both frames are paired one to one by their
//!   common ink, greedily, longest first. The rest to 100 % are strokes that occlusion joins, splits, adds or
//!   removes.
//! - *renamed*: share of the ink that both frames show, point by point on the surface, whose stroke has a
//!   different name.
//! - *pops*: px per 1000 px of ink at surface points that both frames show and only one inks. A contour that
//!   slides over the surface counts as unchanged within 3 px.
//! - *hatch pops*: the same for hatching.
//! - *slip*: distance of hatching strokes from the expected positions of their surface points, across the
//!   stroke, px.
//!
//! A depth buffer of the posed triangles determines which points a frame shows, and their positions in the
//! next frame.

mod change;
mod inked;
mod seen;

use change::Change;
use inked::Inked;
use ligne::animate::{Animator, FrameSpec, Timeline, Turntable, film_points};
use ligne::animation::{Playing, Rigged};
use ligne::drawing::Page;
use ligne::glam::DAffine3;
use ligne::{Camera, Style};
use seen::Seen;

const FRAMES: usize = 24;
const DEGREES: f64 = 0.5;

/// Models with the clip that plays; none for a turntable.
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

fn main() {
    let given: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let (files, mut styles): (Vec<String>, Vec<String>) =
        given.into_iter().partition(|word| MODELS.iter().any(|(file, _)| file.contains(word.as_str())));
    if styles.is_empty() {
        styles = ["ink", "toon", "sketch", "pencil-object"].map(str::to_owned).to_vec();
    }
    println!(
        "{:<28} {:<14} {:>7} {:>7} {:>9} {:>9} {:>7} {:>11} {:>9} {:>9}",
        "model",
        "style",
        "kept %",
        "least %",
        "ceiling %",
        "renamed %",
        "pops",
        "hatch pops",
        "slip 50 %",
        "slip 95 %"
    );
    for (file, clip) in MODELS {
        if !files.is_empty() && !files.iter().any(|word| file.contains(word.as_str())) {
            continue;
        }
        let Ok(rigged) = Rigged::open(file) else {
            println!("{file}: not there, left out");
            continue;
        };
        for style in &styles {
            let sheet = Style::load(style).expect("a style");
            print_changes(file.rsplit('/').next().unwrap_or(file), style, &changes(&rigged, clip, &sheet));
        }
    }
}

fn print_changes(name: &str, style: &str, changes: &[Change]) {
    let mean = |of: fn(&Change) -> f64| changes.iter().map(of).sum::<f64>() / changes.len().max(1) as f64;
    let least = changes.iter().map(|change| change.kept).fold(1.0, f64::min);
    let mut slips: Vec<f64> = changes.iter().flat_map(|change| change.slips_px.iter().copied()).collect();
    slips.sort_by(f64::total_cmp);
    let slip = |share: f64| {
        let place = (slips.len() as f64 * share) as usize;
        slips.get(place).map_or_else(|| "-".to_owned(), |slip| format!("{slip:.3}"))
    };
    let hatching = if slips.is_empty() {
        "-".to_owned()
    } else {
        format!("{:.2}", 1000.0 * mean(|change| change.hatching_popped))
    };
    println!(
        "{name:<28} {style:<14} {:>7.2} {:>7.2} {:>9.2} {:>9.2} {:>7.2} {hatching:>11} {:>9} {:>9}",
        100.0 * mean(|change| change.kept),
        100.0 * least,
        100.0 * mean(|change| change.ceiling),
        100.0 * mean(|change| change.renamed),
        1000.0 * mean(|change| change.popped),
        slip(0.5),
        slip(0.95),
    );
}

fn changes(rigged: &Rigged, clip: Option<&str>, style: &Style) -> Vec<Change> {
    let clip = clip.map(|name| rigged.clips().iter().position(|clip| clip.name == name).unwrap_or(0));
    let from = clip.map_or(0.0, |clip| rigged.clips()[clip].span()[0]);
    let timeline = Timeline::of_frames(FRAMES, from, 24.0).expect("a timeline");
    let steps = (360.0 / DEGREES) as usize;
    let table = clip.is_none().then(|| Turntable::round(&rigged.scene, steps));
    let playing = |frame: usize| -> Vec<Playing> {
        clip.map(|clip| Playing::all(clip, timeline.time(frame))).into_iter().collect()
    };
    let moved = |frame: usize| table.map_or(DAffine3::IDENTITY, |table| table.turn(steps - frame % steps));
    let poses: Vec<_> = timeline.drawn_frames().map(|frame| (playing(frame), moved(frame))).collect();
    let points = film_points(rigged, &poses).expect("poses");
    let camera = Camera::three_quarter_of(rigged.scene.up).fit_points(&points, 0.05);
    let page = Page::px(camera.width, camera.height);
    let animator = Animator::new(rigged, style);
    let of = |frame: usize| {
        let camera = table.map_or(camera, |table| table.camera(&camera, frame));
        let playing = playing(frame);
        let scene = rigged.posed(&playing).expect("a pose");
        let (drawing, _) = animator.draw(&FrameSpec { playing, camera, page }).expect("a drawing");
        Inked::new(&drawing, Seen::new(&scene, &camera))
    };
    let mut changes = Vec::new();
    let mut last = None;
    for frame in timeline.drawn_frames() {
        let inked = of(frame);
        if let Some(before) = &last {
            changes.push(Change::between(before, &inked));
        }
        last = Some(inked);
    }
    changes
}
