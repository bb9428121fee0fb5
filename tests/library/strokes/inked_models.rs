//! Hand-drawn lines on models: light, depth gaps, camera moves, page units, seeds and covered fill borders,
//! against closed forms and plain drawings.

use crate::library::support::measures::stroke_marks::{
    centre_line, circle_chain, ink_context, ink_style, marks, outline_paint, path_distance, path_length,
    polyline_chain, sample_path,
};
use crate::library::support::pipeline::{orthographic, scene};
use crate::library::support::properties::option_set::HAND_DRAWN_OVERRIDES;
use crate::library::support::scenes::solids::{cuboid, sphere, torus};
use glam::DVec3;
use kurbo::{BezPath, Point, Shape};
use ligne::colour::srgb::Colour;
use ligne::drawing::{Drawing, LayerKind, Mark, Paint, Unit};
use ligne::export::SvgOptions;
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::pipeline::render;
use ligne::scene::{Camera, Scene};
use ligne::strokes::{InkContext, ink};

fn lines(drawing: &Drawing) -> &[Mark] {
    let layer = drawing.layers.iter().find(|layer| layer.kind == LayerKind::Lines);
    &layer.expect("lines").marks
}

#[test]
fn the_outline_of_a_ball_is_thick_away_from_the_light() {
    let ball = scene([sphere(64, 1.0)]);
    let camera = orthographic(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, 3.0);
    let light = "light.sources=[{kind=\"directional\", direction=[1, 0, 0.3], space=\"camera\"}]";
    let drawing = render(&ball, &camera, &ink_style(&["pen.swell.lit=0.8", light])).unwrap();
    let [mark] = lines(&drawing) else { panic!("{} lines", lines(&drawing).len()) };
    let outline = outline_paint(mark);
    assert!(outline.pen_width == 4.0 && outline.width < 4.0);
    // The frame is 1000 px wide and the ball 2000/3 px.
    let at = |x: f64| {
        let dark = |k: i32| mark.path.winding(Point::new(x + f64::from(k) * 0.05, 500.0)) != 0;
        f64::from((-120..120).filter(|k| dark(*k)).count() as i32) * 0.05
    };
    let (left, right) = (at(500.0 - 1000.0 / 3.0), at(500.0 + 1000.0 / 3.0));
    assert!((left - 4.0).abs() < 0.15, "{left}");
    assert!((right - 4.0 * (1.0 - 0.8 * 0.958)).abs() < 0.25, "{right}");
}

#[test]
fn outlines_with_a_large_depth_gap_are_thicker() {
    // A small ball slightly above a larger plate.
    let solids = [sphere(48, 0.5), cuboid(DVec3::new(-2.0, -2.0, -0.8), DVec3::new(2.0, 2.0, -0.6))];
    let camera = orthographic(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, 5.0);
    let drawing = render(&scene(solids), &camera, &ink_style(&["pen.swell.gap=0.7"])).unwrap();
    let (inner, outer): (Vec<&Mark>, Vec<&Mark>) =
        lines(&drawing).iter().partition(|mark| mark.path.bounding_box().width() < 300.0);
    let width = |mark: &Mark| match &mark.paint {
        Paint::Outline(outline) => outline.width,
        Paint::Stroke(stroke) => stroke.width,
        Paint::Fill(_) | Paint::Gradient(_) | Paint::Image(_) => 0.0,
    };
    assert!(!inner.is_empty() && !outer.is_empty());
    // The frame is 5 units wide and the depth gap is 0.6.
    let wanted = 4.0 * (1.0 - 0.7 * (1.0 - 0.6 / (0.2 * 5.0)));
    assert!(inner.iter().all(|mark| (width(mark) - wanted).abs() < 0.1), "{} {wanted}", width(inner[0]));
    assert!(outer.iter().all(|mark| (width(mark) - 4.0).abs() < 0.1));
}

