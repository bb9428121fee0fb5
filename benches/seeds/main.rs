//! Frames per second, measured as in the papers that founded this field: `cargo bench --bench seeds`.
//!
//! - By passes and faces: Ishaya, "Real-time cartoon rendering with Direct-X 8.0 hardware", 2003, figure 4
//!   (1,200, 26,000 and 40,000 polygons), and Claes and others, "Fast 3D cartoon rendering with improved
//!   quality by exploiting graphics hardware", 2001 (6,280 and 10,396 faces). Here: levels of a wavy ring,
//!   turned by one degree per frame.
//! - With and without animation, against plain shading: Lake and others, "Stylized rendering techniques for
//!   scalable real-time 3D animation", NPAR 2000, figure 14. Here: moving models, and the same models at rest
//!   on a turntable.
//!
//! A frame is posed, drawn, and written as SVG to memory. *plain* is not part of ligne: one thread lights the
//! vertices and rasterises the triangles.

mod plain;

use std::time::Instant;

use libm::{cos, sin};
use ligne::animate::{Animator, DetailLevel, FrameSpec, Timeline, Turntable, film_points};
use ligne::animation::{Playing, Rigged};
use ligne::drawing::{Page, Unit};
use ligne::edit::simplify::Detail;
use ligne::glam::{DAffine3, DVec3};
use ligne::{Camera, Scene, Style, SvgOptions};

const FACES: [u64; 5] = [1_200, 6_280, 10_396, 26_000, 40_000];
const MOVING: [&str; 4] = [
    "examples/models/crane.glb",
    "../shared/models/animated/Fox.glb",
    "../shared/models/animated/CesiumMan.glb",
    "../shared/models/animated/Knight.glb",
];
const FRAMES: usize = 24;
/// Squares along a side of the ring: 40,328 triangles.
const SIDE: u32 = 142;

/// Row of the table: name, style, and settings.
type Pass = (&'static str, &'static str, &'static [&'static str]);
const PASSES: [Pass; 6] = [
    ("inker", "ink", &[]),
    ("inker, edges", "ink", &["lines.contours=mesh"]),
    ("painter", "toon", &["lines.enabled=false"]),
    ("both", "toon", &[]),
    ("both, edges", "toon", &["lines.contours=mesh"]),
    ("pencil", "pencil", &["lines.contours=mesh"]),
];

fn main() {
    let styles = PASSES.map(|(name, style, set)| (name, styled(style, set)));
    heading("ring: faces");
    let ring = Rigged::from(ring());
    let detail = Detail::of(&ring.scene);
    for faces in FACES {
        let level = DetailLevel::of(&detail, &ring.scene, faces).expect("a level of it");
        let turn = Course::turn(&ring);
        let rates: Vec<f64> = styles
            .iter()
            .map(|(_, style)| rate(&Animator::at_level(&ring, &level, style).ready(), &turn))
            .collect();
        let rest = Animator::at_level(&ring, &level, &styles[0].1);
        row(&level.faces().to_string(), plain_rate(|_| rest.rest().clone(), &turn), &rates);
    }
    println!();
    heading("moving");
    for file in MOVING {
        let Ok(rigged) = Rigged::open(file) else {
            println!("{file}: not there, left out");
            continue;
        };
        let name = file.rsplit('/').next().unwrap_or(file);
        for (what, course) in [("stands", Course::turn(&rigged)), ("moves", Course::clip(&rigged))] {
            let rates: Vec<f64> = styles
                .iter()
                .map(|(_, style)| rate(&Animator::new(&rigged, style).ready(), &course))
                .collect();
            let posed = |frame: usize| match course.moments[frame].playing.as_slice() {
                [] => rigged.scene.clone(),
                playing => rigged.posed(playing).expect("a pose"),
            };
            row(&format!("{name} {what}"), plain_rate(posed, &course), &rates);
        }
    }
}

fn styled(name: &str, set: &[&str]) -> Style {
    let mut style = Style::load(name).expect("a style");
    for (key, value) in set.iter().filter_map(|set| set.split_once('=')) {
        style.set(key, value).expect("a key of styles");
    }
    style
}

