//! [`ViewMap`]: the planar graph of the projected feature lines, cut where visibility changes.
//!
//! 1. `projection` projects the feature segments and clips them to the near plane and the page.
//! 2. `tiles` lays a grid over the image; segments and triangles meet tile by tile.
//! 3. `occlusion` computes the parameter interval of a segment that one triangle hides
//!    (`triangle_occlusion`).
//! 4. `culling` skips most of these comparisons. It changes the time, not the result.
//! 5. `sweep` runs all tiles, counts the intervals along each segment, and cuts it into visible and hidden
//!    pieces.
//! 6. `contours` transfers the visibility of the mesh contour to the smooth contour.
//! 7. `assembly` builds the graph; `overlap` removes lines that coincide in the image.
//!
//! Types: [`graph`]; tolerances: [`tolerances`], [`view_tolerances`]. `queries` reports visibility at points
//! and across gaps.
//!
//! Source: Appel, "The notion of quantitative invisibility and the machine rendering of solids", 1967.

pub(crate) mod assembly;
mod contours;
pub(crate) mod culling;
pub(crate) mod graph;
pub(crate) mod occlusion;
pub(crate) mod overlap;
pub(crate) mod projection;
pub(crate) mod queries;
pub(crate) mod sweep;
pub(crate) mod tiles;
pub(crate) mod tolerances;
pub(crate) mod view_tolerances;

pub(crate) use assembly::map_builder::build;
pub(crate) use assembly::map_builder::{build_through, build_with};
pub(crate) use assembly::motion_lines::{BodyLines, build_motion_lines};
pub(crate) use culling::view_occlusion::ViewOcclusionBuffer;
pub use graph::{ViewEdge, ViewMap, ViewVertex, ViewVertexId, ViewVertexKind};
pub(crate) use queries::gap_occlusion::{GapOcclusion, GapSegment};
pub(crate) use queries::nearest_faces::{FrontFace, front_faces};
