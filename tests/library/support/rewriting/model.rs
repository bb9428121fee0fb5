//! [`RandomModel`]: a random scene of exact bodies, with its placement in the world and a camera.

use glam::{DAffine3, DVec3};
use ligne::load::ModelFormat;
use ligne::scene::{Camera, NamedView, Projection, Scene, UpAxis};

use super::body::Body;
use super::shapes::{
    cuboid, random_axis_rotation, random_cuboid, random_house, random_plate, random_prism, random_round_body,
    random_sheet, random_stairs,
};
use super::text_files::{Digits, write_obj};
use crate::library::support::scenes::random_dice::Dice;

/// Kinds of bodies of a scene.
pub(crate) const SHAPES: [&str; 9] =
    ["boxes", "prisms", "plates", "stairs", "houses", "sheets", "decals", "round bodies", "mixed bodies"];

/// Spatial relations between the bodies of a scene.
pub(crate) const CONTACTS: [&str; 4] = ["free", "touching", "flush", "overlapping"];

/// The viewing direction of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ViewChoice {
    Named(NamedView),
    /// Azimuth and elevation, whole degrees.
    Angles(f64, f64),
    /// An orthographic view along an axis of the bodies.
    AlongAxis(DVec3),
    Direction {
        to_eye: DVec3,
        is_parallel: bool,
    },
}

#[derive(Debug, Clone)]
pub(crate) struct RandomModel {
    /// The kind of its bodies and their contact.
    pub kind: String,
    pub seed: u64,
    pub bodies: Vec<Body>,
    pub world_from_model: DAffine3,
    pub view: ViewChoice,
    pub camera: Camera,
}

impl RandomModel {
    /// The model of a seed. Consecutive seeds run through all combinations of [`SHAPES`] and [`CONTACTS`].
    pub(crate) fn random(seed: u64) -> Self {
        let mut dice = Dice::new(seed);
        // Every shape with every contact in turn.
        let shapes = SHAPES[seed as usize % SHAPES.len()];
        let contact = CONTACTS[seed as usize / SHAPES.len() % CONTACTS.len()];
        let count = [1, 2, 2, 3, 3, 4, 5, 6, 8, 11, 14][dice.below(11)];
        let mut bodies = if shapes == "decals" {
            walls_with_decals(&mut dice)
        } else {
            arrange_bodies(shapes, contact, count, &mut dice)
        };
        let turn = random_axis_rotation(&mut dice);
        for (k, body) in bodies.iter_mut().enumerate() {
            *body = std::mem::take(body).moved(|p| turn * p);
            if body.part.is_empty() {
                body.part = format!("part{k}");
            }
        }
        let is_upright = dice.below(5) < 2;
        let world_from_model = if is_upright {
            DAffine3::IDENTITY
        } else {
            let shift = DVec3::new(3.0, -2.0, 5.0) * dice.below(3) as f64;
            DAffine3::from_mat3_translation(dice.turn(), shift)
        };
        let sight = random_view(is_upright, &mut dice);
        let kind = if shapes == "decals" { shapes.to_owned() } else { format!("{shapes}, {contact}") };
        let camera = Camera::three_quarter();
        let mut model = Self { kind, seed, bodies, world_from_model, view: sight, camera };
        model.fit_camera();
        model
    }

    /// Fits the camera to the scene.
    pub(crate) fn fit_camera(&mut self) {
        let along = |to_eye: DVec3, is_parallel: bool| {
            let to_eye = to_eye.normalize();
            let up = if to_eye.cross(DVec3::Y).length() < 0.1 { DVec3::X } else { DVec3::Y };
            let projection = if is_parallel {
                Projection::Orthographic { height: 1.0 }
            } else {
                Projection::Perspective { fov_y_deg: 35.0 }
            };
            Camera { eye: to_eye, target: DVec3::ZERO, up, projection, ..Camera::three_quarter() }
        };
        let camera = match self.view {
            ViewChoice::Named(view) => Camera::named(view, UpAxis::Y),
            ViewChoice::Angles(azimuth, elevation) => {
                Camera::azimuth_elevation(azimuth, elevation, UpAxis::Y)
            }
            ViewChoice::AlongAxis(axis) => along(self.world_from_model.matrix3 * axis, true),
            ViewChoice::Direction { to_eye, is_parallel } => along(to_eye, is_parallel),
        };
        self.camera = camera.fit(&self.scene());
    }

    /// The scene read from the reference file.
    pub(crate) fn scene(&self) -> Scene {
        Scene::from_bytes(&write_obj(self, Digits::All), ModelFormat::Obj).unwrap()
    }

    /// Whether any body approximates a rounded surface.
    pub(crate) fn is_round(&self) -> bool {
        self.bodies.iter().any(|body| body.is_round)
    }

    /// The points of a body in the world.
    pub(crate) fn world_points(&self, body: &Body) -> Vec<DVec3> {
        body.points.iter().map(|point| self.world_from_model.transform_point3(*point)).collect()
    }

    /// The bodies, grouped by part.
    pub(crate) fn parts(&self) -> impl Iterator<Item = &[Body]> {
        self.bodies.chunk_by(|one, next| one.part == next.part)
    }

    pub(crate) fn has_colours(&self) -> bool {
        self.bodies.iter().flat_map(|body| &body.faces).any(|face| face.colour > 0)
    }

