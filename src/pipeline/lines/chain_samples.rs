//! Samples of the scene next to lines, for pens whose strokes depend on them: the light on the surface, and
//! the depth gap behind the line.
//!
//! Visibility is sampled at page points slightly to the left and right of each visible line. Only what the
//! pens of the style need is sampled.

use glam::DVec2;
use kurbo::{Point, Vec2};

use crate::chains::{Chain, Sample};
use crate::drawing::{Length, Unit};
use crate::geometry::numbers::noise::hash;
use crate::geometry::space::triangles::weights;
use crate::light::{Shading, ShadingNormals};
use crate::lines::{FeatureLines, Lit, Surface, Textures};
use crate::mesh::FaceId;
use crate::scene::Scene;
use crate::strokes::{Pen, StrokeOptions};
use crate::style::Style;
use crate::view::View;
use crate::visibility::front_faces;

/// Distance of the samples from the line, px.
pub(crate) const SIDE_OFFSET_PX: f64 = 1.5;

/// Greatest distance between samples along a line, px.
pub(crate) const SAMPLE_STEP_PX: f64 = 3.0;

/// Depth gap that counts as background, as a share of the frame's longer side at the line's depth.
const BACKGROUND_GAP_OF_FRAME: f64 = 0.2;

/// Least depth difference between the surfaces next to a line, in the same measure. Above it the nearer one
/// counts as the line's own.
pub(crate) const MIN_DEPTH_GAP_OF_FRAME: f64 = 0.01;

/// A view and its position on the page.
pub(crate) struct ChainSampler<'a> {
    pub scene: &'a Scene,
    pub surface: &'a Surface,
    pub view: &'a View,
    pub style: &'a Style,
    /// Offset from the camera's frame to the page.
    pub margin: Vec2,
    pub unit: Unit,
}

/// Samples that the pens of a style need.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct SampleNeeds {
    /// Depth along the lines.
    depth: bool,
    /// Surfaces on both sides.
    sides: bool,
    /// Light on both sides.
    light: bool,
}

impl SampleNeeds {
    fn of(options: &StrokeOptions) -> Self {
        if options.choice.is_some() {
            return Self { depth: true, sides: true, light: true };
        }
        let mut wanted = Self::default();
        let mut add = |pen: &Pen| {
            wanted.depth |= pen.halo.value > 0.0 || pen.swell.near > 0.0;
            wanted.sides |= pen.swell.needs_side_samples();
            wanted.light |= pen.swell.lit > 0.0;
        };
        add(&options.pen);
        for rule in &options.rules {
            // The needs of a rule's pen add up, so the default pen with the rule's changes suffices.
            let mut pen = Pen::default();
            rule.pen.apply(&mut pen);
            add(&pen);
        }
        wanted
    }
}

/// A camera-independent number for each feature segment, from the positions of its vertices. 0 for segments
/// that do not lie on mesh edges. Empty if no pen has random effects.
pub(crate) fn segment_names(lines: &FeatureLines, surface: &Surface, options: &StrokeOptions) -> Vec<u64> {
    let has_hand = |pen: &Pen| pen.hand.is_on() || pen.swell.chance > 0.0;
    let changed = options.rules.iter().any(|rule| {
        let mut pen = Pen::default();
        rule.pen.apply(&mut pen);
        has_hand(&pen)
    });
    if !changed && !has_hand(&options.pen) {
        return Vec::new();
    }
    let mesh = &surface.mesh;
    let name = |ends: [u32; 2]| {
        let [a, b] = [ends[0].min(ends[1]), ends[0].max(ends[1])].map(|end| mesh.positions.get(end as usize));
        let (Some(a), Some(b)) = (a, b) else { return 0 };
        let [a, b] = [a, b].map(|p| hash(0, &(*p + mesh.origin).to_array().map(f64::to_bits)));
        hash(a, &[b]).max(1)
    };
    lines.segments.iter().map(|segment| name(segment.ends)).collect()
}

