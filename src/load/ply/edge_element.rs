//! Reads the edges of a PLY file, which become wires.

use glam::DVec3;

use super::element_rows::{ElementReader, RowValues};
use super::face_elements::{index_of, no_vertex, skip};
use super::header::Element;
use crate::error::Error;
use crate::scene::Warnings;
use crate::scene::extent::coordinate_limits::is_drawable;

/// Property names of the two ends: those of Turk's paper, and those of VCGlib and CGAL.
const END_NAMES: [[&str; 2]; 3] = [["vertex1", "vertex2"], ["v1", "v2"], ["v0", "v1"]];

/// Content of the element `edge`.
#[derive(Default)]
pub(crate) struct EdgeWires {
    /// Ends of each edge.
    pub wires: Vec<[u32; 2]>,
    /// Number of edges left out because of their coordinates.
    pub unusable: u64,
    pub warnings: Warnings,
}

/// Reads the element `edge`.
pub(crate) fn read(
    body: &mut ElementReader,
    element: &Element,
    positions: &[DVec3],
) -> Result<EdgeWires, Error> {
    let count = body.check_count(element)?;
    let mut edges = EdgeWires::default();
    let ends = END_NAMES.iter().find_map(|[from, to]| Some([element.find(&[*from])?, element.find(&[*to])?]));
    let Some(ends) = ends else {
        edges.warnings.note("edges without vertex1 and vertex2 left out");
        skip(body, element)?;
        return Ok(edges);
    };
    if element.find(&["red", "r", "diffuse_red"]).is_some() {
        edges.warnings.note("colours of edges left out: lines have the colours of their pens");
    }
    edges.wires.reserve(count);
    let mut row = RowValues::default();
    for number in 0..count {
        let start = body.cursor.clone();
        body.row(element, number, &mut row)?;
        let mut wire = [0; 2];
        for (end, property) in wire.iter_mut().zip(ends) {
            let index = row.value(property);
            *end = index_of(index, positions)
                .ok_or_else(|| no_vertex(index, positions).at(body.place(start.clone(), element, number)))?;
        }
        let is_usable = |end: &u32| positions.get(*end as usize).is_some_and(|p| is_drawable(*p));
        if wire.iter().all(is_usable) {
            edges.wires.push(wire);
        } else {
            edges.unusable += 1;
        }
    }
    Ok(edges)
}