#[test]
fn tremor_is_stable_under_small_camera_moves() {
    let model = scene([cuboid(DVec3::splat(-1.0), DVec3::splat(1.0))]);
    let drawn = |degrees: f64, sets: &[&str]| {
        let (s, c) = (sin(degrees.to_radians()), cos(degrees.to_radians()));
        let camera = orthographic(DVec3::new(5.0 * s, -5.0 * c, 3.0), DVec3::ZERO, 4.0);
        let drawing = render(&model, &camera, &ink_style(sets)).unwrap();
        lines(&drawing).iter().map(|mark| centre_line(mark).clone()).collect::<Vec<_>>()
    };
    let tremor = ["pen.hand.tremor=6", "pen.hand.tremor_length=50"];
    let (still, moved) = (drawn(30.0, &tremor), drawn(30.2, &tremor));
    let (plain, plain_moved) = (drawn(30.0, &[]), drawn(30.2, &[]));
    assert!(still.len() == moved.len() && still.len() == plain.len());
    let strays = |from: &[BezPath], to: &[BezPath]| {
        let all = from
            .iter()
            .zip(to)
            .flat_map(|(a, b)| sample_path(a, 5.0).into_iter().map(|p| path_distance(b, p)));
        all.fold(0.0, f64::max)
    };
    assert!(strays(&still, &plain) > 3.0);
    let by_eye = strays(&plain, &plain_moved);
    assert!(strays(&still, &moved) < by_eye + 0.5, "{} {by_eye}", strays(&still, &moved));
}

#[test]
fn closed_lines_break_at_corners_and_halos_like_open_ones() {
    let square =
        polyline_chain(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0), (0.0, 0.0)], [2.0; 2]);
    // The pen is lifted at each corner, including the start of the closed line.
    let lifted = marks(std::slice::from_ref(&square), &ink_style(&["pen.hand.overshoot=10"]));
    assert_eq!(lifted.len(), 4);
    for mark in &lifted {
        assert!(
            (107.0..=120.0).contains(&path_length(centre_line(mark))),
            "{}",
            path_length(centre_line(mark))
        );
    }
    let broken =
        marks(std::slice::from_ref(&square), &ink_style(&["pen.hand.breaks=100", "pen.hand.tremor=1"]));
    assert_eq!(broken.len(), 4);
    // A halo over the start of the closed line, and one elsewhere.
    for x in [0.0, 50.0] {
        let near = polyline_chain(&[(x - 30.0, -30.0), (x + 30.0, 30.0)], [1.0; 2]);
        let drawn = marks(&[square.clone(), near], &ink_style(&["pen.halo=5"]));
        assert_eq!(drawn.len(), 2, "{x}");
        let inked: f64 = drawn.iter().map(|mark| path_length(centre_line(mark))).sum();
        let gap = 2.0 * 7.0 * 2.0_f64.sqrt();
        assert!((inked - (400.0 + 60.0 * 2.0_f64.sqrt() - gap)).abs() < 0.02, "{x}: {inked}");
    }
    // With tremor and swell, its corners do not move.
    let mut lit = square;
    lit.samples.iter_mut().for_each(|sample| sample.light = 0.5);
    let drawn = marks(&[lit], &ink_style(&["pen.hand.tremor=2", "pen.swell.lit=0.5"]));
    let [mark] = &drawn[..] else { panic!() };
    for corner in [(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0)] {
        assert!(path_distance(centre_line(mark), corner.into()) < 0.01);
        // Round joins of a line 3 px wide.
        let out = |c: f64| c + if c > 50.0 { 1.4 } else { -1.4 } * std::f64::consts::FRAC_1_SQRT_2;
        assert_ne!(mark.path.winding(Point::new(out(corner.0), out(corner.1))), 0);
    }
}

