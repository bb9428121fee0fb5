//! Round rims: the lines between surfaces become curves where one of these is curved.
//!
//! 1. A line between two surfaces has the direction of the cross product of their normals.
//!    With it at both ends an edge of the line becomes an arc. The normals must be those of a file.
//! 2. A border has one surface only, and bare meshes have no normals. There a line becomes an arc where it
//!    turns evenly: its edges have one length and its corners one turn, within ten per cent.
//! 3. For a view, each edge is halved until its pieces are close to the arc, and the faces next to it are cut
//!    to match.
//!
//! Files, in reading order: [`rim_arcs`] (step 1), [`even_runs`] (step 2), [`rim_cuts`] (step 3).

pub(crate) mod even_runs;
mod rim_arcs;
pub(crate) mod rim_cuts;
