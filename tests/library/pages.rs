//! Pages: panels tile the page, balloons cover no face, and what is wrong is told with its place.

use ligne::kurbo::Rect;
use ligne::page::layout::{Grid, Polygon, Reading, cells};

/// Numbers by chance that are the same each time (splitmix64).
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    /// A layout with brackets at most so deep; gutters lean by whole degrees up to `lean`.
    fn layout(&mut self, depth: u64, lean: i64) -> String {
        let count = 1 + self.below(3);
        let between = if self.below(2) == 0 { "/" } else { "|" };
        let mut text = String::new();
        for item in 0..count {
            if item > 0 {
                let degrees = self.below(2 * lean as u64 + 1) as i64 - lean;
                text += between;
                if degrees != 0 {
                    text += &format!("{degrees}°");
                }
            }
            text += &format!(" {}", 1 + self.below(4));
            if depth > 0 && self.below(2) == 0 {
                text += &format!(" [{}]", self.layout(depth - 1, lean));
            }
            text += " ";
        }
        text
    }
}

fn grid(gutter: f64, reading: Reading) -> Grid {
    Grid { frame: Rect::new(10.0, 12.0, 410.0, 612.0), gutter: [gutter; 2], reading }
}

#[test]
fn panels_tile_the_page() {
    let mut chance = Chance(1);
    let mut panels = 0;
    for _ in 0..300 {
        let layout = chance.layout(2, 6);
        let grid = grid(0.0, Reading::Ltr);
        let Ok(cells) = cells(&layout, &grid) else { continue };
        let outlines: Vec<Polygon> = cells.iter().map(|cell| cell.outline(grid.frame)).collect();
        let area: f64 = outlines.iter().map(Polygon::area).sum();
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

#[test]
fn gutters_part_panels_by_their_width() {
    let mut chance = Chance(2);
    for _ in 0..200 {
        let layout = chance.layout(2, 8);
        let grid = grid(5.0, Reading::Ltr);
        let Ok(cells) = cells(&layout, &grid) else { continue };
        let outlines: Vec<Polygon> = cells.iter().map(|cell| cell.outline(grid.frame)).collect();
        for (number, a) in outlines.iter().enumerate() {
            for b in &outlines[number + 1..] {
                // Convex: their distance is at least the gutter where a line parts them by it, which is one of their sides.
                assert!(!a.meets(b, 5.0 - 1e-9), "{layout}");
            }
        }
    }
}

#[test]
fn shares_are_exact() {
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
    // A gutter that leans between two sides takes from one corner what it gives the other.
    let leaning = cells("1 |12° 1", &grid).unwrap();
    let areas = leaning.iter().map(|cell| cell.outline(grid.frame).area());
    let gutter = 4.0 * 600.0 / f64::to_radians(12.0).cos();
    areas.for_each(|area| assert!((area - (400.0 * 600.0 - gutter) / 2.0).abs() < 1e-6, "{area}"));
}

#[test]
fn right_to_left_mirrors_left_to_right() {
    let mut chance = Chance(3);
    for _ in 0..100 {
        let layout = chance.layout(2, 6);
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
fn panels_without_size_are_refused() {
    for layout in ["0.001 | 100", "1 |50° 1 |-50° 1", "99.9 / *"] {
        let fault = cells(layout, &grid(4.0, Reading::Ltr)).unwrap_err();
        assert!(fault.message.contains("no size"), "{layout}: {}", fault.message);
    }
    let narrow = Grid { frame: Rect::new(0.0, 0.0, 100.0, 100.0), ..grid(60.0, Reading::Ltr) };
    assert!(cells("1 | 1 | 1", &narrow).unwrap_err().message.contains("no size"));
}
