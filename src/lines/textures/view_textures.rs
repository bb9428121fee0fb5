//! [`Textures`]: the pictures and the colours of vertices that a view shows on its surfaces, in the few colours they are painted in.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::picture_levels::Drawn;
use super::texel_scale::Seen;
use super::textured_face::Textured;
use crate::colour::oklab::{self, Oklab, distance2};
use crate::lines::{LineKind, LineOptions};
use crate::mesh::{FaceId, Mesh, PaintId};
use crate::scene::Paints;
use crate::scene::paints::varying_surface::{PaintTable, Varied};
use crate::scene::paints::vertex_colours::Tints;
use crate::view::View;

/// The pictures and the colours of vertices that a view shows on its surfaces, in the few colours they are painted in.
#[derive(Debug, Default)]
pub struct Textures {
    /// By the number of the paint of what shows them.
    of_paint: Vec<Option<Shown>>,
    /// Where lines are wanted between colours.
    artist: Option<Artist>,
    warnings: Vec<String>,
}

/// Where lines are wanted between colours.
#[derive(Debug)]
struct Artist {
    /// How paints look; none of those on whose materials lines run by another picture.
    looks: Vec<Option<Oklab>>,
    /// How far two are apart that have a line between them.
    tolerance: f32,
    /// By their number, the materials on which lines run by a picture that is not painted, and how its colours look.
    inked: Vec<Option<(Shown, Vec<Oklab>)>>,
}

/// What is shown in one paint, or on one material, and varies.
#[derive(Debug)]
struct Shown {
    picture: Option<Drawn>,
    tints: Option<Tints>,
    paints: PaintTable,
}

/// The smoothing of pictures that the style asks for if it says nothing, px.
const SMOOTH_PX: f64 = 0.7;

impl Textures {
    /// The pictures as they are seen on a mesh, with a px of so many user units.
    #[must_use]
    pub fn new(mesh: &Mesh, view: &View, paints: &Paints, px: f64, options: &LineOptions) -> Self {
        let mut textures = Self::default();
        let has_artist = options.enabled && options.kinds.contains(&LineKind::Artist);
        let smooth = if has_artist { options.artist_smooth / SMOOTH_PX } else { 1.0 };
        let sight = Sight { mesh, view, px, smooth, crease_deg: options.crease_deg };
        let number = |paint: PaintId| paints.varied.iter().position(|(own, _)| *own == paint);
        let numbers: Vec<Option<usize>> = (0..paints.list.len()).map(|k| number(k.into())).collect();
        let of_face = |face: u32| *numbers.get(mesh.paint(FaceId(face)).index())?;
        let varied: Vec<&Varied> = paints.varied.iter().map(|(_, varied)| varied).collect();
        let shown = sight.shown(&varied, of_face, &mut textures.warnings);
        for ((paint, _), shown) in paints.varied.iter().zip(shown) {
            textures.of_paint.resize_with(textures.of_paint.len().max(paint.index() + 1), || None);
            textures.of_paint[paint.index()] = shown;
        }
        if has_artist {
            let mut inked: Vec<Option<(Shown, Vec<Oklab>)>> = Vec::new();
            let number = |face: u32| {
                let material = mesh.face_material[face as usize];
                paints.inked.iter().position(|(own, _)| *own == material)
            };
            let varied: Vec<&Varied> = paints.inked.iter().map(|(_, varied)| varied).collect();
            let shown = sight.shown(&varied, number, &mut textures.warnings);
            for ((material, varied), shown) in paints.inked.iter().zip(shown) {
                inked.resize_with(inked.len().max(material.index() + 1), || None);
                let looks = varied.picture.as_ref().map_or(&[][..], |painted| painted.palette());
                inked[material.index()] = shown.map(|shown| (shown, looks.to_vec()));
            }
            let is_inked = |material: usize| inked.get(material).is_some_and(Option::is_some);
            let look = |paint: &crate::scene::Paint| {
                (!is_inked(paint.material.index())).then(|| oklab::of(paint.colour))
            };
            let looks = paints.list.iter().map(look).collect();
            let tolerance = options.artist_tolerance as f32;
            textures.artist = Some(Artist { looks, tolerance, inked });
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
    pub(crate) fn parting(&self, a: PaintId, b: PaintId) -> LineKind {
        let look = |paint: PaintId| self.artist.as_ref()?.looks.get(paint.index()).copied().flatten();
        self.kind(look(a), look(b))
    }

    /// What a line is that parts two colours of the picture by which lines run on a face.
    pub(crate) fn parting_ink(&self, mesh: &Mesh, face: u32, [a, b]: [PaintId; 2]) -> LineKind {
        let inked = self.inked(mesh, face);
        let look = |colour: PaintId| inked?.1.get(colour.index()).copied();
        self.kind(look(a), look(b))
    }

    /// What a line is between two looks.
    fn kind(&self, a: Option<Oklab>, b: Option<Oklab>) -> LineKind {
        let Some((artist, a, b)) = self.artist.as_ref().zip(a).zip(b).map(|((artist, a), b)| (artist, a, b))
        else {
            return LineKind::Isophote;
        };
        let is_far = distance2(a, b) > artist.tolerance * artist.tolerance;
        if is_far { LineKind::Artist } else { LineKind::Isophote }
    }

    /// Whether lines are wanted where painted colours change.
    pub(crate) fn has_artist(&self) -> bool {
        self.artist.is_some()
    }

    /// Whether no face shows anything that varies.
    pub(crate) fn is_empty(&self) -> bool {
        self.of_paint.iter().all(Option::is_none)
            && self.artist.as_ref().is_none_or(|artist| artist.inked.iter().all(Option::is_none))
    }

    /// What a face shows; none if it is of one paint.
    pub(crate) fn on(&self, mesh: &Mesh, face: u32) -> Option<Textured<'_>> {
        self.of_paint.get(mesh.paint(FaceId(face)).index())?.as_ref()?.on(mesh, face)
    }

    /// What lies on a face of the picture by which lines run there, its colours as paints by their numbers.
    pub(crate) fn ink_on(&self, mesh: &Mesh, face: u32) -> Option<Textured<'_>> {
        self.inked(mesh, face)?.0.on(mesh, face)
    }

