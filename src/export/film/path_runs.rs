//! Runs of paths that always follow each other in every frame that contains one of them.
//!
//! A static background behind moving marks then needs one reference per frame instead of one per path.

use super::frame_tokens::{FrameToken, TokenPath};

/// Neighbour of a path across all frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Neighbour {
    Unknown,
    /// Always this path.
    Always(usize),
    Varies,
}

impl Neighbour {
    /// Adds an observation of the neighbour.
    fn observe(&mut self, other: Option<usize>) {
        let now = other.map_or(Self::Varies, Self::Always);
        *self = if *self == Self::Unknown || *self == now { now } else { Self::Varies };
    }
}

/// Lists of two or more shapes that occur in every frame in this order or not at all, sorted by their first
/// shape.
pub(crate) fn runs(frames: &[Vec<FrameToken>], shapes: &[TokenPath]) -> Vec<Vec<usize>> {
    let mut before = vec![Neighbour::Unknown; shapes.len()];
    let mut after = before.clone();
    // A shape that occurs twice in a frame or moves between frames is not part of a run.
    let joins = |token: Option<&FrameToken>| match token {
        Some(FrameToken::Path(shape, _)) => shapes
            .get(*shape)
            .filter(|token_path| token_path.stays && token_path.count > 1 && token_path.count <= frames.len())
            .map(|_| *shape),
        _ => None,
    };
    for frame in frames {
        for (token_index, token) in frame.iter().enumerate() {
            let Some(shape) = joins(Some(token)) else { continue };
            let previous = token_index.checked_sub(1).and_then(|place| joins(frame.get(place)));
            if let (Some(before), Some(after)) = (before.get_mut(shape), after.get_mut(shape)) {
                before.observe(previous);
                after.observe(joins(frame.get(token_index + 1)));
            }
        }
    }
    let follows = |shape: usize| match after.get(shape) {
        Some(Neighbour::Always(next)) if before.get(*next) == Some(&Neighbour::Always(shape)) => Some(*next),
        _ => None,
    };
    let led = |shape: usize| match before.get(shape) {
        Some(Neighbour::Always(previous)) => follows(*previous) == Some(shape),
        _ => false,
    };
    let mut runs = Vec::new();
    for shape in (0..shapes.len()).filter(|shape| !led(*shape)) {
        let run: Vec<usize> = std::iter::successors(Some(shape), |shape| follows(*shape)).collect();
        if run.len() > 1 {
            runs.push(run);
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::super::frame_tokens::FrameTokens;
    use super::*;

    #[test]
    fn path_run_groups_paths_that_always_follow_each_other() {
        let mut tokens = FrameTokens::default();
        let mut frame = |text: &str| {
            let lines: Vec<String> = text
                .chars()
                .map(|letter| format!("<path d=\"M{} 0h1\" class=\"{letter}\"/>", letter as u32))
                .collect();
            tokens.of(lines.iter().map(String::as_str))
        };
        // Each letter is a path with its own class and start point.
        let frames = ["abcdx", "abcydz", "wabc", "d"].map(&mut frame);
        let shapes: Vec<TokenPath> = tokens.shapes;
        let letters = |run: &Vec<usize>| run.len();
        let runs = runs(&frames, &shapes);
        assert_eq!(runs.iter().map(letters).collect::<Vec<_>>(), [3]);
        assert_eq!(runs[0], [0, 1, 2]);
    }
}
