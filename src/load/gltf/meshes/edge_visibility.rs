//! Visibility marks of triangle sides.
//!
//! Source: EXT_mesh_primitive_edge_visibility, draft of Bentley Systems. Each side has two bits: hidden,
//! silhouette (a contour here), hard, or hard as already marked by a neighbour. A silhouette is marked on
//! only one of its two triangles, so the stronger mark of both applies.

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::error::Error;
use crate::load::gltf::json::Edges;
use crate::load::gltf::storage::buffers::Buffers;
use crate::mesh::EdgeMark;
use crate::scene::Warnings;

/// Marks of the sides 0-1, 1-2, 2-0 of each triangle of a primitive.
pub(crate) fn marks(
    buffers: &Buffers,
    edges: &Edges,
    triangles: &[[u32; 3]],
    positions: &[DVec3],
    warnings: &mut Warnings,
) -> Result<Vec<[EdgeMark; 3]>, Error> {
    let mut marks = match edges.visibility {
        Some(accessor) => stored(&buffers.bytes(accessor)?, triangles.len())
            .map_err(|e| e.at(format!("accessor {accessor}")))?,
        None => vec![[EdgeMark::Hidden; 3]; triangles.len()],
    };
    if edges.line_strings.is_empty() {
        return Ok(marks);
    }
    let first = first_at_place(positions);
    let edge = |from: u32, to: u32| {
        let (from, to) = (*first.get(from as usize)?, *first.get(to as usize)?);
        Some([from.min(to), from.max(to)])
    };
    let mut hard = FxHashSet::default();
    let mut nowhere = 0;
    for line in &edges.line_strings {
        let indices = buffers.indices(line.indices)?;
        for string in indices.values.split(|index| *index == indices.restart) {
            let found = string.array_windows().map(|[a, b]| edge(*a, *b));
            nowhere += found.clone().filter(Option::is_none).count() as u64;
            hard.extend(found.flatten());
        }
    }
    warnings.count("marked edges left out, with an index that points nowhere", nowhere);
    for (&[a, b, c], [ab, bc, ca]) in triangles.iter().zip(&mut marks) {
        for (from, to, mark) in [(a, b, ab), (b, c, bc), (c, a, ca)] {
            if edge(from, to).is_some_and(|edge| hard.contains(&edge)) {
                *mark = EdgeMark::Hard;
            }
        }
    }
    Ok(marks)
}

/// First vertex at the position of each vertex. A line string may use any of several vertices at one
/// position.
fn first_at_place(positions: &[DVec3]) -> Vec<u32> {
    let mut first = FxHashMap::default();
    // Adding 0 maps -0 to 0.
    let bits = |position: &DVec3| position.to_array().map(|axis| (axis + 0.0).to_bits());
    positions.iter().zip(0..).map(|(position, id)| *first.entry(bits(position)).or_insert(id)).collect()
}

fn stored(bits: &[u8], triangles: usize) -> Result<Vec<[EdgeMark; 3]>, Error> {
    let needed = triangles.saturating_mul(6).div_ceil(8);
    if bits.len() < needed {
        let message =
            format!("{triangles} triangles need {needed} bytes of visibility, there are {}", bits.len());
        return Err(Error::new(message));
    }
    let mark = |side: usize| match bits.get(side / 4).map_or(0, |byte| byte >> (side % 4 * 2) & 3) {
        0 => EdgeMark::Hidden,
        1 => EdgeMark::Contour,
        _ => EdgeMark::Hard,
    };
    Ok((0..triangles).map(|triangle| [0, 1, 2].map(|side| mark(3 * triangle + side))).collect())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use EdgeMark::{Contour, Hard, Hidden};

    #[test]
    fn edge_visibility_bits_match_the_extension_draft() {
        assert_eq!(stored(&[18, 2], 2).unwrap(), [[Hard, Hidden, Contour], [Hidden, Hard, Hidden]]);
        assert_eq!(stored(&[226, 2], 2).unwrap(), [[Hard, Hidden, Hard], [Hard, Hard, Hidden]]);
        assert!(stored(&[18], 2).is_err());
    }
}
