//! Writes one mark of a drawing as SVG: a `path` element, and a `linearGradient` if its paint needs one.
//!
//! Paint attributes that the enclosing group already has are left out. The mark's origin is written as
//! `data-` attributes: model part, material, tone, number of hiding surfaces, stable id, and the axis of
//! variable-width strokes.

use super::mark_order;
use super::paint_attributes::{Attributes, WIDTH_DECIMALS, hex};
use crate::colour::srgb::Colour;
use crate::drawing::{Gradient, Mark, Paint};
use crate::export::encoding::decimals::Decimals;
use crate::export::encoding::xml::escape;

/// Decimals of dash lengths. Finer than coordinates, because errors accumulate along a path.
const DASH_DECIMALS: u8 = 3;

/// Decimals of gradient stop positions.
const STOP_DECIMALS: u8 = 4;

/// Writes a gradient as a `linearGradient` element in user units. `decimals` is the precision of coordinates.
pub(crate) fn write_gradient(out: &mut Vec<u8>, gradient: &Gradient, id: &str, decimals: Decimals) {
    let number = |value: f64| decimals.text(value);
    let Gradient { start, end, stops } = gradient;
    let line = format!(
        "<linearGradient id=\"{id}\" gradientUnits=\"userSpaceOnUse\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\">",
        number(start.x),
        number(start.y),
        number(end.x),
        number(end.y),
    );
    out.extend_from_slice(line.as_bytes());
    for (place, colour) in stops {
        let place = Decimals::new(STOP_DECIMALS).text(*place);
        let stop = format!("<stop offset=\"{place}\" stop-color=\"{}\"/>", hex(*colour));
        out.extend_from_slice(stop.as_bytes());
    }
    out.extend_from_slice(b"</linearGradient>\n");
}

/// Characters of a mark's id, 5 bits each. With 30 bits, two lines of a drawing are unlikely to have equal
/// ids.
const ID_LETTERS: u32 = 6;

/// The lowest 30 bits of an identity in base 32: digits and lower-case letters.
fn short_id(identity: u64) -> String {
    const DIGITS: &[u8; 32] = b"0123456789abcdefghjkmnpqrstuvwxy";
    let digit = |place: u32| char::from(DIGITS[(identity >> (5 * place) & 31) as usize]);
    (0..ID_LETTERS).map(digit).collect()
}

/// Writes a mark as a `path` element.
///
/// - `outer` holds the attributes of the enclosing group, and `attributes` those of the mark. Only values
///   that differ are written.
/// - `gradient` is the id of the mark's gradient, if any. `ink` is the colour written as `currentColor`.
/// - `data` is the path data (`d`). `axis` is the path data of a stroke's centre line, used for
///   variable-width strokes only.
pub(crate) fn write_mark(
    out: &mut Vec<u8>,
    mark: &Mark,
    outer: &Attributes,
    attributes: &Attributes,
    (gradient, ink): (Option<&String>, Option<Colour>),
    [axis, data]: [&[u8]; 2],
) {
    let provenance = &mark.provenance;
    out.extend_from_slice(b"<path");
    if !provenance.classes.is_empty() || provenance.tone.is_some() {
        let before = out.len();
        out.extend_from_slice(b" class=\"");
        let empty = out.len();
        mark_order::write_classes(out, &provenance.classes, provenance.tone);
        if out.len() == empty {
            out.truncate(before);
        } else {
            out.push(b'"');
        }
    }
    let mut named = |name: &[u8], text: &str| {
        out.extend_from_slice(name);
        escape(out, text);
        out.push(b'"');
    };
    if let Some(part) = &provenance.part {
        named(b" data-part=\"", part);
    }
    if let (Paint::Fill(_) | Paint::Gradient(_), Some(material)) = (&mark.paint, &provenance.material) {
        named(b" data-material=\"", material);
    }
    if let Some(tone) = provenance.tone {
        named(b" data-tone=\"", &tone.to_string());
    }
    if provenance.invisibility > 0 {
        named(b" data-invisibility=\"", &provenance.invisibility.to_string());
    }
    if provenance.identity > 0 {
        named(b" data-id=\"", &short_id(provenance.identity));
    }
    if let Some(text) = &provenance.text {
        named(b" aria-label=\"", &text.words);
    }
    if let Paint::Outline(outline) = &mark.paint {
        out.extend_from_slice(b" data-axis=\"");
        out.extend_from_slice(axis);
        out.extend_from_slice(b"\" data-width=\"");
        let fine = Decimals::new(WIDTH_DECIMALS);
        fine.write(out, fine.round(outline.width));
        out.push(b'"');
    }
    attributes.write_over(outer, out, ink);
    if let Some(id) = gradient {
        out.extend_from_slice(format!(" fill=\"url(#{id})\"").as_bytes());
    }
    if let Paint::Stroke(stroke) = &mark.paint
        && !stroke.dash.is_empty()
    {
        let fine = Decimals::new(DASH_DECIMALS);
        out.extend_from_slice(b" stroke-dasharray=\"");
        for (index, dash) in stroke.dash.iter().enumerate() {
            if index > 0 {
                out.push(b' ');
            }
            fine.write(out, fine.round(*dash));
        }
        out.push(b'"');
        if fine.round(stroke.dash_offset) != 0 {
            out.extend_from_slice(b" stroke-dashoffset=\"");
            fine.write(out, fine.round(stroke.dash_offset));
            out.push(b'"');
        }
    }
    out.extend_from_slice(b" d=\"");
    out.extend_from_slice(data);
    match &provenance.note {
        None => out.extend_from_slice(b"\"/>\n"),
        Some(note) => {
            out.extend_from_slice(b"\"><title>");
            escape(out, note);
            out.extend_from_slice(b"</title></path>\n");
        }
    }
}
