//! Cut-outs: removes the transparent parts of a material's picture from its triangles, so that contours,
//! visibility, regions, shadows and hatching see real holes.
//!
//! 1. [`opacity_mask`] reads the opacity of each texel and the lowest opacity that counts as opaque.
//! 2. [`mask_borders`] traces the border between opaque and clear with bilinear interpolation, in the texel
//!    plane.
//! 3. [`border_detail`] chooses how far the border may be simplified.
//! 4. The crossings of borders with triangle sides are computed once per side, so that neighbours still meet.
//! 5. [`triangle_cut`] cuts each triangle by a constrained Delaunay triangulation and keeps the opaque
//!    pieces.
//! 6. [`cut_geometry`] assembles the geometry from whole triangles and pieces.

mod border_detail;
mod cut_geometry;
mod mask_borders;
mod opacity_mask;
mod triangle_cut;

use std::borrow::Cow;
use std::hash::Hash;

use crate::parallel::prelude::*;
use glam::DVec2;
use rustc_hash::FxHashMap;

use self::cut_geometry::GeometryBuilder;
use self::opacity_mask::{CutExtent, OpacityMask};
use self::triangle_cut::{TexelTriangle, TrianglePieces};
use crate::scene::textures::texel_plane::side_crossings::{TexelSide, doubled_area, sort_crossings};
use crate::scene::textures::texel_plane::texel_borders::{BorderIndex, BorderSegment};
use crate::scene::{Geometry, Scene, Warnings};

/// A scene without the transparent parts of its materials.
pub(crate) struct CutScene<'a> {
    /// The remaining scene; borrowed if nothing is cut away.
    pub scene: Cow<'a, Scene>,
    /// For each geometry that was cut, the original triangle of each new one.
    pub origins: Vec<Option<Vec<u32>>>,
    /// Pictures and triangles that could not be cut.
    pub warnings: Warnings,
}

/// Removes the transparent parts of materials from a scene.
#[must_use]
pub(crate) fn cut_out(scene: &Scene) -> CutScene<'_> {
    let mut warnings = Warnings::default();
    let read: Vec<_> = scene.materials.par_iter().map(|material| CutExtent::of(scene, material)).collect();
    let mut stencils = Vec::with_capacity(read.len());
    for (id, (masked, material)) in read.into_iter().zip(&scene.materials).enumerate() {
        let stencil = match masked {
            Ok(CutExtent::Nowhere) => Ok(MaterialStencil::Whole),
            Ok(CutExtent::Everywhere) => Ok(MaterialStencil::Clear),
            Ok(CutExtent::Where(mask)) => match border_detail::border_index(scene, id, &mask) {
                Some(outline) => Ok(MaterialStencil::Cut(Box::new((mask, outline)))),
                None => Err("its picture has too much detail".to_owned()),
            },
            Err(message) => Err(message),
        };
        stencils.push(stencil.unwrap_or_else(|message| {
            warnings.note(format!("nothing is cut out of the material `{}`: {message}", material.name));
            MaterialStencil::Whole
        }));
    }
    if stencils.iter().all(|stencil| matches!(stencil, MaterialStencil::Whole)) {
        return CutScene { scene: Cow::Borrowed(scene), origins: Vec::new(), warnings };
    }
    let mut cut = scene.clone();
    let mut origins = Vec::with_capacity(cut.geometries.len());
    let mut too_many = 0;
    for geometry in &mut cut.geometries {
        let (rebuilt, whole) = cut_geometry(geometry, &stencils);
        too_many += whole;
        let (rebuilt, of_pieces) = rebuilt.unzip();
        origins.push(of_pieces);
        if let Some(rebuilt) = rebuilt {
            *geometry = rebuilt;
        }
    }
    if too_many > 0 {
        warnings.note(format!("{too_many} triangles show too much of a cut-out picture to be cut along it"));
    }
    CutScene { scene: Cow::Owned(cut), origins, warnings }
}

/// Treatment of a material's triangles: kept, removed, or cut along the borders of a mask.
enum MaterialStencil {
    Whole,
    Clear,
    Cut(Box<(OpacityMask, BorderIndex)>),
}

/// Corners of a triangle in the texel plane; `None` if it has no valid texture coordinates.
fn texels_of(geometry: &Geometry, triangle: usize, mask: &OpacityMask) -> Option<[DVec2; 3]> {
    let [a, b, c] =
        geometry.corner_uvs.get(triangle)?.map(|uv| mask.texels.place(*geometry.uvs.get(uv as usize)?));
    Some([a?, b?, c?])
}

/// A side of a triangle, identified by the positions of its ends.
type SideKey = [[u64; 3]; 2];

/// Classification of a triangle against the mask, independent of its neighbours.
enum TriangleCoverage<'a> {
    Whole,
    Gone,
    Crossed(Box<CrossedTriangle<'a>>),
    /// Too many borders to cut along.
    TooMany,
}

