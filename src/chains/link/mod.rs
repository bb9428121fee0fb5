//! Routes: view edges in the order of the pen stroke that passes them. Each edge is in exactly one route.
//!
//! 1. Edges get a class: kind, body, material and visibility. Only edges of one class are joined.
//! 2. Two edges continue each other where they are the only ones of their class at a view vertex.
//! 3. Where more meet, pieces of one feature segment are paired first, then the pairs that turn least.
//! 4. Routes start at unpaired ends, then at closed loops. Direction and order depend on geometry alone.
//!
//! Files, in reading order: [`edge_class`] the class of a view edge; [`directed_edge`] an edge with a
//! direction, and a total order; [`junction_pairing`] which ends continue each other; [`routes`] the walk
//! along pairs.

pub(crate) mod directed_edge;
pub(crate) mod edge_class;
mod junction_pairing;
pub(crate) mod routes;
