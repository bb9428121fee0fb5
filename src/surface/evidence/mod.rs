//! Creases and curved surfaces by evidence: the normals of the file where they say something, one rule for
//! creases and the shape of each patch elsewhere. The option `lines.surfaces` selects it.
//!
//! 1. Where the normals of the file say something, those of flats are parted from bevels
//!    ([`bevel_normals`](crate::surface::normals::bevel_normals)). Edges are split or soft by them.
//! 2. Creases are split edges, and chains and single edges that stand out from the noise around them.
//! 3. Patches between creases and other borders are curved if their normals vary, unless they are too coarse.
//!
//! Files, in reading order: [`evidence_layout`] (all steps), [`normal_evidence`] (step 1), [`curved_faces`] and
//! [`smooth_patches`] (step 3).

mod curved_faces;
pub(crate) mod evidence_layout;
mod normal_evidence;
mod smooth_patches;
