//! Triangulates polygons: quads by the better diagonal, others by a fan or by ear clipping.
//!
//! Source: Eberly, *Triangulation by Ear Clipping*, sections 2 and 3. Ears are clipped in the order of the
//! corners. The state of a corner is cached until one of its inputs changes.

use glam::{DVec2, DVec3};

use crate::load::tolerances::MAX_COLLINEAR_SINE;

/// Maximum corners of a concave polygon for ear clipping; larger ones are fanned.
const MAX_CONCAVE_CORNERS: usize = 4096;

/// Maximum corner tests of ear clipping; then the rest of the polygon is fanned.
const MAX_CORNER_TESTS: usize = 100_000_000;

/// Maximum corners of a convex polygon for the search for a good apex; larger ones are fanned from the first
/// corner.
const MAX_APEX_CORNERS: usize = 512;

/// Quality of a triangulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CutOutcome {
    /// Complete.
    Sound,
    /// Fanned, at least in part, because the polygon has too many corners.
    TooLarge,
}

/// Triangulates a polygon of three or more corners; triangles are corner numbers, with the orientation of the
/// polygon.
///
/// A triangle is unchanged. A quad is split between corners 0 and 2, or between 1 and 3 if a corner is reflex
/// there or three corners are collinear. A convex polygon is fanned from its first corner that gives only
/// triangles with area. Other polygons are triangulated by ear clipping.
///
/// No diagonal runs along collinear corners. A polygon of n corners gives n − 2 triangles; very large ones
/// lose repeated corners first.
pub(crate) fn triangulate(points: &[DVec3], triangles: &mut Vec<[u32; 3]>) -> CutOutcome {
    match *points {
        [] | [_] | [_, _] => CutOutcome::Sound,
        [_, _, _] => {
            triangles.push([0, 1, 2]);
            CutOutcome::Sound
        }
        [a, b, c, d] => {
            triangles.extend(quad(a, b, c, d));
            CutOutcome::Sound
        }
        _ => polygon(points, triangles),
    }
}

/// Splits a quad into two triangles.
fn quad(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> [[u32; 3]; 2] {
    let (u, v, w) = (b - a, c - a, d - a);
    // The two halves face opposite ways if the diagonal 0-2 is outside.
    let runs_outside = u.cross(v).dot(v.cross(w)) < 0.0;
    let is_flat = |u: DVec3, v: DVec3| {
        u.cross(v).length_squared()
            <= MAX_COLLINEAR_SINE * MAX_COLLINEAR_SINE * u.length_squared() * v.length_squared()
    };
    let is_in_line = (is_flat(u, v) || is_flat(v, w)) && !(is_flat(u, w) || is_flat(c - b, d - b));
    if runs_outside || is_in_line { [[0, 1, 3], [1, 2, 3]] } else { [[0, 1, 2], [0, 2, 3]] }
}

fn polygon(points: &[DVec3], triangles: &mut Vec<[u32; 3]>) -> CutOutcome {
    let Some(flat) = flatten(points) else {
        fan(0..points.len() as u32, triangles);
        return CutOutcome::Sound;
    };
    if is_convex(&flat) {
        let count = points.len() as u32;
        if let Some(apex) = apex(&flat) {
            fan((0..count).map(|k| (apex + k) % count), triangles);
            return CutOutcome::Sound;
        }
    }
    if points.len() <= MAX_CONCAVE_CORNERS {
        return Ears::new(&flat).clip(triangles);
    }
    let mut kept: Vec<u32> = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        if i == 0 || points.get(i - 1) != Some(point) {
            kept.push(i as u32);
        }
    }
    if kept.len() > MAX_CONCAVE_CORNERS {
        fan(kept, triangles);
        return CutOutcome::TooLarge;
    }
    let flat: Vec<DVec2> = kept.iter().filter_map(|&i| flat.get(i as usize).copied()).collect();
    let first = triangles.len();
    let cut = Ears::new(&flat).clip(triangles);
    for corner in triangles.iter_mut().skip(first).flatten() {
        *corner = kept.get(*corner as usize).copied().unwrap_or_default();
    }
    cut
}