fn heading(first: &str) {
    print!("{first:<24} {:>9}", "plain");
    PASSES.iter().for_each(|(name, ..)| print!(" {name:>13}"));
    println!("   frames a second");
}

fn row(name: &str, plain: f64, rates: &[f64]) {
    print!("{name:<24} {plain:>9.0}");
    rates.iter().for_each(|rate| print!(" {rate:>13.1}"));
    println!();
}

/// Poses and cameras of the frames.
struct Course {
    moments: Vec<FrameSpec>,
}

impl Course {
    /// A turntable with one degree per frame.
    fn turn(rigged: &Rigged) -> Self {
        let table = Turntable::round(&rigged.scene, 360);
        let poses: Vec<_> = (0..FRAMES).map(|frame| (Vec::new(), table.turn(360 - frame % 360))).collect();
        Self::seen(rigged, poses, |camera, frame| table.camera(camera, frame))
    }

    /// The first clip at 24 frames per second.
    fn clip(rigged: &Rigged) -> Self {
        let [from, _] = rigged.clips()[0].span();
        let timeline = Timeline::of_frames(FRAMES, from, 24.0).expect("a timeline");
        let playing = |frame| vec![Playing::all(0, timeline.time(frame))];
        let poses = (0..FRAMES).map(|frame| (playing(frame), DAffine3::IDENTITY)).collect();
        Self::seen(rigged, poses, |camera, _| *camera)
    }

    fn seen(
        rigged: &Rigged,
        poses: Vec<(Vec<Playing>, DAffine3)>,
        camera_of: impl Fn(&Camera, usize) -> Camera,
    ) -> Self {
        let points = film_points(rigged, &poses).expect("poses");
        let first =
            Camera::three_quarter_of(rigged.scene.up).with_frame(800.0, 600.0).fit_points(&points, 0.05);
        let page = Page { width: 800.0, height: 600.0, unit: Unit::Px, background: None };
        let moment = |(frame, (playing, _)): (usize, (Vec<Playing>, DAffine3))| FrameSpec {
            playing,
            camera: camera_of(&first, frame),
            page,
        };
        Self { moments: poses.into_iter().enumerate().map(moment).collect() }
    }
}

/// Frames per second, from the median frame time.
fn rate(animator: &Animator, course: &Course) -> f64 {
    let options = SvgOptions::default();
    of_times(course.moments.iter().map(|moment| {
        let begin = Instant::now();
        let (drawing, _) = animator.draw(moment).expect("a drawing");
        std::hint::black_box(drawing.to_svg(&options));
        begin.elapsed().as_secs_f64()
    }))
}

fn plain_rate(posed: impl Fn(usize) -> Scene, course: &Course) -> f64 {
    of_times(course.moments.iter().enumerate().map(|(frame, moment)| {
        let begin = Instant::now();
        let soup = ligne::internals::soup(&posed(frame));
        std::hint::black_box(plain::shaded(&soup.positions, &soup.triangles, &moment.camera));
        begin.elapsed().as_secs_f64()
    }))
}

fn of_times(times: impl Iterator<Item = f64>) -> f64 {
    let mut times: Vec<f64> = times.collect();
    times.sort_by(f64::total_cmp);
    1.0 / times[times.len() / 2]
}

/// Wavy ring, closed in both directions.
fn ring() -> Scene {
    let turn = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(SIDE);
    let point = |i: u32, j: u32| {
        let (a, b) = (turn(i), turn(j));
        let thick = 1.0 + 0.1 * sin(7.0 * a) * sin(5.0 * b);
        let far = 3.0 + thick * cos(b);
        DVec3::new(far * cos(a), far * sin(a), thick * sin(b))
    };
    let number = |i: u32, j: u32| (j % SIDE) * SIDE + i % SIDE;
    let squares = || (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| (i, j)));
    let triangles = squares().flat_map(|(i, j)| {
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    Scene::from_triangles(squares().map(|(i, j)| point(i, j)), triangles).expect("a sound scene")
}
