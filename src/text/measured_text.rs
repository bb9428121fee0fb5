//! [`MeasuredText`]: a text with its break opportunities and the width of a line between any two of them.
//!
//! The breaks between words divide the text into pieces. Each piece is shaped once, and prefix sums of the
//! widths give the width of any line that begins and ends between words. A line that begins or ends at a
//! hyphen also shapes its first or last part.
//!
//! The line-breaking searches of `line_breaking` run here, with these widths as input. Lengths are in ems,
//! unless stated otherwise.

use std::sync::Arc;

use super::Setting;
use super::break_opportunities::{LineBreak, language, line_breaks};
use super::line_breaking::{choose_balanced, greedy};
use super::shaped_pieces::{ShapedPiece, ShapedPieces};
use crate::error::{Error, ErrorKind};

/// Maximum number of lines times break opportunities for balanced breaking.
const MAX_LINE_BREAK_PAIRS: usize = 4_000_000;

/// A text with its break opportunities and measured pieces. Lengths in ems.
pub(crate) struct MeasuredText<'a> {
    text: &'a str,
    pub setting: &'a Setting,
    pub breaks: Vec<LineBreak>,
    pub pieces: ShapedPieces<'a>,
    /// For each break, the number of whole pieces before it.
    pieces_before: Vec<usize>,
    /// Prefix sums: entry `n` is the width of the first `n` pieces with the blanks after them.
    widths: Vec<f64>,
    /// Indices of the breaks without a hyphen. They lie between whole pieces.
    piece_breaks: Vec<usize>,
    /// Maximum extent of the ink above and below the baseline; above, at least the height of capitals.
    pub reach: [f64; 2],
    /// The first error while measuring.
    fault: Option<Error>,
}

impl<'a> MeasuredText<'a> {
    /// Finds the breaks of a text and shapes its pieces. The text must be trimmed.
    ///
    /// # Errors
    /// If the letter size or line spacing is invalid, the language is unknown, or a glyph is missing.
    pub(crate) fn new(text: &'a str, setting: &'a Setting) -> Result<Self, Error> {
        let em = setting.em();
        if !(em.is_finite() && em > 0.0 && setting.leading.is_finite() && setting.leading >= 0.0) {
            return Err(
                Error::new("the letter size or line spacing is not above 0").remedy("give numbers above 0")
            );
        }
        let language = setting.language.as_deref().map(language).transpose()?;
        let breaks = line_breaks(text, language);
        let mut pieces = ShapedPieces::new(text, setting);
        let unhyphenated: Vec<usize> = (0..breaks.len()).filter(|number| !breaks[*number].hyphen).collect();
        let mut widths = vec![0.0];
        let mut reach = [setting.font.file().cap_height, 0.0];
        for pair in unhyphenated.windows(2) {
            let piece = pieces.piece(breaks[pair[0]].at, breaks[pair[1]].at, false)?;
            widths.push(widths.last().unwrap_or(&0.0) + piece.width + piece.blank_width);
            reach = [reach[0].max(piece.reach[0]), reach[1].max(piece.reach[1])];
        }
        let mut stretches = Vec::with_capacity(breaks.len());
        let mut count: usize = 0;
        for line_break in &breaks {
            count += usize::from(!line_break.hyphen);
            stretches.push(count - 1);
        }
        Ok(Self {
            text,
            setting,
            breaks,
            pieces,
            pieces_before: stretches,
            widths,
            piece_breaks: unhyphenated,
            reach,
            fault: None,
        })
    }

    /// Returns the error that occurred while measuring, if any.
    pub(crate) fn take_fault(&mut self) -> Result<(), Error> {
        self.fault.take().map_or(Ok(()), Err)
    }

    /// Converts a length from user units to ems.
    pub(crate) fn in_ems(&self, units: f64) -> f64 {
        units / self.setting.em()
    }

    /// The parts of a line between two breaks: start byte, end byte, and whether a hyphen follows. Parts
    /// are whole pieces, except at breaks with a hyphen.
    pub(crate) fn parts(&self, from: usize, to: usize) -> Vec<(usize, usize, bool)> {
        let (begin, end) = (self.breaks[from], self.breaks[to]);
        let mut parts = Vec::new();
        let mut at = begin.at;
        let first = self.pieces_before[from] + 1;
        let last = if end.hyphen { self.pieces_before[to] } else { self.pieces_before[to] - 1 };
        for stretch in first..=last {
            let border = self.breaks[self.piece_breaks[stretch]].at;
            parts.push((at, border, false));
            at = border;
        }
        parts.push((at, end.at, end.hyphen));
        parts
    }

    /// The width of a line between two breaks, including overhanging ink. `None` if a mandatory break lies
    /// between them, or if a glyph is missing; [`Self::take_fault`] then returns the error.
    pub(crate) fn line_width(&mut self, from: usize, to: usize) -> Option<f64> {
        if (from + 1..to).rev().any(|between| self.breaks[between].must) {
            return None;
        }
        self.measure_line(from, to).map_err(|error| self.fault = Some(error)).ok()
    }

