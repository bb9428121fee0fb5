//! [`DimensionSet`]: the dimensions of all views: lengths, diameters and radii with their texts.
//!
//! Automatic dimensions are the overall size, the diameters of whole cylinders, and the positions of holes.
//! Each of them is shown in one view only.

use glam::DVec3;
use kurbo::{Point, Vec2};

use super::hole_dimensions::HoleDimension;
use crate::page::sheet::arrangement::titles_and_notes::edge_on_view;
use crate::page::sheet::arrangement::view_arrangement::ViewPlacement;
use crate::page::sheet::arrangement::view_plan::ViewPlan;
use crate::page::sheet::lengths::length_precision::{LengthPrecision, MeasuredPoint};
use crate::page::sheet::view::view_side::{SideLength, ViewSide};
use crate::page::tolerances::MIN_PARALLEL_COSINE;

/// Minimum distance of a dimensioned position from the side, on paper, mm; maximum number of positions per
/// side.
const MIN_OFFSET_MM: f64 = 0.05;
const MAX_POSITIONS_PER_SIDE: usize = 6;

/// A diameter or radius with a leader.
#[derive(Debug, Clone)]
pub(crate) struct DiameterLeader {
    pub centre: Point,
    /// Radius on paper, mm.
    pub radius: f64,
    pub text: String,
    /// Centre and radius of the pitch circle of several holes, page mm.
    pub pitch: Option<(Point, f64)>,
}

/// A length that is not in a row: in any direction, or at a given distance.
#[derive(Debug, Clone)]
pub(crate) struct SlantedLength {
    pub ends: [Point; 2],
    /// Unit vector of the length.
    pub along: Vec2,
    /// Distance of the dimension line from its points in mm, to the right or below if positive. Default: the
    /// first free place.
    pub offset: Option<f64>,
    pub text: String,
}

/// The dimensions of all views, each with the number of its view.
#[derive(Debug, Clone, Default)]
pub(crate) struct DimensionSet {
    pub lengths: Vec<(usize, SideLength)>,
    pub slanted: Vec<(usize, SlantedLength)>,
    pub diameters: Vec<(usize, DiameterLeader)>,
}

impl DimensionSet {
    /// Adds a length along a side of a view.
    pub(crate) fn add(&mut self, view: usize, ends: [Point; 2], side: ViewSide, text: String) {
        self.lengths.push((view, SideLength { ends, side, text }));
    }

    /// Adds the overall length, height and depth: below and to the left of the first side view, the third one
    /// in another side view.
    pub(crate) fn add_overall(&mut self, plan: &ViewPlan) {
        let points = MeasuredPoint::of_parts(&plan.sets[0].scene, |_| true);
        let mut measured_axes: Vec<DVec3> = Vec::new();
        let is_side = |k: &usize| matches!(plan.views[*k].placement, ViewPlacement::Projected(_));
        let mut sides: Vec<usize> = (0..plan.views.len()).filter(is_side).collect();
        // Views without section marks come first, because the marks take the space of dimensions.
        sides.sort_by_key(|k| plan.cuts.iter().any(|cut| edge_on_view(plan, cut) == Some(*k)));
        for view in sides {
            let sheet_view = &plan.views[view].sight;
            let [right, up, _] = sheet_view.axes();
            for (axis, side) in [(right, ViewSide::Below), (up, ViewSide::Left)] {
                if measured_axes
                    .iter()
                    .any(|measured_axis| measured_axis.dot(axis).abs() > MIN_PARALLEL_COSINE)
                {
                    continue;
                }
                measured_axes.push(axis);
                // From the outermost points, take those nearest to the dimension line.
                let key = |p: &MeasuredPoint| {
                    let page_point = sheet_view.to_page(p.at);
                    if side.is_across() {
                        (page_point.x, -page_point.y)
                    } else {
                        (page_point.y, page_point.x)
                    }
                };
                let by_start = |a: &MeasuredPoint, b: &MeasuredPoint| {
                    let ((a, c), (b, d)) = (key(a), key(b));
                    a.total_cmp(&b).then(c.total_cmp(&d))
                };
                let by_end = |a: &MeasuredPoint, b: &MeasuredPoint| {
                    let ((a, c), (b, d)) = (key(a), key(b));
                    a.total_cmp(&b).then(d.total_cmp(&c))
                };
                let ends = (points.iter().copied().min_by(by_start), points.iter().copied().max_by(by_end));
                if let (Some(from), Some(to)) = ends {
                    let length = (to.at - from.at).dot(axis).abs();
                    let text = plan.values.written(length, LengthPrecision::between([from, to], axis));
                    self.add(view, [from, to].map(|p| sheet_view.to_page(p.at)), side, text);
                }
            }
        }
    }

