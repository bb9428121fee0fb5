//! [`Strip`] and [`Table`]: scales of tones read from pictures or lists of colours.
//!
//! Source: Lake et al. 2000, section 3 (one-dimensional texture); Ishaya, Real-time cartoon rendering, 2003,
//! "Painting" (two-dimensional texture, indexed by two lights). A graphics card looks up a texel at each
//! pixel; here the borders between texels are levels.

use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;

/// Largest number of tones of a scale. Lists in style sheets are no longer either.
pub(crate) const MAX_TONES: usize = 1024;

/// Colours over the light from 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Strip {
    /// Light level where each colour except the first begins.
    pub levels: Vec<f64>,
    /// The colours, one more than there are levels.
    pub colours: Vec<Colour>,
}

/// Colours over the light of a first and of a second light, each from 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Table {
    /// Level of the first light where each column except the first begins.
    pub columns: Vec<f64>,
    /// Level of the second light where each row except the first begins.
    pub rows: Vec<f64>,
    /// Index of the colour of each cell, row by row.
    cells: Vec<u16>,
    /// The colours in use, darkest first.
    pub colours: Vec<Colour>,
}

impl Strip {
    /// Strip of columns of equal width; equal neighbours are merged.
    ///
    /// # Errors
    /// Returns an error if there is no colour, or more colours than [`MAX_TONES`].
    pub(crate) fn of_columns(columns: &[Colour]) -> Result<Self, String> {
        let (Some(first), count) = (columns.first(), columns.len()) else {
            return Err("has no colour".to_owned());
        };
        let (mut levels, mut colours) = (Vec::new(), vec![*first]);
        for (index, pair) in columns.windows(2).enumerate() {
            if pair[0] != pair[1] {
                levels.push((index + 1) as f64 / count as f64);
                colours.push(pair[1]);
            }
        }
        if colours.len() > MAX_TONES {
            return Err(format!("has {} colours; at most {MAX_TONES} are possible", colours.len()));
        }
        Ok(Self { levels, colours })
    }

    /// Strip of the columns of a picture, in its middle row.
    ///
    /// # Errors
    /// As [`Strip::of_columns`].
    pub(crate) fn of_picture(picture: &Picture) -> Result<Self, String> {
        Self::of_columns(picture.row(picture.height / 2))
    }
}

impl Table {
    /// Table of rows and columns of equal size. Borders between equal neighbours are dropped, and cells of
    /// equal colour are one tone.
    ///
    /// # Errors
    /// Returns an error if a row is empty or of another length, or if there are too many colours.
    pub(crate) fn of_rows(rows: &[Vec<Colour>]) -> Result<Self, String> {
        let width = rows.first().map_or(0, Vec::len);
        if width == 0 || rows.iter().any(|row| row.len() != width) {
            return Err("needs rows of the same number of colours".to_owned());
        }
        let starts = |count: usize, same: &dyn Fn(usize) -> bool| -> Vec<usize> {
            (0..count).filter(|&i| i == 0 || !same(i)).collect()
        };
        let kept_rows = starts(rows.len(), &|r| rows[r] == rows[r - 1]);
        let kept_columns = starts(width, &|c| rows.iter().all(|row| row[c] == row[c - 1]));

        let cell = |r: usize, c: usize| rows[r][c];
        let used = kept_rows.iter().flat_map(|&r| kept_columns.iter().map(move |&c| cell(r, c)));
        let used: Vec<Colour> = used.collect();
        let mut colours = used.clone();
        colours.sort_by(|a, b| a.luma().total_cmp(&b.luma()).then(a.cmp(b)));
        colours.dedup();
        if colours.len() > MAX_TONES {
            return Err(format!("has {} colours; at most {MAX_TONES} are possible", colours.len()));
        }
        let index = |colour: &Colour| colours.iter().position(|c| c == colour).unwrap_or(0) as u16;
        let levels = |kept: &[usize], count: usize| -> Vec<f64> {
            kept.iter().skip(1).map(|&start| start as f64 / count as f64).collect()
        };
        Ok(Self {
            columns: levels(&kept_columns, width),
            rows: levels(&kept_rows, rows.len()),
            cells: used.iter().map(index).collect(),
            colours,
        })
    }

    /// Table of the pixels of a picture: the first light to the right, the second one down.
    ///
    /// # Errors
    /// As [`Table::of_rows`].
    pub(crate) fn of_picture(picture: &Picture) -> Result<Self, String> {
        let rows: Vec<Vec<Colour>> = (0..picture.height).map(|row| picture.row(row).to_vec()).collect();
        Self::of_rows(&rows)
    }

    /// Tone of a cell: the index of its colour.
    #[must_use]
    pub(crate) fn tone(&self, column: u16, row: u16) -> u16 {
        let column = usize::from(column).min(self.columns.len());
        let row = usize::from(row).min(self.rows.len());
        self.cells.get(row * (self.columns.len() + 1) + column).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLACK_TONE: Colour = Colour::BLACK;
    const PURPLE_TONE: Colour = Colour::rgb(90, 0, 90);
    const WHITE_TONE: Colour = Colour::WHITE;

    #[test]
    fn strip_merges_neighbouring_columns_of_equal_colour() {
        // Lake's eight texels, seven of them in shadow.
        let strip = Strip::of_columns(&[
            BLACK_TONE, BLACK_TONE, BLACK_TONE, BLACK_TONE, BLACK_TONE, BLACK_TONE, BLACK_TONE, WHITE_TONE,
        ])
        .unwrap();
        assert_eq!((strip.levels, strip.colours), (vec![0.875], vec![BLACK_TONE, WHITE_TONE]));
        let strip = Strip::of_columns(&[BLACK_TONE, PURPLE_TONE, PURPLE_TONE, BLACK_TONE]).unwrap();
        assert_eq!(
            (strip.levels, strip.colours),
            (vec![0.25, 0.75], vec![BLACK_TONE, PURPLE_TONE, BLACK_TONE])
        );
        assert!(Strip::of_columns(&[]).is_err());
        let picture =
            Picture { width: 2, height: 2, pixels: vec![WHITE_TONE, WHITE_TONE, BLACK_TONE, PURPLE_TONE] };
        assert_eq!(Strip::of_picture(&picture).unwrap().colours, [BLACK_TONE, PURPLE_TONE]);
    }

    #[test]
    fn tone_table_gives_cells_of_equal_colour_one_tone() {
        let table = Table::of_rows(&[
            vec![BLACK_TONE, BLACK_TONE, PURPLE_TONE, PURPLE_TONE],
            vec![BLACK_TONE, BLACK_TONE, PURPLE_TONE, PURPLE_TONE],
            vec![PURPLE_TONE, PURPLE_TONE, WHITE_TONE, WHITE_TONE],
        ])
        .unwrap();
        assert_eq!((&table.columns, &table.rows), (&vec![0.5], &vec![2.0 / 3.0]));
        assert_eq!(table.colours, [BLACK_TONE, PURPLE_TONE, WHITE_TONE]);
        let tones = [(0, 0), (1, 0), (0, 1), (1, 1), (9, 9)].map(|(c, r)| table.tone(c, r));
        assert_eq!(tones, [0, 1, 1, 2, 2]);
        assert!(Table::of_rows(&[vec![BLACK_TONE], vec![]]).is_err());
        let picture = Picture { width: 2, height: 1, pixels: vec![WHITE_TONE, BLACK_TONE] };
        let table = Table::of_picture(&picture).unwrap();
        assert_eq!((table.tone(0, 0), table.tone(1, 0), table.rows.len()), (1, 0, 0));
    }
}
