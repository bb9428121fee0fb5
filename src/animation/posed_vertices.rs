//! [`PosedVertices`]: positions of single vertices while clips play.

use glam::{DAffine3, DVec3};

use super::clip::Playing;
use super::rig::NodePoses;
use super::{DeformableMesh, Rigged};

/// A rigged scene at a moment, for queries of a few vertices. Much cheaper than posing the whole scene.
#[derive(Debug)]
pub struct PosedVertices<'a> {
    rigged: &'a Rigged,
    stance: NodePoses,
    /// Joint transforms of each geometry with a skin.
    joints: Vec<Option<Vec<DAffine3>>>,
}

impl Rigged {
    /// The rig while clips play. Clips that do not exist are ignored.
    #[must_use]
    pub fn at(&self, playing: &[Playing]) -> PosedVertices<'_> {
        let stance = self.rig.stance(playing);
        let joints = self.rig.forms.iter().map(|form| {
            let skin = form.skin.and_then(|skin| self.rig.skins.get(skin))?;
            Some(skin.transforms(&stance.world))
        });
        let joints = joints.collect();
        PosedVertices { rigged: self, stance, joints }
    }

    /// Node that moves a vertex of a part: for a skinned part the joint with the greatest weight, otherwise
    /// the node of the part. Indices are those of the stored scene.
    #[must_use]
    pub fn carrier(&self, part: usize, vertex: usize) -> Option<usize> {
        let node = self.rig.parts.get(part)?.0;
        let joint = || {
            let form = self.rig.forms.get(self.scene.parts.get(part)?.geometry)?;
            let skin = self.rig.skins.get(form.skin?)?;
            let (body, own) = body_of(&form.bodies, vertex)?;
            skin.joints.get(body.first_joint(own)?).copied()
        };
        Some(joint().unwrap_or(node))
    }
}

impl PosedVertices<'_> {
    /// Whether a part is visible. The index is that of the stored scene.
    #[must_use]
    pub fn is_shown(&self, part: usize) -> bool {
        let node = self.rigged.rig.parts.get(part).map(|(node, _)| *node);
        node.and_then(|node| self.stance.visible.get(node).copied()).unwrap_or(true)
    }

    /// Whether a part may have another position or shape than in another moment of the same scene.
    #[must_use]
    pub fn differs(&self, other: &Self, part: usize) -> bool {
        let Rigged { scene, rig } = self.rigged;
        let (Some((node, _)), Some(shown)) = (rig.parts.get(part), scene.parts.get(part)) else {
            return false;
        };
        let form = rig.forms.get(shown.geometry);
        let weights = |stance: &NodePoses| form.and_then(|form| stance.weights.get(form.node).cloned());
        form.is_some_and(|form| form.skin.is_some())
            || self.stance.world.get(*node) != other.stance.world.get(*node)
            || weights(&self.stance) != weights(&other.stance)
    }

    /// World position of a vertex of a part, both by their indices in the stored scene. `None` if there is no
    /// such vertex or its position is not finite.
    #[must_use]
    pub fn place(&self, part: usize, vertex: usize) -> Option<DVec3> {
        let Rigged { scene, rig } = self.rigged;
        let shown = scene.parts.get(part)?;
        let rest = *scene.geometries.get(shown.geometry)?.positions.get(vertex)?;
        let Some((node, within)) = rig.parts.get(part) else {
            return Some(shown.world_from_part.transform_point3(rest));
        };
        let form = rig.forms.get(shown.geometry);
        let body = form.and_then(|form| Some((body_of(&form.bodies, vertex)?, form.node)));
        let joints = self.joints.get(shown.geometry).and_then(Option::as_deref);
        let own = match body {
            Some(((body, own), node)) => body.place(own, self.stance.weights.get(node)?, joints)?,
            None => rest,
        };
        let is_skinned = form.is_some_and(|form| form.skin.is_some());
        let world = if is_skinned { DAffine3::IDENTITY } else { *self.stance.world.get(*node)? };
        Some((world * *within).transform_point3(own)).filter(|place| place.is_finite())
    }
}

/// Body that contains a vertex of a geometry, and the index of the vertex within it.
fn body_of(bodies: &[DeformableMesh], vertex: usize) -> Option<(&DeformableMesh, usize)> {
    let holds = |body: &&DeformableMesh| vertex >= body.start && vertex - body.start < body.positions.len();
    bodies.iter().find(holds).map(|body| (body, vertex - body.start))
}
