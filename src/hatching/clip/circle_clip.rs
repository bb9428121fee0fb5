//! [`ClippedDisc`]: a disc clipped to a domain.
//!
//! Source: Weiler and Atherton, Hidden surface removal using polygon area sorting, 1977, for one circle. The
//! outline of the result follows border pieces inside the circle and arcs of the circle inside the domain in
//! turn.
//!
//! Whether the end of a piece lies inside the circle is decided once for each point, so the loops always
//! close. If rounding confuses the order around the circle, a slightly smaller circle is tried.

use std::f64::consts::TAU;

use kurbo::{BezPath, Point, Vec2};

use super::disc::Disc;
use crate::geometry::numbers::portable_math::atan2;
use crate::geometry::plane::douglas_peucker::{douglas_peucker, farthest_point};
use crate::geometry::plane::planar_distance::{segment_distance_squared, turn_from_y_to_x};
use crate::geometry::plane::polyline_path::add_polygon;
use crate::hatching::tolerances;

/// Result of clipping a disc to a domain.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ClippedDisc {
    /// The whole disc is inside.
    Whole,
    /// Nothing is left.
    Nothing,
    /// The remaining part as a path, and its area.
    Part(BezPath, f64),
}

impl Disc {
    /// Clips the disc to a domain, which lies to the right of its directed `border` as seen on the page (y
    /// down).
    ///
    /// Pieces that do not touch the disc have no effect. If no piece touches it, `inside` says whether the
    /// centre is in the domain. `px` is the length of a px in user units.
    pub(crate) fn cut(self, border: &[[Point; 2]], inside: bool, px: f64) -> ClippedDisc {
        for attempt in 0..MAX_ATTEMPTS {
            let radius = self.radius * (1.0 - f64::from(attempt) * tolerances::DOT_SHRINK_OF_RADIUS);
            let disc = Self { radius, ..self };
            if let Some(cut) = DiscTracer::new(disc, border).and_then(|mut tracer| tracer.cut(inside, px)) {
                return cut;
            }
        }
        ClippedDisc::Nothing
    }
}

/// Number of circles that are tried before the dot is dropped.
const MAX_ATTEMPTS: u32 = 8;

/// Part of a border piece inside the circle. Points are relative to the centre.
#[derive(Debug, Clone, Copy)]
struct BorderSpan {
    ends: [Vec2; 2],
    /// Whether each end lies on the circle.
    rim: [bool; 2],
    used: bool,
}

/// Crossing of the border with the circle.
#[derive(Debug, Clone, Copy)]
struct CircleCrossing {
    angle: f64,
    /// Whether the border enters the circle here.
    enters: bool,
    step: usize,
}

struct DiscTracer {
    disc: Disc,
    /// Parts of the border, sorted by their start points.
    steps: Vec<BorderSpan>,
    /// Crossings sorted by angle. Entering and leaving ones alternate.
    gates: Vec<CircleCrossing>,
}

impl DiscTracer {
    /// `None` if rounding leaves the order around the circle ambiguous.
    fn new(disc: Disc, border: &[[Point; 2]]) -> Option<Self> {
        let r2 = disc.radius * disc.radius;
        let mut steps = Vec::new();
        for ends in border {
            // Adding zero turns a negative zero into a positive one, so that equal points compare equal.
            let [a, b] = ends.map(|p| p - disc.centre + Vec2::ZERO);
            let way = b - a;
            let is_in = [a, b].map(|p| p.hypot2() < r2);
            // |a + t way|² = r² at t = middle ± half.
            let length2 = way.hypot2();
            let middle = -a.dot(way) / length2;
            let off = a.cross(way) / length2;
            let half2 = r2 / length2 - off * off;
            let half = half2.max(0.0).sqrt();
            let at = |t: f64| a + way * t.clamp(0.0, 1.0);
            let step = match is_in {
                _ if a == b => continue,
                [true, true] => BorderSpan { ends: [a, b], rim: [false, false], used: false },
                [true, false] => BorderSpan { ends: [a, at(middle + half)], rim: [false, true], used: false },
                [false, true] => BorderSpan { ends: [at(middle - half), b], rim: [true, false], used: false },
                [false, false] if half2 > 0.0 && middle > 0.0 && middle < 1.0 => BorderSpan {
                    ends: [at(middle - half), at(middle + half)],
                    rim: [true, true],
                    used: false,
                },
                [false, false] => continue,
            };
            steps.push(step);
        }
        steps.sort_by(|s, t| order(s.ends[0], t.ends[0]).then_with(|| order(s.ends[1], t.ends[1])));
        let mut gates = Vec::new();
        for (step, BorderSpan { ends, rim, .. }) in steps.iter().enumerate() {
            for end in [0, 1] {
                if rim[end] {
                    gates.push(CircleCrossing {
                        angle: atan2(ends[end].y, ends[end].x),
                        enters: end == 0,
                        step,
                    });
                }
            }
        }
        gates.sort_by(|a, b| a.angle.total_cmp(&b.angle).then(a.step.cmp(&b.step)));
        let n = gates.len();
        let take_turns = (0..n).all(|k| gates[k].enters != gates[(k + 1) % n].enters);
        take_turns.then_some(Self { disc, steps, gates })
    }

