//! Where on the model at rest a line is, so that what is laid along it stays there when it begins and ends elsewhere.

use glam::DVec3;

use super::hand_gaps::Moored;
use crate::chains::{Anchor, Chain};

/// Where on the model a chain begins and ends, if it knows.
pub(crate) fn ends(chain: &Chain) -> Option<[Anchor; 2]> {
    let ends = [chain.samples.first()?.anchor, chain.samples.last()?.anchor];
    ends.iter().all(Anchor::is_known).then_some(ends)
}

/// A way of space that no model is built along.
const ASLANT: [f64; 3] = [0.37, 0.79, 0.49];

/// At what share of the length of a closed chain a place is that does not move when the chain begins elsewhere: the one that lies
/// farthest along a fixed way on the model at rest; 0 where the chain does not know.
pub(crate) fn place(chain: &Chain) -> f64 {
    let along = |anchor: Anchor| (0..3).map(|k| ASLANT[k] * f64::from(anchor.place[k])).sum::<f64>();
    let known = chain.samples.iter().map(|sample| sample.anchor).enumerate().filter(|(_, a)| a.is_known());
    let farthest = known.map(|(k, anchor)| (k, along(anchor))).max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((farthest, _)) = farthest else { return 0.0 };
    let next = chain.points.iter().cycle().skip(1);
    let lengths: Vec<f64> = chain.points.iter().zip(next).map(|(a, b)| a.distance(*b)).collect();
    let total: f64 = lengths.iter().sum();
    if total > 0.0 { lengths.iter().take(farthest).sum::<f64>() / total } else { 0.0 }
}

/// The place of a chain that is so long from which gaps are counted, if it knows where on the model it is.
pub(crate) fn of(chain: &Chain, length: f64) -> Option<Moored> {
    let [from, to] = ends(chain)?.map(|anchor| DVec3::from_array(anchor.place.map(f64::from)));
    if chain.closed {
        return Some(Moored { arc: place(chain) * length, backwards: false });
    }
    let way = to - from;
    // The model's middle would be there along the line, so that it is the same from both ends.
    let arc = -from.dot(way) / way.length_squared() * length;
    arc.is_finite().then(|| Moored { arc, backwards: way.dot(DVec3::from_array(ASLANT)) < 0.0 })
}
