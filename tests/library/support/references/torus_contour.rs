//! Closed form of the contour of a torus: position, visibility and cusps.
//!
//! A surface point is p = R c(u) + r n, with the normal n = c cos v + z sin v. It is on the contour where n ·
//! (E − R c(u)) = r for the camera position E, which gives two values of v for each u. The line of sight
//! touches the torus there, so two of its four intersections coincide. The other two are the roots of a
//! quadratic.
//!
//! The formula does not hold for a camera between the planes z = ±r.

use glam::DVec3;
use kurbo::Point;
use libm::{acos, atan2, cos, sin};
use ligne::scene::Camera;

use super::textbook_camera::TextbookCamera;

/// A point of the contour and its visibility.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContourPoint {
    pub image: Point,
    pub visible: bool,
    /// Whether the surface curves away from the line of sight; this changes at cusps.
    pub convex: bool,
}

/// A maximal visible part of a contour.
#[derive(Debug, Clone)]
pub(crate) struct VisibleArc {
    pub points: Vec<Point>,
    pub closed: bool,
    /// Number of its ends that are cusps.
    pub cusps: usize,
}

/// The two contours of a torus about the z axis, each a loop of `count` points.
pub(crate) fn torus_contours(
    radius: f64,
    tube: f64,
    camera: &Camera,
    count: usize,
) -> [Vec<ContourPoint>; 2] {
    let eye = TextbookCamera::new(camera);
    [-1.0, 1.0].map(|branch| {
        let place = |k: usize| {
            let u = std::f64::consts::TAU * k as f64 / count as f64;
            let c = DVec3::new(cos(u), sin(u), 0.0);
            let (a, b, wanted) = if eye.perspective {
                (eye.position.dot(c) - radius, eye.position.z, tube)
            } else {
                (-eye.forward.dot(c), -eye.forward.z, 0.0)
            };
            let v = atan2(b, a) + branch * acos((wanted / (a * a + b * b).sqrt()).clamp(-1.0, 1.0));
            let p = c * (radius + tube * cos(v)) + DVec3::Z * (tube * sin(v));
            let (to_eye, far) = if eye.perspective {
                ((eye.position - p).normalize(), p.distance(eye.position))
            } else {
                (-eye.forward, f64::INFINITY)
            };
            let [linear, constant] = remaining_quadratic(radius, tube, p, to_eye);
            let root = linear * linear / 4.0 - constant;
            let meets = root > 0.0 && {
                let (low, high) = (-linear / 2.0 - root.sqrt(), -linear / 2.0 + root.sqrt());
                [low, high].iter().any(|t| *t > 0.0 && *t < far)
            };
            ContourPoint { image: eye.project(p), visible: constant > 0.0 && !meets, convex: constant > 0.0 }
        };
        (0..count).map(place).collect()
    })
}

/// Coefficients a and b of the quartic t² (t² + a t + b) of a line p + t d that touches the torus at t = 0.
fn remaining_quadratic(radius: f64, tube: f64, p: DVec3, d: DVec3) -> [f64; 2] {
    let s = p.length_squared() + radius * radius - tube * tube;
    let q = p.dot(d);
    let flat = d.x * d.x + d.y * d.y;
    [4.0 * q, 4.0 * q * q + 2.0 * s - 4.0 * radius * radius * flat]
}

/// The visible parts of the contours.
pub(crate) fn visible_arcs(contours: &[Vec<ContourPoint>]) -> Vec<VisibleArc> {
    let mut pieces = Vec::new();
    for places in contours {
        let n = places.len();
        let Some(start) = (0..n).find(|k| !places[*k].visible) else {
            let points = places.iter().map(|p| p.image).collect();
            pieces.push(VisibleArc { points, closed: true, cusps: 0 });
            continue;
        };
        let mut current: Option<VisibleArc> = None;
        for k in 1..=n {
            let (before, here) = (places[(start + k - 1) % n], places[(start + k) % n]);
            let cusp = usize::from(before.convex != here.convex);
            match (&mut current, here.visible) {
                (None, true) => {
                    current = Some(VisibleArc { points: vec![here.image], closed: false, cusps: cusp });
                }
                (Some(piece), true) => piece.points.push(here.image),
                (Some(piece), false) => {
                    piece.cusps += cusp;
                    pieces.extend(current.take());
                }
                (None, false) => {}
            }
        }
    }
    pieces
}

impl VisibleArc {
    pub(crate) fn segments(&self) -> Vec<[Point; 2]> {
        let mut segments: Vec<[Point; 2]> = self.points.windows(2).map(|w| [w[0], w[1]]).collect();
        if self.closed {
            segments.push([self.points[self.points.len() - 1], self.points[0]]);
        }
        segments
    }
}
