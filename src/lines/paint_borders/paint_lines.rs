//! Adds the borders between painted colours, of pictures and of vertices, to the feature lines.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::face_borders::{PaintBorder, borders};
use super::tone_edges::ToneEdge;
use crate::lines::feature_line::segment;
use crate::lines::isophotes::isophote_lines::page_px;
use crate::lines::shared_points::PointIds;
use crate::lines::{FeatureLines, FeatureSegment, LineKind, Lit, NO_FACE};
use crate::mesh::FaceId;

/// Adds the borders on faces, and the edges that separate two colours along a part only.
pub(crate) fn find(lit: &Lit, seams: Vec<ToneEdge>, lines: &mut FeatureLines) {
    if lit.textures.is_empty() {
        return;
    }
    const FACES_PER_TASK: usize = 1 << 11;
    let px = page_px(lit);
    let count = lit.mesh.triangles.len();
    let found: Vec<Vec<(u32, LineKind, [DVec3; 2])>> = (0..count.div_ceil(FACES_PER_TASK))
        .into_par_iter()
        .with_max_len(1)
        .map(|chunk| {
            let mut pieces = Vec::new();
            for face in chunk * FACES_PER_TASK..((chunk + 1) * FACES_PER_TASK).min(count) {
                let face = face as u32;
                let is_seen = lit.may_be_seen(face as usize) && !lit.mesh.is_degenerate(FaceId(face));
                if !is_seen {
                    continue;
                }
                let mut put = |kind: LineKind, ends: [[f64; 3]; 2]| {
                    let ends = ends.map(|weights| lit.lifted(face, weights, px));
                    if ends[0] != ends[1] {
                        pieces.push((face, kind, ends));
                    }
                };
                if let Some(textured) = lit.textures.face_texture(lit.mesh, face) {
                    for PaintBorder { ends, paints: [a, b] } in borders(lit, face, &textured) {
                        put(lit.textures.line_kind_between(a, b), ends);
                    }
                }
                if let Some(ink) = lit.textures.ink_on(lit.mesh, face) {
                    for PaintBorder { ends, paints } in borders(lit, face, &ink) {
                        let kind = lit.textures.picture_line_kind_between(lit.mesh, face, paints);
                        if kind == LineKind::Artist {
                            put(kind, ends);
                        }
                    }
                }
            }
            pieces
        })
        .collect();
    let own = lines.points.len();
    lines.append_in_faces(
        lit.mesh,
        &found,
        |piece| piece,
        |face, kind, ends| segment(lit.mesh, face, [face, NO_FACE], kind, ends),
    );
    if seams.is_empty() {
        return;
    }
    let first = lit.mesh.positions.len() as u32;
    let mut ids = PointIds::new(&lines.points[own..], first + own as u32);
    for ToneEdge { segment, pieces } in seams {
        for (places, kind) in pieces {
            let ends = [0, 1].map(|k| match places[k] {
                None => segment.ends[k],
                Some(weights) => ids.of(&mut lines.points, first, lit.lifted(segment.hosts[0], weights, px)),
            });
            lines.segments.push(FeatureSegment { ends, kind, ..segment });
        }
    }
}
