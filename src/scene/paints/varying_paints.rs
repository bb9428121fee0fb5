//! Paints of triangles that show pictures or blended vertex colours.

use super::triangle_colour::{MaterialFactor, TriangleColour, light};
use super::triangle_paints::{MaterialPaint, Paints};
use super::varying_surface::VaryingSurface;
use super::vertex_colours::{self, VertexColourPalette};
use crate::colour::srgb::Colour;
use crate::mesh::PaintId;
use crate::scene::textures::palette::palette_clusters::{
    MIN_CHANNEL_DIFFERENCE, channel_difference, cluster_palette, mean,
};
use crate::scene::textures::{self, Texture};
use crate::scene::{Alpha, Scene};

/// Greatest channel of the dark probe colour, used to derive the effect of tones on dark colours. Tones do
/// not distinguish darker colours.
const DARK_PROBE_LEVEL: f64 = 0.3;

/// Maximum channel difference between equal colours that were stored differently.
const MAX_STORAGE_CHANNEL_ERROR: u32 = 8;

impl Paints {
    /// Adds the paints of a material whose triangles show a picture. Triangles of a single palette colour get
    /// its paint; all others are painted point by point.
    pub(crate) fn add_picture(
        &mut self,
        scene: &Scene,
        material: usize,
        triangles: &[TriangleColour],
        texture: Texture,
        count: usize,
        factor: &MaterialFactor,
    ) {
        let shown_colours: Vec<(Colour, bool)> = triangles
            .iter()
            .filter_map(|triangle_colour| {
                Some((triangle_colour.shown?, triangle_colour.spread < MIN_CHANNEL_DIFFERENCE))
            })
            .collect();
        let triangle_ids: Vec<[usize; 2]> =
            triangles.iter().map(|own| [own.geometry, own.triangle]).collect();
        let shown = texture.shown(scene, material, &triangle_ids);
        let swatches = cluster_palette(&shown_colours);
        let mut colours = match &swatches {
            Some(swatches) => swatches.clone(),
            None => texture.representative_colours(&shown, count),
        };
        colours.sort_unstable();
        colours.dedup();
        let tinted: Vec<Colour> = colours.iter().map(|colour| factor.tint(*colour)).collect();
        let paint_of_tint = self.of_colours(material, &tinted);
        let with_paint: Vec<(Colour, PaintId)> = colours
            .iter()
            .zip(&tinted)
            .filter_map(|(base_colour, tinted)| Some((*base_colour, *paint_of_tint.get(tinted)?)))
            .collect();
        let paint_of = |colour: Colour| {
            with_paint
                .iter()
                .min_by_key(|(listed_colour, _)| channel_difference(*listed_colour, colour))
                .map(|(_, paint)| *paint)
        };
        // Areas of mixed colour are divided where the picture changes, not along triangle edges.
        let is_near = |candidate: &TriangleColour| {
            colours.iter().any(|c| {
                candidate.shown.is_some_and(|s| channel_difference(*c, s) <= MAX_STORAGE_CHANNEL_ERROR)
            })
        };
        let is_whole = |own: &TriangleColour| {
            with_paint.len() < 2
                || (swatches.is_some() && own.spread <= MAX_STORAGE_CHANNEL_ERROR && is_near(own))
        };
        if triangles.iter().all(is_whole) {
            for own in triangles {
                if let Some(paint) = own.shown.and_then(paint_of) {
                    self.paint(scene, own, paint);
                }
            }
            return;
        }
        let picture = PaintId::from(self.list.len());
        let mean_colour = texture.mean(&shown);
        self.list.push(MaterialPaint { material: material.into(), colour: factor.tint(mean_colour) });
        for own in triangles {
            let own_paint = own.shown.filter(|_| is_whole(own)).and_then(paint_of);
            self.paint(scene, own, own_paint.unwrap_or(picture));
        }
        let (colours, mut paints): (Vec<Colour>, Vec<PaintId>) = with_paint.into_iter().unzip();
        // The mean colour comes last.
        paints.push(picture);
        let painted = texture.painted(shown, &colours, mean_colour);
        self.varied.push((picture, VaryingSurface::new(Some(painted), None, paints)));
    }

