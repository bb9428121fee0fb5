//! [`Seen`]: the page in triangles, and what the eye sees in each.

use glam::{DVec2, DVec3};
use kurbo::Point;
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};

use super::cells::Triangulation;
use super::looks;
use super::noding::{self, Border, GridPoint};
use super::thin::{self, Segments};
use crate::drawing::{Length, Unit};
use crate::lines::{LineKind, Lit};
use crate::math::tolerance;
use crate::mesh::{MaterialId, PaintId, PartId};
use crate::view::Frame;
use crate::viewmap::{ViewMap, front_faces};

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
    /// The bin of light in which it is hatched, 0 the darkest; 0 where nothing is hatched.
    pub bin: u16,
    /// Whether it is as dark as it is because something else is between it and a light.
    pub cast: bool,
}

/// The page in triangles, and what the eye sees in each: regions of colour and what hatching is laid on
/// are both read from it, so that they can never disagree.
#[derive(Debug, Clone)]
pub struct Seen {
    pub(super) cut: Triangulation,
    /// What each triangle looks like: [`NOTHING`], or the number of a look plus 1.
    pub(super) looks: Vec<u32>,
    pub(super) table: Vec<Look>,
    /// User units in a step of the triangulation's grid.
    pub(super) step: f64,
    /// Cells in which different looks were seen, because a line around them breaks off.
    pub leaks: u64,
}

/// Which looks cast shadows darken: colours and hatching each have a switch of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Darkened {
    /// The tones of fills.
    pub tones: bool,
    /// The bins of hatching.
    pub bins: bool,
}

/// The visible lines that may part looks and the edge of the page, on a grid.
#[derive(Debug, Clone)]
pub struct PageBorders(Segments);

impl PageBorders {
    /// Those of a view map, before it is moved on the page, in the frame of its camera.
    #[must_use]
    pub fn of(map: &ViewMap, frame: &Frame) -> Self {
        Self(segments(map, [frame.width, frame.height], step(frame)))
    }
}

/// User units in a step of the grid.
fn step(frame: &Frame) -> f64 {
    frame.width.max(frame.height) / tolerance::REGION_STEPS
}

/// Cuts the page along borders and asks what is seen. `shadowed` tells which lights do not reach points of faces.
#[must_use]
pub fn see(
    lit: &Lit,
    PageBorders(segments): &PageBorders,
    shadowed: impl Fn(&[(u32, DVec3)]) -> Vec<u32>,
    darkened: Darkened,
    unit: Unit,
) -> Seen {
    let step = step(&lit.view.frame);
    let px = Length::px(1.0).in_unit(unit);
    let of_tone = match lit.shading.most_levels() {
        0 => tolerance::THIN_BIN_PX,
        1..=tolerance::FEW_LEVELS => tolerance::THIN_PX,
        _ => tolerance::THIN_STEP_PX,
    };
    let fine = |border: Border| if border.is_tone() { of_tone } else { tolerance::THIN_PX };
    let segments = thin::thinned(segments, |border| fine(border) * px / step);
    let noded = noding::node(&segments, tolerance::BRIDGE_PX * px / step);
    let cut = Triangulation::new(noded);

    let centres: Vec<DVec2> = (0..cut.triangles.len())
        .into_par_iter()
        .with_min_len(1 << 12)
        .map(|t| {
            let [a, b, c] = cut.corners(t).map(DVec2::from_array);
            (a + b + c) / 3.0 * step
        })
        .collect();
    let (looks, table) = looks_at(lit, &centres, shadowed, darkened);
    let (looks, leaks) = looks::decide(&cut, &looks, tolerance::LEAK_PX * px / step);
    Seen { cut, looks, table, step, leaks }
}

impl Seen {
    /// Whether anything is seen that looks so.
    pub(crate) fn shows(&self, is_so: impl Fn(&Look) -> bool) -> bool {
        self.table.iter().any(is_so)
    }

    /// The looks of the triangles under a coarser eye, by which different looks may count as one: their
    /// numbers as in [`Seen::looks`], and the table that these point to.
    pub(super) fn seen_as(&self, coarser: impl Fn(&Look) -> Look) -> (Vec<u32>, Vec<Look>) {
        let of: Vec<Look> = self.table.iter().map(coarser).collect();
        let mut table = of.clone();
        table.sort_unstable();
        table.dedup();
        let number: Vec<u32> =
            of.iter().map(|look| table.binary_search(look).map_or(NOTHING, |at| at as u32 + 1)).collect();
        let looks = self.looks.iter().map(|look| match look.checked_sub(1) {
            Some(k) => number.get(k as usize).copied().unwrap_or(NOTHING),
            None => NOTHING,
        });
        (looks.collect(), table)
    }
}

