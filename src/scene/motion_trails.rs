//! [`Mover`]: a moving body, and the paths of some of its vertices.

use glam::DVec3;

/// A body that moves as one (a part, or the vertices of a skin's joint) and may leave motion lines.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mover {
    /// Index of its part in [`super::Scene::parts`].
    pub part: usize,
    /// Material at the start of its first line.
    pub material: Option<u32>,
    /// Identity, the same at all times of a clip.
    pub identity: u64,
    /// For a joint, the index of its parent mover. Connected movers that leave lines share the lines of one
    /// body.
    pub above: Option<usize>,
    /// Whether it always leaves lines; otherwise only if it is fast enough on the page.
    pub chosen: bool,
    /// Seconds between consecutive points of a trail.
    pub interval: f64,
    /// Paths of its vertices.
    pub trails: Vec<Trail>,
    /// Its triangles in world space at this moment; its lines are not drawn over them.
    pub body: Vec<[DVec3; 3]>,
}

/// Path of a vertex.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Trail {
    /// Number of the line among those of its mover.
    pub line: usize,
    /// Whether the style gives its start.
    pub named: bool,
    /// Index in the style's list of lines, if one applies.
    pub rule: Option<usize>,
    /// World positions: now, an interval ago, and so on.
    pub points: Vec<DVec3>,
}
