//! Both sides of a crack line: the part and material it belongs to, and whether it is a silhouette.

use super::crack_lattice::{Crack, CrackLattice};
use super::pixel_jumps::PixelJumps;
use crate::mesh::{MaterialId, Mesh, PartId};
use crate::view::raster::{NO_FRONT, NormalDepthMaps};

/// Surface that a crack belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct CrackOwner {
    pub part: PartId,
    pub material: MaterialId,
    /// Whether depth is continuous, so that both surfaces are seen.
    pub both_seen: bool,
}

/// Properties of a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CrackSides {
    pub owner: CrackOwner,
    /// Depth of the nearer side, world units.
    pub depth: f64,
    /// Whether its other side is background.
    pub silhouette: bool,
}

/// Minimum length of a run of one owner, in cracks. Shorter runs join the run before.
const MIN_RUN_CRACKS: usize = 8;

/// Properties of each crack of a path.
pub(crate) fn sides(
    mesh: &Mesh,
    maps: &NormalDepthMaps,
    jumps: &PixelJumps,
    lattice: &CrackLattice,
    cracks: &[Crack],
) -> Vec<CrackSides> {
    let mut sides: Vec<CrackSides> =
        cracks.iter().map(|crack| side(mesh, maps, jumps, lattice, *crack)).collect();
    merge_short_runs(&mut sides);
    sides
}

fn side(
    mesh: &Mesh,
    maps: &NormalDepthMaps,
    jumps: &PixelJumps,
    lattice: &CrackLattice,
    crack: Crack,
) -> CrackSides {
    let pixels = lattice.pixels(crack).map(|[column, row]| [column.max(0) as usize, row.max(0) as usize]);
    let [a, b] = pixels.map(|[column, row]| row * maps.columns + column);
    let near = if maps.depths[a] <= maps.depths[b] && maps.faces[a] != NO_FRONT { a } else { b };
    let near = if maps.faces[near] == NO_FRONT { a } else { near };
    // Of the two pixels, the one in the later row or column has the other before it.
    let [column, row] = [0, 1].map(|axis| pixels[0][axis].max(pixels[1][axis]));
    let line = if crack.direction.is_multiple_of(2) {
        jumps.line_down(column, row)
    } else {
        jumps.line_across(column, row)
    };
    let face = maps.faces[near] as usize;
    let part = mesh.face_part.get(face).copied().unwrap_or(PartId(0));
    let material = mesh.face_material.get(face).copied().unwrap_or(MaterialId(0));
    let silhouette = maps.faces[a] == NO_FRONT || maps.faces[b] == NO_FRONT;
    CrackSides {
        owner: CrackOwner { part, material, both_seen: !silhouette && jumps.of_depth(line) < 1.0 },
        depth: maps.depth(near),
        silhouette,
    }
}

/// Merges short runs into the run before; at the start of the path, into the run after.
fn merge_short_runs(sides: &mut [CrackSides]) {
    let mut kept: Option<CrackOwner> = None;
    let mut at = 0;
    while at < sides.len() {
        let owner = sides[at].owner;
        let run = sides[at..].iter().take_while(|side| side.owner == owner).count();
        if run >= MIN_RUN_CRACKS {
            // Short runs before the first long one join it.
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
