//! Lines with a hand: widths that swell and taper, tremor, overshoot, breaks, passes, halos and brushes, against
//! what geometry says.

use std::sync::Arc;

use std::f64::consts::{PI, TAU};

use crate::support::pipeline::{orthographic, scene};
use crate::support::properties::option_set::HAND_SETS;
use crate::support::solids::{cuboid, sphere, torus};
use glam::DVec3;
use kurbo::{BezPath, ParamCurve, ParamCurveNearest, Point, Shape};
use ligne::drawing::{Drawing, LayerKind, Mark, OutlinePaint, Paint, Unit};
use ligne::export::SvgOptions;
use ligne::math::colour::Colour;
use ligne::math::function::{cos, sin};
use ligne::render::render;
use ligne::scene::{Camera, Scene};
use ligne::stages::chain::{Chain, Sample};
use ligne::stages::lines::LineKind;
use ligne::stages::mesh::{MaterialId, PartId};
use ligne::stages::stroke::{InkContext, ink};
use ligne::style::Style;

/// A style that extends plain pens with some changes.
fn style(sets: &[&str]) -> Style {
    let plain = ["pen.contour.width=4", "pen.silhouette.width=4", "pen.width=4"];
    let sets: Vec<String> = plain.iter().chain(sets).map(|set| (*set).to_owned()).collect();
    Style::load("ink", &sets).unwrap_or_else(|error| panic!("{error}"))
}

/// A polyline as a chain; its depths run from the first to the second number.
fn chain(points: &[(f64, f64)], depths: [f64; 2]) -> Chain {
    let points: Vec<Point> = points.iter().map(|p| Point::from(*p)).collect();
    let closed = points.len() > 2 && points.first() == points.last();
    let mut path = BezPath::new();
    path.move_to(points[0]);
    points[1..].iter().for_each(|p| path.line_to(*p));
    let last = points.len() - 1;
    let depth = |i: usize| depths[0] + (depths[1] - depths[0]) * i as f64 / last as f64;
    let samples: Vec<Sample> = (0..=last).map(|i| Sample::new(depth(i), 1.0)).collect();
    let mut chain = Chain {
        identity: 0,
        places: Arc::default(),
        points,
        samples,
        closed,
        kind: LineKind::Crease,
        silhouette: false,
        invisibility: 0,
        veiled: false,
        both_seen: false,
        part: PartId(0),
        material: MaterialId(0),
        smooth: false,
        covered: [false; 2],
        segment: 0,
        path,
    };
    if closed {
        chain.points.pop();
        chain.samples.pop();
        chain.path.close_path();
    }
    chain
}

/// A circle of 720 sides, round which it turns to the right.
fn circle(radius: f64) -> Chain {
    let at = |i: u32| {
        let angle = TAU * f64::from(i % 720) / 720.0;
        (200.0 + radius * cos(angle), 200.0 + radius * sin(angle))
    };
    let mut chain = chain(&(0..=720).map(at).collect::<Vec<_>>(), [1.0; 2]);
    chain.path = kurbo::Circle::new((200.0, 200.0), radius).to_path(1e-3);
    chain
}

/// What strokes know where there is no scene.
fn context(style: &Style) -> InkContext<'static> {
    InkContext {
        unit: Unit::Px,
        parts: &[],
        materials: &[],
        hidden: style.lines.hidden,
        behind_glass: 0.5,
        seed: style.seed,
        painted: style.region.enabled,
        depths: [2.0, 4.0],
        names: &[],
        parting: None,
    }
}

fn marks(chains: &[Chain], style: &Style) -> Vec<Mark> {
    ink(chains, &context(style), &style.stroke).into_iter().flat_map(|layer| layer.marks).collect()
}

fn outline(mark: &Mark) -> &OutlinePaint {
    match &mark.paint {
        Paint::Outline(outline) => outline,
        _ => panic!("not a line of varying width: {mark:?}"),
    }
}

/// The middle of a line.
fn axis(mark: &Mark) -> &BezPath {
    match &mark.paint {
        Paint::Outline(outline) => &outline.axis,
        _ => &mark.path,
    }
}

/// Width of an outline across a level line at `x`.
fn width_at(mark: &Mark, x: f64, y: f64) -> f64 {
    let inside = |y: f64| mark.path.winding(Point::new(x, y)) != 0;
    assert!(inside(y), "no ink at {x}, {y}");
    let edge = |sign: f64| {
        let (mut low, mut high) = (0.0, 20.0);
        for _ in 0..40 {
            let middle = (low + high) / 2.0;
            if inside(y + sign * middle) { low = middle } else { high = middle }
        }
        low
    };
    edge(1.0) + edge(-1.0)
}

