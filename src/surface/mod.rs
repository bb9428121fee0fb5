//! The smooth surface that a mesh approximates: creases, patches, normals, curvature and refined faces.
//!
//! 1. `creases` holds the rules that find creased edges.
//! 2. `patches` classifies each connected component as machined, round or faceted, chooses its creases by
//!    these rules (`patch_layout`), and finds the curved patches. `evidence` decides edge by edge and patch by
//!    patch instead.
//! 3. `normals` assigns a normal to each smooth vertex, split at creases.
//! 4. `curvature` estimates principal curvatures and their derivatives.
//! 5. `refine` subdivides curved faces near the lines of a view.
//! 6. `rims` gives the lines between surfaces their curves.
//! 7. `cylinders` recovers cylinders from flat strips.
//!
//! Folders, in reading order: [`creases`], [`patches`], [`evidence`], [`normals`], [`curvature`], [`refine`],
//! [`rims`], [`cylinders`](mod@cylinders). File: `tolerances`.

pub(crate) mod creases;
pub(crate) mod curvature;
pub(crate) mod cylinders;
pub(crate) mod evidence;
pub(crate) mod normals;
pub(crate) mod patches;
pub(crate) mod refine;
pub(crate) mod rims;
mod tolerances;

pub(crate) use creases::hard_edges::HardEdges;

pub(crate) use curvature::surface_curvature::Curvature;
pub(crate) use cylinders::cylinder::Cylinder;
pub(crate) use cylinders::strip_cylinders::cylinders;
pub(crate) use normals::smooth_normals::SmoothNormals;
pub(crate) use patches::patch_layout::Patches;
pub(crate) use patches::surface_class::MeshSource;
pub(crate) use refine::edge_arc::EdgeArc;
pub(crate) use rims::even_runs::EvenRuns;
