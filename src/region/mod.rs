//! [`Regions`]: the parts of the page that look alike, with borders that neighbours share.
//!
//! The page is cut along all visible lines that may part two looks, triangulated under these
//! constraints, and the eye is asked what it sees in the middle of each triangle. Triangles without
//! a line between them must look alike; those that do look alike and hang together are a region. The
//! border between two regions is one curve, which both use.

mod arcs;
mod cells;
mod looks;
mod merge;
mod noding;
pub mod options;
pub mod paint;
mod thin;

use glam::DVec2;
use kurbo::{BezPath, Point};
use rayon::prelude::*;

pub use options::{RegionOptions, Seams};
pub use paint::paint;

use crate::chain::{self, ChainOptions};
use crate::drawing::{Length, Unit};
use crate::lines::{LineKind, Lit};
use crate::math::tolerance;
use crate::mesh::{FaceId, MaterialId, PaintId, PartId};
use crate::viewmap::{ViewMap, front_faces};
use arcs::{OUTSIDE_PATCH, RawArc};
use cells::Triangulation;
use noding::GridPoint;
use thin::Segments;

/// What a part of the page looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Look {
    /// The part of the model that is seen.
    pub part: PartId,
    /// Its material.
    pub material: MaterialId,
    /// What it is painted with: its material, or that in the colour of its texture.
    pub paint: PaintId,
    /// Its tone, 0 the darkest.
    pub tone: u16,
    /// Whether it is as dark as it is because something else is between it and a light.
    pub cast: bool,
}

/// A stretch of border between two regions.
#[derive(Debug, Clone, PartialEq)]
pub struct Border {
    /// The curve, in user units; both regions are painted up to it.
    pub path: BezPath,
    /// The regions on both sides: first the one that lies to the right of the path as the page is
    /// seen (y down). None beyond the page and where there is only paper.
    pub sides: [Option<u32>; 2],
    /// Whether it closes on itself.
    pub closed: bool,
}

/// A part of the page that looks alike and hangs together.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// What it looks like.
    pub look: Look,
    /// Its area, user units squared.
    pub area: f64,
    /// The loops around it and around its holes: borders by their number in [`Regions::borders`], and
    /// whether they are run through from their start.
    pub loops: Vec<Vec<(u32, bool)>>,
}

/// All regions of a drawing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Regions {
    /// The regions.
    pub regions: Vec<Region>,
    /// Their borders.
    pub borders: Vec<Border>,
    /// Cells in which different looks were seen, because a line around them breaks off.
    pub leaks: u64,
}

/// Gathers the regions of a view from the visible lines of its view map, before the map is moved on
/// the page. `shadowed` tells which lights do not reach points of faces.
#[must_use]
pub fn gather(
    lit: &Lit,
    map: &ViewMap,
    shadowed: impl Fn(&[(u32, glam::DVec3)]) -> Vec<u32>,
    options: &RegionOptions,
    chain: &ChainOptions,
    unit: Unit,
) -> Regions {
    let frame = &lit.view.frame;
    let step = frame.width.max(frame.height) / tolerance::REGION_STEPS;
    let px = Length::px(1.0).in_unit(unit);
    let segments = segments(map, [frame.width, frame.height], step);
    let segments = thin::thinned(&segments, tolerance::THIN_PX * px / step);
    let noded = noding::node(&segments, tolerance::BRIDGE_PX * px / step);
    let cut = Triangulation::new(noded);

    let centres: Vec<DVec2> = (0..cut.triangles.len())
        .map(|t| {
            let [a, b, c] = cut.corners(t).map(DVec2::from_array);
            (a + b + c) / 3.0 * step
        })
        .collect();
    let (looks, table) = seen(lit, &centres, shadowed);
    let (looks, leaks) = looks::decide(&cut, &looks, tolerance::LEAK_PX * px / step);

    let crumb = options.crumb.in_unit(unit).max(0.0) / step;
    let patches = merge::gather(&cut, &looks, NOTHING, 2.0 * crumb * crumb);
    regions(&cut, &patches, &table, &Drawn { step, leaks, options, chain, unit })
}

/// In lists of looks: only paper is seen.
const NOTHING: u32 = 0;

/// The visible lines that may part looks and the edge of the page, on a grid.
fn segments(map: &ViewMap, page: [f64; 2], step: f64) -> Segments {
    let on_grid = |p: Point| [p.x, p.y].map(|x| (x / step).round() as i64);
    let [right, bottom] = page.map(|x| (x / step).round() as i64);
    let corners = [[0, 0], [right, 0], [right, bottom], [0, bottom]];
    let mut segments: Segments = (0..4).map(|k| ([corners[k], corners[(k + 1) % 4]], false)).collect();
    let parting = map.edges.iter().filter(|edge| edge.invisibility == 0 && may_part(edge.kind));
    segments.extend(parting.map(|edge| {
        let ends = [edge.start, edge.end].map(|end| on_grid(map.vertices[end.index()].position));
        let inside = |p: GridPoint| [p[0].clamp(0, right), p[1].clamp(0, bottom)];
        (ends.map(inside), edge.smooth)
    }));
    segments.retain(|([a, b], _)| a != b);
    segments
}

