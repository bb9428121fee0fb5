//! [`PosedRenderer`]: prepares an animated scene once at rest, so that each of its poses is prepared faster.
//!
//! Input: a scene in its stored pose, and the same scene in other poses. Output: a [`Renderer`] scene per
//! pose, ready to draw.
//!
//! - Computed once at rest: welded vertices and edges, creases, rounded areas, and paints with their
//!   textures. Paints are computed again if a pose changes materials.
//! - Computed for each pose: positions, normals, creases at new folds, lines and visibility.

use std::sync::Arc;

use super::prepare_mesh::{PreparedMesh, paints_of};
use crate::mesh::VertexSources;
use crate::mesh::components::solid_parts::solid_parts;
use crate::pipeline::Renderer;
use crate::pipeline::cache::shadow_cache::ShadowCache;
use crate::pipeline::cache::view_cache::ViewCache;
use crate::pipeline::fills::glass_pass;
use crate::pipeline::fills::surface_fills::ToneInputs;
use crate::pipeline::fills::surface_requirements;
use crate::pipeline::progress::ProgressFunction;
use crate::pipeline::rest::chain_anchors::Anchors;
use crate::pipeline::thread_pool::run_on_pool;
use crate::scene::textures::cutouts::CutScene;
use crate::scene::{Part, Scene};
use crate::style::Style;
use crate::surface::Patches;

/// Scene prepared at rest, which prepares its poses for drawing. Strokes keep their identity from pose to
/// pose.
#[derive(Debug)]
pub(crate) struct PosedRenderer<'a> {
    scene: &'a Scene,
    style: &'a Style,
    /// The scene in its stored pose.
    still: Renderer<'a>,
    patches: Option<Patches>,
    /// Which vertices of the scene were welded to each mesh vertex. `None` if they cannot be tracked; then
    /// every pose is prepared from the start.
    sources: Option<VertexSources>,
}

impl<'a> PosedRenderer<'a> {
    /// Prepares a scene in its stored pose.
    #[must_use]
    pub(crate) fn new(scene: &'a Scene, style: &'a Style) -> Self {
        let made = Self::without_anchors(scene, style);
        Self { still: made.still.anchored(scene, scene), ..made }
    }

    fn without_anchors(scene: &'a Scene, style: &'a Style) -> Self {
        let (still, patches) =
            run_on_pool(|| Renderer::from_mesh(PreparedMesh::of(scene, style), style, None));
        let sources = VertexSources::of(&still.surface.mesh, &still.scene.to_soup());
        Self { scene, style, still, patches, sources }
    }

    /// The scene in its stored pose.
    #[must_use]
    pub(crate) fn still(&self) -> &Renderer<'a> {
        &self.still
    }

    /// Prepares a pose so that edges near the crease angle do not flicker: they follow their state in earlier
    /// poses.
    ///
    /// `before` yields the earlier poses, latest first. It is advanced only until all such edges are decided.
    #[must_use]
    pub(crate) fn posed_after<'b, I: Iterator<Item = Scene>>(
        &self,
        posed: &'b Scene,
        before: impl Fn() -> I,
    ) -> Renderer<'b>
    where
        'a: 'b,
    {
        let prepared = self
            .following(posed, self.style, before())
            .or_else(|| {
                let rest = rest_without_hidden_parts(self.scene, posed)?;
                PosedRenderer::without_anchors(&rest, self.style).following(posed, self.style, before())
            })
            .unwrap_or_else(|| Renderer::new(posed, self.style));
        prepared.anchored(posed, self.scene)
    }

    /// Prepares a pose by moving the vertices of the rest mesh; `None` if that is not possible.
    fn following<'b>(
        &self,
        posed: &'b Scene,
        style: &'b Style,
        before: impl Iterator<Item = Scene>,
    ) -> Option<Renderer<'b>> {
        let names = |scene: &Scene| scene.parts.iter().map(|part| part.name.clone()).collect::<Vec<_>>();
        if names(self.scene) != names(posed) {
            return None;
        }
        let drawn_scene = glass_pass::without_absent_materials(posed, style);
        let CutScene { scene, origins, warnings } = glass_pass::cut_textures(posed, &drawn_scene);
        let soup = scene.to_soup();
        let mut paints = self.still.paints.clone();
        if posed.materials != self.scene.materials {
            // Another opacity can remove or cut other triangles, even if their number stays the same.
            let rest = self.still.scene.to_soup();
            if rest.triangles != soup.triangles || rest.triangle_material != soup.triangle_material {
                return None;
            }
            if let Some(still) = &paints {
                let mut posed_paints = paints_of(&drawn_scene, style)?;
                posed_paints.carry(&origins);
                paints = Some(Arc::new(posed_paints)).filter(|own| own.has_same_layout(still));
                paints.as_ref()?;
            }
        }
        let (still, sources) = (&self.still.surface, self.sources.as_ref()?);
        let mesh = still.mesh.posed(sources, &soup)?;
        let before = before.map_while(|scene| {
            let previous_soup =
                glass_pass::cut_textures(&scene, &glass_pass::without_absent_materials(&scene, style))
                    .scene
                    .to_soup();
            still.mesh.posed(sources, &previous_soup)
        });
        let line_requirements = surface_requirements::required_lines(style);
        let surface = still.posed(mesh, self.patches.as_ref(), style.lines.crease_deg, before);
        let paintable = paints.as_deref().filter(|_| surface_requirements::uses_paints(style));
        let paintable = paintable.map(|paints| ToneInputs::new(&surface, paints, solid_parts(&surface.mesh)));
        let (search, shadows) = (ViewCache::default(), ShadowCache::default());
        let counts = self.still.counts;
        Some(Renderer {
            scene,
            warnings,
            style,
            line_options: line_requirements,
            paints,
            surface,
            counts,
            paintable,
            search,
            shadows,
            anchors: None,
            progress: ProgressFunction::default(),
        })
    }
}

/// The scene at rest without the parts that a pose hides. `None` if the pose hides none or belongs to another
/// scene.
fn rest_without_hidden_parts(scene: &Scene, posed: &Scene) -> Option<Scene> {
    let mut wanted = posed.parts.iter().peekable();
    let mut parts = scene.parts.clone();
    parts.retain(|part| {
        // Parts with equal name and geometry are interchangeable.
        let is_next = |next: &&Part| next.name == part.name && next.geometry == part.geometry;
        wanted.next_if(is_next).is_some()
    });
    let all_found = wanted.peek().is_none();
    (all_found && !parts.is_empty() && parts.len() < scene.parts.len())
        .then(|| Scene { parts, ..scene.clone() })
}

impl Renderer<'_> {
    /// Adds anchors: positions on the model at rest. Stroke ids and random effects are derived from them, so
    /// they stay the same while the model moves.
    ///
    /// `posed` is the scene of this preparation, and `rest` the same scene at rest.
    fn anchored(self, posed: &Scene, rest: &Scene) -> Self {
        Self { anchors: Some(Anchors::new(posed, rest)), ..self }
    }
}
