//! [`LabelledPage`]: the page as labelled triangles.

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};
use kurbo::Point;

use super::cell_labels;
use super::point_labels::label_points;
use super::surface_label::{NO_LABEL, ShadowDarkening, SurfaceLabel};
use crate::drawing::{Length, Unit};
use crate::lines::{LineKind, Lit};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::regions::arrangement::border_simplification::{self, Segments};
use crate::regions::arrangement::grid_tiles::GridPoint;
use crate::regions::arrangement::snap_rounding::{self, Border};
use crate::regions::cells::triangulation::Triangulation;
use crate::regions::tolerances;
use crate::view::Frame;
use crate::visibility::ViewMap;

/// The page as labelled triangles. Regions of colour and hatching are both derived from it, so they cannot
/// disagree.
#[derive(Debug, Clone)]
pub(crate) struct LabelledPage {
    pub(crate) cut: Triangulation,
    /// Label of each triangle: [`NO_LABEL`], or an index into `table` plus 1.
    pub(crate) triangle_labels: Vec<u32>,
    pub(crate) table: Vec<SurfaceLabel>,
    /// User units per grid step of the triangulation.
    pub(crate) step: f64,
    /// Number of cells with different labels, because a line around them has a gap.
    pub leaks: u64,
}

/// Visible lines that may separate labels, and the edge of the page, on the grid.
#[derive(Debug, Clone)]
pub(crate) struct PageBorders(Segments);

impl PageBorders {
    /// Lines of a view map in its camera frame, before it is moved on the page.
    #[must_use]
    pub(crate) fn of(map: &ViewMap, frame: &Frame) -> Self {
        Self(segments(map, [frame.width, frame.height], step(frame)))
    }
}

/// User units per grid step.
fn step(frame: &Frame) -> f64 {
    frame.width.max(frame.height) / tolerances::REGION_GRID_STEPS
}

/// Triangulates the page along the borders, and labels the triangles.
///
/// `shadowed` returns a mask of the lights that do not reach each point; `None` if nothing casts shadows.
#[must_use]
pub(crate) fn label_page(
    lit: &Lit,
    PageBorders(segments): &PageBorders,
    shadowed: Option<impl Fn(&[(u32, DVec3)]) -> Vec<u32>>,
    darkened: ShadowDarkening,
    unit: Unit,
) -> LabelledPage {
    let step = step(&lit.view.frame);
    let px = Length::px(1.0).in_unit(unit);
    let of_tone = match lit.shading.most_levels() {
        0 => tolerances::BIN_SIMPLIFY_PX,
        1..=crate::light::tolerances::MAX_SEPARATE_LEVELS => tolerances::BORDER_SIMPLIFY_PX,
        _ => tolerances::GRADIENT_SIMPLIFY_PX,
    };
    let fine = |border: Border| if border.is_tone() { of_tone } else { tolerances::BORDER_SIMPLIFY_PX };
    let segments = border_simplification::simplify_borders(segments, |border| fine(border) * px / step);
    let noded = snap_rounding::node(&segments, tolerances::MAX_BRIDGE_PX * px / step);
    let cut = Triangulation::new(noded);

    let centres: Vec<DVec2> = (0..cut.triangles.len())
        .into_par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .map(|t| {
            let [a, b, c] = cut.corners(t).map(DVec2::from_array);
            (a + b + c) / 3.0 * step
        })
        .collect();
    let (centre_labels, table) = label_points(lit, &centres, shadowed, darkened);
    drop(centres);
    let (final_labels, leaks) =
        cell_labels::label_cells(&cut, &centre_labels, tolerances::MIN_LABEL_DIFFERENCE_PX * px / step);
    LabelledPage { cut, triangle_labels: final_labels, table, step, leaks }
}

impl LabelledPage {
    /// Whether any label satisfies the test.
    pub(crate) fn shows(&self, is_so: impl Fn(&SurfaceLabel) -> bool) -> bool {
        self.table.iter().any(is_so)
    }

    /// Labels after relabelling by `coarser`, which may make labels equal: indices as in [`LabelledPage::triangle_labels`], and
    /// their table.
    pub(crate) fn relabelled(
        &self,
        coarser: impl Fn(&SurfaceLabel) -> SurfaceLabel,
    ) -> (Vec<u32>, Vec<SurfaceLabel>) {
        let of: Vec<SurfaceLabel> = self.table.iter().map(coarser).collect();
        let mut table = of.clone();
        table.sort_unstable();
        table.dedup();
        let number: Vec<u32> =
            of.iter().map(|look| table.binary_search(look).map_or(NO_LABEL, |at| at as u32 + 1)).collect();
        let looks = self.triangle_labels.iter().map(|look| match look.checked_sub(1) {
            Some(k) => number.get(k as usize).copied().unwrap_or(NO_LABEL),
            None => NO_LABEL,
        });
        (looks.collect(), table)
    }
}

fn segments(map: &ViewMap, page: [f64; 2], step: f64) -> Segments {
    let on_grid = |p: Point| [p.x, p.y].map(|x| (x / step).round() as i64);
    let [right, bottom] = page.map(|x| (x / step).round() as i64);
    let corners = [[0, 0], [right, 0], [right, bottom], [0, bottom]];
    let mut segments: Segments = (0..4).map(|k| ([corners[k], corners[(k + 1) % 4]], Border::Hard)).collect();
    let parting = map.edges.iter().filter(|edge| edge.invisibility == 0 && may_part(edge.kind));
    segments.reserve(parting.clone().count());
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

/// Whether a line of this kind may separate two labels.
fn may_part(kind: LineKind) -> bool {
    use LineKind::{Artist, Border, Contour, Crease, Intersection, Isophote, Material};
    matches!(kind, Contour | Border | Crease | Material | Intersection | Isophote | Artist)
}
