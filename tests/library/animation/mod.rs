//! Tests of animation: clips, poses, frames, films and motion lines.

mod animation_pointers;
mod films;
mod folded_creases;
mod frames;
mod motion_lines;
mod motion_styles;
mod poses;
