//! How lines are linked, tidied, smoothed and fitted: the `[chain]` table of a style sheet.

use serde::{Deserialize, Serialize};

use crate::drawing::Length;

/// How lines are linked, tidied, smoothed and fitted. A length of 0 turns its step off; with all
/// steps off a chain is exactly the projected mesh edges.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ChainOptions {
    /// How far smoothing may move a point of a line on a smooth surface. Default: 0.5 px.
    pub smooth: Length,
    /// How far a simplified line may lie from the points left out. Default: 0.05 px.
    pub simplify: Length,
    /// Loose pieces shorter than this are left out. Default: 4 px.
    pub tidy: Length,
    /// Whether lines on smooth surfaces become Bézier curves. Default: true.
    pub fit: bool,
    /// How far a fitted curve may lie from the smoothed line. Default: 0.15 px.
    pub fit_tolerance: Length,
}

impl Default for ChainOptions {
    fn default() -> Self {
        Self {
            smooth: Length::px(0.5),
            simplify: Length::px(0.05),
            tidy: Length::px(4.0),
            fit: true,
            fit_tolerance: Length::px(0.15),
        }
    }
}
