//! Patterns over tones: dots, lines, crosses and tiles, cut where their tone ends.
//!
//! Dots are cut as those of half-tone screens are, lines as strokes are: exactly, where they cross the borders of the ground.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use kurbo::{BezPath, Point, Vec2};
use rayon::prelude::*;

use super::clip::{between, stretches};
use super::dots::{DotScreen, ToneBorders, dots};
use super::guide::{Guide, axes};
use super::pattern_options::{Pattern, PatternKind};
use super::{HatchContext, colour, provenance};
use crate::drawing::{Cap, Join, Length, Mark, Paint, Provenance, StrokePaint};
use crate::mesh::{MaterialId, PartId};
use crate::region::{Ground, Look};

/// Patterns of more lines, crosses or tiles than this are too fine to be seen, and are made coarser.
const MOST: f64 = 2e5;

/// The arms of a cross, as part of its square.
const ARM: f64 = 0.3;

/// The marks of a pattern, one for each part, material and tone. `tones` says how many tones there are where something looks so;
/// `guides` are the lines of a pattern that is fixed to the surface.
#[must_use]
pub fn pattern(
    ground: &Ground,
    context: &HatchContext,
    own: &Pattern,
    tones: impl Fn(&Look) -> u16,
    guides: Option<&[Guide]>,
) -> Vec<Mark> {
    let wanted: Vec<bool> = ground
        .cells
        .iter()
        .map(|cell| {
            let name = context.materials.get(cell.look.material.index()).map_or("", |(name, _)| name);
            cell.facet != 0 && own.is_for(name, cell.look.tone, tones(&cell.look))
        })
        .collect();
    let Some([low, high]) = extent(ground, &wanted) else { return Vec::new() };
    let long = |length: Length| length.in_unit(context.unit);
    let size = long(own.size).max(((high.x - low.x) * (high.y - low.y) / MOST).sqrt());
    let angle = own.angle.to_radians();
    if own.kind == PatternKind::Dots {
        let radius = long(own.width) / 2.0 / size;
        let covered = (PI * radius * radius).min(1.0);
        let screen = DotScreen {
            pitch: size,
            angle: -angle,
            origin: Point::ZERO,
            tone_borders: ToneBorders::Cut,
            px: long(Length::px(1.0)),
        };
        let coverage = |cell: u32, _: Point| if wanted[cell as usize] { covered } else { 0.0 };
        let found = dots(ground, &screen, &coverage).into_iter();
        return gathered(found.map(|dots| (dots.cell, dots.path)), ground, context, own, None);
    }
    let lines: Vec<Vec<Point>> = match guides {
        Some(guides) => guides.iter().map(|guide| guide.line.clone()).collect(),
        None => on_page(own, size, angle, [low, high]),
    };
    let cut = |line: &Vec<Point>| -> Vec<(u32, BezPath)> {
        let seen = stretches(ground, line, |cell| wanted[cell as usize]);
        seen.into_iter().map(|s| (s.cell, polyline(&between(line, s.from, s.to)))).collect()
    };
    let cut: Vec<Vec<(u32, BezPath)>> = lines.par_iter().with_min_len(16).map(cut).collect();
    gathered(cut.into_iter().flatten(), ground, context, own, Some(long(own.width)))
}

/// The box around the wanted cells.
fn extent(ground: &Ground, wanted: &[bool]) -> Option<[Point; 2]> {
    let pieces = ground.pieces.iter().filter(|piece| piece.sides.iter().any(|cell| wanted[*cell as usize]));
    let ends = pieces.flat_map(|piece| piece.ends);
    ends.fold(None, |found: Option<[Point; 2]>, p| {
        let [low, high] = found.unwrap_or([p, p]);
        Some([Point::new(low.x.min(p.x), low.y.min(p.y)), Point::new(high.x.max(p.x), high.y.max(p.y))])
    })
}

/// The lines of a pattern that is fixed to the page, over a box of it.
fn on_page(own: &Pattern, size: f64, angle: f64, [low, high]: [Point; 2]) -> Vec<Vec<Point>> {
    let [along, across] = axes(angle);
    let corners = [low, Point::new(high.x, low.y), high, Point::new(low.x, high.y)].map(Point::to_vec2);
    let range = |axis: Vec2| {
        let values = corners.map(|corner| corner.dot(axis) / size);
        let least = values.into_iter().fold(f64::INFINITY, f64::min).floor() as i64;
        least - 1..=values.into_iter().fold(f64::NEG_INFINITY, f64::max).ceil() as i64
    };
    let at = |x: f64, y: f64| ((along * x + across * y) * size).to_point();
    let (columns, rows) = (range(along), range(across));
    let tile: Vec<Vec<Point>> = match own.kind {
        PatternKind::Lines | PatternKind::Dots => {
            let (from, to) = (*columns.start() as f64, *columns.end() as f64);
            return rows.map(|row| vec![at(from, row as f64), at(to, row as f64)]).collect();
        }
        PatternKind::Crosses => {
            let arm = |x: f64, y: f64| vec![Point::new(0.5 - x, 0.5 - y), Point::new(0.5 + x, 0.5 + y)];
            vec![arm(ARM, 0.0), arm(0.0, ARM)]
        }
        // Rows of a tile run down the page, as in SVG.
        PatternKind::Tile => {
            own.path.iter().map(|line| line.iter().map(|p| Point::new(p.x, -p.y)).collect()).collect()
        }
    };
    let cells = rows.flat_map(|row| columns.clone().map(move |column| [column as f64, row as f64]));
    let placed = |[x, y]: [f64; 2]| {
        tile.iter().map(move |line| line.iter().map(|p| at(x + p.x, y + p.y)).collect()).collect::<Vec<_>>()
    };
    cells.flat_map(placed).collect()
}

fn polyline(points: &[Point]) -> BezPath {
    let mut path = BezPath::new();
    let mut points = points.iter();
    if let Some(first) = points.next() {
        path.move_to(*first);
        points.for_each(|p| path.line_to(*p));
    }
    path
}

/// Paths in cells as marks; filled unless they have a width.
fn gathered(
    paths: impl Iterator<Item = (u32, BezPath)>,
    ground: &Ground,
    context: &HatchContext,
    own: &Pattern,
    width: Option<f64>,
) -> Vec<Mark> {
    let mut sets: BTreeMap<(PartId, MaterialId, u16), (Look, BezPath)> = BTreeMap::new();
    for (cell, path) in paths {
        let look = ground.cells[cell as usize].look;
        let set = sets.entry((look.part, look.material, look.tone)).or_insert_with(|| (look, BezPath::new()));
        set.1.extend(path);
    }
    let mark = |(look, path): (Look, BezPath)| {
        let mut ink = colour(own.colour, look, context);
        ink.a = (f64::from(ink.a) * own.opacity).round() as u8;
        let paint = match width {
            None => Paint::Fill(ink),
            Some(width) => Paint::Stroke(StrokePaint {
                width,
                colour: ink,
                cap: Cap::Butt,
                join: Join::Round,
                dash: Vec::new(),
                dash_offset: 0.0,
            }),
        };
        let provenance = Provenance { classes: vec!["pattern"], ..provenance(look, context) };
        Mark { path, paint, provenance }
    };
    sets.into_values().map(mark).collect()
}
