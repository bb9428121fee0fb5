//! Flattens all instances of a scene into one [`Soup`] in world space.

use crate::parallel::prelude::*;
use glam::{DAffine3, DMat3, DVec3};

use super::{Geometry, Paints, Part, Scene};
use crate::mesh::{EdgeMark, MaterialId, PaintId, PartId, Soup, Wire};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::scene::cameras::framing::world_points;
use crate::scene::extent::coordinate_limits::bounds;
use crate::scene::extent::coordinate_limits::is_drawable;

const NO_INDEX: u32 = u32::MAX;
impl Scene {
    /// All triangles and wires in world space.
    ///
    /// Part ids index [`Scene::parts`]; material ids index [`Scene::materials`], and elements without a
    /// material get the id after the last. Mirrored parts have their winding reversed. Parts whose transform
    /// is singular or not finite are left out.
    #[must_use]
    pub(crate) fn to_soup(&self) -> Soup {
        self.flattened(None)
    }

    /// All triangles and wires in world space, with the paint of each triangle.
    #[must_use]
    pub(crate) fn to_painted_soup(&self, paints: &Paints) -> Soup {
        self.flattened(Some(paints))
    }

    /// Like [`Scene::to_soup`], but consumes the geometries: they are empty afterwards, and a single
    /// untransformed geometry is moved without a copy.
    pub(crate) fn take_soup(&mut self, paints: Option<&Paints>) -> Soup {
        let soup = match self.single_untransformed_geometry().filter(|_| paints.is_none()) {
            Some(only) => {
                let mut from = std::mem::take(&mut self.geometries[only]);
                // The step of single precision depends on the largest coordinate, so it is computed before
                // the positions are taken.
                from.lattice_step = from.step();
                let (positions, triangles) =
                    (std::mem::take(&mut from.positions), std::mem::take(&mut from.triangles));
                let mut soup = Soup { positions, triangles, ..Soup::default() };
                let appended = AppendedRange { part: PartId::default(), vertex: 0, triangle: 0 };
                append_attributes(
                    &mut soup,
                    &from,
                    &DAffine3::IDENTITY,
                    appended,
                    self.materials.len() as u32,
                );
                soup
            }
            None => self.flattened(paints),
        };
        self.geometries.iter_mut().for_each(|geometry| *geometry = Geometry::default());
        soup
    }

    /// Index of the geometry, if there is a single part with the identity transform.
    fn single_untransformed_geometry(&self) -> Option<usize> {
        let [part] = self.parts.as_slice() else { return None };
        let geometry = self.geometry_of(part).filter(|_| part.world_from_part == DAffine3::IDENTITY)?;
        (geometry.positions.len() < NO_INDEX as usize).then_some(part.geometry)
    }

    fn flattened(&self, paints: Option<&Paints>) -> Soup {
        let mut soup = Soup::default();
        let default_material = self.materials.len() as u32;
        self.reserve(&mut soup);
        for (id, part) in self.parts.iter().enumerate() {
            if let Some(geometry) = self.geometry_of(part) {
                append(&mut soup, geometry, &part.world_from_part, PartId::from(id), default_material);
                if let Some(paints) = paints {
                    append_paints(&mut soup, paints.of_geometry(part.geometry));
                    if paints.tinted {
                        append_colours(&mut soup, geometry, part.world_from_part.matrix3.determinant() < 0.0);
                    }
                }
            }
        }
        soup
    }

    /// Reserves memory for all parts at once. Growing lists would be copied repeatedly and could end up twice
    /// as large as needed. A failed reservation is ignored.
    fn reserve(&self, soup: &mut Soup) {
        let (mut positions, mut triangles) = (0, 0);
        for geometry in self.parts.iter().filter_map(|part| self.geometry_of(part)) {
            if positions + geometry.positions.len() < NO_INDEX as usize {
                positions += geometry.positions.len();
                triangles += geometry.triangles.len();
            }
        }
        let rooms = [
            soup.positions.try_reserve_exact(positions),
            soup.triangles.try_reserve_exact(triangles),
            soup.triangle_part.try_reserve_exact(triangles),
            soup.triangle_material.try_reserve_exact(triangles),
        ];
        drop(rooms);
    }

