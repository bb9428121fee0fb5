//! Removes intersection curves along which curved surfaces only touch.
//!
//! A shaft in its bore coincides with it in the CAD program, but the facets of both are cut at different
//! places. They pass through each other by the height of their arcs, and would draw a dark band along the
//! contact. Crossing and contact look the same where faces cross at a smaller angle than their surfaces turn
//! from facet to facet:
//!
//! 1. Each face has a *facet angle*: the largest turn to a neighbour, of turns below [`MAX_FACET_DEG`].
//! 2. A segment is *flat* if its faces cross at less than the mean of their facet angles.
//! 3. A curve is removed if nearly all of its length is flat, and kept whole otherwise: coarse bodies that
//!    truly cross do so at a small angle in some places. A curve ends at a branch, and where it passes over a
//!    crease onto another surface.

use crate::geometry::lists::linked_lines::linked_lines;
use crate::lines::tolerances::MIN_CONTACT_OF_CURVE;
use crate::mesh::intersect::intersection_curves::{IntersectionCurves, IntersectionSegment};
use crate::mesh::tolerances::MAX_FACET_DEG;
use crate::mesh::{Dihedral, FaceId, Mesh};

/// The intersection curves of a mesh, without contacts.
#[must_use]
pub(crate) fn remove_contacts(curves: IntersectionCurves, mesh: &Mesh) -> IntersectionCurves {
    let is_flat: Vec<bool> = curves.segments.iter().map(|segment| is_flat(mesh, segment)).collect();
    if !is_flat.contains(&true) {
        return curves;
    }
    let length = |segment: &IntersectionSegment| {
        let [a, b] = segment.ends.map(|end| curves.points[end as usize]);
        a.distance(b)
    };
    let mut touches = vec![false; curves.segments.len()];
    for curve in whole_curves(&curves, mesh) {
        let of = |flat_only: bool| -> f64 {
            let counted = curve.iter().copied().filter(|s| !flat_only || is_flat[*s]);
            counted.map(|s| length(&curves.segments[s])).sum()
        };
        if of(true) >= MIN_CONTACT_OF_CURVE * of(false) {
            curve.iter().for_each(|s| touches[*s] = true);
        }
    }
    let mut number = touches.iter();
    let mut segments = curves.segments;
    segments.retain(|_| number.next() == Some(&false));
    renumbered(&curves.points, segments)
}

/// Whether the faces of a segment cross at less than the mean of their facet angles.
fn is_flat(mesh: &Mesh, segment: &IntersectionSegment) -> bool {
    let [a, b] = segment.faces.map(|face| mesh.face_normals[face as usize].map(f64::from));
    let cosine = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]).abs().min(1.0);
    let angle = crate::geometry::numbers::portable_math::acos(cosine).to_degrees();
    // The facet angles, and so their mean, are below this.
    angle < MAX_FACET_DEG && angle < segment.faces.map(|face| facet_deg(mesh, face)).iter().sum::<f64>() / 2.0
}

/// Facet angle of a face, degrees: the largest turn at its edges that is below a crease.
fn facet_deg(mesh: &Mesh, face: u32) -> f64 {
    let [a, b, c] = mesh.triangles[face as usize];
    let turn = |[v, w]: [u32; 2]| {
        let edge = mesh.edges.between(v, w)?;
        let turn = f64::from(Dihedral::at(mesh, edge)?.turn());
        (turn < MAX_FACET_DEG).then_some(turn)
    };
    if mesh.is_degenerate(FaceId(face)) {
        return 0.0;
    }
    [[a, b], [b, c], [c, a]].into_iter().filter_map(turn).fold(0.0, f64::max)
}

/// Segments of each curve, between the points where curves end.
fn whole_curves(curves: &IntersectionCurves, mesh: &Mesh) -> Vec<Vec<usize>> {
    let mut at_point: Vec<[u32; 2]> = vec![[NO_INDEX; 2]; curves.points.len()];
    let mut count: Vec<u8> = vec![0; curves.points.len()];
    for (number, segment) in curves.segments.iter().enumerate() {
        for end in segment.ends.map(|end| end as usize) {
            if let Some(slot) = at_point[end].get_mut(usize::from(count[end])) {
                *slot = number as u32;
            }
            count[end] = count[end].saturating_add(1).min(3);
        }
    }
    let next = |segment: usize, end: usize| {
        let point = curves.segments[segment].ends[end];
        let [p, q] = at_point[point as usize];
        let next = if p as usize == segment { q } else { p } as usize;
        let faces = |segment: usize| curves.segments[segment].faces;
        (count[point as usize] == 2 && !is_over_crease(mesh, [segment, next].map(faces)))
            .then(|| (next, usize::from(curves.segments[next].ends[0] != point)))
    };
    let mut found = Vec::new();
    linked_lines(curves.segments.len(), next, |line| found.push(line.iter().map(|(s, _)| *s).collect()));
    found
}

