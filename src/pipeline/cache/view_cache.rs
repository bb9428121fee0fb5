//! [`LateSearch`]: what all views of a surface share, made when it pays.
//!
//! The trees in the dual space (see [`EdgeSearch`]) take some time to make and save a little in each view
//! after: not for one drawing, but for all the views of a turning model. Where the surface passes through itself
//! no view changes, so the first one finds it for all; for views that cut faces into finer ones, what is left whole is known.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use crate::light::Cones;
use crate::lines::intersections::intersection_lines;
use crate::lines::{EdgeSearch, Finer, HiddenLines, Known, LineKind, LineOptions, Surface};
use crate::mesh::intersect::intersection_cache::PairSearch;
use crate::mesh::intersect::intersection_curves::IntersectionCurves;
use crate::view::View;
use crate::visibility::ViewCovers;

/// The search is made for this view of a surface. It takes as long as it saves in 40 to 240 views, in the middle
/// of the models of `cargo bench --bench dual_tree` in about 100 (last column). Made when as many views have
/// been drawn without, it never costs more than twice what the better choice does, however many follow.
const MADE_FOR_VIEW: u32 = 100;

/// Asking each of fewer edges than this takes half a millisecond at most.
const FEW_EDGES: usize = 20_000;

/// What the views of one surface share, not there at first.
#[derive(Debug, Default)]
pub(crate) struct LateSearch {
    views: AtomicU32,
    search: OnceLock<EdgeSearch>,
    /// Whether a view has them found, or is about to.
    is_found: AtomicBool,
    intersections: OnceLock<IntersectionCurves>,
    /// Of views that may cut faces.
    asked_views: AtomicU32,
    cones: OnceLock<Cones>,
    /// Of views that cut faces.
    finer_views: AtomicU32,
    pairs: OnceLock<PairSearch>,
}

impl LateSearch {
    /// What is known for one more view. The lines are the same with and without.
    ///
    /// Views may be drawn side by side: one thread makes what is missing while the others go without, so that none
    /// ever waits.
    ///
    /// With `finds` it finds all intersections if none has before.
    pub fn of_next_view(&self, surface: &Surface, options: &LineOptions, finds: bool) -> Known<'_> {
        // No other view has this number.
        let view = self.views.fetch_add(1, Ordering::Relaxed);
        if view + 1 == MADE_FOR_VIEW && surface.mesh.edges.len() >= FEW_EDGES {
            let _ = self.search.set(EdgeSearch::new(surface));
        }
        if finds && is_wanted(surface, options) && !self.is_found.swap(true, Ordering::Relaxed) {
            let _ = self.intersections.set(intersection_lines::all_curves(&surface.mesh));
        }
        Known { search: self.search.get(), intersections: self.intersections.get() }
    }

    /// Intersections of all that is in sight of one more view, with the covers that say what is: where it has to find them by
    /// itself and draws nothing hidden, and covers save more than they cost. The first view has to, and all that follow are told;
    /// where there are too many faces to find all, each has to.
    pub fn in_sight(
        &self,
        surface: &Surface,
        view: &View,
        finer: Option<&IntersectionCurves>,
        options: &LineOptions,
    ) -> Option<(ViewCovers, IntersectionCurves)> {
        let is_told = is_wanted(surface, options)
            && if surface.refined { finer.is_some() } else { self.views.load(Ordering::Relaxed) > 0 };
        if is_told || options.hidden != HiddenLines::None || !has_intersections(options) {
            return None;
        }
        let covers = ViewCovers::of(&surface.mesh, view)?;
        let out_of_sight = covers.out_of_sight(&surface.mesh, view);
        let curves = intersection_lines::curves_in_sight(&surface.mesh, out_of_sight);
        Some((covers, curves))
    }

    /// What bounds the edges of a surface, for one more view that may cut its faces.
    pub fn cones_of_next_view(&self, surface: &Surface) -> Option<&Cones> {
        let is_asked =
            !surface.refined && surface.mesh.edges.len() >= FEW_EDGES && !surface.smooth.is_empty();
        // A surface that is drawn but once gains nothing by it, and each further view what it took to make.
        if is_asked && self.asked_views.fetch_add(1, Ordering::Relaxed) == 1 {
            let _ = self.cones.set(Cones::new(&surface.mesh, &surface.smooth));
        }
        self.cones.get()
    }

    /// The intersections of one more view that cuts faces of a surface, if they are sooner found so.
    pub fn of_finer_view(
        &self,
        surface: &Surface,
        finer: &Finer,
        options: &LineOptions,
    ) -> Option<IntersectionCurves> {
        if !is_wanted(&finer.surface, options) {
            return None;
        }
        // A surface that is drawn but once, as each pose of a film is, gains nothing by it.
        if self.finer_views.fetch_add(1, Ordering::Relaxed) == 1 {
            let _ = self.pairs.set(intersection_lines::search(&surface.mesh));
        }
        self.pairs.get().map(|pairs| intersection_lines::curves_of_finer(pairs, finer))
    }
}

/// Whether all intersections are sought, seen or not.
fn is_wanted(surface: &Surface, options: &LineOptions) -> bool {
    has_intersections(options) && intersection_lines::is_searched_in_full(&surface.mesh, options.hidden)
}

fn has_intersections(options: &LineOptions) -> bool {
    options.enabled && options.kinds.contains(&LineKind::Intersection)
}
