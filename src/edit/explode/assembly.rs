//! [`Assembly`]: bodies that are taken apart, and [`Moves`], how far each goes.

use glam::DVec3;

use super::bodies::Body;
use super::body_axes::is_same;

/// The bodies of an assembly. They move as wholes.
pub(crate) struct Assembly<'a> {
    pub bodies: &'a [Body],
    /// The axes of each body, those of the largest faces first.
    pub axes: Vec<Vec<DVec3>>,
    /// The place of each body among those that have one.
    pub orders: Vec<Option<f64>>,
    /// The gap between bodies that were put apart, world units.
    pub gap: f64,
    /// Surfaces so near touch, world units.
    pub touch: f64,
}

/// Axes of a group that are compared to find those that bodies share.
const MOST_DISTINCT: usize = 256;

impl Assembly<'_> {
    /// The axes that at least two of some bodies share, the most common ones first.
    pub fn shared_axes(&self, of: &[usize]) -> Vec<DVec3> {
        let mut found: Vec<(DVec3, usize)> = Vec::new();
        for axis in of.iter().flat_map(|unit| &self.axes[*unit]) {
            match found.iter().position(|(known, _)| is_same(*known, *axis)) {
                Some(known) => found[known].1 += 1,
                None if found.len() < MOST_DISTINCT => found.push((*axis, 1)),
                None => {}
            }
        }
        found.retain(|(_, count)| *count > 1);
        found.sort_by_key(|(_, count)| usize::MAX - count);
        found.into_iter().map(|(axis, _)| axis).collect()
    }
}

/// How far each body of an assembly moves, world units.
pub(crate) struct Moves {
    pub whole: Vec<DVec3>,
    /// The share of it that the body moves alone.
    pub alone: Vec<DVec3>,
}

/// Two directions at right angles to an axis and to each other, and the axis: right-handed.
pub(crate) fn frame(axis: DVec3) -> [DVec3; 3] {
    let least = axis.abs().min_element();
    let other = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().find(|v| axis.dot(*v).abs() == least);
    let u = axis.cross(other.unwrap_or(DVec3::X)).normalize();
    [u, axis.cross(u).normalize(), axis]
}
