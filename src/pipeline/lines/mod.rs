//! The lines of a view: extra lines, chains, and the samples of surfaces next to chains.
//!
//! 1. Joints between parts of one material are removed ([`part_joints`]); lines found in the image are added
//!    ([`image_line_pass`]).
//! 2. Visible and hidden view edges are linked into chains ([`view_chains`]).
//! 3. Chains sample depth, light and sides ([`chain_samples`]) and colours next to them ([`chain_colours`]).
//! 4. Moving bodies leave motion lines ([`motion_line_pass`]).
//!
//! Files, in reading order: [`part_joints`]; [`image_line_pass`]; [`view_chains`]; [`chain_samples`];
//! [`chain_colours`]; [`motion_line_pass`].

pub(crate) mod chain_colours;
pub(crate) mod chain_samples;
pub(crate) mod image_line_pass;
pub(crate) mod motion_line_pass;
pub(crate) mod part_joints;
pub(crate) mod view_chains;
