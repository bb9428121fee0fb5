//! Parser for SVG path data. Invalid data is rejected as a whole.

use kurbo::{BezPath, Point, Vec2};

/// Parsed path data.
#[derive(Debug, Default)]
pub(crate) struct ParsedPath {
    /// Lines and curves with absolute coordinates.
    pub path: BezPath,
    /// Start point of the data.
    pub start: Option<Point>,
    /// Whether there are arcs. Parsing stops at the first arc.
    pub has_arcs: bool,
    /// Whether there are moves without a following segment.
    pub has_lone_moves: bool,
}

/// Parses path data; `None` if it is invalid.
pub(crate) fn read(data: &str) -> Option<ParsedPath> {
    let mut reader = PathReader { bytes: data.as_bytes(), at: 0 };
    let mut found = ParsedPath::default();
    // Current point, start of the subpath, and a pending move.
    let (mut pen, mut start, mut move_to) = (Point::ZERO, Point::ZERO, None);
    // Last control point of each kind, for the shorthand curve commands.
    let (mut quad, mut cubic) = (None, None);
    let mut command = None;
    loop {
        reader.blanks();
        let Some(&next) = reader.bytes.get(reader.at) else { break };
        let letter = match next {
            letter if letter.is_ascii_alphabetic() => {
                reader.at += 1;
                letter
            }
            // More arguments of the same command; after a move they are lines.
            _ => {
                reader.comma();
                match command? {
                    b'M' => b'L',
                    b'm' => b'l',
                    b'Z' | b'z' => return None,
                    same => same,
                }
            }
        };
        let origin = if letter.is_ascii_lowercase() { pen.to_vec2() } else { Vec2::ZERO };
        let is_move = matches!(letter, b'M' | b'm');
        if !is_move {
            found.start?;
            if let Some(at) = move_to.take() {
                found.path.move_to(at);
            }
        }
        let (last_quad, last_cubic) = (quad.take(), cubic.take());
        let mirrored = |control: Option<Point>| control.map_or(pen, |c| pen + (pen - c));
        match letter.to_ascii_uppercase() {
            b'M' => {
                pen = reader.point()? + origin;
                found.start.get_or_insert(pen);
                start = pen;
                found.has_lone_moves |= move_to.replace(pen).is_some();
            }
            b'L' => {
                pen = reader.point()? + origin;
                found.path.line_to(pen);
            }
            b'H' => {
                pen.x = reader.number()? + origin.x;
                found.path.line_to(pen);
            }
            b'V' => {
                pen.y = reader.number()? + origin.y;
                found.path.line_to(pen);
            }
            b'Q' | b'T' => {
                let control = match letter {
                    b'Q' | b'q' => reader.next_point()? + origin,
                    _ => mirrored(last_quad),
                };
                pen = reader.point()? + origin;
                found.path.quad_to(control, pen);
                quad = Some(control);
            }
            b'C' | b'S' => {
                let first = match letter {
                    b'C' | b'c' => reader.next_point()? + origin,
                    _ => mirrored(last_cubic),
                };
                let second = reader.next_point()? + origin;
                pen = reader.point()? + origin;
                found.path.curve_to(first, second, pen);
                cubic = Some(second);
            }
            b'Z' => {
                found.path.close_path();
                pen = start;
            }
            b'A' => {
                found.has_arcs = true;
                return Some(found);
            }
            _ => return None,
        }
        if letter == b'Z' || letter == b'z' {
            // Segments after a close without a move start here.
            reader.blanks();
            let next = reader.bytes.get(reader.at);
            if next.is_some_and(|next| !matches!(next, b'M' | b'm')) {
                found.path.move_to(start);
            }
        }
        command = Some(letter);
    }
    found.has_lone_moves |= move_to.is_some();
    found.path.elements().iter().all(|element| element.is_finite()).then_some(found)
}

