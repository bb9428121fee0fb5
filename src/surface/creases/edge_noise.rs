//! [`Roughness`]: by how much a surface turns at the edges around a line, where nothing is meant.
//!
//! The median of absolute turns estimates the spread of noise, whatever the few edges that are
//! features do to the mean (Huber and Ronchetti, "Robust Statistics"). So does their
//! lower quartile. Noise spares no edge, so there both agree; a tessellated cylinder turns at two
//! edges of three, and its diagonals are flat: there the quartile is 0. The geometric mean of both
//! is taken.

use super::crease_chains::Chain;
use crate::geometry::numbers::portable_math::{acos, cos};
use crate::mesh::normals::dihedral::Dihedral;
use crate::mesh::{FirstEdges, Mesh, Turns};

/// The standard deviation of a normal distribution is this many times the median of its absolute
/// values.
const DEVIATION_OF_MEDIAN: f64 = 1.4826;

/// And this many times their lower quartile.
const DEVIATION_OF_QUARTILE: f64 = 3.1383;

/// At most so many edges of a chain are looked around at: a longer chain is sampled evenly.
const SAMPLES: usize = 64;

/// Finds the edges around a line.
pub(crate) struct Roughness<'a> {
    mesh: &'a Mesh,
    turns: &'a Turns,
    edges: FirstEdges<'a>,
    /// Edges that turn by more than the angle of this cosine are no noise.
    high_cosine: f32,
}

/// What lies around a line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Around {
    /// Standard deviation of the turns, degrees: 0 where all is flat.
    pub deviation: f64,
    /// Median length of the edges, world units.
    pub edge_length: f64,
}

impl<'a> Roughness<'a> {
    pub fn new(mesh: &'a Mesh, turns: &'a Turns, high_deg: f64) -> Self {
        let edges = FirstEdges::of(&mesh.edges, mesh.positions.len());
        Self { mesh, turns, edges, high_cosine: cos(high_deg.to_radians()) as f32 }
    }

    /// The edges of the faces beside a chain and of their neighbours, without those of the chain
    /// and without other sharp ones.
    pub fn around(&self, chain: &Chain) -> Around {
        let mut own: Vec<u32> = chain.folds.iter().map(|f| f.edge).collect();
        own.sort_unstable();
        let (mut cosines, mut lengths) = (Vec::new(), Vec::new());
        let mut seen = |edge: usize, cosine: f32| {
            let [a, b] = self.mesh.edges.vertices[edge].map(|v| self.mesh.positions[v as usize]);
            lengths.push(a.distance_squared(b));
            if cosine >= self.high_cosine && own.binary_search(&(edge as u32)).is_err() {
                cosines.push(f64::from(-cosine));
            }
        };
        for fold in chain.folds.iter().step_by(chain.folds.len().div_ceil(SAMPLES)) {
            let Some(dihedral) = self.turns.dihedral(self.mesh, fold.edge as usize) else { continue };
            for face in dihedral.faces {
                for (edge, beside) in self.sides(face, fold.edge as usize) {
                    seen(edge, beside.cosine);
                    let beyond = if beside.faces[0] == face { beside.faces[1] } else { beside.faces[0] };
                    self.sides(beyond, edge).for_each(|(edge, next)| seen(edge, next.cosine));
                }
            }
        }
        // Where the cosine is less, the turn is more.
        let mut turn = |share| quantile(&mut cosines, share).map_or(0.0, |c| acos(-c).to_degrees());
        let (median, quartile) = (turn(2), turn(4));
        Around {
            deviation: (DEVIATION_OF_MEDIAN * median * DEVIATION_OF_QUARTILE * quartile).sqrt(),
            edge_length: quantile(&mut lengths, 2).map_or(0.0, f64::sqrt),
        }
    }

    /// The edges of a face at which it meets another, but for one.
    fn sides(&self, face: u32, except: usize) -> impl Iterator<Item = (usize, Dihedral)> + '_ {
        let [a, b, c] = self.mesh.triangles[face as usize];
        let edges = [(a, b), (b, c), (c, a)].into_iter().filter_map(|(u, v)| self.edges.between(u, v));
        edges
            .filter(move |edge| *edge != except)
            .filter_map(|edge| Some((edge, self.turns.dihedral(self.mesh, edge)?)))
    }
}

/// The number below which one in `share` of some numbers lies, the lower of two.
fn quantile(numbers: &mut [f64], share: usize) -> Option<f64> {
    let at = numbers.len().checked_sub(1)? / share;
    Some(*numbers.select_nth_unstable_by(at, f64::total_cmp).1)
}
