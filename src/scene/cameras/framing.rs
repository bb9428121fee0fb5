//! Framing: moves a camera along its view direction and sideways until a model fills its frame.
//!
//! Let `e` be the eye and `p` a point in camera axes (x right, y up, z forward), and `t` the tangent of half
//! the horizontal field of view. The point is left of the frame's right side if `p.x - e.x <= t (p.z - e.z)`.
//! Each side of the frame is therefore a plane, and its position is a maximum over all points: `max(p.x - t
//! p.z)`. Two opposite planes give the nearest eye that sees everything. The result is exact, because it uses
//! the vertices and not their bounding box.

use crate::geometry::space::bounds::Bounds;
use crate::parallel::prelude::*;
use glam::DVec3;

use crate::error::Error;
use crate::error::nearest::nearest;
use crate::geometry::names::glob::glob_matches;
use crate::geometry::numbers::portable_math::tan;
use crate::scene::extent::coordinate_limits::bounds;
use crate::scene::extent::drawn_points::DrawnPoints;
use crate::scene::tolerances;
use crate::scene::{Camera, Projection, Scene};

/// Margin on each side of a fitted model, as a fraction of the frame's shorter side.
pub(crate) const FRAME_MARGIN: f64 = 0.05;

/// Minimum distance of a perspective eye in front of the model, as a fraction of the model's diagonal.
/// Matters only for models that are thin in the view direction, such as a rod seen end-on.
const MIN_EYE_DISTANCE_OF_DIAGONAL: f64 = 0.02;

/// Points per parallel task.
const POINTS_PER_TASK: usize = 1 << 14;

/// Points per bounding box.
const POINTS_PER_BOX: usize = 1 << 8;

/// Maximum Newton steps of the centring. Each step but the last passes a vertex of a convex polyline; three
/// or four are usual.
const MAX_CENTRING_STEPS: usize = 32;

impl Camera {
    /// Moves the camera along its view direction so that the whole scene fills the frame, centred, with a
    /// margin of [`FRAME_MARGIN`] on the tight sides.
    ///
    /// A scene without drawable content leaves the camera unchanged.
    #[must_use]
    pub fn fit(self, scene: &Scene) -> Self {
        self.fit_points(&world_points(scene), FRAME_MARGIN)
    }

    /// Moves the camera along its view direction so that the parts with matching names fill the frame. Other
    /// parts are drawn as well. `*` in the pattern matches any characters, `?` any one.
    ///
    /// ```
    /// let scene = ligne::Scene::open("examples/models/pump.glb")?;
    /// let camera = ligne::Camera::three_quarter_of(scene.up).fit_parts(&scene, "motor*")?;
    /// assert!(camera.fit_parts(&scene, "moter").unwrap_err().to_string().contains("no part"));
    /// # Ok::<(), ligne::Error>(())
    /// ```
    ///
    /// # Errors
    /// If no drawn part has a matching name.
    pub fn fit_parts(self, scene: &Scene, pattern: &str) -> Result<Self, Error> {
        let points = DrawnPoints::of_parts(scene, |part| glob_matches(pattern, &part.name)).points;
        if !points.is_empty() {
            return Ok(self.fit_points(&points, FRAME_MARGIN));
        }
        let names: Vec<&str> = scene.parts.iter().map(|part| part.name.as_str()).collect();
        let near = nearest(pattern, &names).map(|near| format!("did you mean `{near}`?"));
        let remedy = near.unwrap_or_else(|| "look up the names in `scene.parts`".to_owned());
        Err(Error::new(format!("there is no part `{pattern}`")).remedy(remedy))
    }

