//! [`HatchRegions`]: the page as hatching needs it: what is visible where, and where strokes end.
//!
//! Borders are the sides of the triangulation, accurate to a hundredth of a px. They are not smoothed again,
//! and no polygons are built. A stroke is cut where it crosses a border piece, which stores the cells on both
//! its sides.

use std::collections::BTreeMap;

use kurbo::{Point, Rect, Vec2};

use super::border_piece::{BorderPiece, PAPER};

use super::piece_tiles::BorderPieceTiles;
use crate::drawing::{Length, Unit};
use crate::regions::cells::label_components;
use crate::regions::cells::triangulation::{OUTSIDE, Triangulation};
use crate::regions::labels::labelled_page::LabelledPage;
use crate::regions::labels::surface_label::{NO_LABEL, SurfaceLabel};

/// Connected part of the page that looks the same to hatching.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HatchCell {
    /// Label; tones of fills are set to 0. Meaningless in cell 0, which is paper.
    pub look: SurfaceLabel,
    /// Stretch of visible surface that contains the cell; 0 for paper. Cells of one facet differ in light and
    /// shade only.
    pub facet: u32,
    /// Area, user units squared.
    pub area: f64,
}

/// Cells of the page, and the border pieces between them.
#[derive(Debug, Clone, Default)]
pub(crate) struct HatchRegions {
    /// All cells. The first is paper.
    pub cells: Vec<HatchCell>,
    /// Border pieces between different cells or surfaces.
    pub pieces: Vec<BorderPiece>,
    /// Number of facets. Facet 0 is paper.
    pub facets: u32,
    grid: BorderPieceTiles,
}

impl HatchRegions {
    /// Cells of a labelled page, moved by `offset`. Cells with less area than a square of side `crumb` go to
    /// a neighbour.
    #[must_use]
    pub(crate) fn new(labelled_page: &LabelledPage, crumb: Length, unit: Unit, offset: Vec2) -> Self {
        let cut = &labelled_page.cut;
        // Hatching ignores tones and marks of cast shadows: the bins include shadows already.
        let (labels, table) = labelled_page.relabelled(|look| SurfaceLabel { tone: 0, cast: false, ..*look });
        let part = |triangle: usize| {
            labels[triangle]
                .checked_sub(1)
                .and_then(|k| table.get(k as usize))
                .map(|look| (look.part, look.material))
        };
        let (facet_of, _) = cut.flooded(|triangle, side, next| {
            cut.borders[triangle][side].is_none_or(|border| border.is_tone()) && part(triangle) == part(next)
        });
        Self::gathered(labelled_page, &labels, &table, &facet_of, crumb, unit, offset)
    }

    /// Cells that differ in tone and colour, but not in hatching bin.
    #[must_use]
    pub(crate) fn toned(labelled_page: &LabelledPage, crumb: Length, unit: Unit, offset: Vec2) -> Self {
        let (looks, table) = labelled_page.relabelled(|look| SurfaceLabel { bin: 0, ..*look });
        let (facet_of, _) = labelled_page.cut.flooded(|triangle, side, next| {
            labelled_page.cut.borders[triangle][side].is_none_or(|border| border.is_tone())
                && looks[triangle] == looks[next]
        });
        Self::gathered(labelled_page, &looks, &table, &facet_of, crumb, unit, offset)
    }

    /// Cells after relabelling by `coarser`, which may make labels equal. All cells form one facet.
    pub(crate) fn coarse(
        labelled_page: &LabelledPage,
        coarser: impl Fn(&SurfaceLabel) -> SurfaceLabel,
        crumb: Length,
        unit: Unit,
        offset: Vec2,
    ) -> Self {
        let (looks, table) = labelled_page.relabelled(coarser);
        Self::gathered(labelled_page, &looks, &table, &vec![0; looks.len()], crumb, unit, offset)
    }

