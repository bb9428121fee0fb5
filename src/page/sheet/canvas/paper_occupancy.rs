//! [`Occupancy`]: the paper that is occupied by drawn shapes.
//!
//! Every shape is convex with a margin: a disc is a point, a line is a segment, a text is a box. Long lines
//! are cut into pieces. A grid of square cells lists the shapes in each cell, so a query tests only shapes
//! nearby.
//!
//! The distance of two shapes is the smallest distance between their sides. A shape inside another one
//! touches it.
//!
//! Each shape has a [`OccupantKind`]. Texts and balloons need free paper. Lines may cross lines, but no
//! texts, arrows or balloons.

use kurbo::{Point, Rect, Vec2};
use rustc_hash::FxHashMap;

use crate::geometry::plane::planar_distance::segment_distance_squared;
use crate::page::sheet::part_balloons::leader_assignment::segments_meet;

/// Side of a grid cell, mm.
const CELL_SIDE_MM: f64 = 5.0;

/// Kind of a shape that occupies paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum OccupantKind {
    /// Lines and areas of a view: edges, hatching, centre lines.
    Geometry,
    /// Annotation lines: dimension lines, section lines, circles of details.
    Line,
    /// Leaders of texts and balloons.
    Leader,
    /// Arrow heads.
    Arrow,
    /// Texts and balloons; nothing may touch them.
    Solid,
}

/// The kinds that a new shape must not touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Clearance {
    /// All kinds; for texts, arrows and balloons.
    All,
    /// Texts, balloons and arrow heads; for lines.
    Solids,
    /// Texts and balloons; for lines without another place.
    Texts,
    /// Texts, balloons, arrow heads and leaders; for leaders.
    Leaders,
}

/// A convex shape on the page with a margin around it, mm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ConvexShape {
    corners: [Point; 4],
    count: usize,
    margin: f64,
}

impl ConvexShape {
    /// A disc.
    pub(crate) fn disc(centre: Point, radius: f64) -> Self {
        Self { corners: [centre; 4], count: 1, margin: radius }
    }

    /// A line with a width.
    pub(crate) fn line(a: Point, b: Point, width: f64) -> Self {
        Self { corners: [a, b, b, b], count: 2, margin: width / 2.0 }
    }

    /// An axis-parallel rectangle.
    #[cfg(test)]
    fn rect(rect: Rect) -> Self {
        Self::turned(rect.center(), Vec2::new(rect.width() / 2.0, 0.0), Vec2::new(0.0, rect.height() / 2.0))
    }

    /// A rectangle around a point; `along` and `across` lead to the middles of two sides.
    pub(crate) fn turned(middle: Point, along: Vec2, across: Vec2) -> Self {
        let corners = [-along - across, along - across, along + across, across - along].map(|v| middle + v);
        Self { corners, count: 4, margin: 0.0 }
    }

    /// A triangle.
    pub(crate) fn triangle([a, b, c]: [Point; 3]) -> Self {
        Self { corners: [a, b, c, c], count: 3, margin: 0.0 }
    }

    /// The same shape with a wider margin.
    pub(crate) fn wider(self, by: f64) -> Self {
        Self { margin: self.margin + by, ..self }
    }

    /// Bounding box, including the margin.
    pub(crate) fn bounds(&self) -> Rect {
        let corners = &self.corners[..self.count];
        let first = Rect::from_points(corners[0], corners[0]);
        corners.iter().fold(first, |rect, p| rect.union_pt(*p)).inflate(self.margin, self.margin)
    }

    fn sides(&self) -> impl Iterator<Item = [Point; 2]> + '_ {
        let count = if self.count > 2 { self.count } else { 1 };
        (0..count).map(|k| [self.corners[k], self.corners[(k + 1) % self.count]])
    }

    fn holds(&self, p: Point) -> bool {
        let turn = |[a, b]: [Point; 2]| (b - a).cross(p - a);
        self.count > 2
            && (self.sides().all(|side| turn(side) >= 0.0) || self.sides().all(|side| turn(side) <= 0.0))
    }

    /// Whether two shapes are closer than their margins, or one contains the other.
    pub(crate) fn touches(&self, other: &Self) -> bool {
        let near = self.margin + other.margin;
        self.holds(other.corners[0])
            || other.holds(self.corners[0])
            || self
                .sides()
                .any(|a| other.sides().any(|b| segments_cross(a, b) || squared_distance(a, b) < near * near))
    }
}

/// Whether two segments cross. A degenerate segment crosses nothing.
fn segments_cross(one: [Point; 2], other: [Point; 2]) -> bool {
    one[0] != one[1] && other[0] != other[1] && segments_meet(one, other)
}

/// Squared distance of two segments that do not cross.
fn squared_distance(one: [Point; 2], other: [Point; 2]) -> f64 {
    let from = |p: Point, [a, b]: [Point; 2]| segment_distance_squared(p, a, b);
    let ends = [from(one[0], other), from(one[1], other), from(other[0], one), from(other[1], one)];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}

/// Shapes in a grid of square cells.
#[derive(Debug, Clone, Default)]
struct ShapeGrid {
    shapes: Vec<(ConvexShape, Rect, OccupantKind)>,
    cells: FxHashMap<[i32; 2], Vec<u32>>,
}

impl ShapeGrid {
    fn add(&mut self, shape: ConvexShape, kind: OccupantKind) {
        let bounds = shape.bounds();
        if !bounds.is_finite() {
            return;
        }
        let number = self.shapes.len() as u32;
        self.shapes.push((shape, bounds, kind));
        for cell in grid_cells(bounds) {
            self.cells.entry(cell).or_default().push(number);
        }
    }

