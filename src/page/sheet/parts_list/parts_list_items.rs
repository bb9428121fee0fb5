//! [`parts_list_items`]: the parts list of a scene, with equal parts counted as one item.
//!
//! Parts are compared only with items of the same geometry or the same name, so the exact comparison of
//! shapes is rare.

use std::collections::BTreeMap;

use super::congruence::PartShape;
use crate::scene::Scene;

/// An item of a parts list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct PartsListItem {
    /// Item number.
    pub number: String,
    /// Quantity.
    pub count: usize,
    /// Name of the item.
    pub name: String,
    /// Material name of its first part.
    pub material: String,
    /// Remark; empty unless the list comes from a file.
    pub remark: String,
    /// Parts of the item, as indices into [`Scene::parts`].
    pub parts: Vec<usize>,
}

/// The items of a scene, in the order of their first parts.
///
/// Parts are one item if their shapes are congruent, their materials are equal, and they share a geometry or
/// a name. Names may differ by a number at the end (`bolt.001`, `bolt-2`, `bolt 3`). Mirror images are
/// different items.
#[must_use]
pub(crate) fn parts_list_items(scene: &Scene) -> Vec<PartsListItem> {
    // Items of each geometry and each name, and the shape of each item's first part.
    let mut of_geometry: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let mut of_name: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    let mut shapes: Vec<PartShape> = Vec::new();
    let mut items: Vec<PartsListItem> = Vec::new();
    for (number, part) in scene.parts.iter().enumerate() {
        let Some(shape) = PartShape::of(scene, part) else { continue };
        let material = scene.geometry_of(part).and_then(|shape| shape.material_of(0));
        let material = material.and_then(|material| scene.materials.get(material as usize));
        let material = material.map(|material| material.name.clone()).unwrap_or_default();
        let same_geometry = of_geometry.entry(part.geometry).or_default();
        let same_name = of_name.entry(stem(&part.name)).or_default();
        let known = same_geometry.iter().chain(same_name.iter()).copied();
        let known =
            known.into_iter().find(|item| items[*item].material == material && shapes[*item].equals(&shape));
        let item = known.unwrap_or_else(|| {
            items.push(PartsListItem {
                number: (items.len() + 1).to_string(),
                count: 0,
                name: part.name.clone(),
                material,
                remark: String::new(),
                parts: Vec::new(),
            });
            shapes.push(shape);
            items.len() - 1
        });
        for list in [same_geometry, same_name] {
            if !list.contains(&item) {
                list.push(item);
            }
        }
        items[item].parts.push(number);
    }
    for item in &mut items {
        item.count = item.parts.len();
        if item.parts.len() > 1 {
            item.name = common_name(item.parts.iter().map(|part| &*scene.parts[*part].name));
        }
    }
    items
}

/// The common name of several parts: without numbers at the end, and without the numbers that differ.
fn common_name<'a>(mut names: impl Iterator<Item = &'a str> + Clone) -> String {
    let first = names.clone().next().unwrap_or_default();
    if names.clone().all(|name| stem(name) == stem(first)) {
        return stem(first).to_owned();
    }
    let bare = without_numbers(first);
    if names.all(|name| without_numbers(name) == bare) { bare } else { stem(first).to_owned() }
}

/// A name without its numeric words.
fn without_numbers(name: &str) -> String {
    let is_number = |word: &&str| !word.is_empty() && word.chars().all(|c| c.is_ascii_digit());
    let words: Vec<&str> = name.split('_').filter(|word| !is_number(word)).collect();
    words.join("_")
}

/// A name without a number at its end and the separator before it.
fn stem(name: &str) -> &str {
    let bare = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let stem = bare.trim_end_matches(['.', '-', '_', ' ', '#']);
    if bare.len() < name.len() && stem.len() < bare.len() && !stem.is_empty() { stem } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trailing_numbers_are_not_part_of_names() {
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
