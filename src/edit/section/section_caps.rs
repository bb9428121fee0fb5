//! [`caps`]: faces that close solids where the plane cuts them open.
//!
//! 1. The plane is triangulated between the outlines of all solids and the sides of coplanar faces.
//! 2. Just behind the plane, a triangle belongs to a solid if the winding number of the solid's outlines is
//!    not zero. Holes stay open, and overlapping shells of a solid become one. A triangle in several solids
//!    belongs to the smallest one, such as a bolt in a plate without a hole.
//! 3. Just in front of the plane, the winding number changes at coplanar faces: minus one where they face
//!    forward, plus one where they face backward. If nothing is in front, the triangle is a face of the
//!    model, and is kept instead of a cap.

use std::cmp::Ordering;

use glam::DVec2;
use rustc_hash::FxHashMap;
use spade::Triangulation as _;

use super::coplanar_faces::{CoplanarFaces, RemainingFaces};
use super::cut_outlines::{CutOutlines, OutlineEdge, PlaneTriangles, TriangleOwner};
use super::cut_tolerances::CutTolerances;
use super::outline_gaps::closed_outlines;
use super::plane::Plane;
use super::plane_clip::Clipped;
use super::seam_division::{SeamPieces, Seams, bits};
use crate::mesh::EdgeMark;

/// Cap of a solid.
#[derive(Debug, Default)]
pub(crate) struct SectionCap {
    /// Triangles of vertices of the solid's geometry, counter-clockwise as seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Marks of the triangle sides, one entry per triangle.
    pub marks: Vec<[EdgeMark; 3]>,
    /// Area of the cap, world units squared.
    pub area: f64,
    /// Lowest and highest corner of the cap along the axes of the plane.
    pub bounds: Option<[DVec2; 2]>,
    /// Pieces of the open edges, by their end points.
    pub seams: Seams,
    /// Triangles of the original geometry that lie in the plane and stay unchanged.
    pub whole_triangles: Vec<usize>,
    /// Pieces of such triangles: the index of the triangle, the vertices, and the marks of the sides.
    pub pieces: Vec<(usize, [u32; 3], [EdgeMark; 3])>,
}

/// Solid that was cut open.
pub(crate) struct CutSolid {
    pub cut: Clipped,
    /// Volume of the uncut solid, world units cubed.
    pub volume: f64,
    pub reach: CutTolerances,
}

impl CutSolid {
    /// Bounding box of the outlines along the axes of the plane.
    pub(crate) fn bounds(&self, plane: &Plane) -> Option<[DVec2; 2]> {
        let place = |node: &u32| plane.flat(self.cut.geometry.positions[*node as usize]);
        let of = |p: DVec2| [p, p];
        let nodes = self.cut.nodes.iter().map(|node| of(place(node)));
        nodes.reduce(|[low, high], [p, q]| [low.min(p), high.max(q)])
    }

    /// Order of precedence where solids overlap: the smaller volume first.
    fn precedence(&self, other: &Self, plane: &Plane) -> Ordering {
        // Rounded to single precision, so that the order of triangles has no influence.
        let by_volume = (self.volume as f32).total_cmp(&(other.volume as f32));
        let corners = |of: &Self| of.bounds(plane).unwrap_or_default();
        let (own, its) = (corners(self), corners(other));
        let number = |bounds: [DVec2; 2]| bounds.map(|p| p.to_array());
        let by_place = number(own)
            .as_flattened()
            .iter()
            .zip(number(its).as_flattened())
            .fold(Ordering::Equal, |order, (a, b)| order.then(a.total_cmp(b)));
        by_volume.then(by_place)
    }
}

