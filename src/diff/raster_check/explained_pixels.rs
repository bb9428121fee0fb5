//! Pixels explained by findings of geometry, and findings for the others.

use std::ops::Range;

use kurbo::{BezPath, ParamCurve as _, ParamCurveArclen as _, Rect, Shape as _};
use resvg::tiny_skia::PremultipliedColorU8 as Pixel;
use rustc_hash::FxHashMap;

use super::invisible_findings::is_seen;
use super::pixel_comparison::{CoarseComparison, MAX_CHANNEL_DIFFERENCE};
use crate::colour::srgb::Colour;
use crate::diff::findings::finding::{Change, Finding, Verdict};
use crate::diff::shapes::label::Label;
use crate::diff::shapes::picture::{Picture, ShapeKind};

/// Side of a tile in pixels.
const TILE_SIDE_PIXELS: usize = 16;
/// Most pixels inspected per tile, those with the largest difference first.
const MAX_CANDIDATES_PER_TILE: usize = 4;
/// Margin around a changed mark in px within which differences are explained by it. Borders are anti-aliased
/// and snap to pixels.
const EXPLAINED_MARGIN_PX: f64 = 2.0;
/// Long segments are split into pieces of this length in px.
const MAX_PIECE_PX: f64 = 12.0;
/// Most such pieces of all findings; after that, whole boxes are marked.
const MAX_PIECES: usize = 400_000;
/// Most recoloured marks tested; the first visible one ends the search.
const MAX_RECOLOURED: usize = 1000;

/// A square of pixels with candidates.
#[derive(Debug)]
pub(crate) struct CandidateTile {
    column: usize,
    row: usize,
    /// Candidate pixels, those with the largest difference first.
    pub pixels: Vec<[usize; 2]>,
    /// Largest difference, and number of candidates.
    most: u8,
    count: usize,
    /// Bounding box of all candidates: left, top, right, bottom.
    bounds: [usize; 4],
}

/// Mask of explained pixels.
pub(crate) struct ExplainedPixels {
    columns: usize,
    rows: usize,
    scale: f64,
    explained: Vec<bool>,
    claims: bool,
}

impl ExplainedPixels {
    /// Marks the pixels near all visible findings.
    pub(crate) fn new(
        findings: &[Finding],
        pictures: [&Picture; 2],
        columns: usize,
        rows: usize,
        scale: f64,
    ) -> Self {
        let mut places = Self { columns, rows, scale, explained: vec![false; columns * rows], claims: false };
        let mut widths: FxHashMap<&Label, f64> = FxHashMap::default();
        for shape in pictures.iter().flat_map(|picture| picture.shapes.iter()) {
            let width = widths.entry(&*shape.label).or_default();
            *width = width.max(shape.ink.width);
        }
        let mut pieces = 0;
        for finding in findings.iter().filter(|finding| is_seen(finding)) {
            places.claims = true;
            // A mitred corner may reach as far as two line widths.
            let near = EXPLAINED_MARGIN_PX + 2.0 * widths.get(&finding.label).copied().unwrap_or_default();
            let paths = [&finding.removed_path, &finding.added_path];
            let lines =
                finding.kind == ShapeKind::Line && paths.iter().any(|path| !path.elements().is_empty());
            if lines && pieces < MAX_PIECES {
                pieces += paths.into_iter().map(|path| places.along(path, near)).sum::<usize>();
            } else {
                places.mark(finding.place.rect().inflate(near, near));
            }
        }
        places
    }

    /// Whether geometry found any visible change.
    pub(crate) fn has_claims(&self) -> bool {
        self.claims
    }

    /// Marks the pixels near a path; returns the number of pieces.
    fn along(&mut self, path: &BezPath, near: f64) -> usize {
        let mut pieces = 0;
        for segment in path.segments() {
            let count = (segment.arclen(0.5) / MAX_PIECE_PX).ceil().clamp(1.0, 10_000.0) as usize;
            for piece in 0..count {
                let at = |index: usize| index as f64 / count as f64;
                let part = segment.subsegment(at(piece)..at(piece + 1));
                self.mark(part.bounding_box().inflate(near, near));
            }
            pieces += count;
        }
        pieces
    }

    fn mark(&mut self, rect: Rect) {
        for line in pixel_lines(rect, self.columns, self.rows, self.scale) {
            if let Some(pixels) = self.explained.get_mut(line) {
                pixels.fill(true);
            }
        }
    }

    /// Tiles with unexplained differing pixels, or with `any` all differing pixels, largest difference first.
    pub(crate) fn candidates(&self, coarse: &CoarseComparison, any: bool) -> Vec<CandidateTile> {
        let across = self.columns.div_ceil(TILE_SIDE_PIXELS);
        let mut tiles: Vec<Vec<(u8, usize)>> = Vec::new();
        tiles.resize_with(across * self.rows.div_ceil(TILE_SIDE_PIXELS), Vec::new);
        for index in 0..self.explained.len() {
            let value = match any {
                true if coarse.difference[index] > MAX_CHANNEL_DIFFERENCE => coarse.difference[index],
                false if !self.explained[index] => coarse.excess[index],
                _ => 0,
            };
            if value > 0 {
                let (column, row) = (index % self.columns, index / self.columns);
                tiles[row / TILE_SIDE_PIXELS * across + column / TILE_SIDE_PIXELS].push((value, index));
            }
        }
        let mut found: Vec<CandidateTile> = Vec::new();
        for (number, mut pixels) in tiles.into_iter().enumerate() {
            pixels.sort_unstable_by_key(|(value, index)| (std::cmp::Reverse(*value), *index));
            let Some((most, _)) = pixels.first().copied() else { continue };
            let at = |(_, index): &(u8, usize)| [index % self.columns, index / self.columns];
            let boxes = pixels.iter().map(at).map(|[x, y]| [x, y, x + 1, y + 1]);
            found.push(CandidateTile {
                column: number % across,
                row: number / across,
                pixels: pixels.iter().take(MAX_CANDIDATES_PER_TILE).map(at).collect(),
                most,
                count: pixels.len(),
                bounds: union(boxes),
            });
        }
        found.sort_by_key(|tile| std::cmp::Reverse(tile.most));
        found
    }

