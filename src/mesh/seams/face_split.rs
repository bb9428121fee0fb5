//! [`cut_faces`]: splits faces at corners on their sides, into triangles around the opposite corner.

use glam::DVec3;

use crate::geometry::space::triangles::unit_normal;
use crate::mesh::EdgeMark;
use crate::mesh::soup::Soup;

/// Cut of a side: parameter from 0 to 1, and the vertex there.
pub(crate) type SideCut = (f64, u32);

/// A face with the cuts of its sides 0-1, 1-2 and 2-0, in order along each.
pub(crate) type FaceCuts = (u32, [Vec<SideCut>; 3]);

/// Minimum cosine (20 degrees) between a piece and its face. Two such pieces meet at less than a crease
/// angle.
const MIN_PIECE_COSINE: f64 = 0.94;

/// Index of a missing normal or texture coordinate.
const NO_ATTRIBUTE: u32 = u32::MAX;

/// Triangle with the attributes of its corners and the marks of its sides.
#[derive(Clone, Copy)]
struct SplitTriangle {
    corners: [CornerAttributes; 3],
    marks: [EdgeMark; 3],
}

#[derive(Clone, Copy)]
struct CornerAttributes {
    vertex: u32,
    normal: u32,
    uv: u32,
    colour: [f32; 3],
}

/// Splits faces of a soup. The first piece replaces the face; the others are appended. A face stays whole if
/// a piece would turn over or tilt too far.
pub(crate) fn cut_faces(soup: &mut Soup, faces: &[FaceCuts]) {
    for (face, cuts) in faces {
        let face = *face as usize;
        let (mut pieces, uvs) = (Vec::new(), soup.uvs.len());
        split(soup, piece(soup, face), [&cuts[0], &cuts[1], &cuts[2]], &mut pieces);
        let upright = normal(soup, soup.triangles[face]);
        let cosine =
            |piece: &SplitTriangle| normal(soup, piece.corners.map(|corner| corner.vertex)).dot(upright);
        if pieces.iter().any(|piece| cosine(piece) < MIN_PIECE_COSINE) {
            soup.uvs.truncate(uvs);
            continue;
        }
        for (k, piece) in pieces.into_iter().enumerate() {
            put(&mut soup.triangles, face, k, |_| piece.corners.map(|corner| corner.vertex));
            put(&mut soup.triangle_part, face, k, |part| part);
            put(&mut soup.triangle_material, face, k, |material| material);
            put(&mut soup.triangle_paint, face, k, |paint| paint);
            put(&mut soup.corner_normals, face, k, |_| piece.corners.map(|corner| corner.normal));
            put(&mut soup.corner_uvs, face, k, |_| piece.corners.map(|corner| corner.uv));
            put(&mut soup.corner_colours, face, k, |_| piece.corners.map(|corner| corner.colour));
            put(&mut soup.edge_marks, face, k, |_| piece.marks);
        }
    }
}

fn normal(soup: &Soup, corners: [u32; 3]) -> DVec3 {
    unit_normal(corners.map(|v| soup.positions[v as usize]))
}

/// Stores the value of a piece: the first piece replaces the value of its face, others are appended. An empty
/// list stays empty.
fn put<T: Copy>(list: &mut Vec<T>, face: usize, piece: usize, of: impl Fn(T) -> T) {
    let Some(own) = list.get_mut(face) else { return };
    let new = of(*own);
    if piece == 0 {
        *own = new;
    } else {
        list.push(new);
    }
}

fn piece(soup: &Soup, face: usize) -> SplitTriangle {
    let [vertices, normals, uvs] = [
        soup.triangles[face],
        soup.corner_normals.get(face).copied().unwrap_or([NO_ATTRIBUTE; 3]),
        soup.corner_uvs.get(face).copied().unwrap_or([NO_ATTRIBUTE; 3]),
    ];
    let colours = soup.corner_colours.get(face).copied().unwrap_or_default();
    let corner = |k: usize| CornerAttributes {
        vertex: vertices[k],
        normal: normals[k],
        uv: uvs[k],
        colour: colours[k],
    };
    let marks = soup.edge_marks.get(face).copied().unwrap_or_default();
    SplitTriangle { corners: [0, 1, 2].map(corner), marks }
}

