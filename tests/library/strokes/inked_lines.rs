//! Hand-drawn effects on single lines, tested against closed forms: swell, taper, tremor, overshoot, breaks,
//! passes and brushes.

use crate::library::support::measures::stroke_marks::{
    centre_line, circle_chain, ink_style, marks, outline_paint, path_distance, path_length, polyline_chain,
    sample_path, width_at,
};
use kurbo::{Point, Shape};
use ligne::drawing::{OutlinePaint, Paint};
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::lines::LineKind;
use ligne::style::Style;
use std::f64::consts::{PI, TAU};

#[test]
fn tapered_ends_follow_the_easing_formula() {
    let style = ink_style(&["pen.swell.taper=40", "pen.swell.taper_to=0.25"]);
    let drawn = marks(&[polyline_chain(&[(0.0, 50.0), (200.0, 50.0)], [1.0; 2])], &style);
    for (x, t) in [(10.0, 0.25), (20.0, 0.5), (30.0, 0.75), (100.0, 1.0), (180.0, 0.5), (195.0, 0.125)] {
        let wanted = 4.0 * (0.25 + 0.75 * t * (2.0 - t));
        let width = width_at(&drawn[0], x, 50.0);
        assert!((width - wanted).abs() < 0.12, "{x}: {width}, not {wanted}");
    }
    // The mean loss is 1/3 of the 3/4, over 2 times 40 px of 200 px.
    assert!((outline_paint(&drawn[0]).width - 4.0 * (1.0 - 0.75 / 3.0 * 0.4)).abs() < 0.02);
    // Lines that are too short taper over half their length; closed lines do not taper.
    let short = marks(&[polyline_chain(&[(0.0, 50.0), (40.0, 50.0)], [1.0; 2])], &style);
    assert!((width_at(&short[0], 20.0, 50.0) - 4.0).abs() < 0.1);
    assert!((width_at(&short[0], 10.0, 50.0) - 4.0 * (0.25 + 0.75 * 0.75)).abs() < 0.15);
    assert!(matches!(marks(&[circle_chain(50.0)], &style)[0].paint, Paint::Stroke(_)));
}

#[test]
fn continuing_lines_do_not_taper_at_their_joint() {
    let style = ink_style(&["pen.swell.taper=30"]);
    let first = polyline_chain(&[(0.0, 50.0), (100.0, 50.0)], [1.0; 2]);
    let mut second = polyline_chain(&[(100.0, 50.0), (200.0, 52.0)], [1.0; 2]);
    second.kind = LineKind::Border;
    // A line that leaves at a right angle does not continue the first.
    let third = polyline_chain(&[(100.0, 50.0), (100.0, 150.0)], [1.0; 2]);
    let drawn = marks(&[first, second, third], &style);
    let level = drawn.iter().find(|mark| mark.path.winding(Point::new(50.0, 50.0)) != 0).unwrap();
    assert!((width_at(level, 95.0, 50.0) - 4.0).abs() < 0.1);
    assert!(width_at(level, 5.0, 50.0) < 3.0);
    // Continuing lines of different widths meet at the mean width.
    let thin = self::ink_style(&["pen.swell.taper=30", "pen.border.width=2"]);
    let [first, mut second] =
        [(0.0, 100.0), (100.0, 200.0)].map(|(a, b)| polyline_chain(&[(a, 50.0), (b, 50.0)], [1.0; 2]));
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
fn widths_follow_depth_light_gap_and_curvature() {
    let far = polyline_chain(&[(0.0, 50.0), (100.0, 50.0), (200.0, 50.0)], [2.0, 4.0]);
    let near = ink_style(&["pen.swell.near=0.5"]);
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
        let darker =
            width_at(&marks(std::slice::from_ref(&lit), &ink_style(&["pen.swell.lit=0.6"]))[0], x, 50.0);
        assert!((darker - 4.0 * (1.0 - 0.6 * light)).abs() < 0.1, "{x}: {darker}");
        // Light and depth multiply.
        let sets = ink_style(&["pen.swell.lit=0.6", "pen.swell.near=0.5"]);
        let both = width_at(&marks(std::slice::from_ref(&lit), &sets)[0], x, 50.0);
        assert!((both - 4.0 * (1.0 - 0.6 * light) * (1.0 - 0.5 * x / 200.0)).abs() < 0.1, "{x}: {both}");
        let deeper =
            width_at(&marks(std::slice::from_ref(&lit), &ink_style(&["pen.swell.gap=0.6"]))[0], x, 50.0);
        assert!((deeper - 4.0 * (1.0 - 0.6 * (1.0 - light))).abs() < 0.1, "{x}: {deeper}");
    }
    // A circle is convex everywhere. The factor grows with x/(1 + x), where x is `bend_radius` divided by the
    // radius.
    let bend = ink_style(&["pen.swell.bend=0.6", "pen.swell.bend_radius=50"]);
    for radius in [25.0, 50.0, 100.0] {
        let mark = &marks(&[circle_chain(radius)], &bend)[0];
        let Paint::Outline(OutlinePaint { width, .. }) = mark.paint else { panic!("{mark:?}") };
        let x = 50.0 / radius;
        let wanted = 4.0 * (1.0 + 0.6 * x / (1.0 + x));
        assert!((width - wanted).abs() < 0.05, "{radius}: {width}, not {wanted}");
        let area = TAU * radius * wanted;
        assert!((mark.path.area().abs() - area).abs() < 0.01 * area, "{}", mark.path.area());
    }
    // With the shape on the outer side, the circle is concave.
    let mut hole = circle_chain(50.0);
    hole.samples.iter_mut().for_each(|sample| sample.side = 1.0);
    let Paint::Outline(OutlinePaint { width, .. }) = marks(&[hole], &bend)[0].paint else { panic!() };
    assert!((width - 4.0 * 0.7).abs() < 0.05, "{width}");
}