/// Triangles from the first corner to each side.
fn fan(corners: impl IntoIterator<Item = u32>, triangles: &mut Vec<[u32; 3]>) {
    let mut corners = corners.into_iter();
    let (Some(apex), Some(mut last)) = (corners.next(), corners.next()) else { return };
    for corner in corners {
        triangles.push([apex, last, corner]);
        last = corner;
    }
}

/// Projects the polygon along the axis nearest to its normal, counter-clockwise; `None` if it has no normal.
fn flatten(points: &[DVec3]) -> Option<Vec<DVec2>> {
    let first = *points.first()?;
    let next = points.iter().cycle().skip(1);
    // Newell's method.
    let normal = points.iter().zip(next).fold(DVec3::ZERO, |n, (p, q)| {
        n + DVec3::new((p.y - q.y) * (p.z + q.z), (p.z - q.z) * (p.x + q.x), (p.x - q.x) * (p.y + q.y))
    });
    if !normal.is_finite() || normal == DVec3::ZERO {
        return None;
    }
    let size = normal.abs();
    let project = |p: DVec3| {
        let p = p - first;
        if size.x >= size.y && size.x >= size.z {
            DVec2::new(if normal.x < 0.0 { -p.y } else { p.y }, p.z)
        } else if size.y >= size.z {
            DVec2::new(if normal.y < 0.0 { -p.z } else { p.z }, p.x)
        } else {
            DVec2::new(if normal.z < 0.0 { -p.x } else { p.x }, p.y)
        }
    };
    Some(points.iter().map(|&p| project(p)).collect())
}

