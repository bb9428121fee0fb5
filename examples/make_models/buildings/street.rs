//! A street of apartment blocks in about two hundred named parts that share few meshes: walls with open
//! windows, floors, roofs, chimneys, stairs and fences.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use glam::{DQuat, DVec2, DVec3};

use crate::geometry::outline::{at, rectangle};
use crate::geometry::part::{Material, Part};
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{block, pillar, prism};
use crate::writers::glb::{Assembly, Node};

const fn paint(name: &'static str, colour: [f64; 3]) -> Material {
    Material { name, colour, metallic: 0.0, roughness: 0.8 }
}

const BRICK: Material = paint("brick", [0.66, 0.33, 0.25]);
const PLASTER: Material = paint("plaster", [0.88, 0.84, 0.74]);
const TILE: Material = paint("tile", [0.35, 0.3, 0.32]);
const STONE: Material = paint("stone", [0.62, 0.62, 0.6]);
const WOOD: Material = paint("wood", [0.45, 0.32, 0.2]);

const HOUSE_WIDTH_M: f64 = 6.0;
const HOUSE_DEPTH_M: f64 = 5.0;
const STOREY: f64 = 3.0;
const WALL: f64 = 0.3;

/// Quarter turn about z, for walls along y.
const ACROSS: DQuat = DQuat::from_xyzw(0.0, 0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2);
const ALONG: DQuat = DQuat::IDENTITY;

/// Wall along x, one storey high, with openings of (left, sill, width, height).
fn wall(length: f64, openings: &[(f64, f64, f64, f64)]) -> Solid {
    let holes: Vec<Vec<DVec2>> =
        openings.iter().map(|&(x, z, wide, high)| rectangle(at(x, z), at(x + wide, z + high))).collect();
    let flat = prism(&rectangle(DVec2::ZERO, at(length, STOREY)), &holes, 0.0, WALL);
    // From upright in y to upright in z. The outer face of the wall lies at y = 0.
    flat.moved(glam::DAffine3::from_mat3(glam::DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y)))
        .shifted(0.0, WALL, 0.0)
}

/// Overhanging roof with two slopes, or with four that meet in a point.
fn roof(pointed: bool) -> Solid {
    if !pointed {
        let rim = [at(-0.4, 0.0), at(HOUSE_DEPTH_M + 0.4, 0.0), at(HOUSE_DEPTH_M / 2.0, 2.2)];
        return prism(&rim, &[], -0.3, HOUSE_WIDTH_M + 0.3)
            .moved(glam::DAffine3::from_mat3(glam::DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X)));
    }
    let mut solid = Solid::default();
    let eaves = rectangle(at(-0.35, -0.4), at(HOUSE_WIDTH_M + 0.35, HOUSE_DEPTH_M + 0.4));
    let eaves = solid.ring(eaves.into_iter().map(|point| point.extend(0.0)));
    let top = solid.point(DVec3::new(HOUSE_WIDTH_M / 2.0, HOUSE_DEPTH_M / 2.0, 2.6));
    solid.band(&eaves, &[top]);
    solid.faces.push(eaves.iter().rev().copied().collect());
    solid
}

/// Meshes that are shown many times.
#[derive(Default)]
struct Yard {
    meshes: Vec<Part>,
    nodes: Vec<Node>,
}

impl Yard {
    fn mesh(&mut self, name: &str, material: Material, solid: Solid) -> usize {
        self.meshes.push(Part::new(name, material, solid));
        self.meshes.len() - 1
    }

    fn place(&mut self, mesh: usize, rotation: DQuat, translation: DVec3) {
        let name = format!("{}-{}", self.meshes[mesh].name, self.nodes.len() + 1);
        let node = Node { translation, rotation, mesh: Some(mesh), ..Node::group(&name, Vec::new()) };
        self.nodes.push(node);
    }
}