#[test]
fn tremor_stays_within_its_amplitude_and_seeds_change_nothing_else() {
    let chains = [
        polyline_chain(&[(0.0, 50.0), (300.0, 50.0), (300.0, 250.0)], [1.0; 2]),
        polyline_chain(&[(20.0, 300.0), (280.0, 330.0)], [1.0; 2]),
        circle_chain(60.0),
    ];
    let sets =
        |seed: &'static str| ["pen.hand.tremor=3", "pen.hand.tremor_length=40", "pen.swell.taper=20", seed];
    let [one, other] = [sets("seed=1"), sets("seed=2")].map(|sets| marks(&chains, &ink_style(&sets)));
    assert_eq!((one.len(), other.len()), (3, 3));
    assert_eq!(one, marks(&chains, &ink_style(&sets("seed=1"))));
    let mut greatest = 0.0_f64;
    for drawn in [&one, &other] {
        for (mark, chain) in drawn.iter().zip(&chains) {
            for p in sample_path(centre_line(mark), 2.0) {
                let away = path_distance(&chain.path, p);
                assert!(away < 3.0 + 0.1, "{away}");
                greatest = greatest.max(away);
            }
            // Ends and corners do not move.
            for p in chain.points.iter().filter(|_| !chain.closed) {
                assert!(path_distance(centre_line(mark), *p) < 0.15, "{p:?}");
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
fn overshoot_and_stray_stay_within_their_limits() {
    let line = polyline_chain(&[(100.0, 50.0), (300.0, 50.0)], [1.0; 2]);
    for seed in 0..20 {
        let seed = format!("seed={seed}");
        let drawn = marks(std::slice::from_ref(&line), &ink_style(&["pen.hand.overshoot=12", &seed]));
        let bounds = centre_line(&drawn[0]).bounding_box();
        for over in [100.0 - bounds.x0, bounds.x1 - 300.0] {
            assert!((0.35 * 12.0 - 1e-6..12.0 + 1e-6).contains(&over), "{over}");
        }
        let sketched =
            marks(std::slice::from_ref(&line), &ink_style(&["pen.hand.passes=3", "pen.hand.stray=2", &seed]));
        assert_eq!(sketched.len(), 3);
        assert!(centre_line(&sketched[0]).bounding_box().height() < 1e-9);
        for mark in &sketched {
            let strays =
                sample_path(centre_line(mark), 2.0).into_iter().map(|p| path_distance(&line.path, p));
            assert!(strays.fold(0.0, f64::max) < 2.1);
        }
        assert_ne!(sketched[1].path, sketched[2].path);
    }
    // Where a surface covers the end, the line does not overshoot.
    let mut covered = line.clone();
    covered.covered = [true, false];
    let drawn = marks(&[covered], &ink_style(&["pen.hand.overshoot=12"]));
    assert!((centre_line(&drawn[0]).bounding_box().x0 - 100.0).abs() < 1e-6);
    // The pen is lifted at corners.
    let corner = polyline_chain(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0)], [1.0; 2]);
    let drawn = marks(&[corner], &ink_style(&["pen.hand.overshoot=12"]));
    assert_eq!(drawn.len(), 2);
    assert!(
        centre_line(&drawn[0]).bounding_box().x1 > 104.0 && centre_line(&drawn[1]).bounding_box().y0 < -4.0
    );
}

#[test]
fn break_count_follows_the_mean_distance() {
    let line = polyline_chain(&[(0.0, 50.0), (1000.0, 50.0)], [1.0; 2]);
    for seed in 0..10 {
        let drawn =
            marks(std::slice::from_ref(&line), &ink_style(&["pen.hand.breaks=100", &format!("seed={seed}")]));
        assert_eq!(drawn.len(), 11);
        let inked: f64 = drawn.iter().map(|mark| path_length(centre_line(mark))).sum();
        // Gaps of 3 px, plus or minus 40 percent.
        assert!((1000.0 - 10.0 * 3.0 * 1.4..=1000.0 - 10.0 * 3.0 * 0.6).contains(&inked), "{inked}");
    }
    let ring = marks(&[circle_chain(100.0)], &ink_style(&["pen.hand.breaks=100"]));
    assert_eq!(ring.len(), 6);
}

#[test]
fn halos_interrupt_farther_lines() {
    let near = polyline_chain(&[(0.0, 100.0), (200.0, 100.0)], [1.0; 2]);
    let style = ink_style(&["pen.halo=5"]);
    for degrees in [90.0_f64, 60.0, 30.0] {
        let (c, s) = (cos(degrees.to_radians()), sin(degrees.to_radians()));
        let end = |t: f64| (100.0 + t * c, 100.0 + t * s);
        let far = polyline_chain(&[end(-90.0), end(90.0)], [2.0; 2]);
        let drawn = marks(&[near.clone(), far], &style);
        assert_eq!(drawn.len(), 3, "{degrees}");
        let inked: f64 = drawn.iter().map(|mark| path_length(centre_line(mark))).sum();
        // Half the line width plus the halo on both sides, measured along the crossing line.
        let gap = 2.0 * (2.0 + 5.0) / s;
        assert!((inked - (200.0 + 180.0 - gap)).abs() < 0.01, "{degrees}: {inked}");
    }
    // Hidden lines are interrupted as well.
    let mut hidden = polyline_chain(&[(100.0, 10.0), (100.0, 190.0)], [2.0; 2]);
    hidden.invisibility = 1;
    let drawn = marks(&[near.clone(), hidden], &self::ink_style(&["pen.halo=5", "lines.hidden=solid"]));
    assert_eq!(drawn.len(), 3);
    // A line that ends at a T-junction leaves a gap. A line that meets the other in space leaves none,
    // however steeply it recedes.
    let below = polyline_chain(&[(100.0, 100.0), (100.0, 180.0)], [2.0; 2]);
    let inked: f64 =
        marks(&[near.clone(), below], &style).iter().map(|mark| path_length(centre_line(mark))).sum();
    assert!((inked - (280.0 - 7.0)).abs() < 0.01, "{inked}");
    let met = polyline_chain(&[(100.0, 100.0), (100.0, 180.0)], [1.0, 9.0]);
    assert_eq!(marks(&[near.clone(), met], &style).len(), 2);
    let inked: f64 =
        marks(&[near.clone(), polyline_chain(&[(100.0, 100.0), (100.0, 180.0)], [1.0, 9.0])], &style)
            .iter()
            .map(|mark| path_length(centre_line(mark)))
            .sum();
    assert!((inked - 280.0).abs() < 0.01, "{inked}");
}

#[test]
fn brushes_follow_lines() {
    // A rhombus twice as long as wide: stretched once over the line, then repeated along it.
    let lozenge = "path=\"M0 5L10 0L20 5L10 10Z\"";
    let line = polyline_chain(&[(0.0, 50.0), (200.0, 50.0)], [1.0; 2]);
    let stretched = marks(std::slice::from_ref(&line), &ink_style(&[&format!("pen.brush={{{lozenge}}}")]));
    assert!((width_at(&stretched[0], 100.0, 50.0) - 4.0).abs() < 0.1);
    assert!((width_at(&stretched[0], 50.0, 50.0) - 2.0).abs() < 0.1);
    assert!((stretched[0].path.area().abs() - 400.0).abs() < 2.0);
    assert!((outline_paint(&stretched[0]).width - 2.0).abs() < 0.02);
    let repeated =
        marks(&[line], &ink_style(&[&format!("pen.brush={{{lozenge}, mode=\"repeat\", length=20}}")]));
    assert_eq!(repeated[0].path.elements().iter().filter(|e| **e == kurbo::PathEl::ClosePath).count(), 10);
    for k in 0..10 {
        assert!((width_at(&repeated[0], 20.0 * f64::from(k) + 10.0, 50.0) - 4.0).abs() < 0.1);
    }
    // A circle takes a whole number of copies, and the last ends where the first begins.
    let around = marks(
        &[circle_chain(50.0)],
        &ink_style(&[&format!("pen.brush={{{lozenge}, mode=\"repeat\", length=20}}")]),
    );
    let path = &around[0].path;
    assert_eq!(path.elements().iter().filter(|e| **e == kurbo::PathEl::ClosePath).count(), 16);
    let reach: Vec<f64> =
        sample_path(path, 0.5).iter().map(|p| (*p - Point::new(200.0, 200.0)).hypot2().sqrt()).collect();
    let (low, high) = reach.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), r| (l.min(*r), h.max(*r)));
    assert!((low - 48.0).abs() < 0.1 && (high - 52.0).abs() < 0.1, "{low} {high}");
    let copy = PI * 100.0 / 16.0 * 2.0;
    assert!((path.area().abs() - 16.0 * copy).abs() < 4.0, "{}", path.area());
}

