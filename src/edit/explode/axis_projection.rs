//! [`AxisProjection`]: body projected along an axis, as triangles in the plane with heights.
//!
//! Blocking is computed from pairs of triangles, one of each body:
//!
//! 1. Two triangles intersect in a convex polygon in the plane, or not at all.
//! 2. An upward face of one body blocks upward movement where a downward face of the other is above it, and
//!    vice versa. The height difference is linear over the polygon, so the blocked part is a polygon again.
//! 3. The areas of these polygons are added. A part that already passes through the other body does not
//!    block.
//! 4. If bodies interpenetrate along the axis and the other one protrudes on one side only, it blocks
//!    movement to that side. Example: a thread across its axis. A body that protrudes on both sides, like the
//!    ground around a bolt, does not block.

use glam::{DVec2, DVec3};
use kurbo::Point;

use super::bodies::Body;
use super::polygon_overlap::{area, common, cut};
use crate::edit::tolerances::{ANGLE_ROUNDING_RAD, MAX_UPRIGHT_AREA_RATIO};
use crate::geometry::numbers::portable_math::atan2;
use crate::geometry::numbers::ranges::joined;
use crate::geometry::plane::convex_hull::convex_hull;
use crate::geometry::space::bounds::Bounds;
use crate::geometry::space::bounds_tree::BoundsTree;
use crate::geometry::space::triangles::area_vector;

/// Maximum overlap, as a share of the smaller projected area, that counts as grazing. Facets of a shaft and
/// its bore graze each other.
const MAX_GRAZE_AREA_RATIO: f64 = 0.02;

/// Body projected along an axis.
#[derive(Debug, Clone)]
pub(crate) struct AxisProjection {
    triangles: Vec<ProjectedTriangle>,
    tree: BoundsTree,
    /// Bounding box, with the heights along z.
    pub(crate) bounds: Bounds,
    /// Projected area of the upper or lower side. Overlapping surfaces count several times.
    pub area: f64,
}

/// Projected triangle, counter-clockwise.
#[derive(Debug, Clone, Copy)]
struct ProjectedTriangle {
    at: [DVec2; 3],
    height: [f64; 3],
    /// Twice the area.
    area: f64,
    /// Whether the face is directed up or down the axis. Faces of open surfaces count as both.
    is_up: bool,
    is_down: bool,
}

/// Contact of two bodies along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct PairContact {
    /// Whether the projections overlap.
    pub meets: bool,
    /// Whether the other body blocks upward movement of the first.
    pub blocks_up: bool,
    /// Whether the other body blocks downward movement of the first.
    pub blocks_down: bool,
    /// Whether one projection surrounds the other without overlapping it.
    pub is_within: bool,
}

impl PairContact {
    /// The contact as seen from the other body.
    pub(crate) fn turned(self) -> Self {
        Self { blocks_up: self.blocks_down, blocks_down: self.blocks_up, ..self }
    }

    /// Union of two contacts.
    pub(crate) fn or(self, other: Self) -> Self {
        Self {
            meets: self.meets | other.meets,
            blocks_up: self.blocks_up | other.blocks_up,
            blocks_down: self.blocks_down | other.blocks_down,
            is_within: self.is_within | other.is_within,
        }
    }
}

impl AxisProjection {
    /// Projects a body along the third vector of a right-handed orthonormal basis.
    pub(crate) fn new(body: &Body, axes: &[DVec3; 3]) -> Self {
        let (triangles, tree) = (Vec::new(), BoundsTree::default());
        let mut shadow = Self { triangles, tree, bounds: Bounds::EMPTY, area: 0.0 };
        let mut boxes = Vec::new();
        for corners in &body.triangles {
            let placed = corners.map(|p| axes.map(|axis| p.dot(axis)));
            let mut at = placed.map(|[x, y, _]| DVec2::new(x, y));
            let mut height = placed.map(|[.., z]| z);
            let own = Bounds::of(placed.map(DVec3::from_array));
            shadow.bounds = shadow.bounds.union(own);
            let area = (at[1] - at[0]).perp_dot(at[2] - at[0]);
            let whole = area_vector(*corners).length();
            if area.abs() <= MAX_UPRIGHT_AREA_RATIO * whole {
                continue;
            }
            let looks_up = area > 0.0;
            if !looks_up {
                at.swap(1, 2);
                height.swap(1, 2);
            }
            let (is_up, is_down) = (looks_up || body.is_open, !looks_up || body.is_open);
            shadow.triangles.push(ProjectedTriangle { at, height, area: area.abs(), is_up, is_down });
            shadow.area += area.abs() / 4.0;
            boxes.push(own);
        }
        shadow.tree = BoundsTree::new(&boxes);
        shadow
    }

    /// Contact with another body. Surfaces within `touch` of each other touch.
    pub(crate) fn contact_with(&self, other: &Self, touch: f64) -> PairContact {
        if !column(&self.bounds).meets(&other.bounds) {
            return PairContact::default();
        }
        let graze = MAX_GRAZE_AREA_RATIO * self.area.min(other.area);
        if self.triangles.len() > other.triangles.len() {
            return other.blocked_areas(self, touch, graze).turned();
        }
        self.blocked_areas(other, touch, graze)
    }

