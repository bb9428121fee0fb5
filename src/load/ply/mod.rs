//! PLY, text and binary of either byte order.
//!
//! Source: Greg Turk, *The PLY Polygon File Format* (1994). y is taken to point up.

mod body;
mod faces;
mod header;
mod vertices;

use std::path::Path;

use glam::DAffine3;

use self::body::Body;
use self::faces::Faces;
use self::header::Header;
use super::read_with;
use super::text::Cursor;
use crate::error::Error;
use crate::mesh::EdgeMark;
use crate::scene::coordinate::{NOT_DRAWABLE, is_drawable};
use crate::scene::drawable;
use crate::scene::{Geometry, Part, Scene, UpAxis};

/// Reads a PLY file.
///
/// # Errors
/// Names the file and the place if the header is wrong, rows are missing, an index points
/// nowhere, or nothing can be drawn.
pub fn read(path: &Path) -> Result<Scene, Error> {
    read_with(path, read_bytes)
}

/// Reads the bytes of a PLY file; `stem` names its only part.
///
/// # Errors
/// As [`read`].
pub fn read_bytes(bytes: &[u8], stem: &str) -> Result<Scene, Error> {
    let header = Header::parse(bytes)?;
    let mut body = Body { cursor: Cursor { bytes, at: header.body }, encoding: header.encoding };
    let mut scene = Scene { format: "PLY", up: UpAxis::Y, warnings: header.warnings, ..Scene::default() };
    let mut geometry = Geometry::default();
    let mut has_vertices = false;
    let mut triangles = Vec::new();
    let mut edge_marks = Vec::new();
    let mut unusable = 0;
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" if !has_vertices => {
                geometry = vertices::read(&mut body, element)?;
                has_vertices = true;
            }
            name @ ("face" | "tristrips") => {
                if !has_vertices {
                    return Err(
                        Error::new("the faces stand before the vertices").at(format!("element {name}"))
                    );
                }
                let mut faces = Faces::new(&geometry.positions);
                if name == "face" {
                    faces.polygons(&mut body, element)?
                } else {
                    faces.strips(&mut body, element)?
                }
                scene.warnings.extend(&faces.warnings);
                unusable += faces.unusable;
                if !faces.edge_marks.is_empty() {
                    edge_marks.resize(triangles.len(), [EdgeMark::Unmarked; 3]);
                    edge_marks.extend(faces.edge_marks);
                }
                if triangles.is_empty() {
                    triangles = faces.triangles
                } else {
                    triangles.extend(faces.triangles)
                }
            }
            _ => faces::skip(&mut body, element)?,
        }
    }
    scene.warnings.count(NOT_DRAWABLE, unusable);
    if !edge_marks.is_empty() {
        edge_marks.resize(triangles.len(), [EdgeMark::Unmarked; 3]);
    }
    geometry.triangles = triangles;
    geometry.edge_marks = edge_marks;
    // No triangle uses these any more.
    for position in geometry.positions.iter_mut().filter(|p| !is_drawable(**p)) {
        *position = glam::DVec3::ZERO;
    }
    if !geometry.normals.is_empty() {
        geometry.corner_normals.clone_from(&geometry.triangles);
    }
    if !geometry.uvs.is_empty() {
        geometry.corner_uvs.clone_from(&geometry.triangles);
    }
    scene.geometries.push(geometry);
    scene.parts.push(Part { name: stem.to_owned(), geometry: 0, world_from_part: DAffine3::IDENTITY });
    drawable(scene)
}

#[cfg(test)]
mod tests;
