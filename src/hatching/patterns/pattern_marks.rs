//! Marks of patterns over tones: dots, lines, crosses and tiles, clipped where their tone ends.
//!
//! Dots on the page are clipped like half-tone dots, lines like strokes, and other shapes as polygons. All
//! are clipped exactly at the borders of the ground.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::parallel::prelude::*;
use kurbo::{BezPath, Point, Vec2};

use super::pattern_options::{Pattern, PatternKind};
use super::pattern_shapes::{FilledShape, clip_to_domains};
use super::tile::Tile;
use crate::drawing::{Cap, Join, Length, Mark, Paint, Provenance, StrokePaint};
use crate::geometry::plane::polyline_path::polyline;
use crate::geometry::plane::polylines::bounds;
use crate::hatching::clip::domain::Domains;
use crate::hatching::clip::line_clip::{clip_to_cells, sub_polyline};
use crate::hatching::dots::halftone::{DotScreen, ToneBorders, dots};
use crate::hatching::guides::guide::{Guide, axes};
use crate::hatching::{HatchContext, colour, provenance};
use crate::mesh::{MaterialId, PartId};
use crate::regions::surface_curves::decals::Decal;
use crate::regions::{HatchRegions, SurfaceLabel};

/// Greatest number of lines, crosses or tiles of a pattern. Finer patterns could not be seen; they are made
/// coarser.
const MAX_PATTERN_SQUARES: f64 = 2e5;

/// Length of an arm of a cross as a share of its square.
const CROSS_ARM_OF_SQUARE: f64 = 0.3;

/// Content of a pattern that is fixed to the surface.
#[derive(Debug, Clone)]
pub(crate) enum SurfacePattern {
    /// Lines and crosses.
    Guides(Vec<Guide>),
    /// Dots and tiles as they appear on the page, and whether each figure is filled.
    Decals(Vec<Decal>, Vec<bool>),
}

/// The marks of a pattern, one for each part, material and tone.
///
/// `tones` returns the number of tones of a surface with a given look. `fixed` is the content that is fixed
/// to the surface.
#[must_use]
pub(crate) fn pattern(
    ground: &HatchRegions,
    context: &HatchContext,
    settings: &Pattern,
    tones: impl Fn(&SurfaceLabel) -> u16,
    fixed: Option<&SurfacePattern>,
) -> Vec<Mark> {
    let is_wanted_cell: Vec<bool> = ground
        .cells
        .iter()
        .map(|cell| {
            let name = context.materials.get(cell.look.material.index()).map_or("", |(name, _)| name);
            cell.facet != 0 && settings.is_for(name, cell.look.tone, tones(&cell.look))
        })
        .collect();
    let Some([low, high]) = extent(ground, &is_wanted_cell) else { return Vec::new() };
    let long = |length: Length| length.in_unit(context.unit);
    let size = long(settings.size).max(((high.x - low.x) * (high.y - low.y) / MAX_PATTERN_SQUARES).sqrt());
    let angle = settings.angle.to_radians();
    if let Some(SurfacePattern::Decals(decals, filled)) = fixed {
        return surface_marks(ground, context, settings, &is_wanted_cell, decals, filled);
    }
    if settings.kind == PatternKind::Dots {
        let radius = long(settings.width) / 2.0 / size;
        let covered = (PI * radius * radius).min(1.0);
        let screen = DotScreen {
            pitch: size,
            angle: -angle,
            origin: Point::ZERO,
            tone_borders: ToneBorders::Cut,
            px: long(Length::px(1.0)),
        };
        let coverage = |cell: u32, _: Point| if is_wanted_cell[cell as usize] { covered } else { 0.0 };
        let placed_dots = dots(ground, &screen, &coverage).into_iter();
        return marks_by_look(
            placed_dots.map(|dots| (dots.cell, dots.path)),
            ground,
            context,
            settings,
            None,
        );
    }
    let lines: Vec<Vec<Point>> = match fixed {
        Some(SurfacePattern::Guides(guides)) => guides.iter().map(|guide| guide.line.clone()).collect(),
        _ => page_lines(settings, size, angle, [low, high]),
    };
    let clip_line = |line: &Vec<Point>| cut_line(ground, line, |cell| is_wanted_cell[cell as usize]);
    let cut: Vec<Vec<(u32, BezPath)>> = lines.par_iter().with_min_len(16).map(clip_line).collect();
    let mut marks =
        marks_by_look(cut.into_iter().flatten(), ground, context, settings, Some(long(settings.width)));
    if settings.kind == PatternKind::Tile && !settings.tile.shapes.is_empty() {
        let domains = Domains::by_label(ground, &is_wanted_cell);
        let shapes =
            TilePlacement::new(size, angle, settings.tile.height, [low, high]).shapes(&settings.tile);
        let clip_shape = |rings: Vec<Vec<Point>>| {
            clip_to_domains(ground, &domains, |_| true, FilledShape { rings, whole: None })
        };
        let cut: Vec<Vec<(u32, BezPath)>> = shapes.into_par_iter().with_min_len(16).map(clip_shape).collect();
        marks.extend(marks_by_look(cut.into_iter().flatten(), ground, context, settings, None));
    }
    marks
}

