//! Small things and test shapes: [`teapot`], [`knot`], [`jar`], [`horn`], [`picnic`], [`easter`], [`shelf`],
//! and the brush picture of [`brush`].

pub mod brush;
pub mod easter;
pub mod horn;
pub mod jar;
pub mod knot;
pub mod picnic;
pub mod shelf;
pub mod teapot;
