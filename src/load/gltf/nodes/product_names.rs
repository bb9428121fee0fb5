//! Product names for the nodes of files written by Open CASCADE, for example by STEP converters.
//!
//! A STEP file names products, and sometimes their occurrences in an assembly. Open CASCADE writes a node for
//! each occurrence. Two kinds of nodes have no name that a user would recognise:
//!
//! - A node called `=>[0:1:1:3]` is a reference in Open CASCADE's own document. The product's name is on the
//!   parent node, or on the node's mesh if the assembly has several children.
//! - A node called `NAUO12` or `12` has the number of its occurrence. The product's name is on its mesh.
//!
//! Both get the product's name, so that `--only` and `--hide` can select parts by it.

use super::hierarchy::parents;
use crate::load::gltf::json::Root;
use crate::scene::Warnings;

/// Start of `asset.generator` in files of Open CASCADE.
const OPEN_CASCADE: &str = "Open CASCADE";

/// Names nodes after their products, if Open CASCADE wrote the file.
pub(crate) fn name_after_products(root: &mut Root) {
    if !root.asset.generator.as_ref().is_some_and(|generator| generator.starts_with(OPEN_CASCADE)) {
        return;
    }
    // Invalid children are reported when the hierarchy is read.
    let Ok(parents) = parents(&root.nodes, &mut Warnings::default()) else { return };
    let names: Vec<Option<String>> =
        (0..root.nodes.len()).map(|node| product(root, &parents, node)).collect();
    for (node, name) in root.nodes.iter_mut().zip(names) {
        if name.is_some() {
            node.name = name;
        }
    }
}

/// Product name for a node without a usable name.
fn product(root: &Root, parents: &[Option<usize>], index: usize) -> Option<String> {
    let node = root.nodes.get(index)?;
    let own = node.name.as_deref()?;
    let of_mesh = || {
        let name = root.meshes.get(node.mesh?)?.name.as_deref()?;
        is_product(name).then(|| name.to_owned())
    };
    if is_number(own) {
        return of_mesh();
    }
    if !is_reference(own) {
        return None;
    }
    let mut above = parents.get(index).copied().flatten();
    let is_one_of_several =
        above.and_then(|above| root.nodes.get(above)).is_some_and(|above| above.children.len() > 1);
    if let Some(name) = of_mesh().filter(|_| is_one_of_several) {
        return Some(name);
    }
    // A damaged file may have a cycle of nodes.
    for _ in 0..root.nodes.len() {
        let Some(parent) = above else { break };
        match root.nodes.get(parent).and_then(|node| node.name.as_deref()) {
            Some(name) if is_product(name) => return Some(name.to_owned()),
            _ => above = parents.get(parent).copied().flatten(),
        }
    }
    of_mesh()
}

fn is_product(name: &str) -> bool {
    !name.is_empty() && !is_reference(name) && !is_number(name)
}

/// Whether a name is a reference such as `=>[0:1:1:3]`.
fn is_reference(name: &str) -> bool {
    let inner = name.strip_prefix("=>[").and_then(|rest| rest.strip_suffix(']'));
    inner.is_some_and(|inner| inner.chars().all(|c| c.is_ascii_digit() || c == ':'))
}

/// Whether a name is the number of an occurrence: `NAUO12` or `12`.
fn is_number(name: &str) -> bool {
    let digits = name.strip_prefix("NAUO").unwrap_or(name);
    !digits.is_empty() && digits.chars().all(|c| c.is_ascii_digit())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn names(generator: &str) -> Vec<String> {
        let json = r#"{"asset":{"version":"2.0","generator":"GENERATOR"},
            "meshes":[{"primitives":[],"name":"bolt M6"},{"primitives":[],"name":"=>[0:1:1:4]"}],
            "nodes":[{"name":"frame","children":[1,4]},{"name":"lid","children":[2,5]},{"name":"=>[0:1:1:3]","mesh":1},
            {"name":"NAUO7","mesh":0},{"name":"12","mesh":1},{"name":"=>[0:1:1:9]","children":[6]},{"name":"=>[0:1:1:3]"},
            {"name":"=>[0:1:1:3]","mesh":0},{"name":"=>[a]"},{"name":"=>[0:1]","children":[10]},
            {"name":"=>[0:2]","children":[9]},{"name":"stand","children":[12,13]},{"name":"=>[0:1:1:3]","mesh":0},
            {"name":"=>[0:1:1:4]","mesh":1}]}"#;
        let mut root: Root = serde_json::from_str(&json.replace("GENERATOR", generator)).unwrap();
        name_after_products(&mut root);
        root.nodes.into_iter().map(|node| node.name.unwrap()).collect()
    }

    #[test]
    fn node_references_and_numbers_become_product_names() {
        let named = names("Open CASCADE Technology 8.0 [dev.opencascade.org]");
        let wanted = [
            "frame", "lid", "lid", "bolt M6", "12", "lid", "lid", "bolt M6", "=>[a]", "=>[0:1]", "=>[0:2]",
            "stand", "bolt M6", "stand",
        ];
        assert_eq!(named, wanted);
    }

    #[test]
    fn node_names_of_other_programs_are_kept() {
        assert_eq!(names("Blender")[2], "=>[0:1:1:3]");
        assert_eq!(names("Blender")[3], "NAUO7");
    }
}
