//! Builds a [`Mesh`] from a [`Soup`].
//!
//! 1. Sort vertices and faces by position, and move the origin.
//! 2. Turn closed surfaces outward.
//! 3. Join parts to bodies and measure them.
//! 4. Weld nearby vertices, drop duplicate faces, and sew seams.
//! 5. Turn open surfaces.
//! 6. Compute face normals and the stacking order of coplanar surfaces.

use crate::geometry::space::bounds::Bounds;
use crate::parallel::prelude::*;
use glam::DVec3;

use super::order::canonical_order;
use super::seams::seam_search;
use super::weld::nearby_vertices;
use super::{EdgeFaces, Edges, Mesh, MeshMetrics, RepairCounts, Soup, part_metrics};
use crate::mesh::components::bodies::bodies;
use crate::mesh::components::orientation::{ConnectedTriangles, OrientedSurfaces, TurnedFaces, turn_faces};
use crate::mesh::normals::normal_carriers::{CoplanarSearch, normals_and_carriers};
use crate::mesh::normals::triangle_area::{has_own_area, may_have_flat_faces};
use crate::mesh::overlaps::overlay_order::overlays;
use crate::mesh::seams::face_split::cut_faces;
use crate::mesh::weld::duplicate_faces::{retain_faces, unique_faces};
use crate::parallel::task_size::MIN_TASK_ITEMS;