    /// Adds diameters, and the positions of holes from the left and lower edges of the view.
    pub(crate) fn add_rounds(&mut self, plan: &ViewPlan, rounds: &[HoleDimension]) {
        for round in rounds {
            let sight = &plan.views[round.view].sight;
            let count =
                if round.centres.len() > 1 { format!("{}× ", round.centres.len()) } else { String::new() };
            let pitch =
                round.pitch.map(|(middle, radius)| (sight.to_page(middle), radius * sight.mm_per_unit));
            let pitch_text = round.pitch.map_or_else(String::new, |(_, radius)| {
                format!(" / ⌀{}", plan.values.written(2.0 * radius, round.precision))
            });
            let text =
                format!("{count}⌀{}{pitch_text}", plan.values.written(2.0 * round.radius, round.precision));
            let centres: Vec<Point> = round.centres.iter().map(|at| sight.to_page(*at)).collect();
            // The leader belongs to the circle nearest to the upper right corner.
            let upper_right_score = |p: &Point| p.x - p.y;
            let Some(centre) =
                centres.iter().copied().max_by(|a, b| upper_right_score(a).total_cmp(&upper_right_score(b)))
            else {
                continue;
            };
            let radius = round.radius * sight.mm_per_unit;
            self.diameters.push((round.view, DiameterLeader { centre, radius, text, pitch }));
        }
        let mut views: Vec<usize> = rounds.iter().map(|round| round.view).collect();
        views.dedup();
        let step = if views.is_empty() { 0.0 } else { MeasuredPoint::coarsest(&plan.sets[0].scene) };
        for view in views {
            let sight = &plan.views[view].sight;
            let rect = sight.rect();
            let dimensions_in_view: Vec<&HoleDimension> =
                rounds.iter().filter(|round| round.view == view).collect();
            // Positions of holes, except holes that are concentric with something round, which is positioned
            // already.
            let solid_centres: Vec<Point> = dimensions_in_view
                .iter()
                .filter(|round| !round.is_hole)
                .flat_map(|round| round.centres.iter().map(|at| sight.to_page(*at)))
                .collect();
            let hole_centres: Vec<(DVec3, LengthPrecision)> = dimensions_in_view
                .iter()
                .filter(|round| round.is_hole && round.pitch.is_none())
                .flat_map(|round| round.centres.iter().map(|at| (*at, round.precision)))
                .filter(|(at, _)| {
                    solid_centres.iter().all(|solid_centre| {
                        (*solid_centre - sight.to_page(*at)).hypot2() > MIN_OFFSET_MM * MIN_OFFSET_MM
                    })
                })
                .collect();
            let [right, up, _] = sight.axes();
            let corner = plan.middle + right * sight.low.x + up * sight.low.y;
            for (side, axis) in [(ViewSide::Below, right), (ViewSide::Left, up)] {
                let mut written_texts: Vec<String> = Vec::new();
                let mut sorted = hole_centres.clone();
                // Of several holes in line, the nearest to the side comes first.
                sorted.sort_by(|(a, _), (b, _)| {
                    let sort_key = |p: &DVec3| (p.dot(axis), p.dot(right + up - axis));
                    let ((a, c), (b, d)) = (sort_key(a), sort_key(b));
                    a.total_cmp(&b).then(c.total_cmp(&d))
                });
                for (at, precision) in sorted {
                    let distance = (at - corner).dot(axis);
                    let ends = [MeasuredPoint { at: corner, step }, MeasuredPoint::exact(at)];
                    let text = plan
                        .values
                        .written(distance, LengthPrecision::between(ends, axis).coarser(precision));
                    if distance * sight.mm_per_unit < MIN_OFFSET_MM
                        || written_texts.len() >= MAX_POSITIONS_PER_SIDE
                        || written_texts.contains(&text)
                    {
                        continue;
                    }
                    written_texts.push(text.clone());
                    let from = Point::new(rect.x0, rect.y1);
                    self.add(view, [from, sight.to_page(at)], side, text);
                }
            }
        }
    }
}
