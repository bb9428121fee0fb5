//! Strokes laid along guides: broken, bowed, trembling, and clipped at the borders of the tone.

use kurbo::{Point, Vec2};

use super::guide::{Guide, GuideScope};
use crate::geometry::numbers::noise::{hash, unit_interval, value_noise};
use crate::geometry::numbers::portable_math::tan;
use crate::geometry::plane::planar_distance::length;
use crate::geometry::plane::polylines::{arc_lengths, polyline_length};
use crate::hatching::clip::line_clip::{clip_to_cells, sub_polyline};
use crate::hatching::tolerances;
use crate::regions::HatchRegions;

/// Stroke of a hatching.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HatchStroke {
    /// Centre line in page units.
    pub points: Vec<Point>,
    /// The cell where it starts.
    pub cell: u32,
    /// Pen pressure, 0 to 1.
    pub pressure: f64,
    /// Identity from guide, stroke and piece. It is the same in all drawings of the same model with the same
    /// seed.
    pub id: u64,
    /// The rank of its guide.
    pub rank: f64,
}

/// Parameters of laying strokes. Lengths are in page units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct StrokeLayout {
    /// Length of a stroke; 0 means unbroken.
    pub length: f64,
    /// Gap between consecutive strokes of one line.
    pub gap: f64,
    /// Random variation of length and position, 0 to 1.
    pub uneven: f64,
    /// Greatest sideways offset of a stroke from its line.
    pub stray: f64,
    /// Greatest random turn of a stroke, radians.
    pub turn: f64,
    /// Greatest bow of the middle of a stroke.
    pub bow: f64,
    /// Amplitude of tremor.
    pub tremor: f64,
    /// Variation of pressure, 0 to 1.
    pub pressure: f64,
    /// How far strokes run over borders.
    pub overrun: f64,
    /// How far strokes stop short of borders.
    pub short: f64,
    /// Random variation of the ends at borders.
    pub ragged: f64,
    /// Shorter pieces are dropped.
    pub least: f64,
    /// A CSS px in page units.
    pub px: f64,
    /// Random seed.
    pub seed: u64,
}

/// Wavelength of tremor, px.
const TREMOR_WAVE_PX: f64 = 24.0;

/// Distance between points of a stroke that is not straight, px.
const POINT_STEP_PX: f64 = 4.0;

impl StrokeLayout {
    /// Whether each stroke is the unbroken guide itself.
    fn is_plain(&self) -> bool {
        self.length <= 0.0 && self.is_straight()
    }

    fn is_straight(&self) -> bool {
        self.bow <= 0.0 && self.tremor <= 0.0
    }

    /// Greatest distance of a stroke point from its guide.
    fn reach(&self) -> f64 {
        self.stray + self.bow + self.tremor + self.length * tan(self.turn.min(1.0))
    }

    /// Lays strokes along a guide where the `density` of a cell, the share of all guides wanted there,
    /// exceeds the guide's rank.
    #[must_use]
    pub(crate) fn lay(&self, guide: &Guide, ground: &HatchRegions, density: &[f64]) -> Vec<HatchStroke> {
        let in_scope = |cell: u32| match guide.scope {
            GuideScope::Part(part) => {
                let hatch_cell = &ground.cells[cell as usize];
                hatch_cell.facet != 0 && hatch_cell.look.part == part
            }
            GuideScope::Facet(facet) => ground.cells[cell as usize].facet == facet,
        };
        let wanted_density = |cell: u32| if in_scope(cell) { density[cell as usize] } else { 0.0 };
        let is_wanted = |cell: u32| wanted_density(cell) > guide.rank;
        let on_guide = clip_to_cells(ground, &guide.line, is_wanted);
        if on_guide.is_empty() {
            return Vec::new();
        }
        let mut out = Vec::new();
        if self.is_plain() && guide.crowding.is_empty() {
            for (piece, stretch) in on_guide.into_iter().enumerate() {
                let points = sub_polyline(&guide.line, stretch.from, stretch.to);
                let id = hash(guide.id, &[0, piece as u64]);
                out.extend(self.ended(points, stretch.cut, HatchStroke { id, ..blank(guide, stretch.cell) }));
            }
            return out;
        }
        let arcs = arc_lengths(&guide.line);
        let at_arc = |line_position: f64| {
            let k = (line_position as usize).min(arcs.len() - 2);
            arcs[k] + (arcs[k + 1] - arcs[k]) * (line_position - k as f64)
        };
        let margin = self.reach();
        let spans: Vec<(f64, f64)> =
            on_guide.iter().map(|s| (at_arc(s.from) - margin, at_arc(s.to) + margin)).collect();
        for (number, (start, end)) in self.strokes(guide, *arcs.last().unwrap_or(&0.0), &spans) {
            let id = hash(guide.id, &[number.cast_unsigned()]);
            let points = self.drawn(guide, &arcs, start, end, id);
            if points.len() < 2 {
                continue;
            }
            let mut piece = 0;
            for stretch in clip_to_cells(ground, &points, is_wanted) {
                for (from, to) in
                    uncrowded_spans(guide, &arcs, &points, (start, end), stretch.from, stretch.to, |c| {
                        wanted_density(stretch.cell) > guide.rank * c
                    })
                {
                    let cut = [stretch.cut[0] && from == stretch.from, stretch.cut[1] && to == stretch.to];
                    let stroke = HatchStroke { id: hash(id, &[piece]), ..blank(guide, stretch.cell) };
                    piece += 1;
                    out.extend(self.ended(sub_polyline(&points, from, to), cut, stroke));
                }
            }
        }
        out
    }

