//! [`ImageLines`]: curves between the pixels of the maps.

use crate::parallel::prelude::*;
use glam::DVec2;
use rustc_hash::FxHashMap;

use super::ImageOptions;
use crate::lines::image::cracks::crack_lattice::{Crack, CrackLattice};
use crate::lines::image::cracks::crack_paths::{CrackPath, paths};
use crate::lines::image::cracks::crack_repair::{close_gaps, remove_spurs};
use crate::lines::image::cracks::crack_sides::{CrackOwner, CrackSides, sides};
use crate::lines::image::cracks::crest_test::MIN_INDEPENDENT_JUMP;
use crate::lines::image::cracks::jump_tiles::JumpTiles;
use crate::lines::image::cracks::pixel_jumps::PixelJumps;
use crate::lines::image::cracks::taut_path::{Gate, TautBend, crossings, shortest_path};
use crate::mesh::{MaterialId, Mesh, PartId};
use crate::view::raster::NormalDepthMaps;

/// Point of a line in the image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ImagePoint {
    /// Position in the camera's frame, user units.
    pub position: DVec2,
    /// Depth of the nearer side along the optical axis, world units.
    pub depth: f64,
}

/// Straight piece of a line in the image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ImageLinePiece {
    /// Ends, as indices into [`ImageLines::points`].
    pub ends: [u32; 2],
    /// Part of the nearer surface.
    pub part: PartId,
    /// Material of the nearer surface.
    pub material: MaterialId,
    /// Whether depth is continuous across it, so that both surfaces are seen.
    pub both_seen: bool,
    /// Whether its other side is background.
    pub silhouette: bool,
    /// Index of its line.
    pub line: u32,
}

/// Lines found in the image. Pieces that meet share a point.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ImageLines {
    /// Ends of pieces.
    pub points: Vec<ImagePoint>,
    /// Pieces, line by line.
    pub pieces: Vec<ImageLinePiece>,
    /// Number of lines.
    pub lines: u32,
}

/// Traces lines through the edge pixels, along the cracks with the largest jumps.
#[must_use]
pub(crate) fn trace(
    mesh: &Mesh,
    maps: &NormalDepthMaps,
    edges: &[bool],
    options: &ImageOptions,
) -> ImageLines {
    let jumps = PixelJumps::new(mesh, maps, options);
    let jump_map = jumps.map(edges);
    let mut lattice = CrackLattice::local_maxima(&jump_map);
    close_gaps(&mut lattice, &jump_map);
    remove_spurs(&mut lattice);
    let mut paths = paths(&lattice);
    paths.retain(|path| is_line(&lattice, &jump_map, path));
    let pulled: Vec<TautLine> =
        paths.into_par_iter().map(|path| pull_taut(mesh, maps, &jumps, &lattice, path)).collect();
    assemble(&lattice, maps, &pulled)
}

/// Minimum length in cracks, except for strong lines that touch another line.
const MIN_LINE_CRACKS: usize = 12;

/// Minimum length of weak isolated lines, in cracks.
const MIN_FREE_LINE_CRACKS: usize = 40;

/// Whether a path is more than noise.
fn is_line(lattice: &CrackLattice, jumps: &JumpTiles, path: &CrackPath) -> bool {
    let count = path.cracks.len();
    let jump: f32 = path.cracks.iter().map(|crack| lattice.jump(jumps, *crack)).sum();
    let hangs = [0, count].iter().any(|after| lattice.degree(path.corner(lattice, *after)) > 2);
    let is_strong = jump >= MIN_INDEPENDENT_JUMP * count as f32;
    match (is_strong, hangs) {
        (true, true) => true,
        (true, false) => count >= MIN_LINE_CRACKS,
        (false, true) => count >= MIN_LINE_CRACKS && jump >= count as f32,
        (false, false) => count >= MIN_FREE_LINE_CRACKS && jump >= count as f32,
    }
}

/// Path with its taut line.
struct TautLine {
    path: CrackPath,
    bends: Vec<TautBend>,
    crossings: Vec<DVec2>,
    sides: Vec<CrackSides>,
}

fn pull_taut(
    mesh: &Mesh,
    maps: &NormalDepthMaps,
    jumps: &PixelJumps,
    lattice: &CrackLattice,
    mut path: CrackPath,
) -> TautLine {
    let centre = |[column, row]: [i32; 2]| DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5);
    let gates_of = |cracks: &[Crack]| -> Vec<Gate> {
        cracks.iter().map(|crack| lattice.pixels(*crack).map(centre)).collect()
    };
    let corner = |after: usize| {
        let [column, row] = lattice.place(path.corner(lattice, after));
        DVec2::new(column as f64, row as f64)
    };
    let mut gates = gates_of(&path.cracks);
    let (mut start, mut end) = (corner(0), corner(path.cracks.len()));
    let mut bends = shortest_path(start, &gates, end);
    // A ring starts at one of its bends.
    let half = gates.len() / 2;
    let bend = bends.iter().skip(1).take(bends.len().saturating_sub(2));
    if let (true, Some(bend)) = (path.closed, bend.min_by_key(|bend| bend.gate.abs_diff(half)).copied()) {
        path.cracks.rotate_left(bend.gate);
        gates = gates_of(&path.cracks);
        (start, end) = (bend.at, bend.at);
        bends = shortest_path(start, &gates, end);
    }
    let crossings = crossings(&bends, &gates);
    let sides = sides(mesh, maps, jumps, lattice, &path.cracks);
    TautLine { path, bends, crossings, sides }
}

