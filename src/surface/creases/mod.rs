//! Rules that find creased edges. `patches::patch_layout` decides which rule applies to which component.
//!
//! 1. Edges that turn by more than a low threshold are joined to chains, straight on through junctions.
//! 2. A chain with an edge above the high threshold is a crease if it stands out from the noise around it.
//!    Source: Canny 1986 (hysteresis thresholding); Hubeli and Gross 2001 (feature lines on meshes).
//! 3. On machined parts, creases made only by slivers are removed.
//! 4. `low_angle` adds creases below the angle threshold: chamfers, and the centre lines of narrow fillets.
//! 5. Edges folded by a pose become creases with hysteresis in time.
//!
//! Files, in reading order: [`hard_edges`] (step 2), [`crease_chains`] (step 1), [`edge_noise`] (robust
//! noise estimate), [`calm_edges`] (single edges), [`sliver_creases`] (step 3),
//! [`pose_creases`] (step 5). Folder: [`low_angle`].

mod calm_edges;
mod crease_chains;
mod edge_noise;
pub(crate) mod hard_edges;
pub(crate) mod low_angle;
pub(crate) mod pose_creases;
mod sliver_creases;