/// Points on a path, about so far apart.
fn places(path: &BezPath, step: f64) -> Vec<Point> {
    let mut places = Vec::new();
    for segment in path.segments() {
        let count = (kurbo::ParamCurveArclen::arclen(&segment, 1e-3) / step).ceil().max(1.0) as usize;
        places.extend((0..=count).map(|k| segment.eval(k as f64 / count as f64)));
    }
    places
}

fn distance(path: &BezPath, p: Point) -> f64 {
    path.segments().map(|s| s.nearest(p, 1e-6).distance_sq).fold(f64::INFINITY, f64::min).sqrt()
}

fn length(path: &BezPath) -> f64 {
    path.segments().map(|s| kurbo::ParamCurveArclen::arclen(&s, 1e-3)).sum()
}

#[test]
fn tapered_ends_fall_as_they_should() {
    let style = style(&["pen.swell.taper=40", "pen.swell.taper_to=0.25"]);
    let drawn = marks(&[chain(&[(0.0, 50.0), (200.0, 50.0)], [1.0; 2])], &style);
    for (x, t) in [(10.0, 0.25), (20.0, 0.5), (30.0, 0.75), (100.0, 1.0), (180.0, 0.5), (195.0, 0.125)] {
        let wanted = 4.0 * (0.25 + 0.75 * t * (2.0 - t));
        let width = width_at(&drawn[0], x, 50.0);
        assert!((width - wanted).abs() < 0.12, "{x}: {width}, not {wanted}");
    }
    // A mean of 1/3 is lost of the 3/4 at 2 times 40 of 200.
    assert!((outline(&drawn[0]).width - 4.0 * (1.0 - 0.75 / 3.0 * 0.4)).abs() < 0.02);
    // Lines that are too short taper over their half; closed ones do not.
    let short = marks(&[chain(&[(0.0, 50.0), (40.0, 50.0)], [1.0; 2])], &style);
    assert!((width_at(&short[0], 20.0, 50.0) - 4.0).abs() < 0.1);
    assert!((width_at(&short[0], 10.0, 50.0) - 4.0 * (0.25 + 0.75 * 0.75)).abs() < 0.15);
    assert!(matches!(marks(&[circle(50.0)], &style)[0].paint, Paint::Stroke(_)));
}

#[test]
fn lines_that_go_on_do_not_taper_where_they_are_joined() {
    let style = style(&["pen.swell.taper=30"]);
    let first = chain(&[(0.0, 50.0), (100.0, 50.0)], [1.0; 2]);
    let mut second = chain(&[(100.0, 50.0), (200.0, 52.0)], [1.0; 2]);
    second.kind = LineKind::Border;
    // One that leaves at a right angle is not the same line.
    let third = chain(&[(100.0, 50.0), (100.0, 150.0)], [1.0; 2]);
    let drawn = marks(&[first, second, third], &style);
    let level = drawn.iter().find(|mark| mark.path.winding(Point::new(50.0, 50.0)) != 0).unwrap();
    assert!((width_at(level, 95.0, 50.0) - 4.0).abs() < 0.1);
    assert!(width_at(level, 5.0, 50.0) < 3.0);
    // Lines of unlike width meet half-way.
    let thin = self::style(&["pen.swell.taper=30", "pen.border.width=2"]);
    let [first, mut second] =
        [(0.0, 100.0), (100.0, 200.0)].map(|(a, b)| chain(&[(a, 50.0), (b, 50.0)], [1.0; 2]));
    second.kind = LineKind::Border;
    for mark in marks(&[first, second], &thin) {
        let (at, own) =
            if mark.path.winding(Point::new(50.0, 50.0)) != 0 { (99.0, 4.0) } else { (101.0, 2.0) };
        let width = width_at(&mark, at, 50.0);
        assert!((width - 3.0).abs() < 0.15, "{width}");
        let away = width_at(&mark, 100.0 + 20.0 * (at - 100.0), 50.0);
        assert!((away - own).abs() < 0.1, "{away}");
    }
    let upright = drawn.iter().find(|mark| mark.path.winding(Point::new(100.0, 100.0)) != 0).unwrap();
    assert!(upright.path.winding(Point::new(101.5, 55.0)) == 0, "not tapered");
}