    /// Bounding box of everything that is drawn, in world space. Faces without area and wires without length
    /// do not count. `None` if nothing can be drawn.
    #[must_use]
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        bounds(&world_points(self))
    }

    /// Number of triangles, instances counted.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.parts.iter().filter_map(|part| self.geometry_of(part)).map(|g| g.triangles.len()).sum()
    }

    /// Geometry of a part, if its transform is finite and not singular.
    #[must_use]
    pub fn geometry_of(&self, part: &Part) -> Option<&Geometry> {
        let determinant = part.world_from_part.matrix3.determinant();
        let can_be_placed = determinant != 0.0 && determinant.is_finite() && part.world_from_part.is_finite();
        self.geometries.get(part.geometry).filter(|_| can_be_placed)
    }
}

fn append(soup: &mut Soup, from: &Geometry, to_world: &DAffine3, part: PartId, default_material: u32) {
    let first = soup.positions.len();
    // Ids have 32 bits; a part that does not fit is left out.
    if first + from.positions.len() >= NO_INDEX as usize {
        return;
    }
    let is_identity = *to_world == DAffine3::IDENTITY;
    if is_identity {
        soup.positions.extend_from_slice(&from.positions);
    } else {
        let placed = from.positions.par_iter().with_min_len(MIN_TASK_ITEMS);
        soup.positions.par_extend(placed.map(|&p| to_world.transform_point3(p)));
        let own = soup.positions.get(first..).unwrap_or_default();
        if !own.par_iter().with_min_len(MIN_TASK_ITEMS).all(|&p| is_drawable(p)) {
            soup.positions.truncate(first);
            return;
        }
    }
    let turned = to_world.matrix3.determinant() < 0.0;
    let first_triangle = soup.triangles.len();
    append_corners(&mut soup.triangles, &from.triangles, first as u32, turned);
    let appended = AppendedRange { part, vertex: first, triangle: first_triangle };
    append_attributes(soup, from, to_world, appended, default_material);
}

/// Part, first vertex and first triangle of the geometry that was appended last.
struct AppendedRange {
    part: PartId,
    vertex: usize,
    triangle: usize,
}

/// Appends the attributes of the vertices and triangles that were appended last.
fn append_attributes(
    soup: &mut Soup,
    from: &Geometry,
    to_world: &DAffine3,
    appended: AppendedRange,
    default_material: u32,
) {
    let AppendedRange { part, vertex: first, triangle: first_triangle } = appended;
    let turned = to_world.matrix3.determinant() < 0.0;
    let count = soup.triangles.len();

    extend_to(&mut soup.triangle_part, count, part);
    let material = from.material.unwrap_or(default_material);
    if from.triangle_material.is_empty() {
        extend_to(&mut soup.triangle_material, count, MaterialId(material));
    } else {
        soup.triangle_material.extend(from.triangle_material.iter().map(|&m| MaterialId(m)));
        soup.triangle_material.resize(count, MaterialId(material));
    }
    append_normals(soup, from, to_world, first_triangle, turned);

    let first_uv = soup.uvs.len() as u32;
    soup.uvs.extend_from_slice(&from.uvs);
    append_optional(&mut soup.corner_uvs, &from.corner_uvs, first_uv, turned, first_triangle, count);

    if !from.edge_marks.is_empty() {
        soup.edge_marks.resize(first_triangle, [EdgeMark::Unmarked; 3]);
        let marks =
            from.edge_marks.iter().map(|&[ab, bc, ca]| if turned { [ca, bc, ab] } else { [ab, bc, ca] });
        soup.edge_marks.extend(marks);
    }
    if !soup.edge_marks.is_empty() {
        soup.edge_marks.resize(count, [EdgeMark::Unmarked; 3]);
    }
    let first = first as u32;
    soup.wires.extend(from.wires.iter().map(|&[a, b]| Wire {
        vertices: [a, b].map(|i| i.saturating_add(first)),
        part,
        material: MaterialId(material),
    }));
    soup.single_precision |= from.single_precision;
    let step = from.step() * longest_axis(to_world);
    if step > 0.0 {
        let part = part.index();
        soup.steps.resize(soup.steps.len().max(part + 1), 0.0);
        soup.steps[part] = step;
    }
}

