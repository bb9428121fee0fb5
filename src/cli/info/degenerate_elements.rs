//! Faces without area and lines without length, as listed by `ligne info`.

use std::fmt::Write;

use serde::Serialize;

use crate::cli::output::number_text::{counted, short};
use crate::scene::Scene;
use crate::scene::extent::drawn_points::{DegenerateCounts, DrawnPart};

/// Excluded faces and lines of a part.
#[derive(Debug, Serialize)]
pub(crate) struct LeftOutInfo {
    part: String,
    /// Number of faces without area.
    faces: u64,
    /// Number of lines without length.
    lines: u64,
    /// A corner of the first excluded face or line.
    pub first_at: Option<[f64; 3]>,
}

/// Excluded faces and lines of each part, one entry per part.
pub(crate) fn by_part(scene: &Scene, drawn: &[DrawnPart]) -> Vec<DegenerateCounts> {
    let mut left_out = vec![DegenerateCounts::default(); scene.parts.len()];
    for own in drawn {
        if let Some(slot) = left_out.get_mut(own.part) {
            *slot = own.left_out;
        }
    }
    left_out
}

/// Adds a line for each part with excluded elements, up to `most` parts.
pub(crate) fn add(text: &mut String, left_out: &[LeftOutInfo], most: usize) {
    for own in left_out.iter().take(most) {
        // Writing to a string cannot fail. Names may contain terminal control codes.
        let _ = writeln!(text, "  left out: {}", own.line().replace(char::is_control, " "));
    }
    if left_out.len() > most {
        let _ = writeln!(text, "  left out in {} more parts (--all lists them)", left_out.len() - most);
    }
}

impl LeftOutInfo {
    /// Entries of the parts with excluded elements.
    pub(crate) fn of(scene: &Scene, left_out: &[DegenerateCounts]) -> Vec<Self> {
        let parts = scene.parts.iter().zip(left_out).filter(|(_, own)| !own.is_none());
        let info = parts.map(|(part, own)| Self {
            part: part.name.clone(),
            faces: own.faces,
            lines: own.wires,
            first_at: own.first.map(|at| at.to_array()),
        });
        info.collect()
    }

    fn line(&self) -> String {
        let faces = (self.faces > 0).then(|| format!("{} without area", counted(self.faces, "face")));
        let lines = (self.lines > 0).then(|| format!("{} without length", counted(self.lines, "line")));
        let what: Vec<String> = faces.into_iter().chain(lines).collect();
        let at = self.first_at.map_or_else(String::new, |at| {
            let first = if self.faces + self.lines > 1 { "the first " } else { "" };
            format!(", {first}at ({})", at.map(short).join(", "))
        });
        let part = if self.part.is_empty() { "a part without a name" } else { &self.part };
        format!("{} in {part}{at}", what.join(" and "))
    }
}
