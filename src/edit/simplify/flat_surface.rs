//! [`IndexedSurface`]: all drawn triangles of a scene, as points, wedges and faces in plain arrays.

use std::ops::Range;

use crate::geometry::space::bounds::Bounds;
use crate::parallel::prelude::*;
use glam::{DAffine3, DVec3};

use super::collapse_record::{NO_INDEX, Wedge};
use super::point_weld::{Weld, join_near_points};
use crate::geometry::numbers::noise::hash;
use crate::geometry::numbers::portable_math::cbrt;
use crate::geometry::space::morton_curve::{CELLS_PER_HALF_AXIS, along_curve};
use crate::mesh::EdgeMark;
use crate::mesh::tolerances::{WELD_OF_F32_COORDINATE, WELD_OF_PART};
use crate::scene::extent::drawn_points::DrawnPoints;
use crate::scene::{Geometry, Material, Scene};

/// Drawn triangles of a scene, each geometry once.
///
/// A point is a position; the wedges at a point differ in vertex, normal or texture coordinates. Geometries
/// with a single instance are welded with each other in world space.
#[derive(Debug, Clone, Default)]
pub(crate) struct IndexedSurface {
    /// Positions of the points, centred and scaled so that the scene has size 1.
    pub points: Vec<DVec3>,
    /// Attributes of each wedge.
    pub wedges: Vec<Wedge>,
    /// Point of each wedge.
    pub point_of: Vec<u32>,
    /// For each wedge, a hash of the attributes that must be continuous along an edge: geometry, texture
    /// coordinates, colour.
    pub class: Vec<u32>,
    /// Unit normal of each wedge in its geometry, zero if it has none; empty if no geometry has normals.
    pub normals: Vec<[f32; 3]>,
    /// Wedges of each face; [`NO_INDEX`] for faces that are not drawn.
    pub faces: Vec<[u32; 3]>,
    /// File index of each face, counted through all geometries.
    pub in_file: Vec<u32>,
    /// Geometry of each face.
    pub geometry: Vec<u32>,
    /// Material of each face, or [`NO_INDEX`].
    pub material: Vec<u32>,
    /// Whether the sides 0-1, 1-2, 2-0 of each face are marked as lines; empty if none is.
    pub marked: Vec<[bool; 3]>,
    /// Range of each geometry's faces in the file.
    pub ranges: Vec<Range<usize>>,
    /// Weight of errors in each geometry, by the size of its instances, per instance.
    pub weights: Vec<f64>,
}

impl IndexedSurface {
    /// Builds the surface of a scene.
    pub(crate) fn of(scene: &Scene) -> Self {
        let shown = shown(scene);
        let frame = SpatialFrame::of(scene, &shown);
        let textured = scene.materials.iter().any(is_textured);
        let mut weld = Weld::default();
        let (mut flat, mut reaches) = (Self::default(), Vec::new());
        let has_normals = scene.geometries.iter().any(|geometry| !geometry.corner_normals.is_empty());
        for (number, (geometry, shown)) in scene.geometries.iter().zip(&shown).enumerate() {
            let first = flat.faces.len();
            match shown {
                Some(shown) => {
                    // Only the first of several instances has this position, so it must not be welded with
                    // other geometries.
                    let group = if shown.count == 1 { 0 } else { number as u32 + 1 };
                    let framed_points =
                        geometry.positions.iter().map(|p| frame.place(shown.place.transform_point3(*p)));
                    let points: Vec<u32> =
                        framed_points.map(|framed_point| weld.point(group, framed_point)).collect();
                    let reach = reach(geometry) * cbrt(shown.place.matrix3.determinant().abs()) * frame.scale;
                    reaches.resize(weld.len(), 0.0);
                    points.iter().for_each(|point| reaches[*point as usize] = reach);
                    flat.append(number, geometry, &points, textured);
                    flat.weights.push(shown.weight);
                }
                None => {
                    flat.faces.resize(first + geometry.triangles.len(), [NO_INDEX; 3]);
                    flat.weights.push(0.0);
                }
            }
            let count = flat.faces.len();
            let default_material = geometry.material.unwrap_or(NO_INDEX);
            flat.material.extend(geometry.triangle_material.iter().take(count - first));
            flat.material.resize(count, default_material);
            flat.geometry.resize(count, number as u32);
            if !geometry.edge_marks.is_empty() {
                flat.marked.resize(first, [false; 3]);
                let is_line =
                    |mark: EdgeMark| matches!(mark, EdgeMark::Hard | EdgeMark::Contour | EdgeMark::Cut);
                flat.marked
                    .extend(geometry.edge_marks.iter().take(count - first).map(|marks| marks.map(is_line)));
            }
            if !flat.marked.is_empty() {
                flat.marked.resize(count, [false; 3]);
            }
            if has_normals {
                let from = flat.normals.len();
                let of = |wedge: &Wedge| {
                    geometry.normals.get(wedge.normal as usize).copied().map_or([0.0; 3], unit)
                };
                flat.normals.extend(flat.wedges[from..].iter().map(of));
            }
            flat.ranges.push(first..count);
        }
        flat.points = weld.into_points();
        if let Some(joined) = join_near_points(&flat.points, &flat.corners(), &reaches) {
            flat.point_of.iter_mut().for_each(|point| *point = joined[*point as usize]);
        }
        flat.put_in_order();
        flat
    }

