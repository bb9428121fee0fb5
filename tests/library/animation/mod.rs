//! Tests of animation: clips, poses, frames, films and motion lines.

mod animation_pointers;
mod folded_creases;
mod frames_and_films;
mod motion_lines;
mod motion_styles;
mod poses;
