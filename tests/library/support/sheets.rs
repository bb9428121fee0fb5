//! Models of technical sheets as files, and what is read off a composed sheet.

use std::fs;
use std::path::PathBuf;

use ligne::drawing::{Item, Mark};
use ligne::kurbo::{Affine, Rect, Shape};
use ligne::page::Composed;

use super::solids::{Solid, cuboid};

/// A folder of a test's own.
pub fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("ligne-sheets-{}-{name}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// An OBJ file of named solids.
pub fn obj(parts: &[(String, Solid)]) -> String {
    let mut text = String::new();
    let mut first = 1;
    for (name, solid) in parts {
        text += &format!("o {name}\n");
        for p in &solid.positions {
            text += &format!("v {} {} {}\n", p.x, p.y, p.z);
        }
        for [a, b, c] in &solid.triangles {
            text += &format!("f {} {} {}\n", a + first, b + first, c + first);
        }
        first += solid.positions.len() as u32;
    }
    text
}

/// A box between two corners.
pub fn block(low: [f64; 3], high: [f64; 3]) -> Solid {
    cuboid(low.into(), high.into())
}

/// What of a composed page has that name.
pub fn item<'a>(composed: &'a Composed, name: &str) -> &'a Item {
    let found = composed.composition.items.iter().find(|item| item.name == name);
    found.unwrap_or_else(|| panic!("no {name}"))
}

/// The marks of an item, with where it stands on the page.
pub fn marks(item: &Item) -> impl Iterator<Item = (Affine, &Mark)> {
    item.drawing.layers.iter().flat_map(|layer| &layer.marks).map(|mark| (item.place, mark))
}

/// The box around the middles of all lines of an item.
pub fn bounds(item: &Item) -> Rect {
    let boxes = marks(item).map(|(place, mark)| (place * mark.path.clone()).bounding_box());
    boxes.reduce(|a, b| a.union(b)).expect("something drawn")
}

/// All texts of an item.
pub fn words(item: &Item) -> Vec<String> {
    marks(item).filter_map(|(_, mark)| Some(mark.provenance.text.as_ref()?.words.to_string())).collect()
}
