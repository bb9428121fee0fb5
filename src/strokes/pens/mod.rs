//! Pens: width, colour and behaviour of lines, and the rules that choose them.
//!
//! 1. `[pen]` gives the default pen ([`pen`]) with its hand-drawn effects ([`hand`]).
//! 2. `[[rule]]` entries change single fields by kind, visibility and name ([`pen_rules`]).
//! 3. Names, colours and units of the scene come in through [`ink_context`].
//!
//! Files, in reading order: [`hand`]; [`pen`]; [`ink_context`]; [`pen_rules`]; [`ink_widths`] the least ink
//! of view edges.

pub mod hand;
pub(crate) mod ink_context;
pub(crate) mod ink_widths;
pub mod pen;
pub mod pen_rules;
