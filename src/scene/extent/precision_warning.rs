//! Warns about coordinates whose precision is too coarse for the size of the model, such as a house at its
//! map position in single precision.
//!
//! The step is the distance between neighbouring values that a coordinate can have:
//!
//! - In single precision, the distance between neighbouring `f32` numbers at the largest coordinate.
//! - In text files, it is measured. If all numbers fit in single precision, the rule above applies. Otherwise
//!   the step is the last decimal that occurs, if there are at most six. Whole numbers count as exact.

use crate::geometry::space::bounds::Bounds;
use glam::DVec3;

use crate::scene::tolerances::{INTEGER_ROUNDING, MAX_COORDINATE_STEP_OF_MODEL};
use crate::scene::{Geometry, Scene};

/// Returns the scene, with a warning if its coordinates are too coarse.
pub(crate) fn with_precision_warning(mut scene: Scene) -> Scene {
    warn_of_coarse_steps(&mut scene);
    scene
}

/// Adds a warning if the coordinate steps of a part would be visible in a drawing of the model.
pub(crate) fn warn_of_coarse_steps(scene: &mut Scene) {
    // Early exit: near the origin every format is precise enough, and few models are far from it.
    let far: Vec<bool> = scene.geometries.iter().map(is_far).collect();
    if !far.contains(&true) {
        return;
    }
    let Some((low, high)) = scene.bounds() else { return };
    let size = (high - low).length();
    let steps: Vec<DVec3> = scene
        .geometries
        .iter()
        .zip(&far)
        .map(|(geometry, far)| if *far { coordinate_steps(geometry) } else { DVec3::ZERO })
        .collect();
    let mut worst = (MAX_COORDINATE_STEP_OF_MODEL * size, "");
    let mut count = 0_u64;
    for part in &scene.parts {
        let Some(step) = scene.geometry_of(part).and_then(|_| steps.get(part.geometry)) else { continue };
        let turned = part.world_from_part.matrix3;
        let step = turned.x_axis.abs() * step.x + turned.y_axis.abs() * step.y + turned.z_axis.abs() * step.z;
        let step = step.max_element();
        if step > MAX_COORDINATE_STEP_OF_MODEL * size {
            count += 1;
            if step > worst.0 {
                worst = (step, part.name.as_str());
            }
        }
    }
    if count == 0 {
        return;
    }
    let others = match count - 1 {
        0 => String::new(),
        others => format!("; {others} more parts like it"),
    };
    let (step, name, size) = (short(worst.0), worst.1, short(size));
    scene.warnings.note(format!(
        "part `{name}`: its coordinates have steps of {step}, too coarse for a model with a size of {size}: edges are off by as much; \
         move the model near the origin before it is exported{others}"
    ));
}

/// Whether single precision at the largest coordinates is too coarse for the size of the geometry.
fn is_far(geometry: &Geometry) -> bool {
    let around = Bounds::of_many(&geometry.positions);
    let largest = around.largest_coordinate();
    largest.is_finite() && single_step(largest) > MAX_COORDINATE_STEP_OF_MODEL * around.diagonal()
}

/// Coordinate step along each axis; 0 if all values are equal or exact.
fn coordinate_steps(geometry: &Geometry) -> DVec3 {
    let all =
        |holds: &dyn Fn(f64) -> bool| geometry.positions.iter().all(|p| p.to_array().into_iter().all(holds));
    let is_single = geometry.single_precision
        || (all(&|value| f64::from(value as f32) == value) && !all(&|value| value.fract() == 0.0));
    let along = |axis: usize| {
        let values = geometry.positions.iter().map(|p| p.to_array()[axis]);
        let (low, high) = values
            .clone()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        if low >= high {
            return 0.0;
        }
        let is_text = !geometry.single_precision;
        // With two values only, as for a box, few digits are no sign of rounding.
        if is_text && values.clone().all(|value| value == low || value == high) {
            return 0.0;
        }
        if is_single {
            return single_step(low.abs().max(high.abs()));
        }
        let divides = |step: f64| values.clone().all(|value| is_multiple(value, step));
        if divides(1.0) {
            return 0.0;
        }
        // Far from the origin, double precision holds no more decimals.
        (1..=6).map(|digits| 0.1_f64.powi(digits)).find(|step| divides(*step)).unwrap_or(0.0)
    };
    DVec3::new(along(0), along(1), along(2))
}

/// Whether a number is a multiple of a step, except for rounding of double precision.
fn is_multiple(value: f64, step: f64) -> bool {
    let times = value / step;
    (times - times.round()).abs() <= INTEGER_ROUNDING * times.abs()
}

