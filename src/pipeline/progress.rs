//! [`Step`]: the steps of a drawing, for programs that show progress or cancel.

use std::fmt;

/// Step of a drawing. The variants are in order of their beginning.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Step {
    /// Finding feature lines, tones and shadows.
    Lines,
    /// Deciding the visibility of lines.
    Visibility,
    /// Painting and hatching surfaces, and linking lines into chains.
    Fills,
    /// Drawing strokes.
    Strokes,
}

/// Signature of the function.
type GoesOn = dyn Fn(Step) -> bool + Send + Sync;

/// A function that returns whether drawing goes on.
#[derive(Default)]
pub(crate) struct ProgressFunction(pub Option<Box<GoesOn>>);

impl fmt::Debug for ProgressFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("ProgressFunction")
    }
}