impl Mesh {
    /// Builds the mesh of a flattened scene.
    ///
    /// - Vertices at the same position are joined (see [`nearby_vertices`]).
    /// - Faces with repeated corners, and duplicate faces of one part, are dropped.
    /// - Open edges that lie along each other are sewn (see `seams`).
    /// - Faces wound inward or against their neighbours are turned (see `orientation`).
    ///
    /// [`Mesh::cleaning`] and [`Mesh::turned`] count the changes. The result does not depend on the numbering
    /// of vertices, the order of faces, or the first corner of a face. Only parts and materials keep their
    /// order.
    #[must_use]
    pub(crate) fn build(mut soup: Soup) -> Self {
        let mut cleaning = RepairCounts::default();
        let Some((low, high)) = bounds(&soup, |_| true) else {
            cleaning.short_wires = soup.wires.len() as u64;
            return Self { cleaning, ..Self::default() };
        };
        // Faces without area do not affect the position and size of the model.
        let has_flat_faces = may_have_flat_faces(&soup.positions, &soup.triangles, (low, high));
        let counted = if has_flat_faces { bounds(&soup, has_own_area) } else { None };
        // Adding zero turns -0 into +0.
        soup.positions.par_iter_mut().for_each(|p| *p += DVec3::ZERO);
        cleaning.welded =
            canonical_order::sort_by_position(&mut soup, low.abs().max(high.abs()).max_element());
        let (counted_low, counted_high) = counted.unwrap_or((low, high));
        let origin = part_metrics::origin(counted_low, counted_high);
        if origin != DVec3::ZERO {
            soup.positions.par_iter_mut().for_each(|p| *p -= origin);
        }
        drop_collapsed(&mut soup, &mut cleaning);
        let mut edges = Edges::build(soup.positions.len(), &soup.triangles);
        let mut turned = Vec::new();
        // Closed surfaces come first, so that later steps see them wound correctly.
        let mut surfaces = surfaces(&soup, &edges);
        let mut is_final = !surfaces.has_open();
        let turned_of_open = surfaces.turn_closed_only();
        let mut is_as_found = true;
        if turn(&mut soup, &surfaces, &mut turned) {
            canonical_order::sort_faces_by_position(&mut soup);
            edges = Edges::build(soup.positions.len(), &soup.triangles);
            is_as_found = false;
        }

        let of_bodies = |soup: &Soup, bodies: &[_]| {
            MeshMetrics::new(soup, origin, has_flat_faces).united(bodies, origin, soup.single_precision)
        };
        let mut joined_parts = bodies(&soup, &edges);
        let mut extents = of_bodies(&soup, &joined_parts);
        let (borders, reaches) = border_vertices(&soup, &edges, &extents);
        if let Some(joined) = nearby_vertices::join_nearby(&soup.positions, &borders, &reaches) {
            replace_vertices(&mut soup, &joined, &mut cleaning);
            drop_collapsed(&mut soup, &mut cleaning);
            edges = Edges::build(soup.positions.len(), &soup.triangles);
            (is_final, is_as_found) = (false, false);
        }
        if let Some(keep) = unique_faces(&soup, &edges) {
            cleaning.doubled += keep.iter().filter(|k| !**k).count() as u64;
            retain_faces(&mut soup, &keep);
            let mut left = 0..;
            let of = |keep: &bool| if *keep { left.next() } else { None }.unwrap_or(u32::MAX);
            let renamed: Vec<u32> = keep.iter().map(of).collect();
            edges = edges.updated(soup.positions.len(), &soup.triangles, &renamed);
            (is_final, is_as_found) = (false, false);
        }
        let mut seams = seam_search::find(&soup, &edges, &extents, true);
        if !seams.joined.is_empty() {
            let stays = |face: &[u32; 3]| face.iter().all(|v| seams.joined[*v as usize] == *v);
            let renamed = (0..).zip(&soup.triangles).map(|(k, face)| if stays(face) { k } else { u32::MAX });
            let renamed: Vec<u32> = renamed.collect();
            replace_vertices(&mut soup, &seams.joined, &mut cleaning);
            edges = edges.updated(soup.positions.len(), &soup.triangles, &renamed);
            seams = seam_search::find(&soup, &edges, &extents, false);
            is_as_found = false;
        }
        if !seams.cuts.is_empty() {
            let mut renamed: Vec<u32> = (0..soup.triangles.len() as u32).collect();
            seams.cuts.iter().for_each(|(face, _)| renamed[*face as usize] = u32::MAX);
            cut_faces(&mut soup, &seams.cuts);
            edges = edges.updated(soup.positions.len(), &soup.triangles, &renamed);
            is_as_found = false;
        }
        if !is_final {
            if is_as_found {
                surfaces.is_turned = turned_of_open;
            } else {
                surfaces = self::surfaces(&soup, &edges);
            }
            if turn(&mut soup, &surfaces, &mut turned) {
                edges.turn(&surfaces.is_turned);
            }
        }

        soup.triangle_part.resize(soup.triangles.len(), super::PartId::default());
        let found = bodies(&soup, &edges);
        if found != joined_parts {
            extents = of_bodies(&soup, &found);
            joined_parts = found;
        }
        let Soup { positions, triangles, triangle_part: parts, .. } = &soup;
        let search = CoplanarSearch { positions, triangles, parts, edges: &edges, extents: &extents };
        let (face_normals, carriers) = normals_and_carriers(&search);
        cleaning.degenerate = face_normals.iter().filter(|n| **n == [0.0; 3]).count() as u64;
        cleaning.borders = edges.border_count() as u64;
        cleaning.non_manifold = edges.non_manifold_count() as u64;
        soup.triangle_material.resize(soup.triangles.len(), super::MaterialId::default());
        let mut mesh = Self {
            origin,
            extents,
            positions: soup.positions,
            triangles: soup.triangles,
            face_normals,
            carriers,
            first_piece: None,
            face_part: soup.triangle_part,
            bodies: joined_parts,
            face_material: soup.triangle_material,
            face_paint: soup.triangle_paint,
            normals: soup.normals,
            corner_normals: soup.corner_normals,
            uvs: soup.uvs,
            corner_uvs: soup.corner_uvs,
            corner_colours: soup.corner_colours,
            edge_marks: soup.edge_marks,
            overlays: Vec::new(),
            edges,
            wires: soup.wires,
            cleaning,
            turned,
        };
        mesh.overlays = overlays(&mesh);
        mesh
    }
}

/// The connected surfaces of a soup.
fn surfaces(soup: &Soup, edges: &Edges) -> OrientedSurfaces {
    let Soup { positions, triangles, triangle_part: parts, .. } = soup;
    OrientedSurfaces::new(&ConnectedTriangles { positions, triangles, parts, edges })
}

/// Turns and counts the faces that must be turned. Returns false if there are none.
fn turn(soup: &mut Soup, surfaces: &OrientedSurfaces, counts: &mut Vec<TurnedFaces>) -> bool {
    let any = !surfaces.is_turned.is_empty();
    if any {
        turn_faces(soup, &surfaces.is_turned);
        surfaces.count(&soup.triangle_part, counts);
    }
    any
}

