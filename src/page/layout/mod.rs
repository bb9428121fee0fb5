//! Divides a comic page into panels. Input: a layout text and the page frame. Output: panel rectangles or
//! polygons, in the units of the frame.
//!
//! A layout is written as shares: `/` separates rows, `|` separates columns, and brackets divide the row or
//! column before them. `30 [30 | 20 | *] / *` is a row of 30 % of the height with three panels, over one
//! panel that takes the rest. A number of degrees after `/` or `|` slants the gutter: `1 |8° 1`.
//!
//! Files, in reading order: [`grammar`], the parser; [`panel_cells`], the panels on the page; [`polygon`],
//! convex polygons.

pub(crate) mod grammar;
pub(crate) mod panel_cells;
pub(crate) mod polygon;

pub(crate) use panel_cells::{LayoutGrid, Reading, cells};
pub(crate) use polygon::ConvexPolygon;

#[cfg(test)]
mod tests {
    use kurbo::Rect;

    use super::*;

    #[test]
    fn rows_and_columns_share_the_frame() {
        let frame = Rect::new(0.0, 0.0, 100.0, 100.0);
        let grid = LayoutGrid { frame, gutter: [4.0, 6.0], reading: Reading::Ltr };
        let cells = cells("30 [1 | 1] / *", &grid).unwrap();
        assert_eq!(cells[0].nominal, Rect::new(0.0, 0.0, 48.0, 28.2));
        assert_eq!(cells[2].nominal, Rect::new(0.0, 34.2, 100.0, 100.0));
    }
}
