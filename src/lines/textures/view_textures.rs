//! [`Textures`]: the pictures and vertex colours that a view shows, reduced to the few colours that are
//! painted.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::picture_levels::PictureLevels;
use super::texel_scale::PictureView;
use super::textured_face::TexturedFace;
use crate::colour::oklab::{self, Oklab, distance2};
use crate::lines::{LineKind, LineOptions};
use crate::mesh::{FaceId, Mesh, PaintId};
use crate::scene::Paints;
use crate::scene::paints::varying_surface::{PaintTable, VaryingSurface};
use crate::scene::paints::vertex_colours::VertexColourPalette;
use crate::view::View;

/// Pictures and vertex colours that a view shows, reduced to the few colours that are painted.
#[derive(Debug, Default)]
pub(crate) struct Textures {
    /// Indexed by the paint that shows them.
    of_paint: Vec<Option<ShownPaint>>,
    /// Criteria for artist lines, if these are drawn.
    artist: Option<ArtistLines>,
    warnings: Vec<String>,
}

/// Criteria for artist lines.
#[derive(Debug)]
struct ArtistLines {
    /// Colour of each paint; none on materials whose lines follow another picture.
    paint_colours: Vec<Option<Oklab>>,
    /// Smallest colour distance with a line.
    tolerance: f32,
    /// Indexed by material: the picture that lines follow although it is not painted, and its palette.
    inked: Vec<Option<(ShownPaint, Vec<Oklab>)>>,
}

/// Varying colours of one paint or one material.
#[derive(Debug)]
struct ShownPaint {
    picture: Option<PictureLevels>,
    tints: Option<VertexColourPalette>,
    paints: PaintTable,
}

/// Default smoothing of pictures, px.
const DEFAULT_SMOOTHING_PX: f64 = 0.7;

impl Textures {
    /// The textures as seen on a mesh; `px` is a px in user units.
    #[must_use]
    pub(crate) fn new(mesh: &Mesh, view: &View, paints: &Paints, px: f64, options: &LineOptions) -> Self {
        let mut textures = Self::default();
        let has_artist = options.enabled && options.kinds.contains(&LineKind::Artist);
        let smooth = if has_artist { options.artist_smooth / DEFAULT_SMOOTHING_PX } else { 1.0 };
        let sight = TextureContext { mesh, view, px, smooth, crease_deg: options.crease_deg };
        let number = |paint: PaintId| paints.varied.iter().position(|(own, _)| *own == paint);
        let numbers: Vec<Option<usize>> = (0..paints.list.len()).map(|k| number(k.into())).collect();
        let of_face = |face: u32| *numbers.get(mesh.paint(FaceId(face)).index())?;
        let varied: Vec<&VaryingSurface> = paints.varied.iter().map(|(_, varied)| varied).collect();
        let shown = sight.shown(&varied, of_face, &mut textures.warnings);
        for ((paint, _), shown) in paints.varied.iter().zip(shown) {
            textures.of_paint.resize_with(textures.of_paint.len().max(paint.index() + 1), || None);
            textures.of_paint[paint.index()] = shown;
        }
        if has_artist {
            let mut inked: Vec<Option<(ShownPaint, Vec<Oklab>)>> = Vec::new();
            let number = |face: u32| {
                let material = mesh.face_material[face as usize];
                paints.inked.iter().position(|(own, _)| *own == material)
            };
            let varied: Vec<&VaryingSurface> = paints.inked.iter().map(|(_, varied)| varied).collect();
            let shown = sight.shown(&varied, number, &mut textures.warnings);
            for ((material, varied), shown) in paints.inked.iter().zip(shown) {
                inked.resize_with(inked.len().max(material.index() + 1), || None);
                let looks = varied.picture.as_ref().map_or(&[][..], |painted| painted.palette());
                inked[material.index()] = shown.map(|shown| (shown, looks.to_vec()));
            }
            let is_inked = |material: usize| inked.get(material).is_some_and(Option::is_some);
            let look = |paint: &crate::scene::MaterialPaint| {
                (!is_inked(paint.material.index())).then(|| oklab::of(paint.colour))
            };
            let looks = paints.list.iter().map(look).collect();
            let tolerance = options.artist_tolerance as f32;
            textures.artist = Some(ArtistLines { paint_colours: looks, tolerance, inked });
        }
        textures
    }

    /// Warnings about textures that could not be painted.
    pub(crate) fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// Paint at a point of a face.
    #[must_use]
    pub(crate) fn paint(&self, mesh: &Mesh, face: u32, at: DVec3) -> PaintId {
        let shown = self.face_texture(mesh, face);
        let shown = shown.and_then(|shown| shown.paint(mesh.weights(FaceId(face), at)));
        shown.unwrap_or_else(|| mesh.paint(FaceId(face)))
    }

