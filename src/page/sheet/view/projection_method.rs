//! [`ProjectionMethod`]: the projection method, first- or third-angle.

use serde::Deserialize;

/// The projection method: on which side of the front view the other views stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ProjectionMethod {
    /// First angle: the view from the left is on the right of the front view.
    #[default]
    First,
    /// Third angle: the view from the left is on the left of the front view.
    Third,
}