    /// One finding for each connected group of tiles.
    pub(crate) fn findings(&self, tiles: &[CandidateTile], pictures: [&[Pixel]; 2]) -> Vec<Finding> {
        let by_place: FxHashMap<[usize; 2], usize> =
            tiles.iter().enumerate().map(|(index, tile)| ([tile.column, tile.row], index)).collect();
        let mut taken = vec![false; tiles.len()];
        let mut found = Vec::new();
        for first in 0..tiles.len() {
            if std::mem::replace(&mut taken[first], true) {
                continue;
            }
            let (mut group, mut next) = (vec![first], 0);
            while let Some(tile) = group.get(next).map(|index| &tiles[*index]) {
                for (dx, dy) in (0..9).map(|k| (k % 3, k / 3)) {
                    let neighbour = [(tile.column + dx).wrapping_sub(1), (tile.row + dy).wrapping_sub(1)];
                    let index = by_place.get(&neighbour).copied();
                    group.extend(index.filter(|index| !std::mem::replace(&mut taken[*index], true)));
                }
                next += 1;
            }
            found.push(self.finding(&group, tiles, pictures));
        }
        found
    }

    /// The finding for one group of tiles.
    fn finding(&self, group: &[usize], tiles: &[CandidateTile], pictures: [&[Pixel]; 2]) -> Finding {
        let tiles = || group.iter().map(|index| &tiles[*index]);
        let [x0, y0, x1, y1] = union(tiles().map(|tile| tile.bounds));
        let px = |pixel: usize| pixel as f64 / self.scale;
        let place = Rect::new(px(x0), px(y0), px(x1), px(y1));
        // The first tile has the largest difference.
        let [column, row] = tiles().next().and_then(|tile| tile.pixels.first().copied()).unwrap_or_default();
        let colour = |side: usize| {
            pictures[side].get(row * self.columns + column).map_or_else(String::new, |pixel| in_words(*pixel))
        };
        let change = Change { what: "colour".to_owned(), old: colour(0), new: colour(1) };
        let pixels: usize = tiles().map(|tile| tile.count).sum();
        Finding {
            size: pixels as f64 / (self.scale * self.scale),
            added_path: place.to_path(0.1),
            ..Finding::in_place(Verdict::Picture, Label::default(), vec![change], place)
        }
    }
}

/// The box around boxes: left, top, right, bottom.
fn union(boxes: impl Iterator<Item = [usize; 4]>) -> [usize; 4] {
    boxes.fold([usize::MAX, usize::MAX, 0, 0], |all, own| {
        [all[0].min(own[0]), all[1].min(own[1]), all[2].max(own[2]), all[3].max(own[3])]
    })
}

/// Whether a change from one flat colour to another is visible: some pixel of the mark's box differs at all.
pub(crate) fn is_recoloured(
    findings: &[Finding],
    coarse: &CoarseComparison,
    columns: usize,
    scale: f64,
) -> bool {
    let is_flat = |colour: &str| colour.starts_with('#') && !colour.contains(' ');
    let recoloured = findings.iter().filter(|finding| {
        let flat = |change: &Change| change.what == "colour" && is_flat(&change.old) && is_flat(&change.new);
        finding.verdict == Verdict::Restyled && finding.changes.iter().any(flat)
    });
    let rows = coarse.difference.len() / columns.max(1);
    recoloured.take(MAX_RECOLOURED).any(|finding| {
        pixel_lines(finding.place.rect(), columns, rows, scale)
            .filter_map(|line| coarse.difference.get(line))
            .any(|line| line.iter().any(|difference| *difference > 0))
    })
}

/// Index ranges of the pixels of a rectangle in px, one for each row of pixels.
fn pixel_lines(rect: Rect, columns: usize, rows: usize, scale: f64) -> impl Iterator<Item = Range<usize>> {
    let to = move |value: f64, count: usize| (value * scale).clamp(0.0, count as f64) as usize;
    let (left, right) = (to(rect.x0, columns), to(rect.x1 + 1.0 / scale, columns));
    (to(rect.y0, rows)..to(rect.y1 + 1.0 / scale, rows))
        .map(move |row| row * columns + left..row * columns + right)
}

/// A colour in words: `#cc3333`, `#cc3333 at 40 %`, `nothing`.
fn in_words(pixel: Pixel) -> String {
    let plain = pixel.demultiply();
    let hex = Colour::rgb(plain.red(), plain.green(), plain.blue()).hex();
    match plain.alpha() {
        0 => "nothing".to_owned(),
        255 => hex,
        alpha => format!("{hex} at {:.0} %", f64::from(alpha) / 2.55),
    }
}