#[test]
fn widths_follow_depth_light_gap_and_bends() {
    let far = chain(&[(0.0, 50.0), (100.0, 50.0), (200.0, 50.0)], [2.0, 4.0]);
    let near = style(&["pen.swell.near=0.5"]);
    let drawn = marks(std::slice::from_ref(&far), &near);
    for (x, wanted) in [(20.0, 3.8), (100.0, 3.0), (150.0, 2.5)] {
        let width = width_at(&drawn[0], x, 50.0);
        assert!((width - wanted).abs() < 0.1, "{x}: {width}, not {wanted}");
    }
    let mut lit = far;
    for (sample, x) in lit.samples.iter_mut().zip([0.0, 0.5, 1.0]) {
        (sample.light, sample.gap) = (x, x);
    }
    for (x, light) in [(50.0, 0.25), (100.0, 0.5), (150.0, 0.75)] {
        let darker = width_at(&marks(std::slice::from_ref(&lit), &style(&["pen.swell.lit=0.6"]))[0], x, 50.0);
        assert!((darker - 4.0 * (1.0 - 0.6 * light)).abs() < 0.1, "{x}: {darker}");
        // By light and distance together it is the product.
        let sets = style(&["pen.swell.lit=0.6", "pen.swell.near=0.5"]);
        let both = width_at(&marks(std::slice::from_ref(&lit), &sets)[0], x, 50.0);
        assert!((both - 4.0 * (1.0 - 0.6 * light) * (1.0 - 0.5 * x / 200.0)).abs() < 0.1, "{x}: {both}");
        let deeper = width_at(&marks(std::slice::from_ref(&lit), &style(&["pen.swell.gap=0.6"]))[0], x, 50.0);
        assert!((deeper - 4.0 * (1.0 - 0.6 * (1.0 - light))).abs() < 0.1, "{x}: {deeper}");
    }
    // A circle bends out all round: x/(1 + x) with x the radius of half effect over its own.
    let bend = style(&["pen.swell.bend=0.6", "pen.swell.bend_radius=50"]);
    for radius in [25.0, 50.0, 100.0] {
        let mark = &marks(&[circle(radius)], &bend)[0];
        let Paint::Outline(OutlinePaint { width, .. }) = mark.paint else { panic!("{mark:?}") };
        let x = 50.0 / radius;
        let wanted = 4.0 * (1.0 + 0.6 * x / (1.0 + x));
        assert!((width - wanted).abs() < 0.05, "{radius}: {width}, not {wanted}");
        let area = TAU * radius * wanted;
        assert!((mark.path.area().abs() - area).abs() < 0.01 * area, "{}", mark.path.area());
    }
    // With the shape outside of it, it bends in.
    let mut hole = circle(50.0);
    hole.samples.iter_mut().for_each(|sample| sample.side = 1.0);
    let Paint::Outline(OutlinePaint { width, .. }) = marks(&[hole], &bend)[0].paint else { panic!() };
    assert!((width - 4.0 * 0.7).abs() < 0.05, "{width}");
}

#[test]
fn tremor_stays_within_its_amplitude_and_seeds_change_nothing_else() {
    let chains = [
        chain(&[(0.0, 50.0), (300.0, 50.0), (300.0, 250.0)], [1.0; 2]),
        chain(&[(20.0, 300.0), (280.0, 330.0)], [1.0; 2]),
        circle(60.0),
    ];
    let sets =
        |seed: &'static str| ["pen.hand.tremor=3", "pen.hand.tremor_length=40", "pen.swell.taper=20", seed];
    let [one, other] = [sets("seed=1"), sets("seed=2")].map(|sets| marks(&chains, &style(&sets)));
    assert_eq!((one.len(), other.len()), (3, 3));
    assert_eq!(one, marks(&chains, &style(&sets("seed=1"))));
    let mut greatest = 0.0_f64;
    for drawn in [&one, &other] {
        for (mark, chain) in drawn.iter().zip(&chains) {
            for p in places(axis(mark), 2.0) {
                let away = distance(&chain.path, p);
                assert!(away < 3.0 + 0.1, "{away}");
                greatest = greatest.max(away);
            }
            // Ends and corners stay.
            for p in chain.points.iter().filter(|_| !chain.closed) {
                assert!(distance(axis(mark), *p) < 0.15, "{p:?}");
            }
        }
    }
    assert!(greatest > 1.0, "{greatest}");
    for (a, b) in one.iter().zip(&other) {
        assert_ne!(a.path, b.path);
        assert_eq!(a.provenance, b.provenance);
    }
}

