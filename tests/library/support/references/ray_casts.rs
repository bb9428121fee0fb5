//! Reference for visibility: rays from the camera through every triangle of an image cell, in `f64`.

use kurbo::{Point, Vec2};

use super::textbook_camera::TextbookCamera;
use super::triangle_scene::TriangleScene;

/// Side of an image cell, px.
const CELL_PX: f64 = 8.0;
/// Surfaces closer than this share of the scene's size touch, and hide nothing from each other.
const CONTACT_SHARE: f64 = 1e-6;

/// Result of a ray: the occluder in front of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Occluder {
    Nothing,
    /// A surface that touches the point.
    Contact,
    Surface,
}

/// A projected triangle: signed distances to its sides, and nearness as a linear function of the image.
struct ProjectedTriangle {
    sides: [[f64; 3]; 3],
    nearness: [f64; 3],
    range: [f64; 2],
    face: u32,
}

/// Projected triangles of a scene, sorted into image cells.
pub(crate) struct RayCaster<'a> {
    pub polygons: &'a TriangleScene,
    pub camera: &'a TextbookCamera,
    triangles: Vec<ProjectedTriangle>,
    cells: Vec<Vec<u32>>,
    columns: usize,
    rows: usize,
}

impl<'a> RayCaster<'a> {
    /// Projects all triangles into a frame of `width` x `height` px.
    pub(crate) fn new(polygons: &'a TriangleScene, eye: &'a TextbookCamera, width: f64, height: f64) -> Self {
        let (columns, rows) = ((width / CELL_PX).ceil() as usize + 1, (height / CELL_PX).ceil() as usize + 1);
        let cells = vec![Vec::new(); columns * rows];
        let mut rays = Self { polygons, camera: eye, triangles: Vec::new(), cells, columns, rows };
        (0..polygons.faces.len())
            .filter(|face| !polygons.is_degenerate(*face))
            .for_each(|face| rays.add(face));
        rays
    }

    fn add(&mut self, face: usize) {
        let mut corners = self.polygons.corners(face).map(|p| project_point(self.camera, p));
        let area = doubled_area(corners[0].0, corners[1].0, corners[2].0);
        let longest =
            (0..3).map(|k| (corners[k].0 - corners[(k + 1) % 3].0).hypot2()).fold(0.0, f64::max).sqrt();
        if area.abs() <= 1e-8 * longest {
            return; // edge-on
        }
        if area < 0.0 {
            corners.swap(1, 2);
        }
        let [a, b, c] = corners;
        let sides = [(a, b), (b, c), (c, a)].map(|(p, q)| {
            let way = (q.0 - p.0) / (q.0 - p.0).hypot2().sqrt();
            let [x, y] = [-way.y, way.x];
            [x, y, -(x * p.0.x + y * p.0.y)]
        });
        let (u, v) = (b.0 - a.0, c.0 - a.0);
        let (rise_u, rise_v) = (b.1 - a.1, c.1 - a.1);
        let x = (rise_u * v.y - rise_v * u.y) / area.abs();
        let y = (rise_v * u.x - rise_u * v.x) / area.abs();
        let nearness = [x, y, a.1 - x * a.0.x - y * a.0.y];
        let range = [a.1.min(b.1).min(c.1), a.1.max(b.1).max(c.1)];
        let id = self.triangles.len() as u32;
        let cell = |value: f64, most: usize| ((value / CELL_PX).floor().max(0.0) as usize).min(most - 1);
        let low = |f: fn(&Point) -> f64| corners.iter().map(|p| f(&p.0)).fold(f64::INFINITY, f64::min) - 1e-6;
        let high =
            |f: fn(&Point) -> f64| corners.iter().map(|p| f(&p.0)).fold(f64::NEG_INFINITY, f64::max) + 1e-6;
        let x_of = |p: &Point| p.x;
        let y_of = |p: &Point| p.y;
        for row in cell(low(y_of), self.rows)..=cell(high(y_of), self.rows) {
            for column in cell(low(x_of), self.columns)..=cell(high(x_of), self.columns) {
                let (x, y) = ((column as f64 + 0.5) * CELL_PX, (row as f64 + 0.5) * CELL_PX);
                let reaches = |s: &[f64; 3]| {
                    s[0] * x + s[1] * y + s[2] >= -(s[0].abs() + s[1].abs()) * CELL_PX / 2.0 - 1e-6
                };
                if sides.iter().all(reaches) {
                    self.cells[row * self.columns + column].push(id);
                }
            }
        }
        self.triangles.push(ProjectedTriangle { sides, nearness, range, face: face as u32 });
    }