/// Caps of solids that may overlap, one entry per solid. Vertices at crossings of outlines are added to their
/// geometry.
pub(crate) fn caps(solids: &mut [&mut CutSolid], plane: &Plane) -> Vec<SectionCap> {
    let mut outlines =
        CutOutlines::new(solids.iter().map(|cut_solid| cut_solid.reach.points).fold(0.0, f64::max));
    let mut vertices: Vec<FxHashMap<u32, u32>> = vec![FxHashMap::default(); solids.len()];
    let mut open: Vec<Vec<[u32; 2]>> = Vec::with_capacity(solids.len());
    for (number, solid) in solids.iter().enumerate() {
        let (cut, vertex_of_point) = (&solid.cut, &mut vertices[number]);
        let mut point = |node: u32| {
            let vertex = cut.nodes[node as usize];
            let world_point = cut.geometry.positions[vertex as usize];
            // Nodes at the same position become one point.
            let point = outlines.point(plane.flat(world_point), world_point);
            vertex_of_point.entry(point).or_insert(vertex);
            point
        };
        let (edges, _) = closed_outlines(cut);
        // Caps run along the open edges in the opposite direction.
        let ends: Vec<_> = edges.iter().map(|([a, b], times)| ([point(*b), point(*a)], *times)).collect();
        let flats: Vec<[u32; 3]> = cut.flat.iter().map(|flat| flat.nodes.map(&mut point)).collect();
        for (of, (ends, times)) in ends.into_iter().enumerate().filter(|(_, ([a, b], _))| a != b) {
            outlines.edges.push(OutlineEdge {
                ends,
                times,
                solid: number as u32,
                of: of as u32,
                flat: false,
            });
        }
        for corners in flats {
            for k in 0..3 {
                let ends = [corners[k], corners[(k + 1) % 3]];
                if ends[0] != ends[1] {
                    outlines.edges.push(OutlineEdge {
                        ends,
                        times: 1,
                        solid: number as u32,
                        of: 0,
                        flat: true,
                    });
                }
            }
        }
        open.push(edges.iter().map(|(ends, _)| ends.map(|node| cut.nodes[node as usize])).collect());
    }
    let mut section_caps: Vec<SectionCap> = solids.iter().map(|_| SectionCap::default()).collect();
    let Some(faces) = outlines.triangulate(plane) else { return section_caps };
    let mut ranked: Vec<usize> = (0..solids.len()).collect();
    ranked.sort_by(|a, b| solids[*a].precedence(solids[*b], plane).then(a.cmp(b)));
    let mut rank = vec![0; solids.len()];
    ranked.iter().enumerate().for_each(|(k, solid)| rank[*solid] = k);
    let owner = owners(&faces, &outlines, &rank);
    let flats: Vec<CoplanarFaces> =
        solids.iter().map(|cut_solid| CoplanarFaces::new(&cut_solid.cut, plane)).collect();
    let remaining = RemainingFaces::new(&faces, &outlines, &owner, &flats);
    for (section_cap, flats) in section_caps.iter_mut().zip(remaining.whole(&flats)) {
        section_cap.whole_triangles = flats;
    }

    let mut vertex = |solid: usize, point: u32| {
        *vertices[solid].entry(point).or_insert_with(|| {
            let geometry = &mut solids[solid].cut.geometry;
            geometry.positions.push(outlines.place(point));
            if !geometry.colours.is_empty() {
                geometry.colours.resize(geometry.positions.len(), [1.0; 4]);
            }
            geometry.positions.len() as u32 - 1
        })
    };
    for face in faces.inner_faces() {
        let index = face.fix().index();
        let corners = face.vertices().map(|corner| corner.fix().index() as u32);
        let neighbours = face.adjacent_edges().map(|edge| edge.rev().face().fix().index());
        if let Some(piece) = remaining.of(index) {
            if !remaining.is_whole(piece) {
                let [solid, flat] = piece;
                let is_same = |neighbour: usize| remaining.of(neighbour) == Some(piece);
                let mark =
                    |neighbour: usize| if is_same(neighbour) { EdgeMark::Hidden } else { EdgeMark::Unmarked };
                let corners = corners.map(|corner| vertex(solid, corner));
                section_caps[solid].pieces.push((flats[solid].triangle(flat), corners, neighbours.map(mark)));
            }
            continue;
        }
        let Some(TriangleOwner { solid, .. }) = owner[index] else { continue };
        let cap = &mut section_caps[solid as usize];
        let is_own = |neighbour: usize| {
            owner[neighbour].is_some_and(|owner| owner.solid == solid) && remaining.of(neighbour).is_none()
        };
        let mark = |neighbour: usize| if is_own(neighbour) { EdgeMark::Hidden } else { EdgeMark::Cut };
        cap.marks.push(neighbours.map(mark));
        cap.triangles.push(corners.map(|corner| vertex(solid as usize, corner)));
        let [a, b, c] = corners.map(|corner| outlines.at(corner));
        cap.area += (b - a).perp_dot(c - a) / 2.0;
        let [low, high] = cap.bounds.unwrap_or([a, a]);
        cap.bounds = Some([low.min(a).min(b).min(c), high.max(a).max(b).max(c)]);
    }
    // Marks the pieces of each open edge. A piece is covered if the solid owns both sides of it or neither.
    let corners: Vec<_> = faces.fixed_vertices().collect();
    let mut pieces: Vec<&OutlineEdge> = outlines.edges.iter().filter(|edge| !edge.flat).collect();
    pieces.sort_by_key(|edge| (edge.solid, edge.of));
    for edge_pieces in pieces.chunk_by(|a, b| (a.solid, a.of) == (b.solid, b.of)) {
        let (solid, of) = (edge_pieces[0].solid, edge_pieces[0].of as usize);
        let position_of = |point: u32| outlines.place(point);
        let [from, to] =
            open[solid as usize][of].map(|v| solids[solid as usize].cut.geometry.positions[v as usize]);
        let along = |point: u32| (position_of(point) - from).dot(to - from);
        // Outlines run against the open edges.
        let mut segments: Vec<[u32; 2]> =
            edge_pieces.iter().map(|edge| [edge.ends[1], edge.ends[0]]).collect();
        segments.sort_by(|a, b| along(a[0]).total_cmp(&along(b[0])));
        let mark = |[a, b]: &[u32; 2]| {
            let Some(edge) = faces.get_edge_from_neighbors(corners[*a as usize], corners[*b as usize]) else {
                return EdgeMark::Unmarked;
            };
            let is_own = |face: usize| owner[face].is_some_and(|owner| owner.solid == solid);
            let [left, right] = [edge.face().fix().index(), edge.rev().face().fix().index()];
            if is_own(left) == is_own(right) { EdgeMark::Covered } else { EdgeMark::Unmarked }
        };
        let seam = SeamPieces {
            marks: segments.iter().map(mark).collect(),
            through: segments.iter().skip(1).map(|[a, _]| position_of(*a)).collect(),
        };
        if seam.marks.as_slice() != [EdgeMark::Unmarked] {
            section_caps[solid as usize].seams.insert([bits(from), bits(to)], seam);
        }
    }
    section_caps
}

