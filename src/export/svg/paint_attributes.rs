//! [`Attributes`]: the painting attributes of SVG marks, such as `fill` and `stroke-width`.
//!
//! Attributes that most marks of a group share are written once at the group, so files are smaller. A mark
//! writes only those that differ from its group.

use rustc_hash::FxHashMap;

use crate::colour::srgb::Colour;
use crate::drawing::{Cap, Join, Mark, OutlinePaint, Paint};
use crate::export::encoding::decimals::Decimals;

/// Value of one attribute.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum AttributeValue {
    /// Any value: the attribute has no influence on the mark.
    Any,
    /// `none`.
    None,
    /// A colour; its opacity is a separate attribute.
    Colour(Colour),
    /// 0 (transparent) to 255; written as a decimal from 0 to 1.
    Opacity(u8),
    /// Width as a whole number of units of the last of [`WIDTH_DECIMALS`] decimals.
    Width(i64),
    Cap(Cap),
    Join(Join),
}

/// Decimals of stroke widths. They are finer than coordinates, because 0.25 mm is 0.945 px.
pub(crate) const WIDTH_DECIMALS: u8 = 3;

/// Attribute names in written order.
const ATTRIBUTE_NAMES: [&str; 7] =
    ["fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "stroke-linecap", "stroke-linejoin"];

/// Initial values of the attributes by the SVG specification.
const INITIAL_ATTRIBUTES: Attributes = Attributes([
    AttributeValue::Colour(Colour::BLACK),
    AttributeValue::Opacity(255),
    AttributeValue::None,
    AttributeValue::Opacity(255),
    AttributeValue::Width(1000),
    AttributeValue::Cap(Cap::Butt),
    AttributeValue::Join(Join::Miter),
]);

/// Painting attributes of a mark except dashes: one value for each of [`ATTRIBUTE_NAMES`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Attributes([AttributeValue; 7]);

impl Attributes {
    /// The attributes that a mark needs.
    pub(crate) fn of(mark: &Mark) -> Self {
        use AttributeValue::Any;
        match &mark.paint {
            Paint::Stroke(stroke) => Self([
                AttributeValue::None,
                Any,
                AttributeValue::Colour(opaque(stroke.colour)),
                AttributeValue::Opacity(stroke.colour.a),
                AttributeValue::Width(Decimals::new(WIDTH_DECIMALS).round(stroke.width)),
                AttributeValue::Cap(stroke.cap),
                AttributeValue::Join(stroke.join),
            ]),
            // Each gradient is written separately as the mark's own fill.
            Paint::Gradient(gradient) => {
                let opacity = gradient.stops.first().map_or(255, |(_, colour)| colour.a);
                Self([Any, AttributeValue::Opacity(opacity), AttributeValue::None, Any, Any, Any, Any])
            }
            Paint::Fill(colour) | Paint::Outline(OutlinePaint { colour, .. }) => Self([
                AttributeValue::Colour(opaque(*colour)),
                AttributeValue::Opacity(colour.a),
                AttributeValue::None,
                Any,
                Any,
                Any,
                Any,
            ]),
            // An image consists of pieces. Those of a single colour are opaque fills and use these
            // attributes.
            Paint::Image(_) => {
                Self([Any, AttributeValue::Opacity(255), AttributeValue::None, Any, Any, Any, Any])
            }
        }
    }

    /// Attributes for a group: for each attribute, the most frequent value; of equally frequent values, the
    /// first. `runs` holds attributes and the number of consecutive marks with them.
    pub(crate) fn common(runs: &[(Self, usize)]) -> Self {
        let mut common = INITIAL_ATTRIBUTES;
        for (index, best) in common.0.iter_mut().enumerate() {
            let mut counts: FxHashMap<AttributeValue, usize> = FxHashMap::default();
            let values = || {
                let of_run = |(set, count): &(Self, usize)| Some((*set.0.get(index)?, *count));
                runs.iter().filter_map(of_run).filter(|(value, _)| *value != AttributeValue::Any)
            };
            for (value, count) in values() {
                *counts.entry(value).or_default() += count;
            }
            let mut most = 0;
            for (value, _) in values() {
                let count = counts.get(&value).copied().unwrap_or_default();
                if count > most {
                    most = count;
                    *best = value;
                }
            }
        }
        common
    }

    /// Writes the attributes of an outermost group; `ink` is the colour written as `currentColor`.
    pub(crate) fn write(&self, out: &mut Vec<u8>, ink: Option<Colour>) {
        let mut outer = INITIAL_ATTRIBUTES;
        if ink == Some(Colour::BLACK)
            && let Some(fill) = outer.0.first_mut()
        {
            // Black is the initial fill, but must be written if it is `currentColor`.
            *fill = AttributeValue::Any;
        }
        self.write_over(&outer, out, ink);
    }

    /// Writes the attributes that differ from an outer group.
    pub(crate) fn write_over(&self, outer: &Self, out: &mut Vec<u8>, ink: Option<Colour>) {
        for ((name, value), outer) in ATTRIBUTE_NAMES.iter().zip(&self.0).zip(&outer.0) {
            if value == outer || *value == AttributeValue::Any {
                continue;
            }
            out.push(b' ');
            out.extend_from_slice(name.as_bytes());
            out.extend_from_slice(b"=\"");
            match value {
                AttributeValue::Any => {}
                AttributeValue::None => out.extend_from_slice(b"none"),
                AttributeValue::Colour(colour) if ink == Some(*colour) => {
                    out.extend_from_slice(b"currentColor")
                }
                AttributeValue::Colour(colour) => out.extend_from_slice(hex(*colour).as_bytes()),
                AttributeValue::Opacity(a) => {
                    out.extend_from_slice(Decimals::new(3).text(f64::from(*a) / 255.0).as_bytes());
                }
                AttributeValue::Width(width) => {
                    Decimals::new(WIDTH_DECIMALS).write(out, *width);
                }
                AttributeValue::Cap(cap) => out.extend_from_slice(match cap {
                    Cap::Butt => b"butt",
                    Cap::Round => b"round",
                    Cap::Square => b"square",
                }),
                AttributeValue::Join(join) => out.extend_from_slice(match join {
                    Join::Miter => b"miter",
                    Join::Round => b"round",
                    Join::Bevel => b"bevel",
                }),
            }
            out.push(b'"');
        }
    }

    /// Whether a mark inside `outer` needs no attributes.
    pub(crate) fn fits(&self, outer: &Self) -> bool {
        self.0.iter().zip(&outer.0).all(|(value, outer)| value == outer || *value == AttributeValue::Any)
    }
}

/// Whether two marks need the same attributes, apart from dashes.
#[inline]
pub(crate) fn have_equal_paint(a: &Mark, b: &Mark) -> bool {
    match (&a.paint, &b.paint) {
        (Paint::Stroke(a), Paint::Stroke(b)) => {
            let rounded = |width| Decimals::new(WIDTH_DECIMALS).round(width);
            let same_width = a.width == b.width || rounded(a.width) == rounded(b.width);
            same_width && a.colour == b.colour && a.cap == b.cap && a.join == b.join
        }
        (Paint::Stroke(_) | Paint::Gradient(_) | Paint::Image(_), _)
        | (_, Paint::Stroke(_) | Paint::Gradient(_) | Paint::Image(_)) => false,
        // Outlines of lines are filled like regions.
        (a, b) => filled(a) == filled(b),
    }
}

/// Fill colour of a path; `None` for strokes, gradients and images.
fn filled(paint: &Paint) -> Option<Colour> {
    match paint {
        Paint::Stroke(_) | Paint::Gradient(_) | Paint::Image(_) => None,
        Paint::Fill(colour) | Paint::Outline(OutlinePaint { colour, .. }) => Some(*colour),
    }
}

/// The colour without its opacity.
fn opaque(colour: Colour) -> Colour {
    Colour { a: 255, ..colour }
}

/// A colour as `#rgb` where that equals `#rrggbb`.
pub(crate) fn hex(colour: Colour) -> String {
    let Colour { r, g, b, .. } = colour;
    if [r, g, b].iter().all(|channel| channel % 17 == 0) {
        format!("#{:x}{:x}{:x}", r / 17, g / 17, b / 17)
    } else {
        colour.hex()
    }
}