#[test]
fn millimetre_pages_have_the_strokes_of_pixel_pages() {
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
        let style = ink_style(sets);
        let chains = [
            polyline_chain(&[(0.0, 50.0), (300.0, 50.0), (300.0, 250.0)], [1.0; 2]),
            polyline_chain(&[(20.0, 300.0), (280.0, 20.0)], [2.0; 2]),
            circle_chain(60.0),
        ];
        let scale = ligne::drawing::length::MM_PER_PX;
        let small = chains.clone().map(|mut chain| {
            chain.points.iter_mut().for_each(|p| *p = (p.to_vec2() * scale).to_point());
            chain.path.apply_affine(kurbo::Affine::scale(scale));
            chain
        });
        let [px, mm] = [(&chains, Unit::Px), (&small, Unit::Mm)].map(|(chains, unit)| {
            let layers = ink(chains, &InkContext { unit, ..ink_context(&style) }, &style.stroke);
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

fn camera(scene: &Scene) -> Camera {
    let mut camera = Camera::three_quarter();
    (camera.width, camera.height) = (400.0, 400.0);
    camera.fit(scene)
}

#[test]
fn seeds_change_only_hand_drawn_lines() {
    let model = scene([torus(40, 20, 1.0, 0.4), cuboid(DVec3::splat(-0.3), DVec3::splat(0.3))]);
    let camera = camera(&model);
    let [one, other] = ["seed=0", "seed=5"].map(|seed| {
        let sets: Vec<&str> = HAND_DRAWN_OVERRIDES.iter().copied().chain([seed]).collect();
        render(&model, &camera, &ink_style(&sets)).unwrap()
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
    // Without hand-drawn effects, the seed changes nothing.
    let plain = ["seed=0", "seed=5"]
        .map(|seed| render(&model, &camera, &ink_style(&["pen.swell.taper=20", seed])).unwrap());
    assert_eq!(plain[0].layers, plain[1].layers);
}

/// Returns the number of samples on fill borders that carry a line, and the samples that hand-drawn lines
/// leave uncovered.
fn uncovered_border_points(model: &Scene, camera: &Camera) -> (usize, Vec<Point>) {
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
    let plain = render(model, camera, &ink_style(&sets[..4])).unwrap();
    let hand = render(model, camera, &ink_style(&sets)).unwrap();
    let ink =
        |drawing: &Drawing| -> Vec<BezPath> { lines(drawing).iter().map(|mark| mark.path.clone()).collect() };
    let (straight, shaken) = (ink(&plain), ink(&hand));
    let fills = hand.layers.iter().find(|layer| layer.kind == LayerKind::Fills).expect("fills");
    let (mut asked, mut bare) = (0, Vec::new());
    for p in fills.marks.iter().flat_map(|fill| sample_path(&fill.path, 3.0)) {
        if straight.iter().all(|path| path_distance(path, p) > 1.0) {
            continue;
        }
        asked += 1;
        if !shaken.iter().any(|path| path.winding(p) != 0 || path_distance(path, p) < 0.05) {
            bare.push(p);
        }
    }
    (asked, bare)
}

#[test]
fn hand_drawn_lines_cover_fill_borders() {
    let bar = cuboid(DVec3::new(-0.3, -2.0, -0.3), DVec3::new(0.3, 2.0, 0.3));
    let model = scene([torus(60, 30, 1.0, 0.4), bar]);
    let (asked, bare) = uncovered_border_points(&model, &camera(&model));
    assert!(asked > 500, "{asked}");
    assert!(bare.is_empty(), "{} of {asked}: {:?}", bare.len(), &bare[..bare.len().min(9)]);
}

#[test]
fn hand_drawn_lines_cover_fill_borders_of_models() {
    for name in ["teapot.obj", "knot.ply", "bear.ply"] {
        let model = Scene::open(format!("{}/examples/models/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap();
        let (asked, bare) = uncovered_border_points(&model, &camera(&model));
        assert!(asked > 500, "{name}: {asked}");
        // Where a contour ends, the fill border continues along mesh edges.
        assert!(
            100 * bare.len() <= asked,
            "{name}: {} of {asked}: {:?}",
            bare.len(),
            &bare[..bare.len().min(9)]
        );
    }
}

#[test]
fn no_gap_opens_between_fills_and_a_straying_brush() {
    // A bow next to the axis, and a leaf with thin ends.
    let bow = "path=\"M0 0C30 2 60 2 100 0C60 6 30 6 0 0M50 9L51 10L50 10Z\"";
    let leaf = "path=\"M0 5C30 -1 60 -1 100 5C60 9 30 9 0 5Z\"";
    let line = polyline_chain(&[(0.0, 50.0), (200.0, 50.0)], [1.0; 2]);
    let gaps = |brush: &str, more: &[&str]| {
        let brush = format!("pen.brush={{{brush}}}");
        let drawn = marks(
            std::slice::from_ref(&line),
            &ink_style(&[&[brush.as_str(), "pen.width=10"], more].concat()),
        );
        let path = &drawn[0].path;
        let inked = |x: f64, y: f64| path.winding(Point::new(x, y)) != 0;
        // The fill ends at y = 50. Ink on either side must leave no gap to it.
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
fn shaded_ink_follows_the_fill_colour_next_to_the_line() {
    let mut line =
        polyline_chain(&(0..=20).map(|k| (f64::from(k) * 10.0, 50.0)).collect::<Vec<_>>(), [1.0; 2]);
    for (k, sample) in line.samples.iter_mut().enumerate() {
        let colour = if k < 10 { Colour::rgb(200, 0, 0) } else { Colour::rgb(0, 0, 100) };
        sample.backdrop.colour = Some(colour);
    }
    let drawn = marks(&[line], &ink_style(&["pen.colour={shade=0.5}"]));
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
    // Round at its ends, cut straight where the ink changes colour.
    assert!((from + 2.0).abs() < 0.2 && (to - 202.0).abs() < 0.2, "{found:?}");
    assert!((border - 95.0).abs() < 1.0 && (again - border).abs() < 0.01, "{found:?}");
}
