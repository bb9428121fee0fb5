//! Legend of the overlay, in single-stroke letters that need no font.

use kurbo::{Affine, BezPath, Size};

use crate::colour::srgb::Colour;

/// Height of a lower-case letter in line widths.
const LETTER_HEIGHT_WIDTHS: f64 = 6.0;
/// Height of the legend in line widths.
const LEGEND_HEIGHT_WIDTHS: f64 = 24.0;

/// Height of the legend below a picture.
pub(crate) fn height(width: f64) -> f64 {
    width * LEGEND_HEIGHT_WIDTHS
}

/// Strokes of the legend with colour and width: a sample and a word for each row. The legend shrinks if it
/// would be wider than the picture.
pub(crate) fn marks(
    rows: &[(&'static str, Colour)],
    picture: Size,
    width: f64,
) -> Vec<(BezPath, Colour, f64)> {
    let mut found = Vec::new();
    let size = width * LETTER_HEIGHT_WIDTHS;
    let base = picture.height + height(width) * 0.62;
    let mut x = size * 1.5;
    for (word, colour) in rows {
        let mut sample = BezPath::new();
        sample.move_to((x, base - size / 2.0));
        sample.line_to((x + size * 3.0, base - size / 2.0));
        found.push((sample, *colour, width * 2.0));
        x += size * 4.0;
        for letter in word.chars() {
            let (path, wide) = glyph(letter);
            let place = Affine::translate((x, base)) * Affine::scale(size / 4.0);
            found.push((place * path, TEXT_COLOUR, width * 0.8));
            x += (wide + 1.6) * size / 4.0;
        }
        x += size * 2.0;
    }
    let share = (picture.width / x).min(1.0);
    if share < 1.0 {
        let smaller = Affine::translate((0.0, base * (1.0 - share))) * Affine::scale(share);
        for (path, _, width) in &mut found {
            path.apply_affine(smaller);
            *width *= share;
        }
    }
    found
}

/// Colour of the words.
const TEXT_COLOUR: Colour = Colour::rgb(0x40, 0x40, 0x40);

/// A single-stroke letter with an x-height of four units, baseline at y = 0, and its width.
fn glyph(letter: char) -> (BezPath, f64) {
    let (data, wide) = match letter {
        'a' => ("M3 0V-4M3 -2.7C2.6 -3.6 0 -5.2 0 -2S2.6 -.4 3 -1.3", 3.0),
        'b' => ("M0 0V-6M0 -2.7C.4 -3.6 3 -5.2 3 -2S.4 -.4 0 -1.3", 3.0),
        'd' => ("M3 0V-6M3 -2.7C2.6 -3.6 0 -5.2 0 -2S2.6 -.4 3 -1.3", 3.0),
        'e' => ("M0 -2H3C3 -5 0 -4.6 0 -2S2 .4 2.9 -.8", 3.0),
        'g' => ("M3 -4V.6C3 2.2 .8 2.2 .2 1.4M3 -2.7C2.6 -3.6 0 -5.2 0 -2S2.6 -.4 3 -1.3", 3.0),
        'i' => ("M.5 0V-4M.5 -5.6V-5.4", 1.0),
        'l' => ("M.5 0V-6", 1.0),
        'm' => ("M0 0V-4M0 -2.6C.6 -4.4 2 -4.4 2 -2.8V0M2 -2.6C2.6 -4.4 4 -4.4 4 -2.8V0", 4.0),
        'n' => ("M0 0V-4M0 -2.6C.6 -4.4 3 -4.6 3 -2.6V0", 3.0),
        'o' => ("M1.5 0C-.5 0 -.5 -4 1.5 -4S3.5 0 1.5 0Z", 3.0),
        'p' => ("M0 2V-4M0 -2.7C.4 -3.6 3 -5.2 3 -2S.4 -.4 0 -1.3", 3.0),
        'r' => ("M0 0V-4M0 -2.4C.4 -3.6 1.2 -4.1 2 -3.9", 2.0),
        't' => ("M1 -5.4V-1C1 0 1.6 .2 2.2 -.1M0 -4H2", 2.2),
        'v' => ("M0 -4L1.5 0L3 -4", 3.0),
        'w' => ("M0 -4L1.1 0L2.2 -3.6L3.3 0L4.4 -4", 4.4),
        _ => ("", 2.0),
    };
    (BezPath::from_svg(data).unwrap_or_default(), wide)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legend_glyphs_cover_every_word() {
        for letter in "gonenewmovedrepaintedrelabelled".chars() {
            assert!(glyph(letter).0.elements().len() > 1, "{letter}");
        }
        let rows = [("gone", Colour::BLACK), ("relabelled", Colour::BLACK)];
        assert_eq!(marks(&rows, Size::new(500.0, 100.0), 1.0).len(), 2 + 4 + 10);
    }
    #[test]
    fn a_legend_is_no_wider_than_its_picture() {
        use kurbo::Shape as _;
        let rows = ["gone", "new", "moved", "repainted", "relabelled"].map(|word| (word, Colour::BLACK));
        for width in [40.0, 200.0, 1000.0] {
            let right = marks(&rows, Size::new(width, 100.0), 1.0)
                .iter()
                .map(|(path, _, line)| path.bounding_box().x1 + line / 2.0)
                .fold(0.0, f64::max);
            assert!(right < width, "{right} of {width}");
        }
    }
}
