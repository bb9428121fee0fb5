//! Dots and tiles of patterns on the surface, and the charts that map faces to the pattern's plane.

use glam::{DMat3, DVec2, DVec3};
use kurbo::Vec2;

use super::view_hatching::texture_scales;
use crate::drawing::Page;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::hatching::{Pattern, PatternKind, SurfacePattern};
use crate::lines::Lit;
use crate::mesh::{FaceId, Mesh};
use crate::pipeline::tolerances;
use crate::regions::HatchRegions;
use crate::regions::surface_curves::decals::{Figure, MAX_FIGURES, count, decals};
use crate::regions::surface_curves::surface_chart::Chart;
use crate::scene::{Scene, UpAxis};
use crate::view::{Frame, View};

/// Number of points on the outline of a dot.
const DOT_POINTS: u32 = 40;

/// The dots or tiles of a pattern on the surface.
pub(crate) fn surface_figures(
    lit: &Lit,
    ground: &HatchRegions,
    scene: &Scene,
    pattern: &Pattern,
    page: &Page,
    offset: Vec2,
) -> SurfacePattern {
    let mesh = lit.mesh;
    let [size, width] = [pattern.size, pattern.width].map(|length| length.in_unit(page.unit));
    let (figures, filled) = figures(pattern, width / size);
    if figures.is_empty() {
        return SurfacePattern::Decals(Vec::new(), filled);
    }
    let material = |face: u32| {
        let number = mesh.face_material[face as usize].index();
        scene.materials.get(number).map_or("", |material| material.name.as_str())
    };
    let is_patterned: Vec<bool> =
        (0..mesh.triangles.len() as u32).map(|face| pattern.material.matches(material(face))).collect();
    let mut plane =
        PatternPlane::new(lit, scene, pattern.angle.to_radians(), in_model(size, &lit.view.frame));
    let chart =
        |plane: &PatternPlane, face: u32| is_patterned[face as usize].then(|| plane.chart(face)).flatten();
    let figure_count = count(mesh, |face| chart(&plane, face), &figures);
    plane.spacing *= (figure_count / MAX_FIGURES).sqrt().max(1.0);
    let placed_decals = decals(lit, ground, offset, &|face| chart(&plane, face), &figures);
    SurfacePattern::Decals(placed_decals, filled)
}

/// The length in the model of a page length, at the camera's target.
pub(crate) fn in_model(length: f64, frame: &Frame) -> f64 {
    length / frame.scale * if frame.perspective { frame.focus } else { 1.0 }
}

/// The figures that a pattern repeats, y upwards, and whether each is filled.
fn figures(own: &Pattern, width: f64) -> (Vec<Figure>, Vec<bool>) {
    if own.kind == PatternKind::Dots {
        let at = |k: u32| {
            let angle = f64::from(k) / f64::from(DOT_POINTS) * std::f64::consts::TAU;
            DVec2::new(cos(angle), sin(angle)) * (width / 2.0)
        };
        let dot = Figure { lines: vec![(0..DOT_POINTS).map(at).collect()], period: DVec2::ONE };
        return (vec![dot], vec![true]);
    }
    let tile = &own.tile;
    if tile.height <= 0.0 {
        return (Vec::new(), Vec::new());
    }
    let period = DVec2::new(1.0, tile.height);
    let line = |line: &Vec<kurbo::Point>| line.iter().map(|p| DVec2::new(p.x, -p.y)).collect();
    let lines = tile.lines.iter().map(|own| (Figure { lines: vec![line(own)], period }, false));
    let shapes =
        tile.shapes.iter().map(|rings| (Figure { lines: rings.iter().map(line).collect(), period }, true));
    lines.chain(shapes).unzip()
}

/// Plane of unit squares that carries a pattern, and its place on the faces.
struct PatternPlane<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    /// Axes of each part (across, upwards, and normal to both), and their origin.
    parts: Vec<(DMat3, DVec3)>,
    /// For each part, the length of a texture coordinate unit, and whether v runs upwards.
    textures: Vec<(f64, bool)>,
    turn: DVec2,
    /// Side of the squares, in model units.
    spacing: f64,
}