#[test]
fn ends_run_on_and_passes_stray_no_farther_than_told() {
    let line = chain(&[(100.0, 50.0), (300.0, 50.0)], [1.0; 2]);
    for seed in 0..20 {
        let seed = format!("seed={seed}");
        let drawn = marks(std::slice::from_ref(&line), &style(&["pen.hand.overshoot=12", &seed]));
        let bounds = axis(&drawn[0]).bounding_box();
        for over in [100.0 - bounds.x0, bounds.x1 - 300.0] {
            assert!((0.35 * 12.0 - 1e-6..12.0 + 1e-6).contains(&over), "{over}");
        }
        let sketched =
            marks(std::slice::from_ref(&line), &style(&["pen.hand.passes=3", "pen.hand.stray=2", &seed]));
        assert_eq!(sketched.len(), 3);
        assert!(axis(&sketched[0]).bounding_box().height() < 1e-9);
        for mark in &sketched {
            let strays = places(axis(mark), 2.0).into_iter().map(|p| distance(&line.path, p));
            assert!(strays.fold(0.0, f64::max) < 2.1);
        }
        assert_ne!(sketched[1].path, sketched[2].path);
    }
    // Where a surface covers the end, the line does not run on over it.
    let mut covered = line.clone();
    covered.covered = [true, false];
    let drawn = marks(&[covered], &style(&["pen.hand.overshoot=12"]));
    assert!((axis(&drawn[0]).bounding_box().x0 - 100.0).abs() < 1e-6);
    // At a corner the pen is lifted.
    let corner = chain(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0)], [1.0; 2]);
    let drawn = marks(&[corner], &style(&["pen.hand.overshoot=12"]));
    assert_eq!(drawn.len(), 2);
    assert!(axis(&drawn[0]).bounding_box().x1 > 104.0 && axis(&drawn[1]).bounding_box().y0 < -4.0);
}

#[test]
fn breaks_are_as_many_as_their_mean_distance_says() {
    let line = chain(&[(0.0, 50.0), (1000.0, 50.0)], [1.0; 2]);
    for seed in 0..10 {
        let drawn =
            marks(std::slice::from_ref(&line), &style(&["pen.hand.breaks=100", &format!("seed={seed}")]));
        assert_eq!(drawn.len(), 11);
        let inked: f64 = drawn.iter().map(|mark| length(axis(mark))).sum();
        // Gaps of 3 px, give or take 40 percent.
        assert!((1000.0 - 10.0 * 3.0 * 1.4..=1000.0 - 10.0 * 3.0 * 0.6).contains(&inked), "{inked}");
    }
    let ring = marks(&[circle(100.0)], &style(&["pen.hand.breaks=100"]));
    assert_eq!(ring.len(), 6);
}

#[test]
fn farther_lines_break_off_before_nearer_ones() {
    let near = chain(&[(0.0, 100.0), (200.0, 100.0)], [1.0; 2]);
    let style = style(&["pen.halo=5"]);
    for degrees in [90.0_f64, 60.0, 30.0] {
        let (c, s) = (cos(degrees.to_radians()), sin(degrees.to_radians()));
        let end = |t: f64| (100.0 + t * c, 100.0 + t * s);
        let far = chain(&[end(-90.0), end(90.0)], [2.0; 2]);
        let drawn = marks(&[near.clone(), far], &style);
        assert_eq!(drawn.len(), 3, "{degrees}");
        let inked: f64 = drawn.iter().map(|mark| length(axis(mark))).sum();
        // Half the width and the halo, to both sides, along the line.
        let gap = 2.0 * (2.0 + 5.0) / s;
        assert!((inked - (200.0 + 180.0 - gap)).abs() < 0.01, "{degrees}: {inked}");
    }
    // Hidden lines break off as well.
    let mut hidden = chain(&[(100.0, 10.0), (100.0, 190.0)], [2.0; 2]);
    hidden.invisibility = 1;
    let drawn = marks(&[near.clone(), hidden], &self::style(&["pen.halo=5", "lines.hidden=solid"]));
    assert_eq!(drawn.len(), 3);
    // A T-junction backs off; a line that meets the other one in space does not, however steeply it recedes.
    let below = chain(&[(100.0, 100.0), (100.0, 180.0)], [2.0; 2]);
    let inked: f64 = marks(&[near.clone(), below], &style).iter().map(|mark| length(axis(mark))).sum();
    assert!((inked - (280.0 - 7.0)).abs() < 0.01, "{inked}");
    let met = chain(&[(100.0, 100.0), (100.0, 180.0)], [1.0, 9.0]);
    assert_eq!(marks(&[near.clone(), met], &style).len(), 2);
    let inked: f64 = marks(&[near.clone(), chain(&[(100.0, 100.0), (100.0, 180.0)], [1.0, 9.0])], &style)
        .iter()
        .map(|mark| length(axis(mark)))
        .sum();
    assert!((inked - 280.0).abs() < 0.01, "{inked}");
}

