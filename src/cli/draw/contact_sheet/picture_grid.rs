//! Grid of captioned drawings, combined in one drawing.

use std::collections::BTreeSet;

use kurbo::{BezPath, Point, Rect, Shape, Vec2};

use crate::colour::srgb::Colour;
use crate::drawing::stroke_font::stroke_text;
use crate::drawing::{
    Cap, Drawing, Join, Layer, LayerKind, Mark, Page, Paint, Provenance, StrokePaint, Unit,
};

/// Default side length of a picture, px.
pub(crate) const PICTURE_SIDE_PX: f64 = 320.0;

/// Gap between pictures and around the sheet, px.
const GAP_PX: f64 = 20.0;

/// Height of the caption area, and height and line width of its letters, px.
const CAPTION_HEIGHT_PX: f64 = 34.0;
const LETTER_HEIGHT_PX: f64 = 9.0;
const PEN_WIDTH_PX: f64 = 1.4;

/// Captioned drawing of the grid.
#[derive(Debug)]
pub(crate) struct GridPicture {
    /// The drawing. All drawings of a grid have the same size in px.
    pub(crate) drawing: Drawing,
    pub(crate) caption: String,
    /// Name of the layers of this picture.
    pub(crate) key: String,
}

/// Arranges pictures in rows with captions below them. Layers are named by the picture's key.
pub(crate) fn grid(pictures: Vec<GridPicture>, columns: usize) -> Drawing {
    let columns = columns.min(pictures.len()).max(1);
    let rows = pictures.len().div_ceil(columns);
    let (width, height) = pictures
        .first()
        .map_or((PICTURE_SIDE_PX, PICTURE_SIDE_PX), |p| (p.drawing.page.width, p.drawing.page.height));
    let page = Page {
        width: columns as f64 * (width + GAP_PX) + GAP_PX,
        height: rows as f64 * (height + CAPTION_HEIGHT_PX) + GAP_PX,
        unit: Unit::Px,
        background: Some(Colour::WHITE),
    };
    let mut layers: Vec<Layer> = Vec::new();
    let mut captions: Vec<Mark> = Vec::new();
    let mut keys = BTreeSet::new();
    let mut title = String::new();
    for (place, GridPicture { drawing, caption, key }) in pictures.into_iter().enumerate() {
        let (column, row) = ((place % columns) as f64, (place / columns) as f64);
        let corner =
            Vec2::new(GAP_PX + column * (width + GAP_PX), GAP_PX + row * (height + CAPTION_HEIGHT_PX));
        let key = unique(&key, &mut keys);
        title = drawing.title;
        layers.extend(drawing.page.background.filter(|colour| *colour != Colour::WHITE).map(|colour| {
            let path = Rect::new(0.0, 0.0, width, height).to_path(0.1);
            let mark = Mark { path, paint: Paint::Fill(colour), provenance: Provenance::default() };
            layer(LayerKind::Paper, &key, vec![mark.moved(corner)], false)
        }));
        layers.extend(drawing.layers.into_iter().map(|own| {
            let marks = own.marks.into_iter().map(|mark| mark.moved(corner)).collect();
            layer(own.kind, &key, marks, own.ordered)
        }));
        captions.push(caption_mark(
            &caption,
            Point::new(width / 2.0, height + CAPTION_HEIGHT_PX / 2.0) + corner,
            width,
        ));
    }
    layers.push(Layer { kind: LayerKind::Callouts, pen: None, ordered: false, marks: captions });
    Drawing::new(title, page, layers)
}

/// Turns a key into a unique id by appending a number if it is taken.
fn unique(key: &str, taken: &mut BTreeSet<String>) -> String {
    let is_kept = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    let plain: String = key.chars().map(|c| if is_kept(c) { c } else { '-' }).collect();
    let numbered = (2..).map(|number| format!("{plain}-{number}"));
    let free =
        std::iter::once(plain.clone()).chain(numbered).find(|key| !taken.contains(key)).unwrap_or(plain);
    taken.insert(free.clone());
    free
}

/// Layer named by the key of its picture.
fn layer(kind: LayerKind, key: &str, marks: Vec<Mark>, ordered: bool) -> Layer {
    Layer { kind, pen: Some(key.to_owned()), ordered, marks }
}

/// Caption drawn as strokes and shrunk to the width of its picture. The text is stored as a note as well.
fn caption_mark(caption: &str, middle: Point, width: f64) -> Mark {
    let path: BezPath = stroke_text(caption, LETTER_HEIGHT_PX, middle);
    let long = path.bounding_box().width();
    let shrink = if long > width { width / long } else { 1.0 };
    let path = if shrink < 1.0 { stroke_text(caption, LETTER_HEIGHT_PX * shrink, middle) } else { path };
    let paint = Paint::Stroke(StrokePaint::solid(
        PEN_WIDTH_PX * shrink,
        Colour::rgb(0x33, 0x33, 0x33),
        Cap::Round,
        Join::Round,
    ));
    Mark { path, paint, provenance: Provenance { note: Some(caption.into()), ..Provenance::default() } }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(caption: &str, side: f64) -> GridPicture {
        let page = Page { width: side, height: side, unit: Unit::Px, background: None };
        let drawing = Drawing::new("a", page, Vec::new());
        GridPicture { drawing, caption: caption.to_owned(), key: caption.to_owned() }
    }

    #[test]
    fn captions_are_no_wider_than_their_pictures() {
        for side in [40.0, 320.0] {
            let caption = "--azimuth -145 --elevation 22";
            let sheet = grid(vec![picture(caption, side), picture("a", side)], 6);
            assert_eq!(sheet.page.width, 2.0 * side + 60.0);
            let marks = &sheet.layers[0].marks;
            let bounds = marks[0].path.bounding_box();
            assert!(bounds.width() <= side + 1e-9 && bounds.x0 >= 19.0, "{bounds:?}");
            assert_eq!(marks[0].provenance.note.as_deref(), Some(caption));
        }
    }

    #[test]
    fn picture_keys_are_unique_and_valid_ids() {
        let mut taken = BTreeSet::new();
        let keys = ["my/ink.toml", "my ink.toml", "ink"].map(|key| unique(key, &mut taken));
        assert_eq!(keys, ["my-ink.toml", "my-ink.toml-2", "ink"]);
    }
}
