//! Times of linking, tidying, smoothing and fitting of chains, on generated view maps.

use divan::{Bencher, black_box};
use kurbo::Point;
use libm::{cos, sin};
use ligne::Style;
use ligne::drawing::Unit;
use ligne::internals::add_line as add;
use ligne::pipeline::{Chain, LineKind, ViewMap};

fn main() {
    divan::main();
}

/// Wavy loops of small zigzag edges, like the contours of a scan.
fn scan(pieces: usize) -> ViewMap {
    let mut map = ViewMap::default();
    let each = 300;
    for ring in 0..pieces / each {
        let centre = Point::new(50.0 + 20.0 * (ring % 45) as f64, 50.0 + 60.0 * (ring / 45) as f64);
        let points: Vec<Point> = (0..each)
            .map(|k| {
                let angle = std::f64::consts::TAU * k as f64 / each as f64;
                let radius = 40.0 + 6.0 * sin(5.0 * angle) + if k % 2 == 0 { 0.2 } else { -0.2 };
                Point::new(centre.x + radius * cos(angle), centre.y + radius * sin(angle))
            })
            .collect();
        add(&mut map, &points, true, LineKind::Contour);
    }
    map
}

/// Boxes with nine visible edges each.
fn city(edges: usize) -> ViewMap {
    let mut map = ViewMap::default();
    for house in 0..edges / 9 {
        let corner = Point::new(7.0 * (house % 140) as f64, 7.0 * (house / 140) as f64);
        let at = |x: f64, y: f64| Point::new(corner.x + x, corner.y + y);
        let hexagon = [at(0.0, 2.0), at(3.0, 1.0), at(6.0, 2.0), at(6.0, 5.0), at(3.0, 6.0), at(0.0, 5.0)];
        add(&mut map, &hexagon, true, LineKind::Border);
        for spoke in [0, 2, 4] {
            add(&mut map, &[at(3.0, 3.0), hexagon[spoke]], false, LineKind::Crease);
        }
    }
    map
}

#[divan::bench(args = [3_000, 60_000])]
fn chains_of_a_scan(bencher: Bencher, pieces: usize) {
    let (map, style) = (scan(pieces), Style::default());
    bencher.bench(|| Chain::link(black_box(&map), &style, Unit::Px));
}

#[divan::bench(args = [160_000])]
fn chains_of_a_city(bencher: Bencher, edges: usize) {
    let (map, style) = (city(edges), Style::default());
    bencher.bench(|| Chain::link(black_box(&map), &style, Unit::Px));
}
