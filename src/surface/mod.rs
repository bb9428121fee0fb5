//! The smooth surface that a mesh approximates: creases, patches, normals, curvature and refined faces.
//!
//! 1. `creases` holds the rules that find creased edges.
//! 2. `patches` classifies each connected component as machined, round or faceted, chooses its creases by
//!    these rules (`patch_layout`), and finds the curved patches.
//! 3. `normals` assigns a normal to each smooth vertex, split at creases.
//! 4. `curvature` estimates principal curvatures and their derivatives.
//! 5. `refine` subdivides curved faces near the lines of a view.
//! 6. `cylinders` recovers cylinders from flat strips.
//!
//! Folders, in reading order: [`creases`], [`patches`], [`normals`], [`curvature`], [`refine`],
//! [`cylinders`](mod@cylinders). File: `tolerances`.

pub mod creases;
pub mod curvature;
pub mod cylinders;
pub mod normals;
pub mod patches;
pub mod refine;
mod tolerances;

pub use creases::hard_edges::HardEdges;
pub use curvature::principal_curvatures::PrincipalCurvatures;
pub use curvature::surface_curvature::Curvature;
pub use cylinders::cylinder::Cylinder;
pub use cylinders::strip_cylinders::cylinders;
pub use normals::smooth_normals::SmoothNormals;
pub use patches::patch_layout::Patches;
pub use patches::surface_class::MeshSource;
pub use refine::edge_arc::EdgeArc;
