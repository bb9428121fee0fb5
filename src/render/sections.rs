//! [`hatched`]: a style that hatches the faces along which a scene is cut open.

use crate::drawing::Length;
use crate::hatch::{Pattern, PatternKind};
use crate::math::glob::Glob;
use crate::section::{Section, material_name};
use crate::style::Style;

/// The distance of lines on cut faces, and their width.
const SPACING_MM: f64 = 2.0;
const WIDTH_MM: f64 = 0.18;

/// Degrees that the lines of cut parts are turned by, and by how much they are farther apart: neighbours differ in one of both
/// (ISO 128-50, 6.2).
const KINDS: [(f64, f64); 8] =
    [(45.0, 1.0), (135.0, 1.0), (45.0, 1.7), (135.0, 1.7), (45.0, 0.6), (135.0, 0.6), (30.0, 1.0), (120.0, 1.0)];

/// The style with thin lines at 45 degrees on the cut faces of a section, at other angles or distances on neighbouring parts. A pattern
/// that the style itself has for the material of such faces (`cut 1`, `cut 2` and so on) is left as it is.
///
/// Source: ISO 128-50:2001, Basic conventions for representing areas on cuts and sections, 4 and 6.
#[must_use]
pub fn hatched(style: &Style, section: &Section) -> Style {
    let mut style = style.clone();
    let mut kinds: Vec<usize> = section.faces.iter().map(|faces| faces.kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    if kinds.is_empty() {
        return style;
    }
    if !style.hatch.enabled {
        // What is seen where is asked for; nothing but cut faces is hatched.
        style.hatch.enabled = true;
        style.hatch.layers.clear();
        style.hatch.coverage.clear();
        style.hatch.materials.clear();
        style.hatch.blacks = 0;
        style.hatch.cast_shadows = false;
        style.shade.thresholds.clear();
        style.shade.materials.clear();
    }
    for kind in kinds {
        let name = material_name(kind);
        if style.patterns.iter().any(|own| own.material != Glob::new("*") && own.material.matches(&name)) {
            continue;
        }
        let (angle, farther) = KINDS[kind % KINDS.len()];
        style.patterns.push(Pattern {
            material: Glob::new(name),
            kind: PatternKind::Lines,
            size: Length::mm(SPACING_MM * farther),
            width: Length::mm(WIDTH_MM),
            angle,
            colour: style.stroke.pen.colour,
            unpainted: true,
            ..Pattern::default()
        });
    }
    style
}
