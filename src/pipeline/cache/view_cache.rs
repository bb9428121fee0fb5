//! [`ViewCache`]: results that all views of a surface share, built when they pay off.
//!
//! Trees in dual space (see [`EdgeSearch`] and [`ToneTree`]) take time to build and save a little in each later view, so they
//! are built on request only ([`LineOptions::edge_tree`]).
//!
//! Self-intersections of the surface do not depend on the view, so the first view finds them for all. For
//! views that split faces, the intersections of unsplit faces are reused.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use crate::light::ShadingNormals;
use crate::lines::intersections::intersection_lines;
use crate::lines::isophotes::culling::tone_faces;
use crate::lines::{EdgeSearch, HiddenLines, LineKind, LineOptions, RefinedSurface, SharedSearches, Surface};
use crate::mesh::bvh::ToneTree;
use crate::mesh::intersect::cache::intersection_cache::IntersectionCache;
use crate::mesh::intersect::intersection_curves::IntersectionCurves;
use crate::view::View;
use crate::visibility::ViewOcclusionBuffer;

/// Results shared by the views of one surface, built on demand.
#[derive(Debug, Default)]
pub(crate) struct ViewCache {
    views: AtomicU32,
    search: OnceLock<EdgeSearch>,
    tone_tree: OnceLock<ToneTree>,
    /// Whether a view has found the intersections, or is about to.
    is_found: AtomicBool,
    intersections: OnceLock<IntersectionCurves>,
    /// Number of views that split faces.
    finer_views: AtomicU32,
    pairs: OnceLock<IntersectionCache>,
}

impl ViewCache {
    /// The shared results for one more view. The lines are the same with and without them.
    ///
    /// Views may be drawn in parallel. One thread builds a missing result while others go without, so none
    /// waits.
    ///
    /// `normals` are the shading normals, if the surface has tones. With `finds`, this view finds all
    /// intersections if no earlier one has.
    pub(crate) fn share_with_next_view(
        &self,
        surface: &Surface,
        options: &LineOptions,
        normals: Option<&ShadingNormals>,
        finds: bool,
    ) -> SharedSearches<'_> {
        // No other view has this number.
        let view = self.views.fetch_add(1, Ordering::Relaxed);
        if view == 1 && options.edge_tree {
            let _ = self.search.set(EdgeSearch::new(surface));
            let _ = normals.map(|normals| self.tone_tree.set(tone_faces::tree_of(normals)));
        }
        if finds && is_wanted(surface, options) && !self.is_found.swap(true, Ordering::Relaxed) {
            let _ = self.intersections.set(intersection_lines::all_curves(&surface.mesh));
        }
        SharedSearches {
            search: self.search.get(),
            intersections: self.intersections.get(),
            tone_tree: self.tone_tree.get(),
        }
    }

    /// Intersections of the visible surface for one more view, with the view's covers.
    ///
    /// `None` if a shared result exists, if hidden lines are drawn, or if covers do not pay off. The first
    /// view needs them; later views use the shared intersections, unless the surface has too many faces to
    /// find all.
    pub(crate) fn in_sight(
        &self,
        surface: &Surface,
        view: &View,
        finer: Option<&IntersectionCurves>,
        options: &LineOptions,
    ) -> Option<(ViewOcclusionBuffer, IntersectionCurves)> {
        let is_told = is_wanted(surface, options)
            && if surface.refined { finer.is_some() } else { self.views.load(Ordering::Relaxed) > 0 };
        if is_told || options.hidden != HiddenLines::None || !has_intersections(options) {
            return None;
        }
        let covers = ViewOcclusionBuffer::of(&surface.mesh, view)?;
        let out_of_sight = covers.occluded_faces(&surface.mesh, view);
        let curves = intersection_lines::curves_in_sight(&surface.mesh, out_of_sight);
        Some((covers, curves))
    }

    /// The intersections for one more view that splits faces, if the shared search finds them faster.
    pub(crate) fn share_with_finer_view(
        &self,
        surface: &Surface,
        finer: &RefinedSurface,
        options: &LineOptions,
    ) -> Option<IntersectionCurves> {
        if !is_wanted(&finer.surface, options) {
            return None;
        }
        // A surface drawn only once, such as a pose of a film, gains nothing.
        if self.finer_views.fetch_add(1, Ordering::Relaxed) == 1 {
            let _ = self.pairs.set(intersection_lines::search(&surface.mesh));
        }
        self.pairs.get().map(|pairs| intersection_lines::curves_of_finer(pairs, finer))
    }
}

/// Whether all intersections are needed, visible or not.
fn is_wanted(surface: &Surface, options: &LineOptions) -> bool {
    has_intersections(options) && intersection_lines::is_searched_in_full(&surface.mesh, options.hidden)
}

fn has_intersections(options: &LineOptions) -> bool {
    options.enabled && options.kinds.contains(&LineKind::Intersection)
}
