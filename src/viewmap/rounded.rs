//! Visibility of the contours of rounded surfaces, put in the place of what single faces say.

use rayon::prelude::*;

use super::arcs::{self, Judge, Run};
use super::events::{self, Scene};
use super::graph::ArcCounts;
use super::grid::Grid;
use super::layers::Layer;
use super::project::ImageSegment;
use super::visibility::Visibility;
use crate::lines::FeatureLines;
use crate::mesh::Mesh;
use crate::mesh::solid::solid_parts;
use crate::view::View;

const NONE: u32 = u32::MAX;

/// The hidden pieces of all contours of rounded surfaces: one list per image segment, ascending, for
/// those that `is_rounded`.
pub(super) struct Rounded {
    /// Hidden pieces by image segment.
    pub hidden: Vec<(u32, Layer)>,
    /// How they were decided.
    pub counts: ArcCounts,
}

/// Decides them, from what faces hide of the lifted segments.
pub(super) fn decide(
    mesh: &Mesh,
    view: &View,
    lines: &FeatureLines,
    segments: &[ImageSegment],
    seen: &Visibility,
    grid: &Grid,
    px: f64,
) -> Rounded {
    let image_of = image_of(lines, segments);
    let advance = advance(lines, segments, &image_of);
    let scene = Scene { mesh, view, segments, sources: &lines.segments, advance: &advance };
    let events = events::find(&scene, grid);
    let runs = runs(mesh, lines, segments, &image_of);
    let alone = mesh.face_part.windows(2).all(|pair| pair[0] == pair[1]);
    let judge = Judge { scene: &scene, events: &events, seen, alone, px };
    let decided: Vec<(arcs::Decided, ArcCounts)> = runs
        .par_iter()
        .with_min_len(8)
        .map(|run| {
            let mut counts = ArcCounts::default();
            (judge.decide(run, &mut counts), counts)
        })
        .collect();
    let mut counts = ArcCounts::default();
    let mut hidden = Vec::new();
    for (own, of_run) in decided {
        counts = counts.plus(of_run);
        hidden.extend(own);
    }
    hidden.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.interval.start.total_cmp(&b.1.interval.start)));
    Rounded { hidden, counts }
}

/// The image segment of each feature segment, where it has one.
pub(super) fn image_of(lines: &FeatureLines, segments: &[ImageSegment]) -> Vec<u32> {
    let mut image_of = vec![NONE; lines.segments.len()];
    for (i, segment) in segments.iter().enumerate() {
        image_of[segment.source as usize] = i as u32;
    }
    image_of
}

/// [`crate::lines::ContourCurve::advance`] by image segment; 0 for all that is no such contour.
pub(super) fn advance(lines: &FeatureLines, segments: &[ImageSegment], image_of: &[u32]) -> Vec<f32> {
    let mut advance = vec![0.0; segments.len()];
    for curve in &lines.curves {
        for (source, value) in curve.segments.clone().zip(&curve.advance) {
            if let Some(of_image) = advance.get_mut(image_of[source as usize] as usize) {
                *of_image = *value;
            }
        }
    }
    advance
}

/// What the image shows of each contour curve.
pub(super) fn runs(
    mesh: &Mesh,
    lines: &FeatureLines,
    segments: &[ImageSegment],
    image_of: &[u32],
) -> Vec<Run> {
    let solid = solid_parts(mesh);
    let of_curve = |curve| {
        let curve: &crate::lines::ContourCurve = curve;
        let part = lines.segments[curve.segments.start as usize].part;
        let image = |source: u32| Some(image_of[source as usize]).filter(|id| *id != NONE);
        arcs::runs(curve, solid.get(part.index()) == Some(&true), segments, image)
    };
    lines.curves.iter().flat_map(of_curve).collect()
}

impl Rounded {
    /// The hidden pieces of an image segment.
    pub(super) fn of(&self, segment: u32) -> impl Iterator<Item = Layer> + '_ {
        let first = self.hidden.partition_point(|(s, _)| *s < segment);
        self.hidden[first..].iter().take_while(move |(s, _)| *s == segment).map(|(_, layer)| *layer)
    }
}