    /// Numbers and arc-length ranges of the strokes of a guide that touch any of the spans.
    fn strokes(&self, guide: &Guide, total: f64, spans: &[(f64, f64)]) -> Vec<(i64, (f64, f64))> {
        if self.length <= 0.0 {
            return vec![(0, (0.0, total))];
        }
        let period = self.length + self.gap;
        let shift = unit_interval(hash(guide.id, &[START_SEED])) * period;
        let first = (-shift / period).floor() as i64 - 1;
        let last = ((total - shift) / period).ceil() as i64 + 1;
        let mut strokes = Vec::new();
        for number in first..=last {
            // The two ends of a stroke vary independently.
            let end = |side: u64, n: i64| {
                self.uneven
                    * period
                    * 0.5
                    * (unit_interval(hash(guide.id, &[ENDS_SEED, side, n.cast_unsigned()])) - 0.5)
            };
            let middle = shift + number as f64 * period;
            let start = (middle + end(0, number)).max(0.0);
            let stop = (middle + self.length + end(1, number)).min(total);
            if stop > start && spans.iter().any(|(a, b)| start < *b && stop > *a) {
                strokes.push((number, (start, stop)));
            }
        }
        strokes
    }

    /// The centre line of a stroke between two arc lengths of its guide.
    fn drawn(&self, guide: &Guide, arcs: &[f64], start: f64, end: f64, id: u64) -> Vec<Point> {
        let chance = |what: u64| 2.0 * unit_interval(hash(self.seed, &[id, what])) - 1.0;
        let (aside, turn) = (self.stray * chance(1), tan(self.turn.min(1.0)) * chance(2));
        let bow = self.bow * chance(3);
        let tremor = hash(self.seed, &[id, 4]);
        let total = end - start;
        let straight = guide.line.len() == 2 && self.is_straight();
        let count =
            if straight { 1 } else { (total / (POINT_STEP_PX * self.px)).ceil().clamp(2.0, 4000.0) as usize };
        let mut k = 0;
        (0..=count)
            .map(|i| {
                let t = i as f64 / count as f64;
                let s = start + total * t;
                while k + 2 < arcs.len() && arcs[k + 1] < s {
                    k += 1;
                }
                let (a, b) = (guide.line[k], guide.line[k + 1]);
                let way = b - a;
                let long = arcs[k + 1] - arcs[k];
                let p = a + way * if long > 0.0 { (s - arcs[k]) / long } else { 0.0 };
                let across = if long > 0.0 { Vec2::new(-way.y, way.x) / long } else { Vec2::ZERO };
                let waver = self.tremor * value_noise(tremor, s / (TREMOR_WAVE_PX * self.px));
                let off = aside + turn * (s - start - total / 2.0) + bow * 4.0 * t * (1.0 - t) + waver;
                p + across * off
            })
            .collect()
    }

    /// A stroke through these points, lengthened or shortened at ends that were cut at a border. `None` if
    /// too little is left.
    fn ended(&self, mut points: Vec<Point>, cut: [bool; 2], stroke: HatchStroke) -> Option<HatchStroke> {
        let chance = |what: u64| unit_interval(hash(self.seed, &[stroke.id, what]));
        for (end, is_cut) in cut.into_iter().enumerate() {
            if is_cut {
                lengthen(
                    &mut points,
                    end == 1,
                    self.overrun - self.short - self.ragged * chance(5 + end as u64),
                );
            }
        }
        let is_long = points.len() >= 2
            && polyline_length(&points) >= self.least.max(tolerances::MIN_STROKE_LENGTH_UNITS);
        let pressure = 1.0 - self.pressure * chance(7);
        is_long.then_some(HatchStroke { points, pressure, ..stroke })
    }
}

/// A stroke of a guide without points.
const fn blank(guide: &Guide, cell: u32) -> HatchStroke {
    HatchStroke { points: Vec::new(), cell, pressure: 1.0, id: guide.id, rank: guide.rank }
}

/// Separate the random seeds of a guide's first stroke and of stroke ends.
const START_SEED: u64 = 0x5354_4152;
const ENDS_SEED: u64 = 0x454e_4453;

