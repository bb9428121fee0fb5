//! Comparison of random drawings: equivalent drawings are equal, swapped inputs mirror the findings, and
//! distances match brute force.

use crate::library::support::scenes::random_dice::Dice;
use kurbo::{Affine, BezPath, PathEl, Point, Vec2};
use ligne::diff::{self, Diff, DiffOptions, Picture, Verdict};

const PARTS: [&str; 4] = ["base", "lid", "bolt 1", "bolt 2"];
const PAGE: f64 = 400.0;

/// A line of a random drawing.
#[derive(Clone)]
struct Line {
    part: &'static str,
    width: f64,
    path: BezPath,
}

/// Random lines, curves and closed shapes all over the page.
fn random_lines(dice: &mut Dice, count: usize) -> Vec<Line> {
    let mut lines = Vec::new();
    for _ in 0..count {
        let mut at = Point::new(dice.between(20.0, PAGE - 20.0), dice.between(20.0, PAGE - 20.0));
        let mut path = BezPath::new();
        path.move_to(at);
        let mut towards = dice.between(0.0, std::f64::consts::TAU);
        let pieces = 1 + dice.below(6);
        for _ in 0..pieces {
            let way = |angle: f64, length: f64| Vec2::from_angle(angle) * length;
            let length = dice.between(6.0, 24.0);
            let turn = dice.between(-0.5, 0.5);
            let end = at + way(towards + turn, length);
            match dice.below(2) {
                0 => path.line_to(end),
                _ => path.curve_to(
                    at + way(towards, length / 3.0),
                    end - way(towards + 2.0 * turn, length / 3.0),
                    end,
                ),
            }
            (at, towards) = (end, towards + 2.0 * turn);
        }
        if dice.below(5) == 0 && pieces > 2 {
            path.close_path();
        }
        let (part, width) = (PARTS[dice.below(PARTS.len())], [1.0, 1.6][dice.below(2)]);
        lines.push(Line { part, width, path });
    }
    lines
}

fn svg(lines: &[Line], decimals: usize) -> String {
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{PAGE}\" height=\"{PAGE}\"><g fill=\"none\" stroke=\"#000\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"
    );
    for Line { part, width, path } in lines {
        let mut data = String::new();
        let mut put = |letter: &str, points: &[Point]| {
            data += letter;
            for p in points {
                data += &format!("{:.decimals$} {:.decimals$} ", p.x, p.y);
            }
        };
        for element in path.elements() {
            match *element {
                PathEl::MoveTo(p) => put("M", &[p]),
                PathEl::LineTo(p) => put("L", &[p]),
                PathEl::QuadTo(c, p) => put("Q", &[c, p]),
                PathEl::CurveTo(c, d, p) => put("C", &[c, d, p]),
                PathEl::ClosePath => put("Z", &[]),
            }
        }
        out +=
            &format!("<path class=\"crease\" data-part=\"{part}\" stroke-width=\"{width}\" d=\"{data}\"/>\n");
    }
    out + "</g></svg>\n"
}

fn compare(before: &str, after: &str) -> Diff {
    let read = |svg: &str| Picture::from_svg(svg).unwrap_or_else(|error| panic!("{error}\n{svg}"));
    diff::compare(&read(before), &read(after), &DiffOptions::default())
}

/// The same lines in random order, some of them reversed, flattened or split into two marks.
fn rewrite_equivalently(lines: &[Line], dice: &mut Dice) -> Vec<Line> {
    let mut out = Vec::new();
    for line in lines {
        let mut path = line.path.clone();
        if dice.below(2) == 0 {
            path = path.reverse_subpaths();
        }
        if dice.below(3) == 0 {
            let mut flat = BezPath::new();
            kurbo::flatten(path.elements().iter().copied(), 0.001, |element| flat.push(element));
            path = flat;
        }
        let closed = matches!(path.elements().last(), Some(PathEl::ClosePath));
        let count = path.segments().count();
        if dice.below(2) == 0 && count > 1 && !closed {
            // Split into two marks.
            let at = 1 + dice.below(count - 1);
            for piece in [path.segments().take(at).collect::<Vec<_>>(), path.segments().skip(at).collect()] {
                out.push(Line { path: BezPath::from_path_segments(piece.into_iter()), ..line.clone() });
            }
        } else {
            out.push(Line { path, ..line.clone() });
        }
    }
    for index in (1..out.len()).rev() {
        out.swap(index, dice.below(index + 1));
    }
    out
}

#[test]
fn equivalent_drawings_compare_as_equal() {
    for seed in 0..60 {
        let mut dice = Dice::new(seed);
        let lines = random_lines(&mut dice, 60);
        let before = svg(&lines, 3);
        let again = compare(&before, &(before.clone() + "\n"));
        assert!(again.is_same(), "{:#?}", again.lines());
        let after = svg(&rewrite_equivalently(&lines, &mut dice), 5);
        let diff = compare(&before, &after);
        assert!(diff.is_same(), "seed {seed}: {:#?}", diff.lines());
        assert!(compare(&after, &before).is_same(), "seed {seed}, backwards");
    }
}

