//! [`Body`]: a polyhedral surface with exact points and flat polygons, and its triangulation.

use glam::{DVec2, DVec3};

/// A flat polygon, counter-clockwise from outside. It may be concave and may have straight corners.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Face {
    pub corners: Vec<u32>,
    pub colour: u8,
}

/// A connected surface.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Body {
    /// Name of its part. Adjacent bodies of a model with the same name form one part.
    pub part: String,
    pub points: Vec<DVec3>,
    pub faces: Vec<Face>,
    /// Whether it encloses a volume.
    pub is_closed: bool,
    /// Whether it approximates a rounded surface.
    pub is_round: bool,
    /// Opposite corners of an axis-aligned box strictly inside.
    pub core: Option<[DVec3; 2]>,
}

impl Body {
    /// Lowest and highest coordinates.
    pub(crate) fn bounds(&self) -> [DVec3; 2] {
        let points = || self.points.iter().copied();
        [points().reduce(DVec3::min).unwrap(), points().reduce(DVec3::max).unwrap()]
    }

    /// The body with every point moved. The map must preserve orientation and keep boxes axis-aligned.
    pub(crate) fn moved(mut self, place: impl Fn(DVec3) -> DVec3) -> Self {
        self.points.iter_mut().for_each(|point| *point = place(*point));
        self.core = self.core.map(|core| {
            let [a, b] = core.map(&place);
            [a.min(b), a.max(b)]
        });
        self
    }

    pub(crate) fn coloured(mut self, colour: u8) -> Self {
        self.faces.iter_mut().for_each(|face| face.colour = colour);
        self
    }

    pub(crate) fn reverse(&mut self) {
        self.faces.iter_mut().for_each(|face| face.corners.reverse());
    }

    /// The triangles of a face. Another `start` gives other diagonals if the polygon allows several.
    pub(crate) fn triangles(&self, face: &Face, start: usize) -> Vec<[u32; 3]> {
        let points: Vec<DVec3> = face.corners.iter().map(|&corner| self.points[corner as usize]).collect();
        let flat = project_to_plane(&points);
        let mut ring: Vec<usize> = (0..flat.len()).collect();
        ring.rotate_left(start % flat.len());
        clip_ears(&flat, ring).into_iter().map(|ear| ear.map(|k| face.corners[k])).collect()
    }
}

/// The polygon projected along a coordinate axis without rounding, counter-clockwise.
fn project_to_plane(points: &[DVec3]) -> Vec<DVec2> {
    let mut normal = DVec3::ZERO;
    for (k, a) in points.iter().enumerate() {
        normal += (a - points[0]).cross(points[(k + 1) % points.len()] - points[0]);
    }
    let size = normal.abs();
    let flat = |p: &DVec3| match size.max_element() {
        largest if largest == size.x => DVec2::new(p.y, p.z) * DVec2::new(normal.x.signum(), 1.0),
        largest if largest == size.y => DVec2::new(p.z, p.x) * DVec2::new(normal.y.signum(), 1.0),
        _ => DVec2::new(p.x, p.y) * DVec2::new(normal.z.signum(), 1.0),
    };
    points.iter().map(flat).collect()
}

/// Triangulates by ear clipping: the first ear with positive area each time.
fn clip_ears(points: &[DVec2], mut ring: Vec<usize>) -> Vec<[usize; 3]> {
    let mut found = Vec::new();
    let turn = |a: usize, b: usize, c: usize| (points[b] - points[a]).perp_dot(points[c] - points[a]);
    let scale = points.iter().map(|p| (*p - points[0]).length_squared()).fold(0.0, f64::max);
    let least = 1e-12 * scale;
    while ring.len() > 3 {
        let count = ring.len();
        let corners = |k: usize| [ring[(k + count - 1) % count], ring[k], ring[(k + 1) % count]];
        let is_ear = |k: &usize| {
            let [a, b, c] = corners(*k);
            let is_outside =
                |p: usize| turn(a, b, p) < -least || turn(b, c, p) < -least || turn(c, a, p) < -least;
            turn(a, b, c) > least && ring.iter().all(|&p| [a, b, c].contains(&p) || is_outside(p))
        };
        let Some(ear) = (0..count).find(is_ear) else { break };
        found.push(corners(ear));
        ring.remove(ear);
        // Continue at another corner, to avoid fans.
        ring.rotate_left(1);
    }
    if let [a, b, c] = ring[..]
        && turn(a, b, c) > least
    {
        found.push([a, b, c]);
    }
    found
}
