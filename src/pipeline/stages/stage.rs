//! [`Stage`]: the stages whose result can be drawn in place of the finished drawing.

/// A stage whose result can be drawn, for looking into the pipeline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Stage {
    /// n·v on the faces in front, in bands of colour parted by its zero set.
    Field,
    /// The zero sets as they are traced, hidden or not, and where visibility may change.
    Zeros,
    /// All feature lines as they were found, hidden or not.
    Lines,
    /// The view map: every view edge by itself, with its invisibility.
    ViewMap,
    /// The visible view edges, coloured by how strong they are.
    Strengths,
    /// The chains, before they get their pens.
    Chains,
    /// The chains in grey, and what was left out on the way to them.
    Removed,
}

impl Stage {
    /// All stages, in the order of the pipeline.
    pub const ALL: [Self; 7] =
        [Self::Field, Self::Zeros, Self::Lines, Self::ViewMap, Self::Strengths, Self::Chains, Self::Removed];

    /// The name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
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

    /// The stage of that name.
    #[must_use]
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|stage| stage.name() == name)
    }
}
