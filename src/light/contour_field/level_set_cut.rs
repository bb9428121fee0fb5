//! [`SurfaceCut`]: rounded faces cut along the level sets of a field, into pieces that share their borders.
//!
//! 1. Every face is divided into bands between one level and the next.
//! 2. Where a level crosses an edge there is one point, on the arc over that edge. The pieces on all sides
//!    have it as a corner, so neighbours have neither gap nor overlap.
//! 3. Across a hard edge each side has its own normals, and so its own points.
//!
//! Cut at zero alone, n·v separates the facing from the averted side of the surface. The border is the traced
//! contour.
//!
//! Source: Johan Claes and others, "Fast 3D cartoon rendering with improved quality by exploiting graphics
//! hardware", 2001, sections 3.5 and 3.6: triangles are subdivided at tone borders, with up to three tones
//! each. Here any number is allowed, and the borders lie on the rounded surface.

use std::ops::Range;

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::light::tolerances;
use crate::mesh::Mesh;
use crate::surface::{EdgeArc, SmoothNormals};

/// Faces per task. Fixed, so the result does not depend on the number of threads.
const FACES_PER_TASK: usize = 1 << 13;

/// Piece of a face between two neighbouring levels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct FacePiece {
    /// Face it is cut from.
    pub face: u32,
    /// Number of levels below it.
    pub band: u16,
    corners: Range<u32>,
}

/// Rounded faces of a mesh, cut along levels.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct SurfaceCut {
    /// Points where levels cross edges, local space; sorted by the smooth vertices of the edge, then by
    /// level.
    pub points: Vec<DVec3>,
    /// Index of the level at each point.
    pub levels: Vec<u16>,
    /// Pieces face by face; those of one face from the lowest band to the highest.
    pub pieces: Vec<FacePiece>,
    /// Corners of all pieces, one piece after the other.
    corners: Vec<u32>,
    /// Number of vertices of the mesh.
    vertices: usize,
}

/// Corner of a piece: a smooth vertex, or the crossing of a level with the edge between two.
#[derive(Debug, Clone, Copy)]
enum CutCorner {
    Vertex(u32),
    Crossing(LevelCrossing),
}

/// Smooth vertices of an edge, the smaller id first, and the index of a level.
type LevelCrossing = ([u32; 2], u16);

/// Cuts all rounded faces where `values`, one per smooth vertex, reach one of the ascending `levels`.
///
/// A value on a level belongs to the band above it, as zero counts as positive where curves are traced. Every
/// rounded face is covered by its pieces; flat faces have none.
#[must_use]
pub(crate) fn cut(mesh: &Mesh, smooth: &SmoothNormals, values: &[f64], levels: &[f64]) -> SurfaceCut {
    let faces = smooth.corners.len();
    let chunks: Vec<Vec<(u32, u16, Vec<CutCorner>)>> = (0..faces.div_ceil(FACES_PER_TASK))
        .into_par_iter()
        .with_max_len(1)
        .map(|k| {
            let mut found = Vec::new();
            for face in (k * FACES_PER_TASK..((k + 1) * FACES_PER_TASK).min(faces)).map(|face| face as u32) {
                if let Some(corners) = smooth.corners_of(face) {
                    let bands = corners.map(|v| band(values[v as usize], levels));
                    let all = bands[0].min(bands[1]).min(bands[2])..=bands[0].max(bands[1]).max(bands[2]);
                    found.extend(all.map(|band| (face, band, piece(corners, bands, band))));
                }
            }
            found
        })
        .collect();
    let crossings = crossings(chunks.iter().flatten().flat_map(|(_, _, corners)| corners));
    let point = |(between, level): &LevelCrossing| {
        let [a, b] = between.map(|v| values[v as usize]);
        let t = (levels[usize::from(*level)] - a) / (b - a);
        let t = t.clamp(tolerances::ZERO_SET_OF_EDGE, 1.0 - tolerances::ZERO_SET_OF_EDGE);
        EdgeArc::over(mesh, smooth, *between).at(t)
    };
    let mut cut = SurfaceCut {
        points: crossings.par_iter().with_min_len(1 << 10).map(point).collect(),
        levels: crossings.iter().map(|crossing| crossing.1).collect(),
        vertices: mesh.positions.len(),
        ..SurfaceCut::default()
    };
    for (face, band, corners) in chunks.into_iter().flatten() {
        let first = cut.corners.len() as u32;
        cut.corners.extend(corners.iter().map(|corner| match corner {
            CutCorner::Vertex(v) => smooth.vertices[*v as usize],
            CutCorner::Crossing(c) => (cut.vertices + crossings.partition_point(|known| known < c)) as u32,
        }));
        cut.pieces.push(FacePiece { face, band, corners: first..cut.corners.len() as u32 });
    }
    cut
}