/// The parts of a line that lie in wanted cells, each with its cell.
fn cut_line(ground: &HatchRegions, line: &[Point], wanted: impl Fn(u32) -> bool) -> Vec<(u32, BezPath)> {
    let seen = clip_to_cells(ground, line, wanted);
    seen.into_iter().map(|s| (s.cell, polyline(&sub_polyline(line, s.from, s.to)))).collect()
}

/// The marks of figures on the surface, each clipped to the facets that show it.
fn surface_marks(
    ground: &HatchRegions,
    context: &HatchContext,
    pattern: &Pattern,
    is_patterned: &[bool],
    decals: &[Decal],
    filled: &[bool],
) -> Vec<Mark> {
    let domains = Domains::of_facets(ground, is_patterned);
    let mut first = vec![0; ground.facets as usize];
    for (cell, known) in ground.cells.iter().enumerate().rev() {
        first[known.facet as usize] = cell as u32;
    }
    let is_filled = |decal: &&Decal| filled.get(decal.figure as usize).copied().unwrap_or(false);
    let shapes: Vec<Vec<(u32, BezPath)>> = decals
        .par_iter()
        .with_min_len(16)
        .filter(is_filled)
        .map(|decal| {
            let dot_outline = (pattern.kind == PatternKind::Dots).then(|| closed_curve(decal)).flatten();
            let shape = FilledShape { rings: decal.lines.clone(), whole: dot_outline };
            let is_visible_facet = |facet: u32| decal.facets.binary_search(&facet).is_ok();
            let shown = clip_to_domains(ground, &domains, is_visible_facet, shape);
            shown.into_iter().map(|(facet, path)| (first[facet as usize], path)).collect()
        })
        .collect();
    let lines: Vec<Vec<(u32, BezPath)>> = decals
        .par_iter()
        .with_min_len(16)
        .filter(|decal| !is_filled(decal))
        .map(|decal| {
            let is_visible_cell = |cell: u32| {
                let facet = ground.cells[cell as usize].facet;
                is_patterned[cell as usize] && decal.facets.binary_search(&facet).is_ok()
            };
            decal.lines.iter().flat_map(|line| cut_line(ground, line, is_visible_cell)).collect()
        })
        .collect();
    let width = pattern.width.in_unit(context.unit);
    let mut marks = marks_by_look(lines.into_iter().flatten(), ground, context, pattern, Some(width));
    marks.extend(marks_by_look(shapes.into_iter().flatten(), ground, context, pattern, None));
    marks
}

/// A closed curve through the points of a dot.
fn closed_curve(decal: &Decal) -> Option<BezPath> {
    let [ring] = &decal.lines[..] else { return None };
    let n = ring.len();
    let at = |k: usize| ring[k % n];
    let mut path = BezPath::new();
    path.move_to(*ring.first()?);
    // Four quarters, each bulging out to the ring point halfway along it.
    for k in 0..4 {
        let (a, b, c) = (at(k * n / 4), at((2 * k + 1) * n / 8), at((k + 1) * n / 4));
        let bulge = (b - a.midpoint(c)) * (4.0 / 3.0);
        let (from, to) =
            (a.lerp(c, QUARTER_CIRCLE_HANDLE_OF_CHORD), c.lerp(a, QUARTER_CIRCLE_HANDLE_OF_CHORD));
        path.curve_to(from + bulge, to + bulge, c);
    }
    path.close_path();
    Some(path)
}

/// Position of the Bézier handles along the chord of a quarter circle.
const QUARTER_CIRCLE_HANDLE_OF_CHORD: f64 = 0.276_142_374_915_397;

/// The bounding box of the wanted cells.
fn extent(ground: &HatchRegions, wanted: &[bool]) -> Option<[Point; 2]> {
    let pieces = ground.pieces.iter().filter(|piece| piece.sides.iter().any(|cell| wanted[*cell as usize]));
    let bounds = bounds(pieces.flat_map(|piece| piece.ends))?;
    Some([bounds.origin(), Point::new(bounds.x1, bounds.y1)])
}

