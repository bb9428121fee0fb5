//! Feature segments in image space, clipped to the near plane and the page.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::host_sides::HostedLine;
use crate::lines::{FeatureLines, FeatureSegment, LineKind, Role};
use crate::mesh::Mesh;
use crate::view::View;
use crate::visibility::tolerances;

/// Feature segment in image space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ImageSegment {
    /// Start in image space (x, y, nearness).
    pub a: DVec3,
    /// End in image space.
    pub b: DVec3,
    /// Ids of its feature ends: mesh vertices or points of the feature lines.
    pub ends: [u32; 2],
    /// Whether the near plane or the page cut off each end.
    pub cut: [bool; 2],
    /// Faces that never hide it.
    pub hosts: [u32; 2],
    /// Index of the feature segment.
    pub source: u32,
    /// Whether its own faces leave a side open in the image, so background may be next to it.
    pub bounds: bool,
    /// Role in the drawing.
    pub role: Role,
}

/// Image-space point at parameter `t` (0 to 1) between `a` and `b`; the ends are exact.
#[inline]
#[must_use]
pub(crate) fn between(a: DVec3, b: DVec3, t: f64) -> DVec3 {
    if t <= 0.0 {
        a
    } else if t >= 1.0 {
        b
    } else {
        a + (b - a) * t
    }
}

impl ImageSegment {
    /// Image-space point at parameter `t`, 0 to 1.
    #[inline]
    #[must_use]
    pub(crate) fn at(&self, t: f64) -> DVec3 {
        between(self.a, self.b, t)
    }

    /// Length in the image, user units.
    #[inline]
    #[must_use]
    pub(crate) fn length(&self) -> f64 {
        (self.b - self.a).truncate().length()
    }
}

/// Projects all feature segments with any part on the page, in order.
#[must_use]
pub(crate) fn project(mesh: &Mesh, view: &View, lines: &FeatureLines) -> Vec<ImageSegment> {
    let one = |(segment, source): (&FeatureSegment, u32)| {
        project_one(mesh, view, lines, segment, source).unwrap_or(OFF_PAGE)
    };
    let count = lines.segments.len() as u32;
    // Usually all are on the page.
    let mut found: Vec<ImageSegment> =
        lines.segments.par_iter().zip(0..count).with_min_len(1 << 10).map(one).collect();
    if found.par_iter().any(|segment| segment.source == OFF_PAGE.source) {
        found.retain(|segment| segment.source != OFF_PAGE.source);
    }
    found
}

/// Stands for a segment off the page; no segment has that index.
const OFF_PAGE: ImageSegment = ImageSegment {
    a: DVec3::ZERO,
    b: DVec3::ZERO,
    ends: [u32::MAX; 2],
    cut: [false; 2],
    hosts: [u32::MAX; 2],
    source: u32::MAX,
    bounds: false,
    role: Role::Line,
};

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
    let bounds = match segment.kind {
        // The background next to a smooth contour comes from the mesh contour matched to it.
        _ if segment.role == Role::SmoothContour => false,
        LineKind::Contour | LineKind::Border => true,
        LineKind::Crease | LineKind::Material | LineKind::Intersection => {
            let hosted = HostedLine { line: [a, b], ends: segment.ends, hosts: segment.hosts };
            hosted.may_bound(mesh, view, tolerances::BACKGROUND_PROBE_PX * view.frame.px())
        }
        _ => false,
    };
    Some(ImageSegment {
        a,
        b,
        ends: segment.ends,
        cut,
        hosts: segment.hosts,
        source,
        bounds,
        role: segment.role,
    })
}