/// Whether the surface may look different on both sides of lines of a kind.
fn may_part(kind: LineKind) -> bool {
    use LineKind::{Border, Contour, Crease, Intersection, Isophote, Material};
    matches!(kind, Contour | Border | Crease | Material | Intersection | Isophote)
}

/// What is seen at points of the image: for each a number in the table of looks, whose first entry
/// stands for paper.
fn seen(
    lit: &Lit,
    points: &[DVec2],
    shadowed: impl Fn(&[(u32, glam::DVec3)]) -> Vec<u32>,
) -> (Vec<u32>, Vec<Look>) {
    let fronts = front_faces(lit.mesh, lit.view, points);
    let hits: Vec<(usize, u32, glam::DVec3)> = fronts
        .iter()
        .zip(points)
        .enumerate()
        .filter_map(|(k, (front, p))| {
            let front = front.as_ref()?;
            Some((k, front.face, lit.view.frame.local_from_image(p.extend(front.nearness))))
        })
        .collect();
    let asked: Vec<(u32, glam::DVec3)> = hits.iter().map(|(_, face, at)| (*face, *at)).collect();
    let masks = shadowed(&asked);
    let looks: Vec<(usize, Look)> = hits
        .par_iter()
        .with_min_len(256)
        .enumerate()
        .map(|(i, (k, face, at))| (*k, look(lit, *face, *at, masks.get(i).copied().unwrap_or_default())))
        .collect();
    let mut table: Vec<Look> = looks.iter().map(|(_, look)| *look).collect();
    table.sort_unstable();
    table.dedup();
    let mut numbers = vec![NOTHING; points.len()];
    for (k, look) in looks {
        numbers[k] = table.binary_search(&look).map_or(NOTHING, |at| at as u32 + 1);
    }
    (numbers, table)
}

/// What a face looks like at a point of it.
fn look(lit: &Lit, face: u32, at: glam::DVec3, shadowed: u32) -> Look {
    let mesh = lit.mesh;
    let (material, paint) = (mesh.face_material[face as usize], mesh.paint(FaceId(face)));
    let [a, b, c] = mesh.corners(FaceId(face));
    let normal = (b - a).cross(c - a);
    let whole = normal.length_squared();
    let part = |p: glam::DVec3, q: glam::DVec3| (p - at).cross(q - at).dot(normal) / whole;
    let weights = if whole > 0.0 { [part(b, c), part(c, a), part(a, b)] } else { [1.0, 0.0, 0.0] };
    let point = lit.point(face, weights);
    let tone = lit.tone(paint, &point, shadowed);
    let cast = shadowed != 0 && lit.tone(paint, &point, 0) != tone;
    Look { part: mesh.face_part[face as usize], material, paint, tone, cast }
}

/// How borders are drawn.
struct Drawn<'a> {
    step: f64,
    leaks: u64,
    options: &'a RegionOptions,
    chain: &'a ChainOptions,
    unit: Unit,
}

/// The regions of painted patches, and their borders.
fn regions(cut: &Triangulation, patches: &merge::Patches, table: &[Look], drawn: &Drawn) -> Regions {
    // All paper counts as one: there is no border within it, nor between it and what is beyond.
    let is_paper = |patch: u32| patches.looks[patch as usize] == NOTHING;
    let owner: Vec<u32> =
        patches.of.iter().map(|patch| if is_paper(*patch) { OUTSIDE_PATCH } else { *patch }).collect();
    let traced = arcs::trace(cut, &owner, patches.looks.len());
    let mut number: Vec<Option<u32>> = vec![None; patches.looks.len()];
    let mut regions = Vec::new();
    for (patch, loops) in traced.loops.into_iter().enumerate() {
        let look = patches.looks[patch].checked_sub(1).and_then(|k| table.get(k as usize));
        if let (false, Some(look)) = (loops.is_empty(), look) {
            number[patch] = Some(regions.len() as u32);
            let area = patches.area2[patch] / 2.0 * drawn.step * drawn.step;
            regions.push(Region { look: *look, area, loops });
        }
    }
    let of = |patch: u32| number.get(patch as usize).copied().flatten();
    let borders = traced
        .arcs
        .par_iter()
        .with_min_len(4)
        .map(|arc| Border { path: curve(cut, arc, drawn), sides: arc.sides.map(of), closed: arc.closed })
        .collect();
    Regions { regions, borders, leaks: drawn.leaks }
}

/// The curve of an arc.
fn curve(cut: &Triangulation, arc: &RawArc, drawn: &Drawn) -> BezPath {
    let at = |v: &u32| {
        let [x, y] = cut.points[*v as usize];
        Point::new(x as f64 * drawn.step, y as f64 * drawn.step)
    };
    let points: Vec<Point> = arc.points.iter().map(at).collect();
    let px = Length::px(1.0);
    let chain = ChainOptions {
        smooth: if drawn.chain.smooth.in_unit(drawn.unit) > px.in_unit(drawn.unit) * SMOOTH_PX {
            Length::px(SMOOTH_PX)
        } else {
            drawn.chain.smooth
        },
        fit_tolerance: drawn.options.fit_tolerance,
        ..drawn.chain.clone()
    };
    chain::curve(&points, &arc.soft, arc.closed, tolerance::REGION_SNAP * drawn.step, &chain, drawn.unit)
}

/// Smoothing may move borders by no more than this, px: neighbours lie near to each other.
const SMOOTH_PX: f64 = 0.1;
