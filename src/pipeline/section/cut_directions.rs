//! [`long_sides`]: directions of the long straight sides of a cut face in the picture.

use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

use crate::edit::section::CutFaces;
use crate::geometry::numbers::portable_math::atan2;
use crate::scene::{Camera, Projection, Scene};

/// Angle within which hatching counts as parallel to a side, degrees.
pub(crate) const MAX_PARALLEL_DEG: f64 = 10.0;

/// Greatest difference between sides of one direction, degrees. It covers rounding.
const MAX_DIRECTION_SPREAD_DEG: f64 = 0.1;

/// Least total length of a long direction as a share of the longest direction. All sides of a regular polygon
/// are long. The small steps of a rounding next to a straight side are not.
const MIN_LENGTH_OF_LONGEST: f64 = 0.5;

/// The directions of the long sides of cut faces in the pictures of the cameras: degrees from the horizontal,
/// counter-clockwise, 0 to 180.
pub(crate) fn long_sides(scene: &Scene, faces: &CutFaces, cameras: &[Camera]) -> Vec<f64> {
    let border = border(scene, faces);
    cameras.iter().flat_map(|camera| long_directions(&border, camera)).collect()
}

/// The sides of the faces that belong to only one of their triangles, world.
fn border(scene: &Scene, faces: &CutFaces) -> Vec<[DVec3; 2]> {
    let Some(part) = scene.parts.get(faces.part) else { return Vec::new() };
    let Some(shape) = scene.geometry_of(part) else { return Vec::new() };
    let mut times: FxHashMap<[u32; 2], i32> = FxHashMap::default();
    let own = shape.triangles.iter().zip(&shape.triangle_material);
    let mut sides = Vec::new();
    for (triangle, _) in own.filter(|(_, material)| **material == faces.material) {
        for k in 0..3 {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            *times.entry([a.min(b), a.max(b)]).or_default() += 1;
            sides.push([a.min(b), a.max(b)]);
        }
    }
    sides.retain(|side| times.get(side) == Some(&1));
    let place = |v: u32| shape.positions.get(v as usize).map(|p| part.world_from_part.transform_point3(*p));
    sides.into_iter().filter_map(|[a, b]| Some([place(a)?, place(b)?])).collect()
}

/// The long directions of sides in the picture of a camera.
fn long_directions(sides: &[[DVec3; 2]], camera: &Camera) -> Vec<f64> {
    let [right, up, forward] = camera.axes();
    let place = |p: DVec3| {
        let p = p - camera.eye;
        let at = DVec2::new(p.dot(right), p.dot(up));
        match camera.projection {
            Projection::Orthographic { .. } => at,
            Projection::Perspective { .. } => at / p.dot(forward),
        }
    };
    let side = |ends: &[DVec3; 2]| {
        let way = place(ends[1]) - place(ends[0]);
        let angle = atan2(way.y, way.x).to_degrees().rem_euclid(180.0);
        (way.length() > 0.0 && angle.is_finite()).then_some((angle, way.length()))
    };
    let mut sides: Vec<(f64, f64)> = sides.iter().filter_map(side).collect();
    sides.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    // Each direction is that of its longest side, with the total length.
    let mut directions: Vec<(f64, f64)> = Vec::new();
    let mut first = f64::NEG_INFINITY;
    let mut longest = 0.0;
    for (angle, length) in sides {
        match directions.last_mut() {
            Some(direction) if angle - first < MAX_DIRECTION_SPREAD_DEG => {
                direction.1 += length;
                if length > longest {
                    (direction.0, longest) = (angle, length);
                }
            }
            _ => {
                directions.push((angle, length));
                (first, longest) = (angle, length);
            }
        }
    }
    // Directions near 0 and near 180 degrees are one.
    if let [first, .., last] = directions.as_slice()
        && first.0 + 180.0 - last.0 < MAX_DIRECTION_SPREAD_DEG
    {
        let both = first.1 + last.1;
        directions[0].1 = both;
        directions.pop();
    }
    let longest = directions.iter().map(|(_, length)| *length).fold(0.0, f64::max);
    directions.retain(|(_, length)| *length >= MIN_LENGTH_OF_LONGEST * longest);
    directions.into_iter().map(|(angle, _)| angle).collect()
}