/// Number of levels that a value has reached.
fn band(value: f64, levels: &[f64]) -> u16 {
    levels.partition_point(|level| *level <= value) as u16
}

/// Corners of a face's piece in one band, in the winding of the face.
fn piece(corners: [u32; 3], bands: [u16; 3], band: u16) -> Vec<CutCorner> {
    let mut out = Vec::with_capacity(5);
    for k in 0..3 {
        let next = (k + 1) % 3;
        if bands[k] == band {
            out.push(CutCorner::Vertex(corners[k]));
        }
        let between = [corners[k].min(corners[next]), corners[k].max(corners[next])];
        // Level j separates band j from the next. Of the levels crossed along the edge, the piece uses the
        // two at its borders.
        let borders = [band.checked_sub(1), Some(band)].map(|level| {
            let low = bands[k].min(bands[next])..bands[k].max(bands[next]);
            level.filter(|level| low.contains(level)).map(|level| CutCorner::Crossing((between, level)))
        });
        let rising = bands[k] < bands[next];
        out.extend(borders[usize::from(!rising)]);
        out.extend(borders[usize::from(rising)]);
    }
    out
}

/// All crossings, sorted, each once.
fn crossings<'a>(corners: impl Iterator<Item = &'a CutCorner>) -> Vec<LevelCrossing> {
    let of = |corner: &CutCorner| match corner {
        CutCorner::Vertex(_) => None,
        CutCorner::Crossing(crossing) => Some(*crossing),
    };
    let mut all: Vec<LevelCrossing> = corners.filter_map(of).collect();
    all.par_sort_unstable();
    all.dedup();
    all
}

impl SurfaceCut {
    /// Corners of a piece, in the winding of its face: vertices of the mesh, followed by
    /// [`SurfaceCut::points`].
    #[must_use]
    pub(crate) fn corners(&self, piece: &FacePiece) -> &[u32] {
        &self.corners[piece.corners.start as usize..piece.corners.end as usize]
    }

    /// Local position of a corner.
    #[inline]
    #[must_use]
    pub(crate) fn position(&self, mesh: &Mesh, corner: u32) -> DVec3 {
        let corner = corner as usize;
        if corner < self.vertices { mesh.positions[corner] } else { self.points[corner - self.vertices] }
    }

    /// Pieces of a face.
    #[must_use]
    pub(crate) fn of_face(&self, face: u32) -> &[FacePiece] {
        let first = self.pieces.partition_point(|piece| piece.face < face);
        let rest = &self.pieces[first..];
        &rest[..rest.partition_point(|piece| piece.face == face)]
    }

    /// Border between the band of a level and the one below it. Each face that the level crosses gives the
    /// face and two corners, with the upper band on the left.
    pub(crate) fn border(&self, level: u16) -> impl Iterator<Item = (u32, [u32; 2])> + '_ {
        let on = move |corner: u32| {
            let point = (corner as usize).checked_sub(self.vertices);
            point.is_some_and(|point| self.levels[point] == level)
        };
        self.pieces.iter().filter(move |piece| piece.band == level + 1).filter_map(move |piece| {
            let corners = self.corners(piece);
            let pair = |k: usize| [corners[k], corners[(k + 1) % corners.len()]];
            let side = (0..corners.len()).map(pair).find(|side| side.iter().all(|corner| on(*corner)))?;
            Some((piece.face, side))
        })
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::geometry::numbers::portable_math::{cos, sin};
    use crate::mesh::Soup;

    /// Ball of radius 1 with rings from pole to pole.
    fn ball(rings: u32) -> (Mesh, SmoothNormals) {
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        let columns = 2 * rings;
        for i in 0..=rings {
            let polar = std::f64::consts::PI * f64::from(i) / f64::from(rings);
            for k in 0..columns {
                let turn = std::f64::consts::TAU * f64::from(k) / f64::from(columns);
                positions.push(DVec3::new(sin(polar) * cos(turn), sin(polar) * sin(turn), cos(polar)));
                if i < rings {
                    let (a, b) = (i * columns + k, i * columns + (k + 1) % columns);
                    triangles.extend([[a, a + columns, b + columns], [a, b + columns, b]]);
                }
            }
        }
        let mesh = Mesh::build(Soup { positions, triangles, ..Soup::default() });
        let smooth = SmoothNormals::rounded(&mesh);
        (mesh, smooth)
    }

