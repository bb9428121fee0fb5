//! What a file says about the sides of its triangles.
//!
//! Source: EXT_mesh_primitive_edge_visibility, draft of Bentley Systems. Two bits a side: hidden,
//! silhouette (a contour here), hard, and hard as a neighbour already says. A silhouette is marked
//! on one of its two triangles only, so the stronger mark of both is the one to believe.

use rustc_hash::FxHashSet;

use super::buffers::Buffers;
use super::json::Edges;
use crate::error::Error;
use crate::mesh::EdgeMark;

/// The marks of the sides 0-1, 1-2, 2-0 of each triangle of a primitive.
pub fn marks(buffers: &Buffers, edges: &Edges, triangles: &[[u32; 3]]) -> Result<Vec<[EdgeMark; 3]>, Error> {
    let mut marks = match edges.visibility {
        Some(accessor) => stored(&buffers.bytes(accessor)?, triangles.len())
            .map_err(|e| e.at(format!("accessor {accessor}")))?,
        None => vec![[EdgeMark::Hidden; 3]; triangles.len()],
    };
    let mut hard = FxHashSet::default();
    for line in &edges.line_strings {
        let indices = buffers.indices(line.indices)?;
        for string in indices.values.split(|index| *index == indices.restart) {
            hard.extend(string.array_windows().map(|[a, b]| [*a.min(b), *a.max(b)]));
        }
    }
    if !hard.is_empty() {
        for ([a, b, c], [ab, bc, ca]) in triangles.iter().zip(&mut marks) {
            for (from, to, mark) in [(a, b, ab), (b, c, bc), (c, a, ca)] {
                if hard.contains(&[*from.min(to), *from.max(to)]) {
                    *mark = EdgeMark::Hard;
                }
            }
        }
    }
    Ok(marks)
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
    fn bits_are_read_as_the_draft_shows() {
        assert_eq!(stored(&[18, 2], 2).unwrap(), [[Hard, Hidden, Contour], [Hidden, Hard, Hidden]]);
        assert_eq!(stored(&[226, 2], 2).unwrap(), [[Hard, Hidden, Hard], [Hard, Hard, Hidden]]);
        assert!(stored(&[18], 2).is_err());
    }
}
