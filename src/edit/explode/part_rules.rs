//! Rules for single parts: direction, distance, order, group.

use glam::DVec3;

use super::assembly::{Assembly, Moves, frame};
use super::axis_offsets::{AxisExtent, PairContacts, offsets};
use super::axis_projection::{AxisProjection, PairContact};
use super::bodies::{Body, joined};
use crate::geometry::names::glob::Glob;
use crate::scene::Scene;

/// Rule for the parts whose names match. Missing values are computed.
#[derive(Debug, Clone, PartialEq)]
pub struct PartExplosion {
    /// Pattern for part names.
    pub(crate) name: Glob,
    /// Direction of movement in world space, of any length above 0.
    pub direction: Option<DVec3>,
    /// Distance of movement, world units. 0 keeps the parts in place.
    pub distance: Option<f64>,
    /// Order among parts with an order. Of two overlapping parts the one with the greater order ends up
    /// farther along the axis.
    pub order: Option<f64>,
    /// Name of a group. Parts of a group move as one.
    pub group: Option<String>,
}

impl PartExplosion {
    /// Rule without values for the parts whose names match a pattern.
    #[must_use]
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: Glob::new(name), direction: None, distance: None, order: None, group: None }
    }
}

/// Reads a direction from `x`, `-y` or `1,0,-1`; none for other text.
#[must_use]
pub(crate) fn direction(text: &str) -> Option<DVec3> {
    let (sign, axis) = match text.trim() {
        text if text.starts_with('-') && text.len() == 2 => (-1.0, &text[1..]),
        text => (1.0, text.strip_prefix('+').unwrap_or(text)),
    };
    let named = match axis {
        "x" | "X" => Some(DVec3::X),
        "y" | "Y" => Some(DVec3::Y),
        "z" | "Z" => Some(DVec3::Z),
        _ => None,
    };
    if let Some(named) = named {
        return Some(named * sign);
    }
    let numbers: Vec<f64> =
        text.split(',').map(|number| number.trim().parse().ok()).collect::<Option<_>>()?;
    let direction = DVec3::from_array(numbers.try_into().ok()?);
    direction.try_normalize().map(|_| direction)
}

/// Parts that move as one, with their combined rule.
pub(crate) struct PartUnit {
    pub parts: Vec<usize>,
    pub combined_rule: PartExplosion,
}

/// Units of a scene, in the order of their first parts. Parts without faces belong to none.
pub(crate) fn units(scene: &Scene, bodies: &[Body], rules: &[PartExplosion]) -> Vec<PartUnit> {
    let mut units: Vec<PartUnit> = Vec::new();
    for (number, part) in scene.parts.iter().enumerate().filter(|(k, _)| !bodies[*k].triangles.is_empty()) {
        let mut part_rule = PartExplosion::new(part.name.as_str());
        for rule in rules.iter().filter(|rule| rule.name.matches(&part.name)) {
            part_rule.direction = rule.direction.or(part_rule.direction);
            part_rule.distance = rule.distance.or(part_rule.distance);
            part_rule.order = rule.order.or(part_rule.order);
            part_rule.group = rule.group.clone().or(part_rule.group);
        }
        let group = units
            .iter_mut()
            .find(|unit| part_rule.group.is_some() && unit.combined_rule.group == part_rule.group);
        match group {
            Some(PartUnit { parts, combined_rule: told }) => {
                parts.push(number);
                told.direction = told.direction.or(part_rule.direction);
                told.distance = told.distance.or(part_rule.distance);
                told.order = told.order.or(part_rule.order);
            }
            None => units.push(PartUnit { parts: vec![number], combined_rule: part_rule }),
        }
    }
    units
}

/// Moves the units with a given direction or distance. `main` is the axis of the other units.
pub(crate) fn apply_part_rules(
    assembly: &Assembly,
    units: &[PartUnit],
    main: Option<DVec3>,
    moves: &mut Moves,
) {
    let direction = |k: usize| units[k].combined_rule.direction.and_then(DVec3::try_normalize);
    let mut remaining: Vec<usize> = (0..units.len()).filter(|k| direction(*k).is_some()).collect();
    while let Some(axis) = remaining.first().and_then(|k| direction(*k)) {
        let (parallel_units, other_units): (Vec<usize>, Vec<usize>) = remaining.into_iter().partition(|k| {
            direction(*k).is_some_and(|unit_direction| unit_direction.dot(axis) > MIN_PARALLEL_COSINE)
        });
        remaining = other_units;
        for (unit, offset) in parallel_units.iter().zip(offsets_along(assembly, &parallel_units, axis)) {
            moves.total_offsets[*unit] = axis * offset;
            moves.alone[*unit] = moves.total_offsets[*unit];
        }
    }
    for (k, unit) in units.iter().enumerate() {
        if let Some(distance) = unit.combined_rule.distance {
            let move_direction =
                direction(k).or(moves.total_offsets[k].try_normalize()).or(main).unwrap_or_default();
            moves.total_offsets[k] = move_direction * distance;
            moves.alone[k] = moves.total_offsets[k];
        }
    }
}

/// Minimum cosine of the angle between directions that count as equal: 0.1 degrees.
const MIN_PARALLEL_COSINE: f64 = 0.999_998_5;

/// Displacements of some units along a direction that move them past all others, in an order that allows
/// disassembly.
fn offsets_along(assembly: &Assembly, moved_units: &[usize], move_direction: DVec3) -> Vec<f64> {
    let axes = frame(move_direction);
    let other_bodies =
        (0..assembly.bodies.len()).filter(|k| !moved_units.contains(k)).map(|k| &assembly.bodies[k]);
    let fixed_shadow = AxisProjection::new(&joined(other_bodies), &axes);
    let shadows: Vec<AxisProjection> =
        moved_units.iter().map(|k| AxisProjection::new(&assembly.bodies[*k], &axes)).collect();
    // The other bodies form the last entry, and stay.
    let last = moved_units.len();
    let stretch = |shadow: &AxisProjection, size: f64, order| AxisExtent {
        low: shadow.bounds.low.z,
        high: shadow.bounds.high.z,
        size,
        order,
    };
    let mut stretches: Vec<AxisExtent> = shadows
        .iter()
        .zip(moved_units)
        .map(|(shadow, k)| stretch(shadow, 0.0, assembly.orders[*k]))
        .collect();
    stretches.push(stretch(&fixed_shadow, f64::INFINITY, None));
    let mut meetings = PairContacts::new();
    for a in 0..last {
        for b in 0..a {
            meetings.insert([a, b], shadows[a].contact_with(&shadows[b], assembly.touch));
        }
        let past = fixed_shadow.contact_with(&shadows[a], assembly.touch);
        if past.meets || past.is_within {
            // The others block the unit downward, and the unit blocks them upward.
            meetings.insert(
                [last, a],
                PairContact { meets: true, blocks_up: true, blocks_down: false, is_within: false },
            );
        }
    }
    let mut unit_offsets = offsets(&stretches, &meetings, assembly.gap);
    unit_offsets.truncate(last);
    // A unit that nothing blocks moves by the gap, because a direction was given.
    unit_offsets.iter().map(|offset| offset.max(assembly.gap)).collect()
}
