//! What lies on both sides of a line between pixels: whose line it is, and whether background is behind it.

use super::crack_lattice::{Crack, Lattice};
use super::pixel_jumps::Jumps;
use crate::mesh::{MaterialId, Mesh, PartId};
use crate::view::raster::{Maps, NO_FRONT};

/// Whose a line is, crack by crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Owner {
    pub part: PartId,
    pub material: MaterialId,
    /// Whether depth does not jump: both surfaces that meet are seen.
    pub both_seen: bool,
}

/// A crack as the picture has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Side {
    pub owner: Owner,
    /// Depth of the nearer side, world units.
    pub depth: f64,
    /// Whether nothing is on its other side.
    pub silhouette: bool,
}

/// Runs of one owner that are shorter than this many cracks belong to what comes before.
const SHORTEST_RUN: usize = 8;

/// The sides of each crack of a path.
pub(crate) fn sides(
    mesh: &Mesh,
    maps: &Maps,
    jumps: &Jumps,
    lattice: &Lattice,
    cracks: &[Crack],
) -> Vec<Side> {
    let mut sides: Vec<Side> = cracks.iter().map(|crack| side(mesh, maps, jumps, lattice, *crack)).collect();
    settle(&mut sides);
    sides
}

fn side(mesh: &Mesh, maps: &Maps, jumps: &Jumps, lattice: &Lattice, crack: Crack) -> Side {
    let pixels = lattice.pixels(crack).map(|[column, row]| [column.max(0) as usize, row.max(0) as usize]);
    let [a, b] = pixels.map(|[column, row]| row * maps.columns + column);
    let near = if maps.depths[a] <= maps.depths[b] && maps.faces[a] != NO_FRONT { a } else { b };
    let near = if maps.faces[near] == NO_FRONT { a } else { near };
    // Lines run across rows or across columns: the later of both pixels has the other before it.
    let [column, row] = [0, 1].map(|axis| pixels[0][axis].max(pixels[1][axis]));
    let line = if crack.way.is_multiple_of(2) {
        jumps.line_down(column, row)
    } else {
        jumps.line_across(column, row)
    };
    let face = maps.faces[near] as usize;
    let part = mesh.face_part.get(face).copied().unwrap_or(PartId(0));
    let material = mesh.face_material.get(face).copied().unwrap_or(MaterialId(0));
    let silhouette = maps.faces[a] == NO_FRONT || maps.faces[b] == NO_FRONT;
    Side {
        owner: Owner { part, material, both_seen: !silhouette && jumps.of_depth(line) < 1.0 },
        depth: maps.depth(near),
        silhouette,
    }
}

/// Gives short runs to the owner before them, those at the beginning to the one after.
fn settle(sides: &mut [Side]) {
    let mut kept: Option<Owner> = None;
    let mut at = 0;
    while at < sides.len() {
        let owner = sides[at].owner;
        let run = sides[at..].iter().take_while(|side| side.owner == owner).count();
        if run >= SHORTEST_RUN {
            // What came before the first long run is its own.
            if kept.is_none() {
                sides[..at].iter_mut().for_each(|side| side.owner = owner);
            }
            kept = Some(owner);
        } else if let Some(kept) = kept {
            sides[at..at + run].iter_mut().for_each(|side| side.owner = kept);
        }
        at += run;
    }
    if let (None, Some(first)) = (kept, sides.first().map(|side| side.owner)) {
        sides.iter_mut().for_each(|side| side.owner = first);
    }
}
