//! [`ProjectionMethod`]: first- or third-angle projection, which decides where the views of a technical sheet
//! stand around the front view.
//!
//! Source: ISO 5456-2:1996.

use serde::Deserialize;

/// Side of the front view on which each other view stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum ProjectionMethod {
    /// First angle: the view from the left is on the right of the front view.
    #[default]
    First,
    /// Third angle: the view from the left is on the left of the front view.
    Third,
}