/// Maximum scale of a transform along the local axes.
pub(crate) fn longest_axis(to_world: &DAffine3) -> f64 {
    let axes = to_world.matrix3;
    axes.x_axis.length().max(axes.y_axis.length()).max(axes.z_axis.length())
}

/// Extends a list with `value` up to `count` items.
fn extend_to<T: Copy>(list: &mut Vec<T>, count: usize, value: T) {
    list.resize(count, value);
}

/// Appends the paints of the triangles that were appended last; by default those of their materials.
fn append_paints(soup: &mut Soup, paints: &[PaintId]) {
    let own = soup.triangle_material.iter().skip(soup.triangle_paint.len()).enumerate();
    let of = own.map(|(i, material)| paints.get(i).copied().unwrap_or((*material).into()));
    let of: Vec<PaintId> = of.collect();
    soup.triangle_paint.extend(of);
}

/// Appends the corner colours of the triangles that were appended last; white by default.
fn append_colours(soup: &mut Soup, from: &Geometry, turned: bool) {
    let white = [1.0; 4];
    let colour = |v: u32| {
        let [r, g, b, _] = from.colour_of(v).unwrap_or(white);
        [r, g, b]
    };
    let missing = soup.triangles.len() - soup.corner_colours.len();
    let of = |&[a, b, c]: &[u32; 3]| if turned { [a, c, b].map(colour) } else { [a, b, c].map(colour) };
    soup.corner_colours.extend(from.triangles.iter().take(missing).map(of));
}

fn append_corners(to: &mut Vec<[u32; 3]>, from: &[[u32; 3]], first: u32, turned: bool) {
    let all = from;
    let from = all.par_iter().with_min_len(MIN_TASK_ITEMS);
    match (first, turned) {
        (0, false) => to.extend_from_slice(all),
        (_, false) => to.par_extend(from.map(|t| t.map(|i| i.saturating_add(first)))),
        (_, true) => to.par_extend(from.map(|&[a, b, c]| [a, c, b].map(|i| i.saturating_add(first)))),
    }
}

/// Appends corner indices of normals or texture coordinates, with none for triangles without them.
fn append_optional(
    to: &mut Vec<[u32; 3]>,
    from: &[[u32; 3]],
    first: u32,
    turned: bool,
    first_triangle: usize,
    count: usize,
) {
    if !from.is_empty() {
        to.resize(first_triangle, [NO_INDEX; 3]);
        append_corners(to, from, first, turned);
    }
    if !to.is_empty() {
        to.resize(count, [NO_INDEX; 3]);
    }
}

/// Appends normals, transformed by the inverse transpose so that they stay perpendicular to the surface.
fn append_normals(
    soup: &mut Soup,
    from: &Geometry,
    to_world: &DAffine3,
    first_triangle: usize,
    turned: bool,
) {
    let first = soup.normals.len();
    let count = soup.triangles.len();
    let is_identity = to_world.matrix3 == DMat3::IDENTITY;
    let turn = if is_identity { DMat3::IDENTITY } else { to_world.matrix3.inverse().transpose() };
    soup.normals.par_extend(from.normals.par_iter().with_min_len(MIN_TASK_ITEMS).map(|&[x, y, z]| {
        let normal = DVec3::new(x.into(), y.into(), z.into());
        let normal = if is_identity { normal } else { turn * normal }.try_normalize();
        normal.map_or([0.0; 3], |n| [n.x as f32, n.y as f32, n.z as f32])
    }));
    let all_sound =
        soup.normals[first..].par_iter().with_min_len(MIN_TASK_ITEMS).all(|normal| *normal != [0.0; 3]);
    append_optional(
        &mut soup.corner_normals,
        &from.corner_normals,
        first as u32,
        turned,
        first_triangle,
        count,
    );
    if !all_sound {
        for corner in soup.corner_normals.iter_mut().skip(first_triangle).flatten() {
            if soup.normals.get(*corner as usize).is_some_and(|n| *n == [0.0; 3]) {
                *corner = NO_INDEX;
            }
        }
    }
}

#[cfg(test)]
mod tests;