    /// Adds the paints of a material whose vertex colours blend across its triangles. If most triangles have
    /// a single colour, those keep it, and the others are divided among the same colours.
    pub(crate) fn add_tints(
        &mut self,
        scene: &Scene,
        material: usize,
        triangles: &[TriangleColour],
        count: usize,
        factor: &MaterialFactor,
    ) {
        let triangle_colours: Vec<(Colour, bool)> =
            triangles.iter().map(|own| (factor.of(own), own.is_flat())).collect();
        let swatches = cluster_palette(&triangle_colours);
        let opaque = |colour: Colour| Colour { a: factor.base.a, ..colour };
        let mut colours = match &swatches {
            Some(swatches) => swatches.clone(),
            None => {
                let (samples, areas) = vertex_colours::sample_vertex_colours(scene, triangles, factor);
                textures::kmeans_colours(&samples, &areas, count).into_iter().map(opaque).collect()
            }
        };
        colours.sort_unstable();
        colours.dedup();
        if colours.is_empty() {
            return;
        }
        let paint_of_colour = self.of_colours(material, &colours);
        let varied = PaintId::from(self.list.len());
        self.list.push(MaterialPaint { material: material.into(), colour: opaque(mean(&triangle_colours)) });
        for (number, triangle_colour) in triangles.iter().enumerate() {
            let swatch =
                swatches.as_ref().map(|swatches| swatches[number]).filter(|_| triangle_colour.is_flat());
            self.paint(
                scene,
                triangle_colour,
                swatch.and_then(|s| paint_of_colour.get(&s).copied()).unwrap_or(varied),
            );
        }
        let paints = colours.iter().filter_map(|colour| paint_of_colour.get(colour).copied()).collect();
        let tints = VertexColourPalette::new(factor.light(), &colours);
        self.varied.push((varied, VaryingSurface::new(None, Some(tints), paints)));
        self.tinted = true;
    }

    /// Adds the paints of a material whose picture is multiplied by vertex colours. Each of the two is
    /// reduced to a few colours separately.
    pub(crate) fn add_tinted_picture(
        &mut self,
        scene: &Scene,
        material: usize,
        triangles: &[TriangleColour],
        texture: Texture,
        count: usize,
        factor: &MaterialFactor,
    ) {
        let triangle_ids: Vec<[usize; 2]> = triangles
            .iter()
            .filter(|own| own.shown.is_some())
            .map(|own| [own.geometry, own.triangle])
            .collect();
        let shown = texture.shown(scene, material, &triangle_ids);
        let of_picture = texture.representative_colours(&shown, count);
        let plain = MaterialFactor { base: Colour::WHITE, multiplies: false };
        let (samples, areas) = vertex_colours::sample_vertex_colours(scene, triangles, &plain);
        let of_tints = textures::kmeans_colours(&samples, &areas, count);
        // Rows: colours of the picture, its mean colour, and no picture.
        let mean_colour = texture.mean(&shown);
        let rows = of_picture.iter().chain([&mean_colour]).map(|colour| Some(light(*colour))).chain([None]);
        let products: Vec<Colour> = rows
            .flat_map(|row| of_tints.iter().map(move |tint| factor.product([row, Some(light(*tint))])))
            .collect();
        let paint_of_product = self.of_colours(material, &products);
        let varied = PaintId::from(self.list.len());
        let triangle_colours: Vec<(Colour, bool)> =
            triangles.iter().map(|own| (factor.of(own), false)).collect();
        let colour = Colour { a: factor.base.a, ..mean(&triangle_colours) };
        self.list.push(MaterialPaint { material: material.into(), colour });
        triangles.iter().for_each(|own| self.paint(scene, own, varied));
        let paints = products.iter().filter_map(|colour| paint_of_product.get(colour).copied()).collect();
        let painted = texture.painted(shown, &of_picture, mean_colour);
        let tints = VertexColourPalette::new(glam::Vec3::ONE, &of_tints);
        self.varied.push((varied, VaryingSurface::new(Some(painted), Some(tints), paints)));
        self.tinted = true;
    }

    /// Adds the paint of a material whose picture is embedded; its fill colour is the mean of the picture.
    pub(crate) fn add_image(
        &mut self,
        scene: &Scene,
        material: usize,
        triangles: &[TriangleColour],
        texture: Texture,
        factor: &MaterialFactor,
    ) {
        let triangle_ids: Vec<[usize; 2]> =
            triangles.iter().map(|own| [own.geometry, own.triangle]).collect();
        let mean_shown =
            texture.mean_light(&texture.shown(scene, material, &triangle_ids)).unwrap_or(Colour::WHITE);
        let mean = factor.tint(mean_shown);
        // Probes of the same hue, so that the effect of tones on each channel can be derived.
        let greatest = mean.channels().into_iter().fold(0.0, f64::max).max(0.05);
        let bright = |level: f64| {
            let channels = mean.channels().map(|c| c.max(0.1 * greatest) / greatest * level);
            Colour { a: mean.a, ..Colour::from_channels(channels) }
        };
        let [paint, dark, light] = [mean, bright(DARK_PROBE_LEVEL), bright(1.0)].map(|colour| {
            self.list.push(MaterialPaint { material: material.into(), colour });
            PaintId::from(self.list.len() - 1)
        });
        for triangle_colour in triangles {
            self.paint(scene, triangle_colour, paint);
        }
        let weighed = scene.materials.get(material).is_some_and(|own| own.alpha != Alpha::Opaque);
        let base = factor.multiplies.then_some(factor.base);
        self.images.push(texture.imaged((material.into(), paint, [dark, light]), base, weighed));
    }
}