    fn blocked_areas(&self, other: &Self, touch: f64, graze: f64) -> PairContact {
        let (mut both, mut above, mut below) = (0.0, 0.0, 0.0);
        // A body completely above the other does not block it downward, and vice versa.
        let [may_be_above, may_be_below] = [
            other.bounds.high.z > self.bounds.low.z + touch,
            other.bounds.low.z < self.bounds.high.z - touch,
        ];
        let is_open = |both: f64, above: f64, below: f64| {
            both <= graze || may_be_above && above <= graze || may_be_below && below <= graze
        };
        'all: for own in &self.triangles {
            let own_column = column(&Bounds::of(own.at.map(|p| p.extend(0.0))));
            for number in other.tree.near(|around| around.meets(&own_column)) {
                let its = &other.triangles[number as usize];
                let counts = own.is_up && its.is_up;
                let up = own.is_up && its.is_down && may_be_above && above <= graze;
                let down = own.is_down && its.is_up && may_be_below && below <= graze;
                if !(counts || up || down) {
                    continue;
                }
                let common = common(&own.at, &its.at);
                if common.len() < 3 {
                    continue;
                }
                // Height difference at a point of the common polygon.
                let gap = |p: &DVec2| its.height_at(*p) - own.height_at(*p);
                if up {
                    above += area(&cut(&common, |p| gap(p) + touch));
                }
                if down {
                    below += area(&cut(&common, |p| touch - gap(p)));
                }
                if counts {
                    both += area(&common);
                    if may_be_above && above <= graze {
                        above += self.protruding_area([own, its], other, &cut(&common, |p| gap(p) - touch));
                    }
                    if may_be_below && below <= graze {
                        below += other.protruding_area([its, own], self, &cut(&common, |p| -touch - gap(p)));
                    }
                }
                if !is_open(both, above, below) {
                    break 'all;
                }
            }
        }
        let meets = both > graze;
        let is_within = !meets && (self.lies_within(other) || other.lies_within(self));
        let blocks_up = meets && may_be_above && above > graze;
        let blocks_down = meets && may_be_below && below > graze;
        PairContact { meets, blocks_up, blocks_down, is_within }
    }

    /// Area of a polygon if the other body begins inside this one there and ends above it. `tops` are the
    /// upper faces of both. It is 0 if a body is open.
    fn protruding_area(&self, tops: [&ProjectedTriangle; 2], other: &Self, polygon: &[DVec2]) -> f64 {
        if polygon.len() < 3 || tops.iter().any(|top| top.is_down) {
            return 0.0;
        }
        let middle = polygon.iter().sum::<DVec2>() / polygon.len() as f64;
        let [own_top, its_top] = tops.map(|top| top.height_at(middle));
        let (own_floor, its_floor) = (self.floor(middle, own_top), other.floor(middle, its_top));
        let begins_inside = own_floor.zip(its_floor).is_some_and(|(own, its)| own < its && its < own_top);
        if begins_inside { area(polygon) } else { 0.0 }
    }

    /// Highest downward face below `top` at a point.
    fn floor(&self, point: DVec2, top: f64) -> Option<f64> {
        let mut floor = None;
        let column = column(&Bounds::of([point.extend(0.0)]));
        for number in self.tree.near(|around| around.meets(&column)) {
            let triangle = &self.triangles[number as usize];
            if triangle.is_down && triangle.holds(point) {
                let height = triangle.height_at(point);
                if height < top && floor.is_none_or(|known| height > known) {
                    floor = Some(height);
                }
            }
        }
        floor
    }

    /// Whether the other projection surrounds this one: no corner of the convex hull has a free straight path
    /// outward.
    fn lies_within(&self, other: &Self) -> bool {
        if self.triangles.is_empty() || !column(&other.bounds).contains(&self.bounds) {
            return false;
        }
        let corners = self.triangles.iter().flat_map(|t| t.at).map(|p| Point::new(p.x, p.y)).collect();
        convex_hull(corners).iter().all(|p| other.surrounds(DVec2::new(p.x, p.y)))
    }

    /// Whether the triangles cover all directions around a point.
    fn surrounds(&self, point: DVec2) -> bool {
        let full = std::f64::consts::TAU;
        let mut covered: Vec<(f64, f64)> = Vec::new();
        for triangle in &self.triangles {
            if triangle.holds(point) {
                return true;
            }
            let corner_offsets = triangle.at.map(|p| p - point);
            // A triangle covers less than half a turn, counted from the corner with all others to its left.
            let angle = |direction: DVec2| atan2(direction.y, direction.x);
            let first = (0..3).find(|k| {
                corner_offsets.iter().all(|direction| corner_offsets[*k].perp_dot(*direction) >= 0.0)
            });
            let Some(first) = first else { continue };
            let from = angle(corner_offsets[first]);
            let wide = |direction: DVec2| (angle(direction) - from).rem_euclid(full);
            let widest = corner_offsets.map(wide).into_iter().filter(|w| *w < full / 2.0).fold(0.0, f64::max);
            covered.extend([(from, from + widest), (from + full, from + full + widest)]);
        }
        let covered = joined(covered, ANGLE_ROUNDING_RAD);
        matches!(covered[..], [(from, to)] if to >= from + full - ANGLE_ROUNDING_RAD)
    }
}

/// The box without limits along the axis.
fn column(around: &Bounds) -> Bounds {
    Bounds { low: around.low.with_z(f64::NEG_INFINITY), high: around.high.with_z(f64::INFINITY) }
}

impl ProjectedTriangle {
    /// Whether a point lies in the triangle.
    fn holds(&self, point: DVec2) -> bool {
        (0..3).all(|k| (self.at[k] - point).perp_dot(self.at[(k + 1) % 3] - point) >= 0.0)
    }

    /// Height of the triangle at a point inside it.
    fn height_at(&self, p: DVec2) -> f64 {
        let [a, b, c] = self.at;
        let weights = [(b, c), (c, a), (a, b)].map(|(p0, p1)| (p0 - p).perp_dot(p1 - p) / self.area);
        let [low, high] = [
            self.height.iter().copied().fold(f64::INFINITY, f64::min),
            self.height.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ];
        weights.iter().zip(self.height).map(|(weight, height)| weight * height).sum::<f64>().clamp(low, high)
    }
}

#[cfg(test)]
mod tests;