/// Winding number of a solid's outlines around a triangle just behind the plane, and the decrease to the
/// front of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct WindingNumbers {
    solid: u32,
    behind: i32,
    flat: i32,
}

/// Owner of each triangle: the solid of lowest rank with a winding number other than zero.
fn owners(faces: &PlaneTriangles, outlines: &CutOutlines, rank: &[usize]) -> Vec<Option<TriangleOwner>> {
    let mut along: FxHashMap<[u32; 2], Vec<WindingNumbers>> = FxHashMap::default();
    for edge in &outlines.edges {
        let [a, b] = edge.ends;
        let times = if a < b { edge.times } else { -edge.times };
        let (behind, flat) = if edge.flat { (0, times) } else { (times, 0) };
        add(
            along.entry([a.min(b), a.max(b)]).or_default(),
            WindingNumbers { solid: edge.solid, behind, flat },
        );
    }
    let mut windings_of: Vec<Option<Vec<WindingNumbers>>> = vec![None; faces.num_all_faces()];
    let outer = faces.outer_face();
    windings_of[outer.fix().index()] = Some(Vec::new());
    let mut waiting: Vec<_> = faces.convex_hull().map(|edge| (edge, Vec::new())).collect();
    // Flood fill from the outside. Crossing an edge changes the winding number by the number of faces along
    // it.
    while let Some((edge, edge_windings)) = waiting.pop() {
        let reverse_edge = edge.rev();
        let Some(next) = reverse_edge.face().as_inner() else { continue };
        if windings_of[next.fix().index()].is_some() {
            continue;
        }
        let [from, to] = [reverse_edge.from(), reverse_edge.to()].map(|corner| corner.fix().index() as u32);
        let mut face_windings = edge_windings;
        for edge_winding in along.get(&[from.min(to), from.max(to)]).into_iter().flatten() {
            let sign = if from < to { 1 } else { -1 };
            add(
                &mut face_windings,
                WindingNumbers {
                    solid: edge_winding.solid,
                    behind: edge_winding.behind * sign,
                    flat: edge_winding.flat * sign,
                },
            );
        }
        waiting.extend(next.adjacent_edges().map(|edge| (edge, face_windings.clone())));
        windings_of[next.fix().index()] = Some(face_windings);
    }
    let first = |numbers: Vec<WindingNumbers>| {
        let is_cut = numbers.iter().any(|turns| turns.behind != turns.flat);
        let within = numbers.into_iter().filter(|turns| turns.behind != 0).map(|turns| turns.solid);
        within.min_by_key(|solid| rank[*solid as usize]).map(|solid| TriangleOwner { solid, is_cut })
    };
    windings_of.into_iter().map(|turns| turns.and_then(first)).collect()
}

/// Adds winding numbers of a solid, and drops zeros.
fn add(to: &mut Vec<WindingNumbers>, more: WindingNumbers) {
    match to.iter().position(|known| known.solid == more.solid) {
        None => to.push(more),
        Some(k) => {
            to[k].behind += more.behind;
            to[k].flat += more.flat;
            if to[k].behind == 0 && to[k].flat == 0 {
                to.swap_remove(k);
            }
        }
    }
}
