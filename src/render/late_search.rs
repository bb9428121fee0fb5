//! [`LateSearch`]: a search for contours that is made once it pays.
//!
//! The trees in the dual space (see [`EdgeSearch`]) take some time to make and save a little in each view
//! after: not for one drawing, but for all the views of a turning model.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

use crate::lines::{EdgeSearch, Surface};

/// The search is made for this view of a surface. It takes as long as it saves in 40 to 240 views, in the middle
/// of the models of `cargo bench --bench dual_tree` in about 100 (last column). Made when as many views have
/// been drawn without, it never costs more than twice what the better choice does, however many follow.
const MADE_FOR_VIEW: u32 = 100;

/// Asking each of fewer edges than this takes half a millisecond at most.
const FEW_EDGES: usize = 20_000;

/// A search for the lines of the views of one surface, not there at first.
#[derive(Debug, Default)]
pub(super) struct LateSearch {
    views: AtomicU32,
    search: OnceLock<EdgeSearch>,
}

impl LateSearch {
    /// The search for one more view, if there is one. The lines are the same with and without.
    ///
    /// Views may be drawn side by side: one thread makes the search while the others go without, so that none
    /// ever waits.
    pub fn of_next_view(&self, surface: &Surface) -> Option<&EdgeSearch> {
        if surface.mesh.edges.len() < FEW_EDGES {
            return None;
        }
        if self.search.get().is_none() && self.views.fetch_add(1, Ordering::Relaxed) + 1 == MADE_FOR_VIEW {
            // No other view has this number.
            let _ = self.search.set(EdgeSearch::new(surface));
        }
        self.search.get()
    }
}