/// Twice the signed area of a triangle, positive if counter-clockwise.
#[inline]
fn cross(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Whether no corner and no triangle of the fan turns right.
fn is_convex(points: &[DVec2]) -> bool {
    let [first, rest @ ..] = points else { return true };
    let next = points.iter().cycle().skip(1);
    let after = points.iter().cycle().skip(2);
    rest.windows(2).all(|w| matches!(w, [b, c] if cross(*first, *b, *c) >= 0.0))
        && points.iter().zip(next).zip(after).all(|((a, b), c)| cross(*a, *b, *c) >= 0.0)
}

/// Whether a triangle is counter-clockwise and its corners are not collinear.
#[inline]
fn has_area(a: DVec2, b: DVec2, c: DVec2) -> bool {
    let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    cross(a, b, c) > MAX_COLLINEAR_SINE * longest
}

/// First corner of a convex polygon whose fan has only triangles with area; corner 0 of a large polygon.
fn apex(points: &[DVec2]) -> Option<u32> {
    let count = points.len();
    if count > MAX_APEX_CORNERS {
        return Some(0);
    }
    let has_area = |a: DVec2, b: DVec2, c: DVec2| {
        cross(a, b, c) > MAX_COLLINEAR_SINE * (b - a).length() * (c - a).length()
    };
    let is_apex = |apex: &usize| {
        let at = |k: usize| points[(apex + k) % count];
        (1..count - 1).all(|k| has_area(points[*apex], at(k), at(k + 1)))
    };
    (0..count).find(is_apex).map(|apex| apex as u32)
}

/// Cached state of a corner.
#[derive(Clone, Copy, PartialEq)]
enum EarState {
    Nothing,
    /// Reflex, or collinear with its neighbours: no ear while the neighbours stay.
    Reflex,
    /// The given corner is inside the ear: no ear while that corner and the neighbours stay.
    Blocked(u32),
}

#[derive(Clone, Copy)]
struct PolygonCorner {
    point: DVec2,
    before: u32,
    after: u32,
    ear_state: EarState,
}

/// Remaining corners as a linked ring, in polygon order.
struct Ears {
    corners: Vec<PolygonCorner>,
    first: u32,
    left: usize,
    tests: usize,
}

impl Ears {
    fn new(points: &[DVec2]) -> Self {
        let n = points.len() as u32;
        let corners = points
            .iter()
            .zip(0_u32..)
            .map(|(&point, i)| PolygonCorner {
                point,
                before: if i == 0 { n.saturating_sub(1) } else { i - 1 },
                after: if i + 1 == n { 0 } else { i + 1 },
                ear_state: EarState::Nothing,
            })
            .collect();
        Self { corners, first: 0, left: points.len(), tests: 0 }
    }

    fn corner(&self, i: u32) -> PolygonCorner {
        let nowhere = PolygonCorner { point: DVec2::ZERO, before: 0, after: 0, ear_state: EarState::Reflex };
        self.corners.get(i as usize).copied().unwrap_or(nowhere)
    }

    fn ring(&self) -> impl Iterator<Item = u32> + '_ {
        std::iter::successors(Some(self.first), |&i| Some(self.corner(i).after)).take(self.left)
    }

    fn clip(mut self, triangles: &mut Vec<[u32; 3]>) -> CutOutcome {
        while self.left > 3 {
            if self.tests > MAX_CORNER_TESTS {
                let rest: Vec<u32> = self.ring().collect();
                fan(rest, triangles);
                return CutOutcome::TooLarge;
            }
            // A self-intersecting polygon may have no ear; clip any corner.
            let ear = self.first_ear().unwrap_or(self.first);
            let PolygonCorner { before, after, .. } = self.corner(ear);
            triangles.push([before, ear, after]);
            self.remove(ear);
        }
        if let [a, b, c] = *self.ring().collect::<Vec<_>>() {
            triangles.push([a, b, c]);
        }
        CutOutcome::Sound
    }

    fn first_ear(&mut self) -> Option<u32> {
        let mut i = self.first;
        for _ in 0..self.left {
            let corner = self.corner(i);
            if corner.ear_state == EarState::Nothing {
                match self.look(i) {
                    EarState::Nothing => return Some(i),
                    known => self.learn(i, known),
                }
            }
            i = corner.after;
        }
        self.tests += self.left;
        None
    }

    /// Tests a corner; `Nothing` means that it is an ear.
    fn look(&mut self, i: u32) -> EarState {
        let ear = self.corner(i);
        let (a, b, c) = (self.corner(ear.before).point, ear.point, self.corner(ear.after).point);
        if !has_area(a, b, c) {
            return EarState::Reflex;
        }
        let mut tests = 0;
        let blocker = self.ring().find(|&m| {
            tests += 1;
            let p = self.corner(m).point;
            m != i
                && m != ear.before
                && m != ear.after
                && cross(a, b, p) >= 0.0
                && cross(b, c, p) >= 0.0
                && cross(c, a, p) >= -MAX_COLLINEAR_SINE * (a - c).length() * (p - c).length()
                && p != a
                && p != b
                && p != c
        });
        self.tests += tests;
        blocker.map_or(EarState::Nothing, EarState::Blocked)
    }

    fn learn(&mut self, i: u32, known: EarState) {
        if let Some(corner) = self.corners.get_mut(i as usize) {
            corner.ear_state = known;
        }
    }

    fn remove(&mut self, i: u32) {
        let PolygonCorner { before, after, .. } = self.corner(i);
        if let Some(corner) = self.corners.get_mut(before as usize) {
            corner.after = after;
        }
        if let Some(corner) = self.corners.get_mut(after as usize) {
            corner.before = before;
        }
        if i == self.first {
            self.first = after;
        }
        self.left -= 1;
        for corner in &mut self.corners {
            if corner.ear_state == EarState::Blocked(i) {
                corner.ear_state = EarState::Nothing;
            }
        }
        self.tests += self.corners.len() / 8;
        self.learn(before, EarState::Nothing);
        self.learn(after, EarState::Nothing);
    }
}

#[cfg(test)]
mod tests;
