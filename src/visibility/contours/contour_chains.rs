//! [`ContourChain`]: connected image segments of a smooth contour, measured by arc length.

use crate::lines::{ContourCurve, FeatureLines};
use crate::visibility::projection::image_segments::ImageSegment;

const NO_SEGMENT: u32 = u32::MAX;

/// Consecutive image segments of one contour.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ContourChain {
    /// Image segments in order.
    pub segments: Vec<u32>,
    /// Arc length at the start of each segment, user units, and the total length.
    pub starts: Vec<f64>,
    /// Whether the last segment meets the first.
    pub closed: bool,
    /// Whether each segment lies between two cusps, where the averted side of the surface is nearer.
    pub backward: Vec<bool>,
}

impl ContourChain {
    pub(crate) fn length(&self) -> f64 {
        self.starts[self.segments.len()]
    }

    /// Whether the image of the run turns back within `within` of a place.
    pub(crate) fn turns_near(&self, arc_length: f64, within: f64) -> bool {
        let first = self.starts.partition_point(|start| *start < arc_length - within).max(1);
        let cusps = (first..self.segments.len()).take_while(|k| self.starts[*k] <= arc_length + within);
        cusps.into_iter().any(|k| self.backward[k - 1] != self.backward[k])
    }

    /// Distance between two places along the run; the shorter way round if it is closed.
    pub(crate) fn between(&self, from: f64, to: f64) -> f64 {
        let direct = (to - from).abs();
        if self.closed { direct.min(self.length() - direct) } else { direct }
    }
}

/// All runs of a view, curve by curve. A curve that turns back for less than `cusp` user units has no cusp
/// there.
pub(crate) fn contour_chains(
    lines: &FeatureLines,
    segments: &[ImageSegment],
    cusp: f64,
) -> Vec<ContourChain> {
    let mut image_of = vec![NO_SEGMENT; lines.segments.len()];
    for (i, segment) in segments.iter().enumerate() {
        image_of[segment.source as usize] = i as u32;
    }
    lines.curves.iter().flat_map(|curve| of_curve(curve, &image_of, segments, cusp)).collect()
}

fn of_curve(
    curve: &ContourCurve,
    image_of: &[u32],
    segments: &[ImageSegment],
    cusp: f64,
) -> Vec<ContourChain> {
    // Image segments with their advance, which is negative where the curve runs backward.
    let mut found: Vec<Vec<(u32, f32)>> = Vec::new();
    let mut joined = false;
    for (source, advance) in curve.segments.clone().zip(&curve.advance) {
        let id = image_of[source as usize];
        if id == NO_SEGMENT {
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
    let is_complete = found.len() == 1 && found[0].len() == curve.segments.len();
    let closed = is_complete && curve.closed && joined && !segments[found[0][0].0 as usize].cut[0];
    found
        .into_iter()
        .map(|pieces| {
            let mut starts = vec![0.0];
            let mut length = 0.0;
            for (id, _) in &pieces {
                length += segments[*id as usize].length();
                starts.push(length);
            }
            let backward = backward_pieces(&pieces, &starts, closed, cusp);
            ContourChain { segments: pieces.iter().map(|piece| piece.0).collect(), starts, closed, backward }
        })
        .collect()
}

/// Whether each piece lies between cusps.
///
/// Stretches that turn back for less than `cusp` user units are ripples of the mesh. The shortest is removed
/// first, until none is left.
fn backward_pieces(pieces: &[(u32, f32)], starts: &[f64], closed: bool, cusp: f64) -> Vec<bool> {
    let n = pieces.len();
    let mut backward: Vec<bool> = pieces.iter().map(|(_, advance)| *advance < 0.0).collect();
    // Each piece is weighted by its length in the image times its advance.
    let weight = |k: usize| (starts[k + 1] - starts[k]) * f64::from(pieces[k].1.abs());
    loop {
        // Stretches of one value: first index, number of pieces, weight.
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
        let weakest = stretches.iter().min_by(|a, b| a.2.total_cmp(&b.2).then(a.0.cmp(&b.0)));
        match weakest {
            Some(&(first, count, sum)) if sum < cusp => {
                for k in first..first + count {
                    backward[k % n] = !backward[k % n];
                }
            }
            _ => return backward,
        }
    }
}