#[test]
fn brushes_are_laid_along_lines() {
    // A lozenge, twice as long as wide, once over the line and again and again.
    let lozenge = "path=\"M0 5L10 0L20 5L10 10Z\"";
    let line = chain(&[(0.0, 50.0), (200.0, 50.0)], [1.0; 2]);
    let stretched = marks(std::slice::from_ref(&line), &style(&[&format!("pen.brush={{{lozenge}}}")]));
    assert!((width_at(&stretched[0], 100.0, 50.0) - 4.0).abs() < 0.1);
    assert!((width_at(&stretched[0], 50.0, 50.0) - 2.0).abs() < 0.1);
    assert!((stretched[0].path.area().abs() - 400.0).abs() < 2.0);
    assert!((outline(&stretched[0]).width - 2.0).abs() < 0.02);
    let repeated = marks(&[line], &style(&[&format!("pen.brush={{{lozenge}, mode=\"repeat\", length=20}}")]));
    assert_eq!(repeated[0].path.elements().iter().filter(|e| **e == kurbo::PathEl::ClosePath).count(), 10);
    for k in 0..10 {
        assert!((width_at(&repeated[0], 20.0 * f64::from(k) + 10.0, 50.0) - 4.0).abs() < 0.1);
    }
    // Round a circle a whole number of copies, the last of which ends where the first begins.
    let around =
        marks(&[circle(50.0)], &style(&[&format!("pen.brush={{{lozenge}, mode=\"repeat\", length=20}}")]));
    let path = &around[0].path;
    assert_eq!(path.elements().iter().filter(|e| **e == kurbo::PathEl::ClosePath).count(), 16);
    let reach: Vec<f64> =
        places(path, 0.5).iter().map(|p| (*p - Point::new(200.0, 200.0)).hypot2().sqrt()).collect();
    let (low, high) = reach.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), r| (l.min(*r), h.max(*r)));
    assert!((low - 48.0).abs() < 0.1 && (high - 52.0).abs() < 0.1, "{low} {high}");
    let copy = PI * 100.0 / 16.0 * 2.0;
    assert!((path.area().abs() - 16.0 * copy).abs() < 4.0, "{}", path.area());
}

