//! Marks that show pictures, in SVG: a group clipped to the mark's outline, which uses a picture of the
//! document piece by piece.
//!
//! The output uses only widely supported features: clipping by one path, masks, `use` and a transform. A clip
//! path and its content are in page units, so that the pieces of one picture meet to the last written
//! decimal.
//!
//! Pieces overlap slightly to avoid visible gaps. Half-transparent pieces would be darker there. They are
//! written into a mask instead, opaque and with a lightness equal to their opacity, and the mark's outline is
//! filled through it.

use kurbo::BezPath;

use super::mark_order;
use super::paint_attributes::{Attributes, hex};
use crate::colour::srgb::Colour;
use crate::drawing::{ImagePaint, ImagePiece, Mark, PieceContent};
use crate::export::encoding::decimals::Decimals;
use crate::export::encoding::embedded_pictures::{PictureIds, matrix};
use crate::export::encoding::xml::escape;
use crate::export::paths::canonical_path::{CanonicalWriter, PathForm};

/// Writes a mark; `area` is the path data of its outline.
pub(crate) fn write(
    out: &mut Vec<u8>,
    (mark, image): (&Mark, &ImagePaint),
    (outer, attributes): (&Attributes, &Attributes),
    area: &[u8],
    named: &PictureIds,
    decimals: Decimals,
) {
    let (id, picture) = (named.mark(mark), named.picture(image));
    let provenance = &mark.provenance;
    let ink = named.ink(image);
    if ink.is_some() {
        out.extend_from_slice(format!("<mask id=\"{id}\"").as_bytes());
        attributes.write_over(outer, out, None);
        out.extend_from_slice(b">\n");
        pieces(out, image, [id, picture], ink, decimals);
        out.extend_from_slice(b"</mask>\n");
    }
    let tag = if ink.is_some() { "<path class=\"" } else { "<g class=\"" };
    out.extend_from_slice(tag.as_bytes());
    mark_order::write_classes(out, &provenance.classes, provenance.tone);
    out.push(b'"');
    let names =
        [(&b" data-part=\""[..], &provenance.part), (&b" data-material=\""[..], &provenance.material)];
    for (attribute, name) in names {
        if let Some(name) = name {
            out.extend_from_slice(attribute);
            escape(out, name);
            out.push(b'"');
        }
    }
    attributes.write_over(outer, out, None);
    if let Some(ink) = ink {
        out.extend_from_slice(format!(" fill=\"{}\" mask=\"url(#{id})\" d=\"", hex(ink)).as_bytes());
        out.extend_from_slice(area);
        out.extend_from_slice(b"\"/>\n");
        return;
    }
    out.extend_from_slice(format!(" clip-path=\"url(#{id})\">\n").as_bytes());
    clip(out, id, area);
    pieces(out, image, [id, picture], None, decimals);
    out.extend_from_slice(b"</g>\n");
}

/// Writes the pieces of a picture; inside a mask, with a lightness equal to their opacity.
fn pieces(
    out: &mut Vec<u8>,
    image: &ImagePaint,
    [id, picture]: [&str; 2],
    ink: Option<Colour>,
    decimals: Decimals,
) {
    let mut canonical = CanonicalWriter::new(decimals);
    let mut data = Vec::new();
    for (number, pieces) in image.pieces.chunk_by(of_one_colour).enumerate() {
        data.clear();
        let path: BezPath =
            pieces.iter().flat_map(|piece| piece.outline.elements().iter().copied()).collect();
        let Some(shows) = pieces.first().map(|piece| piece.shows) else { continue };
        let form = if matches!(shows, PieceContent::Colour(_)) { PathForm::Filled } else { PathForm::Kept };
        canonical.write(&mut data, &path, form);
        if data.is_empty() {
            continue;
        }
        match shows {
            PieceContent::Pixels(transform) => {
                let own = format!("{id}-{}", number + 1);
                clip(out, &own, &data);
                let used = format!(
                    "<g clip-path=\"url(#{own})\"><use xlink:href=\"#{picture}\" transform=\"matrix({})\"/></g>\n",
                    matrix(transform, " ")
                );
                out.extend_from_slice(used.as_bytes());
            }
            PieceContent::Colour(colour) => {
                let light = Colour { r: colour.a, g: colour.a, b: colour.a, a: 255 };
                let colour = if ink.is_some() { light } else { colour };
                out.extend_from_slice(format!("<path fill=\"{}\" d=\"", hex(colour)).as_bytes());
                out.extend_from_slice(&data);
                out.extend_from_slice(b"\"/>\n");
            }
        }
    }
}

/// Whether two consecutive pieces can share one path.
fn of_one_colour(a: &ImagePiece, b: &ImagePiece) -> bool {
    let colour = |piece: &ImagePiece| -> Option<Colour> {
        match piece.shows {
            PieceContent::Colour(colour) => Some(colour),
            PieceContent::Pixels(_) => None,
        }
    };
    colour(a).is_some() && colour(a) == colour(b)
}

fn clip(out: &mut Vec<u8>, id: &str, data: &[u8]) {
    out.extend_from_slice(format!("<clipPath id=\"{id}\"><path d=\"").as_bytes());
    out.extend_from_slice(data);
    out.extend_from_slice(b"\"/></clipPath>\n");
}
