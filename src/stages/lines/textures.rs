//! [`Textures`]: the pictures that a view shows on its surfaces, each in the few colours it is painted in.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{LineKind, LineOptions};
use crate::math::oklab::{self, Oklab, distance2};
use crate::mesh::{FaceId, Mesh, PaintId};
use crate::scene::Paints;
use crate::scene::texels::outline::{Outline, Segment};
use crate::scene::texture::{Labels, Painted, trace};
use crate::view::View;

/// The pictures that a view shows on its surfaces, each in the few colours it is painted in.
#[derive(Debug, Default)]
pub struct Textures {
    /// By the number of the paint of what shows them.
    of_paint: Vec<Option<Shown>>,
    /// How paints look, and how far two are apart that have a line between them; none where no such lines are wanted.
    artist: Option<(Vec<Oklab>, f32)>,
    warnings: Vec<String>,
}

#[derive(Debug)]
struct Shown {
    labels: Labels,
    borders: Outline,
}

/// How far borders may lie beside their place, px.
const NEAR_PX: f64 = 0.15;

/// A face that shows a picture.
pub(super) struct Textured<'a> {
    shown: &'a Shown,
    /// Its corners in the plane of the texels.
    pub corners: [DVec2; 3],
}

impl Textures {
    /// The pictures as they are seen on a mesh, with a px of so many user units.
    #[must_use]
    pub fn new(mesh: &Mesh, view: &View, paints: &Paints, px: f64, options: &LineOptions) -> Self {
        let mut textures = Self::default();
        if options.enabled && options.kinds.contains(&LineKind::Artist) {
            let colours = paints.list.iter().map(|paint| oklab::of(paint.colour)).collect();
            textures.artist = Some((colours, options.artist_tolerance as f32));
        }
        if paints.pictures.is_empty() {
            return textures;
        }
        let scales = texels_per_px(mesh, view, &paints.pictures, px);
        let shown: Vec<(PaintId, Option<Shown>)> = paints
            .pictures
            .par_iter()
            .zip(scales)
            .map(|((paint, painted), texels_per_px)| {
                let labels = painted.labels(texels_per_px);
                let per_px = texels_per_px * labels.texels.size[0] as f64 / painted.texels().size[0] as f64;
                let near = if per_px.is_finite() { (NEAR_PX * per_px).clamp(0.005, 0.5) } else { 0.1 };
                let borders = trace(&labels).map(|traced| Outline::new(&traced, near));
                (*paint, borders.map(|borders| Shown { labels, borders }))
            })
            .collect();
        for (paint, shown) in shown {
            if shown.is_none() {
                textures
                    .warnings
                    .push("a texture has too much detail, and counts as its mean colour".to_owned());
            }
            textures.of_paint.resize_with(textures.of_paint.len().max(paint.index() + 1), || None);
            textures.of_paint[paint.index()] = shown;
        }
        textures
    }

    /// What could not be painted.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The paint at a point of a face.
    #[must_use]
    pub fn paint(&self, mesh: &Mesh, face: u32, at: DVec3) -> PaintId {
        let shown = self.on(mesh, face);
        let shown = shown.and_then(|shown| shown.paint(mesh.weights(FaceId(face), at)));
        shown.unwrap_or_else(|| mesh.paint(FaceId(face)))
    }

    /// What a line is that parts two paints of one material.
    pub(super) fn parting(&self, a: PaintId, b: PaintId) -> LineKind {
        let Some((colours, tolerance)) = &self.artist else { return LineKind::Isophote };
        let [a, b] = [a, b].map(|paint| colours.get(paint.index()).copied().unwrap_or_default());
        if distance2(a, b) > tolerance * tolerance { LineKind::Artist } else { LineKind::Isophote }
    }

    /// Whether any face shows a picture.
    pub(super) fn is_empty(&self) -> bool {
        self.of_paint.iter().all(Option::is_none)
    }

    /// What a face shows; none if it is of one paint.
    pub(super) fn on(&self, mesh: &Mesh, face: u32) -> Option<Textured<'_>> {
        let shown = self.of_paint.get(mesh.paint(FaceId(face)).index())?.as_ref()?;
        let corners = texels(mesh, face, |uv| shown.labels.texels.place(uv))?;
        Some(Textured { shown, corners })
    }
}