    /// The model as one part with one colour, for STL and PLY.
    pub(crate) fn in_one_part(mut self) -> Self {
        for body in &mut self.bodies {
            body.part = "all".into();
            body.faces.iter_mut().for_each(|face| face.colour = 0);
        }
        self
    }
}

fn random_view(is_upright: bool, dice: &mut Dice) -> ViewChoice {
    let whole =
        |dice: &mut Dice| ViewChoice::Angles(5.0 * dice.below(72) as f64, 5.0 * dice.below(17) as f64);
    match dice.below(6) {
        0 | 1 if is_upright => ViewChoice::Named(NamedView::ALL[dice.below(NamedView::ALL.len())]),
        2 | 3 if is_upright => whole(dice),
        0 => ViewChoice::AlongAxis(random_axis_rotation(dice) * DVec3::X),
        1 => whole(dice),
        k => ViewChoice::Direction { to_eye: dice.direction(), is_parallel: k % 2 == 0 },
    }
}

fn random_body(shapes: &str, dice: &mut Dice) -> Body {
    match shapes {
        "boxes" => random_cuboid(dice),
        "prisms" => random_prism(dice),
        "plates" => random_plate(dice),
        "stairs" => random_stairs(dice),
        "houses" => random_house(dice),
        // Sheets need a body to lie on.
        "sheets" if dice.below(3) == 0 => random_cuboid(dice),
        "sheets" => random_sheet(dice),
        "round bodies" => random_round_body(dice),
        _ => random_body(SHAPES[dice.below(8)], dice),
    }
}

/// Random bodies, each placed apart from the others or in contact with an earlier one.
fn arrange_bodies(shapes: &str, contact: &str, count: usize, dice: &mut Dice) -> Vec<Body> {
    let mut bodies: Vec<Body> = Vec::new();
    for k in 0..count {
        let turn = random_axis_rotation(dice);
        let body = random_body(shapes, dice).moved(|p| turn * p);
        let colour = if dice.below(3) == 0 { 1 + dice.below(2) as u8 } else { 0 };
        let [low, high] = body.bounds();
        let place = match bodies.last() {
            None => -low,
            Some(_) if contact == "free" => {
                let cell = DVec3::new((k % 3) as f64, (k / 3 % 3) as f64, (k / 9) as f64);
                cell * 7.0 - low + DVec3::splat(0.5) * dice.below(3) as f64
            }
            Some(_) => {
                let neighbour = bodies[dice.below(bodies.len())].bounds();
                contact_offset(neighbour, [low, high], contact, dice)
            }
        };
        bodies.push(body.moved(|p| p + place).coloured(colour));
    }
    bodies
}

/// The translation that puts a box in contact with another box.
fn contact_offset(there: [DVec3; 2], [low, high]: [DVec3; 2], contact: &str, dice: &mut Dice) -> DVec3 {
    let size = high - low;
    let room = there[1] - there[0];
    let normal = dice.below(3);
    let mut corner = DVec3::ZERO;
    for axis in 0..3 {
        let half_units = |length: f64| (2.0 * length).round().max(1.0) as usize;
        corner[axis] = if axis == normal {
            let depth = match contact {
                "overlapping" => 0.5 * (1 + dice.below(half_units(size[axis].min(room[axis])))) as f64,
                _ => 0.0,
            };
            if dice.below(2) == 0 { there[1][axis] - depth } else { there[0][axis] - size[axis] + depth }
        } else if contact == "flush" || contact == "overlapping" && dice.below(3) == 0 {
            if dice.below(2) == 0 { there[0][axis] } else { there[1][axis] - size[axis] }
        } else {
            // Any position along the side, in steps of half a unit.
            let way = half_units(room[axis] + size[axis]).max(3) - 1;
            there[0][axis] - size[axis] + 0.5 * (1 + dice.below(way)) as f64
        };
    }
    corner - low
}

/// Boxes with coloured sheets in the planes of their sides, in the same part or in a separate one.
fn walls_with_decals(dice: &mut Dice) -> Vec<Body> {
    let mut bodies = Vec::new();
    for k in 0..1 + dice.below(3) {
        let size = DVec3::new(4.0, 3.0 + dice.below(3) as f64, 5.0);
        let wall = cuboid(size);
        let place = DVec3::X * 6.0 * k as f64;
        let part = format!("wall{k}");
        let mut group = vec![Body { part: part.clone(), ..wall }];
        for decal in 0..1 + dice.below(2) {
            // Each sheet stays in its half of the side, so two never overlap.
            let (low, high) = ([0.5, 2.0][decal], [1.5, 3.5][decal]);
            let (from, to) = (0.5 + 0.5 * dice.below(3) as f64, 2.5);
            let z = if dice.below(2) == 0 { size.z } else { 0.0 };
            let mut sheet = random_sheet(dice);
            sheet.faces.truncate(1);
            sheet.points =
                [(low, from), (high, from), (high, to), (low, to)].map(|(x, y)| DVec3::new(x, y, z)).to_vec();
            if z == 0.0 {
                sheet.reverse();
            }
            let own = if dice.below(2) == 0 { part.clone() } else { format!("decal{k}-{decal}") };
            group.push(Body { part: own, ..sheet.coloured(1 + decal as u8) });
        }
        group.sort_by_key(|body| body.part != part);
        bodies.extend(group.into_iter().map(|body| body.moved(|p| p + place)));
    }
    bodies
}
