//! [`Motion`]: one similarity (shift, rotation and scale) that carries the marks of one drawing onto those
//! of another.
//!
//! 1. Pairs of paths that may correspond each give a candidate motion, by least squares on their points.
//! 2. A candidate is scored by the share of sample points that it carries onto the other drawing, in both
//!    directions.
//! 3. The best candidate is refined by a fit to all pairs that it maps onto each other.
//!
//! Coordinates and distances are in px.

use kurbo::{Affine, BezPath, Point, Rect, Vec2};

use crate::diff::curves::segment::{Segment, bounds, points};
use crate::diff::curves::segment_clusters::SegmentClusters;
use crate::diff::tolerances;

/// Number of pairs of paths, evenly spaced in the list, that give candidate motions. Rounding may nearly
/// double it.
const MAX_MOTION_TRIALS: usize = 48;
/// Number of sample points on each drawing for scoring a motion.
const MOTION_SAMPLES: usize = 600;

/// A similarity and its score.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Motion {
    pub affine: Affine,
    /// Share of the sample points that it carries onto a line of the other drawing, 0 to 1: the smaller of
    /// the shares in both directions.
    pub share: f64,
}

impl Motion {
    /// Scale factor.
    pub(crate) fn scale(&self) -> f64 {
        self.affine.determinant().abs().sqrt()
    }

    /// Rotation in degrees, clockwise on the page.
    pub(crate) fn turn(&self) -> f64 {
        let [a, b, ..] = self.affine.as_coeffs();
        crate::geometry::numbers::portable_math::atan2(b, a).to_degrees()
    }

    /// Displacement of a point.
    pub(crate) fn displacement(&self, p: Point) -> Vec2 {
        self.affine * p - p
    }

    /// Displacements of the four corners of a rectangle.
    pub(crate) fn corner_displacements(&self, place: Rect) -> [Vec2; 4] {
        let (x, y) = ([place.x0, place.x1], [place.y0, place.y1]);
        [(0, 0), (1, 0), (0, 1), (1, 1)]
            .map(|(i, j): (usize, usize)| self.displacement(Point::new(x[i], y[j])))
    }
}

/// Input for fitting a motion to two drawings.
pub(crate) struct MotionInput<'a> {
    /// Pairs of paths, one of each drawing, that may correspond.
    pub path_pairs: Vec<[&'a BezPath; 2]>,
    /// All marks of each drawing as polylines.
    pub lines: [Vec<Vec<Point>>; 2],
}

impl MotionInput<'_> {
    /// Bounding boxes of the marks of each drawing.
    pub(crate) fn boxes(&self) -> [Rect; 2] {
        [0, 1].map(|side: usize| bounds(self.lines[side].iter().flatten()))
    }
}

/// Scores motions on two drawings.
struct MotionScorer {
    /// Sample points of each drawing.
    places: [Vec<Point>; 2],
    lines: [LineIndex; 2],
    /// Maximum distance of a sample point from the line that it is carried onto, px.
    reach: f64,
}

impl MotionScorer {
    fn new(marks: &MotionInput, reach: f64) -> Option<Self> {
        let places = [0, 1].map(|side: usize| spread(&marks.lines[side]));
        if places.iter().any(Vec::is_empty) {
            return None;
        }
        Some(Self { places, lines: [0, 1].map(|side: usize| LineIndex::new(&marks.lines[side])), reach })
    }

    /// Scores a motion; `None` for extreme scale factors.
    fn score(&self, affine: Affine) -> Option<Motion> {
        let Self { places, lines, reach } = self;
        let growth = affine.determinant().abs().sqrt();
        if !tolerances::MOTION_SCALES.contains(&growth) {
            return None;
        }
        let hits = |places: &[Point], to: Affine, lines: &LineIndex, reach: f64| {
            let near = places.iter().filter(|p| lines.has(to * **p, reach)).count();
            near as f64 / places.len() as f64
        };
        let forth = hits(&places[0], affine, &lines[1], reach * growth.max(1.0));
        let back = hits(&places[1], affine.inverse(), &lines[0], reach / growth.min(1.0));
        Some(Motion { affine, share: forth.min(back) })
    }
}

/// Score of the identity: the share of both drawings that coincides with the other one without any motion.
pub(crate) fn static_share(marks: &MotionInput, reach: f64) -> f64 {
    MotionScorer::new(marks, reach)
        .and_then(|judge| judge.score(Affine::IDENTITY))
        .map_or(0.0, |motion| motion.share)
}