    /// Moves the camera along its view direction so that all `points` (world) are in the frame, centred.
    ///
    /// `margin` is a fraction of the frame's shorter side, 0 to below 0.5, and applies to the tight sides. A
    /// parallel view changes its height, a perspective view its distance. Points that are not finite are
    /// ignored; without any the camera is unchanged. A single point is framed like a ball of radius 1.
    #[must_use]
    pub fn fit_points(self, points: &[DVec3], margin: f64) -> Self {
        let Some((low, high)) = bounds(points) else { return self };
        let centre = low / 2.0 + high / 2.0;
        let [right, up, forward] = self.axes();
        // Relative to the centre, so that a model far from the origin keeps its precision.
        let local = Cloud::new(points, |p| {
            let p = p - centre;
            DVec3::new(p.dot(right), p.dot(up), p.dot(forward))
        });
        let diagonal = match (high - low).length() {
            0.0 => 2.0,
            diagonal => diagonal,
        };
        let free = 2.0 * margin.clamp(0.0, 0.49) * self.width.min(self.height);
        let frame = (self.width - free, self.height - free);
        let (eye, projection) = match self.projection {
            Projection::Perspective { fov_y_deg } => {
                let y = tan(fov_y_deg.to_radians() / 2.0);
                let tangents = (y * frame.0 / self.height, y * frame.1 / self.height);
                (perspective_eye(&local, tangents, diagonal), self.projection)
            }
            Projection::Orthographic { .. } => {
                let (eye, height) = parallel_eye(&local, frame, self.height, diagonal);
                (eye, Projection::Orthographic { height })
            }
        };
        let aside = centre + right * eye.x + up * eye.y;
        Self { eye: aside + forward * eye.z, target: aside, projection, ..self }
    }
}

/// Points in camera axes, with a bounding box for each block of them.
///
/// Extreme points in a direction are found without testing most points. Each maximum is exact and does not
/// depend on the order of the points.
struct Cloud {
    points: Vec<DVec3>,
    /// Lower and upper corner of each [`POINTS_PER_BOX`] of points.
    boxes: Vec<Bounds>,
}

impl Cloud {
    /// Transforms all finite points to camera axes.
    fn new(points: &[DVec3], place: impl Fn(DVec3) -> DVec3 + Sync) -> Self {
        // Replace invalid points by a duplicate of a valid one.
        let finite = points.iter().copied().find(|p| p.is_finite()).unwrap_or_default();
        let placed = points
            .par_iter()
            .with_min_len(POINTS_PER_TASK)
            .map(|&p| place(if p.is_finite() { p } else { finite }));
        let points: Vec<DVec3> = placed.collect();
        let boxes = points
            .par_chunks(POINTS_PER_BOX)
            .with_min_len(POINTS_PER_TASK / POINTS_PER_BOX)
            .map(|points| Bounds::of(points.iter().copied()))
            .collect();
        Self { points, boxes }
    }

    /// Maximum of `point · direction`, and the depth of a point that attains it; of several, the deepest.
    fn farthest(&self, direction: DVec3) -> (f64, f64) {
        // Rounding is monotonic in products and sums, so no point exceeds this bound.
        let beyond = |around: &Bounds| {
            product(DVec3::select(direction.cmpge(DVec3::ZERO), around.high, around.low), direction)
        };
        let mut best = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        let mut look = |points: &[DVec3]| {
            for p in points {
                let found = (product(*p, direction), p.z);
                if found > best {
                    best = found;
                }
            }
            best.0
        };
        // Start with the box of the greatest bound, so that most others can be skipped.
        let reaches: Vec<f64> = self.boxes.iter().map(beyond).collect();
        let first =
            reaches.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(block, _)| block);
        let blocks = || self.points.chunks(POINTS_PER_BOX);
        let mut reached = blocks().nth(first).map_or(f64::NEG_INFINITY, &mut look);
        for (reach, points) in reaches.into_iter().zip(blocks()) {
            if reach < reached {
                continue;
            }
            reached = look(points);
        }
        best
    }

    /// Maximum of `point · direction`.
    fn reach(&self, direction: DVec3) -> f64 {
        self.farthest(direction).0
    }
}

/// Dot product with a fixed order of summation.
#[inline]
fn product(p: DVec3, direction: DVec3) -> f64 {
    p.x * direction.x + p.y * direction.y + p.z * direction.z
}

/// Eye in camera axes that sees all points within the half angles with tangents `tx` and `ty`.
fn perspective_eye(points: &Cloud, (tx, ty): (f64, f64), diagonal: f64) -> DVec3 {
    // Positions of the right, left, top and bottom planes, and of the nearest point.
    let reach = |x, y, z| points.reach(DVec3::new(x, y, z));
    let (r, l) = (reach(1.0, 0.0, -tx), reach(-1.0, 0.0, -tx));
    let (t, b) = (reach(0.0, 1.0, -ty), reach(0.0, -1.0, -ty));
    let near = reach(0.0, 0.0, -1.0);
    let z = (-(r + l) / (2.0 * tx))
        .min(-(t + b) / (2.0 * ty))
        .min(-near - MIN_EYE_DISTANCE_OF_DIAGONAL * diagonal);
    DVec3::new(centred(points, tx, z, DVec3::X), centred(points, ty, z, DVec3::Y), z)
}

