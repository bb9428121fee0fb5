//! Canonical order of marks that may be exchanged: by name, then by start point and path.
//!
//! Neighbours of equal paint may be exchanged, because one colour over itself looks the same in either order.

use std::borrow::Cow;
use std::ops::Range;

use crate::parallel::prelude::*;
use rustc_hash::FxHashMap;

use super::paint_attributes::{Attributes, have_equal_paint};
use crate::drawing::{Mark, Paint, Provenance};
use crate::export::encoding::decimals::Decimals;
use crate::export::encoding::xml::read_back;
use crate::export::paths::canonical_path::{CanonicalWriter, PathForm};
use crate::export::paths::path_piece::PathPoint;

/// Number of marks written per task.
pub(crate) const MARKS_PER_CHUNK: usize = 2048;

/// Name of a mark. Marks are compared by the fields in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) struct MarkName<'a> {
    /// Classes as written.
    pub classes: &'a str,
    /// The part of the model.
    pub part: Option<&'a str>,
    /// The material, where it is written.
    pub material: Option<&'a str>,
    /// The tone of a region.
    pub tone: Option<u16>,
}

/// Path data of marks.
pub(crate) struct MarkPaths {
    /// Text of each chunk of marks.
    texts: Vec<Vec<u8>>,
    /// Ranges of each mark.
    ranges_by_mark: Vec<PathRange>,
}

/// Ranges of a mark's data in its chunk: first its axis, then its own path.
#[derive(Debug, Clone, Copy)]
struct PathRange {
    begin: usize,
    axis_end: usize,
    end: usize,
    start: Option<PathPoint>,
}

impl MarkPaths {
    /// Writes the paths of marks. If these are ordered, each path keeps its direction.
    pub(crate) fn of(marks: &[&Mark], ordered: bool, decimals: Decimals) -> Self {
        let write = |chunk: &[&Mark]| {
            let mut text = Vec::with_capacity(chunk.len() * 64);
            let mut canonical = CanonicalWriter::new(decimals);
            let mut ranges = Vec::with_capacity(chunk.len());
            for mark in chunk {
                let begin = text.len();
                if let Paint::Outline(outline) = &mark.paint {
                    let form = if ordered { PathForm::Kept } else { PathForm::Stroked };
                    canonical.write(&mut text, &outline.axis, form);
                }
                let axis_end = text.len();
                let start = canonical.write(&mut text, &mark.path, form(mark, ordered));
                ranges.push(PathRange { begin, axis_end, end: text.len(), start });
            }
            (text, ranges)
        };
        let chunks: Vec<(Vec<u8>, Vec<PathRange>)> =
            marks.par_chunks(MARKS_PER_CHUNK).with_max_len(1).map(write).collect();
        let mut paths = Self { texts: Vec::new(), ranges_by_mark: Vec::with_capacity(marks.len()) };
        for (text, ranges) in chunks {
            paths.texts.push(text);
            paths.ranges_by_mark.extend(ranges);
        }
        paths
    }

    /// The `d` of a mark.
    pub(crate) fn data(&self, mark: usize) -> &[u8] {
        self.text(mark, |place| place.axis_end..place.end)
    }

    /// Axis of a line drawn as an outline, as path data.
    pub(crate) fn axis(&self, mark: usize) -> &[u8] {
        self.text(mark, |place| place.begin..place.axis_end)
    }

    fn text(&self, mark: usize, range: impl Fn(&PathRange) -> Range<usize>) -> &[u8] {
        let place = self.ranges_by_mark.get(mark).map(range);
        place
            .zip(self.texts.get(mark / MARKS_PER_CHUNK))
            .and_then(|(range, text)| text.get(range))
            .unwrap_or_default()
    }
}

/// The changes to a mark's path that do not affect how it is painted.
fn form(mark: &Mark, ordered: bool) -> PathForm {
    match &mark.paint {
        _ if ordered => PathForm::Kept,
        Paint::Stroke(stroke) if stroke.dash.is_empty() => PathForm::Stroked,
        Paint::Stroke(_) => PathForm::Kept,
        Paint::Fill(_) | Paint::Gradient(_) | Paint::Image(_) | Paint::Outline(_) => PathForm::Filled,
    }
}

/// A run of neighbours of equal paint.
pub(crate) struct PaintRun {
    /// Positions of the marks in the written order.
    pub range: Range<usize>,
    pub attributes: Attributes,
}

/// Runs of marks of equal paint.
pub(crate) fn runs(marks: &[&Mark]) -> Vec<PaintRun> {
    let mut at = 0;
    let run = |run: &[&Mark]| {
        let range = at..at + run.len();
        at = range.end;
        Some(PaintRun { range, attributes: Attributes::of(run.first()?) })
    };
    marks.chunk_by(|a, b| have_equal_paint(a, b)).filter_map(run).collect()
}

