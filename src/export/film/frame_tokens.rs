//! Frames as lists of numbers for their lines of text, so that equal lines have equal numbers.
//!
//! A path is identified by everything except its start point. Shifted copies have the same number.

use rustc_hash::FxHashMap;

/// A line of a frame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum FrameToken {
    /// A path: its number, and its start point as written.
    Path(usize, Box<str>),
    /// Any other line, by the number of its text.
    Other(usize),
}

/// A path without its start point.
#[derive(Debug, Clone)]
pub(crate) struct TokenPath {
    /// Text before and after the first coordinates.
    pub before: Box<str>,
    pub after: Box<str>,
    /// Start point in the first frame that contains it.
    pub first: Box<str>,
    /// Number of occurrences.
    pub count: usize,
    /// Whether all occurrences start at the same point.
    pub stays: bool,
}

/// All lines of all frames, each once.
#[derive(Debug, Default)]
pub(crate) struct FrameTokens {
    pub shapes: Vec<TokenPath>,
    pub other_lines: Vec<Box<str>>,
    known_shapes: FxHashMap<(Box<str>, Box<str>), usize>,
    known_others: FxHashMap<Box<str>, usize>,
}

impl FrameTokens {
    /// Numbers the lines of a frame.
    pub(crate) fn of<'a>(&mut self, lines: impl Iterator<Item = &'a str>) -> Vec<FrameToken> {
        lines.map(|line| self.token(line)).collect()
    }

    /// Numbers a line of a frame.
    fn token(&mut self, line: &str) -> FrameToken {
        let Some([before, place, after]) = parts(line) else {
            let next = self.other_lines.len();
            let number = *self.known_others.entry(line.into()).or_insert(next);
            if number == next {
                self.other_lines.push(line.into());
            }
            return FrameToken::Other(number);
        };
        let next = self.shapes.len();
        let number = *self.known_shapes.entry((before.into(), after.into())).or_insert(next);
        if number == next {
            let (before, after, first) = (before.into(), after.into(), place.into());
            self.shapes.push(TokenPath { before, after, first, count: 0, stays: true });
        }
        if let Some(shape) = self.shapes.get_mut(number) {
            shape.count += 1;
            shape.stays &= *shape.first == *place;
        }
        FrameToken::Path(number, place.into())
    }
}

/// Text of a path before its first coordinates, the coordinates, and the rest; `None` for other lines and for
/// paths that cannot be shifted.
fn parts(line: &str) -> Option<[&str; 3]> {
    // Paths with references, or with an axis next to the outline, cannot be shifted.
    let path = line.starts_with("<path") && (line.ends_with("/>") || line.ends_with("</path>"));
    if !path || line.contains("url(#") || line.contains(" id=\"") {
        return None;
    }
    let start = line.find(" d=\"M")? + 5;
    if line.contains(" data-axis=") {
        return Some([line.get(..start)?, "", line.get(start..)?]);
    }
    let rest = line.get(start..)?;
    let first = number(rest)?;
    let between = rest.get(first..)?;
    let blank = usize::from(between.starts_with(' '));
    let end = first + blank + number(between.get(blank..)?)?;
    Some([line.get(..start)?, rest.get(..end)?, rest.get(end..)?])
}

/// Length of the number at the start of a text.
fn number(text: &str) -> Option<usize> {
    let mut point = false;
    let goes_on = |(at, letter): (usize, char)| match letter {
        '-' => at == 0,
        '.' => !std::mem::replace(&mut point, true),
        digit => digit.is_ascii_digit(),
    };
    let mut goes_on = goes_on;
    let end = text.char_indices().find(|own| !goes_on(*own)).map_or(text.len(), |(at, _)| at);
    (end > 0).then_some(end)
}

/// The two coordinates of a start point.
pub(crate) fn coordinates(place: &str) -> Option<[&str; 2]> {
    let (x, rest) = place.split_at_checked(number(place)?)?;
    Some([x, rest.trim_start()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_tokens_recognize_a_path_at_any_start_point() {
        let mut tokens = FrameTokens::default();
        let lines = [
            "<g>",
            "<path class=\"crease\" d=\"M1.5.25l3 4\"/>",
            "<path class=\"crease\" d=\"M-7-8l3 4\"/>",
            "<path class=\"crease\" d=\"M1.5.25l3 5\"/>",
            "<path fill=\"url(#a)\" d=\"M1 2l3 4\"/>",
            "<path data-axis=\"M1 2l3 4\" d=\"M1 2l3 4z\"/>",
            "<g>",
        ];
        let own = tokens.of(lines.into_iter());
        assert_eq!(own[0], own[6]);
        assert_eq!(own[1], FrameToken::Path(0, "1.5.25".into()));
        assert_eq!(own[2], FrameToken::Path(0, "-7-8".into()));
        assert_eq!(own[3], FrameToken::Path(1, "1.5.25".into()));
        assert_eq!(own[4], FrameToken::Other(1));
        assert_eq!(own[5], FrameToken::Path(2, "".into()));
        assert_eq!((tokens.shapes[0].count, tokens.shapes[0].stays), (2, false));
        assert_eq!(coordinates("1.5.25"), Some(["1.5", ".25"]));
        assert_eq!(coordinates("-7-8"), Some(["-7", "-8"]));
        assert_eq!(coordinates("10 20.5"), Some(["10", "20.5"]));
    }
}