impl Textured<'_> {
    /// The point of the plane of the texels that lies at a point of the face.
    fn place(&self, weights: [f64; 3]) -> DVec2 {
        let [a, b, c] = self.corners;
        a * weights[0] + b * weights[1] + c * weights[2]
    }

    /// How many texels lie between two points of the face.
    pub fn texels_along(&self, ends: [[f64; 3]; 2]) -> f64 {
        self.place(ends[0]).distance(self.place(ends[1]))
    }

    /// The paint at a point of the face.
    pub fn paint(&self, weights: [f64; 3]) -> Option<PaintId> {
        self.shown.labels.paint_at(self.place(weights))
    }

    /// The paints of the picture.
    pub fn palette(&self) -> &[PaintId] {
        &self.shown.labels.paints
    }

    /// The borders between colours that may lie on the face, and the paints that each parts.
    pub fn borders(&self) -> Vec<(Segment, [PaintId; 2])> {
        let [a, b, c] = self.corners;
        let paints = &self.shown.labels.paints;
        let make =
            |segment: Segment, parted: [u8; 2]| (segment, parted.map(|colour| paints[colour as usize]));
        self.shown.borders.near_as(a.min(b).min(c), a.max(b).max(c), make).unwrap_or_default()
    }

    /// The paints that may be seen on the face.
    pub fn paints(&self) -> Vec<PaintId> {
        let [a, b, c] = self.corners;
        let within = [a, b, c, (a + b + c) / 3.0].map(|p| self.shown.labels.paint_at(p));
        let parted = self.borders().into_iter().flat_map(|(_, paints)| paints);
        let mut paints: Vec<PaintId> = within.into_iter().flatten().chain(parted).collect();
        paints.sort_unstable();
        paints.dedup();
        paints
    }
}

/// The corners of a face in the plane of the texels.
fn texels(mesh: &Mesh, face: u32, place: impl Fn([f32; 2]) -> Option<DVec2>) -> Option<[DVec2; 3]> {
    let corners = mesh.corner_uvs.get(face as usize)?;
    let [a, b, c] = corners.map(|uv| place(*mesh.uvs.get(uv as usize)?));
    Some([a?, b?, c?])
}

/// How many texels of each picture lie along a px where it turns to the eye, in the mean over what is seen of the page.
fn texels_per_px(mesh: &Mesh, view: &View, pictures: &[(PaintId, Painted)], px: f64) -> Vec<f64> {
    let (width, height) = (view.frame.width, view.frame.height);
    let last = pictures.iter().map(|(paint, _)| paint.index()).max().unwrap_or_default();
    let mut of_paint = vec![None; last + 1];
    for (number, (paint, _)) in pictures.iter().enumerate() {
        of_paint[paint.index()] = Some(number);
    }
    let of_face = |face: usize| -> Option<(usize, [f64; 2])> {
        let number = (*of_paint.get(mesh.paint(FaceId(face as u32)).index())?)?;
        if !view.facing[face] {
            return None;
        }
        let [p, q, r] = mesh.triangles[face].map(|v| view.points[v as usize]);
        let is_out = |p: DVec3| p.is_nan() || p.x < 0.0 || p.y < 0.0 || p.x > width || p.y > height;
        if is_out(p) && is_out(q) && is_out(r) {
            return None;
        }
        let [a, b, c] = texels(mesh, face as u32, |uv| pictures[number].1.texels().place(uv))?;
        let on_page = (q - p).truncate().perp_dot((r - p).truncate()).abs();
        let in_texels = (b - a).perp_dot(c - a).abs();
        (on_page.is_finite()).then_some((number, [in_texels, on_page / (px * px)]))
    };
    let mut sums = vec![[0.0_f64; 2]; pictures.len()];
    // One after another, so that sums are the same with any number of threads.
    for (number, areas) in (0..mesh.triangles.len()).filter_map(of_face) {
        sums[number].iter_mut().zip(areas).for_each(|(sum, area)| *sum += area);
    }
    sums.iter().map(|[texels, page]| if *page > 0.0 { (texels / page).sqrt() } else { 1.0 }).collect()
}
