//! [`Stage`]: names of the pipeline stages whose intermediate results can be drawn instead of the finished
//! drawing, to debug the pipeline.

/// A pipeline stage whose result can be drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub(crate) enum Stage {
    /// n·v (normal and view direction) on the front faces, in bands of colour separated by its zero set.
    Field,
    /// Zero sets of n·v, the smooth contours, as traced, hidden or not; and the edges where visibility may
    /// change.
    Zeros,
    /// All feature lines as found, hidden or not.
    Lines,
    /// The view map: every view edge separately, with its invisibility.
    ViewMap,
    /// The visible view edges, coloured by strength.
    Strengths,
    /// The chains, before they get pens.
    Chains,
    /// The chains in grey, and the lines removed by tidying.
    Removed,
}

impl Stage {
    /// All stages, in the order of the pipeline.
    pub(crate) const ALL: [Self; 7] =
        [Self::Field, Self::Zeros, Self::Lines, Self::ViewMap, Self::Strengths, Self::Chains, Self::Removed];

    /// The name on the command line.
    #[must_use]
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Field => "field",
            Self::Zeros => "zeros",
            Self::Lines => "lines",
            Self::ViewMap => "viewmap",
            Self::Strengths => "strengths",
            Self::Chains => "chains",
            Self::Removed => "removed",
        }
    }

    /// The stage of a name on the command line.
    #[must_use]
    pub(crate) fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|stage| stage.name() == name)
    }
}