/// Reader of path data.
struct PathReader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl PathReader<'_> {
    fn blanks(&mut self) {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        self.at += rest.iter().take_while(|b| matches!(b, b' ' | b'\t' | b'\n' | b'\r' | 0x0c)).count();
    }

    /// An optional comma between numbers.
    fn comma(&mut self) {
        self.blanks();
        if self.bytes.get(self.at) == Some(&b',') {
            self.at += 1;
            self.blanks();
        }
    }

    fn point(&mut self) -> Option<Point> {
        self.blanks();
        let x = self.number()?;
        self.comma();
        Some(Point::new(x, self.number()?))
    }

    /// A point followed by another point.
    fn next_point(&mut self) -> Option<Point> {
        let point = self.point()?;
        self.comma();
        Some(point)
    }

    fn number(&mut self) -> Option<f64> {
        self.blanks();
        let begin = self.at;
        let is = |at: usize, what: &[u8]| self.bytes.get(at).is_some_and(|b| what.contains(b));
        let digits = |from: usize| {
            self.bytes.get(from..).unwrap_or_default().iter().take_while(|b| b.is_ascii_digit()).count()
        };
        let mut at = begin + usize::from(is(begin, b"+-"));
        let whole = digits(at);
        at += whole;
        let mut fraction = 0;
        if is(at, b".") {
            fraction = digits(at + 1);
            at += 1 + fraction;
        }
        if whole + fraction == 0 {
            return None;
        }
        if is(at, b"eE") {
            let sign = usize::from(is(at + 1, b"+-"));
            let exponent = digits(at + 1 + sign);
            if exponent > 0 {
                at += 1 + sign + exponent;
            }
        }
        let text = std::str::from_utf8(self.bytes.get(begin..at)?).ok()?;
        self.at = at;
        text.parse().ok()
    }
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn path_parser_follows_the_svg_path_grammar() {
        for (data, wanted) in [
            ("M1 2 3 4", "M1,2 L3,4"),
            (" m 1,2 , 3 -4.5.5-1e1 ", "M1,2 L4,-2.5 L4.5,-12.5"),
            ("M1 1h+2v.5H0V0z", "M1,1 L3,1 L3,1.5 L0,1.5 L0,0 Z"),
            ("M0 0q1 1 2 0t2 0T9 9", "M0,0 Q1,1 2,0 Q3,-1 4,0 Q5,1 9,9"),
            ("M0 0c0 1 1 2 2 2s2-1 2-2", "M0,0 C0,1 1,2 2,2 C3,2 4,1 4,0"),
            // The shorthand of one kind does not mirror the other kind.
            ("M0 0q1 1 2 0s1 1 2 0", "M0,0 Q1,1 2,0 C2,0 3,1 4,0"),
            ("M0 0c0 1 1 2 2 2t2 0", "M0,0 C0,1 1,2 2,2 Q2,2 4,2"),
            ("M5 5h1zh2m1 1h1", "M5,5 L6,5 Z M5,5 L7,5 M8,6 L9,6"),
            ("M1 1m2 2h1M9 9", "M3,3 L4,3"),
            ("M1 1L2 2A1 1 0 0 1 4 4", "M1,1 L2,2"),
        ] {
            let found = read(data).map(|found| found.path.to_svg());
            assert_eq!(found.as_deref(), Some(wanted), "{data}");
        }
        assert!(read("M1 1a1 1 0 0 0 1 1").is_some_and(|found| found.has_arcs));
        let lone = |data| read(data).is_some_and(|found| found.has_lone_moves);
        assert!(lone("M1 1m2 2h1") && lone("M1 1h1m1 1") && lone("M1 1") && !lone("M1 1z"));
    }

    #[test]
    fn path_parser_rejects_malformed_path_data() {
        for data in [
            "L1 1",
            "M1",
            "M1 1L2",
            "M1 1L2 2,",
            "M1 1 x",
            "M1 1z5",
            "M1 1 L1 1e999",
            "M,1 1",
            "none",
            "M1 1L1,,2",
            "M1 1l1 1 #",
        ] {
            assert!(read(data).is_none(), "{data}");
        }
    }
}
