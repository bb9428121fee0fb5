//! Interior lines: suggestive contours, ridges and valleys, which show the shape of a surface between its
//! contours.
//!
//! 1. Each finder turns the surface's curvature into a curve over the mesh and a measure along it.
//! 2. The measure is 1 at the threshold below which nothing is drawn. Curves are cut where it passes 1.
//! 3. The measure above 1 gives the line its strength, and so its width.
//!
//! Thresholds are relative to the size of the model's features, so that no style depends on the model's unit.
//! Source: the measures follow Rusinkiewicz's rtsc; each finder names its paper.
//!
//! Files, in reading order: [`interior_options`]; [`suggestive_contours`]; [`ridges`] ridges and valleys;
//! [`apparent_ridges`].

mod apparent_ridges;
pub(crate) mod interior_options;
mod ridges;
mod suggestive_contours;

use crate::parallel::prelude::*;
use glam::DVec3;

pub(crate) use interior_options::InsideOptions;

use super::zero_set::{EdgePoint, ZeroSet};
use crate::lines::tolerances;
use crate::lines::{FeatureLines, FeatureSegment, LineKind, LineOptions, NO_FACE};
use crate::mesh::Mesh;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::curvature::feature_size::MAX_FEATURE_OF_PART;
use crate::surface::{Curvature, SmoothNormals};
use crate::view::View;

/// Smallest measure of a line with full strength.
const FULL_STRENGTH_MEASURE: f64 = 8.0;

const NO_POINT: u32 = u32::MAX;

/// Whether any interior line is drawn.
#[must_use]
pub(crate) fn has_interior_lines(options: &LineOptions) -> bool {
    options.kinds.iter().any(|kind| kind.is_inside())
}

/// Curvature used for the interior lines of a mesh.
#[must_use]
pub(crate) fn curvature(mesh: &Mesh, smooth: &SmoothNormals, options: &InsideOptions) -> Curvature {
    Curvature::new(mesh, smooth, options.smooth * MAX_FEATURE_OF_PART)
}

/// Adds the interior lines of the wanted kinds.
pub(crate) fn find(
    mesh: &Mesh,
    view: &View,
    smooth: &SmoothNormals,
    curvature: &Curvature,
    options: &LineOptions,
    lines: &mut FeatureLines,
) {
    let seen = CurvatureView::new(mesh, view, smooth, curvature);
    let wants = |kind| options.kinds.contains(&kind);
    if wants(LineKind::Suggestive) {
        suggestive_contours::find(&seen, &options.inside, lines);
    }
    if options.inside.apparent && wants(LineKind::Ridge) {
        apparent_ridges::find(&seen, &options.inside, lines);
    }
    let ridges = wants(LineKind::Ridge) && !options.inside.apparent;
    if ridges || wants(LineKind::Valley) {
        ridges::find(&seen, ridges, wants(LineKind::Valley), &options.inside, lines);
    }
}

/// Surface with its curvature and view directions.
pub(crate) struct CurvatureView<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    smooth: &'a SmoothNormals,
    curvature: &'a Curvature,
    /// Whether the inside of surfaces may be visible.
    open: bool,
    /// Direction to the camera in the basis `dir1`, `dir2`, normal; one per smooth vertex.
    eye: Vec<DVec3>,
}

impl<'a> CurvatureView<'a> {
    fn new(mesh: &'a Mesh, view: &'a View, smooth: &'a SmoothNormals, curvature: &'a Curvature) -> Self {
        let frame = &view.frame;
        let eye = (0..smooth.vertices.len())
            .into_par_iter()
            .with_min_len(MIN_TASK_ITEMS)
            .map(|v| {
                let at = mesh.positions[smooth.vertices[v] as usize];
                let to_eye =
                    if frame.perspective { (frame.eye - at).normalize_or_zero() } else { -frame.forward };
                let p = &curvature.principal[v];
                DVec3::new(to_eye.dot(p.dir1), to_eye.dot(p.dir2), to_eye.dot(curvature.normals[v]))
            })
            .collect();
        // Where the near plane cuts a surface open, its inside is visible.
        let is_cut = !view.clipped.is_empty() || view.points.iter().any(|p| p.z.is_nan());
        Self { mesh, view, smooth, curvature, open: mesh.cleaning.borders > 0 || is_cut, eye }
    }

    /// Feature size around a point, world units.
    fn size(&self, point: &EdgePoint) -> f64 {
        self.curvature.feature_size(point.between[0])
    }

    /// A value for each smooth vertex.
    fn field(&self, value: impl Fn(usize) -> f64 + Sync + Send) -> Vec<f64> {
        (0..self.eye.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS).map(value).collect()
    }

    /// Whether a face can be visible.
    fn shows(&self, face: u32) -> bool {
        self.open || self.view.facing[face as usize]
    }

    /// 1 if the outside of a face is seen, −1 for the inside, where the curvature has the opposite sign.
    fn side(&self, face: u32) -> f64 {
        if self.view.facing[face as usize] { 1.0 } else { -1.0 }
    }

    /// Adds the parts of a curve where the measure exceeds 1.
    fn add(
        &self,
        set: &ZeroSet,
        kind: impl Fn(u32) -> Option<LineKind>,
        measure: impl Fn(&EdgePoint, f64) -> f64,
        lines: &mut FeatureLines,
    ) {
        let first = self.mesh.positions.len() as u32;
        lines.strengths.resize(lines.points.len(), 1.0);
        let mut ids = vec![NO_POINT; set.points.len()];
        for segment in &set.segments {
            let Some(kind) = kind(segment.face) else { continue };
            let side = self.side(segment.face);
            let ends = segment.ends.map(|end| &set.points[end as usize]);
            let measures = ends.map(|end| measure(end, side));
            let whole = measures.map(|m| m > 1.0);
            if whole == [false, false] {
                continue;
            }
            let positions = ends.map(|end| end.position(self.mesh, self.smooth));
            let mut point = |at: DVec3, strength: f64| {
                lines.points.push(at);
                lines.strengths.push(strength as f32);
                first + lines.points.len() as u32 - 1
            };
            let ends = [0, 1].map(|i| {
                if !whole[i] {
                    let t = (1.0 - measures[1 - i]) / (measures[i] - measures[1 - i]);
                    return point(positions[1 - i].lerp(positions[i], t.clamp(0.0, 1.0)), 0.0);
                }
                let id = &mut ids[segment.ends[i] as usize];
                if *id == NO_POINT {
                    *id = point(positions[i], strength(measures[i]));
                }
                *id
            });
            lines.segments.push(FeatureSegment {
                smooth: true,
                strength: 0.0,
                ..FeatureSegment::on_face(self.mesh, segment.face, [segment.face, NO_FACE], kind, ends)
            });
        }
    }
}

/// Threshold that is safe to divide by.
fn positive(threshold: f64) -> f64 {
    threshold.max(tolerances::MIN_LINE_THRESHOLD)
}

/// Strength of a line with the given measure: 0 at 1, and 1 from [`FULL_STRENGTH_MEASURE`] on.
fn strength(measure: f64) -> f64 {
    ((1.0 - 1.0 / measure) / (1.0 - 1.0 / FULL_STRENGTH_MEASURE)).clamp(0.0, 1.0)
}
