//! Isophotes: curves where the tone of the surface changes, traced through the faces.
//!
//! Source: Claes, Di Fiore, Vansichem and Van Reeth, "Fast 3D cartoon rendering with improved quality by
//! exploiting graphics hardware", IVCNZ 2001, sections 3.5 and 3.6. There triangles are cut by the tones at
//! their corners and at the centroid where three tones meet. Deviations: any number of levels is traced.
//! Light is evaluated with the interpolated unit normal where it is not linear. So borders are right inside
//! large faces too.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::level_tracer::{FaceExtents, FaceSample, LevelSegment, LevelTracer};
use super::tone_changes::TraceReason;
use crate::light::{LightSlope, SurfacePoint};
use crate::lines::feature_line::segment;
use crate::lines::isophotes::culling::covered_faces::visible_faces_of;
use crate::lines::isophotes::culling::tone_faces::faces_with_borders;
use crate::lines::tolerances;
use crate::lines::{FeatureLines, LineKind, Lit, NO_FACE};
use crate::mesh::bvh::ToneTree;
use crate::mesh::{FaceId, PaintId};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Adds the isophotes of a lit surface, for each of the given sets of shadowed lights.
///
/// With `sees_through` gradients get steps on covered faces too. With a `tree` over the shading normals, only
/// the faces that it finds are examined where it applies. Returns the reason for each added segment, in
/// order.
pub(crate) fn find(
    lit: &Lit,
    shadowed: &[u32],
    sees_through: bool,
    tree: Option<&ToneTree>,
    lines: &mut FeatureLines,
) -> Vec<TraceReason> {
    const FACES_PER_TASK: usize = 1 << 9;
    let holding = tree.and_then(|tree| faces_with_borders(lit.shading, tree));
    let count = holding.as_ref().map_or(lit.mesh.triangles.len(), Vec::len);
    let ready = ShadingTables::new(lit, shadowed, sees_through);
    let found: Vec<(Vec<LevelSegment>, Vec<TraceReason>)> = (0..count.div_ceil(FACES_PER_TASK))
        .into_par_iter()
        .with_max_len(1)
        .map(|chunk| {
            let mut tracer = IsophoteTracer::new(lit, &ready);
            for index in chunk * FACES_PER_TASK..((chunk + 1) * FACES_PER_TASK).min(count) {
                let face = holding.as_ref().map_or(index, |faces| faces[index] as usize);
                if lit.may_be_seen(face) && !lit.mesh.is_degenerate(FaceId(face as u32)) {
                    tracer.trace(face as u32, shadowed);
                }
            }
            (tracer.found, tracer.traced)
        })
        .collect();
    let (found, traced): (Vec<Vec<LevelSegment>>, Vec<Vec<TraceReason>>) = found.into_iter().unzip();
    let piece = |(face, ends): LevelSegment| (face, LineKind::Isophote, ends);
    lines.append_in_faces(lit.mesh, &found, piece, |face, kind, ends| {
        segment(lit.mesh, face, [face, NO_FACE], kind, ends)
    });
    traced.concat()
}

struct IsophoteTracer<'a> {
    lit: &'a Lit<'a>,
    ready: &'a ShadingTables,
    found: Vec<LevelSegment>,
    /// Reason for each piece in `found`.
    traced: Vec<TraceReason>,
}

/// Tables that are the same for all faces.
struct ShadingTables {
    /// A CSS px in user units.
    px: f64,
    /// For each channel and set of shadowed lights, the light at every normal, with the outside and with the
    /// inside to the camera; empty if light depends on position.
    values: Vec<Vec<[Vec<f64>; 2]>>,
    /// For each channel, whether light depends on position.
    is_local: Vec<bool>,
    /// Bound on the change of the other channels with the normal.
    slope: LightSlope,
    /// Whether each face may be visible; used for gradients, empty if unknown.
    in_sight: Vec<bool>,
}

/// A CSS px in user units, on a page of nominal size.
pub(crate) fn page_px(lit: &Lit) -> f64 {
    lit.view.frame.width.max(lit.view.frame.height) / NOMINAL_PAGE_PX
}