    fn any(&self, shape: &ConvexShape, matters: impl Fn(OccupantKind) -> bool) -> bool {
        let bounds = shape.bounds();
        for cell in grid_cells(bounds) {
            for number in self.cells.get(&cell).into_iter().flatten() {
                let (other, its, kind) = &self.shapes[*number as usize];
                if matters(*kind) && its.overlaps(bounds) && other.touches(shape) {
                    return true;
                }
            }
        }
        false
    }
}

/// The occupied paper of a view.
#[derive(Debug, Clone, Default)]
pub(crate) struct Occupancy {
    /// Lines of the view itself. They are many, and only texts must avoid them.
    geometry: ShapeGrid,
    /// Annotations.
    written: ShapeGrid,
}

impl Occupancy {
    /// Marks the paper of a shape as occupied.
    pub(crate) fn take(&mut self, shape: ConvexShape, kind: OccupantKind) {
        let own = if kind == OccupantKind::Geometry { &mut self.geometry } else { &mut self.written };
        for piece in split_line(shape) {
            own.add(piece, kind);
        }
    }

    /// Whether a shape touches none of the kinds that `clear` excludes.
    pub(crate) fn is_free(&self, shape: &ConvexShape, clear: Clearance) -> bool {
        let matters = |kind: OccupantKind| match clear {
            Clearance::All => true,
            Clearance::Solids => matches!(kind, OccupantKind::Solid | OccupantKind::Arrow),
            Clearance::Texts => kind == OccupantKind::Solid,
            Clearance::Leaders => {
                matches!(kind, OccupantKind::Solid | OccupantKind::Arrow | OccupantKind::Leader)
            }
        };
        !split_line(*shape).any(|piece| {
            self.written.any(&piece, matters) || clear == Clearance::All && self.geometry.any(&piece, matters)
        })
    }
}

/// A line cut into pieces that touch few cells; other shapes unchanged.
fn split_line(shape: ConvexShape) -> impl Iterator<Item = ConvexShape> {
    let [a, b] = [shape.corners[0], shape.corners[1]];
    let count = if shape.count == 2 {
        ((b - a).hypot2().sqrt() / (2.0 * CELL_SIDE_MM)).ceil().clamp(1.0, 1000.0) as u32
    } else {
        1
    };
    (0..count).map(move |k| {
        let at = |k: u32| a.lerp(b, f64::from(k) / f64::from(count));
        if count == 1 { shape } else { ConvexShape::line(at(k), at(k + 1), 2.0 * shape.margin) }
    })
}

/// The grid cells that a box touches.
fn grid_cells(bounds: Rect) -> impl Iterator<Item = [i32; 2]> {
    const MAX_COORDINATE_MM: f64 = 1e4;
    let cell = |x: f64| (x.clamp(-MAX_COORDINATE_MM, MAX_COORDINATE_MM) / CELL_SIDE_MM).floor() as i32;
    let (columns, rows) = (cell(bounds.x0)..=cell(bounds.x1), cell(bounds.y0)..=cell(bounds.y1));
    rows.flat_map(move |y| columns.clone().map(move |x| [x, y]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn convex_shapes_touch_within_their_margins() {
        let p = Point::new;
        let text = ConvexShape::rect(Rect::new(0.0, 0.0, 10.0, 4.0));
        for (shape, touches) in [
            (ConvexShape::line(p(-5.0, 2.0), p(15.0, 2.0), 0.25), true),
            (ConvexShape::line(p(4.0, 2.0), p(6.0, 2.0), 0.25), true),
            (ConvexShape::line(p(-5.0, 5.0), p(15.0, 5.0), 0.25), false),
            (ConvexShape::line(p(-5.0, 5.0), p(15.0, 5.0), 0.25).wider(1.0), true),
            (ConvexShape::disc(p(5.0, 2.0), 0.1), true),
            (ConvexShape::disc(p(13.0, 8.0), 4.9), false),
            (ConvexShape::disc(p(13.0, 8.0), 5.1), true),
            (ConvexShape::triangle([p(12.0, -4.0), p(12.0, 8.0), p(11.0, 2.0)]), false),
            (ConvexShape::triangle([p(12.0, -4.0), p(12.0, 8.0), p(9.0, 2.0)]), true),
            (ConvexShape::rect(Rect::new(-9.0, -9.0, 30.0, 30.0)), true),
        ] {
            let mut taken = Occupancy::default();
            taken.take(shape, OccupantKind::Line);
            assert_eq!(text.touches(&shape), touches, "{shape:?}");
            assert_eq!(shape.touches(&text), touches, "{shape:?}");
            assert_eq!(!taken.is_free(&text, Clearance::All), touches, "{shape:?}");
            assert!(taken.is_free(&text, Clearance::Solids));
        }
    }

    #[test]
    fn long_lines_occupy_their_whole_length() {
        let mut taken = Occupancy::default();
        taken.take(
            ConvexShape::line(Point::new(-500.0, -250.0), Point::new(500.0, 250.0), 0.5),
            OccupantKind::Leader,
        );
        for k in -49..50 {
            let at = Point::new(10.0 * f64::from(k), 5.0 * f64::from(k));
            assert!(!taken.is_free(&ConvexShape::disc(at, 0.1), Clearance::Leaders), "{k}");
            assert!(
                taken.is_free(&ConvexShape::disc(at + Vec2::new(0.0, 2.0), 1.0), Clearance::Leaders),
                "{k}"
            );
        }
    }
}
