//! [`SheetView`]: one orthographic view on a technical sheet, with its direction, extent, scale and position.
//!
//! 1. The extent is the bounding box of the model's points along the right and up axes of the camera.
//! 2. The sheet's arrangement sets the scale and the position.
//! 3. The view then maps model points to the page, provides the camera, and draws itself.

use glam::{DVec2, DVec3};
use kurbo::{Affine, Point, Rect};

use crate::drawing::{Drawing, Page, PlacedDrawing, Unit};
use crate::error::Error;
use crate::pipeline::Renderer;
use crate::scene::{Camera, Projection};

/// Margin around a view for the width of its lines, mm.
pub(crate) const LINE_MARGIN_MM: f64 = 1.5;

/// An orthographic view on a sheet.
#[derive(Debug, Clone)]
pub(crate) struct SheetView {
    /// Name of the view.
    pub name: String,
    /// Title above the view.
    pub title: Option<String>,
    /// Camera; only its axes are used.
    camera: Camera,
    /// Centre of the model, the origin of the extent, world space.
    middle: DVec3,
    /// Lower left corner of the extent, model units to the right and up.
    pub low: DVec2,
    /// Upper right corner of the extent, model units to the right and up.
    pub high: DVec2,
    /// Scale: length on paper of a model unit, mm.
    pub mm_per_unit: f64,
    /// Upper left corner of the extent on the page, mm.
    pub corner: Point,
}

impl SheetView {
    /// Creates the view of a point set along a camera's direction, at the page origin with a scale of 1 mm
    /// per model unit.
    pub(crate) fn new(name: &str, camera: Camera, middle: DVec3, points: &[DVec3]) -> Self {
        let [right, up, _] = camera.axes();
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for p in points.iter().filter(|p| p.is_finite()) {
            let p = DVec2::new((*p - middle).dot(right), (*p - middle).dot(up));
            (low, high) = (low.min(p), high.max(p));
        }
        if low.x > high.x {
            (low, high) = (DVec2::ZERO, DVec2::ZERO);
        }
        Self {
            name: name.to_owned(),
            title: None,
            camera,
            middle,
            low,
            high,
            mm_per_unit: 1.0,
            corner: Point::ZERO,
        }
    }

    /// The same view, limited to a square around a point: the extent of a detail. `radius` is half the side,
    /// model units.
    pub(crate) fn detail(&self, name: &str, at: DVec3, radius: f64) -> Self {
        let [right, up, _] = self.camera.axes();
        let p = DVec2::new((at - self.middle).dot(right), (at - self.middle).dot(up));
        let (low, high) = (p - radius, p + radius);
        Self { name: name.to_owned(), title: None, low, high, ..self.clone() }
    }

    /// Unit vectors to the right, up and forward, world space.
    pub(crate) fn axes(&self) -> [DVec3; 3] {
        self.camera.axes()
    }

    /// Width and height on paper if a model unit is `unit` mm long.
    pub(crate) fn size(&self, unit: f64) -> [f64; 2] {
        let size = (self.high - self.low) * unit;
        [size.x, size.y]
    }

    /// The rectangle of the view on the page, mm.
    pub(crate) fn rect(&self) -> Rect {
        let [w, h] = self.size(self.mm_per_unit);
        Rect::from_origin_size(self.corner, (w, h))
    }

    /// Maps a point of the model to the page, mm.
    pub(crate) fn to_page(&self, p: DVec3) -> Point {
        let [right, up, _] = self.axes();
        let p = p - self.middle;
        let (x, y) = (p.dot(right) - self.low.x, self.high.y - p.dot(up));
        self.corner + kurbo::Vec2::new(x * self.mm_per_unit, y * self.mm_per_unit)
    }

    /// The camera of the view. Its frame is the view on paper with a margin, in mm.
    pub(crate) fn view_camera(&self) -> Camera {
        let [right, up, forward] = self.axes();
        let centre = (self.low + self.high) / 2.0;
        let target = self.middle + right * centre.x + up * centre.y;
        let [w, h] = self.size(self.mm_per_unit).map(|side| side + 2.0 * LINE_MARGIN_MM);
        Camera {
            eye: target - forward * (self.high - self.low).length().max(f64::MIN_POSITIVE),
            target,
            up,
            projection: Projection::Orthographic { height: h / self.mm_per_unit },
            width: w,
            height: h,
            near: None,
        }
    }

    /// Transform from the frame of [`Self::view_camera`] to the page, both in mm.
    pub(crate) fn frame_to_page(&self) -> Affine {
        Affine::translate((self.corner.x - LINE_MARGIN_MM, self.corner.y - LINE_MARGIN_MM))
    }

    /// Draws the view and returns it with its warnings.
    ///
    /// # Errors
    /// Returns an error if there is nothing to draw.
    pub(crate) fn draw(&self, prepared: &Renderer) -> Result<(PlacedDrawing, Vec<String>), Error> {
        let camera = self.view_camera();
        let page = Page { width: camera.width, height: camera.height, unit: Unit::Mm, background: None };
        let (drawing, report): (Drawing, _) = prepared.draw(&camera, page)?;
        Ok((
            PlacedDrawing { name: self.name.clone(), drawing, place: self.frame_to_page(), clip: None },
            report.warnings,
        ))
    }
}
