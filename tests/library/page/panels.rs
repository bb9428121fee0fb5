//! Comic panels: they tile the page, gutters have their width, shares are exact, and reading directions
//! mirror each other.

use crate::library::support::scenes::random_dice::Dice;
use ligne::kurbo::{Point, Rect};
use ligne::page::layout::{ConvexPolygon, LayoutGrid, Reading, cells};

/// Returns a random layout with brackets nested up to `depth` levels. Gutters lean by whole degrees, at most
/// `lean`.
fn layout(dice: &mut Dice, depth: u64, lean: i64) -> String {
    let count = 1 + dice.below(3);
    let between = if dice.below(2) == 0 { "/" } else { "|" };
    let mut text = String::new();
    for item in 0..count {
        if item > 0 {
            let degrees = dice.below(2 * lean as usize + 1) as i64 - lean;
            text += between;
            if degrees != 0 {
                text += &format!("{degrees}°");
            }
        }
        text += &format!(" {}", 1 + dice.below(4));
        if depth > 0 && dice.below(2) == 0 {
            text += &format!(" [{}]", layout(dice, depth - 1, lean));
        }
        text += " ";
    }
    text
}

/// Returns a grid in the frame that all pages of these tests share.
pub(crate) fn grid(gutter: f64, reading: Reading) -> LayoutGrid {
    LayoutGrid { frame: Rect::new(10.0, 12.0, 410.0, 612.0), gutter: [gutter; 2], reading }
}

#[test]
fn panels_tile_the_page() {
    let mut dice = Dice::new(1);
    let mut panels = 0;
    for _ in 0..300 {
        let layout = layout(&mut dice, 2, 6);
        let grid = grid(0.0, Reading::Ltr);
        let Ok(cells) = cells(&layout, &grid) else { continue };
        let outlines: Vec<ConvexPolygon> = cells.iter().map(|cell| cell.outline(grid.frame)).collect();
        let area: f64 = outlines.iter().map(ConvexPolygon::area).sum();
        assert!((area - grid.frame.area()).abs() < 1e-6 * grid.frame.area(), "{layout}: {area}");
        for (number, a) in outlines.iter().enumerate() {
            for b in &outlines[number + 1..] {
                assert!(a.common(b).area() < 1e-6, "{layout}");
            }
        }
        panels += outlines.len();
    }
    assert!(panels > 900, "{panels}");
}

/// Returns the distance between two disjoint polygons: the smallest distance from a corner of one to a side
/// of the other.
fn distance(a: &ConvexPolygon, b: &ConvexPolygon) -> f64 {
    let to_side = |p: Point, (from, to): (Point, Point)| {
        let share = ((p - from).dot(to - from) / (to - from).hypot2()).clamp(0.0, 1.0);
        p.distance(from.lerp(to, share))
    };
    let least = |a: &ConvexPolygon, b: &ConvexPolygon| {
        let all = a.0.iter().flat_map(|p| b.sides().map(|side| to_side(*p, side)));
        all.fold(f64::INFINITY, f64::min)
    };
    least(a, b).min(least(b, a))
}

#[test]
fn gutters_separate_panels_by_their_width() {
    let mut dice = Dice::new(2);
    for _ in 0..200 {
        let layout = layout(&mut dice, 2, 8);
        let grid = grid(5.0, Reading::Ltr);
        let Ok(cells) = cells(&layout, &grid) else { continue };
        let outlines: Vec<ConvexPolygon> = cells.iter().map(|cell| cell.outline(grid.frame)).collect();
        for (number, a) in outlines.iter().enumerate() {
            for b in &outlines[number + 1..] {
                assert!(distance(a, b) > 5.0 - 1e-6, "{layout}");
            }
        }
    }
}

#[test]
fn panel_shares_are_exact() {
    let grid = grid(4.0, Reading::Ltr);
    let found = cells("30 [2 | 1 | 1] / 20 / * [1 / 3]", &grid).unwrap();
    let nominal = |k: usize| found[k].nominal;
    let (across, down) = (400.0 - 8.0, 600.0 - 8.0);
    assert!((nominal(0).width() - across / 2.0).abs() < 1e-9);
    assert!((nominal(2).width() - across / 4.0).abs() < 1e-9);
    assert!((nominal(0).height() - down * 0.3).abs() < 1e-9);
    assert!((nominal(3).height() - down * 0.2).abs() < 1e-9);
    let rest = down * 0.5 - 4.0;
    assert!(
        (nominal(4).height() - rest / 4.0).abs() < 1e-9 && (nominal(5).height() - rest * 0.75).abs() < 1e-9
    );
    // A leaning gutter between two sides takes from one corner the area that it gives the other.
    let leaning = cells("1 |12° 1", &grid).unwrap();
    let areas = leaning.iter().map(|cell| cell.outline(grid.frame).area());
    let gutter = 4.0 * 600.0 / ligne::geometry::numbers::portable_math::cos(f64::to_radians(12.0));
    areas.for_each(|area| assert!((area - (400.0 * 600.0 - gutter) / 2.0).abs() < 1e-6, "{area}"));
}

#[test]
fn right_to_left_layouts_mirror_left_to_right_ones() {
    let mut dice = Dice::new(3);
    for _ in 0..100 {
        let layout = layout(&mut dice, 2, 6);
        let (ltr, rtl) = (grid(4.0, Reading::Ltr), grid(4.0, Reading::Rtl));
        let (Ok(a), Ok(b)) = (cells(&layout, &ltr), cells(&layout, &rtl)) else { continue };
        for (a, b) in a.iter().zip(&b) {
            let (a, b) = (a.outline(ltr.frame), b.outline(rtl.frame));
            assert!((a.area() - b.area()).abs() < 1e-6);
            let (a, b) = (a.bounds(), b.bounds());
            assert!((a.x0 + b.x1 - 420.0).abs() < 1e-6 && (a.y0 - b.y0).abs() < 1e-6, "{layout}");
        }
    }
}

#[test]
fn panels_without_size_are_rejected() {
    for (layout, message) in [
        ("0.001 | 100", "no size"),
        ("99.9 / *", "no size"),
        ("1 |50° 1 |-50° 1", "gutters around this panel meet"),
    ] {
        let fault = cells(layout, &grid(4.0, Reading::Ltr)).map(|cells| cells.len()).unwrap_err();
        assert!(fault.message.contains(message), "{layout}: {}", fault.message);
    }
    let narrow = LayoutGrid { frame: Rect::new(0.0, 0.0, 100.0, 100.0), ..grid(60.0, Reading::Ltr) };
    assert!(cells("1 | 1 | 1", &narrow).unwrap_err().message.contains("no size"));
}
