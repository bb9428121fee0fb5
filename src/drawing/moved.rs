//! Marks moved on the page.

use kurbo::{Affine, Vec2};

use super::{Mark, Paint, Shows};

impl Mark {
    /// The mark, so far from where it was.
    #[must_use]
    pub fn moved(mut self, by: Vec2) -> Self {
        let moved = Affine::translate(by);
        self.path.apply_affine(moved);
        if let Some(text) = &mut self.provenance.text {
            text.place = moved * text.place;
        }
        match &mut self.paint {
            Paint::Stroke(_) | Paint::Fill(_) => {}
            Paint::Gradient(gradient) => {
                gradient.start += by;
                gradient.end += by;
            }
            Paint::Outline(outline) => outline.axis.apply_affine(moved),
            Paint::Image(image) => {
                for piece in &mut image.pieces {
                    piece.outline.apply_affine(moved);
                    if let Shows::Pixels(place) = &mut piece.shows {
                        *place = moved * *place;
                    }
                }
            }
        }
        self
    }
}
