//! Text: words shaped with fonts, broken into lines, and set as marks of a drawing.
//!
//! 1. `break_opportunities` finds where lines may break (UAX 14 and hyphenation).
//! 2. `shaped_pieces` shapes the text between two breaks once, with `font_fallback` and `shaping`.
//! 3. `measured_text` computes the width of any line; `line_breaking` chooses the breaks (greedy or by
//!    dynamic programming).
//! 4. [`text_block`] sets the lines and makes marks of them.
//!
//! Start with [`text_block`], [`setting`] and [`font`]; the other files follow in the order above.
//!
//! ```
//! use ligne::text::{Font, Setting, TextBlock};
//!
//! let setting = Setting::new(Font::named("comic")?).with_em(4.0).upper_case();
//! let block = TextBlock::balanced("Nothing to see here, move along!", &setting, 30.0)?;
//! assert!(block.lines.len() > 1 && block.width <= 30.0);
//! let marks = block.marks(ligne::kurbo::Point::new(10.0, 10.0), ligne::Colour::BLACK);
//! assert_eq!(marks[0].provenance.text.as_ref().unwrap().words.as_ref(), block.lines[0].words);
//! # Ok::<(), ligne::Error>(())
//! ```

mod break_opportunities;
pub(crate) mod font;
mod font_fallback;
mod line_breaking;
mod measured_text;
pub(crate) mod setting;
mod shaped_pieces;
mod shaping;
pub(crate) mod text_block;

pub use font::Font;
pub use font_fallback::FontFallback;
pub use setting::{Align, LetterSize, Setting};
pub use text_block::{TextBlock, TextLine};
