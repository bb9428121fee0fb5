//! [`items`]: the parts list of a scene: what it is made of, by name, with counts.

use std::collections::BTreeMap;

use crate::scene::Scene;

/// An item of a parts list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Item {
    /// What it is called.
    pub name: String,
    /// What its parts are made of, by the name of the material of the first of them.
    pub material: String,
    /// Its parts, indices into [`Scene::parts`].
    pub parts: Vec<usize>,
}

/// The items of a scene, in the order in which their first parts are in it: parts of one name, and parts whose names differ in a number
/// at the end alone (`bolt.001`, `bolt-2`, `bolt 3`), if there are several of these, are one item.
#[must_use]
pub fn items(scene: &Scene) -> Vec<Item> {
    let mut stems: BTreeMap<&str, usize> = BTreeMap::new();
    let drawn = |part: &usize| {
        let geometry = scene.parts.get(*part).and_then(|part| scene.geometry_of(part));
        geometry.is_some_and(|geometry| !geometry.triangles.is_empty())
    };
    let parts: Vec<usize> = (0..scene.parts.len()).filter(drawn).collect();
    for part in &parts {
        *stems.entry(stem(&scene.parts[*part].name)).or_default() += 1;
    }
    let mut known: BTreeMap<&str, usize> = BTreeMap::new();
    let mut items: Vec<Item> = Vec::new();
    for part in parts {
        let name = &*scene.parts[part].name;
        let name = if stems.get(stem(name)).is_some_and(|count| *count > 1) { stem(name) } else { name };
        let number = *known.entry(name).or_insert_with(|| {
            let shape = scene.geometry_of(&scene.parts[part]);
            let material = shape.and_then(|shape| shape.material_of(0));
            let material = material.and_then(|material| scene.materials.get(material as usize));
            let material = material.map(|material| material.name.clone()).unwrap_or_default();
            items.push(Item { name: name.to_owned(), material, parts: Vec::new() });
            items.len() - 1
        });
        items[number].parts.push(part);
    }
    items
}

/// A name without a number at its end and what parts that from it.
fn stem(name: &str) -> &str {
    let bare = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let stem = bare.trim_end_matches(['.', '-', '_', ' ', '#']);
    if bare.len() < name.len() && stem.len() < bare.len() && !stem.is_empty() { stem } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_at_the_end_are_no_names() {
        for (name, own) in [
            ("bolt.001", "bolt"),
            ("bolt_M6x25_1", "bolt_M6x25"),
            ("cover-bolt-12", "cover-bolt"),
            ("link 3", "link"),
            ("gear29", "gear29"),
            ("gear_29t", "gear_29t"),
            ("12", "12"),
            ("-1", "-1"),
            ("", ""),
        ] {
            assert_eq!(stem(name), own);
        }
    }
}
