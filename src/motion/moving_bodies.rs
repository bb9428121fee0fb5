//! Bodies of a scene, and the choice of those that leave motion lines.

use super::options::{MotionOptions, Speed};
use crate::animation::Rigged;
use crate::geometry::names::name_ids::stable_ids;
use crate::geometry::numbers::noise::hash;

/// Default speed limit in model sizes per second. Faster bodies leave lines if nothing else selects bodies.
const MIN_SPEED_SIZES_PER_S: f64 = 0.5;

/// Unit of motion: a part, or the vertices that one joint of its skin moves most.
pub(crate) struct MovingBody {
    /// Index of the part in the file.
    pub part: usize,
    /// Node or joint that moves it.
    pub node: usize,
    /// Stable identity at all times.
    pub identity: u64,
    /// For a skinned part, whether each vertex belongs to this body. `None` for other parts, where all do.
    owned_vertices: Option<Vec<bool>>,
}

impl MovingBody {
    /// Whether it is moved by a joint of a skin.
    pub(crate) fn is_joint(&self) -> bool {
        self.owned_vertices.is_some()
    }

    /// Whether a vertex of the part belongs to it.
    pub(crate) fn holds(&self, vertex: u32) -> bool {
        self.owned_vertices.as_ref().is_none_or(|own| own.get(vertex as usize).copied().unwrap_or(false))
    }
}

/// The bodies of the moving parts of a scene: whole parts, and skinned parts joint by joint.
pub(crate) fn bodies(rigged: &Rigged, moves: impl Fn(usize) -> bool) -> Vec<MovingBody> {
    let (scene, rig) = (&rigged.scene, &rigged.rig);
    let parts = stable_ids(scene.parts.iter().map(|part| part.name.as_str()));
    let mut bodies = Vec::new();
    for (part, ((node, _), shown)) in
        rig.parts.iter().zip(&scene.parts).enumerate().filter(|(part, _)| moves(*part))
    {
        let identity = parts.get(part).copied().unwrap_or_default();
        let is_skinned = rig.forms.get(shown.geometry).is_some_and(|form| form.skin.is_some());
        if !is_skinned {
            bodies.push(MovingBody { part, node: *node, identity, owned_vertices: None });
            continue;
        }
        let count = scene.geometries.get(shown.geometry).map_or(0, |geometry| geometry.positions.len());
        let carriers: Vec<usize> =
            (0..count).map(|vertex| rigged.carrier(part, vertex).unwrap_or(*node)).collect();
        let mut joints = carriers.clone();
        joints.sort_unstable();
        joints.dedup();
        bodies.extend(joints.into_iter().map(|joint| MovingBody {
            part,
            node: joint,
            identity: hash(identity, &[joint as u64]),
            owned_vertices: Some(carriers.iter().map(|carrier| *carrier == joint).collect()),
        }));
    }
    bodies
}

/// Selection of bodies by name, by the file, or by speed.
pub(crate) struct BodySelection<'a> {
    /// Whether bodies that are fast enough on the page leave lines.
    pub by_page_speed: bool,
    rigged: &'a Rigged,
    options: &'a MotionOptions,
    /// Whether each node is selected, itself or through an ancestor.
    nodes: Vec<bool>,
    /// Speed above which bodies are selected, model units per second.
    pub speed: Option<f64>,
}

impl<'a> BodySelection<'a> {
    pub(crate) fn new(rigged: &'a Rigged, options: &'a MotionOptions) -> Self {
        let rig = &rigged.rig;
        let mut nodes = vec![false; rig.nodes.len()];
        for &number in &rig.order {
            let Some(node) = rig.nodes.get(number) else { continue };
            let above = node.parent.and_then(|parent| nodes.get(parent).copied()).unwrap_or(false);
            if let Some(own) = nodes.get_mut(number) {
                *own =
                    above || node.leaves_lines || options.parts.iter().any(|name| name.matches(&node.name));
            }
        }
        let speed = match options.speed {
            Some(Speed::Model(speed)) => Some(speed),
            Some(Speed::Page(_)) => None,
            None if !options.parts.is_empty() || nodes.contains(&true) => None,
            None => rigged
                .scene
                .bounds()
                .map(|(least, greatest)| MIN_SPEED_SIZES_PER_S * least.distance(greatest)),
        };
        Self { by_page_speed: matches!(options.speed, Some(Speed::Page(_))), rigged, options, nodes, speed }
    }

    /// Whether a body at a speed leaves lines in every view.
    pub(crate) fn selects(&self, body: &MovingBody, speed: f64) -> bool {
        let named = |part: usize| {
            let name = self.rigged.scene.parts.get(part).map_or("", |part| &part.name);
            let node = self.rigged.rig.parts.get(part).map(|(node, _)| *node);
            self.options.parts.iter().any(|glob| glob.matches(name))
                || node.is_some_and(|node| self.is_marked(node))
        };
        self.speed.is_some_and(|least| speed > least) || self.is_marked(body.node) || named(body.part)
    }

    fn is_marked(&self, node: usize) -> bool {
        self.nodes.get(node).copied().unwrap_or(false)
    }
}
