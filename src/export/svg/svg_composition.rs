//! A page of several drawings as SVG: one group for each drawing, with its layers inside.

use kurbo::{Affine, BezPath};

use super::svg_drawing::{finished, open};
use super::svg_options::SvgOptions;
use crate::drawing::{Composition, Drawing, PlacedDrawing};
use crate::export::encoding::decimals::Decimals;
use crate::export::encoding::embedded_pictures::{PictureIds, matrix};
use crate::export::encoding::xml::{UniqueIds, escape};
use crate::export::paths::canonical_path::{CanonicalWriter, PathForm};

impl Composition {
    /// Writes the page as SVG text. Each drawing is a layer with its name, clipped to its frame and moved to
    /// its place, and contains the drawing's own layers. Their ids start with the name of the drawing. The
    /// same page gives the same bytes.
    ///
    /// ```
    /// use ligne::drawing::{Composition, Drawing, Page, PlacedDrawing, Unit};
    /// use ligne::kurbo::Affine;
    ///
    /// let page = Page { width: 50.0, height: 50.0, unit: Unit::Mm, background: None };
    /// let drawing = Drawing::new("", page, Vec::new());
    /// let item = PlacedDrawing { name: "left".into(), drawing, place: Affine::translate((5.0, 0.0)), clip: None };
    /// let svg = Composition::new("two", page, vec![item]).to_svg(&Default::default());
    /// assert!(svg.contains(r#"<g id="left" inkscape:groupmode="layer" inkscape:label="left" transform="translate(5)""#));
    /// ```
    #[must_use]
    pub fn to_svg(&self, options: &SvgOptions) -> String {
        let mut ids = UniqueIds::new(&options.id_prefix);
        let take_ids = |item: &PlacedDrawing, ids: &mut UniqueIds| {
            let id = ids.take(&item.name);
            let clip = item.clip.as_ref().map(|_| ids.take(&format!("{}-frame", item.name)));
            (id, clip)
        };
        let ids_of: Vec<(String, Option<String>)> =
            self.items.iter().map(|item| take_ids(item, &mut ids)).collect();
        let mut pictures: Vec<PictureIds> = Vec::with_capacity(self.items.len());
        for PlacedDrawing { name, drawing, .. } in &self.items {
            ids.within(name);
            pictures.push(PictureIds::of(drawing, &mut ids));
        }
        let uses = pictures.iter().any(|picture_ids| !picture_ids.is_empty());
        ids.within("");
        let mut out = Vec::new();
        open(&mut out, (&self.title, &self.page), (uses, false), options, &mut ids);
        Drawing::new("", self.page, Vec::new()).paper(&mut out, &mut ids);
        for ((item, (id, clip)), picture_ids) in self.items.iter().zip(&ids_of).zip(&pictures) {
            ids.within("");
            if let (Some(id), Some(path)) = (clip, &item.clip) {
                // The clip path is in the units of the clipped drawing.
                let decimals = Decimals::new(options.decimals(item.drawing.page.unit));
                write_clip(&mut out, id, &(item.place.inverse() * path.clone()), decimals);
            }
            open_item(&mut out, (id, &item.name), clip.as_deref(), item.place);
            ids.within(&item.name);
            item.drawing.write_content(&mut out, picture_ids, options, &mut ids);
            out.extend_from_slice(b"</g>\n");
        }
        finished(out)
    }
}

fn write_clip(out: &mut Vec<u8>, id: &str, path: &BezPath, decimals: Decimals) {
    out.extend_from_slice(format!("<clipPath id=\"{id}\"><path d=\"").as_bytes());
    CanonicalWriter::new(decimals).write(out, path, PathForm::Filled);
    out.extend_from_slice(b"\"/></clipPath>\n");
}

/// Writes the start tag of a drawing's group.
fn open_item(out: &mut Vec<u8>, (id, name): (&str, &str), clip: Option<&str>, place: Affine) {
    out.extend_from_slice(b"<g id=\"");
    out.extend_from_slice(id.as_bytes());
    out.extend_from_slice(b"\" inkscape:groupmode=\"layer\" inkscape:label=\"");
    escape(out, name);
    out.push(b'"');
    if let Some(clip) = clip {
        out.extend_from_slice(format!(" clip-path=\"url(#{clip})\"").as_bytes());
    }
    out.extend_from_slice(transform(place).as_bytes());
    out.extend_from_slice(b">\n");
}

/// The `transform` attribute that places a drawing; empty for the identity.
fn transform(place: Affine) -> String {
    let [a, b, c, d, x, y] = place.as_coeffs();
    if [a, b, c, d] != [1.0, 0.0, 0.0, 1.0] {
        return format!(" transform=\"matrix({})\"", matrix(place, " "));
    }
    let text = |value: f64| Decimals::new(SHIFT_DECIMALS).text(value);
    match (text(x), text(y)) {
        (x, y) if x == "0" && y == "0" => String::new(),
        (x, y) if y == "0" => format!(" transform=\"translate({x})\""),
        (x, y) => format!(" transform=\"translate({x} {y})\""),
    }
}

/// Decimals of a drawing's shift, finer than its coordinates.
const SHIFT_DECIMALS: u8 = 4;
