//! [`Facet`]: a triangle that shows a part of a picture, small or flat enough that one affine map brings the
//! picture to the page.

use glam::{DVec2, DVec3};

use crate::mesh::PartId;
use crate::view::Frame;

/// Corner of a facet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FacetCorner {
    /// Position in image space.
    pub image: DVec3,
    /// Place that it shows, in the plane of the texels.
    pub place: DVec2,
}

/// Triangle that shows a part of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Facet {
    pub corners: [FacetCorner; 3],
    /// Part of the model it belongs to.
    pub part: PartId,
    /// Its colour, if it shows a single one.
    pub colour: Option<crate::colour::srgb::Colour>,
    /// One bit per side, from each corner to the next: whether it is separated there from the next facet.
    parted: u8,
    /// One bit per side: whether another face passes through there.
    walls: u8,
}

impl Facet {
    /// Facet that is separated from nothing.
    pub(crate) const fn new(corners: [FacetCorner; 3], part: PartId) -> Self {
        Self { corners, part, colour: None, parted: 0, walls: 0 }
    }
}

impl Facet {
    /// Twice its area on the page, positive where it turns from x to y.
    pub(crate) fn area2(&self) -> f64 {
        let [a, b, c] = self.corners.map(|corner| corner.image.truncate());
        (b - a).perp_dot(c - a)
    }

    /// Four points at distance `reach` around its centre, with the places they would show.
    ///
    /// The corners of a narrow facet alone determine the map poorly across the facet.
    pub(crate) fn around(&self, reach: f64, perspective: bool) -> Option<[FacetCorner; 4]> {
        let [a, b, c] = self.corners;
        let weight = |corner: &FacetCorner| if perspective { corner.image.z } else { 1.0 };
        let (qa, qb, qc) = (weight(&a), weight(&b), weight(&c));
        // The place is a quotient of two functions that are linear on the page.
        let (nb, nc) = ((b.place - a.place) * qb, (c.place - a.place) * qc);
        let [u, v] = [b, c].map(|corner| (corner.image - a.image).truncate());
        let double_area = u.perp_dot(v);
        let (along_x, along_y) = (DVec2::new(v.y, -u.y) / double_area, DVec2::new(-v.x, u.x) / double_area);
        let middle = (u + v) / 3.0;
        let corner_at = |at: DVec2| {
            let share = [along_x.x * at.x + along_y.x * at.y, along_x.y * at.x + along_y.y * at.y];
            let q = qa + (qb - qa) * share[0] + (qc - qa) * share[1];
            let n = nb * share[0] + nc * share[1];
            let image = (a.image.truncate() + at).extend(q);
            FacetCorner { image, place: a.place + n / q }
        };
        let probes = [DVec2::X, -DVec2::X, DVec2::Y, -DVec2::Y].map(|axis| corner_at(middle + axis * reach));
        probes.iter().all(|corner| corner.place.is_finite()).then_some(probes)
    }

    /// Smallest and largest place that it shows.
    pub(crate) fn places(&self) -> [DVec2; 2] {
        let [a, b, c] = self.corners.map(|corner| corner.place);
        [a.min(b).min(c), a.max(b).max(c)]
    }

    /// Whether its bounding box meets the page.
    pub(crate) fn is_on(&self, frame: &Frame) -> bool {
        let [a, b, c] = self.corners.map(|corner| corner.image.truncate());
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        high.x >= 0.0 && high.y >= 0.0 && low.x <= frame.width && low.y <= frame.height
    }

    /// Whether another face passes through at a side.
    pub(crate) fn is_wall(&self, side: usize) -> bool {
        self.walls >> side & 1 == 1
    }

    /// Whether any side is separated.
    pub(crate) fn is_cut(&self) -> bool {
        self.parted != 0
    }

    /// Whether a side is separated from the next facet: by another face there, or farther along the line of
    /// the side.
    pub(crate) fn is_parted(&self, side: usize) -> bool {
        self.parted >> side & 1 == 1
    }

    /// Marks a side as separated; another face may pass through there.
    pub(crate) fn with_parted(self, side: usize, wall: bool) -> Self {
        Self { parted: self.parted | 1 << side, walls: self.walls | u8::from(wall) << side, ..self }
    }

    /// The same facet, starting with another corner.
    pub(crate) fn turned(&self, first: usize) -> Self {
        let turned = |bits: u8| (0..3).fold(0, |all, k| all | (bits >> ((first + k) % 3) & 1) << k);
        let corners = [0, 1, 2].map(|k| self.corners[(first + k) % 3]);
        Self { corners, parted: turned(self.parted), walls: turned(self.walls), ..*self }
    }

    /// Both parts of the facet after a cut at a point of a side. The first keeps the first corner of the
    /// side, the second its second corner.
    pub(crate) fn cut(&self, side: usize, share: f64, frame: &Frame) -> [Self; 2] {
        let rotated = self.turned(side);
        let [a, b, c] = rotated.corners;
        let middle = between(a, b, share, frame);
        let of = |corners, sides: u8| {
            let (parted, walls) = (rotated.parted & sides, rotated.walls & sides);
            Self { corners, parted, walls, ..rotated }
        };
        [of([a, middle, c], 0b101), of([middle, b, c], 0b011)]
    }

