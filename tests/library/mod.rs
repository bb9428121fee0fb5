//! Tests of the library, a file for each capability. `cargo test --lib shadows::` runs one.

mod animation;
mod chains;
mod diff;
mod drawings;
mod edit;
mod export;
mod hatching;
mod lines;
mod load;
mod page;
mod project;
mod regions;
mod strokes;
mod support;
mod surface;
mod visibility;

mod without;
