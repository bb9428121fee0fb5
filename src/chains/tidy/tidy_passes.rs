//! Tidying passes: decides which lines are drawn, and stitches them together.
//!
//! Source: Bénard, Hertzmann and Kass, Computing smooth surface contours with accurate topology, ACM
//! Transactions on Graphics 2014, section 6. Lines without junctions are removed if they are short with free
//! ends, loop on themselves or run next to others. This repeats until nothing changes, here for at most three
//! rounds.

use crate::parallel::prelude::*;

use super::double_lines::drop_doubles;
use super::hidden_gaps::bridge_gaps;
use super::raw_line::{RawLine, VertexDegrees};
use super::removed_lines::{RemovalLog, RemovalReason};
use super::short_lines::drop_short_lines;
use super::silhouette_runs::{self, MinRunLengths};
use super::stitching::stitch;
use crate::chains::link::edge_class::EdgeClass;
use crate::chains::link::routes::routes;
use crate::lines::{HiddenLines, LineKind};
use crate::surface::MeshSource;
use crate::visibility::{GapOcclusion, ViewEdge, ViewMap};

/// Largest hidden gap that is bridged, in tidy lengths.
const MAX_HIDDEN_GAP_TIDY_LENGTHS: f64 = 0.6;

/// Minimum length of a silhouette or inner run on rounded surfaces, in tidy lengths.
const MIN_SMOOTH_RUN_TIDY_LENGTHS: f64 = 3.0;

/// Minimum length of such a run on sharp edges, where its ends are exact, in tidy lengths.
const MIN_SHARP_RUN_TIDY_LENGTHS: f64 = 1.0;

/// Minimum length of a line, in tidy lengths; a shorter one is less than a dot of the pen.
const MIN_LINE_TIDY_LENGTHS: f64 = 0.1;

/// Maximum number of rounds of stitching and dropping. Each may free the ends of other lines.
const MAX_ROUNDS: usize = 3;

/// The tidied lines of a view map. Hidden lines are left out if they are not drawn; all other dropped lines
/// are recorded in `bin`.
pub(crate) fn tidied(
    map: &ViewMap,
    hidden: HiddenLines,
    tidy: f64,
    window: f64,
    ahead: Option<&GapOcclusion>,
    bin: &mut RemovalLog,
) -> Vec<RawLine> {
    let mut classes: Vec<Option<EdgeClass>> =
        map.edges.par_iter().map(|e| Some(EdgeClass::of(map, e))).collect();
    if tidy > 0.0 {
        drop_thin_folds(map, &mut classes, bin);
        // Only contours have such gaps, and contours are continued by contours only.
        let is_contour = |e: &ViewEdge| e.kind == LineKind::Contour;
        if map.edges.par_iter().any(|e| e.invisibility > 0 && e.smooth && is_contour(e)) {
            let source = |(e, class): (&ViewEdge, &Option<EdgeClass>)| {
                class.filter(|_| is_contour(e)).map(|_| EdgeClass::of_source(map, e))
            };
            let sources: Vec<Option<EdgeClass>> = map.edges.par_iter().zip(&classes).map(source).collect();
            bridge_gaps(
                map,
                &routes(map, &sources, window),
                MAX_HIDDEN_GAP_TIDY_LENGTHS * tidy,
                ahead,
                &mut classes,
            );
        }
    }
    classes.par_iter_mut().for_each(|slot| {
        let Some(class) = slot else { return };
        if class.hidden && hidden == HiddenLines::None {
            *slot = None;
        } else if tidy > 0.0 {
            class.silhouette = false;
        } else {
            // Without tidying nothing counts as noise.
            class.origin = MeshSource::Constructed;
        }
    });
    let routes = routes(map, &classes, window);
    let raw = |route| RawLine::of_route(map, &routes, route, &classes);
    let all = || (0..routes.len()).into_par_iter().with_min_len(64).with_max_len(128).map(raw).collect();
    let (raws, mut degrees): (Vec<Option<RawLine>>, VertexDegrees) =
        crate::parallel::join(all, || VertexDegrees::new(map, &classes));
    let mut raws: Vec<RawLine> = raws.into_iter().flatten().collect();
    if tidy <= 0.0 {
        return raws;
    }
    for _ in 0..MAX_ROUNDS {
        let count = raws.len();
        raws = stitch(raws, &mut degrees, tidy, ahead, bin);
        drop_doubles(&mut raws, &mut degrees, tidy, bin);
        drop_short_lines(&mut raws, &mut degrees, tidy, bin);
        if raws.len() == count {
            break;
        }
    }
    cut(raws, tidy, bin)
}

/// Drops dots, and cuts lines where they change between silhouette and inner contour.
fn cut(mut raws: Vec<RawLine>, tidy: f64, bin: &mut RemovalLog) -> Vec<RawLine> {
    let shortest =
        MinRunLengths { soft: MIN_SMOOTH_RUN_TIDY_LENGTHS * tidy, hard: MIN_SHARP_RUN_TIDY_LENGTHS * tidy };
    let parts = |raw: &mut RawLine| {
        let is_dot = !raw.class.hidden && raw.length() < MIN_LINE_TIDY_LENGTHS * tidy;
        if is_dot { Some(Vec::new()) } else { silhouette_runs::split_at_silhouette(raw, shortest) }
    };
    let parts: Vec<Option<Vec<RawLine>>> = raws.par_iter_mut().with_max_len(16).map(parts).collect();
    // Most lines stay whole, and then nothing is moved.
    if parts.iter().all(Option::is_none) {
        return raws;
    }
    let mut all = Vec::with_capacity(raws.len());
    for (raw, parts) in raws.into_iter().zip(parts) {
        match parts {
            None => all.push(raw),
            Some(parts) => {
                if parts.is_empty() {
                    bin.record(&raw, || RemovalReason::Point);
                }
                all.extend(parts);
            }
        }
    }
    all
}

/// Drops the sides of folds that are thinner than a pen, except silhouette.
fn drop_thin_folds(map: &ViewMap, classes: &mut [Option<EdgeClass>], bin: &mut RemovalLog) {
    if map.thin_folds.is_empty() {
        return;
    }
    for (edge, class) in map.edges.iter().zip(classes) {
        // A gap in the silhouette would be worse.
        if !edge.silhouette && map.thin_folds.binary_search(&edge.segment).is_ok() {
            *class = None;
            if edge.invisibility == 0 {
                let ends = [edge.start, edge.end].map(|v| map.vertices[v.index()].position);
                bin.record_piece(edge.kind, RemovalReason::Double, ends);
            }
        }
    }
}