    /// Builds cells and border pieces from triangles with known labels and facets.
    fn gathered(
        labelled_page: &LabelledPage,
        triangle_labels: &[u32],
        table: &[SurfaceLabel],
        facet_of: &[u32],
        crumb: Length,
        unit: Unit,
        offset: Vec2,
    ) -> Self {
        let triangulation = &labelled_page.cut;
        let mut numbers: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut keys: Vec<(u32, u32)> = vec![(NO_LABEL, 0)];
        let keyed: Vec<u32> = (0..triangle_labels.len())
            .map(|t| {
                if triangle_labels[t] == NO_LABEL {
                    return NO_LABEL;
                }
                *numbers.entry((triangle_labels[t], facet_of[t])).or_insert_with(|| {
                    keys.push((triangle_labels[t], facet_of[t]));
                    keys.len() as u32 - 1
                })
            })
            .collect();
        let crumb = crumb.in_unit(unit).max(0.0) / labelled_page.step;
        let patches = label_components::gather(triangulation, &keyed, NO_LABEL, 2.0 * crumb * crumb);

        let mut regions = Self { cells: vec![paper()], facets: 1, ..Self::default() };
        let mut cell_of: Vec<Option<u32>> = vec![None; patches.labels.len()];
        let mut facets: BTreeMap<u32, u32> = BTreeMap::new();
        for patch in &patches.component_of_triangle {
            let (look, facet) = keys[patches.labels[*patch as usize] as usize];
            let cell = &mut cell_of[*patch as usize];
            if cell.is_some() {
                continue;
            }
            let seen_look = look.checked_sub(1).and_then(|k| table.get(k as usize));
            let Some(look) = seen_look else {
                *cell = Some(PAPER);
                continue;
            };
            let next = regions.facets;
            let facet = *facets.entry(facet).or_insert(next);
            regions.facets = next.max(facet + 1);
            *cell = Some(regions.cells.len() as u32);
            let area = patches.area2[*patch as usize] / 2.0 * labelled_page.step * labelled_page.step;
            regions.cells.push(HatchCell { look: *look, facet, area });
        }
        let of = |triangle: usize| cell_of[patches.component_of_triangle[triangle] as usize].unwrap_or(PAPER);
        regions.add_pieces(triangulation, of, |v: u32| {
            let [x, y] = triangulation.points[v as usize];
            Point::new(x as f64 * labelled_page.step, y as f64 * labelled_page.step) + offset
        });
        regions.grid = BorderPieceTiles::new(&regions.pieces);
        regions
    }

    /// A ground with the given cells and pieces, for tests and for pages without a model. The first cell is
    /// paper.
    #[cfg(test)]
    #[must_use]
    pub(crate) fn of_pieces(cells: Vec<HatchCell>, pieces: Vec<BorderPiece>) -> Self {
        let facets = cells.iter().map(|cell| cell.facet + 1).max().unwrap_or(1);
        let grid = BorderPieceTiles::new(&pieces);
        Self { cells, pieces, facets, grid }
    }

    fn add_pieces(&mut self, cut: &Triangulation, cell: impl Fn(usize) -> u32, point: impl Fn(u32) -> Point) {
        for (triangle, corners) in cut.triangles.iter().enumerate() {
            for side in 0..3 {
                let next = cut.neighbours[triangle][side];
                // Each side once: from the triangle with the smaller number.
                if next != OUTSIDE && (next as usize) < triangle {
                    continue;
                }
                let own = cell(triangle);
                let other_cell = if next == OUTSIDE { PAPER } else { cell(next as usize) };
                let parts = cut.borders[triangle][side].is_some_and(|border| !border.is_tone());
                if own == other_cell && (!parts || own == PAPER) {
                    continue;
                }
                let facet = |cell: u32| self.cells[cell as usize].facet;
                let parts_surfaces = parts || facet(own) != facet(other_cell);
                let ends = [corners[side], corners[(side + 1) % 3]].map(&point);
                // Triangles turn from x to y, so their inside is on the right on the page.
                self.pieces.push(BorderPiece { ends, sides: [own, other_cell], parts_surfaces });
            }
        }
    }

