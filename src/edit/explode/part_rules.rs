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
    pub name: Glob,
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
pub fn direction(text: &str) -> Option<DVec3> {
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
    pub told: PartExplosion,
}

/// Units of a scene, in the order of their first parts. Parts without faces belong to none.
pub(crate) fn units(scene: &Scene, bodies: &[Body], told: &[PartExplosion]) -> Vec<PartUnit> {
    let mut units: Vec<PartUnit> = Vec::new();
    for (number, part) in scene.parts.iter().enumerate().filter(|(k, _)| !bodies[*k].triangles.is_empty()) {
        let mut own = PartExplosion::new(part.name.as_str());
        for rule in told.iter().filter(|rule| rule.name.matches(&part.name)) {
            own.direction = rule.direction.or(own.direction);
            own.distance = rule.distance.or(own.distance);
            own.order = rule.order.or(own.order);
            own.group = rule.group.clone().or(own.group);
        }
        let group = units.iter_mut().find(|unit| own.group.is_some() && unit.told.group == own.group);
        match group {
            Some(PartUnit { parts, told }) => {
                parts.push(number);
                told.direction = told.direction.or(own.direction);
                told.distance = told.distance.or(own.distance);
                told.order = told.order.or(own.order);
            }
            None => units.push(PartUnit { parts: vec![number], told: own }),
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
    let direction = |k: usize| units[k].told.direction.and_then(DVec3::try_normalize);
    let mut left: Vec<usize> = (0..units.len()).filter(|k| direction(*k).is_some()).collect();
    while let Some(way) = left.first().and_then(|k| direction(*k)) {
        let (own, others): (Vec<usize>, Vec<usize>) = left
            .into_iter()
            .partition(|k| direction(*k).is_some_and(|own| own.dot(way) > MIN_PARALLEL_COSINE));
        left = others;
        for (unit, offset) in own.iter().zip(offsets_along(assembly, &own, way)) {
            moves.whole[*unit] = way * offset;
            moves.alone[*unit] = moves.whole[*unit];
        }
    }
    for (k, unit) in units.iter().enumerate() {
        if let Some(distance) = unit.told.distance {
            let way = direction(k).or(moves.whole[k].try_normalize()).or(main).unwrap_or_default();
            moves.whole[k] = way * distance;
            moves.alone[k] = moves.whole[k];
        }
    }
}

/// Minimum cosine of the angle between directions that count as equal: 0.1 degrees.
const MIN_PARALLEL_COSINE: f64 = 0.999_998_5;

/// Displacements of some units along a direction that move them past all others, in an order that allows
/// disassembly.
fn offsets_along(assembly: &Assembly, own: &[usize], way: DVec3) -> Vec<f64> {
    let axes = frame(way);
    let others = (0..assembly.bodies.len()).filter(|k| !own.contains(k)).map(|k| &assembly.bodies[k]);
    let others = AxisProjection::new(&joined(others), &axes);
    let shadows: Vec<AxisProjection> =
        own.iter().map(|k| AxisProjection::new(&assembly.bodies[*k], &axes)).collect();
    // The other bodies form the last entry, and stay.
    let last = own.len();
    let stretch = |shadow: &AxisProjection, size: f64, order| AxisExtent {
        low: shadow.low,
        high: shadow.high,
        size,
        order,
    };
    let mut stretches: Vec<AxisExtent> =
        shadows.iter().zip(own).map(|(shadow, k)| stretch(shadow, 0.0, assembly.orders[*k])).collect();
    stretches.push(stretch(&others, f64::INFINITY, None));
    let mut meetings = PairContacts::new();
    for a in 0..last {
        for b in 0..a {
            meetings.insert([a, b], shadows[a].contact_with(&shadows[b], assembly.touch));
        }
        let past = others.contact_with(&shadows[a], assembly.touch);
        if past.meets || past.is_within {
            // The others block the unit downward, and the unit blocks them upward.
            meetings.insert(
                [last, a],
                PairContact { meets: true, blocks_up: true, blocks_down: false, is_within: false },
            );
        }
    }
    let mut found = offsets(&stretches, &meetings, assembly.gap);
    found.truncate(last);
    // A unit that nothing blocks moves by the gap, because a direction was given.
    found.iter().map(|offset| offset.max(assembly.gap)).collect()
}