impl<'a> PatternPlane<'a> {
    fn new(lit: &Lit<'a>, scene: &Scene, angle: f64, spacing: f64) -> Self {
        let mesh = lit.mesh;
        let of_part = |part: &crate::scene::Part| {
            let matrix = part.world_from_part.matrix3;
            let up = if scene.up == UpAxis::Y { matrix.y_axis } else { matrix.z_axis };
            let up = up.try_normalize().unwrap_or(DVec3::Y);
            let across = (matrix.x_axis - up * matrix.x_axis.dot(up)).try_normalize();
            let across = across.unwrap_or_else(|| up.any_orthonormal_vector());
            (DMat3::from_cols(across, up, across.cross(up)), part.world_from_part.translation - mesh.origin)
        };
        let scales = texture_scales(mesh);
        let mut turns = vec![0.0; scales.len()];
        for face in 0..mesh.corner_uvs.len() {
            if let (Some([a, b, c]), Some(turn)) =
                (texture(mesh, face as u32), turns.get_mut(mesh.face_part[face].index()))
            {
                *turn += (b - a).perp_dot(c - a);
            }
        }
        Self {
            mesh,
            view: lit.view,
            parts: scene.parts.iter().map(of_part).collect(),
            textures: scales.into_iter().zip(turns).map(|(scale, turn)| (scale, turn >= 0.0)).collect(),
            turn: DVec2::new(cos(angle), sin(angle)),
            spacing,
        }
    }

    /// The corners of a face in the plane. They come from texture coordinates, or else from the two axes of
    /// the part that the face is most parallel to.
    fn chart(&self, face: u32) -> Option<Chart> {
        let place = |p: DVec2| {
            let [x, y] = [p.dot(self.turn), self.turn.perp_dot(p)];
            DVec2::new(x, y) / self.spacing
        };
        let part = self.mesh.face_part[face as usize].index();
        let corners = self.mesh.corners(FaceId(face));
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        if let (Some(uvs), Some((scale, upwards))) = (texture(self.mesh, face), self.textures.get(part)) {
            let flip = DVec2::new(1.0, if *upwards { 1.0 } else { -1.0 });
            let [p, q, r] = uvs.map(|uv| uv * flip * *scale);
            if (q - p).perp_dot(r - p).abs() > tolerances::MIN_TEXTURE_AREA_SHARE * normal.length() {
                return Some(Chart { corners: [p, q, r].map(place), name: 0 });
            }
        }
        let (axes, origin) = self.parts.get(part)?;
        let own = axes.transpose() * if self.view.facing[face as usize] { normal } else { -normal };
        let (axis, _) = own
            .abs()
            .to_array()
            .into_iter()
            .enumerate()
            .fold((2, -1.0), |best, (k, v)| if v > best.1 { (k, v) } else { best });
        let side = own[axis].signum();
        // Seen from outside, upwards points up; seen from above, across stays across.
        let [right, up] = match axis {
            0 => [DVec3::NEG_Z * side, DVec3::Y],
            1 => [DVec3::X, DVec3::NEG_Z * side],
            _ => [DVec3::X * side, DVec3::Y],
        };
        let on = |p: DVec3| {
            let p = axes.transpose() * (p - *origin);
            place(DVec2::new(p.dot(right), p.dot(up)))
        };
        Some(Chart { corners: corners.map(on), name: 1 + 2 * axis as u32 + u32::from(side > 0.0) })
    }
}

/// The texture coordinates of a face's corners.
fn texture(mesh: &Mesh, face: u32) -> Option<[DVec2; 3]> {
    let uvs = mesh.corner_uvs.get(face as usize)?;
    let at = |uv: u32| {
        let [u, v] = mesh.uvs.get(uv as usize)?.map(f64::from);
        (u.is_finite() && v.is_finite()).then(|| DVec2::new(u, v))
    };
    let [a, b, c] = uvs.map(at);
    Some([a?, b?, c?])
}
