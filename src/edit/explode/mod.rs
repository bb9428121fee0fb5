//! Exploded views: moves the parts of an assembly apart until none hides another.
//!
//! 1. `bodies` takes the surface of each part from the mesh. `part_rules` joins parts of one group into a
//!    unit.
//! 2. `body_axes` finds the candidate axes. `axis_blocking` tests along an axis which bodies block each
//!    other, with the projections of `axis_projection` (areas from `polygon_overlap`).
//! 3. Bodies that block each other in both directions move as one. Sub-assemblies at an angle to the axis do,
//!    too.
//! 4. `axis_offsets` sorts the others along the axis and computes offsets with gaps between them.
//! 5. Groups that move as one are separated the same way along the next best axis (`assembly`).
//! 6. Rules for single parts come last: direction, distance, order, group. `trail_lines` draws the paths.
//!
//! Source: Li, Agrawala, Curless, Salesin, Automated generation of interactive 3D exploded view diagrams,
//! 2008, section 3: blocking along axes, offsets without overlap, sub-assemblies. Deviation: all parts of one
//! axis move at once.

mod assembly;
mod axis_blocking;
mod axis_offsets;
mod axis_projection;
mod bodies;
mod body_axes;
mod part_rules;
mod polygon_overlap;
mod trail_lines;

use glam::{DAffine3, DVec3};

pub use part_rules::PartExplosion;
pub(crate) use part_rules::direction;
pub(crate) use trail_lines::TRAIL;
pub use trail_lines::with_trails;

use super::tolerances;
use crate::scene::Scene;
use assembly::{Assembly, Moves};
use axis_blocking::AxisBlocking;
use bodies::{Body, joined};

/// Settings of an exploded view.
#[derive(Debug, Clone, PartialEq)]
pub struct Explosion {
    /// Axis along which parts move first, world space. The best axis if none.
    pub axis: Option<DVec3>,
    /// Scale of the displacements. 1 leaves gaps of 4 % of the model's diagonal.
    pub factor: f64,
    /// Rules for single parts. If several match a part, the last one with a value counts.
    pub parts: Vec<PartExplosion>,
}

impl Default for Explosion {
    fn default() -> Self {
        Self { axis: None, factor: 1.0, parts: Vec::new() }
    }
}

/// Gap between parts, as a share of the model's diagonal.
const PART_GAP_RATIO: f64 = 0.04;

/// Displacements of the parts of a scene, world units. Zero for parts that stay.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PartOffsets {
    /// Displacement of each part.
    pub offsets: Vec<DVec3>,
    /// Final part of each displacement, without the common movement with interlocking parts.
    pub alone: Vec<DVec3>,
}

/// Computes the displacement of each part.
///
/// The largest part of each connected group stays. Parts that overlap along the axis end up one behind the
/// other. Parts that interlock along all axes move as one.
#[must_use]
pub fn explode(scene: &Scene, explosion: &Explosion) -> PartOffsets {
    let count = scene.parts.len();
    let mut part_offsets = PartOffsets { offsets: vec![DVec3::ZERO; count], alone: vec![DVec3::ZERO; count] };
    let bodies = bodies::bodies(scene);
    let Some((low, high)) = scene.bounds() else { return part_offsets };
    let diagonal = (high - low).length();
    let units = part_rules::units(scene, &bodies, &explosion.parts);
    if diagonal <= 0.0 {
        return part_offsets;
    }
    let unit_bodies: Vec<Body> =
        units.iter().map(|unit| joined(unit.parts.iter().map(|part| &bodies[*part]))).collect();
    let assembly = Assembly {
        orders: units.iter().map(|unit| unit.combined_rule.order).collect(),
        axes: unit_bodies.iter().map(body_axes::body_axes).collect(),
        bodies: &unit_bodies,
        gap: PART_GAP_RATIO * diagonal * explosion.factor.max(0.0),
        touch: tolerances::TOUCH_DISTANCE_OF_DIAGONAL * diagonal,
    };
    let mut moves =
        Moves { total_offsets: vec![DVec3::ZERO; units.len()], alone: vec![DVec3::ZERO; units.len()] };
    let own_way = |unit: &part_rules::PartUnit| unit.combined_rule.direction.is_some();
    let free_units: Vec<usize> = (0..units.len()).filter(|k| !own_way(&units[*k])).collect();
    let first = explosion.axis.and_then(DVec3::try_normalize);
    let main = assembly.all(&free_units, first, &mut moves);
    part_rules::apply_part_rules(&assembly, &units, main.or(first), &mut moves);
    for (unit, (total_offset, alone)) in units.iter().zip(moves.total_offsets.iter().zip(&moves.alone)) {
        for part in &unit.parts {
            part_offsets.offsets[*part] = *total_offset;
            part_offsets.alone[*part] = *alone;
        }
    }
    part_offsets
}

