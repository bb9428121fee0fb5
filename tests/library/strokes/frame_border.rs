//! Lines that leave the frame keep their full width up to the border and have no ink outside it; tested
//! against computed widths and bounds.

use glam::DVec3;
use kurbo::{BezPath, Point, Rect, Shape};
use ligne::chains::Chain;
use ligne::drawing::{Mark, Paint};
use ligne::strokes::{InkContext, ink};
use ligne::style::Style;

use crate::library::support::measures::stroke_marks::{
    centre_line, ink_context, ink_style, outline_paint, path_length, polyline_chain, width_at,
};
use crate::library::support::scenes::moving_boxes::{
    draw_at, front_camera, motion_lines, rig_solids, translation_channel, unit_cube,
};

const FRAME: Rect = Rect::new(0.0, 0.0, 200.0, 100.0);

fn ink_in_frame(chains: &[Chain], style: &Style) -> Vec<Mark> {
    let context = InkContext { frame: Some(FRAME), ..ink_context(style) };
    ink(chains, &context, &style.stroke).into_iter().flat_map(|layer| layer.marks).collect()
}

fn is_inside(path: &BezPath) -> bool {
    let bounds = path.bounding_box();
    bounds.x0 >= -1e-6 && bounds.y0 >= -1e-6 && bounds.x1 <= 200.0 + 1e-6 && bounds.y1 <= 100.0 + 1e-6
}

#[test]
fn tapers_lie_outside_the_frame() {
    let style = ink_style(&["pen.swell.taper=40"]);
    let marks = ink_in_frame(&[polyline_chain(&[(0.0, 50.0), (120.0, 50.0)], [1.0; 2])], &style);
    let mark = &marks[0];
    // The line has its full width at the border and tapers as usual at the other end.
    for x in [0.3, 5.0, 40.0, 79.0] {
        assert!((width_at(mark, x, 50.0) - 4.0).abs() < 0.15, "{x}: {}", width_at(mark, x, 50.0));
    }
    // 5 px from that end is an eighth of the taper. The width eases from a fifth at the end to the full
    // width.
    let eased = 4.0 * (0.2 + 0.8 * 0.125 * (2.0 - 0.125));
    assert!((width_at(mark, 115.0, 50.0) - eased).abs() < 0.15, "{}", width_at(mark, 115.0, 50.0));
    assert!(is_inside(&mark.path) && is_inside(centre_line(mark)));
    assert!((path_length(centre_line(mark)) - 120.0).abs() < 0.01);
    let mean = mark.path.area().abs() / 120.0;
    assert!((outline_paint(mark).width - mean).abs() < 0.05, "{} {mean}", outline_paint(mark).width);
    // A line that ends inside the frame tapers, even close to the border.
    let near = ink_in_frame(&[polyline_chain(&[(0.5, 50.0), (120.0, 50.0)], [1.0; 2])], &style);
    assert!(width_at(&near[0], 1.5, 50.0) < 1.0);
}

#[test]
fn slanted_lines_are_clipped_straight_at_the_frame() {
    let style = ink_style(&["pen.swell.taper=30", "pen.width=8"]);
    // From the left border to the lower border.
    let marks = ink_in_frame(&[polyline_chain(&[(0.0, 40.0), (90.0, 100.0)], [1.0; 2])], &style);
    let mark = &marks[0];
    assert!(is_inside(&mark.path));
    // Ink meets both borders over the full width of the line: 8 px divided by the cosine of its angle to
    // them.
    let long = (90.0_f64 * 90.0 + 60.0 * 60.0).sqrt();
    let dark = |from: Point, to: Point| {
        (0..2000).filter(|k| mark.path.winding(from.lerp(to, f64::from(*k) / 2000.0)) != 0).count() as f64
            / 2000.0
            * (to - from).hypot()
    };
    let left = dark(Point::new(0.01, 0.0), Point::new(0.01, 99.9));
    assert!((left - 8.0 * long / 90.0).abs() < 0.3, "{left}");
    let below = dark(Point::new(0.0, 99.99), Point::new(200.0, 99.99));
    assert!((below - 8.0 * long / 60.0).abs() < 0.3, "{below}");
}

#[test]
fn tremor_and_dashes_stay_inside_the_frame() {
    for sets in [
        &["pen.hand.tremor=3", "pen.hand.tremor_length=20"][..],
        &["pen.hand.tremor=2", "pen.dash=[6, 4]"],
        &["pen.swell.taper=20", "pen.hand.overshoot=30", "pen.hand.passes=3", "pen.hand.stray=2"],
        &["pen.brush={ path = 'M0 5C30 -1 60 -1 100 5C60 9 30 9 0 5Z' }"],
    ] {
        let style = ink_style(sets);
        for points in
            [&[(0.0, 50.0), (200.0, 30.0)], &[(60.0, 0.0), (150.0, 100.0)], &[(30.0, 50.0), (80.0, 0.0)]]
        {
            let marks = ink_in_frame(&[polyline_chain(points, [1.0; 2])], &style);
            assert!(!marks.is_empty());
            for mark in &marks {
                let drawn =
                    if matches!(mark.paint, Paint::Stroke(_)) { centre_line(mark) } else { &mark.path };
                assert!(is_inside(drawn), "{sets:?}: {:?}", drawn.bounding_box());
            }
        }
    }
}

#[test]
fn brush_tips_lie_outside_the_frame() {
    let style = ink_style(&["pen.brush={ path = 'M0 5L30 0L70 0L100 5L70 10L30 10Z' }"]);
    let marks = ink_in_frame(&[polyline_chain(&[(0.0, 50.0), (150.0, 50.0)], [1.0; 2])], &style);
    for x in [0.3, 20.0, 60.0] {
        assert!(width_at(&marks[0], x, 50.0) > 3.6, "{x}: {}", width_at(&marks[0], x, 50.0));
    }
    assert!(width_at(&marks[0], 140.0, 50.0) < 2.0);
}

#[test]
fn motion_lines_are_clipped_at_the_frame() {
    // The picture is 10 units wide; the motion began 12 units to the left.
    let model = rig_solids(vec![unit_cube()], vec![translation_channel(0, DVec3::X * 12.0)]);
    let changes = ["motion.taper=1", "motion.width=9", "motion.segments=100", "motion.speed=1"];
    let own = crate::library::support::scenes::moving_boxes::motion_style(&changes);
    let mut camera = front_camera();
    camera.target.x += 12.0;
    camera.eye.x += 12.0;
    let drawing = draw_at(&model, 1.0, &camera, &own);
    let marks = motion_lines(&drawing);
    assert!(!marks.is_empty());
    let frame = Rect::new(0.0, 0.0, drawing.page.width, drawing.page.height);
    for mark in marks {
        let bounds = mark.path.bounding_box();
        assert!(frame.inflate(1e-6, 1e-6).union(bounds) == frame.inflate(1e-6, 1e-6), "{bounds:?}");
    }
    assert!(motion_lines(&drawing).iter().any(|mark| mark.path.bounding_box().x0 < 1e-6));
}
