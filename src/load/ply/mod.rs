//! PLY, text and binary of either byte order.
//!
//! Source: Greg Turk, *The PLY Polygon File Format* (1994). The y axis is assumed to point up.
//!
//! 1. [`header`] reads the encoding and the elements with their properties.
//! 2. [`element_rows`] reads the rows of an element. Elements may come in any order: faces, strips and edges
//!    before the vertices are skipped and read once the vertices are known.
//! 3. [`vertex_element`], [`face_elements`] and [`edge_element`] read vertices, polygons and strips, and
//!    edges, which become wires.
//!
//! Faces with colours get materials of these colours. Other elements are skipped.

mod edge_element;
mod element_rows;
mod face_elements;
mod header;
mod vertex_element;

use glam::DAffine3;

use self::element_rows::ElementReader;
use self::face_elements::FaceReader;
use self::header::{Element, Header};
use super::text_cursor::Cursor;
use super::triangle_colours;
use crate::colour::srgb::Colour;
use crate::error::Error;
use crate::mesh::EdgeMark;
use crate::scene::drawable;
use crate::scene::extent::coordinate_limits::{NOT_DRAWABLE_WARNING, is_drawable};
use crate::scene::extent::precision_warning;
use crate::scene::{Geometry, Part, Scene, UpAxis, Warnings};

/// Reads the bytes of a PLY file; `stem` names its only part.
///
/// # Errors
/// Names the place if the header is wrong, rows are missing, an index is out of range, or
/// nothing can be drawn.
pub(crate) fn read_bytes(bytes: &[u8], stem: &str) -> Result<Scene, Error> {
    let header = Header::parse(bytes)?;
    let mut body = ElementReader { cursor: Cursor { bytes, at: header.body }, encoding: header.encoding };
    let mut model = Model { warnings: header.warnings, ..Model::default() };
    let mut has_vertices = false;
    // Elements that need the vertices, with the start of their rows.
    let mut waiting: Vec<(&Element, usize)> = Vec::new();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" if !has_vertices => {
                model.geometry = vertex_element::read(&mut body, element)?;
                has_vertices = true;
                let end = body.cursor.at;
                for (element, start) in std::mem::take(&mut waiting) {
                    body.cursor.at = start;
                    model.connect(&mut body, element)?;
                }
                body.cursor.at = end;
            }
            "face" | "tristrips" | "edge" if has_vertices => model.connect(&mut body, element)?,
            "face" | "tristrips" | "edge" => {
                waiting.push((element, body.cursor.at));
                face_elements::skip(&mut body, element)?;
            }
            _ => face_elements::skip(&mut body, element)?,
        }
    }
    if let Some((element, _)) = waiting.iter().find(|(element, _)| element.count > 0) {
        return Err(Error::new("the file has no vertices").at(format!("element {}", element.name)));
    }
    model.into_scene(stem)
}

/// Content of a file.
#[derive(Default)]
struct Model {
    geometry: Geometry,
    /// Colours of the triangles; shorter than these, or empty, if elements have none.
    colours: Vec<Option<Colour>>,
    warnings: Warnings,
    /// Number of faces and edges left out because of their coordinates.
    unusable: u64,
}

impl Model {
    /// Reads the rows of an element that refers to vertices.
    fn connect(&mut self, body: &mut ElementReader, element: &Element) -> Result<(), Error> {
        if element.name == "edge" {
            let edges = edge_element::read(body, element, &self.geometry.positions)?;
            self.warnings.extend(&edges.warnings);
            self.unusable += edges.unusable;
            self.geometry.wires.extend(edges.wires);
            return Ok(());
        }
        let mut faces = FaceReader::new(&self.geometry.positions);
        if element.name == "face" {
            faces.polygons(body, element)?;
        } else {
            faces.strips(body, element)?;
        }
        self.warnings.extend(&faces.warnings);
        self.unusable += faces.unusable;
        if !faces.colours.is_empty() {
            self.colours.resize(self.geometry.triangles.len(), None);
            self.colours.extend(faces.colours);
        }
        if !faces.edge_marks.is_empty() {
            self.geometry.edge_marks.resize(self.geometry.triangles.len(), [EdgeMark::Unmarked; 3]);
            self.geometry.edge_marks.extend(faces.edge_marks);
        }
        let triangles = faces.triangles;
        if self.geometry.triangles.is_empty() {
            self.geometry.triangles = triangles;
        } else {
            self.geometry.triangles.extend(triangles);
        }
        Ok(())
    }

    /// Makes a scene of one part.
    fn into_scene(self, stem: &str) -> Result<Scene, Error> {
        let Self { mut geometry, colours, warnings, unusable } = self;
        let mut scene = Scene { format: "PLY", up: UpAxis::Y, warnings, ..Scene::default() };
        scene.warnings.count(NOT_DRAWABLE_WARNING, unusable);
        if !geometry.edge_marks.is_empty() {
            geometry.edge_marks.resize(geometry.triangles.len(), [EdgeMark::Unmarked; 3]);
        }
        // No triangle uses these positions.
        for position in geometry.positions.iter_mut().filter(|p| !is_drawable(**p)) {
            *position = glam::DVec3::ZERO;
        }
        if !geometry.normals.is_empty() {
            geometry.corner_normals.clone_from(&geometry.triangles);
        }
        if !geometry.uvs.is_empty() {
            geometry.corner_uvs.clone_from(&geometry.triangles);
        }
        if !colours.is_empty() {
            if geometry.colours.iter().any(|[r, g, b, _]| [*r, *g, *b] != [1.0; 3]) {
                scene
                    .warnings
                    .note("colours of faces left out: the vertices have colours too, and those are drawn");
            } else {
                geometry.colours.clear();
                triangle_colours::paint(&mut geometry, &colours, &mut scene.materials);
            }
        }
        scene.geometries.push(geometry);
        scene.parts.push(Part { name: stem.to_owned(), geometry: 0, world_from_part: DAffine3::IDENTITY });
        drawable(scene).map(precision_warning::with_precision_warning)
    }
}

#[cfg(test)]
mod tests;
