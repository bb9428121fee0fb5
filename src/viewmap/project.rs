//! Feature segments in image space, cut to the near plane and the page.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::lines::{FeatureLines, FeatureSegment, LineKind, NO_FACE};
use crate::mesh::Mesh;
use crate::view::View;

/// A feature segment as the image shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImageSegment {
    /// Its start in image space (x, y, nearness).
    pub a: DVec3,
    /// Its end.
    pub b: DVec3,
    /// The ids of its feature ends; they name mesh vertices or points of the feature lines.
    pub ends: [u32; 2],
    /// Whether near plane or page cut the ends off.
    pub cut: [bool; 2],
    /// Faces that never hide it.
    pub hosts: [u32; 2],
    /// Index of the feature segment.
    pub source: u32,
    /// Whether it bounds a surface in the image, so that there may be background beside it.
    pub bounds: bool,
    /// By how much nearer visibility is asked at its two ends, in nearness; 0 but for contours of
    /// rounded surfaces.
    pub lift: [f64; 2],
}

/// The image-space point at parameter `t`, 0 to 1, of the way from `a` to `b`; the ends are exact.
#[inline]
#[must_use]
pub fn between(a: DVec3, b: DVec3, t: f64) -> DVec3 {
    if t <= 0.0 {
        a
    } else if t >= 1.0 {
        b
    } else {
        a + (b - a) * t
    }
}

impl ImageSegment {
    /// The image-space point at parameter `t`, 0 to 1.
    #[inline]
    #[must_use]
    pub fn at(&self, t: f64) -> DVec3 {
        between(self.a, self.b, t)
    }

    /// The segment as visibility is asked of it. A contour of a rounded surface is asked `aside` user
    /// units to its outer side and nearer by its lift, where none of the faces around it, which stand
    /// for the same surface, is in the way, while what truly hides it still is.
    #[must_use]
    pub fn asked(&self, aside: f64) -> Self {
        if !self.is_rounded() {
            return *self;
        }
        let shift = self.outward(aside);
        let [a, b] = self.lift.map(|lift| shift.extend(lift));
        Self { a: self.a + a, b: self.b + b, ends: [u32::MAX; 2], ..*self }
    }

    /// The same far behind everything: where it is hidden, something lies beside the contour.
    #[must_use]
    pub fn probe(&self, aside: f64, farthest: f64) -> Self {
        let shift = self.outward(aside);
        let move_out = |p: DVec3| (p.truncate() + shift).extend(farthest);
        Self { a: move_out(self.a), b: move_out(self.b), ends: [u32::MAX; 2], hosts: [NO_FACE; 2], ..*self }
    }

    /// A vector `aside` long to the outer side of a contour of a rounded surface, whose surface lies
    /// on the left in the image.
    fn outward(&self, aside: f64) -> DVec2 {
        // y points down, so that the right is where `perp` points.
        (self.b - self.a).truncate().perp().normalize_or_zero() * aside
    }

    /// Whether it is a contour of a rounded surface.
    #[inline]
    #[must_use]
    pub fn is_rounded(&self) -> bool {
        self.lift[0] > 0.0
    }

    /// Length in the image, user units.
    #[inline]
    #[must_use]
    pub fn length(&self) -> f64 {
        (self.b - self.a).truncate().length()
    }
}

/// All feature segments of which something lies on the page, in order.
#[must_use]
pub fn project(mesh: &Mesh, view: &View, lines: &FeatureLines) -> Vec<ImageSegment> {
    let found: Vec<Vec<ImageSegment>> = lines
        .segments
        .par_chunks(1 << 12)
        .enumerate()
        .map(|(chunk, segments)| {
            let first = chunk << 12;
            let numbered = segments.iter().enumerate();
            numbered.filter_map(|(i, s)| project_one(mesh, view, lines, s, (first + i) as u32)).collect()
        })
        .collect();
    found.concat()
}

fn project_one(
    mesh: &Mesh,
    view: &View,
    lines: &FeatureLines,
    segment: &FeatureSegment,
    source: u32,
) -> Option<ImageSegment> {
    let image = |end: u32| match view.points.get(end as usize) {
        Some(p) => *p,
        None => view.frame.image_from_local(lines.position(mesh, end)),
    };
    let [mut a, mut b] = segment.ends.map(image);
    let mut cut = [false; 2];
    if a.z.is_nan() || b.z.is_nan() {
        let [p, q] = segment.ends.map(|end| lines.position(mesh, end));
        ([a, b], cut) = view.frame.clip_segment(p, q)?;
    }
    let (start, end) = view.frame.clip_to_page(a, b)?;
    let d = b - a;
    if end < 1.0 {
        b = a + d * end;
        cut[1] = true;
    }
    if start > 0.0 {
        a += d * start;
        cut[0] = true;
    }
    // Beside contours of rounded surfaces background is sought in another way.
    let bounds =
        segment.lift == 0.0 && (segment.kind == LineKind::Contour || segment.kind == LineKind::Border);
    let lift = [a.z, b.z].map(|q| view.frame.nearness_step(q, f64::from(segment.lift)));
    Some(ImageSegment { a, b, ends: segment.ends, cut, hosts: segment.hosts, source, bounds, lift })
}