    /// Like [`Self::cut`], with the share of the side measured on the page.
    pub(crate) fn cut_on_page(&self, side: usize, share: f64, frame: &Frame) -> [Self; 2] {
        if !frame.perspective {
            return self.cut(side, share, frame);
        }
        let [a, b] = [side, (side + 1) % 3].map(|k| self.corners[k].image.z);
        self.cut(side, share * b / ((1.0 - share) * a + share * b), frame)
    }

    /// Longest side, and a bound for the error of one affine map.
    ///
    /// The bound is the distance on the page between the midpoint of the side and the image of its midpoint
    /// in space. The facet's whole depth range is taken to lie along the side.
    pub(crate) fn miss(&self) -> (usize, f64) {
        let length = |side: usize| (self.corners[side].image - self.corners[(side + 1) % 3].image).truncate();
        let (side, longest) = [0, 1, 2]
            .map(|side| (side, length(side).length()))
            .into_iter()
            .fold((0, 0.0), |longest, candidate| if candidate.1 > longest.1 { candidate } else { longest });
        let [a, b, c] = self.corners.map(|corner| corner.image.z);
        let (farthest, nearest) = (a.min(b).min(c), a.max(b).max(c));
        (side, longest * (nearest - farthest) / (2.0 * (nearest + farthest)).abs())
    }
}

/// Image of a point of a side in space.
fn between(a: FacetCorner, b: FacetCorner, share: f64, frame: &Frame) -> FacetCorner {
    // Measured from the same end in both facets that have the side.
    let order =
        |p: DVec3, q: DVec3| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)).then(p.z.total_cmp(&q.z)).is_gt();
    let (a, b, share) = if order(a.image, b.image) { (b, a, 1.0 - share) } else { (a, b, share) };
    let place = a.place.lerp(b.place, share);
    if !frame.perspective {
        return FacetCorner { image: a.image.lerp(b.image, share), place };
    }
    let (wa, wb) = ((1.0 - share) / a.image.z, share / b.image.z);
    let at = (a.image.truncate() * wa + b.image.truncate() * wb) / (wa + wb);
    FacetCorner { image: at.extend(1.0 / (wa + wb)), place }
}

/// Cuts facets so that none shows more than `spans` texels along x or y.
///
/// Facets that show a repetition narrower than `min_period` user units are left out, because the whole picture is
/// visible there at once.
pub(crate) fn cut_to_spans(
    facets: Vec<Facet>,
    spans: [Option<f64>; 2],
    periods: [Option<f64>; 2],
    min_period: f64,
    frame: &Frame,
) -> Vec<Facet> {
    let mut open = facets;
    open.reverse();
    let mut done = Vec::with_capacity(open.len());
    while let Some(facet) = open.pop() {
        let [low, high] = facet.places();
        let too_long = (0..2).find_map(|axis| {
            let span = spans[axis].filter(|span| high[axis] - low[axis] > *span)?;
            Some((axis, span))
        });
        let Some((axis, span)) = too_long else {
            done.push(facet);
            continue;
        };
        if !facet.is_on(frame) || shrinks(&facet, periods, min_period) {
            continue;
        }
        let at = (f64::midpoint(low[axis], high[axis]) / span).round() * span;
        // The cut is at a multiple of the span if one lies within, otherwise in the middle.
        let at = if at > low[axis] && at < high[axis] { at } else { f64::midpoint(low[axis], high[axis]) };
        let crosses = |side: &usize| {
            let (a, b) = (facet.corners[*side].place[axis], facet.corners[(side + 1) % 3].place[axis]);
            (a < at) != (b < at)
        };
        let length = |side: &usize| {
            (facet.corners[*side].place[axis] - facet.corners[(side + 1) % 3].place[axis]).abs()
        };
        let longest = (0..3).filter(crosses).max_by(|a, b| length(a).total_cmp(&length(b)));
        let Some(side) = longest.filter(|side| length(side) > 0.0) else {
            done.push(facet);
            continue;
        };
        let (a, b) = (facet.corners[side].place[axis], facet.corners[(side + 1) % 3].place[axis]);
        open.extend(facet.cut(side, ((at - a) / (b - a)).clamp(0.01, 0.99), frame));
        if done.len() + open.len() > MAX_FACETS {
            break;
        }
    }
    done
}

/// Largest number of facets of a picture.
const MAX_FACETS: usize = 1 << 19;

/// Whether a repetition of the picture is narrower than `min_period` on a facet.
fn shrinks(facet: &Facet, periods: [Option<f64>; 2], min_period: f64) -> bool {
    let [a, b, c] = facet.corners;
    let (p, q) = (b.place - a.place, c.place - a.place);
    let double_area = p.perp_dot(q);
    let [on_page, along] = [b, c].map(|corner| (corner.image - a.image).truncate());
    (0..2).any(|axis| {
        let Some(period) = periods[axis] else { return false };
        // Length on the page of a step of one texel.
        let step = if axis == 0 { (q.y, -p.y) } else { (-q.x, p.x) };
        let texel_step = (on_page * step.0 + along * step.1) / double_area;
        texel_step.length() * period < min_period
    })
}