    fn cut(&mut self, inside: bool, px: f64) -> Option<ClippedDisc> {
        let (mut path, mut area2) = (BezPath::new(), 0.0);
        for first in 0..self.gates.len() {
            if self.gates[first].enters && !self.steps[self.gates[first].step].used {
                area2 += self.follow(first, &mut path, px)?;
            }
        }
        // The remaining steps form loops inside the circle. The orientation of the largest one says whether
        // its surroundings are in the domain.
        let mut largest = 0.0_f64;
        for first in 0..self.steps.len() {
            if !self.steps[first].used {
                let (points, last) = self.chain(first)?;
                if self.steps[last].rim[1] {
                    return None;
                }
                let loop2: f64 = points.windows(2).map(|pair| pair[0].cross(pair[1])).sum();
                largest = if loop2.abs() > largest.abs() { loop2 } else { largest };
                area2 += loop2;
                self.draw_loop(&points, &mut path, px);
            }
        }
        if self.gates.is_empty() {
            if self.steps.is_empty() {
                return Some(if inside { ClippedDisc::Whole } else { ClippedDisc::Nothing });
            }
            if largest < 0.0 {
                area2 += TAU * self.disc.radius * self.disc.radius;
                self.disc.draw(&mut path, px);
            }
        }
        let crumb = tolerances::MIN_DOT_PIECE_PX * px;
        let area = area2 / 2.0;
        Some(if area < crumb * crumb { ClippedDisc::Nothing } else { ClippedDisc::Part(path, area) })
    }

    /// Traces the loop that enters the circle at a crossing, adds it to the path, and returns twice its area.
    fn follow(&mut self, first: usize, path: &mut BezPath, px: f64) -> Option<f64> {
        let (mut gate, mut area2) = (first, 0.0);
        loop {
            let (points, last) = self.chain(self.gates[gate].step)?;
            area2 += points.windows(2).map(|pair| pair[0].cross(pair[1])).sum::<f64>();
            let thin = thinned(&points, &[0, points.len() - 1], tolerances::MAX_DOT_OUTLINE_ERROR_PX * px);
            for (k, point) in thin.iter().enumerate() {
                match (gate == first, k) {
                    (true, 0) => path.move_to(self.disc.centre + *point),
                    // The preceding arc ends at this point.
                    (false, 0) => {}
                    _ => path.line_to(self.disc.centre + *point),
                }
            }
            let left = self.gates.iter().position(|g| g.step == last && !g.enters)?;
            let next = (left + 1) % self.gates.len();
            let (from, to) = (self.gates[left].angle, self.gates[next]);
            let sweep = if next > left { to.angle - from } else { to.angle - from + TAU };
            self.disc.arc(path, from, sweep, self.steps[to.step].ends[0], px);
            area2 += self.disc.radius * self.disc.radius * sweep;
            if next == first {
                path.close_path();
                return Some(area2);
            }
            if self.steps[to.step].used {
                return None;
            }
            gate = next;
        }
    }

