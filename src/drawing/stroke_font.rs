//! Single-stroke letters: text that looks the same in SVG, PDF, PNG and on plotters, without fonts.
//!
//! A table holds the strokes of each character as SVG path data. Texts are scaled to the requested x-height.

use kurbo::{Affine, BezPath, Point};

/// Gap between letters, in units of [`LETTER_STROKES`].
const LETTER_GAP: f64 = 1.3;

/// Height of small letters (x-height) in [`LETTER_STROKES`].
const X_HEIGHT: f64 = 4.0;

/// The bowl that many letters have.
const BOWL_PATH: &str = "M0-2C0-3.1.67-4 1.5-4S3-3.1 3-2 2.33 0 1.5 0 0-.9 0-2Z";

/// Letters: character, width, whether it has a bowl, and its other strokes. x right, y down, baseline at 0.
const LETTER_STROKES: [(char, f64, bool, &str); 43] = [
    (' ', 1.0, false, ""),
    ('-', 1.8, false, "M0-2H1.8"),
    ('.', 0.2, false, "M0 0H.2"),
    (',', 0.3, false, "M.3-.2L0 .8"),
    (':', 0.2, false, "M0-3H.2M0 0H.2"),
    ('_', 2.6, false, "M0 1H2.6"),
    ('/', 2.2, false, "M0 .8L2.2-6"),
    ('0', 3.0, false, "M1.5-6C.6-6 0-4.8 0-3S.6 0 1.5 0 3-1.2 3-3 2.4-6 1.5-6Z"),
    ('1', 1.4, false, "M0-4.8L1.4-6V0"),
    ('2', 2.9, false, "M.1-4.6C.2-5.5.8-6 1.5-6 2.3-6 2.9-5.4 2.9-4.6 2.9-3 .8-2 0 0H2.9"),
    (
        '3',
        2.9,
        false,
        "M.2-5.2C.5-5.7.9-6 1.5-6 2.2-6 2.7-5.4 2.7-4.6S2.2-3.2 1.3-3.2C2.3-3.2 2.9-2.5 2.9-1.6 2.9-.7 2.3 0 1.4 0 .8 0 .3-.3 0-.9",
    ),
    ('4', 3.0, false, "M2.3 0V-6L0-1.6H3"),
    (
        '5',
        2.9,
        false,
        "M2.6-6H.5L.3-3.3C.6-3.6 1-3.8 1.5-3.8 2.3-3.8 2.9-3 2.9-1.9S2.3 0 1.4 0C.8 0 .3-.3 0-.8",
    ),
    ('6', 3.0, true, "M2.5-5.9C1-5.5 0-4 0-2"),
    ('7', 2.8, false, "M0-6H2.8L.8 0"),
    (
        '8',
        2.9,
        false,
        "M1.45-3.2C.7-3.2.2-3.8.2-4.6S.7-6 1.45-6 2.7-5.4 2.7-4.6 2.2-3.2 1.45-3.2ZM1.45-3.2C.6-3.2 0-2.5 0-1.6S.6 0 1.45 0 2.9-.7 2.9-1.6 2.3-3.2 1.45-3.2Z",
    ),
    ('9', 3.0, false, "M1.5-6C.67-6 0-5.1 0-4S.67-2 1.5-2 3-2.9 3-4 2.33-6 1.5-6ZM3-4C3-2 2-.5.5-.1"),
    ('a', 3.0, true, "M3-4V0"),
    ('b', 3.0, true, "M0-6V0"),
    ('c', 2.8, false, "M2.8-3.3C2.5-3.75 2.1-4 1.5-4 .67-4 0-3.1 0-2S.67 0 1.5 0C2.1 0 2.5-.25 2.8-.7"),
    ('d', 3.0, true, "M3-6V0"),
    ('e', 3.0, false, "M0-2H3C3-3.1 2.33-4 1.5-4S0-3.1 0-2 .67 0 1.5 0C2.1 0 2.5-.25 2.8-.7"),
    ('f', 1.9, false, "M1.9-6C1-6.1.7-5.6.7-4.8V0M0-4H1.8"),
    ('g', 3.0, true, "M3-4V.4C3 1.5 2.4 2 1.5 2 .9 2 .4 1.8.1 1.4"),
    ('h', 2.8, false, "M0-6V0M0-2.4C0-3.4.6-4 1.5-4S2.8-3.4 2.8-2.4V0"),
    ('i', 0.0, false, "M0-4V0M0-5.7V-5.3"),
    ('j', 0.8, false, "M.8-4V1C.8 1.7.5 2 0 2M.8-5.7V-5.3"),
    ('k', 2.8, false, "M0-6V0M2.6-4L0-1.6M.9-2.4L2.8 0"),
    ('l', 0.8, false, "M0-6V-.8C0-.2.3 0 .8 0"),
    (
        'm',
        4.2,
        false,
        "M0-4V0M0-2.6C0-3.5.4-4 1.1-4S2.1-3.5 2.1-2.6V0M2.1-2.6C2.1-3.5 2.5-4 3.2-4S4.2-3.5 4.2-2.6V0",
    ),
    ('n', 2.8, false, "M0-4V0M0-2.4C0-3.4.6-4 1.5-4S2.8-3.4 2.8-2.4V0"),
    ('o', 3.0, true, ""),
    ('p', 3.0, true, "M0-4V2"),
    ('q', 3.0, true, "M3-4V2"),
    ('r', 1.6, false, "M0-4V0M0-2.4C0-3.4.6-4 1.6-4"),
    (
        's',
        2.7,
        false,
        "M2.6-3.4C2.3-3.8 1.9-4 1.4-4 .7-4 .2-3.6.2-3 .2-1.6 2.7-2.4 2.7-1 2.7-.4 2.1 0 1.4 0 .8 0 .3-.2 0-.7",
    ),
    ('t', 1.8, false, "M.7-5.4V-1C.7-.3 1.1 0 1.8 0M0-4H1.8"),
    ('u', 2.8, false, "M0-4V-1.6C0-.6.5 0 1.3 0S2.8-.6 2.8-1.6M2.8-4V0"),
    ('v', 2.8, false, "M0-4L1.4 0L2.8-4"),
    ('w', 4.4, false, "M0-4L1.1 0L2.2-3.6L3.3 0L4.4-4"),
    ('x', 2.6, false, "M0-4L2.6 0M2.6-4L0 0"),
    ('y', 2.8, false, "M0-4L1.4 0M2.8-4L1.1.9C.8 1.7.5 2 0 2"),
    ('z', 2.5, false, "M0-4H2.5L0 0H2.5"),
];