/// In lists of looks: only paper is seen.
pub(super) const NOTHING: u32 = 0;

fn segments(map: &ViewMap, page: [f64; 2], step: f64) -> Segments {
    let on_grid = |p: Point| [p.x, p.y].map(|x| (x / step).round() as i64);
    let [right, bottom] = page.map(|x| (x / step).round() as i64);
    let corners = [[0, 0], [right, 0], [right, bottom], [0, bottom]];
    let mut segments: Segments = (0..4).map(|k| ([corners[k], corners[(k + 1) % 4]], Border::Hard)).collect();
    let parting = map.edges.iter().filter(|edge| edge.invisibility == 0 && may_part(edge.kind));
    segments.extend(parting.map(|edge| {
        let ends = [edge.start, edge.end].map(|end| on_grid(map.vertices[end.index()].position));
        let inside = |p: GridPoint| [p[0].clamp(0, right), p[1].clamp(0, bottom)];
        let border = match (matches!(edge.kind, LineKind::Isophote | LineKind::Artist), edge.smooth) {
            (false, false) => Border::Hard,
            (false, true) => Border::Soft,
            (true, false) => Border::HardTone,
            (true, true) => Border::SoftTone,
        };
        (ends.map(inside), border)
    }));
    segments.retain(|([a, b], _)| a != b);
    segments
}

/// Whether the surface may look different on both sides of lines of a kind.
fn may_part(kind: LineKind) -> bool {
    use LineKind::{Artist, Border, Contour, Crease, Intersection, Isophote, Material};
    matches!(kind, Contour | Border | Crease | Material | Intersection | Isophote | Artist)
}

/// What is seen at points of the image: for each a number in the table of looks, whose first entry
/// stands for paper.
fn looks_at(
    lit: &Lit,
    points: &[DVec2],
    shadowed: impl Fn(&[(u32, DVec3)]) -> Vec<u32>,
    darkened: Darkened,
) -> (Vec<u32>, Vec<Look>) {
    let fronts = front_faces(lit.mesh, lit.view, points);
    let hits: Vec<(usize, u32, DVec3)> = fronts
        .par_iter()
        .zip(points)
        .enumerate()
        .with_min_len(1 << 12)
        .filter_map(|(k, (front, p))| {
            let front = front.as_ref()?;
            Some((k, front.face, lit.view.frame.local_from_image(p.extend(front.nearness))))
        })
        .collect();
    let asked: Vec<(u32, DVec3)> = hits.iter().map(|(_, face, at)| (*face, *at)).collect();
    let masks = shadowed(&asked);
    let looks: Vec<(usize, Look)> = hits
        .par_iter()
        .with_min_len(256)
        .with_max_len(512)
        .enumerate()
        .map(|(i, (k, face, at))| {
            (*k, look(lit, *face, *at, masks.get(i).copied().unwrap_or_default(), darkened))
        })
        .collect();
    // They are few, and come again and again.
    let some = looks.par_chunks(1 << 12).map(|looks| looks.iter().map(|(_, look)| *look).collect());
    let all: FxHashSet<Look> = some.reduce(FxHashSet::default, |mut all, some: FxHashSet<Look>| {
        all.extend(some);
        all
    });
    let mut table: Vec<Look> = all.into_iter().collect();
    table.sort_unstable();
    let number: FxHashMap<Look, u32> = table.iter().copied().zip(NOTHING + 1..).collect();
    let found: Vec<u32> = looks
        .par_iter()
        .with_min_len(1 << 12)
        .map(|(_, look)| number.get(look).copied().unwrap_or(NOTHING))
        .collect();
    let mut numbers = vec![NOTHING; points.len()];
    looks.iter().zip(found).for_each(|((k, _), found)| numbers[*k] = found);
    (numbers, table)
}

/// What a face looks like at a point of it.
fn look(lit: &Lit, face: u32, at: DVec3, shadowed: u32, darkened: Darkened) -> Look {
    let mesh = lit.mesh;
    let (material, paint) = (mesh.face_material[face as usize], lit.paint(face, at));
    let point = lit.at(face, at);
    let (tone_lit, bin_lit) = lit.tone_and_bin_shown(face, paint, &point, 0);
    let (tone_dark, bin_dark) = if shadowed == 0 {
        (tone_lit, bin_lit)
    } else {
        lit.tone_and_bin_shown(face, paint, &point, shadowed)
    };
    let tone = if darkened.tones { tone_dark } else { tone_lit };
    let bin = if darkened.bins { bin_dark } else { bin_lit };
    let cast = tone != tone_lit;
    Look { part: mesh.face_part[face as usize], material, paint, tone, bin, cast }
}