    /// The points of the border from the start of a step to where it leaves the circle or closes, and the
    /// index of the last step.
    fn chain(&mut self, first: usize) -> Option<(Vec<Vec2>, usize)> {
        let start = self.steps[first].ends[0];
        let closes = !self.steps[first].rim[0];
        let (mut points, mut at) = (vec![start], first);
        loop {
            self.steps[at].used = true;
            let BorderSpan { ends, rim, .. } = self.steps[at];
            points.push(ends[1]);
            if rim[1] || (closes && ends[1] == start) {
                return Some((points, at));
            }
            let begin = self.steps.partition_point(|step| order(step.ends[0], ends[1]).is_lt());
            let from_here = self.steps[begin..].iter().take_while(|step| step.ends[0] == ends[1]);
            // Where several steps continue, take the first one met when turning through the domain from the
            // direction of arrival.
            let back = ends[0] - ends[1];
            let open = from_here.enumerate().filter(|(_, step)| !step.used && !step.rim[0]);
            let turned =
                open.map(|(k, step)| (turn_from_y_to_x(back, step.ends[1] - step.ends[0]), begin + k));
            at = turned.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?.1;
        }
    }

    /// Adds a closed chain of points to the path. Its last point equals its first.
    fn draw_loop(&self, points: &[Vec2], path: &mut BezPath, px: f64) {
        let far = |k: usize| (points[k] - points[0]).hypot2();
        let Some(middle) = farthest_point((0..points.len()).rev(), far, f64::NEG_INFINITY) else { return };
        let mut thin =
            thinned(points, &[0, middle, points.len() - 1], tolerances::MAX_DOT_OUTLINE_ERROR_PX * px);
        thin.pop();
        add_polygon(path, thin.into_iter().map(|point| self.disc.centre + point));
    }
}

fn order(a: Vec2, b: Vec2) -> std::cmp::Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
}

