//! Contours of tori have the pieces and cusps of the closed-form contour.

use std::collections::HashMap;

use super::smooth_contours::{cameras, contour_options, length, max_deviations};
use crate::library::support::measures::line_picture::length_farther_than;
use crate::library::support::pipeline::{Stages, run_stages, scene};
use crate::library::support::references::torus_contour::{self, VisibleArc, visible_arcs};
use crate::library::support::scenes::solids::torus;
use kurbo::Point;
use ligne::lines::{Contours, LineKind};
use ligne::scene::Projection;
use ligne::visibility::ViewVertexKind;

/// A connected piece of visible contour in the drawing.
struct DrawnPiece {
    length: f64,
    ends: usize,
    cusps: usize,
}

/// Groups visible contour edges that share a vertex.
fn drawn_pieces(drawn: &Stages) -> Vec<DrawnPiece> {
    let seen = || drawn.map.edges.iter().filter(|e| e.invisibility == 0 && e.kind == LineKind::Contour);
    let mut group: HashMap<u32, u32> = HashMap::new();
    fn first(group: &mut HashMap<u32, u32>, v: u32) -> u32 {
        let above = *group.entry(v).or_insert(v);
        if above == v { v } else { first(group, above) }
    }
    let mut degree: HashMap<u32, usize> = HashMap::new();
    for edge in seen() {
        let (a, b) = (first(&mut group, edge.start.0), first(&mut group, edge.end.0));
        group.insert(a, b);
        *degree.entry(edge.start.0).or_default() += 1;
        *degree.entry(edge.end.0).or_default() += 1;
    }
    let mut pieces: HashMap<u32, DrawnPiece> = HashMap::new();
    for edge in seen() {
        let own = first(&mut group, edge.start.0);
        let piece = pieces.entry(own).or_insert(DrawnPiece { length: 0.0, ends: 0, cusps: 0 });
        let [a, b] = drawn.edge_ends(edge);
        piece.length += (b - a).hypot();
        for end in [edge.start, edge.end].iter().filter(|v| degree[&v.0] == 1) {
            piece.ends += 1;
            let kind = drawn.map.vertices[end.index()].kind;
            piece.cusps += usize::from(kind != ViewVertexKind::TJunction);
        }
    }
    pieces.into_values().collect()
}

/// Counts loops and open lines of at least `least` px, and the cusps at their ends.
fn census<'a, T: 'a>(
    pieces: impl IntoIterator<Item = &'a T>,
    least: f64,
    tell: impl Fn(&T) -> (f64, bool, usize),
) -> [usize; 3] {
    let mut counts = [0; 3];
    for (length, closed, cusps) in pieces.into_iter().map(tell) {
        if length >= least {
            counts[usize::from(!closed)] += 1;
            counts[2] += cusps;
        }
    }
    counts
}

/// Results over 30 views of a torus.
#[derive(Debug, Default)]
struct TorusTally {
    /// Number of views with pieces or cusps that differ from the closed form.
    wrong: usize,
    /// Largest distance of the drawn contours from the full contour, visible or hidden, px.
    off: f64,
    /// Length drawn where there should be none, and length missing, px.
    extra: f64,
    missing: f64,
    length: f64,
}

/// Shorter pieces and gaps are not counted, because they depend on the view on a coarse torus, px.
const MIN_PIECE_LENGTH_PX: f64 = 14.0;

fn torus_views(around: usize, along: usize, radius: f64, tube: f64, within: f64) -> TorusTally {
    let solid = scene([torus(around, along, radius, tube)]);
    let mut tally = TorusTally::default();
    for camera in cameras(9, 30, radius + tube) {
        let is_parallel = matches!(camera.projection, Projection::Orthographic { .. });
        if !is_parallel && camera.eye.z.abs() < 1.2 * tube {
            continue;
        }
        let drawn = run_stages(&solid, &camera, &contour_options(Contours::Smooth));
        let loops = torus_contour::torus_contours(radius, tube, &camera, 8000);
        let truth = visible_arcs(&loops);
        let should: Vec<[Point; 2]> = truth.iter().flat_map(VisibleArc::segments).collect();
        let whole = loops.iter().flat_map(|l| (0..l.len()).map(|k| [l[k].image, l[(k + 1) % l.len()].image]));
        let whole: Vec<[Point; 2]> = whole.collect();
        let is = drawn.visible_segments();
        let wanted = census(&truth, MIN_PIECE_LENGTH_PX, |p| (length(&p.segments()), p.closed, p.cusps));
        let pieces = drawn_pieces(&drawn);
        let found = census(&pieces, MIN_PIECE_LENGTH_PX, |p| (p.length, p.ends == 0, p.cusps));
        let off = max_deviations(&is, &whole)[0];
        let (extra, missing) =
            (length_farther_than(&is, &should, within), length_farther_than(&should, &is, within));
        if wanted != found || extra > 0.0 || missing > 0.0 {
            println!(
                "torus {around}x{along} of {tube} from {:.3?} {:?}: loops, lines, cusps {found:?}, \
                 should be {wanted:?}; {off:.3} px off, {extra:.2} px extra, {missing:.2} px missing",
                camera.eye.to_array(),
                camera.projection
            );
        }
        tally.wrong += usize::from(wanted != found);
        tally.off = tally.off.max(off);
        tally.extra += extra;
        tally.missing += missing;
        tally.length += length(&should);
    }
    println!("torus {around}x{along} of {tube}: {tally:?}");
    tally
}

#[test]
fn the_contour_of_a_torus_has_its_pieces_and_cusps() {
    // Limits: views of 30 with different pieces, and extra and missing length in thousandths. The polyhedron
    // shows pieces of 1 to 3 px near cusps that the torus does not have; tidying removes them later.
    for (tube, around, within, wrong, [extra, missing]) in [
        (0.25, 24, 0.5, 8, [4.2, 0.2]),
        (0.25, 48, 0.5, 2, [4.2, 0.2]),
        (0.25, 96, 0.5, 2, [4.2, 0.2]),
        (0.45, 24, 0.5, 10, [5.0, 0.2]),
        (0.45, 48, 0.5, 4, [5.0, 0.2]),
        (0.45, 96, 0.5, 4, [5.0, 0.2]),
    ] {
        let tally = torus_views(around, around / 2, 1.0, tube, within);
        assert!(tally.wrong <= wrong, "{tally:?}");
        let share = |length: f64| 1000.0 * length / tally.length;
        assert!(share(tally.extra) <= extra && share(tally.missing) <= missing, "{tally:?}");
    }
}
