//! Transforms of marks.

use kurbo::{Affine, Vec2};

use super::{Mark, Paint, PieceContent};

impl Mark {
    /// The mark transformed by `place`. Line widths and dashes are scaled with it.
    #[must_use]
    pub fn placed(mut self, place: Affine) -> Self {
        let scale = place.determinant().abs().sqrt();
        self.path.apply_affine(place);
        if let Some(text) = &mut self.provenance.text {
            text.place = place * text.place;
        }
        match &mut self.paint {
            Paint::Stroke(stroke) => {
                stroke.width *= scale;
                stroke.dash.iter_mut().for_each(|length| *length *= scale);
                stroke.dash_offset *= scale;
            }
            Paint::Fill(_) => {}
            Paint::Gradient(gradient) => {
                gradient.start = place * gradient.start;
                gradient.end = place * gradient.end;
            }
            Paint::Outline(outline) => {
                outline.axis.apply_affine(place);
                outline.width *= scale;
                outline.pen_width *= scale;
            }
            Paint::Image(image) => {
                for piece in &mut image.pieces {
                    piece.outline.apply_affine(place);
                    if let PieceContent::Pixels(at) = &mut piece.shows {
                        *at = place * *at;
                    }
                }
            }
        }
        self
    }

    /// The mark moved by a vector.
    #[must_use]
    pub fn moved(self, by: Vec2) -> Self {
        self.placed(Affine::translate(by))
    }
}