#[test]
fn a_shift_is_reported_as_moved_by_its_length() {
    for seed in 0..40 {
        let mut dice = Dice::new(seed);
        let lines = random_lines(&mut dice, 25);
        let d = [0.1, 0.7, 3.0][dice.below(3)];
        let way = Vec2::from_angle(dice.between(0.0, std::f64::consts::TAU)) * d;
        let moved: Vec<Line> = lines
            .iter()
            .map(|line| Line { path: Affine::translate(way) * line.path.clone(), ..line.clone() })
            .collect();
        let diff = compare(&svg(&lines, 4), &svg(&rewrite_equivalently(&moved, &mut dice), 4));
        assert!(!diff.findings.is_empty());
        for finding in &diff.findings {
            assert_eq!(finding.verdict, Verdict::Moved, "seed {seed}: {:#?}", diff.lines());
            assert!((finding.largest - d).abs() <= 0.01 * d, "seed {seed}: {} for {d}", finding.largest);
            assert!((finding.p95 - d).abs() <= 0.01 * d, "seed {seed}: {} for {d}", finding.p95);
        }
    }
}

/// The lines with some removed, widened, moved or scaled, and with two lines added.
fn edit_randomly(lines: &[Line], dice: &mut Dice) -> Vec<Line> {
    let mut out = random_lines(dice, 2);
    for line in lines {
        let mut line = line.clone();
        match dice.below(8) {
            0 => continue,
            1 => line.width += 0.5,
            2 => {
                line.path = Affine::translate((dice.between(-3.0, 3.0), dice.between(-3.0, 3.0))) * line.path
            }
            3 => {
                line.path = Affine::scale_about(dice.between(0.7, 1.3), Point::new(200.0, 200.0)) * line.path
            }
            _ => {}
        }
        out.push(line);
    }
    out
}

#[test]
fn findings_mirror_when_the_inputs_are_swapped() {
    for seed in 0..60 {
        let mut dice = Dice::new(seed);
        let lines = random_lines(&mut dice, 40);
        let (before, after) = (svg(&lines, 3), svg(&edit_randomly(&lines, &mut dice), 3));
        let told = |diff: &Diff, mirrored: bool| {
            let mut all: Vec<(Verdict, String, i64)> = diff
                .findings
                .iter()
                .map(|finding| {
                    let verdict = match (finding.verdict, mirrored) {
                        (Verdict::Removed, true) => Verdict::Added,
                        (Verdict::Added, true) => Verdict::Removed,
                        (verdict, _) => verdict,
                    };
                    (verdict, finding.label.part_name().to_owned(), (finding.largest * 100.0).round() as i64)
                })
                .collect();
            all.sort();
            all
        };
        let (forth, back) = (compare(&before, &after), compare(&after, &before));
        assert!(!forth.findings.is_empty());
        let (forth_told, back_told) = (told(&forth, false), told(&back, true));
        assert_eq!(
            forth_told.len(),
            back_told.len(),
            "seed {seed}: {:#?} {:#?}",
            forth.lines(),
            back.lines()
        );
        for (a, b) in forth_told.iter().zip(&back_told) {
            assert_eq!((a.0, &a.1), (b.0, &b.1), "seed {seed}: {:#?} {:#?}", forth.lines(), back.lines());
            assert!((a.2 - b.2).abs() <= 1 + a.2 / 100, "seed {seed}: {a:?} {b:?}");
        }
    }
}

/// Largest distance from points of one path to the other, by brute force.
fn brute_force_distance(one: &BezPath, other: &BezPath) -> f64 {
    let points = |path: &BezPath| {
        let mut points: Vec<Point> = Vec::new();
        for segment in path.segments() {
            points.extend((0..=40).map(|i| kurbo::ParamCurve::eval(&segment, f64::from(i) / 40.0)));
        }
        points
    };
    let (ours, theirs) = (points(one), points(other));
    let nearest = |p: &Point| {
        let on = |pair: &[Point]| {
            let along = pair[1] - pair[0];
            let share = if along.hypot2() > 0.0 {
                ((*p - pair[0]).dot(along) / along.hypot2()).clamp(0.0, 1.0)
            } else {
                0.0
            };
            p.distance(pair[0] + along * share)
        };
        theirs.windows(2).map(on).fold(f64::INFINITY, f64::min)
    };
    ours.iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn distances_match_brute_force() {
    let (mut near, mut far) = (0, 0);
    for seed in 0..300 {
        let mut dice = Dice::new(seed);
        let line = random_lines(&mut dice, 1).remove(0);
        // Each control point moves independently.
        let reach = [0.004, 0.012, 0.02, 0.03, 0.1, 1.0][dice.below(6)];
        let mut bent = line.clone();
        bent.path = line
            .path
            .elements()
            .iter()
            .map(|element| {
                Affine::translate((dice.between(-reach, reach), dice.between(-reach, reach))) * *element
            })
            .collect();
        let distance =
            brute_force_distance(&line.path, &bent.path).max(brute_force_distance(&bent.path, &line.path));
        let diff = compare(&svg(std::slice::from_ref(&line), 2), &svg(std::slice::from_ref(&bent), 6));
        let tolerance = diff.tolerance_px;
        assert!((tolerance - 0.02).abs() < 1e-12);
        // One of the two lines is written with two decimals.
        let rounding = 0.5e-2 * 1.5;
        if distance < tolerance - rounding - 0.003 {
            near += 1;
            assert!(diff.is_same(), "seed {seed}: {distance} {:#?}", diff.lines());
        } else if distance > tolerance + rounding + 0.003 {
            far += 1;
            let [finding] = diff.findings.as_slice() else { panic!("seed {seed}: {:#?}", diff.lines()) };
            assert!(
                (finding.largest - distance).abs() < rounding + 0.01 * distance + 0.002,
                "{} {distance}",
                finding.largest
            );
        }
    }
    assert!(near > 40 && far > 60, "{near} {far}");
}