/// The motion with the highest score: a similarity if `similar`, otherwise a shift. `more` adds candidates;
/// `reach` is the distance (px) within which a sample point hits a line.
pub(crate) fn find(marks: &MotionInput, more: &[Affine], reach: f64, similar: bool) -> Option<Motion> {
    let judge = MotionScorer::new(marks, reach)?;
    let judge = |affine: Affine| judge.score(affine);
    let step = (marks.path_pairs.len() / MAX_MOTION_TRIALS).max(1);
    let tried = marks.path_pairs.iter().step_by(step).filter_map(|[old, new]| {
        let (a, b) = (points(old), points(new));
        (a.len() == b.len()).then(|| fit(&a, &b, similar)).flatten()
    });
    let mut best: Option<Motion> = None;
    for found in tried.chain(more.iter().copied()).filter_map(judge) {
        if best.is_none_or(|best| found.share > best.share + tolerances::MIN_SCORE_GAIN_SHARE) {
            best = Some(found);
        }
    }
    let best = best?;
    // Refine the motion with all pairs that it carries onto each other.
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for [old, new] in &marks.path_pairs {
        let (old, new) = (points(old), points(new));
        let growth = best.scale().max(1.0);
        if old.len() == new.len()
            && old.iter().zip(&new).all(|(p, q)| (best.affine * *p).distance(*q) <= 2.0 * reach * growth)
        {
            a.extend(old);
            b.extend(new);
        }
    }
    let refined = fit(&a, &b, similar).and_then(judge).filter(|refined| refined.share >= best.share - 0.01);
    Some(refined.unwrap_or(best))
}

/// Least-squares similarity or shift that carries points `a` to points `b`.
fn fit(a: &[Point], b: &[Point], similar: bool) -> Option<Affine> {
    if a.is_empty() || a.len() != b.len() {
        return None;
    }
    let count = a.len() as f64;
    let mean = |points: &[Point]| points.iter().fold(Vec2::ZERO, |sum, p| sum + p.to_vec2()) / count;
    let (mean_a, mean_b) = (mean(a), mean(b));
    if !similar {
        return Some(Affine::translate(mean_b - mean_a));
    }
    let (mut turn, mut size) = (Vec2::ZERO, 0.0);
    for (p, q) in a.iter().zip(b) {
        let (p, q) = (p.to_vec2() - mean_a, q.to_vec2() - mean_b);
        turn += Vec2::new(p.dot(q), p.cross(q));
        size += p.hypot2();
    }
    if size <= tolerances::MIN_POINT_SPREAD_PX2 {
        return None;
    }
    let turn = turn / size;
    let linear = Affine::new([turn.x, turn.y, -turn.y, turn.x, 0.0, 0.0]);
    Some(Affine::translate(mean_b - (linear * mean_a.to_point()).to_vec2()) * linear)
}

/// About [`MOTION_SAMPLES`] points, evenly spaced along all lines together.
fn spread(lines: &[Vec<Point>]) -> Vec<Point> {
    let segments = || lines.iter().flat_map(|points| points.windows(2)).map(|pair| (pair[0], pair[1]));
    let length: f64 = segments().map(|(p, q)| p.distance(q)).sum();
    let step = length / MOTION_SAMPLES as f64;
    let mut found = Vec::new();
    let mut rest = step / 2.0;
    for (p, q) in segments() {
        let own = p.distance(q);
        while rest < own && found.len() <= MOTION_SAMPLES {
            found.push(p.lerp(q, rest / own));
            rest += step;
        }
        rest -= own;
    }
    found
}

/// Lines with an index for distance queries.
struct LineIndex {
    segments: Vec<Segment>,
    clusters: SegmentClusters,
}

impl LineIndex {
    fn new(lines: &[Vec<Point>]) -> Self {
        let segments = lines.iter().flat_map(|points| points.windows(2));
        let segments: Vec<Segment> =
            segments.map(|pair| Segment { chain: 0, from: pair[0], to: pair[1] }).collect();
        let bundles = SegmentClusters::new(&segments);
        Self { segments, clusters: bundles }
    }

    /// Whether a point is within `reach` of the lines.
    fn has(&self, p: Point, reach: f64) -> bool {
        self.clusters.any(&self.segments, p, reach)
    }
}