    fn inked(&self, mesh: &Mesh, face: u32) -> Option<&(Shown, Vec<Oklab>)> {
        self.artist.as_ref()?.inked.get(mesh.face_material[face as usize].index())?.as_ref()
    }
}

impl Shown {
    /// What of it lies on a face.
    fn on(&self, mesh: &Mesh, face: u32) -> Option<Textured<'_>> {
        let picture = self.picture.as_ref().and_then(|drawn| {
            let [a, b, c] = mesh.corner_uvs.get(face as usize)?.map(|uv| mesh.uvs.get(uv as usize).copied());
            drawn.on(face, [a?, b?, c?])
        });
        let tints = self.tints.as_ref().zip(mesh.corner_colours.get(face as usize).copied());
        (picture.is_some() || tints.is_some()).then_some(Textured { paints: &self.paints, picture, tints })
    }
}

/// How surfaces are looked at.
struct Sight<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    px: f64,
    /// How much coarser than it is seen detail is drawn.
    smooth: f64,
    /// Surfaces go on across edges that turn by less than this.
    crease_deg: f64,
}

impl Sight<'_> {
    /// What is shown of each of some things that vary; a function tells which of them a face shows. None where a picture has too
    /// much detail.
    fn shown(
        &self,
        varied: &[&Varied],
        number: impl Fn(u32) -> Option<usize> + Sync,
        warnings: &mut Vec<String>,
    ) -> Vec<Option<Shown>> {
        if varied.is_empty() {
            return Vec::new();
        }
        let texels: Vec<_> =
            varied.iter().map(|own| own.picture.as_ref().map(|painted| *painted.texels())).collect();
        let Self { mesh, view, px, .. } = *self;
        let seen = Seen { mesh, view, px, number, texels: &texels };
        let scales = seen.scales();
        let shown: Vec<Option<Shown>> = varied
            .par_iter()
            .zip(scales)
            .enumerate()
            .map(|(picture, (varied, scale))| {
                let (tints, paints) = (varied.tints.clone(), varied.paints().clone());
                let Some(painted) = &varied.picture else {
                    return Some(Shown { picture: None, tints, paints });
                };
                let densities = || seen.densities(picture, self.crease_deg);
                let drawn = Drawn::new(painted, &scale, self.smooth, densities)?;
                Some(Shown { picture: Some(drawn), tints, paints })
            })
            .collect();
        for _ in shown.iter().filter(|shown| shown.is_none()) {
            warnings.push("a texture has too much detail, and counts as its mean colour".to_owned());
        }
        shown
    }
}
