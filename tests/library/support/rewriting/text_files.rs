//! Writers for models as text: OBJ, and PLY with coordinates in double precision.

use std::fmt::Write as _;

use glam::DVec3;

use super::model::RandomModel;

/// Precision of written coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Digits {
    /// The shortest decimal that identifies the number in double precision.
    All,
    Six,
    /// The shortest decimal that identifies the number rounded to single precision.
    Single,
}

impl Digits {
    fn write(self, number: f64) -> String {
        match self {
            Self::All => number.to_string(),
            Self::Six => format!("{number:.6}"),
            Self::Single => (number as f32).to_string(),
        }
    }

    fn point(self, p: DVec3) -> String {
        p.to_array().map(|number| self.write(number)).join(" ")
    }
}

/// An OBJ file with one object per part.
pub(crate) fn write_obj(model: &RandomModel, digits: Digits) -> Vec<u8> {
    write_obj_text(model, digits, false)
}

/// An OBJ file with one group per face.
pub(crate) fn write_obj_in_groups(model: &RandomModel) -> Vec<u8> {
    write_obj_text(model, Digits::All, true)
}

fn write_obj_text(model: &RandomModel, digits: Digits, has_group_per_face: bool) -> Vec<u8> {
    let mut text = String::new();
    let (mut first, mut groups) = (1, 0);
    let has_colours = model.has_colours();
    for part in model.parts() {
        if !has_group_per_face {
            writeln!(text, "o {}", part[0].part).unwrap();
        }
        for body in part {
            for point in model.world_points(body) {
                writeln!(text, "v {}", digits.point(point)).unwrap();
            }
            let mut colour = None;
            for face in &body.faces {
                if has_group_per_face {
                    groups += 1;
                    writeln!(text, "g face{groups}").unwrap();
                }
                if has_colours && colour != Some(face.colour) {
                    colour = Some(face.colour);
                    writeln!(text, "usemtl colour{}", face.colour).unwrap();
                }
                let corners: Vec<String> = face.corners.iter().map(|c| (c + first).to_string()).collect();
                writeln!(text, "f {}", corners.join(" ")).unwrap();
            }
            first += body.points.len() as u32;
        }
    }
    text.into_bytes()
}

pub(crate) fn write_ply(model: &RandomModel) -> Vec<u8> {
    let points: Vec<DVec3> = model.bodies.iter().flat_map(|body| model.world_points(body)).collect();
    let faces: usize = model.bodies.iter().map(|body| body.faces.len()).sum();
    let mut text = String::from("ply\nformat ascii 1.0\n");
    writeln!(text, "element vertex {}", points.len()).unwrap();
    for axis in ["x", "y", "z"] {
        writeln!(text, "property double {axis}").unwrap();
    }
    writeln!(text, "element face {faces}\nproperty list uchar int vertex_indices\nend_header").unwrap();
    for point in points {
        writeln!(text, "{}", Digits::All.point(point)).unwrap();
    }
    let mut first = 0;
    for body in &model.bodies {
        for face in &body.faces {
            let corners: Vec<String> = face.corners.iter().map(|c| (c + first).to_string()).collect();
            writeln!(text, "{} {}", corners.len(), corners.join(" ")).unwrap();
        }
        first += body.points.len() as u32;
    }
    text.into_bytes()
}