/// Splits a triangle at the cuts of its sides, recursively. New inner edges are marked as hidden.
fn split(soup: &mut Soup, whole: SplitTriangle, cuts: [&[SideCut]; 3], pieces: &mut Vec<SplitTriangle>) {
    let Some(side) = cuts.iter().position(|cuts| !cuts.is_empty()) else {
        pieces.push(whole);
        return;
    };
    let [a, b, c] = [0, 1, 2].map(|k| whole.corners[(side + k) % 3]);
    let marks = [0, 1, 2].map(|k| whole.marks[(side + k) % 3]);
    let mut from = a;
    for k in 0..=cuts[side].len() {
        let cut = cuts[side].get(k);
        let to = cut.map_or(b, |(t, vertex)| between(soup, [a, b], *t, *vertex));
        let (first, last) = (k == 0, cut.is_none());
        let mark = |own: bool, mark: EdgeMark| if own { mark } else { EdgeMark::Hidden };
        let part = SplitTriangle {
            corners: [from, to, c],
            marks: [marks[0], mark(last, marks[1]), mark(first, marks[2])],
        };
        let rest = |own: bool, k: usize| if own { cuts[(side + k) % 3] } else { &[] };
        split(soup, part, [&[], rest(last, 1), rest(first, 2)], pieces);
        from = to;
    }
}

/// Attributes of a face on one of its sides, at parameter `t` from 0 to 1. The normal is that of the nearer
/// end.
fn between(soup: &mut Soup, [a, b]: [CornerAttributes; 2], t: f64, vertex: u32) -> CornerAttributes {
    let mix = |p: f32, q: f32| (f64::from(p) + (f64::from(q) - f64::from(p)) * t) as f32;
    let uvs = [a.uv, b.uv].map(|uv| soup.uvs.get(uv as usize).copied());
    let uv = match uvs {
        [Some(p), Some(q)] => {
            soup.uvs.push([0, 1].map(|k| mix(p[k], q[k])));
            soup.uvs.len() as u32 - 1
        }
        _ => NO_ATTRIBUTE,
    };
    let normal = if t < 0.5 { a.normal } else { b.normal };
    CornerAttributes { vertex, normal, uv, colour: [0, 1, 2].map(|k| mix(a.colour[k], b.colour[k])) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cut_faces_keeps_the_attributes_of_the_face() {
        let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let mut soup = Soup {
            positions: vec![
                at(0.0, 0.0),
                at(4.0, 0.0),
                at(0.0, 4.0),
                at(1.0, 0.0),
                at(2.0, 0.0),
                at(3.0, 1.0),
            ],
            triangles: vec![[0, 1, 2]],
            uvs: vec![[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]],
            corner_uvs: vec![[0, 1, 2]],
            edge_marks: vec![[EdgeMark::Hard; 3]],
            ..Soup::default()
        };
        cut_faces(&mut soup, &[(0, [vec![(0.25, 3), (0.5, 4)], vec![(0.25, 5)], vec![]])]);
        let place = |v: u32| soup.positions[v as usize];
        let area = |[a, b, c]: [u32; 3]| (place(b) - place(a)).cross(place(c) - place(a)).z / 2.0;
        assert_eq!(soup.triangles.len(), 4);
        assert!(soup.triangles.iter().all(|t| area(*t) > 0.0));
        assert_eq!(soup.triangles.iter().map(|t| area(*t)).sum::<f64>(), 8.0);
        for (triangle, uvs) in soup.triangles.iter().zip(&soup.corner_uvs) {
            for (v, uv) in triangle.iter().zip(uvs) {
                let uv = soup.uvs[*uv as usize].map(f64::from);
                assert_eq!([place(*v).x, place(*v).y], uv);
            }
        }
        // The sides of the file are split into three, two and one pieces.
        let hard = soup.edge_marks.as_flattened().iter().filter(|mark| **mark == EdgeMark::Hard);
        assert_eq!(hard.count(), 6);
    }

    #[test]
    fn cut_faces_refuses_pieces_that_flip_or_tilt() {
        // Seen from the opposite corner, the second-last vertex is outside a narrow face. The last vertex is
        // above the face.
        let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let mut soup = Soup {
            positions: vec![
                at(0.0, 0.0),
                at(22.0, 0.0),
                at(20.0, 1.0),
                at(21.0, -0.1),
                DVec3::new(10.0, 0.0, 0.3),
            ],
            triangles: vec![[0, 1, 2]],
            uvs: vec![[0.0, 0.0], [22.0, 0.0], [20.0, 1.0]],
            corner_uvs: vec![[0, 1, 2]],
            ..Soup::default()
        };
        cut_faces(&mut soup, &[(0, [vec![], vec![(0.5, 3)], vec![]])]);
        assert_eq!((&soup.triangles, soup.uvs.len()), (&vec![[0, 1, 2]], 3));
        cut_faces(&mut soup, &[(0, [vec![(0.5, 4)], vec![], vec![]])]);
        assert_eq!((&soup.triangles, soup.uvs.len()), (&vec![[0, 1, 2]], 3));
    }
}
