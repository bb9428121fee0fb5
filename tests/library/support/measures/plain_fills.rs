//! A style of flat fills without lines, and the fills of a drawing.

use ligne::colour::srgb::Colour;
use ligne::drawing::{Drawing, Mark, Paint};
use ligne::style::Style;

/// A toon style with one tone, in the surface colour and without lines, plus overrides.
pub(crate) fn flat_fill_style(changes: &[&str]) -> Style {
    let mut all =
        vec!["lines.enabled=false", "fills.thresholds=[]", "fills.tones=[1.0]", "light.from_model=false"];
    all.extend(changes);
    Style::load_with("toon", &all.iter().map(|change| (*change).to_owned()).collect::<Vec<_>>()).unwrap()
}

/// The filled marks of a drawing with their colours, in painting order.
pub(crate) fn filled_marks(drawing: &Drawing) -> Vec<(&Mark, Colour)> {
    let colour = |mark: &Mark| match &mark.paint {
        Paint::Fill(colour) => Some(*colour),
        _ => None,
    };
    let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
    marks.filter_map(|mark| Some((mark, colour(mark)?))).collect()
}
