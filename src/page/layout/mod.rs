//! How panels part a page: pure geometry.
//!
//! A layout is written as shares: `/` parts rows, `|` parts columns, and what stands in brackets parts the row or column before
//! it. `30 [30 | 20 | *] / *` is a row of 30 % of the height with three panels, over one panel that takes the rest. A number of
//! degrees behind `/` or `|` leans the gutter: `1 |8° 1`.
//!
//! ```
//! use ligne::kurbo::Rect;
//! use ligne::page::layout::{Grid, Reading, cells};
//!
//! let grid = Grid { frame: Rect::new(0.0, 0.0, 100.0, 100.0), gutter: [4.0, 6.0], reading: Reading::Ltr };
//! let cells = cells("30 [1 | 1] / *", &grid).unwrap();
//! assert_eq!(cells[0].nominal, Rect::new(0.0, 0.0, 48.0, 28.2));
//! assert_eq!(cells[2].nominal, Rect::new(0.0, 34.2, 100.0, 100.0));
//! ```

pub mod grammar;
pub mod polygon;
pub mod split;

pub use grammar::Fault;
pub use polygon::Polygon;
pub use split::{Cell, Grid, Reading, cells};
