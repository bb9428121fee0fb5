//! [`GeometryBuilder`]: assembles a geometry from whole triangles and pieces of cut ones.

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::triangle_cut::{PieceVertex, TrianglePieces};
use crate::mesh::EdgeMark;
use crate::scene::Geometry;

const NO_INDEX: u32 = u32::MAX;

/// A geometry under construction.
pub(crate) struct GeometryBuilder<'a> {
    from: &'a Geometry,
    to: Geometry,
    /// Original triangle of each new one.
    origins: Vec<u32>,
    /// Vertices at crossings, keyed by the ends of the side and the bits of the position along it.
    on_sides: FxHashMap<([u32; 2], u64), u32>,
}

impl<'a> GeometryBuilder<'a> {
    /// Starts with the vertices and wires of a geometry, without triangles.
    pub(crate) fn of(from: &'a Geometry) -> Self {
        let to = Geometry {
            positions: from.positions.clone(),
            normals: from.normals.clone(),
            uvs: from.uvs.clone(),
            colours: from.colours.clone(),
            wires: from.wires.clone(),
            material: from.material,
            single_precision: from.single_precision,
            lattice_step: from.lattice_step,
            ..Geometry::default()
        };
        Self { from, to, origins: Vec::new(), on_sides: FxHashMap::default() }
    }

    /// Adds a triangle unchanged.
    pub(crate) fn keep(&mut self, triangle: usize) {
        self.origins.push(triangle as u32);
        self.to.triangles.push(self.from.triangles[triangle]);
        self.to.triangle_material.extend(self.from.triangle_material.get(triangle));
        self.to.corner_normals.extend(self.from.corner_normals.get(triangle));
        self.to.corner_uvs.extend(self.from.corner_uvs.get(triangle));
        self.to.edge_marks.extend(self.from.edge_marks.get(triangle));
    }

    /// Adds the pieces of a triangle. Each side comes with its crossings (bits of the positions along it) and
    /// its direction.
    pub(crate) fn add(&mut self, triangle: usize, pieces: &TrianglePieces, sides: [(&Vec<u64>, bool); 3]) {
        let from = self.from;
        let corners = from.triangles[triangle];
        let shares: Vec<[f64; 3]> =
            pieces.places.iter().map(|place| barycentric_shares(*place, sides)).collect();
        let vertices: Vec<u32> = pieces
            .places
            .iter()
            .zip(&shares)
            .map(|(place, shares)| match *place {
                PieceVertex::Corner(k) => corners[usize::from(k)],
                PieceVertex::Inside(_) => self.vertex(corners, *shares),
                PieceVertex::Side(k, number) => {
                    let (first, second) = (corners[usize::from(k)], corners[(usize::from(k) + 1) % 3]);
                    let (crossings, is_forward) = sides[usize::from(k)];
                    let ends = if is_forward { [first, second] } else { [second, first] };
                    let part = f64::from_bits(crossings[number as usize]);
                    if let Some(known) = self.on_sides.get(&(ends, part.to_bits())) {
                        return *known;
                    }
                    // Computed from the ends of the side only, so that the neighbour gets the same vertex.
                    let new = self.vertex([ends[0], ends[1], ends[0]], [1.0 - part, part, 0.0]);
                    self.on_sides.insert((ends, part.to_bits()), new);
                    new
                }
            })
            .collect();
        let normals = from.corner_normals.get(triangle).map(|of| {
            let corners = of.map(|n| {
                from.normals.get(n as usize).map(|n| DVec3::from_array(n.map(f64::from)).normalize_or_zero())
            });
            self.blended(&pieces.places, &shares, *of, corners, |to, normal: DVec3| {
                to.normals.push(normal.to_array().map(|x| x as f32));
                to.normals.len()
            })
        });
        let uvs = from.corner_uvs.get(triangle).map(|of| {
            let corners = of
                .map(|uv| from.uvs.get(uv as usize).map(|[u, v]| DVec3::new((*u).into(), (*v).into(), 0.0)));
            self.blended(&pieces.places, &shares, *of, corners, |to, uv: DVec3| {
                to.uvs.push([uv.x as f32, uv.y as f32]);
                to.uvs.len()
            })
        });
        for piece in &pieces.triangles {
            self.origins.push(triangle as u32);
            self.to.triangles.push(piece.map(|i| vertices[i as usize]));
            self.to.triangle_material.extend(from.triangle_material.get(triangle));
            self.to.corner_normals.extend(normals.as_ref().map(|of| piece.map(|i| of[i as usize])));
            self.to.corner_uvs.extend(uvs.as_ref().map(|of| piece.map(|i| of[i as usize])));
            self.to.edge_marks.extend(from.edge_marks.get(triangle).map(|marks| {
                [0, 1, 2].map(|k| {
                    let ends = [piece[k], piece[(k + 1) % 3]].map(|i| pieces.places[i as usize]);
                    (0..3)
                        .find(|side| ends.iter().all(|end| lies_on(*end, *side)))
                        .map_or(EdgeMark::Unmarked, |side| marks[side])
                })
            }));
        }
    }