impl Assembly<'_> {
    /// Separates bodies along `combined_rule`, or along the best axis. Returns the axis.
    fn all(&self, of: &[usize], told: Option<DVec3>, moves: &mut Moves) -> Option<DVec3> {
        let mut known = Vec::new();
        let level = match told {
            Some(axis) => AxisBlocking::new(self, of, axis),
            None => self.best_axis(of, &[], &mut known)?,
        };
        let mut groups = level.groups(self);
        if groups.len() < 2 {
            // All bodies are at an angle to the axis, or interlock.
            groups = level.held();
        }
        self.along(&level, &groups, (&[level.axis], &known), moves);
        Some(level.axis)
    }

    /// Separates groups along the axis of a level, then separates the bodies of each group. The whole could
    /// not be separated along the axes `tried`. `known_levels` holds the relations along axes that were already
    /// computed.
    fn along(
        &self,
        level: &AxisBlocking,
        groups: &[Vec<usize>],
        (tried, known_levels): (&[DVec3], &[AxisBlocking]),
        moves: &mut Moves,
    ) {
        for (group, offset) in groups.iter().zip(level.offsets(self, groups)) {
            let displacement = level.axis * offset;
            for unit in group {
                moves.total_offsets[*unit] += displacement;
                if offset != 0.0 {
                    moves.alone[*unit] = displacement;
                }
            }
            if group.len() < 2 {
                continue;
            }
            group.iter().for_each(|unit| moves.alone[*unit] = DVec3::ZERO);
            let tried = if groups.len() > 1 { &[level.axis] } else { tried };
            let mut known: Vec<AxisBlocking> =
                known_levels.iter().map(|level| level.of_some(group)).collect();
            if let Some(next) = self.best_axis(group, tried, &mut known) {
                let all: Vec<DVec3> = tried.iter().copied().chain([next.axis]).collect();
                let held_groups = next.held();
                self.along(&next, &held_groups, (&all, &known), moves);
            }
        }
    }

    /// Axis along which the fewest pairs interlock. Ties go to the axis that separates more pairs, then to
    /// the first. None if nothing can be separated.
    ///
    /// Axes of bodies are tried only if pairs interlock along all world axes. New relations are added to
    /// `known_levels`.
    fn best_axis(
        &self,
        of: &[usize],
        but: &[DVec3],
        known_levels: &mut Vec<AxisBlocking>,
    ) -> Option<AxisBlocking> {
        let mut axes: Vec<DVec3> = vec![DVec3::X, DVec3::Y, DVec3::Z];
        let mut best: Option<((usize, usize), AxisBlocking)> = None;
        for try_shared_axes in [false, true] {
            if try_shared_axes {
                axes = self.shared_axes(of);
                axes.retain(|axis| !DVec3::AXES.iter().any(|known| body_axes::is_parallel(*known, *axis)));
                axes.truncate(MAX_TRIED_AXES);
            }
            for axis in
                axes.iter().filter(|axis| !but.iter().any(|tried| body_axes::is_parallel(*tried, **axis)))
            {
                let known_level = known_levels.iter().find(|level| level.axis == *axis).cloned();
                let level = known_level.unwrap_or_else(|| {
                    let level = AxisBlocking::new(self, of, *axis);
                    known_levels.push(level.clone());
                    level
                });
                let rank = (level.held_pairs(), usize::MAX - level.separable_pairs());
                let is_better = best.as_ref().is_none_or(|(best_rank, _)| rank < *best_rank);
                if is_better && level.separable_pairs() > 0 && level.held().len() > 1 {
                    best = Some((rank, level));
                }
            }
            if best.as_ref().is_some_and(|((held_count, _), _)| *held_count == 0) {
                break;
            }
        }
        best.map(|(_, level)| level)
    }
}

/// Maximum number of shared body axes tried for one group.
const MAX_TRIED_AXES: usize = 3;

/// Moves the parts of a scene.
#[must_use]
pub fn moved(mut scene: Scene, ways: &PartOffsets) -> Scene {
    for (part, way) in scene.parts.iter_mut().zip(&ways.offsets) {
        part.world_from_part = DAffine3::from_translation(*way) * part.world_from_part;
    }
    scene
}