/// Position of the eye along the axis `side`, at the depth `eye_z`, for equal margins on both sides of the
/// picture.
///
/// The narrowest angle that contains the points is the root of a convex, decreasing function of its tangent,
/// `max(x - t z) + max(-x - t z) + 2 t eye_z`. Newton's method from 0 never overshoots it.
fn centred(points: &Cloud, widest: f64, eye_z: f64, side: DVec3) -> f64 {
    let mut t = 0.0;
    let mut x = 0.0;
    for _ in 0..MAX_CENTRING_STEPS {
        let plus = points.farthest(side - t * DVec3::Z);
        let minus = points.farthest(-side - t * DVec3::Z);
        let excess = plus.0 + minus.0 + 2.0 * t * eye_z;
        x = (plus.0 - minus.0) / 2.0;
        let fall = plus.1 + minus.1 - 2.0 * eye_z;
        let next = t + excess / fall;
        if next <= t || next.is_nan() {
            break;
        }
        t = next.min(widest);
    }
    x
}

/// Eye in camera axes and picture height of a parallel view of all points.
fn parallel_eye(points: &Cloud, frame: (f64, f64), height: f64, diagonal: f64) -> (DVec3, f64) {
    let [r, l, t, b, near] =
        [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::NEG_Z].map(|axis| points.reach(axis));
    let span = ((r + l) * height / frame.0).max((t + b) * height / frame.1);
    let span = if span < tolerances::MIN_VIEW_HEIGHT_OF_DIAGONAL * diagonal {
        diagonal * height / frame.0.min(frame.1)
    } else {
        span
    };
    (DVec3::new((r - l) / 2.0, (t - b) / 2.0, -near - diagonal), span)
}

/// World positions of all drawn vertices, part by part: those of triangles with area and of wires with
/// length. Parts that [`Scene::to_soup`] leaves out are left out here too.
#[must_use]
pub(crate) fn world_points(scene: &Scene) -> Vec<DVec3> {
    DrawnPoints::of(scene).points
}

#[cfg(test)]
mod tests {
    use glam::DAffine3;

    use super::*;
    use crate::scene::{Geometry, NamedView, Part, UpAxis};

    /// Position of a point in the frame: 0 to 1 from left to right and from top to bottom.
    fn frame_position(camera: &Camera, p: DVec3) -> (f64, f64) {
        let [right, up, forward] = camera.axes();
        let d = p - camera.eye;
        let half = match camera.projection {
            Projection::Perspective { fov_y_deg } => tan(fov_y_deg.to_radians() / 2.0) * d.dot(forward),
            Projection::Orthographic { height } => height / 2.0,
        };
        assert!(d.dot(forward) > 0.0, "behind the eye");
        let aspect = camera.width / camera.height;
        (0.5 + d.dot(right) / (2.0 * half * aspect), 0.5 - d.dot(up) / (2.0 * half))
    }

    /// Free fractions of the frame: left, right, top, bottom.
    fn free_margins(camera: &Camera, points: &[DVec3]) -> [f64; 4] {
        points.iter().fold([f64::INFINITY; 4], |[l, r, t, b], &p| {
            let (x, y) = frame_position(camera, p);
            [l.min(x), r.min(1.0 - x), t.min(y), b.min(1.0 - y)]
        })
    }

    fn cameras() -> Vec<Camera> {
        let mut cameras: Vec<Camera> =
            NamedView::ALL.into_iter().map(|view| Camera::named(view, UpAxis::Z)).collect();
        for (azimuth, elevation) in [(35.0, 22.0), (200.0, -70.0), (0.0, 90.0), (-61.0, 3.0)] {
            let camera = Camera::azimuth_elevation(azimuth, elevation, UpAxis::Z);
            for fov_y_deg in [1.0, 35.0, 70.0] {
                cameras.push(camera.with_projection(Projection::Perspective { fov_y_deg }));
            }
        }
        let shapes = [(1000.0, 1000.0), (1600.0, 400.0), (190.0, 277.0)];
        shapes.into_iter().flat_map(|(w, h)| cameras.iter().map(move |c| c.with_frame(w, h))).collect()
    }

    /// An irregular, slanted point cloud.
    fn point_cloud(offset: DVec3, scale: f64) -> Vec<DVec3> {
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut point = || {
            let (x, y, z) = (random(), random(), random());
            offset + scale * DVec3::new(3.0 * x, y * y + 0.3 * x, 2.0 * z * x)
        };
        (0..500).map(|_| point()).collect()
    }

