//! [`TailTarget`]: the part that the tail of a balloon points at.

use kurbo::{Point, Rect};

use crate::page::figure::PartExtent;
use crate::page::layout::ConvexPolygon;
use crate::page::tolerances::MIN_TARGET_AREA_MM2;

/// Words in the names of parts that speak, most specific first.
const FACE_WORDS: [&str; 6] = ["mouth", "beak", "face", "head", "helmet", "skull"];

/// Maximum share of the panel that a face covers; larger parts are not faces.
const MAX_FACE_AREA_SHARE: f64 = 0.3;

/// The target of a balloon's tail.
pub(crate) struct TailTarget {
    /// Name of the part.
    pub part: String,
    /// Convex hull of the part on the page, clipped to its panel.
    pub hull: ConvexPolygon,
    /// The point of the hull that the tail points to.
    pub aim: Point,
    /// The hull, if the part is a face and must not be covered.
    pub face: Option<ConvexPolygon>,
}

impl TailTarget {
    /// Chooses one of several parts: the one that is named like a face, otherwise the highest one. `None` if
    /// no part is in the panel.
    pub(crate) fn of(places: &[PartExtent], panel: &ConvexPolygon) -> Option<Self> {
        let within = |place: &PartExtent| ConvexPolygon(place.hull.clone()).common(panel);
        let seen: Vec<(&PartExtent, ConvexPolygon)> = places
            .iter()
            .map(|place| (place, within(place)))
            .filter(|(_, hull)| hull.area() > MIN_TARGET_AREA_MM2)
            .collect();
        let rank = |part: &str| {
            let part = part.to_ascii_lowercase();
            FACE_WORDS.iter().position(|face| part.contains(face)).unwrap_or(FACE_WORDS.len())
        };
        let top = |hull: &ConvexPolygon| hull.bounds().y0;
        let (place, hull) = seen.iter().min_by(|(a, one), (b, other)| {
            rank(&a.part).cmp(&rank(&b.part)).then(top(one).total_cmp(&top(other)))
        })?;
        let bounds = hull.bounds();
        let is_face = hull.area() <= MAX_FACE_AREA_SHARE * panel.area();
        // The tail points at the upper part of a large part.
        let (hull, aim) = match is_face {
            true => (hull.clone(), bounds.center()),
            false => {
                let upper = Rect { y1: bounds.y0 + bounds.height() * 0.4, ..bounds };
                let upper = hull.common(&ConvexPolygon::from(upper));
                (hull.clone(), upper.bounds().center())
            }
        };
        let face = is_face.then(|| hull.clone());
        Some(Self { part: place.part.clone(), hull, aim, face })
    }
}
