//! [`JointInfo`]: a joint of a skin.

use std::collections::BTreeSet;

use serde::Serialize;

use super::text_lists::named;
use crate::animation::Rig;

/// A joint of a skin.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct JointInfo {
    name: String,
    /// Name of the parent node.
    parent: Option<String>,
}

/// Joints of all skins without duplicates, in node order.
pub(crate) fn of_rig(rig: &Rig) -> Vec<JointInfo> {
    let numbers: BTreeSet<usize> = rig.skins.iter().flat_map(|skin| skin.joints.iter().copied()).collect();
    let nodes = numbers.into_iter().filter_map(|number| rig.nodes.get(number));
    let parent = |number: usize| rig.nodes.get(number).map(|node| node.name.clone());
    nodes.map(|node| JointInfo { name: node.name.clone(), parent: node.parent.and_then(parent) }).collect()
}

impl JointInfo {
    /// Entry of the joint in the text.
    pub(crate) fn line(&self) -> String {
        let parent =
            self.parent.as_deref().map_or_else(String::new, |parent| format!(", below {}", named(parent)));
        format!("{}{parent}", named(&self.name))
    }
}
