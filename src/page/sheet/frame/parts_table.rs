//! [`PartsTable`]: the parts list as a table above the title block (ISO 7573).
//!
//! Layouts with one to several columns of rows are tried, each column with all headings. The first one lower
//! than 30 % of the sheet is taken, otherwise the one with the smallest area.
//!
//! - A column is as wide as the title block, half of it, or a third of it if all texts fit. More columns
//!   continue to the left.
//! - A text that is too long for its cell gets smaller letters, then several lines, and its row grows.
//! - Rows start at the bottom, above the title block.

use kurbo::{Point, Rect};

use crate::error::Error;
use crate::page::sheet::canvas::sheet_canvas::{SheetCanvas, THICK_LINE_MM, THIN_LINE_MM, WordAnchor};
use crate::page::sheet::parts_list::parts_list_items::PartsListItem;
use crate::page::tolerances;
use crate::text::Font;

/// Height of a row with one line, and of each further line, mm.
const ROW_HEIGHT_MM: f64 = 6.0;
const LINE_PITCH_MM: f64 = 2.9;

/// Letter heights in the table, preferred first, mm.
const LETTER_HEIGHTS_MM: [f64; 4] = [2.5, 2.2, 2.0, 1.8];

/// Letter height of headings, and padding at both sides of a cell, mm.
const HEADING_HEIGHT_MM: f64 = 1.8;
const SIDE_PADDING_MM: f64 = 1.0;

/// Minimum width of the columns for numbers and counts, mm.
const MIN_NUMBER_WIDTH_MM: f64 = 9.0;

/// Minimum width of a column with a heading, mm.
const MIN_COLUMN_WIDTH_MM: f64 = 13.0;

/// Preferred and maximum height of the table, as shares of the sheet's height.
const PREFERRED_HEIGHT_SHARE: f64 = 0.3;
const MAX_HEIGHT_SHARE: f64 = 0.6;

const COLUMN_HEADINGS: [&str; 5] = ["Item", "Qty", "Name", "Material", "Remark"];

/// A row: letter height and lines of each cell, and the height of the row.
struct TableRow {
    cells: [(f64, Vec<String>); 5],
    height: f64,
}

/// A parts table with its place.
pub(crate) struct PartsTable {
    pub place: Rect,
    /// The x coordinates of the cell borders in a column, from the left.
    ends: [f64; 6],
    columns: Vec<Vec<TableRow>>,
}

impl PartsTable {
    /// Sets the table of some items above a title block; `None` without items.
    ///
    /// # Errors
    /// Returns an error if no font has a glyph, or the table does not fit.
    pub(crate) fn new(
        items: &[PartsListItem],
        block: Rect,
        space: Rect,
        font: &Font,
    ) -> Result<Option<Self>, Error> {
        if items.is_empty() {
            return Ok(None);
        }
        let ink = SheetCanvas::new(font, "parts-list");
        let texts: Vec<[String; 5]> = items.iter().map(cell_texts).collect();
        let mut widest = [0.0_f64; 5];
        for (item, texts) in items.iter().zip(&texts) {
            for (widest, text) in widest.iter_mut().zip(texts) {
                let about =
                    |error: Error| error.within(format!("part `{}`, item {}", item.name, item.number));
                *widest = widest.max(ink.width(text, LETTER_HEIGHTS_MM[0]).map_err(about)?);
            }
        }
        let whole = block.width();
        let across = (space.width() / (whole / 2.0)).floor().max(1.0) as usize;
        let mut ways = vec![(1, whole)];
        ways.extend((2..=across).map(|count| (count, whole / 2.0)));
        // Thirds are possible if all texts fit at full size.
        let third = whole / 3.0;
        let natural: f64 =
            widest.iter().skip(2).map(|wide| (wide + 2.0 * SIDE_PADDING_MM).max(MIN_COLUMN_WIDTH_MM)).sum();
        let narrow = natural + 2.0 * MIN_NUMBER_WIDTH_MM <= third
            && widest[0] + 2.0 * SIDE_PADDING_MM <= MIN_NUMBER_WIDTH_MM
            && widest[1] + 2.0 * SIDE_PADDING_MM <= MIN_NUMBER_WIDTH_MM;
        if narrow {
            ways.insert(2.min(ways.len()), (3, third));
        }
        let mut best: Option<Self> = None;
        let mut lowest = f64::INFINITY;
        for (count, width) in ways {
            let ends = cell_ends(width, &widest, width < whole / 2.0);
            let rows =
                texts.iter().map(|texts| fit_row(texts, &ends, &ink)).collect::<Result<Vec<_>, _>>()?;
            let columns = split_into_columns(rows, count);
            let high =
                |column: &Vec<TableRow>| column.iter().map(|row| row.height).sum::<f64>() + ROW_HEIGHT_MM;
            let height = columns.iter().map(high).fold(0.0, f64::max);
            lowest = lowest.min(height);
            let wide = width * columns.len() as f64;
            let place = Rect::new(block.x1 - wide, block.y0 - height, block.x1, block.y0);
            let own = Self { place, ends, columns };
            if height <= PREFERRED_HEIGHT_SHARE * space.height() {
                return Ok(Some(own));
            }
            let is_smaller =
                |best: &Self| own.place.area() < best.place.area() - tolerances::MIN_AREA_GAIN_MM2;
            let is_better = best.as_ref().is_none_or(is_smaller);
            if height <= MAX_HEIGHT_SHARE * space.height() && place.y0 > space.y0 && is_better {
                best = Some(own);
            }
        }
        best.map(Some).ok_or_else(|| {
            let count = items.len();
            let most = MAX_HEIGHT_SHARE * space.height();
            Error::new(format!(
                "a parts list of {count} items with all its columns is {lowest:.0} mm high and does not fit on this sheet, where it may be {most:.0} mm high"
            ))
            .remedy("choose a larger size, hide parts with `hide`, or leave parts_list out")
        })
    }

