//! Letters: words shaped with fonts, broken into lines, and set as marks of a drawing.
//!
//! ```
//! use ligne::text::{Block, Font, Setting};
//!
//! let setting = Setting::new(Font::named("comic")?).with_em(4.0).upper_case();
//! let block = Block::balanced("Nothing to see here, move along!", &setting, 30.0)?;
//! assert!(block.lines.len() > 1 && block.width <= 30.0);
//! let marks = block.marks(ligne::kurbo::Point::new(10.0, 10.0), ligne::math::colour::Colour::BLACK);
//! assert_eq!(marks[0].provenance.text.as_ref().unwrap().words.as_ref(), block.lines[0].words);
//! # Ok::<(), ligne::Error>(())
//! ```

pub mod block;
mod breaks;
mod chain;
mod direction;
pub mod font;
mod lines;
mod pieces;
pub mod setting;
mod shaping;
mod source;

pub use block::{Block, Line};
pub use chain::Fallback;
pub use font::Font;
pub use setting::{Align, Setting, Size};
