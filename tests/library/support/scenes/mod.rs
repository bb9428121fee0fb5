//! Solids, scenes and drawings for tests, fixed and random.
//!
//! Reading order:
//!
//! 1. [`solids`], [`round_solids`], [`profile_bars`]: single solids in closed form.
//! 2. [`random_dice`]: the random generator. [`random_scenes`], [`hard_scenes`]: random scenes and cameras.
//! 3. [`moving_boxes`], [`pointer_board`]: animated scenes, built in memory and as a glTF file.
//! 4. [`sheet_models`]: model files for technical sheets. [`random_svg`]: random SVG drawings.

pub(crate) mod hard_scenes;
pub(crate) mod moving_boxes;
pub(crate) mod pointer_board;
pub(crate) mod profile_bars;
pub(crate) use crate::geometry::dice as random_dice;
pub(crate) mod random_scenes;
pub(crate) mod random_svg;
pub(crate) mod round_solids;
pub(crate) mod sheet_models;
pub(crate) mod solids;
