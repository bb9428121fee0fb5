//! Halftone dots and stippling: measured coverage equals the requested tone, and marks stay on their surface.

use crate::library::support::measures::polygon_cover;
use crate::library::support::measures::polygon_cover::{mean_coverage, polygon_regions, square};
use kurbo::{BezPath, Point, Shape};
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::hatching::{CellDots, DotScreen, Stipple, ToneBorders, dots, stipple};
use ligne::regions::HatchRegions;

const SCREEN: DotScreen = DotScreen {
    pitch: 6.0,
    angle: std::f64::consts::FRAC_PI_4,
    origin: Point::ORIGIN,
    tone_borders: ToneBorders::Whole,
    px: 1.0,
};

const STIPPLE: Stipple = Stipple { radius: 0.9, uneven: 0.2, rounds: 8, seed: 1, px: 1.0 };

/// A square patch of 100 px.
fn patch() -> HatchRegions {
    polygon_regions(&[(1, square(7.0, 9.0, 100.0))])
}

fn patch_coverage(made: &[CellDots]) -> f64 {
    let paths: Vec<&BezPath> = made.iter().map(|dots| &dots.path).collect();
    mean_coverage(&paths, 7.0, 9.0, 100.0)
}

fn assert_equal_on_any_thread_count<T: Send + PartialEq>(make: impl Fn() -> T + Sync) {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(&make)
    };
    let one = with(1);
    assert!(one == with(2) && one == with(3));
}

/// A wavy star in two tones on one surface, a square in it on another surface, and the shade at a point of a
/// cell.
fn scene() -> (HatchRegions, impl Fn(u32, Point) -> f64 + Sync) {
    let middle = Point::new(100.0, 100.0);
    let at = |k: usize| {
        let angle = std::f64::consts::TAU * (k % 200) as f64 / 200.0;
        middle + kurbo::Vec2::new(cos(angle), sin(angle)) * (80.0 + 12.0 * sin(5.0 * angle))
    };
    let hole = square(60.0, 110.0, 30.0);
    // The upper half, and the lower half with a slit to the hole and around it.
    let upper: Vec<Point> = (100..=200).map(at).collect();
    let mut lower: Vec<Point> = (0..=100).map(at).collect();
    lower.extend([hole[0], hole[3], hole[2], hole[1], hole[0], at(100)]);
    let light = |cell: u32, p: Point| match cell {
        1 => 0.002 * p.x,
        2 => 0.55,
        _ => 0.3,
    };
    (polygon_regions(&[(1, upper), (1, lower), (2, hole)]), light)
}

#[test]
fn dot_screen_coverage_matches_the_requested_tone() {
    let patch = patch();
    for (pitch, degrees) in [(6.0, 45.0), (3.7, 15.0), (1.6, 0.0), (11.0, 75.0_f64)] {
        let screen = DotScreen { pitch, angle: degrees.to_radians(), ..SCREEN };
        let mut before = 0.0;
        for percent in (0..=100).step_by(5) {
            let asked = f64::from(percent) / 100.0;
            let share = patch_coverage(&dots(&patch, &screen, &|_, _| asked));
            assert!((share - asked).abs() < 0.012, "{pitch} {degrees}: {asked} became {share}");
            assert!(share > before || percent == 0, "{asked}");
            before = share;
        }
    }
}

#[test]
fn darker_screens_keep_the_ink_of_lighter_ones() {
    let (ground, _) = scene();
    let inked = |asked: f64| {
        let made = dots(&ground, &SCREEN, &|_, _| asked);
        let paths: Vec<&BezPath> = made.iter().map(|dots| &dots.path).collect();
        polygon_cover::pixel_coverage(&paths, 0.0, 0.0, 200.0)
    };
    let mut before = inked(0.05);
    for percent in (10..=95).step_by(5) {
        let now = inked(f64::from(percent) / 100.0);
        let lost = before.iter().zip(&now).filter(|(before, now)| **before > **now + 0.3).count();
        assert!(lost < 12, "{percent}: {lost} pixels of {}", now.len());
        before = now;
    }
}

#[test]
fn stipple_coverage_matches_the_requested_tone() {
    let patch = patch();
    let mut before = 0.0;
    for percent in (0..=95).step_by(5) {
        let asked = f64::from(percent) / 100.0;
        let share = patch_coverage(&stipple(&patch, &STIPPLE, &|_, _| asked));
        assert!((share - asked).abs() < 0.03, "{asked} became {share}");
        assert!(share > before || percent == 0, "{asked}");
        before = share;
    }
}