#[test]
fn pictures_of_strokes_are_brushes() {
    // 8 by 8 pixels: four columns dark over the whole height, four only in the upper half.
    let dark = |x: u32, y: u32| x < 4 || y < 4;
    let pixels: Vec<u8> = (0..64).map(|k| if dark(k % 8, k / 8) { 0 } else { 255 }).collect();
    let folder = std::env::temp_dir().join(format!("ligne-brush-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = std::fs::File::create(folder.join("strip.png")).unwrap();
    let mut encoder = png::Encoder::new(file, 8, 8);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    std::fs::write(folder.join("sheet.toml"), "[pen]\nwidth = 8\nbrush = { image = \"strip.png\" }\n")
        .unwrap();
    let loaded = Style::load(folder.join("sheet.toml").to_str().unwrap(), &[]);
    std::fs::write(folder.join("sheet.toml"), "[pen]\nbrush = { image = \"lost.png\" }\n").unwrap();
    let lost = Style::load(folder.join("sheet.toml").to_str().unwrap(), &[]).unwrap_err().to_string();
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(lost.contains("lost.png") && lost.contains("cannot read the brush"), "{lost}");
    let drawn = marks(&[chain(&[(0.0, 50.0), (160.0, 50.0)], [1.0; 2])], &loaded.unwrap());
    assert!((width_at(&drawn[0], 40.0, 50.0) - 8.0).abs() < 0.1);
    assert_eq!(drawn[0].path.winding(Point::new(120.0, 51.0)), 0);
    assert_ne!(drawn[0].path.winding(Point::new(120.0, 47.0)), 0);
}

fn lines(drawing: &Drawing) -> &[Mark] {
    let layer = drawing.layers.iter().find(|layer| layer.kind == LayerKind::Lines);
    &layer.expect("lines").marks
}

#[test]
fn the_outline_of_a_ball_is_thick_away_from_the_light() {
    let ball = scene([sphere(64, 1.0)]);
    let camera = orthographic(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, 3.0);
    let light = "light.sources=[{kind=\"directional\", direction=[1, 0, 0.3], space=\"camera\"}]";
    let drawing = render(&ball, &camera, &style(&["pen.swell.lit=0.8", light])).unwrap();
    let [mark] = lines(&drawing) else { panic!("{} lines", lines(&drawing).len()) };
    let outline = outline(mark);
    assert!(outline.pen_width == 4.0 && outline.width < 4.0);
    // The frame is 1000 px wide, the ball 2000/3.
    let at = |x: f64| {
        let dark = |k: i32| mark.path.winding(Point::new(x + f64::from(k) * 0.05, 500.0)) != 0;
        f64::from((-120..120).filter(|k| dark(*k)).count() as i32) * 0.05
    };
    let (left, right) = (at(500.0 - 1000.0 / 3.0), at(500.0 + 1000.0 / 3.0));
    assert!((left - 4.0).abs() < 0.15, "{left}");
    assert!((right - 4.0 * (1.0 - 0.8 * 0.958)).abs() < 0.25, "{right}");
}

#[test]
fn outlines_before_background_are_thicker_than_those_before_what_is_near() {
    // A small ball a little above a plate that is larger than it.
    let solids = [sphere(48, 0.5), cuboid(DVec3::new(-2.0, -2.0, -0.8), DVec3::new(2.0, 2.0, -0.6))];
    let camera = orthographic(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, 5.0);
    let drawing = render(&scene(solids), &camera, &style(&["pen.swell.gap=0.7"])).unwrap();
    let (inner, outer): (Vec<&Mark>, Vec<&Mark>) =
        lines(&drawing).iter().partition(|mark| mark.path.bounding_box().width() < 300.0);
    let width = |mark: &Mark| match &mark.paint {
        Paint::Outline(outline) => outline.width,
        Paint::Stroke(stroke) => stroke.width,
        Paint::Fill(_) | Paint::Gradient(_) | Paint::Image(_) => 0.0,
    };
    assert!(!inner.is_empty() && !outer.is_empty());
    // The frame is 5 across, and 0.6 lie between.
    let wanted = 4.0 * (1.0 - 0.7 * (1.0 - 0.6 / (0.2 * 5.0)));
    assert!(inner.iter().all(|mark| (width(mark) - wanted).abs() < 0.1), "{} {wanted}", width(inner[0]));
    assert!(outer.iter().all(|mark| (width(mark) - 4.0).abs() < 0.1));
}

#[test]
fn the_hand_lasts_while_the_eye_moves() {
    let model = scene([cuboid(DVec3::splat(-1.0), DVec3::splat(1.0))]);
    let drawn = |degrees: f64, sets: &[&str]| {
        let (s, c) = (sin(degrees.to_radians()), cos(degrees.to_radians()));
        let camera = orthographic(DVec3::new(5.0 * s, -5.0 * c, 3.0), DVec3::ZERO, 4.0);
        let drawing = render(&model, &camera, &style(sets)).unwrap();
        lines(&drawing).iter().map(|mark| axis(mark).clone()).collect::<Vec<_>>()
    };
    let tremor = ["pen.hand.tremor=6", "pen.hand.tremor_length=50"];
    let (still, moved) = (drawn(30.0, &tremor), drawn(30.2, &tremor));
    let (plain, plain_moved) = (drawn(30.0, &[]), drawn(30.2, &[]));
    assert!(still.len() == moved.len() && still.len() == plain.len());
    let strays = |from: &[BezPath], to: &[BezPath]| {
        let all = from.iter().zip(to).flat_map(|(a, b)| places(a, 5.0).into_iter().map(|p| distance(b, p)));
        all.fold(0.0, f64::max)
    };
    assert!(strays(&still, &plain) > 3.0);
    let by_eye = strays(&plain, &plain_moved);
    assert!(strays(&still, &moved) < by_eye + 0.5, "{} {by_eye}", strays(&still, &moved));
}

#[test]
fn closed_lines_are_cut_as_open_ones_are() {
    let square = chain(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0), (0.0, 0.0)], [2.0; 2]);
    // The pen is lifted at each corner, also at the seam.
    let lifted = marks(std::slice::from_ref(&square), &style(&["pen.hand.overshoot=10"]));
    assert_eq!(lifted.len(), 4);
    for mark in &lifted {
        assert!((107.0..=120.0).contains(&length(axis(mark))), "{}", length(axis(mark)));
    }
    let broken = marks(std::slice::from_ref(&square), &style(&["pen.hand.breaks=100", "pen.hand.tremor=1"]));
    assert_eq!(broken.len(), 4);
    // A halo over the seam, and one elsewhere.
    for x in [0.0, 50.0] {
        let near = chain(&[(x - 30.0, -30.0), (x + 30.0, 30.0)], [1.0; 2]);
        let drawn = marks(&[square.clone(), near], &style(&["pen.halo=5"]));
        assert_eq!(drawn.len(), 2, "{x}");
        let inked: f64 = drawn.iter().map(|mark| length(axis(mark))).sum();
        let gap = 2.0 * 7.0 * 2.0_f64.sqrt();
        assert!((inked - (400.0 + 60.0 * 2.0_f64.sqrt() - gap)).abs() < 0.02, "{x}: {inked}");
    }
    // With a hand and a swell its corners stay where they are.
    let mut lit = square;
    lit.samples.iter_mut().for_each(|sample| sample.light = 0.5);
    let drawn = marks(&[lit], &style(&["pen.hand.tremor=2", "pen.swell.lit=0.5"]));
    let [mark] = &drawn[..] else { panic!() };
    for corner in [(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0)] {
        assert!(distance(axis(mark), corner.into()) < 0.01);
        // Round joints of a line of 3.
        let out = |c: f64| c + if c > 50.0 { 1.4 } else { -1.4 } * std::f64::consts::FRAC_1_SQRT_2;
        assert_ne!(mark.path.winding(Point::new(out(corner.0), out(corner.1))), 0);
    }
}

