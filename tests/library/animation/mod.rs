//! Clips, poses, frames and motion lines: each against a plain evaluator of glTF or against rays.

mod animation_pointers;
mod folded_creases;
mod frames_and_films;
mod motion_lines;
mod motion_styles;
mod poses;
