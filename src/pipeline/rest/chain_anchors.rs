//! [`Anchors`]: positions of line points on the model at rest, so that strokes persist while the model moves.
//!
//! A point of a chain is unprojected from the page into the world. The closest triangle of its part gives its
//! position on the surface. The same triangle of the resting part gives its rest position.

use std::sync::Arc;

use crate::parallel::prelude::*;
use glam::{DAffine3, DVec3};

use crate::chains::{Anchor, Chain, chain_identity};
use crate::geometry::names::name_ids::stable_ids;
use crate::geometry::numbers::portable_math::{cbrt, tan};
use crate::mesh::PartId;
use crate::mesh::bvh::triangle_tree::TriangleTree;
use crate::mesh::normals::triangle_area::has_own_area;
use crate::scene::{Camera, Geometry, Part, Projection, Scene};

/// Parts of a posed scene, with their rest positions.
#[derive(Debug)]
pub(crate) struct Anchors {
    /// One entry per geometry of the scene.
    resting: Vec<RestGeometry>,
    parts: Vec<PosedPart>,
    /// A stable number for each part.
    names: Vec<u64>,
}

/// Geometry at rest.
#[derive(Debug)]
struct RestGeometry {
    triangles: Arc<[[DVec3; 3]]>,
    middle: DVec3,
    diagonal: f64,
}

/// Part in its pose.
#[derive(Debug)]
struct PosedPart {
    geometry: usize,
    tree: TriangleTree,
    /// World units per diagonal of its geometry.
    size: f64,
    /// Transform from the geometry at rest to the world, and whether every corner now lies there.
    world_from_rest: DAffine3,
    is_at_rest: bool,
}

impl Anchors {
    /// The anchors of a posed scene and the same scene at rest. Geometries with equal numbers must have the
    /// same triangles.
    pub(crate) fn new(posed: &Scene, rest: &Scene) -> Self {
        let resting: Vec<RestGeometry> = rest.geometries.par_iter().map(RestGeometry::new).collect();
        let part = |(number, part): (usize, &Part)| {
            let is_it = |other: &&Part| other.name == part.name && other.geometry == part.geometry;
            let own = rest.parts.get(number).filter(is_it).or_else(|| rest.parts.iter().find(is_it));
            let own = own.map_or(part.world_from_part, |own| own.world_from_part);
            let world = |p: DVec3| part.world_from_part.transform_point3(p);
            let corners = posed.geometry_of(part).map(corners).unwrap_or_default();
            let corners: Vec<[DVec3; 3]> = corners.into_iter().map(|corners| corners.map(world)).collect();
            let diagonal = resting.get(part.geometry).map_or(1.0, |own| own.diagonal);
            let stretch = cbrt(part.world_from_part.matrix3.determinant().abs());
            let rests = resting.get(part.geometry).is_some_and(|resting| {
                let rest = resting.triangles.iter().map(|corners| corners.map(|p| own.transform_point3(p)));
                rest.eq(corners.iter().copied())
            });
            let size = stretch * diagonal;
            PosedPart {
                geometry: part.geometry,
                tree: TriangleTree::new(corners),
                size,
                world_from_rest: own,
                is_at_rest: rests,
            }
        };
        let parts = posed.parts.par_iter().enumerate().map(part).collect();
        let names = stable_ids(posed.parts.iter().map(|part| part.name.as_str()));
        Self { resting, parts, names }
    }

    /// Sets the anchor of every chain sample and names the chains. `margin` is the offset of the camera's
    /// frame on the page.
    pub(crate) fn anchor_chains(&self, chains: &mut [Chain], camera: &Camera, margin: kurbo::Vec2) {
        let [right, up, forward] = camera.axes();
        let perspective = match camera.projection {
            Projection::Perspective { fov_y_deg } => Some(tan(fov_y_deg.to_radians() / 2.0)),
            Projection::Orthographic { .. } => None,
        };
        // World units per page unit, at a depth.
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
        chain_identity::assign_identities(chains, &self.names);
    }

    /// Whether every part is in its rest position.
    pub(crate) fn rests(&self) -> bool {
        self.parts.iter().all(|part| part.is_at_rest)
    }

    /// The rest position of a point near a part, world.
    pub(crate) fn at_rest(&self, part: PartId, world: DVec3) -> Option<DVec3> {
        let part = self.parts.get(part.index())?;
        let (place, _) = self.rest_position(part, world)?;
        Some(part.world_from_rest.transform_point3(place))
    }

    /// The anchor of a point near a part.
    pub(crate) fn anchor_at(&self, part: PartId, world: DVec3) -> Option<Anchor> {
        self.anchor(self.parts.get(part.index())?, world, 1.0)
    }

    /// The position of a point near a part on its resting geometry.
    fn rest_position(&self, part: &PosedPart, world: DVec3) -> Option<(DVec3, &RestGeometry)> {
        let resting = self.resting.get(part.geometry)?;
        let nearest = part.tree.nearest(world)?;
        let [a, b, c] = resting.triangles.get(nearest.triangle as usize)?;
        Some((*a * nearest.weights.x + *b * nearest.weights.y + *c * nearest.weights.z, resting))
    }

    /// The anchor of a point near a part. `unit` is the length of a page unit there.
    fn anchor(&self, part: &PosedPart, world: DVec3, unit: f64) -> Option<Anchor> {
        let (place, resting) = self.rest_position(part, world).filter(|_| unit > 0.0)?;
        let place = (place - resting.middle) / resting.diagonal;
        let anchor = Anchor { rest_position: place.as_vec3().to_array(), scale: (part.size / unit) as f32 };
        (place.is_finite() && anchor.scale.is_finite()).then_some(anchor)
    }
}

impl RestGeometry {
    fn new(geometry: &Geometry) -> Self {
        let triangles = corners(geometry);
        // Faces without area are not drawn. They count only if there are no others.
        let counted = bounds(triangles.iter().filter(|corners| has_own_area(**corners)));
        let (low, high) = counted.or_else(|| bounds(triangles.iter())).unwrap_or_default();
        let diagonal = (high - low).length();
        let diagonal = if diagonal > 0.0 { diagonal } else { 1.0 };
        Self { middle: low / 2.0 + high / 2.0, diagonal, triangles: triangles.into() }
    }
}

/// The bounding box of triangle corners, without non-finite ones.
fn bounds<'a>(triangles: impl Iterator<Item = &'a [DVec3; 3]>) -> Option<(DVec3, DVec3)> {
    let finite = triangles.flatten().filter(|p| p.is_finite());
    finite.map(|p| (*p, *p)).reduce(|(low, high), (p, _)| (low.min(p), high.max(p)))
}

/// The corners of all triangles of a geometry. Invalid indices give NaN.
fn corners(geometry: &Geometry) -> Vec<[DVec3; 3]> {
    let corner = |vertex: u32| geometry.positions.get(vertex as usize).copied().unwrap_or(DVec3::NAN);
    geometry.triangles.iter().map(|triangle| triangle.map(corner)).collect()
}
