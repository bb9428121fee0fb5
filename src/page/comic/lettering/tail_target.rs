//! [`Target`]: what a tail points at, and the face that nothing is to cover.

use kurbo::{Point, Rect};

use crate::page::figure::Place;
use crate::page::layout::Polygon;

/// Words in the names of parts that speak.
const FACES: [&str; 6] = ["mouth", "beak", "face", "head", "helmet", "skull"];

/// A part that fills more than this share of its panel is no face.
const LARGEST_FACE: f64 = 0.3;

/// What a tail points at.
pub(crate) struct Target {
    /// The name of the part.
    pub part: String,
    /// The outline of the part on the page, within its panel.
    pub hull: Polygon,
    /// The point in it that the tail goes towards.
    pub aim: Point,
    /// What is kept free of balloons.
    pub face: Option<Polygon>,
}

impl Target {
    /// Of several parts that which is called a face, or the highest one; none where none is within the panel.
    pub fn of(places: &[Place], panel: &Polygon) -> Option<Self> {
        let within = |place: &Place| Polygon(place.hull.clone()).common(panel);
        let seen: Vec<(&Place, Polygon)> = places
            .iter()
            .map(|place| (place, within(place)))
            .filter(|(_, hull)| hull.area() > 1e-3)
            .collect();
        let rank = |part: &str| {
            let part = part.to_ascii_lowercase();
            FACES.iter().position(|face| part.contains(face)).unwrap_or(FACES.len())
        };
        let top = |hull: &Polygon| hull.bounds().y0;
        let (place, hull) = seen.iter().min_by(|(a, one), (b, other)| {
            rank(&a.part).cmp(&rank(&b.part)).then(top(one).total_cmp(&top(other)))
        })?;
        let bounds = hull.bounds();
        let is_face = hull.area() <= LARGEST_FACE * panel.area();
        // Of what is larger, the tail points at the upper part.
        let (hull, aim) = match is_face {
            true => (hull.clone(), bounds.center()),
            false => {
                let upper = Rect { y1: bounds.y0 + bounds.height() * 0.4, ..bounds };
                let upper = hull.common(&Polygon::from(upper));
                (hull.clone(), upper.bounds().center())
            }
        };
        let face = is_face.then(|| hull.clone());
        Some(Self { part: place.part.clone(), hull, aim, face })
    }
}
