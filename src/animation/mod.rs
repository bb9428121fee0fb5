//! Poses: positions of parts and vertices of a scene while clips play.
//!
//! ```
//! use ligne::animation::{Playing, Rigged};
//!
//! let pump = Rigged::open("examples/models/pump.glb")?;
//! assert!(pump.clips().is_empty());
//! assert_eq!(pump.posed(&[])?.parts, pump.scene.parts);
//! assert!(pump.posed(&[Playing::all(0, 1.5)]).is_err());
//! # Ok::<(), ligne::Error>(())
//! ```
//!
//! 1. [`track`] interpolates keys in time; a [`clip`] is a set of tracks with their targets.
//! 2. [`rig`] mixes the clips that play into a transform, weights and visibility for each node.
//! 3. [`deformable_mesh`] moves vertices by morph targets, then by the joints of a skin.
//! 4. `animated_values` gives cameras, lights and materials their values; [`material_factors`] converts those
//!    of materials.
//!
//! [`posed_vertices`] gives the positions of single vertices without posing the whole scene. `tolerances`
//! holds the smallest quaternion.

mod animated_values;
pub(crate) mod clip;
pub(crate) mod deformable_mesh;
pub(crate) mod material_factors;
pub(crate) mod posed_vertices;
pub(crate) mod rig;
mod tolerances;
pub(crate) mod track;

pub(crate) use clip::{
    AnimationTarget, CameraProperty, ClipChannel, LightProperty, MaterialProperty, NodeProperty,
};
pub use clip::{Clip, Playing};
pub(crate) use deformable_mesh::DeformableMesh;
pub(crate) use material_factors::MaterialFactors;
pub(crate) use posed_vertices::PosedVertices;
pub(crate) use rig::Rig;
pub(crate) use track::{Interpolation, Track};

use std::collections::BTreeSet;

use glam::{DAffine3, DVec3};

use crate::error::Error;
use crate::scene::{Camera, LightKind, NamedCamera, Scene};
use animated_values::AnimatedValues;
use rig::{NodeAttachment, NodePoses};

/// A scene in its stored pose, with the rig that animates it.
#[derive(Debug, Clone, Default)]
pub struct Rigged {
    /// The scene in the stored pose. It also contains parts and lights that are hidden in that pose and that
    /// a clip shows at some time; [`Rigged::posed`] drops these while they are hidden.
    ///
    /// The rig refers to parts, geometries, cameras and lights by index. Remove parts from the result of
    /// `posed`, not from this scene.
    pub scene: Scene,
    /// The rig; empty for formats without animation.
    pub(crate) rig: Rig,
}

impl From<Scene> for Rigged {
    /// A scene without animation.
    fn from(scene: Scene) -> Self {
        Self { scene, rig: Rig::default() }
    }
}

impl Rigged {
    /// The clips of the model. [`Playing`] refers to them by index.
    #[must_use]
    pub fn clips(&self) -> &[Clip] {
        &self.rig.clips
    }

    /// The scene while clips play; the stored pose if none does.
    ///
    /// # Errors
    /// If a clip does not exist, if a time or a weight is not a number, or if a posed coordinate is not
    /// finite.
    pub fn posed(&self, playing: &[Playing]) -> Result<Scene, Error> {
        self.check(playing)?;
        if playing.is_empty() && !self.hides() {
            return Ok(self.scene.clone());
        }
        let mut scene = self.scene.clone();
        if playing.is_empty() {
            self.keep_shown(&self.rig.stance(playing), &mut scene);
            return Ok(scene);
        }
        let rig = &self.rig;
        let stance = self.stance(playing)?;
        self.move_vertices(&stance, &mut scene)?;
        let skinned: Vec<bool> = rig.forms.iter().map(|form| form.skin.is_some()).collect();
        for (part, (node, node_from_part)) in scene.parts.iter_mut().zip(&rig.parts) {
            // The joints already transform a skinned mesh to world space.
            let is_skinned = skinned.get(part.geometry).copied().unwrap_or(false);
            let world = if is_skinned { DAffine3::IDENTITY } else { stance.world[*node] };
            part.world_from_part = world * *node_from_part;
        }
        let values = AnimatedValues::new(&rig.clips, playing);
        for (named_camera, rigged_camera) in scene.cameras.iter_mut().zip(&rig.cameras) {
            named_camera.camera = now_camera(&named_camera.camera, *rigged_camera, &stance, &values);
        }
        for (light, rigged_light) in scene.lights.iter_mut().zip(&rig.lights) {
            values.light(rigged_light.number, light);
            light.kind = moved_light(light.kind, stance.world[rigged_light.node]);
        }
        for (number, (material, rest)) in scene.materials.iter_mut().zip(&rig.materials).enumerate() {
            if let Some(now) = values.material(number, rest) {
                now.apply_to(material);
            }
        }
        self.keep_shown(&stance, &mut scene);
        Ok(scene)
    }

    /// Whether any parts or lights are hidden in the stored pose.
    #[must_use]
    pub fn hides(&self) -> bool {
        let rig = &self.rig;
        let nodes = rig.parts.iter().map(|(node, _)| *node).chain(rig.lights.iter().map(|held| held.node));
        if rig.nodes.iter().all(|node| node.visible) {
            return false;
        }
        let stance = rig.stance(&[]);
        nodes.into_iter().any(|node| stance.visible.get(node) == Some(&false))
    }

