//! How regions are collected and painted: part of the `[fills]` table of a style sheet.

use serde::{Deserialize, Serialize};

use crate::drawing::Length;

/// Treatment of the border between two regions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Seams {
    /// The region painted first extends a little under its neighbour. No paper shows through where both are
    /// anti-aliased.
    #[default]
    Underlap,
    /// Regions end at their border.
    Exact,
}

/// How steps of light are painted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum StepsAs {
    /// Each step in its own colour.
    #[default]
    Bands,
    /// As one gradient where steps lie side by side along straight, parallel borders; elsewhere each in its
    /// own colour.
    Gradients,
}

/// How regions are collected and painted.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RegionOptions {
    /// Whether regions are painted at all. Default: false.
    pub enabled: bool,
    /// How steps of light are painted. Default: bands.
    pub steps_as: StepsAs,
    /// Treatment of borders. Default: underlap.
    pub seams: Seams,
    /// How far a region extends under its neighbour. Default: 0.6 px.
    pub underlap: Length,
    /// Regions with less area than a square of this side go to a neighbour. Default: 2 px.
    pub crumb: Length,
    /// How far a fitted border may lie from the exact one. Default: 0.05 px.
    pub fit_tolerance: Length,
}

impl Default for RegionOptions {
    fn default() -> Self {
        Self {
            enabled: false,
            steps_as: StepsAs::Bands,
            seams: Seams::Underlap,
            underlap: Length::px(0.6),
            crumb: Length::px(2.0),
            fit_tolerance: Length::px(0.05),
        }
    }
}