    /// Draws the table.
    ///
    /// # Errors
    /// Returns an error if no font has a glyph.
    pub(crate) fn draw(&self, ink: &mut SheetCanvas) -> Result<(), Error> {
        let width = self.ends[5];
        for (k, column) in self.columns.iter().enumerate() {
            let left = self.place.x0 + k as f64 * width;
            let heading = COLUMN_HEADINGS.map(|heading| (HEADING_HEIGHT_MM, vec![heading.to_owned()]));
            let mut bottom = self.place.y1;
            for row in std::iter::once(&TableRow { cells: heading, height: ROW_HEIGHT_MM }).chain(column) {
                let top = bottom - row.height;
                for (n, (high, lines)) in row.cells.iter().enumerate() {
                    let cell = Rect::new(left + self.ends[n], top, left + self.ends[n + 1], bottom);
                    if cell.width() <= 0.0 {
                        continue;
                    }
                    ink.rect(cell, THIN_LINE_MM);
                    let more = (lines.len().max(1) - 1) as f64 * LINE_PITCH_MM;
                    let first = cell.center().y + (high - more) / 2.0;
                    for (k, line) in lines.iter().enumerate() {
                        let at = Point::new(cell.x0 + SIDE_PADDING_MM, first + k as f64 * LINE_PITCH_MM);
                        ink.word(line, at, *high, WordAnchor::Left, 0.0)?;
                    }
                }
                bottom = top;
            }
        }
        ink.rect(self.place, THICK_LINE_MM);
        Ok(())
    }
}

fn cell_texts(item: &PartsListItem) -> [String; 5] {
    let count = item.count.to_string();
    [item.number.clone(), count, item.name.clone(), item.material.clone(), item.remark.clone()]
}

/// Cell borders of a column with a given width.
fn cell_ends(width: f64, widest: &[f64; 5], natural: bool) -> [f64; 6] {
    let own = |k: usize| widest[k] + 2.0 * SIDE_PADDING_MM;
    let [item, count] = [0, 1].map(|k| MIN_NUMBER_WIDTH_MM.max(own(k)).min(0.2 * width));
    let is_remarked = widest[4] > 0.0;
    let [material, remark] = if natural {
        // The name column takes the rest of the width.
        [own(3).max(MIN_COLUMN_WIDTH_MM), if is_remarked { own(4).max(MIN_COLUMN_WIDTH_MM) } else { 0.0 }]
    } else if is_remarked {
        [0.22 * width; 2]
    } else {
        [0.28 * width, 0.0]
    };
    [0.0, item, item + count, width - material - remark, width - remark, width]
}

/// Sets the texts of a row into its cells.
fn fit_row(texts: &[String; 5], ends: &[f64; 6], ink: &SheetCanvas) -> Result<TableRow, Error> {
    let mut height = ROW_HEIGHT_MM;
    let mut cells = [const { (0.0, Vec::new()) }; 5];
    for (k, cell) in cells.iter_mut().enumerate() {
        let width = ends[k + 1] - ends[k] - 2.0 * SIDE_PADDING_MM;
        if width > 0.0 {
            *cell = ink.fitted(&texts[k], &LETTER_HEIGHTS_MM, width, |_, lines| lines == 1)?;
            height = height.max(ROW_HEIGHT_MM + (cell.1.len().max(1) - 1) as f64 * LINE_PITCH_MM);
        }
    }
    Ok(TableRow { cells, height })
}

/// Splits rows into at most `count` columns, with the tallest column as low as possible.
fn split_into_columns(rows: Vec<TableRow>, count: usize) -> Vec<Vec<TableRow>> {
    let total: f64 = rows.iter().map(|row| row.height).sum();
    let highest = rows.iter().map(|row| row.height).fold(0.0, f64::max);
    let columns = |most: f64| {
        let mut ends = Vec::new();
        let mut high = 0.0;
        for (k, row) in rows.iter().enumerate() {
            if high + row.height > most + tolerances::LENGTH_ROUNDING_MM && high > 0.0 {
                ends.push(k);
                high = 0.0;
            }
            high += row.height;
        }
        ends.push(rows.len());
        ends
    };
    let mut most = (total / count as f64).max(highest);
    while columns(most).len() > count {
        most += LINE_PITCH_MM / 4.0;
    }
    let ends = columns(most);
    let mut rows = rows.into_iter();
    let mut begin = 0;
    let take = |end: usize| {
        let own = rows.by_ref().take(end - begin).collect();
        begin = end;
        own
    };
    ends.into_iter().map(take).collect()
}