/// A triangle that borders pass through.
struct CrossedTriangle<'a> {
    mask: &'a OpacityMask,
    corners: [DVec2; 3],
    sides: [TexelSide; 3],
    borders: Vec<BorderSegment>,
    /// Positions of the crossings on each side, 0 to 1.
    parts: [Vec<f64>; 3],
}

/// Cuts a geometry. Returns the new geometry with the original triangle of each new one, or `None` if nothing
/// is cut away; and the number of triangles that could not be cut.
fn cut_geometry(geometry: &Geometry, stencils: &[MaterialStencil]) -> (Option<(Geometry, Vec<u32>)>, usize) {
    let stencil = |triangle: usize| {
        let material = geometry.material_of(triangle).and_then(|id| stencils.get(id as usize));
        material.unwrap_or(&MaterialStencil::Whole)
    };
    let count = geometry.triangles.len();
    let is_sound = geometry.triangles.as_flattened().iter().all(|v| (*v as usize) < geometry.positions.len());
    if !is_sound || (0..count).all(|triangle| matches!(stencil(triangle), MaterialStencil::Whole)) {
        return (None, 0);
    }
    // Triangles that show the same part of a picture, such as the leaves of a tree, are classified and cut
    // once.
    let shows = group_equal((0..count).map(|triangle| texel_key(geometry, triangle, stencil(triangle))));
    let looks: Vec<TriangleCoverage> = shows
        .firsts
        .par_iter()
        .map(|triangle| match stencil(*triangle) {
            MaterialStencil::Whole => TriangleCoverage::Whole,
            MaterialStencil::Clear => TriangleCoverage::Gone,
            MaterialStencil::Cut(cut) => classify_triangle(geometry, *triangle, &cut.0, &cut.1),
        })
        .collect();
    let look_of = |triangle: usize| &looks[shows.kind[triangle] as usize];
    let crossings = crossings(geometry, look_of);
    let none = Vec::new();
    let of_sides = |triangle: usize| {
        side_keys(geometry, triangle)
            .map(|(key, is_forward)| (crossings.get(&key).unwrap_or(&none), is_forward))
    };
    let cut_like = group_equal((0..count).map(|triangle| (shows.kind[triangle], of_sides(triangle))));
    let pieces: Vec<Option<TrianglePieces>> = cut_like
        .firsts
        .par_iter()
        .map(|triangle| {
            let of_sides = of_sides(*triangle);
            let crossings = of_sides
                .map(|(crossings, _)| crossings.iter().map(|bits| f64::from_bits(*bits)).collect::<Vec<_>>());
            let crossings = crossings.each_ref().map(Vec::as_slice);
            match look_of(*triangle) {
                TriangleCoverage::Gone => Some(TrianglePieces::default()),
                TriangleCoverage::Crossed(crossed) => {
                    let CrossedTriangle { mask, corners, sides, borders, .. } = crossed.as_ref();
                    TexelTriangle { corners: *corners, sides: *sides, crossings }.cut(borders, Some(mask))
                }
                _ if crossings.iter().all(|crossings| crossings.is_empty()) => None,
                // A neighbour is cut along a common side. Adding the same points here keeps both connected.
                _ => {
                    let corners = [DVec2::ZERO, DVec2::X, DVec2::Y];
                    let sides = sides(corners, of_sides.map(|side| side.1));
                    TexelTriangle { corners, sides, crossings }.cut(&[], None)
                }
            }
        })
        .collect();
    let mut rebuilt = GeometryBuilder::of(geometry);
    for triangle in 0..count {
        match &pieces[cut_like.kind[triangle] as usize] {
            None => rebuilt.keep(triangle),
            Some(pieces) => rebuilt.add(triangle, pieces, of_sides(triangle)),
        }
    }
    let left_whole = |triangle: &usize| match look_of(*triangle) {
        TriangleCoverage::TooMany => true,
        TriangleCoverage::Crossed(_) => pieces[cut_like.kind[*triangle] as usize].is_none(),
        TriangleCoverage::Whole | TriangleCoverage::Gone => false,
    };
    let too_many = (0..count).filter(left_whole).count();
    (Some(rebuilt.done()), too_many)
}

/// Key of the part of a picture that a triangle shows: material, texture coordinates, and the direction of
/// its sides. `None` if it does not depend on a picture.
type TexelKey = Option<(u32, [[u32; 2]; 3], [bool; 3])>;

