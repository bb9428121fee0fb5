//! A view on a sheet: its camera, its size and its place on paper.
//!
//! Files, in reading order:
//!
//! - `sheet_view`: direction, extent, scale and position of a view; maps points of the model to the page.
//! - [`projection_method`]: first- or third-angle projection.
//! - `scale_series`: the standard scales (ISO 5455) and their text.
//! - [`view_side`]: the four sides of a view, and a length along one of them.

pub(crate) mod projection_method;
pub(crate) mod scale_series;
pub(crate) mod sheet_view;
pub(crate) mod view_side;