impl ShadingTables {
    fn new(lit: &Lit, shadowed: &[u32], sees_through: bool) -> Self {
        // The light does not depend on the paint.
        let paint = PaintId(0);
        let value = |channel: usize, normal: DVec3, shadowed: u32| {
            let point = SurfacePoint { position: DVec3::ZERO, normal, ambient_visibility: 1.0 };
            lit.shading.value(channel, paint, &point, shadowed)
        };
        let of = |channel: usize, shadowed: u32| {
            if lit.shading.is_local(channel) {
                return [Vec::new(), Vec::new()];
            }
            [1.0, -1.0].map(|side| {
                let normals = lit.normals.normals.par_iter().with_min_len(MIN_TASK_ITEMS);
                normals.map(|normal| value(channel, *normal * side, shadowed)).collect()
            })
        };
        let channels = 0..lit.shading.channels();
        Self {
            px: page_px(lit),
            is_local: channels.clone().map(|channel| lit.shading.is_local(channel)).collect(),
            slope: lit.shading.slope(),
            values: channels.map(|c| shadowed.iter().map(|s| of(c, *s)).collect()).collect(),
            in_sight: if lit.shading.most_levels() > crate::light::tolerances::MAX_SEPARATE_LEVELS
                && !sees_through
            {
                visible_faces_of(lit.mesh, lit.view)
            } else {
                Vec::new()
            },
        }
    }
}

impl<'a> IsophoteTracer<'a> {
    fn new(lit: &'a Lit<'a>, ready: &'a ShadingTables) -> Self {
        Self { lit, ready, found: Vec::new(), traced: Vec::new() }
    }

    /// Whether no level can cross a face, from the light at its corners and the turn of its normals.
    fn is_even(
        &self,
        face: u32,
        normals: &[DVec3; 3],
        levels: &[f64],
        channel: usize,
        shadow: usize,
    ) -> bool {
        let [outside, inside] = &self.ready.values[channel][shadow];
        let values = if self.lit.view.facing[face as usize] { outside } else { inside };
        if values.is_empty() {
            return false;
        }
        let [a, b, c] = self.lit.normals.corners[face as usize];
        let (a, b, c) = (values[a as usize], values[b as usize], values[c as usize]);
        let [n, m, o] = normals;
        let turn2 = n.distance_squared(*m).max(m.distance_squared(*o)).max(o.distance_squared(*n));
        let [low, high] = self.ready.slope.between([a.min(b).min(c), a.max(b).max(c)], turn2.sqrt());
        levels.partition_point(|level| *level < low) == levels.partition_point(|level| *level <= high)
    }

    fn trace(&mut self, face: u32, shadowed: &[u32]) {
        let Lit { mesh, normals, shading, .. } = self.lit;
        let n = normals.of(face);
        let is_flat = n[0] == n[1] && n[1] == n[2];
        let own = [mesh.paint(FaceId(face))];
        let shown = self.paints_shown(face);
        let paints = shown.as_deref().unwrap_or(&own);
        let mut measures = None;
        for channel in 0..shading.channels() {
            if is_flat && !self.ready.is_local[channel] {
                continue;
            }
            for (k, paint) in paints.iter().enumerate() {
                let levels = shading.levels(*paint, channel);
                if levels.is_empty() || paints[..k].iter().any(|p| shading.levels(*p, channel) == levels) {
                    continue;
                }
                let is_hidden = || self.ready.in_sight.get(face as usize) == Some(&false);
                if self.lit.is_gradient(channel, levels) && is_hidden() {
                    continue;
                }
                for (shadow, shadowed) in shadowed.iter().enumerate() {
                    if self.is_even(face, &n, levels, channel, shadow) {
                        continue;
                    }
                    let measures = *measures.get_or_insert_with(|| self.measures(face, &n));
                    let band = self.band((face, &n), measures, channel, levels, *shadowed);
                    let nodes = [0, 1, 2].map(|k| self.corner(&band, k, shadow));
                    band.trace(nodes, &mut self.found);
                    self.traced.resize(self.found.len(), TraceReason { channel, shadowed: *shadowed });
                }
            }
        }
    }