/// Distance between a number and the next one in single precision.
fn single_step(value: f64) -> f64 {
    let value = value as f32;
    f64::from(value.next_up()) - f64::from(value)
}

/// Rounds a number to three significant digits, for messages.
fn short(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use glam::DAffine3;

    use super::*;
    use crate::scene::Part;

    /// A rotated house of 10.37 by 8.11 by 6 at a position.
    fn house(at: DVec3, single_precision: bool, round: impl Fn(f64) -> f64) -> Scene {
        let corner = |k: u32| {
            let [x, y, z] = [10.37, 8.11, 6.0];
            let p = DVec3::new(x * f64::from(k & 1), y * f64::from(k >> 1 & 1), z * f64::from(k >> 2));
            let turned = DVec3::new(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z / 3.0);
            DVec3::from_array((at + turned).to_array().map(&round))
        };
        let geometry = Geometry {
            positions: (0..8).map(corner).collect(),
            triangles: vec![[0, 1, 2], [1, 3, 2], [4, 6, 5], [5, 6, 7]],
            single_precision,
            ..Geometry::default()
        };
        let part = Part { name: "house".into(), geometry: 0, world_from_part: DAffine3::IDENTITY };
        let mut scene = Scene { geometries: vec![geometry], parts: vec![part], ..Scene::default() };
        warn_of_coarse_steps(&mut scene);
        scene
    }

    const MAP_ORIGIN: DVec3 = DVec3::new(451_234.0, 5_412_345.0, 410.0);

    #[test]
    fn single_precision_far_from_the_origin_gives_a_precision_warning() {
        let single = |value: f64| f64::from(value as f32);
        let lines = house(MAP_ORIGIN, true, single).warnings.lines();
        assert_eq!(lines.len(), 1);
        for word in ["part `house`", "steps of 0.5,", "size of 18", "move the model near the origin"] {
            assert!(lines[0].contains(word), "{word}: {}", lines[0]);
        }
        assert!(house(DVec3::ZERO, true, single).warnings.is_empty());
        // A tenth of a millimetre at ten metres.
        assert!(house(DVec3::new(1000.0, 0.0, 0.0), true, single).warnings.is_empty());
    }

    #[test]
    fn few_decimals_far_from_the_origin_give_a_precision_warning() {
        let tenths = |value: f64| (value * 10.0).round() / 10.0;
        assert!(house(MAP_ORIGIN, false, tenths).warnings.lines()[0].contains("steps of 0.1,"));
        let single = |value: f64| f64::from(value as f32);
        assert!(house(MAP_ORIGIN, false, single).warnings.lines()[0].contains("steps of 0.5,"));
        for fine in [|value: f64| (value * 1e6).round() / 1e6, |value: f64| value, f64::round] {
            assert!(
                house(MAP_ORIGIN, false, fine).warnings.is_empty(),
                "{:?}",
                house(MAP_ORIGIN, false, fine).warnings
            );
        }
        assert!(house(DVec3::ZERO, false, tenths).warnings.is_empty());
        // The coordinates of an axis-aligned box have few decimals and are exact.
        let mut scene = house(DVec3::ZERO, false, |value| value);
        for (k, position) in scene.geometries[0].positions.iter_mut().enumerate() {
            let side = |bit: usize| if k >> bit & 1 == 0 { 0.5 } else { 10.5 };
            *position = MAP_ORIGIN + DVec3::new(side(0), side(1), side(2));
        }
        warn_of_coarse_steps(&mut scene);
        assert!(scene.warnings.is_empty(), "{}", scene.warnings);
    }

    #[test]
    fn moved_and_large_models_give_no_precision_warning() {
        let mut scene = house(DVec3::ZERO, true, |value| f64::from(value as f32));
        scene.parts[0].world_from_part = DAffine3::from_translation(MAP_ORIGIN);
        warn_of_coarse_steps(&mut scene);
        assert!(scene.warnings.is_empty());
        // A large model is drawn at a small scale.
        let mut scene = house(MAP_ORIGIN, true, |value| f64::from(value as f32));
        scene.warnings = crate::scene::Warnings::default();
        let far = DAffine3::from_translation(DVec3::new(1e5, 0.0, 0.0));
        scene.parts.push(Part { world_from_part: far, ..scene.parts[0].clone() });
        warn_of_coarse_steps(&mut scene);
        assert!(scene.warnings.is_empty());
    }
}
