//! [`items`]: the parts list of a scene: what it is made of, by name, with counts.

use std::collections::BTreeMap;

use crate::scene::Scene;

/// An item of a parts list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Item {
    /// Its number.
    pub number: String,
    /// How many there are.
    pub count: usize,
    /// What it is called.
    pub name: String,
    /// What its parts are made of, by the name of the material of the first of them.
    pub material: String,
    /// What else there is to say.
    pub remark: String,
    /// Its parts, indices into [`Scene::parts`].
    pub parts: Vec<usize>,
}

/// The items of a scene, in the order in which their first parts are in it: parts that show one shape, not mirrored, are one item, and so
/// are parts of one name, and parts whose names differ in a number at the end alone (`bolt.001`, `bolt-2`, `bolt 3`).
#[must_use]
pub fn items(scene: &Scene) -> Vec<Item> {
    let drawn = |part: &usize| {
        let geometry = scene.parts.get(*part).and_then(|part| scene.geometry_of(part));
        geometry.is_some_and(|geometry| !geometry.triangles.is_empty())
    };
    let mut of_shape: BTreeMap<(usize, bool), usize> = BTreeMap::new();
    let mut of_name: BTreeMap<&str, usize> = BTreeMap::new();
    let mut items: Vec<Item> = Vec::new();
    for number in (0..scene.parts.len()).filter(drawn) {
        let part = &scene.parts[number];
        let shape = (part.geometry, part.world_from_part.matrix3.determinant() < 0.0);
        let known = of_shape.get(&shape).or_else(|| of_name.get(stem(&part.name))).copied();
        let item = known.unwrap_or_else(|| {
            let material = scene.geometry_of(part).and_then(|shape| shape.material_of(0));
            let material = material.and_then(|material| scene.materials.get(material as usize));
            let material = material.map(|material| material.name.clone()).unwrap_or_default();
            items.push(Item {
                number: (items.len() + 1).to_string(),
                count: 0,
                name: part.name.clone(),
                material,
                remark: String::new(),
                parts: Vec::new(),
            });
            items.len() - 1
        });
        of_shape.insert(shape, item);
        of_name.entry(stem(&part.name)).or_insert(item);
        items[item].parts.push(number);
    }
    for item in &mut items {
        item.count = item.parts.len();
        if item.parts.len() > 1 {
            item.name = common(item.parts.iter().map(|part| &*scene.parts[*part].name));
        }
    }
    items
}

/// What several parts are called: without numbers at the end, and without those in between by which alone they differ.
fn common<'a>(mut names: impl Iterator<Item = &'a str> + Clone) -> String {
    let first = names.clone().next().unwrap_or_default();
    if names.clone().all(|name| stem(name) == stem(first)) {
        return stem(first).to_owned();
    }
    let bare = without_numbers(first);
    if names.all(|name| without_numbers(name) == bare) { bare } else { stem(first).to_owned() }
}

/// A name without its words that are numbers.
fn without_numbers(name: &str) -> String {
    let is_number = |word: &&str| !word.is_empty() && word.chars().all(|c| c.is_ascii_digit());
    let words: Vec<&str> = name.split('_').filter(|word| !is_number(word)).collect();
    words.join("_")
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