/// The street, in metres and y up.
pub fn street() -> Assembly {
    let mut yard = Yard::default();
    let windows = [(0.8, 0.9, 1.1, 1.5), (2.45, 0.9, 1.1, 1.5), (4.1, 0.9, 1.1, 1.5)];
    let shop = [(0.7, 0.5, 2.4, 1.8), (4.1, 0.05, 1.1, 2.3)];
    let fronts = [BRICK, PLASTER].map(|paint| {
        let upper = yard.mesh(&format!("front-{}", paint.name), paint, wall(HOUSE_WIDTH_M, &windows));
        let lower = yard.mesh(&format!("shop-{}", paint.name), paint, wall(HOUSE_WIDTH_M, &shop));
        // A side wall stands between front and back with a small gap to both.
        let side = wall(HOUSE_DEPTH_M - 2.0 * WALL - 0.02, &[(1.7, 0.9, 1.0, 1.4)]);
        [upper, lower, yard.mesh(&format!("side-{}", paint.name), paint, side)]
    });
    let floor =
        block(DVec3::new(0.05, 0.05, -0.12), DVec3::new(HOUSE_WIDTH_M - 0.05, HOUSE_DEPTH_M - 0.05, 0.0));
    let floor = yard.mesh("floor", STONE, floor);
    let chimney = yard.mesh("chimney", BRICK, pillar(DVec3::ZERO, DVec3::new(0.7, 0.7, 2.4)));
    let sill = yard.mesh("sill", STONE, block(DVec3::new(0.7, -0.14, 0.78), DVec3::new(2.0, 0.1, 0.88)));
    let step = yard.mesh("step", STONE, block(DVec3::new(-0.9, -0.8, 0.0), DVec3::new(0.9, -0.02, 0.16)));
    let post = yard.mesh("post", WOOD, pillar(DVec3::ZERO, DVec3::new(0.12, 0.12, 1.2)));
    let rail = yard.mesh("rail", WOOD, block(DVec3::new(0.0, -0.03, 0.8), DVec3::new(6.4, 0.03, 0.95)));
    let ground =
        yard.mesh("ground", STONE, block(DVec3::new(-2.0, -7.0, -0.3), DVec3::new(27.5, 13.5, -0.13)));
    yard.place(ground, ALONG, DVec3::ZERO);
    let mut roofs = Solid::default();
    for (i, storeys) in [2, 3, 1, 2, 1, 2, 3, 1].into_iter().enumerate() {
        let [upper, lower, side] = fronts[i % 2];
        let corner = DVec3::new(6.5 * (i % 4) as f64, if i < 4 { 0.0 } else { 7.5 }, 0.0);
        for storey in 0..storeys {
            let foot = corner + DVec3::Z * (STOREY + 0.13) * f64::from(storey);
            yard.place(floor, ALONG, foot);
            yard.place(if storey == 0 { lower } else { upper }, ALONG, foot + DVec3::Z * 0.01);
            yard.place(upper, ALONG, foot + DVec3::new(0.0, HOUSE_DEPTH_M - WALL, 0.01));
            for x in [WALL, HOUSE_WIDTH_M] {
                yard.place(side, ACROSS, foot + DVec3::new(x, WALL + 0.01, 0.01));
            }
            if storey > 0 {
                for k in 0..3 {
                    yard.place(sill, ALONG, foot + DVec3::X * (1.65 * f64::from(k)));
                }
            }
        }
        let top = corner + DVec3::Z * ((STOREY + 0.13) * f64::from(storeys) - 0.1);
        roofs.append(&roof(i % 3 == 1).shifted(top.x, top.y, top.z));
        yard.place(chimney, ALONG, top + DVec3::new(1.2 + 0.7 * (i % 3) as f64, HOUSE_DEPTH_M * 0.3, 0.4));
        yard.place(step, ALONG, corner + DVec3::new(4.65, 0.0, -0.13));
    }
    let roofs = yard.mesh("roofs", TILE, roofs);
    yard.place(roofs, ALONG, DVec3::ZERO);
    for k in 0..9 {
        yard.place(post, ALONG, DVec3::new(3.2 * f64::from(k) - 0.4, -5.2, -0.13));
    }
    for k in 0..4 {
        yard.place(rail, ALONG, DVec3::new(6.4 * f64::from(k) - 0.4, -5.2, -0.13));
    }
    let root = Node {
        // From z up to y up.
        rotation: DQuat::from_xyzw(-FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2),
        ..Node::group("street", yard.nodes)
    };
    let (eye, target) = (DVec3::new(-9.0, 17.0, 32.0), DVec3::new(12.5, 2.0, -3.0));
    Assembly {
        meshes: yard.meshes,
        root,
        with_normals: false,
        eye,
        target,
        fov_y: TAU / 9.0,
        aspect: 1.5,
        clip: None,
    }
}
