//! Visibility of all segments, tile by tile.
//!
//! 1. Every segment is split at tile borders. Parts behind the occlusion buffer are hidden.
//! 2. In each tile, every segment part is compared with every triangle in front of it. Crowded tiles are
//!    subdivided.
//! 3. The results of all tiles are gathered and joined per segment.
//! 4. Each segment is cut where its invisibility changes, and where background begins or ends next to it.
//!
//! Files, in reading order: [`segment_visibility`] the whole computation; [`tile_segments`] step 1;
//! [`tile_comparison`], [`segment_comparison`] step 2; [`segment_pieces`] step 4.

mod segment_comparison;
pub(crate) mod segment_pieces;
pub(crate) mod segment_visibility;
mod tile_comparison;
mod tile_segments;