    /// Adds a vertex interpolated between three others.
    fn vertex(&mut self, corners: [u32; 3], shares: [f64; 3]) -> u32 {
        let [a, b, c] = corners.map(|corner| self.from.positions[corner as usize]);
        self.to.positions.push(a * shares[0] + b * shares[1] + c * shares[2]);
        if !self.from.colours.is_empty() {
            let mut colour = [0.0; 4];
            for (corner, share) in corners.iter().zip(shares) {
                let of = self.from.colours.get(*corner as usize).copied().unwrap_or([1.0; 4]);
                colour.iter_mut().zip(of).for_each(|(sum, channel)| *sum += channel * share as f32);
            }
            self.to.colours.push(colour);
        }
        self.to.positions.len() as u32 - 1
    }

    /// Interpolates an attribute of the corners at each place and returns its indices; none if a corner has
    /// no attribute.
    fn blended(
        &mut self,
        places: &[PieceVertex],
        shares: &[[f64; 3]],
        numbers: [u32; 3],
        corners: [Option<DVec3>; 3],
        add: impl Fn(&mut Geometry, DVec3) -> usize,
    ) -> Vec<u32> {
        let of_place = |(place, shares): (&PieceVertex, &[f64; 3])| match (*place, corners) {
            (PieceVertex::Corner(k), _) => numbers[usize::from(k)],
            (_, [Some(a), Some(b), Some(c)]) => {
                add(&mut self.to, a * shares[0] + b * shares[1] + c * shares[2]) as u32 - 1
            }
            _ => NO_INDEX,
        };
        places.iter().zip(shares).map(of_place).collect()
    }

    /// The geometry, and the original triangle of each new one.
    pub(crate) fn done(self) -> (Geometry, Vec<u32>) {
        (self.to, self.origins)
    }
}

/// Barycentric coordinates of a place.
fn barycentric_shares(place: PieceVertex, sides: [(&Vec<u64>, bool); 3]) -> [f64; 3] {
    let mut shares = [0.0; 3];
    match place {
        PieceVertex::Inside(inside) => return inside,
        PieceVertex::Corner(k) => shares[usize::from(k)] = 1.0,
        PieceVertex::Side(k, number) => {
            let (crossings, is_forward) = sides[usize::from(k)];
            let part = f64::from_bits(crossings[number as usize]);
            let part = if is_forward { part } else { 1.0 - part };
            shares[usize::from(k)] = 1.0 - part;
            shares[(usize::from(k) + 1) % 3] = part;
        }
    }
    shares
}

/// Whether a place is on the side after a corner.
fn lies_on(place: PieceVertex, side: usize) -> bool {
    match place {
        PieceVertex::Corner(k) => usize::from(k) == side || usize::from(k) == (side + 1) % 3,
        PieceVertex::Side(k, _) => usize::from(k) == side,
        PieceVertex::Inside(_) => false,
    }
}
