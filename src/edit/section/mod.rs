//! Section of a scene: removes everything in front of a plane and closes the solids that the plane cuts open.
//!
//! 1. [`plane_spec`] reads the [`plane`] from an option such as `y=12.5`.
//! 2. `void_winding` orients each surface so that winding numbers separate material from voids.
//! 3. `plane_sides` finds the parts that the plane cuts. `plane_clip` clips each of them at the plane and
//!    lists the open edges along it. `cut_tolerances` gives the distances within which points coincide.
//!    `outline_gaps` closes small gaps between open edges.
//! 4. `section_caps` triangulates the plane between the outlines (`cut_outlines`) and assigns each triangle
//!    to a solid by winding number. `coplanar_faces` keeps faces of the model that lie in the plane.
//! 5. `seam_division` splits the clipped triangles where the caps have vertices.
//! 6. `neighbour_kinds` numbers the cut parts so that touching ones differ.
//!
//! ```
//! use ligne::Scene;
//! use ligne::glam::DVec3;
//! use ligne::edit::section::{Plane, cut};
//!
//! let scene = Scene::open("examples/models/pump.glb")?;
//! let (low, high) = scene.bounds().unwrap_or_default();
//! if let Some(plane) = Plane::new((low + high) / 2.0, DVec3::Z) {
//!     let section = cut(scene, &plane, &[]);
//!     assert!(section.faces.iter().all(|face| face.area > 0.0));
//! }
//! # Ok::<(), ligne::Error>(())
//! ```

mod coplanar_faces;
mod cut_outlines;
mod cut_tolerances;
mod neighbour_kinds;
mod outline_gaps;
pub(crate) mod plane;
mod plane_clip;
mod plane_sides;
pub(crate) mod plane_spec;
mod seam_division;
mod section_caps;
mod void_winding;

use glam::{DAffine3, DVec2};

pub use crate::geometry::names::glob::Glob;
pub(crate) use neighbour_kinds::are_neighbours;
pub use plane::Plane;
pub use plane_spec::CutPlane;

use crate::geometry::lists::disjoint_sets::DisjointSets;
use crate::mesh::EdgeMark;
use crate::mesh::weld::nearby_vertices;
use crate::scene::{Alpha, Geometry, Material, Part, Scene};
use cut_tolerances::CutTolerances;
use plane_clip::Clipped;
use section_caps::{CutSolid, SectionCap};

/// Scene that was cut open.
#[derive(Debug, Clone, Default)]
pub struct Section {
    /// Remaining scene behind the plane.
    pub scene: Scene,
    /// Cut faces, one entry per part that has any, in the order of parts.
    pub faces: Vec<CutFaces>,
}

/// Cut faces of a part.
#[derive(Debug, Clone, PartialEq)]
pub struct CutFaces {
    /// Index of the part in the remaining scene.
    pub part: usize,
    /// Index of their material in [`Scene::materials`]. Only these faces use it. It has the colour of the
    /// part.
    pub material: u32,
    /// Area, model units squared.
    pub area: f64,
    /// Bounding box along the axes of the plane: lowest and highest coordinates.
    pub bounds: [DVec2; 2],
    /// Small number that differs between parts whose cut faces touch.
    pub kind: usize,
}

/// Name of the material of cut faces with a number.
#[must_use]
pub(crate) fn material_name(kind: usize) -> String {
    format!("cut {}", kind + 1)
}

