//! [`explode`]: how far the parts of an assembly move so that each is seen by itself.
//!
//! Along an axis, parts that stand in each other's way are put apart in the order in which they can be taken off; parts that hold each
//! other in both directions move as one, and are put apart along another axis.
//!
//! Source: Li, Agrawala, Curless, Salesin, Automated generation of interactive 3D exploded view diagrams, 2008, 3: blocking along the
//! main axes, and offsets that end all overlap. Here what blocks is told by columns over a grid, and all parts of one axis move at once.

mod columns;
mod order;
mod trails;

use glam::{DAffine3, DVec3};

pub use trails::{TRAIL, with_trails};

use crate::mesh::area::has_own_area;
use crate::scene::Scene;
use columns::{Columns, Grid};

/// How an assembly is taken apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Explosion {
    /// The axis along which parts move first; found if none is told.
    pub axis: Option<DVec3>,
    /// How far apart they come: 1 leaves a gap of 4 % of the model's diagonal.
    pub factor: f64,
}

impl Default for Explosion {
    fn default() -> Self {
        Self { axis: None, factor: 1.0 }
    }
}

/// A gap between parts, as a share of the model's diagonal.
const GAP: f64 = 0.04;

/// Fields of the grid along the longer side of the model.
const FIELDS: f64 = 160.0;

/// Surfaces so near, as a share of the model's diagonal, touch.
const TOUCH: f64 = 1e-5;

/// How far the parts of a scene move, world: zero for those that stay.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Ways {
    /// The whole way of each part.
    pub offsets: Vec<DVec3>,
    /// What of it the part goes by itself, and not with others that it is held by.
    pub alone: Vec<DVec3>,
}

/// How far each part moves.
///
/// Of the parts that hang together the largest stays. Where two parts overlap seen along the axis, one is before the other on it, but for
/// parts that hold each other along all axes, which move as one.
#[must_use]
pub fn explode(scene: &Scene, explosion: &Explosion) -> Ways {
    let bodies: Vec<Vec<[DVec3; 3]>> = (0..scene.parts.len()).map(|part| body(scene, part)).collect();
    let mut ways = Ways { offsets: vec![DVec3::ZERO; bodies.len()], alone: vec![DVec3::ZERO; bodies.len()] };
    let Some((low, high)) = scene.bounds() else { return ways };
    let diagonal = (high - low).length();
    let parts: Vec<usize> = (0..bodies.len()).filter(|part| !bodies[*part].is_empty()).collect();
    if diagonal <= 0.0 || parts.len() < 2 {
        return ways;
    }
    let step = (high - low).max_element() / FIELDS;
    let mut grids: Vec<Grid> = match explosion.axis.and_then(DVec3::try_normalize) {
        Some(axis) => {
            let grid = grid(axis, step);
            vec![
                grid,
                Grid { axes: rotated(grid.axes), step },
                Grid { axes: rotated(rotated(grid.axes)), step },
            ]
        }
        None => [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| grid(axis, step)).into(),
    };
    let reach = Reach { gap: GAP * diagonal * explosion.factor.max(0.0), touch: TOUCH * diagonal };
    if explosion.axis.is_none() {
        // The axis first along which fewest parts hold each other; of equals the one along which more are put apart.
        let held = |grid: &Grid| {
            let columns: Vec<Columns> = parts.iter().map(|part| Columns::new(&bodies[*part], grid)).collect();
            order::held_and_met(&columns, reach.touch)
        };
        let mut ranked: Vec<_> = grids.iter().map(|grid| (held(grid), *grid)).collect();
        ranked.sort_by_key(|((held, met), _)| (*held, usize::MAX - *met));
        grids = ranked.into_iter().map(|(_, grid)| grid).collect();
    }
    apart(&bodies, &parts, &grids, &reach, &mut ways);
    ways
}

/// Lengths that putting apart needs, world.
struct Reach {
    gap: f64,
    touch: f64,
}

/// Puts parts apart along the first axis, and those that hold each other along the next ones.
fn apart(bodies: &[Vec<[DVec3; 3]>], parts: &[usize], grids: &[Grid], reach: &Reach, ways: &mut Ways) {
    let Some((grid, others)) = grids.split_first() else { return };
    let columns: Vec<Columns> = parts.iter().map(|part| Columns::new(&bodies[*part], grid)).collect();
    let groups = order::groups(&columns, reach.touch);
    let moved = order::offsets(&columns, &groups, reach.touch, reach.gap);
    for (group, offset) in groups.iter().zip(moved) {
        let own: Vec<usize> = group.iter().map(|k| parts[*k]).collect();
        for part in &own {
            ways.offsets[*part] += grid.axes[2] * offset;
            if offset != 0.0 {
                ways.alone[*part] = grid.axes[2] * offset;
            }
        }
        if own.len() > 1 {
            own.iter().for_each(|part| ways.alone[*part] = DVec3::ZERO);
            apart(bodies, &own, others, reach, ways);
        }
    }
}

/// The scene with its parts moved so.
#[must_use]
pub fn moved(mut scene: Scene, ways: &Ways) -> Scene {
    for (part, way) in scene.parts.iter_mut().zip(&ways.offsets) {
        part.world_from_part = DAffine3::from_translation(*way) * part.world_from_part;
    }
    scene
}

fn body(scene: &Scene, part: usize) -> Vec<[DVec3; 3]> {
    let part = &scene.parts[part];
    let Some(geometry) = scene.geometry_of(part) else { return Vec::new() };
    let corner = |v: u32| geometry.positions.get(v as usize).copied().unwrap_or_default();
    let corners = |t: &[u32; 3]| t.map(|v| part.world_from_part.transform_point3(corner(v)));
    geometry.triangles.iter().map(corners).filter(|corners| has_own_area(*corners)).collect()
}

fn grid(axis: DVec3, step: f64) -> Grid {
    let least = axis.abs().min_element();
    let beside = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().find(|v| axis.dot(*v).abs() == least);
    let u = axis.cross(beside.unwrap_or(DVec3::X)).normalize();
    Grid { axes: [u, axis.cross(u).normalize(), axis], step }
}

fn rotated([u, v, axis]: [DVec3; 3]) -> [DVec3; 3] {
    [v, axis, u]
}