    /// The cell at a point.
    #[must_use]
    pub(crate) fn cell_at(&self, p: Point) -> u32 {
        self.grid.cell_at(&self.pieces, p)
    }

    /// Cells at the points of a lattice, row by row from its first point.
    #[must_use]
    pub(crate) fn raster(&self, first: Point, pitch: f64, columns: usize, rows: usize) -> Vec<u32> {
        let mut meets: Vec<Vec<(f64, u32)>> = vec![Vec::new(); rows];
        for piece in &self.pieces {
            let [a, b] = piece.ends;
            // The cell on the right of the piece on the page.
            let cell = piece.sides[usize::from(b.y > a.y)];
            let (top, bottom) = (a.y.min(b.y), a.y.max(b.y));
            let row = |y: f64| ((y - first.y) / pitch).ceil().max(0.0) as usize;
            for (k, meets) in meets.iter_mut().enumerate().take(row(bottom)).skip(row(top)) {
                let y = first.y + k as f64 * pitch;
                meets.push((a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)), cell));
            }
        }
        let mut cells = vec![PAPER; columns * rows];
        for (meets, cells) in meets.iter_mut().zip(cells.chunks_exact_mut(columns.max(1))) {
            meets.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let mut next = meets.iter().peekable();
            let mut cell = PAPER;
            for (k, own) in cells.iter_mut().enumerate() {
                let x = first.x + k as f64 * pitch;
                while let Some((_, beyond)) = next.next_if(|(at, _)| *at <= x) {
                    cell = *beyond;
                }
                *own = cell;
            }
        }
        cells
    }

    /// Numbers of the pieces within `reach` of a point, ascending. May include some that are farther away.
    #[must_use]
    pub(crate) fn pieces_near(&self, p: Point, reach: f64) -> Vec<u32> {
        self.grid.near(Rect::from_points(p - Vec2::new(reach, reach), p + Vec2::new(reach, reach)))
    }

    /// Crossings of a segment with border pieces, in order: the parameter, the piece's number, and whether
    /// the segment passes from its first side to its second.
    pub(crate) fn crossings(&self, from: Point, to: Point, out: &mut Vec<(f64, u32, bool)>) {
        let first = out.len();
        self.grid.visit(from, to, |number| {
            if let Some((t, along)) = crossing(&self.pieces[number as usize], from, to) {
                out.push((t, number, along));
            }
        });
        out[first..].sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut last = None;
        let mut kept = first;
        for k in first..out.len() {
            if last != Some(out[k].1) {
                last = Some(out[k].1);
                out[kept] = out[k];
                kept += 1;
            }
        }
        out.truncate(kept);
    }
}

const fn paper() -> HatchCell {
    use crate::mesh::{MaterialId, PaintId, PartId};
    let look = SurfaceLabel {
        part: PartId(0),
        material: MaterialId(0),
        paint: PaintId(0),
        tone: 0,
        bin: 0,
        cast: false,
    };
    HatchCell { look, facet: 0, area: 0.0 }
}

/// Whether a point lies to the right of the line from `a` to `b` on the page, or on it.
fn is_right(a: Point, b: Point, p: Point) -> bool {
    (b - a).cross(p - a) >= 0.0
}

/// Parameter of a segment's crossing with a piece, and whether it passes from the first side to the second.
fn crossing(piece: &BorderPiece, from: Point, to: Point) -> Option<(f64, bool)> {
    let [a, b] = piece.ends;
    let (side_a, side_b) = (is_right(from, to, a), is_right(from, to, b));
    if side_a == side_b {
        return None;
    }
    let (off_from, off_to) = ((b - a).cross(from - a), (b - a).cross(to - a));
    // The first point of a segment belongs to it, and the last to the next segment.
    if (off_from >= 0.0) == (off_to >= 0.0) {
        return None;
    }
    Some(((off_from / (off_from - off_to)).clamp(0.0, 1.0), off_from >= 0.0))
}
