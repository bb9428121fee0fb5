//! [`Mover`]: a body that moves, and the ways that some of its vertices have come.

use glam::DVec3;

/// A body that moves as one (a part, or what a joint of its skin moves) and may leave motion lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Mover {
    /// Its part, an index into [`super::Scene::parts`].
    pub part: usize,
    /// The material where its first line begins.
    pub material: Option<u32>,
    /// What tells it from others at all times of a clip.
    pub identity: u64,
    /// Of a joint, which of the movers it hangs on; those that hang together and leave lines share the lines of one body.
    pub above: Option<usize>,
    /// Whether it leaves lines wherever it is seen from; else it does if it is fast enough on the page.
    pub chosen: bool,
    /// Seconds from a point of a trail to the next one.
    pub interval: f64,
    /// The ways of its vertices.
    pub trails: Vec<Trail>,
    /// Its triangles in the world now; its lines are not drawn over them.
    pub body: Vec<[DVec3; 3]>,
}

/// The way that a vertex has come.
#[derive(Debug, Clone, PartialEq)]
pub struct Trail {
    /// Which of the lines of its mover it is.
    pub line: usize,
    /// Whether the style says where it begins.
    pub named: bool,
    /// Which entry of the style's list of lines is for it, if one is.
    pub rule: Option<usize>,
    /// Where it was in the world: now, an interval ago, and so on.
    pub points: Vec<DVec3>,
}