/// Key of a triangle, and whether any of it may remain.
fn texel_key(geometry: &Geometry, triangle: usize, stencil: &MaterialStencil) -> (bool, TexelKey) {
    let corners = geometry.corner_uvs.get(triangle).map(|corners| {
        corners.map(|uv| geometry.uvs.get(uv as usize).map_or([u32::MAX; 2], |uv| uv.map(f32::to_bits)))
    });
    match stencil {
        MaterialStencil::Whole => (true, None),
        MaterialStencil::Clear => (false, None),
        MaterialStencil::Cut(_) => {
            let is_forward = side_keys(geometry, triangle).map(|key| key.1);
            let material = geometry.material_of(triangle).unwrap_or(u32::MAX);
            (true, Some((material, corners.unwrap_or([[u32::MAX; 2]; 3]), is_forward)))
        }
    }
}

/// Groups of equal items.
struct EqualGroups {
    /// Group of each item.
    kind: Vec<u32>,
    /// First item of each group.
    firsts: Vec<usize>,
}

fn group_equal<T: Eq + Hash>(all: impl Iterator<Item = T>) -> EqualGroups {
    let mut known: FxHashMap<T, u32> = FxHashMap::default();
    let mut alike = EqualGroups { kind: Vec::new(), firsts: Vec::new() };
    for (number, one) in all.enumerate() {
        let next = alike.firsts.len() as u32;
        let kind = *known.entry(one).or_insert(next);
        if kind == next {
            alike.firsts.push(number);
        }
        alike.kind.push(kind);
    }
    alike
}

/// Classifies a triangle against a mask.
fn classify_triangle<'a>(
    geometry: &Geometry,
    triangle: usize,
    mask: &'a OpacityMask,
    outline: &BorderIndex,
) -> TriangleCoverage<'a> {
    let Some(corners) = texels_of(geometry, triangle, mask) else { return TriangleCoverage::Whole };
    let [a, b, c] = corners;
    let whole_or_gone =
        || if mask.is_opaque((a + b + c) / 3.0) { TriangleCoverage::Whole } else { TriangleCoverage::Gone };
    if doubled_area(a, b, c) == 0.0 {
        return whole_or_gone();
    }
    let Some(mut borders) = outline.near(a.min(b).min(c), a.max(b).max(c)) else {
        return TriangleCoverage::TooMany;
    };
    let sides = sides(corners, side_keys(geometry, triangle).map(|key| key.1));
    let mut parts: [Vec<f64>; 3] = Default::default();
    borders.retain(|border| {
        let crossed = sides.map(|side| side.crossing(*border).map(|(part, _)| part));
        parts.iter_mut().zip(crossed).for_each(|(parts, part)| parts.extend(part));
        crossed.iter().any(Option::is_some)
            || border.iter().any(|end| sides.iter().all(|side| side.admits(*end)))
    });
    if borders.is_empty() {
        return whole_or_gone();
    }
    TriangleCoverage::Crossed(Box::new(CrossedTriangle { mask, corners, sides, borders, parts }))
}

/// Sides of a triangle in the texel plane, each directed from the end that comes first in space.
fn sides(corners: [DVec2; 3], is_forward: [bool; 3]) -> [TexelSide; 3] {
    [0, 1, 2].map(|k| {
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        let (from, to) = if is_forward[k] { (a, b) } else { (b, a) };
        TexelSide { from, to, inside: doubled_area(from, to, corners[(k + 2) % 3]) >= 0.0 }
    })
}

/// Keys of a triangle's sides, and whether each side begins with the end that comes first in space.
fn side_keys(geometry: &Geometry, triangle: usize) -> [(SideKey, bool); 3] {
    let ends = geometry.triangles[triangle].map(|corner| geometry.positions[corner as usize]);
    [0, 1, 2].map(|k| {
        let [a, b] = [ends[k], ends[(k + 1) % 3]].map(|p| (p + glam::DVec3::ZERO).to_array());
        let is_forward = a.partial_cmp(&b).is_none_or(std::cmp::Ordering::is_le);
        let [a, b] = [a, b].map(|p| p.map(f64::to_bits));
        (if is_forward { [a, b] } else { [b, a] }, is_forward)
    })
}

/// Crossings of borders with all sides, from both adjacent triangles: sorted positions along the side, as
/// bits.
fn crossings<'a>(
    geometry: &Geometry,
    look: impl Fn(usize) -> &'a TriangleCoverage<'a>,
) -> FxHashMap<SideKey, Vec<u64>> {
    let mut all: FxHashMap<SideKey, Vec<f64>> = FxHashMap::default();
    for triangle in 0..geometry.triangles.len() {
        let TriangleCoverage::Crossed(crossed) = look(triangle) else { continue };
        for (parts, (key, _)) in crossed.parts.iter().zip(side_keys(geometry, triangle)) {
            if !parts.is_empty() {
                all.entry(key).or_default().extend(parts);
            }
        }
    }
    let bits = |mut parts: Vec<f64>| {
        sort_crossings(&mut parts);
        parts.into_iter().map(f64::to_bits).collect()
    };
    all.into_iter().map(|(key, parts)| (key, bits(parts))).collect()
}

#[cfg(test)]
mod tests;
