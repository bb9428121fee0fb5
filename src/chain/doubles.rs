//! Drops second strokes: lines that run beside a longer one within a pen's width.

use kurbo::{Point, Vec2};

use super::line::{distance2, length};
use super::link::{Class, Routes, Step};
use crate::lines::LineKind;
use crate::viewmap::ViewMap;

/// Cosine of the largest angle (35 degrees) between strokes that count as parallel.
const PARALLEL_COSINE: f64 = 0.82;

/// Part of a line that must run beside others for the whole to be a double.
const COVERED: f64 = 0.8;

/// Length, in distances, over which the direction of a jagged line is taken.
const WINDOW: f64 = 4.0;

/// A line shorter than this many distances doubles another at twice the distance.
const FLAKE: f64 = 16.0;

/// A piece of a visible line in a bucket of the page.
#[derive(Debug, Clone, Copy)]
struct Piece {
    route: u32,
    a: Point,
    b: Point,
    direction: Vec2,
}

/// Pieces by square cells of the page.
struct Buckets {
    cell: f64,
    corner: Point,
    columns: usize,
    rows: usize,
    first: Vec<u32>,
    pieces: Vec<u32>,
}

/// Takes the class from the edges of smooth contours and noisy creases that double a longer
/// visible line within `distance`, shortest first; returns whether there was any.
pub(super) fn drop_doubles(
    map: &ViewMap,
    routes: &Routes,
    organic: &[bool],
    distance: f64,
    classes: &mut [Option<Class>],
) -> bool {
    let mut pieces: Vec<Piece> = Vec::new();
    let mut spans: Vec<(usize, usize)> = Vec::with_capacity(routes.len());
    let mut lengths: Vec<f64> = Vec::with_capacity(routes.len());
    let mut silhouettes: Vec<bool> = Vec::with_capacity(routes.len());
    let mut suspects: Vec<u32> = Vec::new();
    for (route, (steps, _)) in routes.iter().enumerate() {
        let first = pieces.len();
        let mut total = 0.0;
        if let Some(class) = steps.first().and_then(|s| classes[s.edge as usize]).filter(|c| !c.hidden) {
            collect(map, route as u32, steps, distance, &mut pieces);
            total = pieces[first..].iter().map(|p| length(p.b - p.a)).sum();
            if is_suspect(map, steps, class, organic) {
                suspects.push(route as u32);
            }
        }
        spans.push((first, pieces.len()));
        // A silhouette is never the weaker of two.
        let silhouette = steps.first().and_then(|s| classes[s.edge as usize]).is_some_and(|c| c.silhouette);
        silhouettes.push(silhouette);
        lengths.push(if silhouette { total * 1e3 } else { total });
    }
    if suspects.is_empty() {
        return false;
    }
    let Some(buckets) = Buckets::new(&pieces, 4.0 * distance) else { return false };
    suspects.sort_by(|a, b| lengths[*a as usize].total_cmp(&lengths[*b as usize]).then(a.cmp(b)));
    let mut gone = vec![false; routes.len()];
    for route in suspects {
        let (first, end) = spans[route as usize];
        let own = &pieces[first..end];
        let total: f64 = own.iter().map(|p| length(p.b - p.a)).sum();
        // The shorter, the more likely a flake; but a gap in the outline is worse than a double.
        let (allowed, distance) = match (silhouettes[route as usize], total < FLAKE * distance) {
            (true, _) => (0.0, distance),
            (false, true) => ((1.0 - COVERED) * total, 2.0 * distance),
            (false, false) => ((1.0 - COVERED) * total, distance),
        };
        let mut bare = 0.0;
        for piece in own {
            if !buckets.beside(&pieces, piece, distance, |other| {
                other != route && !gone[other as usize] && lengths[other as usize] > lengths[route as usize]
            }) {
                bare += length(piece.b - piece.a);
                if bare > allowed {
                    break;
                }
            }
        }
        if total > 0.0 && bare <= allowed {
            gone[route as usize] = true;
            for step in routes.get(route as usize).0 {
                classes[step.edge as usize] = None;
            }
        }
    }
    gone.contains(&true)
}

/// Whether a line may be a double at all: exact models draw every line they have.
fn is_suspect(map: &ViewMap, steps: &[Step], class: Class, organic: &[bool]) -> bool {
    match class.kind {
        LineKind::Contour => {
            let smooth = steps.iter().filter(|s| map.edges[s.edge as usize].smooth).count();
            2 * smooth > steps.len()
        }
        LineKind::Crease => organic.get(class.part.index()).copied().unwrap_or(false),
        _ => false,
    }
}