#[test]
fn pages_in_millimetres_are_drawn_alike() {
    let sets = [
        "pen.swell.taper=20",
        "pen.swell.bend=0.5",
        "pen.hand.tremor=2",
        "pen.hand.breaks=120",
        "pen.hand.passes=2",
        "pen.hand.overshoot=6",
        "pen.halo=3",
    ];
    let brush = ["pen.brush={path=\"M0 5L10 0L20 5L10 10Z\", mode=\"repeat\"}"];
    for sets in [&sets[..], &brush[..]] {
        let style = style(sets);
        let chains = [
            chain(&[(0.0, 50.0), (300.0, 50.0), (300.0, 250.0)], [1.0; 2]),
            chain(&[(20.0, 300.0), (280.0, 20.0)], [2.0; 2]),
            circle(60.0),
        ];
        let scale = ligne::drawing::length::MM_PER_PX;
        let small = chains.clone().map(|mut chain| {
            chain.points.iter_mut().for_each(|p| *p = (p.to_vec2() * scale).to_point());
            chain.path.apply_affine(kurbo::Affine::scale(scale));
            chain
        });
        let [px, mm] = [(&chains, Unit::Px), (&small, Unit::Mm)].map(|(chains, unit)| {
            let layers = ink(chains, &InkContext { unit, ..context(&style) }, &style.stroke);
            layers.into_iter().flat_map(|layer| layer.marks).collect::<Vec<_>>()
        });
        assert_eq!(px.len(), mm.len());
        for (px, mm) in px.iter().zip(&mm) {
            let (a, b) = (px.path.bounding_box(), mm.path.bounding_box().scale_from_origin(1.0 / scale));
            assert!((a.x0 - b.x0).abs() + (a.y1 - b.y1).abs() < 0.05, "{a:?} {b:?}");
            let (a, b) = (px.path.area().abs(), mm.path.area().abs() / (scale * scale));
            assert!((a - b).abs() < 0.01 * a + 0.1, "{a} {b}");
        }
    }
}

#[test]
fn the_shortest_lines_are_drawn_too() {
    let dot = chain(&[(10.0, 10.0), (10.5, 10.2)], [1.0; 2]);
    assert_eq!(marks(&[dot], &style(&["pen.swell.taper=20"])).len(), 1);
}

fn camera(scene: &Scene) -> Camera {
    let mut camera = Camera::three_quarter();
    (camera.width, camera.height) = (400.0, 400.0);
    camera.fit(scene)
}

#[test]
fn another_seed_changes_the_hand_and_nothing_else() {
    let model = scene([torus(40, 20, 1.0, 0.4), cuboid(DVec3::splat(-0.3), DVec3::splat(0.3))]);
    let camera = camera(&model);
    let [one, other] = ["seed=0", "seed=5"].map(|seed| {
        let sets: Vec<&str> = HAND_SETS.iter().copied().chain([seed]).collect();
        render(&model, &camera, &style(&sets)).unwrap()
    });
    assert!(one.to_svg(&SvgOptions::default()).contains("data-axis"));
    for (a, b) in one.layers.iter().zip(&other.layers) {
        assert_eq!((a.kind, a.marks.len()), (b.kind, b.marks.len()));
        for (a, b) in a.marks.iter().zip(&b.marks) {
            assert_eq!(a.provenance, b.provenance);
        }
        if a.kind != LayerKind::Lines {
            assert_eq!(a.marks, b.marks);
        } else {
            assert_ne!(a.marks, b.marks);
        }
    }
    // Without a hand it changes nothing at all.
    let plain = ["seed=0", "seed=5"]
        .map(|seed| render(&model, &camera, &style(&["pen.swell.taper=20", seed])).unwrap());
    assert_eq!(plain[0].layers, plain[1].layers);
}

/// How many places on borders of paint have a line on them, and those that lines with a hand leave bare.
fn bare(model: &Scene, camera: &Camera) -> (usize, Vec<Point>) {
    let sets = [
        "fills.enabled=true",
        "fills.thresholds=[]",
        "fills.underlap=0",
        "fills.seams=exact",
        "pen.hand.tremor=4",
        "pen.hand.tremor_length=30",
        "pen.swell.taper=30",
        "pen.swell.taper_to=0",
        "pen.swell.bend=0.6",
    ];
    let plain = render(model, camera, &style(&sets[..4])).unwrap();
    let hand = render(model, camera, &style(&sets)).unwrap();
    let ink =
        |drawing: &Drawing| -> Vec<BezPath> { lines(drawing).iter().map(|mark| mark.path.clone()).collect() };
    let (straight, shaken) = (ink(&plain), ink(&hand));
    let fills = hand.layers.iter().find(|layer| layer.kind == LayerKind::Fills).expect("fills");
    let (mut asked, mut bare) = (0, Vec::new());
    for p in fills.marks.iter().flat_map(|fill| places(&fill.path, 3.0)) {
        if straight.iter().all(|path| distance(path, p) > 1.0) {
            continue;
        }
        asked += 1;
        if !shaken.iter().any(|path| path.winding(p) != 0 || distance(path, p) < 0.05) {
            bare.push(p);
        }
    }
    (asked, bare)
}