/// Samples what the pens of the chains need.
pub(crate) fn sample_chains(chains: &mut [Chain], sampler: &ChainSampler) {
    let wanted = SampleNeeds::of(&sampler.style.stroke);
    if wanted == SampleNeeds::default() {
        return;
    }
    let px = Length::px(1.0).in_unit(sampler.unit);
    for chain in chains.iter_mut() {
        densify(chain, SAMPLE_STEP_PX * px, sampler.view.frame.perspective);
    }
    if wanted.sides {
        sampler.sample_sides(chains, px, wanted.light);
    }
}

/// Adds points to a chain until neighbours are at most a step apart.
pub(crate) fn densify(chain: &mut Chain, step: f64, perspective: bool) {
    let n = chain.points.len();
    let sides = if chain.closed { n } else { n.saturating_sub(1) };
    let (mut points, mut samples) = (Vec::with_capacity(n), Vec::with_capacity(n));
    for i in 0..sides {
        let j = (i + 1) % n;
        let (a, b) = (chain.points[i], chain.points[j]);
        let (from, to) = (chain.samples[i], chain.samples[j]);
        let count = ((b - a).hypot2().sqrt() / step).ceil().clamp(1.0, 1e5) as usize;
        for k in 0..count {
            let t = k as f64 / count as f64;
            points.push(a.lerp(b, t));
            samples.push(if perspective { foreshortened(from, to, t) } else { from.lerp(to, t) });
        }
    }
    if !chain.closed {
        points.extend(chain.points.last());
        samples.extend(chain.samples.last());
    }
    (chain.points, chain.samples) = (points, samples);
}

/// Interpolates two samples in perspective, where 1/depth is linear along the image of a line.
fn foreshortened(from: Sample, to: Sample, t: f64) -> Sample {
    let mut sample = from.lerp(to, t);
    if from.depth > 0.0 && to.depth > 0.0 {
        sample.depth = 1.0 / ((1.0 - t) / from.depth + t / to.depth);
    }
    sample
}

/// The surface visible at a point next to a line: its depth and light.
#[derive(Debug, Clone, Copy)]
struct SideSample {
    depth: f64,
    light: f64,
}

impl ChainSampler<'_> {
    fn sample_sides(&self, chains: &mut [Chain], px: f64, light: bool) {
        let mut places: Vec<DVec2> = Vec::new();
        for chain in chains.iter().filter(|chain| chain.invisibility == 0) {
            for i in 0..chain.points.len() {
                let across = across(chain, i) * (SIDE_OFFSET_PX * px);
                for p in [chain.points[i] + across, chain.points[i] - across] {
                    let p = p - self.margin;
                    places.push(DVec2::new(p.x, p.y));
                }
            }
        }
        let seen = self.sample_surfaces(&places, light);
        let mut pairs = seen.chunks_exact(2);
        let frame = &self.view.frame;
        for chain in chains.iter_mut().filter(|chain| chain.invisibility == 0) {
            for sample in &mut chain.samples {
                if let Some([left, right]) = pairs.next() {
                    set_side_values(sample, *left, *right, frame.side_at(sample.depth));
                }
            }
        }
    }

    /// The surfaces visible at points of the frame; `None` is background.
    fn sample_surfaces(&self, places: &[DVec2], light: bool) -> Vec<Option<SideSample>> {
        let (mesh, view) = (&self.surface.mesh, self.view);
        let frame = &view.frame;
        let fronts = front_faces(mesh, view, places);
        let dark = |nearness: f64| SideSample { depth: frame.depth_of(nearness), light: 1.0 };
        if !light {
            return fronts.into_iter().map(|front| front.map(|front| dark(front.nearness))).collect();
        }
        let normals = ShadingNormals::new(mesh, &self.surface.hard, &self.surface.smooth);
        // Warnings are dropped here; painting reports the same ones.
        let style = self.style;
        let shading = Shading::new(self.scene, &[], mesh, frame, &style.light, &style.tones, &mut Vec::new());
        let textures = Textures::default();
        let lit = Lit {
            mesh,
            view,
            normals: &normals,
            shading: &shading,
            ambient_visibility: &[],
            textures: &textures,
            solid: &[],
        };
        let of = |(front, place): (Option<crate::visibility::FrontFace>, &DVec2)| {
            let front = front?;
            let at = frame.local_from_image(place.extend(front.nearness));
            let point = lit.point(front.face, weights(mesh.corners(FaceId(front.face)), at));
            let light = shading.value(0, mesh.paint(FaceId(front.face)), &point, 0);
            Some(SideSample { light: light.clamp(0.0, 1.0), ..dark(front.nearness) })
        };
        fronts.into_iter().zip(places).map(of).collect()
    }
}

