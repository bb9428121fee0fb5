//! Fixed origins for dashes and hand-drawn gaps, so that they do not slide along a line in an animation.
//!
//! Gaps counted from the visible start of a line would move whenever that start moves. Here they are counted
//! from a point of the model at rest, computed from the anchors of the line.

use glam::DVec3;

use super::hand_gaps::GapOrigin;
use crate::chains::{Anchor, Chain};

/// The anchors (positions on the model at rest) of both ends of a chain, if they are known.
pub(crate) fn end_anchors(chain: &Chain) -> Option<[Anchor; 2]> {
    let ends = [chain.samples.first()?.anchor, chain.samples.last()?.anchor];
    ends.iter().all(Anchor::is_known).then_some(ends)
}

/// Direction in model space that is unlikely to be an axis of a model, so that ties are rare. Not normalised.
const OBLIQUE_AXIS: [f64; 3] = [0.37, 0.79, 0.49];

/// Position on a closed chain that does not depend on where the chain starts, as a share of its length, 0 to
/// 1.
///
/// It is the point farthest along [`OBLIQUE_AXIS`] on the model at rest; 0 if anchors are unknown.
pub(crate) fn closed_origin_share(chain: &Chain) -> f64 {
    let along =
        |anchor: Anchor| (0..3).map(|k| OBLIQUE_AXIS[k] * f64::from(anchor.rest_position[k])).sum::<f64>();
    let known = chain.samples.iter().map(|sample| sample.anchor).enumerate().filter(|(_, a)| a.is_known());
    let farthest = known.map(|(k, anchor)| (k, along(anchor))).max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((farthest, _)) = farthest else { return 0.0 };
    let next = chain.points.iter().cycle().skip(1);
    let lengths: Vec<f64> = chain.points.iter().zip(next).map(|(a, b)| a.distance(*b)).collect();
    let total: f64 = lengths.iter().sum();
    if total > 0.0 { lengths.iter().take(farthest).sum::<f64>() / total } else { 0.0 }
}

/// The origin of gaps for a chain of the given length in user units; `None` if its anchors are unknown.
pub(crate) fn gap_origin(chain: &Chain, length: f64) -> Option<GapOrigin> {
    let [from, to] = end_anchors(chain)?.map(|anchor| DVec3::from_array(anchor.rest_position.map(f64::from)));
    if chain.closed {
        return Some(GapOrigin { arc: closed_origin_share(chain) * length, backwards: false });
    }
    let way = to - from;
    // The part's centre projected onto the line through both ends. It stays the same if the ends move along
    // the line.
    let arc = -from.dot(way) / way.length_squared() * length;
    arc.is_finite().then(|| GapOrigin { arc, backwards: way.dot(DVec3::from_array(OBLIQUE_AXIS)) < 0.0 })
}
