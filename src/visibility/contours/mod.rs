//! Visibility of smooth contours, taken from the contour of the mesh.
//!
//! 1. The visibility of the mesh contour is exact. The smooth contour runs near it.
//! 2. The images of smooth contours are chained and measured by arc length; stretches between two cusps are
//!    marked.
//! 3. Each visible or hidden part of the mesh contour is matched to the nearest suitable position of a smooth
//!    contour.
//! 4. A smooth contour is visible where a matched part is. Unmatched visible parts are drawn themselves,
//!    except small folds and spurs.
//!
//! Files, in reading order: [`contour_chains`] step 2; [`contour_matching`] step 3; [`contour_spurs`] short
//! detours of the mesh contour; [`contour_visibility`] step 4; [`thin_folds`] contours of folds thinner than
//! a pen.

mod contour_chains;
pub(crate) mod contour_matching;
mod contour_spurs;
pub(crate) mod contour_visibility;
pub(crate) mod thin_folds;
