//! Painting attributes of SVG, hoisted to the groups that share them.

use rustc_hash::FxHashMap;

use crate::colour::srgb::Colour;
use crate::drawing::{Cap, Join, Mark, OutlinePaint, Paint};
use crate::export::encoding::decimals::Decimals;

/// Value of one attribute.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Value {
    /// Has no influence on the mark.
    Any,
    /// `none`.
    None,
    /// A colour; its opacity is an attribute of its own.
    Colour(Colour),
    /// 0 to 255.
    Opacity(u8),
    /// Steps of [`WIDTH_DECIMALS`].
    Width(i64),
    Cap(Cap),
    Join(Join),
}

/// Decimals of widths, finer than those of coordinates: 0.25 mm is 0.945 px.
pub(crate) const WIDTH_DECIMALS: u8 = 3;

const NAMES: [&str; 7] =
    ["fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "stroke-linecap", "stroke-linejoin"];

/// What holds where nothing is written.
const INITIAL: Attributes = Attributes([
    Value::Colour(Colour::BLACK),
    Value::Opacity(255),
    Value::None,
    Value::Opacity(255),
    Value::Width(1000),
    Value::Cap(Cap::Butt),
    Value::Join(Join::Miter),
]);

/// How marks are painted, but for dashes: one value for each of [`NAMES`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Attributes([Value; 7]);

impl Attributes {
    /// The attributes a mark needs.
    pub fn of(mark: &Mark) -> Self {
        use Value::Any;
        match &mark.paint {
            Paint::Stroke(stroke) => Self([
                Value::None,
                Any,
                Value::Colour(opaque(stroke.colour)),
                Value::Opacity(stroke.colour.a),
                Value::Width(Decimals::new(WIDTH_DECIMALS).round(stroke.width)),
                Value::Cap(stroke.cap),
                Value::Join(stroke.join),
            ]),
            // The gradient is the mark's own: it is written beside these.
            Paint::Gradient(gradient) => {
                let opacity = gradient.stops.first().map_or(255, |(_, colour)| colour.a);
                Self([Any, Value::Opacity(opacity), Value::None, Any, Any, Any, Any])
            }
            Paint::Fill(colour) | Paint::Outline(OutlinePaint { colour, .. }) => Self([
                Value::Colour(opaque(*colour)),
                Value::Opacity(colour.a),
                Value::None,
                Any,
                Any,
                Any,
                Any,
            ]),
            // Its pieces of one colour are filled, opaque, and nothing else.
            Paint::Image(_) => Self([Any, Value::Opacity(255), Value::None, Any, Any, Any, Any]),
        }
    }

    /// What is best written on a group: of each attribute the value of the most marks, the first
    /// of equally frequent ones. Of each run of marks that are painted alike, the attributes and how many they are.
    pub fn common(runs: &[(Self, usize)]) -> Self {
        let mut common = INITIAL;
        for (index, best) in common.0.iter_mut().enumerate() {
            let mut counts: FxHashMap<Value, usize> = FxHashMap::default();
            let values = || {
                let of_run = |(set, count): &(Self, usize)| Some((*set.0.get(index)?, *count));
                runs.iter().filter_map(of_run).filter(|(value, _)| *value != Value::Any)
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

    /// Writes what a group must say at the top of the document; `ink` is the colour that is `currentColor`.
    pub fn write(&self, out: &mut Vec<u8>, ink: Option<Colour>) {
        let mut outer = INITIAL;
        if ink == Some(Colour::BLACK)
            && let Some(fill) = outer.0.first_mut()
        {
            // Black, which goes without saying elsewhere, is another colour here.
            *fill = Value::Any;
        }
        self.write_over(&outer, out, ink);
    }

    /// Writes what differs inside a group that says `outer`.
    pub fn write_over(&self, outer: &Self, out: &mut Vec<u8>, ink: Option<Colour>) {
        for ((name, value), outer) in NAMES.iter().zip(&self.0).zip(&outer.0) {
            if value == outer || *value == Value::Any {
                continue;
            }
            out.push(b' ');
            out.extend_from_slice(name.as_bytes());
            out.extend_from_slice(b"=\"");
            match value {
                Value::Any => {}
                Value::None => out.extend_from_slice(b"none"),
                Value::Colour(colour) if ink == Some(*colour) => out.extend_from_slice(b"currentColor"),
                Value::Colour(colour) => out.extend_from_slice(hex(*colour).as_bytes()),
                Value::Opacity(a) => {
                    out.extend_from_slice(Decimals::new(3).text(f64::from(*a) / 255.0).as_bytes());
                }
                Value::Width(width) => {
                    Decimals::new(WIDTH_DECIMALS).write(out, *width);
                }
                Value::Cap(cap) => out.extend_from_slice(match cap {
                    Cap::Butt => b"butt",
                    Cap::Round => b"round",
                    Cap::Square => b"square",
                }),
                Value::Join(join) => out.extend_from_slice(match join {
                    Join::Miter => b"miter",
                    Join::Round => b"round",
                    Join::Bevel => b"bevel",
                }),
            }
            out.push(b'"');
        }
    }

    /// Whether nothing needs to be written inside a group that says `outer`.
    pub fn fits(&self, outer: &Self) -> bool {
        self.0.iter().zip(&outer.0).all(|(value, outer)| value == outer || *value == Value::Any)
    }
}

/// Whether two marks are painted alike but for their dashes: they need the same attributes.
#[inline]
pub(crate) fn alike(a: &Mark, b: &Mark) -> bool {
    match (&a.paint, &b.paint) {
        (Paint::Stroke(a), Paint::Stroke(b)) => {
            let rounded = |width| Decimals::new(WIDTH_DECIMALS).round(width);
            let same_width = a.width == b.width || rounded(a.width) == rounded(b.width);
            same_width && a.colour == b.colour && a.cap == b.cap && a.join == b.join
        }
        (Paint::Stroke(_) | Paint::Gradient(_) | Paint::Image(_), _)
        | (_, Paint::Stroke(_) | Paint::Gradient(_) | Paint::Image(_)) => false,
        // The outline of a line is filled as a region is.
        (a, b) => filled(a) == filled(b),
    }
}

/// The colour that a path is filled with.
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

/// `#rgb` where it says the same as `#rrggbb`.
pub(crate) fn hex(colour: Colour) -> String {
    let Colour { r, g, b, .. } = colour;
    if [r, g, b].iter().all(|channel| channel % 17 == 0) {
        format!("#{:x}{:x}{:x}", r / 17, g / 17, b / 17)
    } else {
        colour.hex()
    }
}
