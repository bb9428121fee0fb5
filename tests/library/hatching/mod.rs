//! Tests of hatching, halftone dots, patterns and paper.

mod halftone;
mod hatching_and_fills;
mod hatching_strokes;
mod hatching_tone;
mod paper;
mod patterns;