/// The chain without the points that are closer than `off` to the segments between the others. The points at
/// `stops` are kept.
fn thinned(points: &[Vec2], stops: &[usize], off: f64) -> Vec<Vec2> {
    let at = |k: usize| points[k].to_point();
    // Of equally distant points the last one is kept.
    let keep = douglas_peucker(points.len(), stops, |first, last| {
        let distance2 = |k: usize| segment_distance_squared(at(k), at(first), at(last));
        farthest_point((first + 1..last).rev(), distance2, off * off)
    });
    points.iter().zip(keep).filter(|(_, keep)| *keep).map(|(p, _)| *p).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use kurbo::Shape;

    use super::*;
    use crate::geometry::numbers::noise::{hash, unit_interval};
    use crate::geometry::numbers::portable_math::{cos, sin};

    const DISC: Disc = Disc { centre: Point::new(30.0, 20.0), radius: 4.0 };

    /// The area of the clipped disc, checked against the path.
    fn cut(border: &[[Point; 2]], inside: bool) -> f64 {
        match DISC.cut(border, inside, 1.0) {
            ClippedDisc::Whole => PI * 16.0,
            ClippedDisc::Nothing => 0.0,
            ClippedDisc::Part(path, area) => {
                assert!((path.area() - area).abs() < 0.01 * 25.0, "{area} {}", path.to_svg());
                for p in path.segments().map(|s| kurbo::ParamCurve::eval(&s, 0.5)) {
                    assert!((p - DISC.centre).hypot2().sqrt() < 4.01);
                }
                area
            }
        }
    }

    fn disc_point(x: f64, y: f64) -> Point {
        DISC.centre + Vec2::new(x, y)
    }

    fn regular_polygon(centre: Point, radius: f64, corners: usize) -> Vec<Point> {
        let at = |k: usize| TAU * k as f64 / corners as f64;
        (0..corners).map(|k| centre + Vec2::new(cos(at(k)), sin(at(k))) * radius).collect()
    }

    fn closed_sides(corners: &[Point]) -> Vec<[Point; 2]> {
        corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]).collect()
    }

    #[test]
    fn disc_clipped_by_lines_has_exact_areas() {
        let half = [[disc_point(-9.0, 0.0), disc_point(9.0, 0.0)]];
        assert!((cut(&half, true) - 8.0 * PI).abs() < 1e-9);
        // The same in two pieces that meet at the centre and bend there.
        let bent =
            [[disc_point(-9.0, 0.0), disc_point(0.0, 0.0)], [disc_point(0.0, 0.0), disc_point(0.0, -9.0)]];
        assert!((cut(&bent, true) - 12.0 * PI).abs() < 1e-9);
        let back = bent.map(|[a, b]| [b, a]);
        assert!((cut(&back, true) - 4.0 * PI).abs() < 1e-9);
        // A strip between two lines, 2 wide.
        let strip =
            [[disc_point(-9.0, -1.0), disc_point(9.0, -1.0)], [disc_point(9.0, 1.0), disc_point(-9.0, 1.0)]];
        let segment = 16.0 * crate::geometry::numbers::portable_math::acos(0.25) - 15.0_f64.sqrt();
        assert!((cut(&strip, true) - (16.0 * PI - 2.0 * segment)).abs() < 1e-9);
        // The complement of the strip.
        let outside = strip.map(|[a, b]| [b, a]);
        assert!((cut(&outside, false) - 2.0 * segment).abs() < 1e-9);
    }

    #[test]
    fn touching_borders_clip_nothing_off_a_disc() {
        for x in [4.0, 4.0 + 1e-12, 4.0 - 1e-12] {
            assert!(
                (cut(&[[disc_point(x, -9.0), disc_point(x, 9.0)]], true) - 16.0 * PI).abs() < 2e-3,
                "{x}"
            );
            // A square that touches the circle with a corner, and one with a side along the tangent.
            let square = [
                disc_point(x, 0.0),
                disc_point(x + 2.0, -2.0),
                disc_point(x + 4.0, 0.0),
                disc_point(x + 2.0, 2.0),
            ];
            let mut hole = closed_sides(&square);
            hole.iter_mut().for_each(|ends| ends.reverse());
            assert!((cut(&hole, true) - 16.0 * PI).abs() < 2e-3, "{x}");
            assert!(cut(&closed_sides(&square), false).abs() < 2e-3, "{x}");
        }
    }

    #[test]
    fn borders_inside_a_disc_clip_holes_and_islands() {
        let island = closed_sides(&regular_polygon(disc_point(1.0, 0.0), 1.0, 400));
        assert!((cut(&island, false) - PI).abs() < 1e-3);
        let hole: Vec<[Point; 2]> = island.iter().map(|[a, b]| [*b, *a]).collect();
        assert!((cut(&hole, true) - 15.0 * PI).abs() < 1e-3);
        // Two triangles that share one point.
        let left = closed_sides(&[disc_point(0.0, 0.0), disc_point(-2.0, 1.0), disc_point(-2.0, -1.0)]);
        let right = closed_sides(&[disc_point(0.0, 0.0), disc_point(2.0, -1.0), disc_point(2.0, 1.0)]);
        assert!((cut(&[left, right].concat(), true) - 4.0).abs() < 1e-9);
    }

    #[test]
    fn disc_clipped_by_stars_matches_sampled_areas() {
        for seed in 0..200_u64 {
            let chance = |k: u64, n: u64| unit_interval(hash(seed, &[k, n]));
            let corners = 3 + (chance(0, 0) * 40.0) as u64;
            let middle = disc_point(chance(1, 0) * 8.0 - 4.0, chance(2, 0) * 8.0 - 4.0);
            let star: Vec<Point> = (0..corners)
                .map(|k| {
                    let angle = TAU * (k as f64 + 0.9 * chance(3, k)) / corners as f64;
                    let to = Vec2::new(cos(angle), sin(angle)) * (0.3 + 6.0 * chance(4, k));
                    middle + to
                })
                .collect();
            let mut outline = BezPath::new();
            outline.move_to(star[0]);
            star[1..].iter().for_each(|p| outline.line_to(*p));
            outline.close_path();
            let n = 100;
            let samples = (0..n * n).map(|k| {
                let cell = 8.0 / f64::from(n);
                disc_point(
                    f64::from(k % n) * cell - 4.0 + cell / 2.0,
                    f64::from(k / n) * cell - 4.0 + cell / 2.0,
                )
            });
            let within = samples.filter(|p| (*p - DISC.centre).hypot2() < 16.0 && outline.winding(*p) != 0);
            let wanted = within.count() as f64 * 64.0 / f64::from(n * n);
            let inside = outline.winding(DISC.centre) != 0;
            let got = cut(&closed_sides(&star), inside);
            assert!((got - wanted).abs() < 0.25, "seed {seed}: {got} {wanted}");
            let back: Vec<[Point; 2]> = closed_sides(&star).iter().map(|[a, b]| [*b, *a]).collect();
            let rest = cut(&back, !inside);
            assert!((got + rest - 16.0 * PI).abs() < 0.03, "seed {seed}: {got} and {rest}");
        }
    }
}