impl TautLine {
    /// Position of the line after the given number of cracks.
    fn at(&self, after: usize) -> DVec2 {
        let last = self.crossings.len().saturating_sub(1);
        let [a, b] = [after.saturating_sub(1), after.min(last)].map(|i| self.crossings[i]);
        a.midpoint(b)
    }

    /// Points of the line with their positions in half cracks: bends lie on cracks, all others between them.
    fn stops(&self, junctions: &FxHashMap<usize, u32>, lattice: &CrackLattice) -> Vec<(usize, LinePoint)> {
        let n = self.path.cracks.len();
        let mut stops: Vec<(usize, LinePoint)> = Vec::with_capacity(self.bends.len());
        let inner = self.bends.len().saturating_sub(2);
        stops.extend(
            self.bends.iter().skip(1).take(inner).map(|bend| (2 * bend.gate + 1, LinePoint::Bend(bend.at))),
        );
        for after in 0..=n {
            let corner = self.path.corner(lattice, after);
            if let Some(point) = junctions.get(&corner) {
                stops.push((2 * after, LinePoint::Junction(*point)));
            } else if after == 0 || after == n {
                let bend = if after == 0 { self.bends.first() } else { self.bends.last() };
                stops.extend(bend.map(|bend| (2 * after, LinePoint::Bend(bend.at))));
            } else if self.sides[after - 1].owner != self.sides[after].owner {
                stops.push((2 * after, LinePoint::Bend(self.at(after))));
            }
        }
        stops.sort_by_key(|(at, _)| *at);
        stops
    }
}

/// Future point of a line.
#[derive(Debug, Clone, Copy)]
enum LinePoint {
    Bend(DVec2),
    Junction(u32),
}

fn assemble(lattice: &CrackLattice, maps: &NormalDepthMaps, pulled: &[TautLine]) -> ImageLines {
    let mut lines = ImageLines { lines: pulled.len() as u32, ..ImageLines::default() };
    let point = |at: DVec2, depth: f64| ImagePoint { position: at / maps.scale, depth };
    // Lines that pass through a junction determine its position; the others end there.
    let mut junctions: FxHashMap<usize, u32> = FxHashMap::default();
    for through in [true, false] {
        for own in pulled {
            let n = own.path.cracks.len();
            let inner = if own.path.closed { 0..n } else { 1..n };
            for after in (0..=n).filter(|after| inner.contains(after) == through) {
                let corner = own.path.corner(lattice, after);
                if lattice.degree(corner) > 2 {
                    junctions.entry(corner).or_insert_with(|| {
                        let side = &own.sides[after.min(n - 1)];
                        let [column, row] = lattice.place(corner);
                        let at = if through { own.at(after) } else { DVec2::new(column as f64, row as f64) };
                        lines.points.push(point(at, side.depth));
                        (lines.points.len() - 1) as u32
                    });
                }
            }
        }
    }
    for (line, own) in pulled.iter().enumerate() {
        let n = own.path.cracks.len();
        let stops = own.stops(&junctions, lattice);
        let mut ends: Vec<u32> = Vec::with_capacity(stops.len());
        for (at, stop) in &stops {
            ends.push(match stop {
                LinePoint::Junction(id) => *id,
                LinePoint::Bend(_) if own.path.closed && *at == 2 * n => ends[0],
                LinePoint::Bend(position) => {
                    lines.points.push(point(*position, own.sides[(at / 2).min(n - 1)].depth));
                    (lines.points.len() - 1) as u32
                }
            });
        }
        for (stops, ends) in stops.windows(2).zip(ends.windows(2)) {
            let [from, to] = [ends[0], ends[1]];
            let [a, b] = [from, to].map(|id| lines.points[id as usize].position);
            if from != to && a != b {
                let middle = (stops[0].0 + stops[1].0) / 4;
                let side = own.sides[middle.min(n - 1)];
                let CrackOwner { part, material, both_seen } = side.owner;
                let silhouette = side.silhouette;
                lines.pieces.push(ImageLinePiece {
                    ends: [from, to],
                    part,
                    material,
                    both_seen,
                    silhouette,
                    line: line as u32,
                });
            }
        }
    }
    lines
}