#[test]
fn png_pictures_serve_as_brushes() {
    // An image of 8 by 8 pixels: four columns dark over the full height, four only in the upper half.
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
    let loaded = Style::load(folder.join("sheet.toml").to_str().unwrap());
    std::fs::write(folder.join("sheet.toml"), "[pen]\nbrush = { image = \"lost.png\" }\n").unwrap();
    let lost = Style::load(folder.join("sheet.toml").to_str().unwrap()).unwrap_err().to_string();
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(lost.contains("lost.png") && lost.contains("cannot read the brush"), "{lost}");
    let drawn = marks(&[polyline_chain(&[(0.0, 50.0), (160.0, 50.0)], [1.0; 2])], &loaded.unwrap());
    assert!((width_at(&drawn[0], 40.0, 50.0) - 8.0).abs() < 0.1);
    assert_eq!(drawn[0].path.winding(Point::new(120.0, 51.0)), 0);
    assert_ne!(drawn[0].path.winding(Point::new(120.0, 47.0)), 0);
}

#[test]
fn very_short_lines_are_drawn() {
    let dot = polyline_chain(&[(10.0, 10.0), (10.5, 10.2)], [1.0; 2]);
    assert_eq!(marks(&[dot], &ink_style(&["pen.swell.taper=20"])).len(), 1);
}
