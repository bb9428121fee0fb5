//! [`Assembly`]: bodies to be separated, and [`Moves`]: their displacements.

use glam::DVec3;

use super::bodies::Body;
use super::body_axes::is_parallel;

/// Bodies of an assembly. Each moves as a whole.
pub(crate) struct Assembly<'a> {
    pub bodies: &'a [Body],
    /// Axes of each body, those of the largest faces first.
    pub axes: Vec<Vec<DVec3>>,
    /// Given order of each body, if any.
    pub orders: Vec<Option<f64>>,
    /// Gap between separated bodies, world units.
    pub gap: f64,
    /// Distance within which surfaces touch, world units.
    pub touch: f64,
}

/// Maximum number of distinct axes compared in a group.
const MAX_DISTINCT_AXES: usize = 256;

impl Assembly<'_> {
    /// Axes that at least two of the bodies share, most common first.
    pub(crate) fn shared_axes(&self, of: &[usize]) -> Vec<DVec3> {
        let mut counted_axes: Vec<(DVec3, usize)> = Vec::new();
        for axis in of.iter().flat_map(|unit| &self.axes[*unit]) {
            match counted_axes.iter().position(|(known_axis, _)| is_parallel(*known_axis, *axis)) {
                Some(index) => counted_axes[index].1 += 1,
                None if counted_axes.len() < MAX_DISTINCT_AXES => counted_axes.push((*axis, 1)),
                None => {}
            }
        }
        counted_axes.retain(|(_, count)| *count > 1);
        counted_axes.sort_by_key(|(_, count)| usize::MAX - count);
        counted_axes.into_iter().map(|(axis, _)| axis).collect()
    }
}

/// Displacement of each body, world units.
pub(crate) struct Moves {
    pub total_offsets: Vec<DVec3>,
    /// Final part of the displacement, without the common movement with interlocking bodies.
    pub alone: Vec<DVec3>,
}

/// Right-handed orthonormal basis with the axis as its third vector.
pub(crate) fn frame(axis: DVec3) -> [DVec3; 3] {
    let least = axis.abs().min_element();
    let other = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().find(|v| axis.dot(*v).abs() == least);
    let u = axis.cross(other.unwrap_or(DVec3::X)).normalize();
    [u, axis.cross(u).normalize(), axis]
}
