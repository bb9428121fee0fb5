//! Tests of chains: plain chains equal the visible lines, and polygons become circles and arcs.

mod circles_to_scale;
mod untidied_chains;
