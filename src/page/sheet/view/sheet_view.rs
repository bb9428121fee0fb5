//! [`Sight`]: a view on a sheet: from where, of what, how large, and where on the sheet.

use glam::{DVec2, DVec3};
use kurbo::{Affine, Point, Rect};

use crate::drawing::{Drawing, Item, Page, Unit};
use crate::error::Error;
use crate::pipeline::Prepared;
use crate::scene::{Camera, Projection};

/// Room round a view for the width of its lines, mm.
pub(crate) const RIM: f64 = 1.5;

/// A view on a sheet.
#[derive(Debug, Clone)]
pub(crate) struct Sight {
    /// What it is called.
    pub name: String,
    /// What stands above it.
    pub title: Option<String>,
    /// From where: a direction.
    camera: Camera,
    /// Where the model's middle is seen, and the box around what is seen, in units of the model to the right and up from there.
    middle: DVec3,
    pub low: DVec2,
    pub high: DVec2,
    /// Length on paper of a unit of the model, mm.
    pub unit: f64,
    /// The upper left corner of that box on the page.
    pub corner: Point,
}

impl Sight {
    /// A view of points in the direction of a camera.
    pub fn new(name: &str, camera: Camera, middle: DVec3, points: &[DVec3]) -> Self {
        let [right, up, _] = camera.axes();
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for p in points.iter().filter(|p| p.is_finite()) {
            let p = DVec2::new((*p - middle).dot(right), (*p - middle).dot(up));
            (low, high) = (low.min(p), high.max(p));
        }
        if low.x > high.x {
            (low, high) = (DVec2::ZERO, DVec2::ZERO);
        }
        Self { name: name.to_owned(), title: None, camera, middle, low, high, unit: 1.0, corner: Point::ZERO }
    }

    /// The same view of a place around a point.
    pub fn around(&self, name: &str, at: DVec3, radius: f64) -> Self {
        let [right, up, _] = self.camera.axes();
        let p = DVec2::new((at - self.middle).dot(right), (at - self.middle).dot(up));
        let (low, high) = (p - radius, p + radius);
        Self { name: name.to_owned(), title: None, low, high, ..self.clone() }
    }

    /// Right, up and forward, world.
    pub fn axes(&self) -> [DVec3; 3] {
        self.camera.axes()
    }

    /// Its width and height on paper, at a length on paper of a unit.
    pub fn size(&self, unit: f64) -> [f64; 2] {
        let size = (self.high - self.low) * unit;
        [size.x, size.y]
    }

    /// The box around it on the page.
    pub fn rect(&self) -> Rect {
        let [w, h] = self.size(self.unit);
        Rect::from_origin_size(self.corner, (w, h))
    }

    /// Where a point of the model is on the page.
    pub fn page(&self, p: DVec3) -> Point {
        let [right, up, _] = self.axes();
        let p = p - self.middle;
        let (x, y) = (p.dot(right) - self.low.x, self.high.y - p.dot(up));
        self.corner + kurbo::Vec2::new(x * self.unit, y * self.unit)
    }

    /// The camera that takes it, with a frame on paper.
    pub fn taken(&self) -> Camera {
        let [right, up, forward] = self.axes();
        let centre = (self.low + self.high) / 2.0;
        let target = self.middle + right * centre.x + up * centre.y;
        let [w, h] = self.size(self.unit).map(|side| side + 2.0 * RIM);
        Camera {
            eye: target - forward * (self.high - self.low).length().max(f64::MIN_POSITIVE),
            target,
            up,
            projection: Projection::Orthographic { height: h / self.unit },
            width: w,
            height: h,
            near: None,
        }
    }

    /// From the frame of the camera to the page.
    pub fn place(&self) -> Affine {
        Affine::translate((self.corner.x - RIM, self.corner.y - RIM))
    }

    /// Draws it.
    ///
    /// # Errors
    /// If there is nothing in it.
    pub fn item(&self, prepared: &Prepared) -> Result<(Item, Vec<String>), Error> {
        let camera = self.taken();
        let page = Page { width: camera.width, height: camera.height, unit: Unit::Mm, background: None };
        let (drawing, report): (Drawing, _) = prepared.draw(&camera, page, None)?;
        Ok((Item { name: self.name.clone(), drawing, place: self.place(), clip: None }, report.warnings))
    }
}