/// The parts of a span where its guide is wanted in spite of crowding.
fn uncrowded_spans(
    guide: &Guide,
    arcs: &[f64],
    points: &[Point],
    (start, end): (f64, f64),
    from: f64,
    to: f64,
    is_wanted: impl Fn(f64) -> bool,
) -> Vec<(f64, f64)> {
    if guide.crowding.is_empty() {
        return vec![(from, to)];
    }
    let count = (points.len() - 1) as f64;
    let crowding = |place: f64| {
        let s = start + (end - start) * place / count;
        let k = arcs.partition_point(|arc| *arc <= s).clamp(1, arcs.len() - 1) - 1;
        let long = arcs[k + 1] - arcs[k];
        let t = if long > 0.0 { ((s - arcs[k]) / long).clamp(0.0, 1.0) } else { 0.0 };
        guide.crowding[k] + (guide.crowding[k + 1] - guide.crowding[k]) * t
    };
    // Crowding changes slowly, so it is sampled at the points and crossings are bisected between them.
    let mut places = vec![from];
    places.extend((from.floor() as usize + 1..points.len()).map(|k| k as f64).take_while(|p| *p < to));
    places.push(to);
    let mut out: Vec<(f64, f64)> = Vec::new();
    for pair in places.windows(2) {
        let (mut a, mut b) = (pair[0], pair[1]);
        match (is_wanted(crowding(a)), is_wanted(crowding(b))) {
            (false, false) => continue,
            (true, true) => {}
            (starts, _) => {
                let (mut low, mut high) = (a, b);
                for _ in 0..CROWDING_BISECTIONS {
                    let middle = f64::midpoint(low, high);
                    if is_wanted(crowding(middle)) == starts { low = middle } else { high = middle }
                }
                if starts { b = low } else { a = high }
            }
        }
        match out.last_mut() {
            Some(last) if last.1 == a => last.1 = b,
            _ => out.push((a, b)),
        }
    }
    out
}

/// Bisections that find the end of a stroke in a crowd.
const CROWDING_BISECTIONS: usize = 12;

/// Extends an end of a polyline along its last direction, or shortens it.
fn lengthen(points: &mut Vec<Point>, at_end: bool, by: f64) {
    if by == 0.0 || points.len() < 2 {
        return;
    }
    if !at_end {
        points.reverse();
    }
    let n = points.len();
    if by > 0.0 {
        let last_segment = points[n - 1] - points[n - 2];
        let long = length(last_segment);
        if long > 0.0 {
            points[n - 1] += last_segment / long * by;
        }
    } else {
        let mut left = -by;
        while points.len() >= 2 {
            let n = points.len();
            let final_segment = points[n - 2] - points[n - 1];
            let long = length(final_segment);
            if long > left {
                points[n - 1] += final_segment / long * left;
                break;
            }
            left -= long;
            points.pop();
        }
    }
    if !at_end {
        points.reverse();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hatching::clip::line_clip::tests::two_squares;
    use crate::mesh::PartId;

    fn guide(rank: f64) -> Guide {
        Guide {
            line: vec![Point::new(-5.0, 4.0), Point::new(30.0, 4.0)],
            rank,
            id: 7,
            scope: GuideScope::Part(PartId(0)),
            crowding: Vec::new(),
        }
    }

    #[test]
    fn strokes_are_laid_where_the_tone_exceeds_the_guide_rank() {
        let hand = StrokeLayout { px: 1.0, ..StrokeLayout::default() };
        let ground = two_squares(false);
        let ends = |rank: f64| {
            let strokes = hand.lay(&guide(rank), &ground, &[0.0, 0.6, 0.3]);
            strokes.iter().map(|s| (s.points[0].x, s.points[s.points.len() - 1].x)).collect::<Vec<_>>()
        };
        assert_eq!(ends(0.1), [(0.0, 20.0)]);
        assert_eq!(ends(0.5), [(0.0, 10.0)]);
        assert_eq!(ends(0.7), []);
    }

    #[test]
    fn stroke_ends_fall_short_or_overrun_by_the_given_length() {
        let ground = two_squares(true);
        let hand = StrokeLayout { px: 1.0, overrun: 2.0, ..StrokeLayout::default() };
        let strokes = hand.lay(&guide(0.0), &ground, &[0.0, 1.0, 0.0]);
        assert_eq!((strokes[0].points[0].x, strokes[0].points[1].x), (-2.0, 12.0));
        let hand = StrokeLayout { px: 1.0, short: 1.0, ..StrokeLayout::default() };
        let strokes = hand.lay(&guide(0.0), &ground, &[0.0, 1.0, 0.0]);
        assert_eq!((strokes[0].points[0].x, strokes[0].points[1].x), (1.0, 9.0));
    }

    #[test]
    fn strokes_end_where_rank_times_crowding_exceeds_the_tone() {
        let ground = two_squares(false);
        let hand = StrokeLayout { px: 1.0, ..StrokeLayout::default() };
        let crowded = Guide { crowding: vec![1.0, 8.0], ..guide(0.2) };
        let strokes = hand.lay(&crowded, &ground, &[0.0, 0.6, 0.6]);
        // Wanted while 0.2 times the crowding is below 0.6. Crowding reaches 3 at two sevenths of the length.
        let end = strokes[0].points.last().expect("a point").x;
        assert!((end - (-5.0 + 35.0 * 2.0 / 7.0)).abs() < 0.05, "{end}");
    }
}
