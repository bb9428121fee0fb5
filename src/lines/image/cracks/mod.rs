//! Cracks: lines that run between pixels, from corner to corner.
//!
//! 1. The jump of depth and normals between each pair of neighbouring edge pixels is measured.
//! 2. A crack belongs to a line if its jump is a local maximum (non-maximum suppression) and no echo of a
//!    larger one.
//! 3. Small gaps are closed and short spurs removed.
//! 4. Cracks are joined into paths that pass straight through junctions.
//! 5. A path becomes the shortest curve between the pixel centres on its two sides (funnel algorithm).
//!
//! Files, in reading order: [`pixel_jumps`]; [`jump_tiles`] jumps stored in tiles; [`crest_test`];
//! [`crack_lattice`]; [`crack_repair`]; [`crack_paths`]; [`crack_sides`] part and material on both sides;
//! [`taut_path`].

pub(crate) mod crack_lattice;
pub(crate) mod crack_paths;
pub(crate) mod crack_repair;
pub(crate) mod crack_sides;
pub(crate) mod crest_test;
pub(crate) mod jump_tiles;
pub(crate) mod pixel_jumps;
pub(crate) mod taut_path;
