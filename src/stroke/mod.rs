//! Strokes: chains with their ink.
