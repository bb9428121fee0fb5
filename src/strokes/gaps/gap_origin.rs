//! Position of lines on the resting model, so that dashes and gaps stay in place while the visible part
//! changes.

use glam::DVec3;

use super::hand_gaps::GapOrigin;
use crate::chains::{Anchor, Chain};

/// The anchors at both ends of a chain, if they are known.
pub(crate) fn end_anchors(chain: &Chain) -> Option<[Anchor; 2]> {
    let ends = [chain.samples.first()?.anchor, chain.samples.last()?.anchor];
    ends.iter().all(Anchor::is_known).then_some(ends)
}

/// Oblique direction, unlikely to be an axis of a model.
const OBLIQUE_AXIS: [f64; 3] = [0.37, 0.79, 0.49];

/// Position on a closed chain that does not depend on where the chain starts, as a share of its length. It is
/// the point farthest along a fixed direction on the resting model; 0 if anchors are unknown.
pub(crate) fn fixed_share(chain: &Chain) -> f64 {
    let along = |anchor: Anchor| (0..3).map(|k| OBLIQUE_AXIS[k] * f64::from(anchor.place[k])).sum::<f64>();
    let known = chain.samples.iter().map(|sample| sample.anchor).enumerate().filter(|(_, a)| a.is_known());
    let farthest = known.map(|(k, anchor)| (k, along(anchor))).max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((farthest, _)) = farthest else { return 0.0 };
    let next = chain.points.iter().cycle().skip(1);
    let lengths: Vec<f64> = chain.points.iter().zip(next).map(|(a, b)| a.distance(*b)).collect();
    let total: f64 = lengths.iter().sum();
    if total > 0.0 { lengths.iter().take(farthest).sum::<f64>() / total } else { 0.0 }
}

/// The origin of gaps for a chain of the given length, if its anchors are known.
pub(crate) fn gap_origin(chain: &Chain, length: f64) -> Option<GapOrigin> {
    let [from, to] = end_anchors(chain)?.map(|anchor| DVec3::from_array(anchor.place.map(f64::from)));
    if chain.closed {
        return Some(GapOrigin { arc: fixed_share(chain) * length, backwards: false });
    }
    let way = to - from;
    // The projection of the model's centre onto the line, which is the same from both ends.
    let arc = -from.dot(way) / way.length_squared() * length;
    arc.is_finite().then(|| GapOrigin { arc, backwards: way.dot(DVec3::from_array(OBLIQUE_AXIS)) < 0.0 })
}
