//! [`Flow`]: the directions of strokes over a page, made smooth where the surface says little of them.
//!
//! Directions are lines without sense, kept as twice their angle, so that opposite ones agree. Where a
//! surface bends, its directions are kept; over evenly round places and narrow flat ones they are spread from
//! around, never across the border of a facet. Wide flat faces keep theirs, which are level. Source: Hertzmann and Zorin, "Illustrating smooth surfaces",
//! SIGGRAPH 2000, section 5, there with four directions on the mesh.

use kurbo::{Point, Vec2};

use crate::regions::Samples;
use crate::regions::lattice::direction_field::{Axes, Axis};

/// The directions of strokes over a page.
#[derive(Debug, Clone)]
pub struct Flow<'a> {
    samples: &'a Samples,
    axes: Vec<Axis>,
}

/// Rounds of spreading.
const ROUNDS: usize = 60;

/// How much a neighbour counts against a point that is sure.
const NEIGHBOUR: f32 = 3.0;

impl<'a> Flow<'a> {
    /// The flow along axes that are given at the points of a lattice.
    #[must_use]
    pub fn new(samples: &'a Samples, axes: &Axes) -> Self {
        let given = &axes.of;
        let axes = samples.spread(given.clone(), ROUNDS, |k, own, around| {
            if samples.facets[k] == 0 || axes.hold[k] {
                return own;
            }
            let sure = (given[k][0] * given[k][0] + given[k][1] * given[k][1]).sqrt();
            let (mut sum, mut whole) = (given[k], sure);
            for axis in around.into_iter().flatten() {
                sum = [sum[0] + NEIGHBOUR * axis[0], sum[1] + NEIGHBOUR * axis[1]];
                whole += NEIGHBOUR;
            }
            if whole > 0.0 { sum.map(|x| x / whole) } else { sum }
        });
        Self { samples, axes }
    }

    /// The lattice.
    #[must_use]
    pub const fn samples(&self) -> &Samples {
        self.samples
    }

    /// The direction on a facet at a point of the page, of unit length and either sense; `None` where the
    /// facet is not seen nearby or nothing tells of a direction.
    #[must_use]
    pub fn at(&self, facet: u32, p: Point) -> Option<Vec2> {
        let mut sum = [0.0_f64; 2];
        for (k, weight) in self.samples.around(p) {
            if self.samples.facets[k] == facet {
                let [x, y] = self.axes[k].map(f64::from);
                let length = (x * x + y * y).sqrt();
                if length > 0.0 {
                    let weight = (weight + FAINT) / length;
                    sum = [sum[0] + x * weight, sum[1] + y * weight];
                }
            }
        }
        let length = (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
        if length <= 0.0 {
            return None;
        }
        // Half of the angle whose cosine and sine these are.
        let cosine = sum[0] / length;
        let x = f64::midpoint(1.0, cosine).max(0.0).sqrt();
        let y = f64::midpoint(1.0, -cosine).max(0.0).sqrt();
        Some(Vec2::new(x, if sum[1] < 0.0 { -y } else { y }))
    }
}

/// Points of the lattice whose weight would vanish still count a little.
const FAINT: f64 = 1e-9;