/// Cuts a scene along a plane and keeps everything behind it.
///
/// - Cut faces belong to the part that is cut. Their material is named `cut 1`, `cut 2`, … and has the colour
///   of the part.
/// - They cover the area where the winding number of the part's outlines is not zero.
/// - A closed surface inside another one bounds a void if the file winds it the opposite way. Otherwise it is
///   a solid. The winding has no other effect.
/// - Where parts overlap, the one with the smallest volume gets the cut face.
/// - Outlines of open surfaces are closed over gaps of up to a ten-thousandth of the part. Others stay open
///   and are counted in the warnings of the scene.
/// - Parts whose name matches `uncut` stay whole if the plane goes through them.
#[must_use]
pub fn cut(mut scene: Scene, plane: &Plane, uncut: &[Glob]) -> Section {
    let mut keep = vec![true; scene.parts.len()];
    // Parts without a material use the entry after the last. That entry becomes explicit, because materials
    // are added.
    let plain = scene.materials.len() as u32;
    scene.materials.push(Material::default());
    let mut numbers = Vec::new();
    let mut opened: Vec<CutSolid> = Vec::new();
    // For each solid, whether it has no vertex in front of the plane.
    let mut only_ends = Vec::new();
    let mut unclosed = 0;
    for (number, keep) in keep.iter_mut().enumerate() {
        let part = &scene.parts[number];
        let stays = uncut.iter().any(|glob| glob.matches(&part.name));
        let Some(shape) = scene.geometry_of(part) else { continue };
        let to_world = part.world_from_part;
        let reach = CutTolerances::of(shape, &to_world);
        let (behind, before) = plane_sides::sides_reached(shape, &to_world, plane, reach.plane);
        *keep = behind || !before;
        // A solid with a face in the plane may lie inside a solid that is cut.
        if behind && !stays && (before || plane_sides::has_flat(shape, &to_world, plane, reach.plane)) {
            let shape =
                void_winding::orient_surfaces(shape, &plane_clip::first_at_position(&shape.positions));
            let cut = clip_part(&shape, &to_world, (plane, reach));
            if before {
                unclosed += outline_gaps::closed_outlines(&cut).1;
            }
            only_ends.push(!before);
            numbers.push(number);
            opened.push(CutSolid { cut, volume: volume(&shape, &to_world), reach });
        }
    }
    let caps = cap_solids(&mut opened, plane);
    let mut faces_of = Vec::new();
    for (((number, CutSolid { cut, .. }), cap), only_ends) in
        numbers.into_iter().zip(opened).zip(caps).zip(only_ends)
    {
        let Clipped { mut geometry, flat, .. } = cut;
        if only_ends
            && cap.triangles.is_empty()
            && cap.pieces.is_empty()
            && cap.whole_triangles.len() == flat.len()
        {
            continue;
        }
        let part = &scene.parts[number];
        let base_material = scene.geometry_of(part).and_then(|shape| shape.material_of(0)).unwrap_or(plain);
        let count = geometry.triangles.len();
        seam_division::split_at_seams(&mut geometry, count, &cap.seams);
        if let Some(shape) = scene.geometry_of(part) {
            let turned = part.world_from_part.matrix3.determinant() < 0.0;
            for triangle in &cap.whole_triangles {
                plane_clip::add_flat(&mut geometry, shape, *triangle, None, turned);
            }
            for (triangle, corners, marks) in &cap.pieces {
                plane_clip::add_flat(&mut geometry, shape, *triangle, Some((*corners, *marks)), turned);
            }
        }
        keep[number] =
            !(geometry.triangles.is_empty() && geometry.wires.is_empty() && cap.triangles.is_empty());
        if let Some(bounds) = cap.bounds {
            let material = scene.materials.len() as u32;
            scene.materials.push(cut_material(scene.materials.get(base_material as usize)));
            append_cap(&mut geometry, &cap, material, base_material);
            faces_of.push(CutFaces { part: number, material, area: cap.area, bounds, kind: 0 });
        }
        let Part { geometry: of, world_from_part, .. } = &mut scene.parts[number];
        (*of, *world_from_part) = (scene.geometries.len(), DAffine3::IDENTITY);
        scene.geometries.push(geometry);
    }
    neighbour_kinds::assign_kinds(&mut faces_of);
    let names: Vec<usize> = scene.retain_parts(&keep);
    for faces in &mut faces_of {
        faces.part = names[faces.part];
        scene.materials[faces.material as usize].name = material_name(faces.kind);
    }
    scene.warnings.count("outlines of cut surfaces that do not close, and are left open", unclosed);
    Section { scene, faces: faces_of }
}

