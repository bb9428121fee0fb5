//! [`Method`]: first- or third-angle projection.

use serde::Deserialize;

/// Which side of a view shows what lies beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// A view from the left is on the right of the front view.
    #[default]
    First,
    /// A view from the left is on the left of the front view.
    Third,
}