    fn append(&mut self, number: usize, geometry: &Geometry, points: &[u32], textured: bool) {
        // Linked list of the wedges of each vertex.
        let mut first = vec![NO_INDEX; points.len()];
        let mut next: Vec<u32> = Vec::new();
        let start = self.wedges.len() as u32;
        for (face, corners) in geometry.triangles.iter().enumerate() {
            let normals = geometry.corner_normals.get(face).copied().unwrap_or([NO_INDEX; 3]);
            let uvs = geometry.corner_uvs.get(face).copied().unwrap_or([NO_INDEX; 3]);
            let mut wedges = [NO_INDEX; 3];
            for k in 0..3 {
                let Some(head) = first.get_mut(corners[k] as usize) else { break };
                let made = Wedge { vertex: corners[k], normal: normals[k], uv: uvs[k] };
                let mut at = *head;
                while at != NO_INDEX && self.wedges[at as usize] != made {
                    at = next[(at - start) as usize];
                }
                if at == NO_INDEX {
                    at = self.wedges.len() as u32;
                    self.wedges.push(made);
                    self.point_of.push(points[corners[k] as usize]);
                    self.class.push(class(number, geometry, made, textured));
                    next.push(*head);
                    *head = at;
                }
                wedges[k] = at;
            }
            // A face with an invalid index is not drawn.
            self.faces.push(if wedges.contains(&NO_INDEX) { [NO_INDEX; 3] } else { wedges });
        }
    }

    /// Numbers points along a space-filling curve and sorts faces by their points, so that neighbours are
    /// close in memory.
    fn put_in_order(&mut self) {
        let along = |place: DVec3| along_curve(place, 1.0 / CELLS_PER_HALF_AXIS);
        let codes = self.points.par_iter().enumerate().map(|(point, place)| (along(*place), point as u32));
        let mut order: Vec<(u64, u32)> = codes.collect();
        order.par_sort_unstable();
        let mut numbers = vec![NO_INDEX; order.len()];
        for (number, (_, point)) in order.iter().enumerate() {
            numbers[*point as usize] = number as u32;
        }
        self.points = order.iter().map(|(_, point)| self.points[*point as usize]).collect();
        self.point_of.iter_mut().for_each(|point| *point = numbers[*point as usize]);

        let first = |corners: &[u32; 3]| corners.iter().copied().min().unwrap_or(NO_INDEX);
        let keys = self.corners().into_par_iter().enumerate();
        let keys = keys.map(|(face, corners)| u64::from(first(&corners)) << 32 | face as u64);
        let mut keys: Vec<u64> = keys.collect();
        keys.par_sort_unstable();
        self.in_file = keys.iter().map(|key| *key as u32).collect();
        let order = &self.in_file;
        self.faces = in_order(&self.faces, order);
        self.material = in_order(&self.material, order);
        self.geometry = in_order(&self.geometry, order);
        self.marked = in_order(&self.marked, order);
    }

