//! Solids, scenes and drawings that tests make, fixed and random.

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
