//! Writer of Wavefront OBJ and MTL.

use std::fmt::Write as _;

use glam::DVec3;

use crate::geometry::part::{Material, Part, y_up_from_z_up};

/// Number with `places` decimals, without trailing zeros or a negative zero.
fn number(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Text of an OBJ file, turned to y up, with one object per part. Consecutive parts of the same name form one
/// object. `normals` has one list per part and one entry per point; corners refer to them.
pub fn text(title: &str, library: Option<&str>, parts: &[Part], normals: &[Vec<DVec3>]) -> String {
    let mut out = format!("# {title}\n");
    if let Some(library) = library {
        let _ = writeln!(out, "mtllib {library}");
    }
    let up = y_up_from_z_up();
    let mut base = 1;
    for (place, part) in parts.iter().enumerate() {
        if place == 0 || parts[place - 1].name != part.name {
            let _ = writeln!(out, "o {}", part.name);
        }
        for point in &part.solid.points {
            let [x, y, z] = up.transform_point3(*point).to_array().map(|value| number(value, 4));
            let _ = writeln!(out, "v {x} {y} {z}");
        }
        let normals = normals.get(place);
        for normal in normals.into_iter().flatten() {
            let [x, y, z] = up.transform_vector3(*normal).to_array().map(|value| number(value, 4));
            let _ = writeln!(out, "vn {x} {y} {z}");
        }
        if library.is_some() {
            let _ = writeln!(out, "usemtl {}", part.material.name);
        }
        for face in &part.solid.faces {
            out.push('f');
            for corner in face {
                let id = corner + base;
                let _ = if normals.is_some() { write!(out, " {id}//{id}") } else { write!(out, " {id}") };
            }
            out.push('\n');
        }
        base += part.solid.points.len() as u32;
    }
    out
}

/// Text of the material library, with each material once, in order of first use.
pub fn library(title: &str, parts: &[Part]) -> String {
    let mut out = format!("# {title}\n");
    let mut written: Vec<Material> = Vec::new();
    for material in parts.iter().map(|part| part.material) {
        if !written.contains(&material) {
            let [r, g, b] = material.colour.map(|value| number(value, 3));
            let _ = writeln!(out, "newmtl {}\nKd {r} {g} {b}\nKs 0 0 0\nillum 1", material.name);
            written.push(material);
        }
    }
    out
}