    /// Lengths and turns along the sides of a face.
    fn measures(&self, face: u32, n: &[DVec3; 3]) -> FaceExtents {
        let Lit { mesh, view, .. } = self.lit;
        let corners = mesh.triangles[face as usize].map(|v| view.points[v as usize]);
        let length = |i: usize, j: usize| {
            let way = corners[j].truncate() - corners[i].truncate();
            // A side that the near plane cuts has unlimited length.
            if way.is_nan() || corners[i].z.is_nan() || corners[j].z.is_nan() {
                f64::INFINITY
            } else {
                way.length()
            }
        };
        let p = mesh.corners(FaceId(face));
        FaceExtents {
            sides: [length(1, 2), length(2, 0), length(0, 1)],
            spans: [p[1].distance(p[2]), p[2].distance(p[0]), p[0].distance(p[1])],
            turns: [n[1].distance(n[2]), n[2].distance(n[0]), n[0].distance(n[1])],
        }
    }

    fn band(
        &self,
        (face, normals): (u32, &[DVec3; 3]),
        measures: FaceExtents,
        channel: usize,
        levels: &'a [f64],
        shadowed: u32,
    ) -> LevelTracer<'a> {
        // Hatching strokes end there one by one, so lower accuracy is enough.
        let (near, exact) = if self.lit.shading.bin_channel() == Some(channel) {
            (tolerances::MAX_BIN_BORDER_ERROR_PX, tolerances::MAX_BIN_BORDER_ERROR_TONE)
        } else if self.lit.is_gradient(channel, levels) {
            (tolerances::MAX_BIN_BORDER_ERROR_PX, tolerances::MAX_GRADIENT_BORDER_ERROR_TONE)
        } else {
            (tolerances::MAX_ISOPHOTE_ERROR_PX, tolerances::MAX_ISOPHOTE_ERROR_TONE)
        };
        LevelTracer {
            lit: self.lit,
            px: self.ready.px,
            face,
            paint: self.lit.mesh.paint(FaceId(face)),
            normals: *normals,
            channel,
            is_local: self.ready.is_local[channel],
            slope: self.ready.slope,
            shadowed,
            levels,
            stride: self.lit.stride(face, channel, levels, shadowed),
            max_light_error: max_value_error(levels),
            max_position_error: near,
            exact,
            measures,
        }
    }

    /// Paints that a textured face shows; only the first if all have the same levels. None without texture.
    fn paints_shown(&self, face: u32) -> Option<Vec<PaintId>> {
        let Lit { mesh, shading, textures, .. } = self.lit;
        let textured = textures.face_texture(mesh, face)?;
        let (first, others) = textured.palette().split_first()?;
        let differs =
            |channel| others.iter().any(|p| shading.levels(*p, channel) != shading.levels(*first, channel));
        Some(if (0..shading.channels()).any(differs) { textured.paints() } else { vec![*first] })
    }

    /// Corner of a face, from the tables where possible.
    fn corner(&self, band: &LevelTracer, k: usize, shadow: usize) -> FaceSample {
        let [outside, inside] = &self.ready.values[band.channel][shadow];
        let values = if self.lit.view.facing[band.face as usize] { outside } else { inside };
        match values.get(self.lit.normals.corners[band.face as usize][k] as usize) {
            Some(value) => FaceSample { weights: CORNER_WEIGHTS[k], value: *value },
            None => band.node(CORNER_WEIGHTS[k]),
        }
    }
}

/// Barycentric weights of the corners of a face.
const CORNER_WEIGHTS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Nominal width of a page, px.
const NOMINAL_PAGE_PX: f64 = 1000.0;

/// Minimum number of levels that lie close together, so that their borders need less accuracy.
const MIN_DENSE_LEVELS: usize = 16;

/// Largest invisible error for such levels, as a share of one step.
const MAX_VALUE_ERROR_OF_STEP: f64 = 0.05;

/// Largest invisible error of light; 0 for few levels.
fn max_value_error(levels: &[f64]) -> f64 {
    match levels {
        [first, .., last] if levels.len() >= MIN_DENSE_LEVELS => {
            MAX_VALUE_ERROR_OF_STEP * (last - first) / (levels.len() - 1) as f64
        }
        _ => 0.0,
    }
}
