//! Guides along curves fixed to the model. Hatching then moves with the model and does not swim when the
//! camera turns.
//!
//! Such curves crowd where the surface turns away from the eye. Guides of high rank are dropped there, so the
//! spacing of the remaining ones matches the tone. As the view changes, strokes appear and disappear but
//! never jump.
//!
//! Source: Praun, Hoppe, Webb and Finkelstein, "Real-time hatching", SIGGRAPH 2001, section 4, where texture
//! levels of detail have this role.

use glam::DVec3;
use kurbo::Point;
use rustc_hash::FxHashMap;

use super::guide::{Guide, GuideScope, rank};
use crate::geometry::numbers::noise::hash;
use crate::hatching::clip::line_clip::{clip_to_cells, sub_polyline};
use crate::mesh::PartId;
use crate::regions::HatchRegions;
use crate::regions::surface_curves::level_curves::LevelCurve;

/// Guides along the visible parts of level curves, `pitch` page units apart where they are densest.
///
/// `are_seen` takes page points, each with a nearness. For each it returns whether nothing is in front.
/// `place_of` returns a number for a part and a rough position in it.
#[must_use]
pub(crate) fn guides_along_curves(
    ground: &HatchRegions,
    curves: &[LevelCurve],
    are_seen: impl Fn(&[(Point, f64)]) -> Vec<bool>,
    place_of: impl Fn(PartId, DVec3) -> u64,
    pitch: f64,
    seed: u64,
) -> Vec<Guide> {
    let mut pieces: Vec<(u32, f64, f64, u32)> = Vec::new();
    for (number, curve) in curves.iter().enumerate() {
        let on_part = |cell: u32| {
            let cell = &ground.cells[cell as usize];
            cell.facet != 0 && cell.look.part == curve.part
        };
        for stretch in clip_to_cells(ground, &curve.line, on_part) {
            pieces.push((number as u32, stretch.from, stretch.to, ground.cells[stretch.cell as usize].facet));
        }
    }
    let middles: Vec<(Point, f64)> = pieces
        .iter()
        .map(|(curve, from, to, _)| {
            let curve = &curves[*curve as usize];
            let middle_position = f64::midpoint(*from, *to);
            (
                crate::hatching::clip::line_clip::point_at(&curve.line, middle_position),
                value_at(&curve.nearness, middle_position),
            )
        })
        .collect();
    let is_visible = are_seen(&middles);
    let mut counts: FxHashMap<u64, u64> = FxHashMap::default();
    let mut guides = Vec::new();
    for ((number, from, to, facet), _) in pieces.into_iter().zip(is_visible).filter(|(_, seen)| *seen) {
        let curve = &curves[number as usize];
        let line = sub_polyline(&curve.line, from, to);
        if line.len() < 2 {
            continue;
        }
        // One crowding value for each remaining point.
        let mut crowding = vec![value_at(&curve.density, from) * pitch];
        let inner = (from.floor() as usize + 1..curve.line.len()).take_while(|k| (*k as f64) < to);
        crowding.extend(inner.map(|k| curve.density[k] * pitch));
        crowding.push(value_at(&curve.density, to) * pitch);
        crowding.resize(line.len(), value_at(&curve.density, to) * pitch);
        // The identity of a piece comes from its part, its level and its rough position in the model.
        let middle = point_at(&curve.points, f64::midpoint(from, to));
        let name = hash(seed, &[place_of(curve.part, middle), curve.level.cast_unsigned()]);
        let count = counts.entry(name).or_default();
        let id = hash(name, &[*count]);
        *count += 1;
        guides.push(Guide { line, rank: rank(curve.level), id, scope: GuideScope::Facet(facet), crowding });
    }
    guides
}

fn value_at(values: &[f64], place: f64) -> f64 {
    let k = (place as usize).min(values.len() - 2);
    values[k] + (values[k + 1] - values[k]) * (place - k as f64)
}

fn point_at(points: &[DVec3], place: f64) -> DVec3 {
    let k = (place as usize).min(points.len() - 2);
    points[k].lerp(points[k + 1], place - k as f64)
}