#[test]
fn lines_cover_the_borders_of_what_is_painted() {
    let bar = cuboid(DVec3::new(-0.3, -2.0, -0.3), DVec3::new(0.3, 2.0, 0.3));
    let model = scene([torus(60, 30, 1.0, 0.4), bar]);
    let (asked, bare) = bare(&model, &camera(&model));
    assert!(asked > 500, "{asked}");
    assert!(bare.is_empty(), "{} of {asked}: {:?}", bare.len(), &bare[..bare.len().min(9)]);
}

#[test]
fn lines_cover_the_borders_of_painted_models() {
    for name in ["teapot.obj", "knot.ply", "bear.ply"] {
        let model = Scene::open(format!("{}/examples/models/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap();
        let (asked, bare) = bare(&model, &camera(&model));
        assert!(asked > 500, "{name}: {asked}");
        // Where a contour ends, what is painted goes on along edges of the mesh.
        assert!(
            100 * bare.len() <= asked,
            "{name}: {} of {asked}: {:?}",
            bare.len(),
            &bare[..bare.len().min(9)]
        );
    }
}

#[test]
fn no_paper_shows_between_paint_and_a_brush_that_strays() {
    // A bow beside the axis, and a leaf that is thin at its ends.
    let bow = "path=\"M0 0C30 2 60 2 100 0C60 6 30 6 0 0M50 9L51 10L50 10Z\"";
    let leaf = "path=\"M0 5C30 -1 60 -1 100 5C60 9 30 9 0 5Z\"";
    let line = chain(&[(0.0, 50.0), (200.0, 50.0)], [1.0; 2]);
    let gaps = |brush: &str, more: &[&str]| {
        let brush = format!("pen.brush={{{brush}}}");
        let drawn =
            marks(std::slice::from_ref(&line), &style(&[&[brush.as_str(), "pen.width=10"], more].concat()));
        let path = &drawn[0].path;
        let inked = |x: f64, y: f64| path.winding(Point::new(x, y)) != 0;
        // Paint ends at 50: whatever ink there is on one side has none of it between.
        let is_open = |x: f64| {
            let ys: Vec<f64> = (-120..=120).map(|k| 50.0 + f64::from(k) * 0.05).collect();
            let own = |y: &f64| inked(x, *y);
            let (up, down) = ys.split_at(120);
            let nearest = [up.iter().rev().position(own), down.iter().position(own)];
            nearest.into_iter().flatten().min() != Some(0) || !inked(x, 50.15) || !inked(x, 49.85)
        };
        (5..195).filter(|x| is_open(f64::from(*x))).count()
    };
    let painted = "fills.enabled=true";
    assert!(gaps(bow, &[]) > 100, "the measure sees gaps");
    for more in [&[painted][..], &[painted, "pen.hand={tremor=1.5, tremor_length=30}"]] {
        assert_eq!((gaps(bow, more), gaps(leaf, more)), (0, 0), "{more:?}");
    }
}

#[test]
fn shades_follow_what_is_beside_the_line() {
    let mut line = chain(&(0..=20).map(|k| (f64::from(k) * 10.0, 50.0)).collect::<Vec<_>>(), [1.0; 2]);
    for (k, sample) in line.samples.iter_mut().enumerate() {
        let colour = if k < 10 { Colour::rgb(200, 0, 0) } else { Colour::rgb(0, 0, 100) };
        sample.under.colour = Some(colour);
    }
    let drawn = marks(&[line], &style(&["pen.colour={shade=0.5}"]));
    let found: Vec<(Colour, f64, f64)> = drawn
        .iter()
        .map(|mark| {
            let reach = mark.path.bounding_box();
            let colour = match &mark.paint {
                Paint::Outline(outline) => outline.colour,
                Paint::Stroke(stroke) => stroke.colour,
                Paint::Fill(colour) => *colour,
                Paint::Image(_) => panic!("a picture"),
                Paint::Gradient(_) => panic!("ink has one colour"),
            };
            (colour, reach.x0, reach.x1)
        })
        .collect();
    let [(red, from, border), (blue, again, to)] = found[..] else { panic!("{found:?}") };
    assert_eq!((red, blue), (Colour::rgb(100, 0, 0), Colour::rgb(0, 0, 50)));
    // Round at its ends, straight where its ink changes.
    assert!((from + 2.0).abs() < 0.2 && (to - 202.0).abs() < 0.2, "{found:?}");
    assert!((border - 95.0).abs() < 1.0 && (again - border).abs() < 0.01, "{found:?}");
}
