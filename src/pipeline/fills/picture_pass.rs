//! Textures drawn as pictures over the regions that show them.

use std::sync::Arc;

use kurbo::BezPath;

use super::surface_fills::SurfaceFills;
use crate::drawing::{Layer, Length, Mark, Page, Paint, Provenance};
use crate::images::facets::face_crossings::FaceCrossings;
use crate::images::facets::visible_faces::VisibleFaces;
use crate::images::tone_veils::ToneVeils;
use crate::images::{ImageContext, pictures};
use crate::lines::FeatureLines;
use crate::mesh::{Mesh, PartId};
use crate::regions::Regions;
use crate::regions::paint::region_paint::PaintContext;
use crate::regions::paint::region_unions::unions;
use crate::scene::textures::EmbeddedTexture;
use crate::scene::{Camera, Paints};
use crate::style::Style;
use crate::view::raster::PixelGrid;

/// Adds the pictures of materials to painted regions, and the translucent fills that give them tones. `mesh`
/// is that of the surface, where panes hide nothing.
pub(crate) fn add(
    fills: &SurfaceFills,
    (mesh, lines): (&Mesh, &FeatureLines),
    (paints, regions): (&Paints, &Regions),
    (page, camera, style): (&Page, &Camera, &Style),
    layers: &mut [Layer],
    warnings: &mut Vec<String>,
) {
    let Some(over) = layers.last_mut().filter(|_| !paints.images.is_empty()) else { return };
    let (view, context) = (fills.lit().view, fills.paint_context(page, camera));
    let screen = &PixelGrid::new(mesh, view);
    let in_front = &VisibleFaces::new(mesh, screen);
    let px = Length::px(1.0).in_unit(page.unit);
    let (crossings, samples) = (&FaceCrossings::of(mesh, view, lines), style.textures.samples);
    let stage = ImageContext {
        mesh,
        view,
        screen,
        visible_faces: in_front,
        crossings,
        offset: context.offset,
        px,
        max_pixels_per_px: samples,
    };
    for imaged in &paints.images {
        let Some(shades) = ToneVeils::of(context.shading, &paints.list, imaged) else { continue };
        let Some(pieces) = pictures(&stage, imaged, |picture| shades.tone(picture)) else { continue };
        let painted = PictureRegions { regions, imaged, context: &context };
        let parts: Vec<PartId> = pieces.of_part.iter().map(|(part, _)| *part).collect();
        let outlines = painted.outlines(&parts, |_| true);
        let veils: Vec<Vec<BezPath>> = shades
            .veils
            .iter()
            .map(|(_, tones)| painted.outlines(&parts, |tone| tones.contains(&tone)))
            .collect();
        for (number, ((part, image), path)) in pieces.of_part.into_iter().zip(outlines).enumerate() {
            if path.elements().is_empty() {
                continue;
            }
            let provenance = painted.provenance("picture", part, None);
            over.marks.push(Mark { path, paint: Paint::Image(image), provenance });
            for ((colour, tones), outlines) in shades.veils.iter().zip(&veils) {
                let Some(path) = outlines.get(number).filter(|path| !path.elements().is_empty()) else {
                    continue;
                };
                let provenance = painted.provenance("shade", part, tones.first().copied());
                over.marks.push(Mark { path: path.clone(), paint: Paint::Fill(*colour), provenance });
            }
        }
        warnings.extend(pieces.coarse.map(|(off, lost)| {
            let material = painted.provenance("", PartId(0), None).material;
            let of = material.map_or_else(String::new, |name| format!(" of material '{name}'"));
            let lost =
                if lost > 0 { format!(", and {lost} pieces of it its mean colour") } else { String::new() };
            format!("the picture{of} has too many pieces: it is drawn within {off} px of its place{lost}")
        }));
    }
}

/// Regions that show a picture.
struct PictureRegions<'a> {
    regions: &'a Regions,
    imaged: &'a EmbeddedTexture,
    context: &'a PaintContext<'a>,
}

impl PictureRegions<'_> {
    /// For each of these parts (ascending), the outline of the regions that show the picture in the selected
    /// tones.
    fn outlines(&self, parts: &[PartId], of_tone: impl Fn(u16) -> bool) -> Vec<BezPath> {
        let class = |number: u32| {
            let look = self.regions.regions.get(number as usize)?.label;
            let shown = look.paint == self.imaged.paint && of_tone(look.tone);
            parts.binary_search(&look.part).ok().filter(|_| shown).map(|part| part as u32)
        };
        unions(self.regions, parts.len(), class, self.context.offset)
    }

    fn provenance(&self, class: &'static str, part: PartId, tone: Option<u16>) -> Provenance {
        let name = |name: &Arc<str>| (!name.is_empty()).then(|| Arc::clone(name));
        Provenance {
            classes: vec![class],
            tone,
            part: self.context.parts.get(part.index()).and_then(name),
            material: self.context.materials.get(self.material()).and_then(name),
            ..Provenance::default()
        }
    }

    /// Index of the material.
    fn material(&self) -> usize {
        self.imaged.material.index()
    }
}