    /// Removes the parts and lights of hidden nodes from a scene.
    fn keep_shown(&self, stance: &NodePoses, scene: &mut Scene) {
        let shown = |node: usize| stance.visible.get(node).copied().unwrap_or(true);
        let mut nodes = self.rig.parts.iter().map(|(node, _)| *node);
        scene.parts.retain(|_| nodes.next().is_none_or(shown));
        let mut nodes = self.rig.lights.iter().map(|held| held.node);
        scene.lights.retain(|_| nodes.next().is_none_or(shown));
    }

    /// The cameras of the scene while clips play; cheaper than [`Rigged::posed`].
    ///
    /// # Errors
    /// As [`Rigged::posed`].
    pub fn cameras(&self, playing: &[Playing]) -> Result<Vec<NamedCamera>, Error> {
        self.check(playing)?;
        if playing.is_empty() {
            return Ok(self.scene.cameras.clone());
        }
        let stance = self.stance(playing)?;
        let values = AnimatedValues::new(&self.rig.clips, playing);
        let moved = |(named, held): (&NamedCamera, &NodeAttachment)| {
            let camera = now_camera(&named.camera, *held, &stance, &values);
            NamedCamera { camera, ..named.clone() }
        };
        Ok(self.scene.cameras.iter().zip(&self.rig.cameras).map(moved).collect())
    }

    /// Keeps the parts that [`Scene::keep_parts`] keeps, in the scene and in the rig.
    pub fn keep_parts(&mut self, only: &[String], hide: &[String]) {
        let names: Vec<String> = self.scene.parts.iter().map(|part| part.name.clone()).collect();
        self.scene.keep_parts(only, hide);
        // Parts with equal names are kept or removed together, so the names identify the remaining parts.
        let kept: BTreeSet<&str> = self.scene.parts.iter().map(|part| part.name.as_str()).collect();
        let mut stays = names.iter().map(|name| kept.contains(name.as_str()));
        self.rig.parts.retain(|_| stays.next().unwrap_or(true));
    }

    /// Poses of the nodes while clips play.
    fn stance(&self, playing: &[Playing]) -> Result<NodePoses, Error> {
        let stance = self.rig.stance(playing);
        match stance.world.iter().position(|world| !world.is_finite()) {
            Some(node) => {
                Err(Error::new("its transform is not finite at this time").at(format!("node {node}")))
            }
            None => Ok(stance),
        }
    }

    /// Returns an error for clips that do not exist and for invalid times and weights.
    fn check(&self, playing: &[Playing]) -> Result<(), Error> {
        for Playing { clip, time, weight } in playing {
            if *clip >= self.rig.clips.len() {
                let count = self.rig.clips.len();
                return Err(Error::new(format!("there is no clip {clip}; the file has {count}")));
            }
            if !(time.is_finite() && weight.is_finite() && *weight >= 0.0) {
                return Err(Error::new(format!("no time or no weight: {time} s, {weight}"))
                    .remedy("give finite numbers, and no weight below 0"));
            }
        }
        Ok(())
    }

    fn move_vertices(&self, stance: &NodePoses, scene: &mut Scene) -> Result<(), Error> {
        for (geometry, form) in scene.geometries.iter_mut().zip(&self.rig.forms) {
            let joints = form
                .skin
                .and_then(|skin| self.rig.skins.get(skin))
                .map(|skin| skin.transforms(&stance.world));
            for body in &form.bodies {
                let (mut positions, mut normals) = (body.positions.clone(), body.normals.clone());
                body.pose((&mut positions, &mut normals), &stance.weights[form.node], joints.as_deref());
                if positions
                    .iter()
                    .zip(&body.positions)
                    .any(|(now, rest)| rest.is_finite() && !now.is_finite())
                {
                    return Err(
                        Error::new("a vertex is not finite at this time").at(format!("node {}", form.node))
                    );
                }
                let range = body.start..body.start + positions.len();
                let finite = |(to, from): (&mut DVec3, DVec3)| {
                    if from.is_finite() {
                        *to = from;
                    }
                };
                geometry
                    .positions
                    .get_mut(range.clone())
                    .into_iter()
                    .flatten()
                    .zip(positions)
                    .for_each(finite);
                let to = geometry.normals.get_mut(range).into_iter().flatten();
                to.zip(normals).for_each(|(to, from)| *to = from);
            }
        }
        Ok(())
    }
}

/// Camera with its animated properties, at the present pose of its node.
fn now_camera(camera: &Camera, held: NodeAttachment, stance: &NodePoses, values: &AnimatedValues) -> Camera {
    moved_camera(&values.camera(held.number, *camera), stance.world[held.node])
}

/// Camera at the present pose of its node: at the origin, looking along -z with y up.
fn moved_camera(camera: &Camera, world: DAffine3) -> Camera {
    let directions = [DVec3::NEG_Z, DVec3::Y].map(|axis| world.transform_vector3(axis).try_normalize());
    match directions {
        [Some(forward), Some(up)] => {
            Camera { eye: world.translation, target: world.translation + forward, up, ..*camera }
        }
        _ => *camera,
    }
}

/// Light at the present pose of its node: at the origin, shining along -z.
fn moved_light(kind: LightKind, world: DAffine3) -> LightKind {
    let along = |before: DVec3| world.transform_vector3(DVec3::NEG_Z).try_normalize().unwrap_or(before);
    match kind {
        LightKind::Directional { direction } => LightKind::Directional { direction: along(direction) },
        LightKind::Point { .. } => LightKind::Point { position: world.translation },
        LightKind::Spot { direction, inner_angle, outer_angle, .. } => LightKind::Spot {
            position: world.translation,
            direction: along(direction),
            inner_angle,
            outer_angle,
        },
    }
}
