//! [`GuideDirections`]: the direction field of strokes over a page, smoothed where the surface gives no clear direction.
//!
//! A direction has no sense, so its angle is stored doubled and opposite directions agree. Curved surfaces
//! keep their directions, and so do wide flat faces, whose directions are level. Over spherical areas and
//! narrow flat faces, directions spread in from around, never across the border of a facet.
//!
//! Source: Hertzmann and Zorin, "Illustrating smooth surfaces", SIGGRAPH 2000, section 5, which smooths
//! four-fold directions on the mesh.

use kurbo::{Point, Vec2};

use crate::hatching::tolerances;
use crate::regions::LightLattice;
use crate::regions::sampling::direction_field::{DirectionField, LineDirection};

/// Direction field of strokes over a page.
#[derive(Debug, Clone)]
pub(crate) struct GuideDirections<'a> {
    samples: &'a LightLattice,
    axes: Vec<LineDirection>,
}

/// Number of smoothing rounds.
const SPREAD_ROUNDS: usize = 60;

/// Weight of a neighbour relative to a point with a certain direction.
const NEIGHBOUR_WEIGHT: f32 = 3.0;

impl<'a> GuideDirections<'a> {
    /// The field that smooths the axes given at the points of a lattice.
    #[must_use]
    pub(crate) fn new(samples: &'a LightLattice, axes: &DirectionField) -> Self {
        let initial = &axes.directions;
        let axes = samples.spread(initial.clone(), SPREAD_ROUNDS, |k, own, around| {
            if samples.facets[k] == 0 || axes.is_independent[k] {
                return own;
            }
            let sure = (initial[k][0] * initial[k][0] + initial[k][1] * initial[k][1]).sqrt();
            let (mut sum, mut weight_sum) = (initial[k], sure);
            for axis in around.into_iter().flatten() {
                sum = [sum[0] + NEIGHBOUR_WEIGHT * axis[0], sum[1] + NEIGHBOUR_WEIGHT * axis[1]];
                weight_sum += NEIGHBOUR_WEIGHT;
            }
            if weight_sum > 0.0 { sum.map(|x| x / weight_sum) } else { sum }
        });
        Self { samples, axes }
    }

    /// The lattice of the field.
    #[must_use]
    pub(crate) const fn samples(&self) -> &LightLattice {
        self.samples
    }

    /// The direction on a facet at a point of the page, of unit length and either sense. Returns `None` if
    /// the facet is not visible nearby or has no direction there.
    #[must_use]
    pub(crate) fn at(&self, facet: u32, p: Point) -> Option<Vec2> {
        let mut sum = [0.0_f64; 2];
        for (k, weight) in self.samples.around(p) {
            if self.samples.facets[k] == facet {
                let [x, y] = self.axes[k].map(f64::from);
                let length = (x * x + y * y).sqrt();
                if length > 0.0 {
                    let weight = (weight + tolerances::MIN_SAMPLE_WEIGHT) / length;
                    sum = [sum[0] + x * weight, sum[1] + y * weight];
                }
            }
        }
        let length = (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
        if length <= 0.0 {
            return None;
        }
        // Half of the angle with this cosine and sine.
        let cosine = sum[0] / length;
        let x = f64::midpoint(1.0, cosine).max(0.0).sqrt();
        let y = f64::midpoint(1.0, -cosine).max(0.0).sqrt();
        Some(Vec2::new(x, if sum[1] < 0.0 { -y } else { y }))
    }
}