    /// Points of the corners of each face; [`NO_INDEX`] for faces that are not drawn.
    pub(crate) fn corners(&self) -> Vec<[u32; 3]> {
        let point = |wedge: u32| self.point_of.get(wedge as usize).copied().unwrap_or(NO_INDEX);
        self.faces.iter().map(|wedges| wedges.map(point)).collect()
    }
}

/// Instances of a geometry.
struct DrawnGeometry {
    /// Transform of the first instance.
    place: DAffine3,
    count: usize,
    weight: f64,
}

/// Instances of each geometry; `None` if it has none that can be drawn.
fn shown(scene: &Scene) -> Vec<Option<DrawnGeometry>> {
    let mut all: Vec<Option<DrawnGeometry>> = scene.geometries.iter().map(|_| None).collect();
    for part in scene.parts.iter().filter(|part| scene.geometry_of(part).is_some()) {
        let Some(shown) = all.get_mut(part.geometry) else { continue };
        let place = part.world_from_part;
        let shown = shown.get_or_insert(DrawnGeometry { place, count: 0, weight: 0.0 });
        // The error is a squared length times an area, so it scales with the fourth power of the cube root of
        // the volume.
        let volume = (place.matrix3.determinant() / shown.place.matrix3.determinant()).abs();
        shown.count += 1;
        shown.weight += cbrt(volume).powi(4);
    }
    for shown in all.iter_mut().flatten() {
        // Removing a face removes it from all instances, so the weight is per instance.
        shown.weight /= shown.count as f64;
    }
    all
}

/// Distance within which vertices of a geometry on open edges are welded.
fn reach(geometry: &Geometry) -> f64 {
    let around = Bounds::of(DrawnPoints::of_geometry(geometry));
    let written =
        if geometry.single_precision { WELD_OF_F32_COORDINATE * around.largest_coordinate() } else { 0.0 };
    let reach = (WELD_OF_PART * around.diagonal()).max(written);
    if reach.is_finite() { reach } else { 0.0 }
}

/// Coordinate frame that gives the scene about size 1.
struct SpatialFrame {
    middle: DVec3,
    scale: f64,
}

impl SpatialFrame {
    fn of(scene: &Scene, shown: &[Option<DrawnGeometry>]) -> Self {
        let places = scene.geometries.iter().zip(shown).filter_map(|(geometry, shown)| {
            let place = shown.as_ref()?.place;
            Some(
                DrawnPoints::of_geometry(geometry)
                    .into_iter()
                    .map(move |point| place.transform_point3(point)),
            )
        });
        let around = Bounds::of(places.flatten());
        let size = around.size().max_element();
        let sound = size > 0.0 && size.is_finite();
        Self {
            middle: if sound { around.low.midpoint(around.high) } else { DVec3::ZERO },
            scale: if sound { 1.0 / size } else { 1.0 },
        }
    }

    fn place(&self, point: DVec3) -> DVec3 {
        (point - self.middle) * self.scale
    }
}

fn in_order<T: Copy>(values: &[T], order: &[u32]) -> Vec<T> {
    if values.is_empty() { Vec::new() } else { order.iter().map(|which| values[*which as usize]).collect() }
}

/// Hash of the attributes that must be continuous along an edge.
fn class(number: usize, geometry: &Geometry, wedge: Wedge, textured: bool) -> u32 {
    let pair = |[a, b]: [f32; 2]| u64::from(a.to_bits()) << 32 | u64::from(b.to_bits());
    let uv = geometry.uvs.get(wedge.uv as usize).filter(|_| textured).map_or(u64::MAX, |uv| pair(*uv));
    let colour = geometry.colours.get(wedge.vertex as usize);
    let [rg, ba] = colour.map_or([0; 2], |[r, g, b, a]| [pair([*r, *g]), pair([*b, *a])]);
    if uv == u64::MAX && colour.is_none() {
        return number as u32;
    }
    hash(number as u64, &[uv, rg, ba]) as u32
}

/// Whether texture coordinates of a material matter.
fn is_textured(material: &Material) -> bool {
    material.texture.is_some() || material.picture.is_some() || material.opacity_map.is_some()
}

fn unit([x, y, z]: [f32; 3]) -> [f32; 3] {
    let length = (x * x + y * y + z * z).sqrt();
    if length > 0.0 && length.is_finite() { [x / length, y / length, z / length] } else { [0.0; 3] }
}