    /// The width of a line between two breaks, including overhanging ink.
    pub(crate) fn measure_line(&mut self, from: usize, to: usize) -> Result<f64, Error> {
        let parts_whole = !self.breaks[from].hyphen && !self.breaks[to].hyphen;
        let at = |source: &Self, number: usize| source.breaks[source.piece_breaks[number]].at;
        let (first, last, sum) = if parts_whole {
            let (begin, end) = (self.pieces_before[from], self.pieces_before[to]);
            let first = self.pieces.piece(at(self, begin), at(self, begin + 1), false)?;
            let last = self.pieces.piece(at(self, end - 1), at(self, end), false)?;
            (first, last, self.widths[end] - self.widths[begin])
        } else {
            let parts = self.parts(from, to);
            let pieces: Vec<Arc<ShapedPiece>> = parts
                .iter()
                .map(|(from, to, hyphen)| self.pieces.piece(*from, *to, *hyphen))
                .collect::<Result<_, _>>()?;
            let sum = pieces.iter().map(|piece| piece.width + piece.blank_width).sum::<f64>();
            match (pieces.first(), pieces.last()) {
                (Some(first), Some(last)) => (Arc::clone(first), Arc::clone(last), sum),
                _ => return Ok(0.0),
            }
        };
        // In text from right to left, the last piece is on the left.
        let [left, right] = if self.pieces.runs_left { [&last, &first] } else { [&first, &last] };
        Ok(left.overhang[0] + sum - last.blank_width + right.overhang[1])
    }

    /// Breaks the text greedily into lines of at most `width` user units. Returns the breaks that end
    /// lines, or the break after which nothing fits. `parted` allows hyphens.
    pub(crate) fn greedy(&mut self, width: f64, parted: bool) -> Result<Vec<usize>, usize> {
        let limit = self.in_ems(width);
        let breaks = self.breaks.clone();
        let mut fits = |from: usize, to: usize| self.line_width(from, to).is_some_and(|width| width <= limit);
        let last = breaks.len() - 1;
        greedy(last, &mut fits, &|at| parted || !breaks[at].hyphen, &|at| breaks[at].must)
    }

    /// The error for a word that is too wide. It starts at the break `begin`; `width` is in user units.
    pub(crate) fn word_too_wide_error(&mut self, begin: usize, width: f64) -> Error {
        if let Some(fault) = self.fault.take() {
            return fault;
        }
        let end = (begin + 1..self.breaks.len()).find(|at| !self.breaks[*at].hyphen).unwrap_or(begin);
        let word =
            self.text.get(self.breaks[begin].at..self.breaks[end].at).unwrap_or_default().trim().to_owned();
        let own = self.line_width(begin, end).unwrap_or_default() * self.setting.em();
        Error::new(format!("`{word}` is {own:.2} wide, but the text has a width of {width:.2}"))
            .remedy("make the text wider, set it smaller, or name the language for hyphenation")
    }

    /// Returns an error if the search for balanced breaks would be too large.
    pub(crate) fn check_search_size(&self, lines: usize) -> Result<(), Error> {
        if lines.saturating_mul(self.breaks.len()) <= MAX_LINE_BREAK_PAIRS {
            return Ok(());
        }
        Err(Error::new("the text is too long to balance its lines").remedy("give it a width"))
    }

    /// Breaks the text into exactly `lines` lines with the smallest maximum cost. Returns this cost and the
    /// breaks that end lines. `parted` allows hyphens; `cost` takes the line number and the line's two
    /// breaks.
    pub(crate) fn best_ends(
        &mut self,
        lines: usize,
        parted: bool,
        cost: &mut dyn FnMut(&mut Self, usize, usize, usize) -> Option<f64>,
    ) -> Option<(f64, Vec<usize>)> {
        let may_end: Vec<bool> = self.breaks.iter().map(|place| parted || !place.hyphen).collect();
        let last = self.breaks.len() - 1;
        choose_balanced(lines, last, &mut |line, from, to| cost(self, line, from, to), &|at| may_end[at])
    }

    /// Breaks the text so that it fits in the smallest ellipse of an aspect ratio (height by width).
    /// Returns half the width of the ellipse and the breaks that end lines. Numbers of lines are tried from 1
    /// up, until no larger number can give a smaller ellipse.
    pub(crate) fn smallest_ellipse(&mut self, aspect: f64, parted: bool) -> Result<(f64, Vec<usize>), Error> {
        let [above, below] = self.reach;
        let leading = self.setting.leading;
        let mut best: Option<(f64, Vec<usize>)> = None;
        for lines in 1..self.breaks.len() {
            let height = above + below + (lines - 1) as f64 * leading;
            let reached = best.as_ref().map_or(f64::INFINITY, |(square, _)| *square);
            // Vertical distance of the line's farther edge from the centre, scaled so that the ellipse is a
            // circle.
            let corner = |line: usize| {
                let top = line as f64 * leading - height / 2.0;
                top.abs().max((top + above + below).abs()) / aspect
            };
            if corner(0) * corner(0) >= reached {
                break;
            }
            self.check_search_size(lines)?;
            let mut cost = |source: &mut Self, line: usize, from: usize, to: usize| {
                let half = source.line_width(from, to)? / 2.0;
                let square = half * half + corner(line) * corner(line);
                (half * half < reached).then_some(square)
            };
            if let Some(found) = self.best_ends(lines, parted, &mut cost)
                && found.0 < reached
            {
                best = Some(found);
            }
        }
        self.take_fault()?;
        let (square, ends) =
            best.ok_or_else(|| Error::new("the text has no lines").of_kind(ErrorKind::Empty))?;
        Ok((square.sqrt(), ends))
    }
}
