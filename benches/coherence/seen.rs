//! [`Seen`]: depth buffer of a frame, which maps surface points between frames. It shares no code with the
//! renderer.

use ligne::glam::DVec3;
use ligne::kurbo::Point;
use ligne::scene::Projection;
use ligne::{Camera, Scene};

const NONE: u32 = u32::MAX;
/// Maximum distance behind the front surface of a point that counts as visible, as a share of the model's
/// size.
const BEHIND: f64 = 0.01;

/// Depth buffer of a frame with one cell per px.
pub struct Seen {
    width: usize,
    height: usize,
    face: Vec<u32>,
    /// Depth along the optical axis, world units.
    depth: Vec<f64>,
    /// Corners of each triangle: page position, px, and depth.
    corners: Vec<[Spot; 3]>,
    perspective: bool,
    behind: f64,
}

/// Page position and depth.
#[derive(Clone, Copy)]
pub struct Spot {
    pub at: Point,
    depth: f64,
}

/// Point on the surface: a triangle and barycentric weights.
#[derive(Clone, Copy)]
pub struct Place {
    face: u32,
    shares: [f64; 3],
}

impl Seen {
    pub fn new(scene: &Scene, camera: &Camera) -> Self {
        let soup = ligne::internals::soup(scene);
        let (low, high) = scene.bounds().expect("something to see");
        let (width, height) = (camera.width.ceil() as usize, camera.height.ceil() as usize);
        let spots: Vec<Spot> = soup.positions.iter().map(|position| spot(*position, camera)).collect();
        let corners: Vec<[Spot; 3]> =
            soup.triangles.iter().map(|triangle| triangle.map(|corner| spots[corner as usize])).collect();
        let mut seen = Self {
            width,
            height,
            face: vec![NONE; width * height],
            depth: vec![f64::INFINITY; width * height],
            corners,
            perspective: matches!(camera.projection, Projection::Perspective { .. }),
            behind: BEHIND * low.distance(high),
        };
        for face in 0..seen.corners.len() {
            seen.fill(face);
        }
        seen
    }

    fn fill(&mut self, face: usize) {
        let corners = self.corners[face];
        if corners.iter().any(|corner| corner.depth <= 0.0 && self.perspective) {
            return;
        }
        let least =
            |f: fn(&Spot) -> f64| corners.iter().map(f).fold(f64::INFINITY, f64::min).max(0.0) as usize;
        let most = |f: fn(&Spot) -> f64, limit: usize| {
            (corners.iter().map(f).fold(0.0, f64::max).ceil() as usize).min(limit)
        };
        for y in least(|c| c.at.y)..most(|c| c.at.y, self.height) {
            for x in least(|c| c.at.x)..most(|c| c.at.x, self.width) {
                let Some(shares) = shares(&corners, Point::new(x as f64 + 0.5, y as f64 + 0.5)) else {
                    continue;
                };
                if shares.iter().any(|share| *share < 0.0) {
                    continue;
                }
                let depth = self.mixed(&corners, shares).1;
                let cell = y * self.width + x;
                if depth < self.depth[cell] {
                    (self.depth[cell], self.face[cell]) = (depth, face as u32);
                }
            }
        }
    }

    /// Barycentric weights in space and the depth, from weights on the page.
    fn mixed(&self, corners: &[Spot; 3], on_page: [f64; 3]) -> ([f64; 3], f64) {
        let weigh = |corner: usize| {
            if self.perspective { on_page[corner] / corners[corner].depth } else { on_page[corner] }
        };
        let weights = [weigh(0), weigh(1), weigh(2)];
        let sum: f64 = weights.iter().sum();
        let shares = weights.map(|weight| weight / sum);
        (shares, (0..3).map(|corner| shares[corner] * corners[corner].depth).sum())
    }

    /// Surface points in front within one px of a page position. Lines often lie at the edge of a face, where
    /// one px is far along the surface.
    pub fn places(&self, at: Point) -> Vec<Place> {
        let front = self.around(at).map(|cell| self.depth[cell]).fold(f64::INFINITY, f64::min);
        let place = |cell: usize| {
            let face = self.face[cell];
            let corners = self.corners.get(face as usize)?;
            let centre = Point::new((cell % self.width) as f64 + 0.5, (cell / self.width) as f64 + 0.5);
            let on_page = shares(corners, centre)?;
            Some(Place { face, shares: self.mixed(corners, on_page).0 })
        };
        self.around(at).filter(|cell| self.depth[*cell] <= front + self.behind).filter_map(place).collect()
    }

    /// Surface point in front at a page position.
    pub fn place(&self, at: Point) -> Option<Place> {
        let cell = self.around(at).nth(4)?;
        let corners = self.corners.get(self.face[cell] as usize)?;
        let on_page = shares(corners, at)?.map(|share| share.max(0.0));
        let sum: f64 = on_page.iter().sum();
        Some(Place { face: self.face[cell], shares: self.mixed(corners, on_page.map(|share| share / sum)).0 })
    }

    /// Position of a surface point in this frame.
    pub fn spot(&self, place: Place) -> Spot {
        let corners = &self.corners[place.face as usize];
        let sum =
            |f: &dyn Fn(&Spot) -> f64| (0..3).map(|corner| place.shares[corner] * f(&corners[corner])).sum();
        let depth: f64 = sum(&|corner| corner.depth);
        let weight = |corner: &Spot| if self.perspective { corner.depth / depth } else { 1.0 };
        let at = Point::new(
            sum(&|corner| corner.at.x * weight(corner)),
            sum(&|corner| corner.at.y * weight(corner)),
        );
        Spot { at, depth }
    }

    /// Whether a point is visible.
    pub fn shows(&self, spot: Spot) -> bool {
        self.around(spot.at).any(|cell| self.depth[cell] + self.behind >= spot.depth)
    }

    /// Cells around a position, with the central cell in fifth place. Fewer at the border of the page.
    fn around(&self, at: Point) -> impl Iterator<Item = usize> + '_ {
        let cells = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| [dx, dy]));
        cells.filter_map(move |[dx, dy]| {
            let (x, y) = ((at.x + f64::from(dx)).floor(), (at.y + f64::from(dy)).floor());
            let inside = x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height as f64;
            inside.then(|| y as usize * self.width + x as usize)
        })
    }
}

fn spot(position: DVec3, camera: &Camera) -> Spot {
    let [right, up, forward] = camera.axes();
    let offset = position - camera.eye;
    let depth = offset.dot(forward);
    let scale = match camera.projection {
        Projection::Perspective { fov_y_deg } => {
            camera.height / (2.0 * libm::tan(fov_y_deg.to_radians() / 2.0) * depth)
        }
        Projection::Orthographic { height } => camera.height / height,
    };
    let at = Point::new(
        camera.width / 2.0 + offset.dot(right) * scale,
        camera.height / 2.0 - offset.dot(up) * scale,
    );
    Spot { at, depth }
}

/// Barycentric weights on the page. Their sum is one.
fn shares(corners: &[Spot; 3], at: Point) -> Option<[f64; 3]> {
    let [a, b, c] = corners.map(|corner| corner.at);
    let all = (b - a).cross(c - a);
    let share = |p: Point, q: Point| (p - at).cross(q - at) / all;
    let shares = [share(b, c), share(c, a), share(a, b)];
    shares.iter().all(|share| share.is_finite()).then_some(shares)
}
