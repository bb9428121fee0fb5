//! [`Stage`]: the stages whose result can be drawn in place of the finished drawing.

/// A stage whose result can be drawn, for looking into the pipeline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stage {
    /// All feature lines as they were found, hidden or not.
    Lines,
    /// The view map: every view edge by itself, with its invisibility.
    ViewMap,
    /// The chains, before they get their pens.
    Chains,
}

impl Stage {
    /// All stages, in the order of the pipeline.
    pub const ALL: [Self; 3] = [Self::Lines, Self::ViewMap, Self::Chains];

    /// The name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lines => "lines",
            Self::ViewMap => "viewmap",
            Self::Chains => "chains",
        }
    }

    /// The stage of that name.
    #[must_use]
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|stage| stage.name() == name)
    }
}