/// Box around all vertices of faces with `counts` and of wires with a length.
fn bounds(soup: &Soup, counts: impl Fn([DVec3; 3]) -> bool + Sync) -> Option<(DVec3, DVec3)> {
    let at = |v: u32| soup.positions[v as usize];
    let of_chunk = |chunk: &[[u32; 3]]| {
        Bounds::of(chunk.iter().map(|t| t.map(at)).filter(|corners| counts(*corners)).flatten())
    };
    let faces = soup.triangles.par_chunks(1 << 14).map(of_chunk).reduce(|| Bounds::EMPTY, Bounds::union);
    let wires = soup.wires.iter().map(|wire| wire.vertices.map(at));
    let all = faces.union(Bounds::of(wires.filter(|[a, b]| a != b).flatten()));
    (all.low.x <= all.high.x).then_some((all.low, all.high))
}

fn replace_vertices(soup: &mut Soup, joined: &[u32], cleaning: &mut RepairCounts) {
    cleaning.welded += joined.iter().enumerate().filter(|(id, to)| *id as u32 != **to).count() as u64;
    soup.triangles.par_iter_mut().for_each(|t| *t = t.map(|v| joined[v as usize]));
    for wire in &mut soup.wires {
        wire.vertices = wire.vertices.map(|v| joined[v as usize]);
    }
}

fn drop_collapsed(soup: &mut Soup, cleaning: &mut RepairCounts) {
    let sound = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    if !soup.triangles.par_iter().all(sound) {
        let keep: Vec<bool> = soup.triangles.iter().map(sound).collect();
        cleaning.collapsed += keep.iter().filter(|k| !**k).count() as u64;
        retain_faces(soup, &keep);
    }
    let wires = soup.wires.len();
    soup.wires.retain(|w| w.vertices[0] != w.vertices[1]);
    cleaning.short_wires += (wires - soup.wires.len()) as u64;
}

/// Vertices on open edges, ascending, with their weld tolerance: the largest of their parts.
fn border_vertices(soup: &Soup, edges: &Edges, extents: &MeshMetrics) -> (Vec<u32>, Vec<f64>) {
    let part = |face: u32| soup.triangle_part.get(face as usize).copied().unwrap_or_default();
    let open = |e: usize| match edges.faces(e) {
        EdgeFaces::One(face) => Some((edges.vertices[e], extents.part(part(face)).weld)),
        _ => None,
    };
    let ends = (0..edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS).filter_map(open);
    let mut vertices: Vec<(u32, f64)> =
        ends.flat_map_iter(|(ends, reach)| ends.map(|v| (v, reach))).collect();
    vertices.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
    vertices.dedup_by_key(|(vertex, _)| *vertex);
    vertices.into_iter().unzip()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn soup(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> Soup {
        Soup {
            positions: points.iter().map(|p| DVec3::from_array(*p)).collect(),
            triangles: triangles.to_vec(),
            ..Soup::default()
        }
    }

    #[test]
    fn build_welds_equal_and_nearly_equal_vertices() {
        let d = 1e-9;
        let mesh = Mesh::build(soup(
            &[
                [0.0; 3],
                [1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [1.0, 0.0, 0.0],
                [0.0, 1.0 + d, 0.0],
                [1.0, 1.0, 0.0],
            ],
            &[[0, 1, 2], [3, 5, 4]],
        ));
        assert_eq!((mesh.cleaning.welded, mesh.cleaning.borders), (2, 4));
        assert_eq!(mesh.origin, DVec3::ZERO);
    }

    #[test]
    fn cleaning_counts_doubled_collapsed_and_flat_faces() {
        let mesh = Mesh::build(soup(
            &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]],
            &[[0, 1, 2], [2, 1, 0], [1, 1, 2], [0, 1, 3]],
        ));
        let c = mesh.cleaning;
        assert_eq!((c.doubled, c.collapsed, c.degenerate), (1, 1, 1));
        // The flat face continues in the face that runs along its side in the other direction.
        assert_eq!(mesh.triangles, [[0, 1, 3], [0, 2, 1]]);
    }

    #[test]
    fn an_empty_soup_is_an_empty_mesh() {
        assert!(Mesh::build(Soup::default()).triangles.is_empty());
    }
}
