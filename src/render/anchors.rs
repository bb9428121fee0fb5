//! [`Anchors`]: where on the model at rest the points of lines are, so that strokes last while it moves.
//!
//! A point of a chain is put back from the page into the world; the nearest triangle of its part says what place on the
//! surface that is, and the same triangle of the part at rest where this place rests.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::chain::{Anchor, Chain, identity};
use crate::math::function::{cbrt, tan};
use crate::math::identity::identities;
use crate::scene::{Camera, Geometry, Projection, Scene};
use crate::trees::nearest::NearestTree;

/// The parts of a posed scene, and how they rest.
#[derive(Debug)]
pub(super) struct Anchors {
    /// One a geometry of the scene that parts show.
    resting: Vec<Resting>,
    parts: Vec<Posed>,
    /// What tells parts apart.
    names: Vec<u64>,
}

/// A geometry as it rests.
#[derive(Debug)]
struct Resting {
    triangles: Arc<[[DVec3; 3]]>,
    middle: DVec3,
    diagonal: f64,
}

/// A part as it is posed.
#[derive(Debug)]
struct Posed {
    geometry: usize,
    tree: NearestTree,
    /// World units in a diagonal of its geometry.
    size: f64,
}

impl Anchors {
    /// Of a scene and its geometries at rest, which have the same triangles.
    pub fn new(posed: &Scene, rest: &[Geometry]) -> Self {
        let resting: Vec<Resting> = rest.par_iter().map(Resting::new).collect();
        let part = |part: &crate::scene::Part| {
            let world = |p: DVec3| part.world_from_part.transform_point3(p);
            let corners = posed.geometry_of(part).map(corners).unwrap_or_default();
            let corners: Vec<[DVec3; 3]> = corners.into_iter().map(|corners| corners.map(world)).collect();
            let diagonal = resting.get(part.geometry).map_or(1.0, |own| own.diagonal);
            let stretch = cbrt(part.world_from_part.matrix3.determinant().abs());
            Posed { geometry: part.geometry, tree: NearestTree::new(&corners), size: stretch * diagonal }
        };
        let parts = posed.parts.par_iter().map(part).collect();
        let names = identities(posed.parts.iter().map(|part| part.name.as_str()));
        Self { resting, parts, names }
    }

    /// Tells chains, which lie in the frame of a camera moved by `margin`, where on the model they are, and names them.
    pub fn ask(&self, chains: &mut [Chain], camera: &Camera, margin: kurbo::Vec2) {
        let [right, up, forward] = camera.axes();
        let perspective = match camera.projection {
            Projection::Perspective { fov_y_deg } => Some(tan(fov_y_deg.to_radians() / 2.0)),
            Projection::Orthographic { .. } => None,
        };
        // World units in a unit of the page, at a depth.
        let unit = |depth: f64| match (perspective, camera.projection) {
            (Some(tangent), _) => 2.0 * tangent * depth / camera.height,
            (None, Projection::Orthographic { height }) => height / camera.height,
            (None, Projection::Perspective { .. }) => 0.0,
        };
        chains.par_iter_mut().for_each(|chain| {
            let Some(part) = self.parts.get(chain.part.index()) else { return };
            for (point, sample) in chain.points.iter().zip(&mut chain.samples) {
                let (unit, p) = (unit(sample.depth), *point - margin);
                let aside = right * ((p.x - camera.width / 2.0) * unit);
                let above = up * ((camera.height / 2.0 - p.y) * unit);
                let world = camera.eye + forward * sample.depth + aside + above;
                sample.anchor = self.anchor(part, world, unit).unwrap_or_default();
            }
        });
        identity::name(chains, &self.names);
    }

    /// Where a point near a part is on it; a unit of the page is `unit` long there.
    fn anchor(&self, part: &Posed, world: DVec3, unit: f64) -> Option<Anchor> {
        let resting = self.resting.get(part.geometry)?;
        let nearest = part.tree.nearest(world).filter(|_| unit > 0.0)?;
        let [a, b, c] = resting.triangles.get(nearest.triangle as usize)?;
        let place = *a * nearest.weights.x + *b * nearest.weights.y + *c * nearest.weights.z;
        let place = (place - resting.middle) / resting.diagonal;
        let anchor = Anchor { place: place.as_vec3().to_array(), scale: (part.size / unit) as f32 };
        (place.is_finite() && anchor.scale.is_finite()).then_some(anchor)
    }
}

impl Resting {
    fn new(geometry: &Geometry) -> Self {
        let triangles = corners(geometry);
        let finite = || triangles.iter().flatten().copied().filter(|p| p.is_finite());
        let low = finite().reduce(DVec3::min).unwrap_or_default();
        let high = finite().reduce(DVec3::max).unwrap_or_default();
        let diagonal = (high - low).length();
        let diagonal = if diagonal > 0.0 { diagonal } else { 1.0 };
        Self { middle: low / 2.0 + high / 2.0, diagonal, triangles: triangles.into() }
    }
}

/// The corners of all triangles of a geometry; of those that refer to nothing none is a number.
fn corners(geometry: &Geometry) -> Vec<[DVec3; 3]> {
    let corner = |vertex: u32| geometry.positions.get(vertex as usize).copied().unwrap_or(DVec3::NAN);
    geometry.triangles.iter().map(|triangle| triangle.map(corner)).collect()
}
