//! Chains of view edges: complete without tidying, and circles where corners lie on one.

mod circles_to_scale;
mod untidied_chains;