/// Unit vector to the left of a chain at a point, in its direction of travel.
pub(crate) fn across(chain: &Chain, i: usize) -> Vec2 {
    let n = chain.points.len();
    let at = |k: usize| -> Point { chain.points[k] };
    let (before, after) = if chain.closed {
        (at((i + n - 1) % n), at((i + 1) % n))
    } else {
        (at(i.saturating_sub(1)), at((i + 1).min(n - 1)))
    };
    let way = after - before;
    let length = way.hypot2().sqrt();
    if length > 0.0 { Vec2::new(way.y, -way.x) / length } else { Vec2::ZERO }
}

/// Sets the side, gap and light of a line's sample from the surfaces on both sides.
fn set_side_values(sample: &mut Sample, left: Option<SideSample>, right: Option<SideSample>, size: f64) {
    let depth = |seen: Option<SideSample>| seen.map_or(f64::INFINITY, |seen| seen.depth);
    let apart = (depth(right) - depth(left)) / (size * MIN_DEPTH_GAP_OF_FRAME).max(f64::MIN_POSITIVE);
    // Between two backgrounds neither side is nearer.
    sample.side = if apart.is_nan() { 0.0 } else { apart.clamp(-1.0, 1.0) };
    let farther = depth(left).max(depth(right)) - sample.depth;
    sample.gap = (farther / (size * BACKGROUND_GAP_OF_FRAME).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let light = |seen: Option<SideSample>| seen.map_or(0.0, |seen| seen.light);
    let share = (1.0 + sample.side) / 2.0;
    sample.light = match (left, right) {
        (None, None) => 1.0,
        _ => light(left) * share + light(right) * (1.0 - share),
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn side_values_come_from_the_nearer_side_of_a_line() {
        let mut sample = Sample::new(10.0, 1.0);
        let near = SideSample { depth: 10.0, light: 0.25 };
        set_side_values(&mut sample, Some(near), None, 1.0);
        assert_eq!((sample.side, sample.gap, sample.light), (1.0, 1.0, 0.25));
        set_side_values(&mut sample, Some(SideSample { depth: 10.1, light: 0.75 }), Some(near), 1.0);
        assert_eq!((sample.side, sample.light), (-1.0, 0.25));
        assert!((sample.gap - 0.5).abs() < 1e-12);
        // A crease: both sides are equally near, so the light is their mean.
        set_side_values(&mut sample, Some(SideSample { light: 0.75, ..near }), Some(near), 1.0);
        assert_eq!((sample.side, sample.gap, sample.light), (0.0, 0.0, 0.5));
        set_side_values(&mut sample, None, None, 1.0);
        assert_eq!((sample.side, sample.gap, sample.light), (0.0, 1.0, 1.0));
    }

    #[test]
    fn foreshortened_interpolates_depth_in_perspective() {
        let [near, far] = [1.0, 3.0].map(|depth| Sample::new(depth, 1.0));
        assert!((foreshortened(near, far, 0.5).depth - 1.5).abs() < 1e-12);
    }
}
