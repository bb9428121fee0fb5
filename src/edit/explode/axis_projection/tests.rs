//! Contacts of random boxes, compared with vertical columns through both.

use super::*;
use crate::geometry::dice::Dice;

type Box3 = [DVec3; 2];

fn body_of_boxes(boxes: &[Box3]) -> Body {
    let mut body = Body::default();
    for [low, high] in boxes {
        let at = |k: usize| {
            let pick = |bit: usize, l: f64, h: f64| if k >> bit & 1 == 1 { h } else { l };
            DVec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z))
        };
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        for [a, b, c, d] in sides {
            body.triangles.extend([[at(a), at(b), at(c)], [at(a), at(c), at(d)]]);
        }
    }
    body
}

/// Overlap and blocked areas by columns. Between the sides of boxes, each column has constant contents.
fn areas_by_columns(a: &[Box3], b: &[Box3]) -> [f64; 3] {
    let sides = |k: usize| {
        let mut sides: Vec<f64> = a.iter().chain(b).flatten().map(|p| p[k]).collect();
        sides.sort_by(f64::total_cmp);
        sides
    };
    let (across, along) = (sides(0), sides(1));
    let mut areas = [0.0; 3];
    for (x, y) in across.windows(2).flat_map(|x| along.windows(2).map(move |y| (x, y))) {
        let (middle, area) = ([(x[0] + x[1]) / 2.0, (y[0] + y[1]) / 2.0], (x[1] - x[0]) * (y[1] - y[0]));
        let stands = |of: &&Box3| (0..2).all(|k| of[0][k] < middle[k] && middle[k] < of[1][k]);
        let (mut up, mut down, mut met) = (false, false, false);
        for (a, b) in a.iter().filter(stands).flat_map(|a| b.iter().filter(stands).map(move |b| (a, b))) {
            met = true;
            let ([a0, a1], [b0, b1]) = (a.map(|p| p.z), b.map(|p| p.z));
            up |= b0 >= a1 || a0 < b0 && b0 < a1 && a1 < b1;
            down |= b1 <= a0 || b0 < a0 && a0 < b1 && b1 < a1;
        }
        for (sum, is) in areas.iter_mut().zip([met, up, down]) {
            *sum += if is { area } else { 0.0 };
        }
    }
    areas
}

#[test]
fn contact_with_matches_vertical_columns_of_random_boxes() {
    let mut dice = Dice::new(8);
    let (mut held, mut apart) = (0, 0);
    for round in 0..200 {
        // Two boxes per body, one above the other.
        let mut random = || {
            let mut box_between = |low: f64, high: f64| {
                let (x, y, z) = (dice.between(0.0, 1.5), dice.between(0.0, 1.5), dice.between(low, high));
                let size = DVec3::new(dice.between(0.2, 1.5), dice.between(0.2, 1.5), dice.between(0.2, 0.6));
                [DVec3::new(x, y, z), DVec3::new(x, y, z) + size]
            };
            [box_between(0.0, 1.0), box_between(2.0, 3.0)]
        };
        let (a, b) = (random(), random());
        let shadow = |boxes: &[Box3]| AxisProjection::new(&body_of_boxes(boxes), &DVec3::AXES);
        let (of_a, of_b) = (shadow(&a), shadow(&b));
        let meeting = of_a.contact_with(&of_b, 1e-9);
        assert_eq!(of_b.contact_with(&of_a, 1e-9), meeting.turned(), "round {round}");
        let graze = MAX_GRAZE_AREA_RATIO * of_a.area.min(of_b.area);
        // Columns count once even if several boxes overlap there.
        let columns = areas_by_columns(&a, &b);
        let said = [meeting.meets, meeting.blocks_up, meeting.blocks_down];
        for (said, area) in said.iter().zip(columns).filter(|(_, area)| *area == 0.0 || *area > graze) {
            assert_eq!(*said, area > graze, "round {round}: {columns:?}");
        }
        held += usize::from(said == [true; 3]);
        apart += usize::from(said == [true, true, false]);
    }
    assert!(held > 10 && apart > 10, "{held} {apart}");
}

#[test]
fn contact_with_reports_a_body_inside_a_ring() {
    let block = |x: [f64; 2], y: [f64; 2]| [DVec3::new(x[0], y[0], 0.0), DVec3::new(x[1], y[1], 1.0)];
    let ring = [
        block([-3.0, -2.0], [-3.0, 3.0]),
        block([2.0, 3.0], [-3.0, 3.0]),
        block([-2.0, 2.0], [-3.0, -2.0]),
        block([-2.0, 2.0], [2.0, 3.0]),
    ];
    let shadow = |boxes: &[Box3]| AxisProjection::new(&body_of_boxes(boxes), &DVec3::AXES);
    let within = |inner: &[Box3], outer: &[Box3]| shadow(inner).contact_with(&shadow(outer), 1e-9).is_within;
    assert!(within(&[block([-1.0, 1.0], [-1.0, 1.0])], &ring));
    assert!(within(&ring, &[block([-2.0, 2.0], [-2.0, 2.0])]));
    // A gap in the ring is a free path outward.
    assert!(!within(&[block([-1.0, 1.0], [-1.0, 1.0])], &ring[..3]));
    assert!(!within(&[block([4.0, 5.0], [-1.0, 1.0])], &ring));
}
