//! Bounds of parts in the frame of a camera: boxes and convex hulls, selected by name.

use glam::DVec3;
use kurbo::{Point, Rect};

use crate::geometry::names::glob::glob_matches;
use crate::geometry::plane::convex_hull::convex_hull;
use crate::scene::extent::drawn_points::DrawnPoints;
use crate::scene::{Camera, Scene};
use crate::view::Frame;

/// The bounds of a part in the frame of a camera, hidden or not.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PartExtent {
    /// Name of the part.
    pub part: String,
    /// Bounding box, in units of the frame.
    pub bounds: Rect,
    /// Convex hull, clockwise on the page.
    pub hull: Vec<Point>,
}

/// Whether a pattern matches the name of a part.
///
/// It may match the whole name, the name without its model (`head` for `hero/head`), or the model (`hero` for
/// all its parts).
#[must_use]
pub(crate) fn name_matches(glob: &str, name: &str) -> bool {
    let own = || {
        name.split_once('/')
            .is_some_and(|(model, part)| glob_matches(glob, part) || glob_matches(glob, model))
    };
    glob_matches(glob, name) || own()
}

/// The points of the parts that match a pattern, world.
pub(crate) fn part_points(scene: &Scene, glob: &str) -> Vec<DVec3> {
    DrawnPoints::of_parts(scene, |part| name_matches(glob, &part.name)).points
}

/// The bounds of the parts that match a pattern and are in front of the camera.
#[must_use]
pub(crate) fn find_part_bounds(scene: &Scene, camera: &Camera, glob: &str) -> Vec<PartExtent> {
    let frame = Frame::new(camera, DVec3::ZERO);
    let mut places = Vec::new();
    let drawn = DrawnPoints::of_parts(scene, |part| name_matches(glob, &part.name));
    for own in &drawn.parts {
        let Some(part) = scene.parts.get(own.part) else { continue };
        let seen = drawn.points.get(own.points.clone()).unwrap_or_default().iter().copied();
        let before = seen.filter(|p| !frame.perspective || frame.depth(*p) > 0.0);
        let image = before.map(|p| frame.image_from_camera(frame.camera_from_local(p)));
        let hull = convex_hull(image.map(|p| Point::new(p.x, p.y)).filter(|p| p.is_finite()).collect());
        let Some(first) = hull.first() else { continue };
        let bounds = hull.iter().fold(Rect::from_points(*first, *first), |rect, p| rect.union_pt(*p));
        places.push(PartExtent { part: part.name.clone(), bounds, hull });
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn name_matches_part_names_with_and_without_the_model() {
        for (glob, name) in
            [("head", "hero/head"), ("hero", "hero/head"), ("hero/h*", "hero/head"), ("head", "head")]
        {
            assert!(name_matches(glob, name), "{glob} {name}");
        }
        assert!(!name_matches("head", "hero/hand") && !name_matches("her", "hero/head"));
    }
}