/// The pieces of a route, with the direction each has over a few distances.
fn collect(map: &ViewMap, route: u32, steps: &[Step], distance: f64, pieces: &mut Vec<Piece>) {
    let at = |k: usize| match steps.get(k) {
        Some(step) => map.vertices[step.from(map).index()].position,
        None => steps.last().map_or(Point::ZERO, |step| map.vertices[step.to(map).index()].position),
    };
    let reach = WINDOW * distance / 2.0;
    for k in 0..steps.len() {
        let (a, b) = (at(k), at(k + 1));
        let mut low = k;
        while low > 0 && length(at(low) - a) < reach {
            low -= 1;
        }
        let mut high = k + 1;
        while high < steps.len() && length(at(high) - b) < reach {
            high += 1;
        }
        pieces.push(Piece { route, a, b, direction: super::fit::unit(at(high) - at(low)) });
    }
}

impl Buckets {
    fn new(pieces: &[Piece], cell: f64) -> Option<Self> {
        let ends = || pieces.iter().flat_map(|p| [p.a, p.b]);
        let mut low = ends().next()?;
        let mut high = low;
        for p in ends() {
            low = Point::new(low.x.min(p.x), low.y.min(p.y));
            high = Point::new(high.x.max(p.x), high.y.max(p.y));
        }
        // Giant pages get larger cells rather than more than a million.
        let cell = cell.max((high.x - low.x) / 1000.0).max((high.y - low.y) / 1000.0);
        if !cell.is_finite() || cell <= 0.0 {
            return None;
        }
        let columns = ((high.x - low.x) / cell) as usize + 1;
        let rows = ((high.y - low.y) / cell) as usize + 1;
        let mut buckets =
            Self { cell, corner: low, columns, rows, first: vec![0; columns * rows + 1], pieces: Vec::new() };
        for piece in pieces {
            buckets.each_cell(piece.a, piece.b, 0.0).for_each(|c| buckets.first[c + 1] += 1);
        }
        for c in 1..buckets.first.len() {
            buckets.first[c] += buckets.first[c - 1];
        }
        let mut next = buckets.first.clone();
        buckets.pieces = vec![0; buckets.first.last().copied().unwrap_or(0) as usize];
        for (i, piece) in pieces.iter().enumerate() {
            for c in buckets.each_cell(piece.a, piece.b, 0.0) {
                buckets.pieces[next[c] as usize] = i as u32;
                next[c] += 1;
            }
        }
        Some(buckets)
    }

    /// Cells that a segment, widened by `margin`, touches; along long segments it is taken in parts
    /// so that their boxes stay small.
    fn each_cell(&self, a: Point, b: Point, margin: f64) -> impl Iterator<Item = usize> + use<> {
        let parts = ((length(b - a) / self.cell).ceil() as usize).clamp(1, 4096);
        let mut cells: Vec<usize> = Vec::with_capacity(4);
        let column = |x: f64| (((x - self.corner.x) / self.cell).max(0.0) as usize).min(self.columns - 1);
        let row = |y: f64| (((y - self.corner.y) / self.cell).max(0.0) as usize).min(self.rows - 1);
        for part in 0..parts {
            let p = a.lerp(b, part as f64 / parts as f64);
            let q = a.lerp(b, (part + 1) as f64 / parts as f64);
            for y in row(p.y.min(q.y) - margin)..=row(p.y.max(q.y) + margin) {
                for x in column(p.x.min(q.x) - margin)..=column(p.x.max(q.x) + margin) {
                    cells.push(y * self.columns + x);
                }
            }
        }
        cells.sort_unstable();
        cells.dedup();
        cells.into_iter()
    }

    /// Whether a parallel piece of an admitted route runs within `distance` of the piece's middle.
    fn beside(&self, pieces: &[Piece], piece: &Piece, distance: f64, admit: impl Fn(u32) -> bool) -> bool {
        let middle = piece.a.midpoint(piece.b);
        self.each_cell(middle, middle, distance).any(|cell| {
            let range = self.first[cell] as usize..self.first[cell + 1] as usize;
            self.pieces[range].iter().map(|i| &pieces[*i as usize]).any(|other| {
                admit(other.route)
                    && distance2(middle, other.a, other.b) <= distance * distance
                    && other.direction.dot(piece.direction).abs() >= PARALLEL_COSINE
            })
        })
    }
}