#[test]
fn halftone_marks_stay_on_their_surface() {
    let (ground, light) = scene();
    let cut = DotScreen { tone_borders: ToneBorders::Cut, ..SCREEN };
    let made = [
        (dots(&ground, &SCREEN, &light), true),
        (dots(&ground, &cut, &light), false),
        (stipple(&ground, &STIPPLE, &light), true),
    ];
    for (made, may_pass_tones) in made {
        assert_eq!(made.len(), 3);
        for CellDots { cell, path } in &made {
            let facet = |cell: u32| ground.cells[cell as usize].facet;
            let is_own = |other: u32| other == *cell || (may_pass_tones && facet(other) == facet(*cell));
            for segment in path.segments() {
                for t in [0.0, 0.3, 0.6] {
                    let p = kurbo::ParamCurve::eval(&segment, t);
                    // A point of the surface lies within 0.02 px.
                    let mut around = (0..16).map(|k| {
                        let angle = std::f64::consts::TAU * (f64::from(k) + 0.3) / 16.0;
                        let way = kurbo::Vec2::new(cos(angle), sin(angle));
                        ground.cell_at(p + way * 0.02)
                    });
                    assert!(around.any(is_own), "cell {cell}: {p:?}");
                }
            }
        }
    }
}

#[test]
fn blank_cells_stay_blank_and_cut_dots() {
    let left = square(0.0, 0.0, 60.0);
    let right = square(60.0, 0.0, 60.0);
    let ground = polygon_regions(&[(1, left), (1, right)]);
    let shade = |cell: u32, _: Point| if cell == 1 { 0.4 } else { 0.0 };
    for made in [dots(&ground, &SCREEN, &shade), stipple(&ground, &STIPPLE, &shade)] {
        assert_eq!(made.len(), 1);
        assert!(made[0].path.bounding_box().x1 < 60.02);
        assert!((mean_coverage(&[&made[0].path], 0.0, 0.0, 60.0) - 0.4).abs() < 0.015);
    }
}

#[test]
fn light_stippling_is_even_without_a_lattice() {
    let made = stipple(&polygon_regions(&[(1, square(0.0, 0.0, 300.0))]), &STIPPLE, &|_, _| 0.1);
    let centres: Vec<(Point, f64)> = made[0]
        .path
        .elements()
        .split(|element| matches!(element, kurbo::PathEl::ClosePath))
        .filter(|dot| !dot.is_empty())
        .map(|dot| {
            let around = dot.iter().copied().collect::<BezPath>().bounding_box();
            (around.center(), around.width() / 2.0)
        })
        .collect();
    let density = centres.len() as f64 / (300.0 * 300.0);
    let spacing = density.sqrt().recip();
    // Radial distribution: pair distances in tenths of the spacing, from dots away from the edge.
    let mut pairs = [0.0_f64; 60];
    let mut seen = 0.0;
    for (k, (p, radius)) in centres.iter().enumerate() {
        let is_within = |p: Point| (0.0..=300.0).contains(&p.x) && (0.0..=300.0).contains(&p.y);
        assert!(is_within(*p));
        let is_inner = [p.x, p.y].iter().all(|x| (6.0 * spacing..300.0 - 6.0 * spacing).contains(x));
        seen += f64::from(u8::from(is_inner));
        for (other, (q, other_radius)) in centres.iter().enumerate() {
            let distance = (*p - *q).hypot2().sqrt();
            if other == k {
                continue;
            }
            assert!(distance > radius + other_radius, "dots overlap at {p:?}");
            if is_inner && distance < 6.0 * spacing {
                pairs[(distance / spacing * 10.0) as usize] += 1.0;
            }
        }
    }
    let ring = |k: usize| {
        let (inner, outer) = (k as f64 / 10.0 * spacing, (k + 1) as f64 / 10.0 * spacing);
        std::f64::consts::PI * (outer * outer - inner * inner) * density
    };
    let radial: Vec<f64> = pairs.iter().enumerate().map(|(k, pairs)| pairs / seen / ring(k)).collect();
    println!("{radial:.2?}");
    // No dot within 0.6 of the spacing, no sharp peak at the neighbours, and even density from 3 spacings on.
    assert!(radial[..6].iter().all(|share| *share == 0.0), "{radial:.2?}");
    assert!(radial[7..14].iter().all(|share| *share < 3.0), "{radial:.2?}");
    assert!(radial[30..].iter().all(|share| (0.8..1.2).contains(share)), "{radial:.2?}");
}

#[test]
fn halftones_do_not_depend_on_thread_count() {
    let (ground, light) = scene();
    assert_equal_on_any_thread_count(|| dots(&ground, &SCREEN, &light));
    assert_equal_on_any_thread_count(|| stipple(&ground, &STIPPLE, &light));
}