/// Squares of a pattern that is fixed to the page, over a box of it.
struct TilePlacement {
    size: f64,
    along: Vec2,
    across: Vec2,
    height: f64,
    columns: std::ops::RangeInclusive<i64>,
    rows: std::ops::RangeInclusive<i64>,
}

impl TilePlacement {
    fn new(size: f64, angle: f64, height: f64, [low, high]: [Point; 2]) -> Self {
        let [along, across] = axes(angle);
        let corners = [low, Point::new(high.x, low.y), high, Point::new(low.x, high.y)].map(Point::to_vec2);
        let range = |axis: Vec2, step: f64| {
            let values = corners.map(|corner| corner.dot(axis) / step);
            let least = values.into_iter().fold(f64::INFINITY, f64::min).floor() as i64;
            least - 1..=values.into_iter().fold(f64::NEG_INFINITY, f64::max).ceil() as i64
        };
        let (columns, rows) = (range(along, size), range(across, size * height));
        Self { size, along, across, height, columns, rows }
    }

    fn at(&self, x: f64, y: f64) -> Point {
        ((self.along * x + self.across * y) * self.size).to_point()
    }

    /// The first corners of all squares. Columns run along, rows across, which is down the page as in SVG.
    fn cells(&self) -> impl Iterator<Item = [f64; 2]> {
        let of_row =
            move |row: i64| self.columns.clone().map(move |column| [column as f64, row as f64 * self.height]);
        self.rows.clone().flat_map(of_row)
    }

    /// The shapes of all tiles, in page coordinates.
    fn shapes(&self, tile: &Tile) -> Vec<Vec<Vec<Point>>> {
        let placed = |[x, y]: [f64; 2]| {
            let point = move |p: &Point| self.at(x + p.x, y + p.y);
            let rings = move |rings: &Vec<Vec<Point>>| {
                rings.iter().map(|ring| ring.iter().map(point).collect()).collect::<Vec<_>>()
            };
            tile.shapes.iter().map(rings).collect::<Vec<_>>()
        };
        self.cells().flat_map(placed).collect()
    }
}

/// The lines of a pattern that is fixed to the page, over a box of it.
fn page_lines(own: &Pattern, size: f64, angle: f64, corners: [Point; 2]) -> Vec<Vec<Point>> {
    let height = if own.kind == PatternKind::Tile { own.tile.height } else { 1.0 };
    if height <= 0.0 {
        return Vec::new();
    }
    let placing = TilePlacement::new(size, angle, height, corners);
    let at = |x: f64, y: f64| placing.at(x, y);
    let tile: Vec<Vec<Point>> = match own.kind {
        PatternKind::Lines | PatternKind::Dots => {
            let (from, to) = (*placing.columns.start() as f64, *placing.columns.end() as f64);
            let rows = placing.rows.clone();
            return rows.map(|row| vec![at(from, row as f64), at(to, row as f64)]).collect();
        }
        PatternKind::Crosses => {
            let arm = |x: f64, y: f64| vec![Point::new(0.5 - x, 0.5 - y), Point::new(0.5 + x, 0.5 + y)];
            vec![arm(CROSS_ARM_OF_SQUARE, 0.0), arm(0.0, CROSS_ARM_OF_SQUARE)]
        }
        PatternKind::Tile => own.tile.lines.clone(),
    };
    let placed = |[x, y]: [f64; 2]| {
        tile.iter().map(move |line| line.iter().map(|p| at(x + p.x, y + p.y)).collect()).collect::<Vec<_>>()
    };
    placing.cells().flat_map(placed).collect()
}

/// Collects paths in cells into marks. They are filled unless they have a width.
fn marks_by_look(
    paths: impl Iterator<Item = (u32, BezPath)>,
    ground: &HatchRegions,
    context: &HatchContext,
    own: &Pattern,
    width: Option<f64>,
) -> Vec<Mark> {
    let mut sets: BTreeMap<(PartId, MaterialId, u16), (SurfaceLabel, BezPath)> = BTreeMap::new();
    for (cell, path) in paths {
        let label = ground.cells[cell as usize].look;
        let set =
            sets.entry((label.part, label.material, label.tone)).or_insert_with(|| (label, BezPath::new()));
        set.1.extend(path);
    }
    let mark = |(surface_label, path): (SurfaceLabel, BezPath)| {
        let mut ink = colour(own.colour, surface_label, context);
        ink.a = (f64::from(ink.a) * own.opacity).round() as u8;
        let paint = match width {
            None => Paint::Fill(ink),
            Some(width) => Paint::Stroke(StrokePaint::solid(width, ink, Cap::Butt, Join::Round)),
        };
        let provenance = Provenance { classes: vec!["pattern"], ..provenance(surface_label, context) };
        Mark { path, paint, provenance }
    };
    sets.into_values().map(mark).collect()
}
