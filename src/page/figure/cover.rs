//! [`Cover`]: which of a frame models cover, in coarse squares, to weigh places by.

use glam::DVec3;
use kurbo::{Point, Rect, Vec2};

use crate::page::layout::Polygon;
use crate::scene::{Camera, Scene};
use crate::view::Frame;

/// Squares across and down a frame.
const SQUARES: usize = 48;

/// Which squares of a frame models cover.
#[derive(Debug, Clone, PartialEq)]
pub struct Cover {
    /// The frame.
    frame: Rect,
    squares: Vec<bool>,
}

impl Cover {
    /// Of the frame of a camera, which is put at `corner`.
    #[must_use]
    pub fn of(scene: &Scene, camera: &Camera, corner: Point) -> Self {
        let frame = Frame::new(camera, DVec3::ZERO);
        let mut squares = vec![false; SQUARES * SQUARES];
        let scale = Vec2::new(SQUARES as f64 / camera.width, SQUARES as f64 / camera.height);
        for part in &scene.parts {
            let Some(geometry) = scene.geometry_of(part) else { continue };
            let seen: Vec<Option<Point>> = geometry
                .positions
                .iter()
                .map(|p| {
                    let own = frame.camera_from_local(part.world_from_part.transform_point3(*p));
                    let image = frame.image_from_camera(own);
                    let place = Point::new(image.x * scale.x, image.y * scale.y);
                    (place.is_finite() && !(frame.perspective && own.z <= 0.0)).then_some(place)
                })
                .collect();
            for corners in &geometry.triangles {
                let [a, b, c] = corners.map(|corner| seen.get(corner as usize).copied().flatten());
                if let (Some(a), Some(b), Some(c)) = (a, b, c) {
                    mark(&mut squares, [a, b, c]);
                }
            }
        }
        Self { frame: Rect::from_origin_size(corner, (camera.width, camera.height)), squares }
    }

    /// The share of a polygon that is covered.
    #[must_use]
    pub fn share(&self, hull: &Polygon) -> f64 {
        let (mut all, mut covered) = (0_u32, 0_u32);
        let step = Vec2::new(self.frame.width(), self.frame.height()) / SQUARES as f64;
        for (number, is_covered) in self.squares.iter().enumerate() {
            let (x, y) = ((number % SQUARES) as f64 + 0.5, (number / SQUARES) as f64 + 0.5);
            if hull.holds(self.frame.origin() + Vec2::new(x * step.x, y * step.y)) {
                all += 1;
                covered += u32::from(*is_covered);
            }
        }
        f64::from(covered) / f64::from(all.max(1))
    }
}

/// Marks the squares whose middle a triangle holds.
fn mark(squares: &mut [bool], [a, b, c]: [Point; 3]) {
    let range = |values: [f64; 3]| {
        let low = values.into_iter().fold(f64::INFINITY, f64::min).max(0.0);
        let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max).min(SQUARES as f64);
        (low as usize)..(high.ceil().max(0.0) as usize).min(SQUARES)
    };
    let side = |p: Point, q: Point, r: Point| (q - p).cross(r - p);
    for y in range([a.y, b.y, c.y]) {
        for x in range([a.x, b.x, c.x]) {
            let p = Point::new(x as f64 + 0.5, y as f64 + 0.5);
            let sides = [side(a, b, p), side(b, c, p), side(c, a, p)];
            let within = sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0);
            if let Some(square) = squares.get_mut(y * SQUARES + x).filter(|_| within) {
                *square = true;
            }
        }
    }
}