    /// Area vector of a piece.
    fn area(cut: &SurfaceCut, mesh: &Mesh, piece: &FacePiece) -> DVec3 {
        let corners: Vec<DVec3> = cut.corners(piece).iter().map(|c| cut.position(mesh, *c)).collect();
        let fan = corners.windows(2).skip(1).map(|pair| (pair[0] - corners[0]).cross(pair[1] - corners[0]));
        fan.sum::<DVec3>() / 2.0
    }

    #[test]
    fn level_set_cut_keeps_a_closed_surface_closed() {
        let (mesh, smooth) = ball(12);
        let values: Vec<f64> = smooth
            .vertices
            .iter()
            .map(|v| mesh.positions[*v as usize].dot(DVec3::new(0.6, 0.0, 0.8)))
            .collect();
        let cut = cut(&mesh, &smooth, &values, &[-0.5, -0.1, 0.0, 0.3, 0.31, 0.9]);
        let mut sides: BTreeMap<[u32; 2], i32> = BTreeMap::new();
        for piece in &cut.pieces {
            let corners = cut.corners(piece);
            assert!((3..=5).contains(&corners.len()));
            for k in 0..corners.len() {
                let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
                *sides.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
            }
        }
        // A closed surface stays closed: every side is traversed in both directions.
        assert!(sides.values().all(|sum| *sum == 0));
        assert!(cut.pieces.len() > mesh.triangles.len() + 100);
    }

    #[test]
    fn level_set_cut_splits_a_plane_into_strips() {
        let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let positions = vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
        let mesh = Mesh::build(Soup { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Soup::default() });
        let smooth = SmoothNormals::rounded(&mesh);
        let values: Vec<f64> = mesh.positions.iter().map(|p| (p + mesh.origin).x).collect();
        let levels = [0.25, 0.5, 0.9];
        let cut = cut(&mesh, &smooth, &values, &levels);
        let mut areas = [0.0; 4];
        for piece in &cut.pieces {
            areas[usize::from(piece.band)] += area(&cut, &mesh, piece).z;
        }
        for (found, wanted) in areas.into_iter().zip([0.25, 0.25, 0.4, 0.1]) {
            assert!((found - wanted).abs() < 1e-12, "{found} for {wanted}");
        }
        for (level, at) in levels.into_iter().enumerate() {
            let border: Vec<[DVec3; 2]> = cut
                .border(level as u16)
                .map(|(_, side)| side.map(|c| cut.position(&mesh, c) + mesh.origin))
                .collect();
            // The upper band is on the left, so the border runs down.
            assert!(border.iter().all(|[a, b]| (a.x - at).abs().max((b.x - at).abs()) < 1e-12 && a.y > b.y));
            assert!((border.iter().map(|[a, b]| a.y - b.y).sum::<f64>() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn level_set_cut_through_a_ball_is_a_great_circle() {
        let (mesh, smooth) = ball(16);
        let eye = DVec3::new(2.0, -1.0, 0.7).normalize();
        let values: Vec<f64> = smooth.normals.iter().map(|normal| normal.dot(eye)).collect();
        let cut = cut(&mesh, &smooth, &values, &[0.0]);
        for point in &cut.points {
            assert!((point.length() - 1.0).abs() < 1e-3 && point.dot(eye).abs() < 2e-3, "{point}");
        }
        let shadow = |band| {
            let pieces = cut.pieces.iter().filter(|piece| piece.band == band);
            pieces.map(|piece| area(&cut, &mesh, piece).dot(eye)).sum::<f64>()
        };
        let disc = std::f64::consts::PI;
        assert!((shadow(1) - disc).abs() < 0.02 * disc && (shadow(0) + shadow(1)).abs() < 1e-12);
    }

    #[test]
    fn a_value_equal_to_a_level_belongs_to_the_upper_band() {
        let (mesh, smooth) = ball(6);
        let cut = cut(&mesh, &smooth, &vec![0.0; smooth.vertices.len()], &[0.0]);
        assert!(cut.points.is_empty() && cut.pieces.iter().all(|piece| piece.band == 1));
        assert_eq!(cut.of_face(3).len(), 1);
    }
}
