//! Hatching, half-tone dots, patterns and paper, measured as covered area.

mod halftone;
mod hatching_and_fills;
mod hatching_tone;
mod paper;
mod patterns;