/// Whether one of the two surfaces is creased between two consecutive segments, given the faces of both.
fn is_over_crease(mesh: &Mesh, [before, after]: [[u32; 2]; 2]) -> bool {
    let Some(shared) = before.iter().find(|face| after.contains(face)) else { return false };
    let other = |faces: [u32; 2]| if faces[0] == *shared { faces[1] } else { faces[0] };
    Dihedral::of(mesh, [other(before), other(after)], false).turn() >= MAX_FACET_DEG as f32
}

/// No segment, or no point.
const NO_INDEX: u32 = u32::MAX;

/// Curves of the given segments. Unused points are dropped, and the rest are in order of first use.
fn renumbered(points: &[glam::DVec3], mut segments: Vec<IntersectionSegment>) -> IntersectionCurves {
    let mut numbers = vec![NO_INDEX; points.len()];
    let mut used = Vec::new();
    for segment in &mut segments {
        segment.ends = segment.ends.map(|end| {
            let number = &mut numbers[end as usize];
            if *number == NO_INDEX {
                *number = used.len() as u32;
                used.push(points[end as usize]);
            }
            *number
        });
    }
    IntersectionCurves { points: used, segments }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::intersection_lines::all_curves;
    use super::*;
    use crate::mesh::Soup;

    /// Adds the side of a cylinder about z, made of `strips` flat strips and rotated by a fraction of a
    /// strip.
    fn add_tube(soup: &mut Soup, strips: u32, radius: f64, [low, high]: [f64; 2], turned: f64) {
        let first = soup.positions.len() as u32;
        let at = |k: u32, z: f64| {
            let angle = std::f64::consts::TAU * (f64::from(k) + turned) / f64::from(strips);
            let (sin, cos) = (
                crate::geometry::numbers::portable_math::sin(angle),
                crate::geometry::numbers::portable_math::cos(angle),
            );
            DVec3::new(radius * cos, radius * sin, z)
        };
        soup.positions.extend((0..strips).flat_map(|k| [at(k, low), at(k, high)]));
        for k in 0..strips {
            let [a, b] = [first + 2 * k, first + 2 * ((k + 1) % strips)];
            soup.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
        }
    }

    fn total_curve_length(curves: &IntersectionCurves) -> f64 {
        let of = |s: &IntersectionSegment| {
            curves.points[s.ends[0] as usize].distance(curves.points[s.ends[1] as usize])
        };
        curves.segments.iter().map(of).sum()
    }

    #[test]
    fn a_shaft_in_its_bore_has_no_band_of_lines() {
        let mut soup = Soup::default();
        add_tube(&mut soup, 24, 1.0, [0.0, 2.0], 0.0);
        add_tube(&mut soup, 30, 1.0, [-1.0, 3.0], 0.37);
        let mesh = Mesh::build(soup);
        assert!(all_curves(&mesh).segments.is_empty());
    }

    #[test]
    fn crossing_tubes_keep_closed_intersection_curves() {
        for (strips, aside) in [(8, 0.9), (12, 0.5), (24, 0.3)] {
            let mut soup = Soup::default();
            add_tube(&mut soup, strips, 1.0, [-1.0, 1.0], 0.1);
            let across = soup.positions.len();
            add_tube(&mut soup, strips, 0.4, [-3.0, 3.0], 0.4);
            for p in &mut soup.positions[across..] {
                *p = DVec3::new(p.z, p.x + aside, p.y);
            }
            let mesh = Mesh::build(soup);
            let curves = all_curves(&mesh);
            // Two closed curves at least as long as the circumference of the thin tube, or one where the tube
            // is cut open.
            assert!(total_curve_length(&curves) > 2.0, "{strips}: {}", total_curve_length(&curves));
            let ends = |point: u32| curves.segments.iter().filter(|s| s.ends.contains(&point)).count();
            assert!((0..curves.points.len() as u32).all(|point| ends(point) == 2), "{strips}");
        }
    }
}
