//! The sheet of paper: picture and grain behind the model, and tooth over the ink.
//!
//! Source: Lake et al. 2000, section 3.3 and figure 6: the paper's texture lies behind the model and shows
//! through the ink.
//! 1. Specks are placed at random, one in each square of a grid on the page ([`grain`]).
//! 2. A picture of paper is tiled over the page; its dark hollows are laid over ink and paint ([`sheet`]).
//!
//! Files, in reading order: [`grain`] specks; [`sheet`] the layers behind and over the drawing.

pub(crate) mod grain;
pub(crate) mod sheet;