    #[test]
    fn fit_points_centres_the_model_and_touches_the_margin() {
        for camera in cameras() {
            let points = point_cloud(DVec3::ZERO, 1.0);
            let fitted = camera.fit_points(&points, FRAME_MARGIN);
            assert_eq!(fitted.validate(), Ok(()));
            let [l, r, t, b] = free_margins(&fitted, &points);
            assert!((l - r).abs() < 1e-9 && (t - b).abs() < 1e-9, "not centred: {l} {r} {t} {b} {camera:?}");
            let side = camera.width.min(camera.height);
            let (across, down) = (FRAME_MARGIN * side / camera.width, FRAME_MARGIN * side / camera.height);
            assert!(l > across - 1e-9 && t > down - 1e-9, "outside: {l} {t} {camera:?}");
            assert!(l < across + 1e-9 || t < down + 1e-9, "not tight: {l} {t} {camera:?}");
        }
    }

    #[test]
    fn fit_points_keeps_the_view_direction() {
        for camera in cameras() {
            let fitted = camera.fit_points(&point_cloud(DVec3::new(5.0, -3.0, 1.0), 1.0), FRAME_MARGIN);
            let turn = camera.axes().into_iter().zip(fitted.axes()).map(|(a, b)| (a - b).length());
            assert!(turn.into_iter().all(|turn| turn < 1e-9));
        }
    }

    #[test]
    fn fit_points_does_not_depend_on_model_size_and_position() {
        for (offset, scale) in [(4.6e6, 10.0), (0.0, 3e-6), (1e9, 3e9)] {
            for camera in cameras() {
                let points = point_cloud(DVec3::splat(offset), scale);
                let there = free_margins(&camera.fit_points(&points, FRAME_MARGIN), &points);
                let points = point_cloud(DVec3::ZERO, 1.0);
                let here = free_margins(&camera.fit_points(&points, FRAME_MARGIN), &points);
                assert!(here.into_iter().zip(there).all(|(a, b)| (a - b).abs() < 1e-5), "{here:?} {there:?}");
            }
        }
    }

    #[test]
    fn fit_points_frames_flat_and_empty_models() {
        let single = [DVec3::new(3.0, 4.0, 5.0)];
        let repeated = [DVec3::ONE; 4];
        let line = [DVec3::ZERO, DVec3::X];
        let upright = [DVec3::ZERO, DVec3::Z, DVec3::Z * 3.0];
        let sheet = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X + DVec3::Y];
        let holed = [DVec3::ZERO, DVec3::NAN, DVec3::ONE, DVec3::INFINITY];
        for points in [&single[..], &repeated, &line, &upright, &sheet, &holed] {
            for camera in cameras() {
                let fitted = camera.fit_points(points, FRAME_MARGIN);
                assert_eq!(fitted.validate(), Ok(()), "{points:?} {camera:?}");
                let finite: Vec<DVec3> = points.iter().copied().filter(|p| p.is_finite()).collect();
                let inside = free_margins(&fitted, &finite).into_iter().all(|free| free > 0.01);
                assert!(inside, "{points:?} {camera:?} {fitted:?}");
            }
        }
        let camera = Camera::three_quarter();
        assert_eq!(camera.fit_points(&[], FRAME_MARGIN), camera);
        assert_eq!(camera.fit_points(&[DVec3::NAN], FRAME_MARGIN), camera);
    }

    #[test]
    fn fit_ignores_vertices_that_are_not_drawn() {
        let geometry = Geometry {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::splat(1e6), DVec3::Z],
            triangles: vec![[0, 1, 2]],
            wires: vec![[0, 4]],
            ..Geometry::default()
        };
        let part = |name: &str, world_from_part| Part { name: name.to_owned(), geometry: 0, world_from_part };
        let scene = Scene {
            geometries: vec![geometry, Geometry::default()],
            parts: vec![
                part("a", DAffine3::IDENTITY),
                part("b", DAffine3::from_translation(DVec3::splat(10.0))),
            ],
            ..Scene::default()
        };
        let points = world_points(&scene);
        assert_eq!(points.len(), 8);
        assert_eq!(bounds(&points), Some((DVec3::ZERO, DVec3::splat(11.0))));
        let fitted = Camera::three_quarter().fit(&scene);
        assert_eq!(fitted, Camera::three_quarter().fit_points(&points, FRAME_MARGIN));
    }
}
