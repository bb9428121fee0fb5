//! [`label_points`]: labels of points of the image.

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};

use super::surface_label::{NO_LABEL, ShadowDarkening, SurfaceLabel};
use crate::lines::Lit;
use crate::visibility::{FrontFace, front_faces};

/// Points per task. Consecutive points are close together and mostly look alike.
const POINTS_PER_TASK: usize = 1 << 9;

/// Labels of a batch of points: the distinct labels, and for each point [`NO_LABEL`] or an index plus 1.
struct LabelBatch {
    labels: Vec<SurfaceLabel>,
    numbers: Vec<u32>,
}

/// Labels points of the image: for each [`NO_LABEL`], or an index into the table plus 1.
///
/// `shadowed` returns a mask of the lights that do not reach each point; `None` if nothing casts shadows.
/// There is a point for each triangle of the page, so only the index is stored per point.
pub(crate) fn label_points(
    lit: &Lit,
    points: &[DVec2],
    shadowed: Option<impl Fn(&[(u32, DVec3)]) -> Vec<u32>>,
    darkened: ShadowDarkening,
) -> (Vec<u32>, Vec<SurfaceLabel>) {
    let fronts = front_faces(lit.mesh, lit.view, points);
    let position_on =
        |front: &FrontFace, p: &DVec2| lit.view.frame.local_from_image(p.extend(front.nearness));
    let masks = shadowed.map(|shadowed| {
        let visible_points = || fronts.iter().zip(points).filter_map(|(front, p)| Some((front.as_ref()?, p)));
        let shadow_queries: Vec<(u32, DVec3)> =
            visible_points().map(|(front, p)| (front.face, position_on(front, p))).collect();
        let mut masks = shadowed(&shadow_queries).into_iter();
        let of_point =
            |front: &Option<FrontFace>| front.as_ref().and_then(|_| masks.next()).unwrap_or_default();
        fronts.iter().map(of_point).collect::<Vec<u32>>()
    });
    let look_at = |k: usize| {
        let front = fronts[k].as_ref()?;
        let shadowed = masks.as_ref().map_or(0, |masks| masks[k]);
        Some(label_at(lit, front.face, position_on(front, &points[k]), shadowed, darkened))
    };
    let some: Vec<LabelBatch> = (0..points.len().div_ceil(POINTS_PER_TASK))
        .into_par_iter()
        .with_max_len(1)
        .map(|task| {
            LabelBatch::of(
                (task * POINTS_PER_TASK..((task + 1) * POINTS_PER_TASK).min(points.len())).map(look_at),
            )
        })
        .collect();
    let distinct_labels: FxHashSet<SurfaceLabel> =
        some.iter().flat_map(|some| &some.labels).copied().collect();
    let mut table: Vec<SurfaceLabel> = distinct_labels.into_iter().collect();
    table.sort_unstable();
    let mut numbers = Vec::with_capacity(points.len());
    for LabelBatch { labels: looks, numbers: batch_numbers } in some {
        let number = |look: &SurfaceLabel| table.binary_search(look).map_or(NO_LABEL, |at| at as u32 + 1);
        let of: Vec<u32> = looks.iter().map(number).collect();
        numbers.extend(
            batch_numbers.iter().map(|own| own.checked_sub(1).map_or(NO_LABEL, |own| of[own as usize])),
        );
    }
    (numbers, table)
}

impl LabelBatch {
    fn of(point_labels: impl Iterator<Item = Option<SurfaceLabel>>) -> Self {
        let (mut batch_labels, mut known) = (Vec::new(), FxHashMap::default());
        // Consecutive points mostly have the same label.
        let mut last = (None, NO_LABEL);
        let numbers = point_labels.map(|point_label| {
            if point_label != last.0 {
                let number = point_label.map_or(NO_LABEL, |look| {
                    *known.entry(look).or_insert_with(|| {
                        batch_labels.push(look);
                        batch_labels.len() as u32
                    })
                });
                last = (point_label, number);
            }
            last.1
        });
        let numbers = numbers.collect();
        Self { labels: batch_labels, numbers }
    }
}

/// Label of a face at a point on it.
fn label_at(lit: &Lit, face: u32, at: DVec3, shadowed: u32, darkened: ShadowDarkening) -> SurfaceLabel {
    let mesh = lit.mesh;
    let (material, paint) = (mesh.face_material[face as usize], lit.paint(face, at));
    let point = lit.at(face, at);
    let (tone_lit, bin_lit) = lit.tone_and_bin_shown(face, paint, &point, 0);
    let (tone_dark, bin_dark) = if shadowed == 0 {
        (tone_lit, bin_lit)
    } else {
        lit.tone_and_bin_shown(face, paint, &point, shadowed)
    };
    let tone = if darkened.tones { tone_dark } else { tone_lit };
    let bin = if darkened.bins { bin_dark } else { bin_lit };
    let cast = tone != tone_lit;
    SurfaceLabel { part: mesh.face_part[face as usize], material, paint, tone, bin, cast }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{MaterialId, PaintId, PartId};

    #[test]
    fn label_batch_numbers_distinct_labels_and_leaves_paper_unlabelled() {
        let look = |tone| SurfaceLabel {
            part: PartId(0),
            material: MaterialId(0),
            paint: PaintId(0),
            tone,
            bin: 0,
            cast: tone == 9,
        };
        let seen = [3, 3, 0, 9, 0, 0, 3, 7, 9].map(|tone| (tone > 0).then(|| look(tone)));
        let LabelBatch { labels: looks, numbers } = LabelBatch::of(seen.into_iter());
        assert_eq!(looks, [3, 9, 7].map(look));
        let back = numbers.iter().map(|number| number.checked_sub(1).map(|k| looks[k as usize]));
        assert!(back.eq(seen) && numbers[2] == NO_LABEL);
        assert!(LabelBatch::of(std::iter::empty()).numbers.is_empty());
    }
}
