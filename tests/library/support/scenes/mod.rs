//! Solids, scenes and drawings for tests, fixed and random.
//!
//! Reading order:
//!
//! 1. [`solids`], [`round_solids`], [`profile_bars`]: single solids in closed form.
//! 2. [`random_dice`]: the random generator. [`random_scenes`], [`hard_scenes`]: random scenes and cameras.
//! 3. [`moving_boxes`], [`pointer_board`]: animated scenes, built in memory and as a glTF file.
//! 4. [`sheet_models`]: model files for technical sheets. [`random_svg`]: random SVG drawings.

pub mod hard_scenes;
pub mod moving_boxes;
pub mod pointer_board;
pub mod profile_bars;
pub mod random_dice;
pub mod random_scenes;
pub mod random_svg;
pub mod round_solids;
pub mod sheet_models;
pub mod solids;
