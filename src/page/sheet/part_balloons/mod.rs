//! Balloons of the parts list: where a leader starts on the drawing, and which balloon each item gets.
//!
//! 1. `balloon_anchors` finds a point well inside the visible area of each item, from a face-id buffer.
//! 2. [`leader_assignment`] assigns items to balloon slots around the view so that no two leaders cross:
//!    exchanges that shorten the leaders, then tabu search (Glover 1989) for the conflicts that remain.
//!
//! The rings of slots and the drawing are in `annotations::balloon_rings`.

pub(crate) mod balloon_anchors;
pub(crate) mod leader_assignment;
