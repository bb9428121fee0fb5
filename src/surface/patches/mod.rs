//! Classification of components, and the borders between flat, faceted and curved patches.
//!
//! 1. Flat edges join faces to planar regions.
//! 2. Each connected component is classified as machined, round or faceted, from planar area, edge angles
//!    and file normals. File normals that do not fit the surface are rejected.
//! 3. On machined components, patches with enough total curvature (Meyer et al. 2002) count as round.
//! 4. Borders of planar regions and of narrow strips separate patches.
//! 5. The creases of each component are chosen by its class (`patch_layout`), with the rules of
//!    `surface::creases`.
//!
//! Files, in reading order: [`patch_layout`] (all steps), [`planar_regions`] (step 1), [`component_classes`]
//! (step 2), [`component_stats`] (its input), [`surface_class`] (its result), [`normal_validation`],
//! [`sliver_bends`], [`curved_patches`] (step 3).

mod component_classes;
mod component_stats;
mod curved_patches;
pub(crate) mod normal_validation;
pub(crate) mod patch_layout;
pub(crate) mod planar_regions;
mod sliver_bends;
pub(crate) mod surface_class;
