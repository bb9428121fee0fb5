//! [`Run`]: what the image shows of a smooth contour from head to tail, measured by length.

use crate::lines::{ContourCurve, FeatureLines};
use crate::visibility::projection::image_segments::ImageSegment;

const NONE: u32 = u32::MAX;

/// Image segments of one contour that follow each other.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Run {
    /// Image segments in order.
    pub segments: Vec<u32>,
    /// How far along the run each of them begins, user units, and the whole length.
    pub starts: Vec<f64>,
    /// Whether the last meets the first.
    pub closed: bool,
    /// Whether each lies between two cusps, where the averted side of the surface is the nearer one.
    pub backward: Vec<bool>,
}

impl Run {
    pub fn length(&self) -> f64 {
        self.starts[self.segments.len()]
    }

    /// Whether the image of the run turns back no farther than `within` from a place.
    pub fn turns_near(&self, place: f64, within: f64) -> bool {
        let first = self.starts.partition_point(|start| *start < place - within).max(1);
        let cusps = (first..self.segments.len()).take_while(|k| self.starts[*k] <= place + within);
        cusps.into_iter().any(|k| self.backward[k - 1] != self.backward[k])
    }

    /// How far apart two places are, the shorter way round a closed run.
    pub fn between(&self, from: f64, to: f64) -> f64 {
        let direct = (to - from).abs();
        if self.closed { direct.min(self.length() - direct) } else { direct }
    }
}

/// All runs of a view, curve by curve. The image of a curve that turns back for less than `cusp` user
/// units has no cusp there.
pub(crate) fn runs(lines: &FeatureLines, segments: &[ImageSegment], cusp: f64) -> Vec<Run> {
    let mut image_of = vec![NONE; lines.segments.len()];
    for (i, segment) in segments.iter().enumerate() {
        image_of[segment.source as usize] = i as u32;
    }
    lines.curves.iter().flat_map(|curve| of_curve(curve, &image_of, segments, cusp)).collect()
}

fn of_curve(curve: &ContourCurve, image_of: &[u32], segments: &[ImageSegment], cusp: f64) -> Vec<Run> {
    // Image segments and what they say of running backward.
    let mut found: Vec<Vec<(u32, f32)>> = Vec::new();
    let mut joined = false;
    for (source, advance) in curve.segments.clone().zip(&curve.advance) {
        let id = image_of[source as usize];
        if id == NONE {
            joined = false;
            continue;
        }
        let cut = segments[id as usize].cut;
        match found.last_mut() {
            Some(run) if joined && !cut[0] => run.push((id, *advance)),
            _ => found.push(vec![(id, *advance)]),
        }
        joined = !cut[1];
    }
    let whole = found.len() == 1 && found[0].len() == curve.segments.len();
    let closed = whole && curve.closed && joined && !segments[found[0][0].0 as usize].cut[0];
    found
        .into_iter()
        .map(|pieces| {
            let mut starts = vec![0.0];
            let mut length = 0.0;
            for (id, _) in &pieces {
                length += segments[*id as usize].length();
                starts.push(length);
            }
            let backward = evened(&pieces, &starts, closed, cusp);
            Run { segments: pieces.iter().map(|piece| piece.0).collect(), starts, closed, backward }
        })
        .collect()
}

/// Whether each piece lies between cusps. Stretches that turn back for less than `cusp` user units are
/// ripples of the mesh: the shortest is made even first.
fn evened(pieces: &[(u32, f32)], starts: &[f64], closed: bool, cusp: f64) -> Vec<bool> {
    let n = pieces.len();
    let mut backward: Vec<bool> = pieces.iter().map(|(_, advance)| *advance < 0.0).collect();
    // What a piece says weighs as much as is drawn of it.
    let weight = |k: usize| (starts[k + 1] - starts[k]) * f64::from(pieces[k].1.abs());
    loop {
        // Stretches of one value: first index, number, weight.
        let mut stretches: Vec<(usize, usize, f64)> = Vec::new();
        for k in 0..n {
            match stretches.last_mut() {
                Some((first, count, sum)) if backward[*first] == backward[k] => {
                    *count += 1;
                    *sum += weight(k);
                }
                _ => stretches.push((k, 1, weight(k))),
            }
        }
        if closed && stretches.len() > 1 && backward[0] == backward[n - 1] {
            let (first, count, sum) = stretches.pop().unwrap_or_default();
            stretches[0] = (first, stretches[0].1 + count, stretches[0].2 + sum);
        }
        if stretches.len() < 2 {
            return backward;
        }
        let least = stretches.iter().min_by(|a, b| a.2.total_cmp(&b.2).then(a.0.cmp(&b.0)));
        match least {
            Some(&(first, count, sum)) if sum < cusp => {
                for k in first..first + count {
                    backward[k % n] = !backward[k % n];
                }
            }
            _ => return backward,
        }
    }
}
