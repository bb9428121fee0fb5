//! Mesh edges that are feature lines: contours, borders, creases and material boundaries.
//!
//! 1. An edge with one face is a border. An edge with two faces is a contour, crease or material boundary
//!    (`edge_lines`). Which edges are creases was decided before, in `surface::patches::patch_layout`.
//! 2. Edges with three faces or more are judged body by body (`edge_fans`).
//! 3. Contour edges that only a few rippled faces cause are marked (`ripple_edges`).
//! 4. Borders in a plane where surfaces overlap get their kind from the surface on top (`coplanar_overlaps`).
//! 5. Wires that repeat such a line are dropped (`free_wires`).
//!
//! Source: Lake, Marshall, Harris and Blackstein, Stylized rendering techniques, NPAR 2000, section 4.1.
//!
//! Files, in reading order: [`edge_lines`]; [`edge_fans`]; [`ripple_edges`]; [`coplanar_overlaps`];
//! [`free_wires`]; [`culling`] shortcuts for many views of one surface.

pub(crate) mod coplanar_overlaps;
pub(crate) mod culling;
mod edge_fans;
pub(crate) mod edge_lines;
pub(crate) mod free_wires;
pub(crate) mod ripple_edges;
