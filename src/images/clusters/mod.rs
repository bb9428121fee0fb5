//! Clusters of textured facets that are painted as one image each, from back to front.
//!
//! A facet is a piece of a visible triangle on which one affine map of the texture is accurate. Clusters
//! keep the number of image elements in the drawing small.
//!
//! 1. A cluster grows from a large facet over its neighbours while one least-squares affine map, or one
//!    colour, fits all of them.
//! 2. A pixel buffer gives the pairs of clusters that cover each other; a topological sort gives the painting
//!    order.
//! 3. Clusters that cover each other cyclically are split and sorted again.
//! 4. Each cluster gets an outline, widened slightly so that no background shines through.
//!
//! Files, in reading order: [`affine_fit`] the affine map; [`facet_cluster`] step 1; [`cluster_order`] step
//! 2; [`cluster_arrangement`] steps 1 to 3; [`cluster_outline`] step 4.

pub(crate) mod affine_fit;
pub(crate) mod cluster_arrangement;
mod cluster_order;
pub(crate) mod cluster_outline;
pub(crate) mod facet_cluster;
