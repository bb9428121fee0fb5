//! [`PointConstraint`]: possible collapse directions of a point, by the borders, seams and creases at it; and its
//! initial error quadric.

use crate::geometry::space::triangles::area_vector;
use crate::parallel::prelude::*;
use glam::DVec3;

use super::collapse_record::NO_INDEX;
use super::error_quadric::Quadric;
use super::flat_surface::IndexedSurface;
use super::point_faces::PointFaces;

/// Weight of a plane that holds a border in its place, relative to the area of the adjacent faces.
const BORDER_WEIGHT: f64 = 10.0;

/// The same for seams of materials, textures and colours, and for edges marked in the file.
const SEAM_WEIGHT: f64 = 1.0;

/// The same for creases, which are already held by the planes of their two faces.
const CREASE_WEIGHT: f64 = 0.25;

/// Edges whose face normals have a smaller cosine are creases.
const MAX_CREASE_COSINE: f64 = 0.7;

/// Possible collapse directions of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PointConstraint {
    /// To any neighbour: no border or seam ends here or passes through.
    Plain,
    /// Along a border or a seam, to the next point on it.
    Line,
    /// To any neighbour, although borders or non-manifold edges meet here: those are held by their planes
    /// alone.
    Knot,
    /// To points on other lines, at an extra cost. Texture coordinates, colours or materials meet here, and a
    /// collapse spreads one over another.
    Corner,
}

/// State of a point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Site {
    pub kind: PointConstraint,
    /// Next points on its line, in both directions.
    pub along: [u32; 2],
    pub quadric: Quadric,
    /// Its position.
    pub place: DVec3,
    /// Value of the quadric at its position.
    pub error: f64,
}

impl Site {
    /// Adds the quadric of a point that collapses onto this one.
    pub(crate) fn take(&mut self, quadric: &Quadric) {
        self.quadric.add(quadric);
        self.error = self.quadric.at(self.place);
    }
}

/// A side of a face at a point.
#[derive(Clone, Copy)]
struct FaceSide {
    other: u32,
    opposite: u32,
    face: u32,
    /// Attributes that must agree on both sides of an edge for it to be inside a smooth surface.
    signature: [u32; 3],
    marked: bool,
}

/// Initial state of each point.
pub(crate) fn sites(flat: &IndexedSurface, corners: &[[u32; 3]], fans: &PointFaces) -> Vec<Site> {
    let normal = |corners: &[u32; 3]| match corners.contains(&NO_INDEX) {
        true => DVec3::ZERO,
        false => area_vector(corners.map(|point| flat.points[point as usize])),
    };
    // Unit normal and area of each face.
    let planes: Vec<(DVec3, f64)> = corners
        .par_iter()
        .map(normal)
        .map(|normal| {
            let length = normal.length();
            if length > 0.0 { (normal / length, 0.5 * length) } else { (DVec3::ZERO, 0.0) }
        })
        .collect();
    let of =
        |sides: &mut Vec<FaceSide>, point: usize| site(flat, corners, fans, &planes, sides, point as u32);
    (0..fans.len()).into_par_iter().with_min_len(1024).map_init(Vec::new, of).collect()
}

fn site(
    flat: &IndexedSurface,
    corners: &[[u32; 3]],
    fans: &PointFaces,
    planes: &[(DVec3, f64)],
    sides: &mut Vec<FaceSide>,
    point: u32,
) -> Site {
    let place = flat.points[point as usize];
    let mut quadric = Quadric::default();
    let (mut weight, mut lines, mut along) = (0.0, 0, [NO_INDEX; 2]);
    sides.clear();
    for &face in fans.about(point) {
        let f = face as usize;
        weight = flat.weights[flat.geometry[f] as usize];
        let (normal, area) = planes[f];
        quadric.add(&Quadric::of_plane(normal, place, area));
        let Some(k) = corners[f].iter().position(|p| *p == point) else { continue };
        let (next, last) = ((k + 1) % 3, (k + 2) % 3);
        let class = |k: usize| flat.class[flat.faces[f][k] as usize];
        let marks = flat.marked.get(f).copied().unwrap_or_default();
        for (end, opposite, marked) in [(next, last, marks[k]), (last, next, marks[last])] {
            let signature = [class(k), class(end), flat.material[f]];
            sides.push(FaceSide {
                other: corners[f][end],
                opposite: corners[f][opposite],
                face,
                signature,
                marked,
            });
        }
    }
    sides.sort_unstable_by_key(|side| (side.other, side.opposite, side.signature, side.face));
    for edge in sides.chunk_by(|a, b| a.other == b.other) {
        let way = flat.points[edge[0].other as usize] - place;
        let normal = |side: &FaceSide| planes[side.face as usize].0;
        let strength = match strength(edge) {
            Some(strength) => {
                if let Some(slot) = along.get_mut(lines) {
                    *slot = edge[0].other;
                }
                lines += 1;
                strength
            }
            None if normal(&edge[0]).dot(normal(&edge[edge.len() - 1])) < MAX_CREASE_COSINE => CREASE_WEIGHT,
            None => continue,
        };
        for side in edge {
            let Some(upright) = way.cross(normal(side)).try_normalize() else { continue };
            quadric.add(&Quadric::of_plane(upright, place, strength * way.length_squared()));
        }
    }
    let kind = match lines {
        0 => PointConstraint::Plain,
        2 => PointConstraint::Line,
        _ if sides.iter().all(|side| is_like(side, &sides[0])) => PointConstraint::Knot,
        _ => PointConstraint::Corner,
    };
    let quadric = quadric.scaled(weight);
    Site { kind, along, quadric, place, error: quadric.at(place) }
}

/// Whether two faces at a point have equal attributes there.
fn is_like(one: &FaceSide, other: &FaceSide) -> bool {
    let [class, _, material] = one.signature;
    class == other.signature[0] && material == other.signature[2]
}

/// Weight of the planes that hold an edge: border, non-manifold edge, seam or marked edge; `None` for other
/// edges.
///
/// Duplicate faces count as one: only the number of distinct opposite points matters.
fn strength(edge: &[FaceSide]) -> Option<f64> {
    let (one, other) = edge.split_at(edge.partition_point(|side| side.opposite == edge[0].opposite));
    if other.is_empty() {
        return Some(BORDER_WEIGHT);
    }
    if other.iter().any(|side| side.opposite != other[0].opposite) {
        return Some(SEAM_WEIGHT);
    }
    let same = one.len() == other.len() && one.iter().zip(other).all(|(a, b)| a.signature == b.signature);
    (!same || edge.iter().any(|side| side.marked)).then_some(SEAM_WEIGHT)
}