    /// Kind of the line between two paints of one material.
    pub(crate) fn line_kind_between(&self, a: PaintId, b: PaintId) -> LineKind {
        let look = |paint: PaintId| self.artist.as_ref()?.paint_colours.get(paint.index()).copied().flatten();
        self.kind(look(a), look(b))
    }

    /// Kind of the line between two colours of the picture that lines follow on a face.
    pub(crate) fn picture_line_kind_between(&self, mesh: &Mesh, face: u32, [a, b]: [PaintId; 2]) -> LineKind {
        let inked = self.inked(mesh, face);
        let look = |colour: PaintId| inked?.1.get(colour.index()).copied();
        self.kind(look(a), look(b))
    }

    /// Kind of the line between two colours.
    fn kind(&self, a: Option<Oklab>, b: Option<Oklab>) -> LineKind {
        let Some((artist, a, b)) = self.artist.as_ref().zip(a).zip(b).map(|((artist, a), b)| (artist, a, b))
        else {
            return LineKind::Isophote;
        };
        let is_far = distance2(a, b) > artist.tolerance * artist.tolerance;
        if is_far { LineKind::Artist } else { LineKind::Isophote }
    }

    /// Whether artist lines are drawn.
    pub(crate) fn has_artist(&self) -> bool {
        self.artist.is_some()
    }

    /// Whether no face shows varying colours.
    pub(crate) fn is_empty(&self) -> bool {
        self.of_paint.iter().all(Option::is_none)
            && self.artist.as_ref().is_none_or(|artist| artist.inked.iter().all(Option::is_none))
    }

    /// Varying colours of a face; none if it has a single paint.
    pub(crate) fn face_texture(&self, mesh: &Mesh, face: u32) -> Option<TexturedFace<'_>> {
        self.of_paint.get(mesh.paint(FaceId(face)).index())?.as_ref()?.face_texture(mesh, face)
    }

    /// The picture that lines follow on a face. Its colours are paints with the same numbers.
    pub(crate) fn ink_on(&self, mesh: &Mesh, face: u32) -> Option<TexturedFace<'_>> {
        self.inked(mesh, face)?.0.face_texture(mesh, face)
    }

    fn inked(&self, mesh: &Mesh, face: u32) -> Option<&(ShownPaint, Vec<Oklab>)> {
        self.artist.as_ref()?.inked.get(mesh.face_material[face as usize].index())?.as_ref()
    }
}

impl ShownPaint {
    /// Varying colours on a face.
    fn face_texture(&self, mesh: &Mesh, face: u32) -> Option<TexturedFace<'_>> {
        let picture = self.picture.as_ref().and_then(|drawn| {
            let [a, b, c] = mesh.corner_uvs.get(face as usize)?.map(|uv| mesh.uvs.get(uv as usize).copied());
            drawn.on(face, [a?, b?, c?])
        });
        let tints = self.tints.as_ref().zip(mesh.corner_colours.get(face as usize).copied());
        (picture.is_some() || tints.is_some()).then_some(TexturedFace {
            paints: &self.paints,
            picture,
            tints,
        })
    }
}

/// How pictures are evaluated.
struct TextureContext<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    px: f64,
    /// Coarseness of the drawn detail, relative to visible detail.
    smooth: f64,
    /// Surfaces continue across edges that turn by less than this.
    crease_deg: f64,
}

impl TextureContext<'_> {
    /// Reduces the given textures for the view. `number` returns the index of the texture that a face shows.
    /// None where a picture has too much detail.
    fn shown(
        &self,
        varied: &[&VaryingSurface],
        number: impl Fn(u32) -> Option<usize> + Sync,
        warnings: &mut Vec<String>,
    ) -> Vec<Option<ShownPaint>> {
        if varied.is_empty() {
            return Vec::new();
        }
        let texels: Vec<_> =
            varied.iter().map(|own| own.picture.as_ref().map(|painted| *painted.texels())).collect();
        let Self { mesh, view, px, .. } = *self;
        let seen = PictureView { mesh, view, px, number, texels: &texels };
        let scales = seen.scales();
        let shown: Vec<Option<ShownPaint>> = varied
            .par_iter()
            .zip(scales)
            .enumerate()
            .map(|(picture, (varied, scale))| {
                let (tints, paints) = (varied.tints.clone(), varied.paints().clone());
                let Some(painted) = &varied.picture else {
                    return Some(ShownPaint { picture: None, tints, paints });
                };
                let densities = || seen.densities(picture, self.crease_deg);
                let drawn = PictureLevels::new(painted, &scale, self.smooth, densities)?;
                Some(ShownPaint { picture: Some(drawn), tints, paints })
            })
            .collect();
        for _ in shown.iter().filter(|shown| shown.is_none()) {
            warnings.push("a texture has too much detail, and counts as its mean colour".to_owned());
        }
        shown
    }
}
