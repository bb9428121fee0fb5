//! Text output of `ligne info`.

use std::fmt::Write;

use super::degenerate_elements;
use super::joints::JointInfo;
use super::lights_cameras_clips::{CameraInfo, ClipInfo, LightInfo};
use super::materials::MaterialInfo;
use super::model_contents::ModelInfo;
use super::text_lists::{MAX_SHOWN_ENTRIES, list};
use crate::cli::output::number_text::counted;

impl ModelInfo {
    /// Formats the contents as text. A full text lists everything, with bounds and precision of each part. A
    /// short text stops after [`MAX_SHOWN_ENTRIES`] entries per list.
    pub(crate) fn text(&self, is_full: bool) -> String {
        let most = if is_full { usize::MAX } else { MAX_SHOWN_ENTRIES };
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}: {}, {} up", self.file, self.format, self.up);
        let _ = writeln!(text, "  {}, {}", counted(self.triangles, "triangle"), vertices(self.vertices));
        if let Some(bounds) = &self.bounds {
            let unit = self.unit.map_or_else(|| ",".to_owned(), |unit| format!(" {unit},"));
            let _ = writeln!(text, "  {}", bounds.words(&unit));
        }
        if self.unused_vertices > 0 {
            let _ = writeln!(text, "  {} that no face or line uses", vertices(self.unused_vertices));
        }
        degenerate_elements::add(&mut text, &self.left_out, most);
        if let Some(turned) = self.turned.words() {
            let _ = writeln!(
                text,
                "  {turned}: their winding in the file points inward or contradicts their neighbours"
            );
        }
        list(&mut text, "part", most, self.parts.iter().map(|part| part.line(is_full)));
        list(&mut text, "material", most, self.materials.iter().map(MaterialInfo::line));
        list(&mut text, "light", most, self.lights.iter().map(LightInfo::line));
        list(&mut text, "camera", most, self.cameras.iter().map(CameraInfo::line));
        if is_full {
            list(&mut text, "joint", most, self.joints.iter().map(JointInfo::line));
        } else if !self.joints.is_empty() {
            let _ = writeln!(text, "  {} (--all lists them)", counted(self.joints.len() as u64, "joint"));
        }
        list(&mut text, "animation", most, self.animations.iter().map(ClipInfo::line));
        list(&mut text, "warning", most, self.warnings.iter().cloned());
        list(&mut text, "note", most, self.notes.iter().cloned());
        text
    }
}

fn vertices(n: u64) -> String {
    counted(n, "vertex").replace("vertexs", "vertices")
}
