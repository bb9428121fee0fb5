//! [`film_points`]: the points that a camera's frame must contain to show a whole film.

use crate::parallel::prelude::*;
use glam::{DAffine3, DVec3};

use crate::animation::{Playing, Rigged};
use crate::error::Error;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::scene::cameras::framing::world_points;

/// Number of directions for extreme points. On a ball, the part outside all of them is half a percent of its
/// size, less than the margin of any frame.
const DIRECTION_COUNT: usize = 256;

/// Golden angle, radians. Directions at this spacing cover the sphere evenly.
const GOLDEN_ANGLE_RAD: f64 = 2.399_963_229_728_653;

/// The extreme points of a scene in all its poses, world.
///
/// Each entry of `poses` holds the clips that play, and a transform applied afterwards, such as that of a
/// camera that moves round the model.
///
/// # Errors
/// As [`Rigged::posed`].
pub fn film_points(rigged: &Rigged, poses: &[(Vec<Playing>, DAffine3)]) -> Result<Vec<DVec3>, Error> {
    let directions = directions();
    let still = poses.iter().any(|(playing, _)| playing.is_empty());
    let still = if still { outermost(&world_points(&rigged.posed(&[])?), &directions) } else { Vec::new() };
    let of = |(playing, moved): &(Vec<Playing>, DAffine3)| -> Result<Vec<DVec3>, Error> {
        let moved = |p: &DVec3| moved.transform_point3(*p);
        if playing.is_empty() {
            return Ok(still.iter().map(moved).collect());
        }
        let points = world_points(&rigged.posed(playing)?);
        Ok(outermost(&points, &directions).iter().map(moved).collect())
    };
    let found: Result<Vec<Vec<DVec3>>, Error> = poses.par_iter().map(of).collect();
    Ok(found?.concat())
}

/// Directions spread evenly over the sphere (Fibonacci lattice).
fn directions() -> Vec<DVec3> {
    let of = |number: usize| {
        let z = 1.0 - (2.0 * number as f64 + 1.0) / DIRECTION_COUNT as f64;
        let (radius, angle) = ((1.0 - z * z).max(0.0).sqrt(), GOLDEN_ANGLE_RAD * number as f64);
        DVec3::new(radius * cos(angle), radius * sin(angle), z)
    };
    (0..DIRECTION_COUNT).map(of).collect()
}

/// The points that are extreme in one of the directions.
fn outermost(points: &[DVec3], directions: &[DVec3]) -> Vec<DVec3> {
    if points.len() <= directions.len() {
        return points.to_vec();
    }
    let farthest = |direction: &DVec3| {
        let none = (f64::NEG_INFINITY, DVec3::ZERO);
        let further = |best: (f64, DVec3), p: &DVec3| {
            let own = p.dot(*direction);
            if own > best.0 { (own, *p) } else { best }
        };
        points.iter().fold(none, further).1
    };
    directions.par_iter().map(farthest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn outermost_points_of_a_ball_reach_98_percent_in_every_direction() {
        let ball: Vec<DVec3> = (0..20_000)
            .map(|i| {
                let z = 1.0 - (2.0 * f64::from(i) + 1.0) / 20_000.0;
                let angle = 1.3 * f64::from(i);
                let radius = (1.0 - z * z).sqrt();
                DVec3::new(radius * cos(angle), radius * sin(angle), z)
            })
            .collect();
        let kept = outermost(&ball, &directions());
        for direction in &ball[..500] {
            let reach = kept.iter().map(|p| p.dot(*direction)).fold(0.0, f64::max);
            assert!(reach > 0.985, "{direction} {reach}");
        }
    }

    #[test]
    fn film_points_apply_the_transform_of_each_pose() -> Result<(), Error> {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let rigged = Rigged::from(Scene::from_triangles(corners, [[0, 1, 2]])?);
        let moved = DAffine3::from_translation(DVec3::Z);
        let points = film_points(&rigged, &[(Vec::new(), DAffine3::IDENTITY), (Vec::new(), moved)])?;
        assert_eq!(points.len(), 6);
        assert_eq!(points[3], DVec3::Z);
        Ok(())
    }
}
