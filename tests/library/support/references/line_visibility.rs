//! Reference for the visibility of a polyhedron's lines: one ray per sample along every line.

use kurbo::{Point, Vec2};
use ligne::scene::{Camera, Scene};
use rayon::prelude::*;

use super::polyhedron_lines::{Kind, Line, lines};
use super::ray_casts::{Before, Rays, around, project};
use super::textbook_camera::Eye;
use super::triangle_scene::Polygons;

/// Edges with at least this angle may be drawn as creases.
const MAY_CREASE_DEG: f64 = 15.0;
/// Maximum distance between samples, px.
const STEP: f64 = 1.0;
/// If a shift by this distance changes the visibility, the sample counts as unsure, px.
const SHIFT: f64 = 0.75;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    Visible,
    Hidden,
    /// Too close to call.
    Unsure,
}

/// A sample: a short piece of a line.
pub struct Place {
    pub at: Point,
    /// Vector from the middle to the end of the piece.
    pub half: Vec2,
    pub line: u32,
    pub state: State,
    /// Whether another connected component clearly hides it.
    pub behind_others: bool,
    /// Whether it is a contour or border with background on one side.
    pub is_outline: bool,
}

impl Place {
    pub fn length(&self) -> f64 {
        2.0 * self.half.hypot2().sqrt()
    }

    pub fn stretch(&self) -> [Point; 2] {
        [self.at - self.half, self.at + self.half]
    }
}

/// The lines of a view and the samples along them, in line order.
pub struct Truth {
    pub lines: Vec<Line>,
    pub places: Vec<Place>,
}

impl Truth {
    pub fn of(scene: &Scene, camera: &Camera) -> Self {
        let polygons = Polygons::of(scene);
        let eye = Eye::new(camera);
        let rays = Rays::new(&polygons, &eye, camera.width, camera.height);
        let lines = lines(&polygons, &eye, MAY_CREASE_DEG);
        let frame = kurbo::Rect::new(0.0, 0.0, camera.width, camera.height);
        let along = |(id, line)| places(&rays, id, line).into_iter().filter(|place| frame.contains(place.at));
        let places = lines.par_iter().enumerate().flat_map_iter(along).collect();
        Self { lines, places }
    }

    pub fn kind(&self, place: &Place) -> Kind {
        self.lines[place.line as usize].kind
    }

    /// The pieces of the samples that satisfy `wanted`.
    pub fn stretches(&self, wanted: impl Fn(&Place) -> bool) -> Vec<[Point; 2]> {
        self.places.iter().filter(|place| wanted(place)).map(Place::stretch).collect()
    }
}

fn places(rays: &Rays, id: usize, line: &Line) -> Vec<Place> {
    let [(a, near_a), (b, near_b)] = line.ends.map(|end| project(rays.eye, end));
    let length = (b - a).hypot2().sqrt();
    let count = (length / STEP).ceil().max(1.0) as usize;
    let half = (b - a) / (2.0 * count as f64);
    let share = |k: usize| (k as f64 + 0.5) / count as f64;
    let hidden: Vec<Before> = (0..count)
        .map(|k| {
            rays.before(a.lerp(b, share(k)), near_a + (near_b - near_a) * share(k), |f| {
                touching(rays, line, f)
            })
        })
        .collect();
    let reach = (SHIFT / (length / count as f64).max(1e-9)).ceil().min(count as f64) as usize;
    (0..count)
        .map(|k| {
            let (at, nearness) = (a.lerp(b, share(k)), near_a + (near_b - near_a) * share(k));
            let is_hidden = hidden[k] == Before::Something;
            let clears = |touching: &dyn Fn(u32) -> Option<f64>| {
                [SHIFT, SHIFT / 2.0].into_iter().any(|radius| {
                    around(at, radius).any(|p| rays.before(p, nearness, touching) != Before::Something)
                })
            };
            let near = k.saturating_sub(reach)..(k + reach + 1).min(count);
            let changes = hidden[near].iter().any(|other| (*other == Before::Something) != is_hidden);
            let touches = hidden[k] == Before::Contact;
            let state = match is_hidden {
                true if changes || clears(&|face| touching(rays, line, face)) => State::Unsure,
                true => State::Hidden,
                false if changes || touches || line.unsure => State::Unsure,
                false => State::Visible,
            };
            let others = |face: u32| of_others(rays, line, face);
            let behind_others = state == State::Hidden
                && rays.before(at, nearness, others) == Before::Something
                && !clears(&others);
            let beside = Vec2::new(-half.y, half.x) / half.hypot2().sqrt().max(1e-12);
            let is_outline = matches!(line.kind, Kind::Contour | Kind::Border)
                && !is_hidden
                && [-1.0, 1.0].into_iter().any(|side| rays.is_background(at + beside * side));
            Place { at, half, line: id as u32, state, behind_others, is_outline }
        })
        .collect()
}

/// Depth distance within which a face does not hide a line; `None` for the line's own faces.
///
/// The distance is smaller for faces that share one end of the line.
fn touching(rays: &Rays, line: &Line, face: u32) -> Option<f64> {
    if line.hosts.contains(&face) {
        return None;
    }
    let own = &rays.polygons.faces[face as usize];
    match line.corners.iter().filter(|corner| own.contains(corner)).count() {
        0 => Some(rays.contact()),
        1 => Some(1e-4 * rays.contact()),
        _ => None,
    }
}

/// The contact distance for faces of other components; `None` for those of the line's own component.
fn of_others(rays: &Rays, line: &Line, face: u32) -> Option<f64> {
    let piece = &rays.polygons.piece;
    let own = line.hosts.iter().any(|host| piece[*host as usize] == piece[face as usize]);
    (!own).then_some(rays.contact())
}