/// Sort key of a mark, apart from its path data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct SortKey {
    rank: Option<usize>,
    start: Option<PathPoint>,
}

/// Written order of marks: within a run by name, start point and path.
pub(crate) fn sorted(marks: &[&Mark], runs: &[PaintRun], paths: &MarkPaths) -> Vec<usize> {
    let ranks = ranks(marks);
    let key = |mark: usize| {
        let start = paths.ranges_by_mark.get(mark).and_then(|place| place.start);
        (SortKey { rank: ranks.get(mark).copied(), start }, mark)
    };
    // Keys are stored next to the mark numbers to avoid cache misses.
    let mut order: Vec<(SortKey, usize)> = (0..marks.len()).into_par_iter().map(key).collect();
    for run in runs.iter().filter(|run| run.range.len() > 1) {
        let Some(of_run) = order.get_mut(run.range.clone()) else { continue };
        // The mark number breaks ties, so the sort need not be stable.
        of_run.par_sort_unstable_by(|(key, a), (other, b)| {
            key.cmp(other).then_with(|| paths.data(*a).cmp(paths.data(*b))).then(a.cmp(b))
        });
    }
    order.into_iter().map(|(_, mark)| mark).collect()
}

/// Rank of each mark's name among all names.
fn ranks(marks: &[&Mark]) -> Vec<usize> {
    let mut known: FxHashMap<RawMarkName, usize> = FxHashMap::default();
    let mut names: Vec<RawMarkName> = Vec::new();
    let mut last: Option<(RawMarkName, usize)> = None;
    let mut numbers: Vec<usize> = Vec::with_capacity(marks.len());
    for mark in marks {
        let called = RawMarkName::of(mark);
        let number = match last {
            // Most marks have the same name as the previous one.
            Some((same, number)) if same == called => number,
            _ => *known.entry(called).or_insert_with(|| {
                names.push(called);
                names.len() - 1
            }),
        };
        last = Some((called, number));
        numbers.push(number);
    }
    let texts: Vec<[Option<Cow<str>>; 3]> = names.iter().map(RawMarkName::texts).collect();
    let name = |number: usize| {
        let [classes, part, material] =
            texts.get(number).map_or([None; 3], |texts| texts.each_ref().map(Option::as_deref));
        let tone = names.get(number).and_then(|called| called.tone);
        MarkName { classes: classes.unwrap_or_default(), part, material, tone }
    };
    let mut order: Vec<usize> = (0..names.len()).collect();
    order.sort_by(|a, b| name(*a).cmp(&name(*b)));
    // Names with equal text have equal rank.
    let mut ranks = vec![0; names.len()];
    let mut rank = 0;
    for (index, number) in order.iter().enumerate() {
        let before = index.checked_sub(1).and_then(|before| order.get(before));
        if before.is_some_and(|before| name(*before) != name(*number)) {
            rank += 1;
        }
        if let Some(place) = ranks.get_mut(*number) {
            *place = rank;
        }
    }
    numbers.into_iter().filter_map(|number| ranks.get(number).copied()).collect()
}

/// Name of a mark before it is written as text.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct RawMarkName<'a> {
    classes: &'a [&'static str],
    tone: Option<u16>,
    part: Option<&'a str>,
    material: Option<&'a str>,
}

impl<'a> RawMarkName<'a> {
    fn of(mark: &'a Mark) -> Self {
        let Provenance { classes, tone, part, material, .. } = &mark.provenance;
        let material =
            material.as_deref().filter(|_| matches!(mark.paint, Paint::Fill(_) | Paint::Gradient(_)));
        Self { classes, tone: *tone, part: part.as_deref(), material }
    }

    /// Classes, part and material as they read back from the file.
    fn texts(&self) -> [Option<Cow<'a, str>>; 3] {
        let mut classes = Vec::new();
        write_classes(&mut classes, self.classes, self.tone);
        let classes = String::from_utf8_lossy(&classes).into_owned();
        [Some(Cow::Owned(classes)), self.part.map(read_back), self.material.map(read_back)]
    }
}

/// Writes the classes of a mark, the tone last.
pub(crate) fn write_classes(out: &mut Vec<u8>, classes: &[&str], tone: Option<u16>) {
    for (index, class) in classes.iter().enumerate() {
        if index > 0 {
            out.push(b' ');
        }
        out.extend_from_slice(class.as_bytes());
    }
    if let Some(tone) = tone {
        let blank = if classes.is_empty() { "" } else { " " };
        out.extend_from_slice(format!("{blank}tone-{tone}").as_bytes());
    }
}