/// A text in small letters with x-height `height`, its baseline centred at `middle`.
///
/// Capitals become small letters. Characters that [`LETTER_STROKES`] lacks are omitted.
pub(crate) fn stroke_text(text: &str, height: f64, middle: Point) -> BezPath {
    let letters = text
        .chars()
        .map(|c| c.to_ascii_lowercase())
        .filter_map(|c| LETTER_STROKES.iter().find(|(known, ..)| *known == c));
    let mut line = BezPath::new();
    let mut at = 0.0;
    for (_, width, has_bowl, strokes) in letters {
        for strokes in [if *has_bowl { BOWL_PATH } else { "" }, strokes] {
            // All strokes are valid path data; a test parses them.
            let strokes = BezPath::from_svg(strokes).unwrap_or_default();
            line.extend(Affine::translate((at, 0.0)) * strokes);
        }
        at += width + LETTER_GAP;
    }
    let scale = height / X_HEIGHT;
    let left = middle.x - (at - LETTER_GAP).max(0.0) * scale / 2.0;
    Affine::new([scale, 0.0, 0.0, scale, left, middle.y]) * line
}

#[cfg(test)]
mod tests {
    use super::*;
    use kurbo::Shape;

    #[test]
    fn stroke_font_letters_parse_and_fit_their_width() {
        for (letter, width, has_bowl, strokes) in LETTER_STROKES {
            let path = BezPath::from_svg(strokes).unwrap();
            let bounds = path.bounding_box();
            assert!(
                strokes.is_empty() || (bounds.x0 >= 0.0 && bounds.x1 <= width + 0.05),
                "{letter}: {bounds:?}"
            );
            assert!(!has_bowl || width == 3.0, "{letter}");
        }
    }

    #[test]
    fn stroke_font_covers_every_style_name() {
        for name in crate::Style::names() {
            assert!(name.chars().all(|c| LETTER_STROKES.iter().any(|(known, ..)| *known == c)), "{name}");
            let bounds = stroke_text(name, 8.0, Point::new(100.0, 50.0)).bounding_box();
            assert!((bounds.center().x - 100.0).abs() < 1.0, "{name}: {bounds:?}");
        }
    }
}
