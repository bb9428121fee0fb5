//! Pens: width, colour and behaviour of lines, and the rules that choose them.
//!
//! 1. `[pen]` gives the default pen ([`pen`]) with its hand-drawn effects ([`hand`]).
//! 2. `[[rule]]` entries change single fields by kind, visibility and name ([`pen_rules`]).
//! 3. A function of the program may change the pen once more ([`pen_choice`]).
//! 4. Names, colours and units of the scene come in through [`ink_context`].
//!
//! Files, in reading order: [`hand`]; [`pen`]; [`ink_context`]; [`pen_choice`]; [`pen_rules`]; [`ink_widths`] the least ink
//! of view edges.

pub(crate) mod hand;
pub(crate) mod ink_context;
pub(crate) mod ink_widths;
pub(crate) mod pen;
pub(crate) mod pen_choice;
pub(crate) mod pen_rules;