/// Volume enclosed by a shape, world units cubed.
fn volume(shape: &Geometry, place: &DAffine3) -> f64 {
    let corner = |v: u32| shape.positions.get(v as usize).copied().unwrap_or_default();
    let from = shape.triangles.first().map(|t| corner(t[0])).unwrap_or_default();
    let of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| corner(v) - from);
        a.dot(b.cross(c))
    };
    (shape.triangles.iter().map(of).sum::<f64>() / 6.0 * place.matrix3.determinant()).abs()
}

/// Caps of all solids, one entry per solid. Solids whose outlines may overlap are capped together.
fn cap_solids(opened: &mut [CutSolid], plane: &Plane) -> Vec<SectionCap> {
    let bounds: Vec<_> = opened.iter().map(|solid| solid.bounds(plane)).collect();
    let groups = DisjointSets::new(opened.len(), |join| {
        for (a, first_box) in bounds.iter().enumerate() {
            for (b, second_box) in bounds[..a].iter().enumerate() {
                let (Some([low, high]), Some([from, to])) = (first_box, second_box) else { continue };
                if low.cmple(*to).all() && from.cmple(*high).all() {
                    join(a as u32, b as u32);
                }
            }
        }
    });
    let mut results: Vec<SectionCap> = opened.iter().map(|_| SectionCap::default()).collect();
    for first in 0..opened.len() as u32 {
        let is_in = |k: usize| groups.representative(k as u32) == groups.representative(first);
        if (0..first as usize).any(is_in) {
            continue;
        }
        let together: Vec<usize> = (0..opened.len()).filter(|k| is_in(*k)).collect();
        let mut solids: Vec<&mut CutSolid> =
            opened.iter_mut().enumerate().filter(|(k, _)| is_in(*k)).map(|(_, solid)| solid).collect();
        for (k, cap) in together.into_iter().zip(section_caps::caps(&mut solids, plane)) {
            results[k] = cap;
        }
    }
    results
}

/// Clips a shape. If its outlines do not close, nearly coincident vertices are joined as in the mesh, and
/// gaps are closed that the mesh would sew.
fn clip_part(shape: &Geometry, place: &DAffine3, (plane, own): (&Plane, CutTolerances)) -> Clipped {
    let mut cut = plane_clip::clip(shape, place, (plane, own.plane), None);
    let (_, unclosed) = outline_gaps::closed_outlines(&cut);
    if unclosed == 0 {
        return cut;
    }
    let world: Vec<_> =
        shape.positions.iter().map(|p| place.transform_point3(*p) + glam::DVec3::ZERO).collect();
    let mut used: Vec<u32> = shape.triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let reaches = vec![own.points; used.len()];
    if let Some(joined) = nearby_vertices::join_nearby(&world, &used, &reaches) {
        let shape = void_winding::orient_surfaces(shape, &joined);
        let again = plane_clip::clip(&shape, place, (plane, own.plane), Some(&joined));
        if outline_gaps::closed_outlines(&again).1 < unclosed {
            cut = again;
        }
    }
    outline_gaps::close_gaps(&mut cut, own.gap);
    cut
}

/// Opaque, untextured copy of a material for cut faces.
fn cut_material(of: Option<&Material>) -> Material {
    let own = of.cloned().unwrap_or_default();
    Material {
        name: String::new(),
        texture: None,
        picture: None,
        opacity_map: None,
        alpha: Alpha::Opaque,
        transmission: 0.0,
        gloss: None,
        ..own
    }
}

/// Appends the triangles of a cap to the remaining shape.
fn append_cap(shape: &mut Geometry, faces: &SectionCap, material: u32, looks: u32) {
    let before = shape.triangles.len();
    if shape.triangle_material.is_empty() {
        shape.triangle_material.resize(before, looks);
    }
    shape.triangles.extend(&faces.triangles);
    shape.triangle_material.resize(shape.triangles.len(), material);
    if !shape.corner_normals.is_empty() {
        shape.corner_normals.resize(shape.triangles.len(), [u32::MAX; 3]);
    }
    if !shape.corner_uvs.is_empty() {
        shape.corner_uvs.resize(shape.triangles.len(), [u32::MAX; 3]);
    }
    shape.edge_marks.resize(before, [EdgeMark::Unmarked; 3]);
    shape.edge_marks.extend(&faces.marks);
}