    /// The occluder in front of an image point at a given nearness.
    ///
    /// `touching` returns the depth distance within which a face does not hide the point, or `None` to skip
    /// the face.
    pub(crate) fn occluder_at(
        &self,
        at: Point,
        nearness: f64,
        touching: impl Fn(u32) -> Option<f64>,
    ) -> Occluder {
        let depth = self.depth(nearness);
        let contact = CONTACT_SHARE * self.polygons.size;
        let mut found = Occluder::Nothing;
        for seen in self.triangles_at(at) {
            let hit = seen.nearness[0] * at.x + seen.nearness[1] * at.y + seen.nearness[2];
            let lead = depth - self.depth(hit.clamp(seen.range[0], seen.range[1]));
            if lead <= -contact {
                continue;
            }
            match touching(seen.face) {
                None => {}
                Some(limit) if lead > limit => return Occluder::Surface,
                Some(_) => found = Occluder::Contact,
            }
        }
        found
    }

    /// The nearness of the nearest wanted face at an image point.
    pub(crate) fn nearest(&self, at: Point, wanted: impl Fn(u32) -> bool) -> Option<f64> {
        let seen = self.triangles_at(at).filter(|seen| wanted(seen.face));
        let hits = seen.map(|seen| seen.nearness[0] * at.x + seen.nearness[1] * at.y + seen.nearness[2]);
        hits.max_by(f64::total_cmp)
    }

    /// Whether an image point shows background.
    pub(crate) fn is_background(&self, at: Point) -> bool {
        self.triangles_at(at).next().is_none()
    }

    /// The depth distance within which surfaces touch, world units.
    pub(crate) fn contact_distance(&self) -> f64 {
        CONTACT_SHARE * self.polygons.size
    }

    fn triangles_at(&self, at: Point) -> impl Iterator<Item = &ProjectedTriangle> + '_ {
        let (column, row) = ((at.x / CELL_PX).floor(), (at.y / CELL_PX).floor());
        let inside =
            column >= 0.0 && row >= 0.0 && (column as usize) < self.columns && (row as usize) < self.rows;
        let cell = if inside { &self.cells[row as usize * self.columns + column as usize][..] } else { &[] };
        let covers = move |s: &[f64; 3]| s[0] * at.x + s[1] * at.y + s[2] >= -1e-7;
        cell.iter().map(|id| &self.triangles[*id as usize]).filter(move |seen| seen.sides.iter().all(covers))
    }

    fn depth(&self, nearness: f64) -> f64 {
        if self.camera.perspective { 1.0 / nearness } else { -nearness }
    }
}

/// The image position of a point, and its nearness: a number that is linear along straight image lines.
pub(crate) fn project_point(eye: &TextbookCamera, p: glam::DVec3) -> (Point, f64) {
    let depth = eye.depth(p);
    (eye.project(p), if eye.perspective { 1.0 / depth } else { -depth })
}

/// Eight points on a circle around a point.
pub(crate) fn circle_points(at: Point, radius: f64) -> impl Iterator<Item = Point> {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let ways = [
        (1.0, 0.0),
        (half, half),
        (0.0, 1.0),
        (-half, half),
        (-1.0, 0.0),
        (-half, -half),
        (0.0, -1.0),
        (half, -half),
    ];
    ways.into_iter().map(move |(x, y)| at + Vec2::new(x, y) * radius)
}

fn doubled_area(a: Point, b: Point, c: Point) -> f64 {
    (b - a).cross(c - a)
}
