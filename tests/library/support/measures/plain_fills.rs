//! Drawings of colours alone: one tone for all, no ink; and what of them is painted.

use ligne::colour::srgb::Colour;
use ligne::drawing::{Drawing, Mark, Paint};
use ligne::style::Style;

/// One tone for all, in the colour of the surface, and no ink.
pub fn plain(changes: &[&str]) -> Style {
    let mut all =
        vec!["lines.enabled=false", "fills.thresholds=[]", "fills.tones=[1.0]", "light.from_model=false"];
    all.extend(changes);
    Style::load("toon", &all.iter().map(|change| (*change).to_owned()).collect::<Vec<_>>()).unwrap()
}

/// The fills of a drawing and their colours, painted first to last.
pub fn fills(drawing: &Drawing) -> Vec<(&Mark, Colour)> {
    let colour = |mark: &Mark| match &mark.paint {
        Paint::Fill(colour) => Some(*colour),
        _ => None,
    };
    let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
    marks.filter_map(|mark| Some((mark, colour(mark)?))).collect()
}
