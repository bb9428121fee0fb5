//! [`Decal`]: figures on a plane laid on the surface, projected to the page with the facets that show them.
//!
//! 1. The plane lies on the surface face by face, by texture coordinates or part axes.
//! 2. Each figure is anchored at its centre. Its points are found by walking from there over the faces,
//!    straight in the plane. Where the plane ends or turns away from the camera, the last face is extended.
//! 3. Sample points decide on which facets a figure is visible. The exact clipping uses the borders of the
//!    [`HatchRegions`].

use std::collections::BTreeMap;

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};
use kurbo::{Point, Vec2};

use super::level_curves::are_visible;
use super::surface_chart::Chart;
use super::surface_chart::Walker;
use crate::lines::{Lit, shows_inside};
use crate::mesh::{FaceId, Mesh};
use crate::regions::HatchRegions;
use crate::regions::hatch_regions::border_piece::PAPER;

/// Figure that is repeated on the plane.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Figure {
    /// Its lines, open or closed. A closed line does not repeat its first point.
    pub lines: Vec<Vec<DVec2>>,
    /// Distance between repetitions along x and y, in the plane.
    pub period: DVec2,
}

/// Figure on the page.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Decal {
    /// Index of the figure.
    pub figure: u32,
    /// Its lines, page units.
    pub lines: Vec<Vec<Point>>,
    /// Facets on which some of it is visible, ascending.
    pub facets: Vec<u32>,
}

/// Maximum number of figures on a surface. More would be too small to see.
pub(crate) const MAX_FIGURES: f64 = 5e5;

/// Approximate number of points per line that are tested for visibility.
const VISIBILITY_SAMPLES_PER_LINE: usize = 12;

/// Minimum distance between figures of two charts, relative to their sizes. It applies where the normals
/// differ little (cosine above `MIN_NORMAL_COSINE`); there the later figure is left out.
const MIN_SPACING_RATIO: f64 = 0.9;
const MIN_NORMAL_COSINE: f64 = 0.7;

/// Approximate number of figures that the charts would hold.
#[must_use]
pub(crate) fn count(mesh: &Mesh, chart: impl Fn(u32) -> Option<Chart>, figures: &[Figure]) -> f64 {
    let area = |chart: Chart| {
        let [a, b, c] = chart.corners;
        let area = (b - a).perp_dot(c - a).abs() / 2.0;
        if area.is_finite() { area } else { 0.0 }
    };
    let whole: f64 = (0..mesh.triangles.len() as u32).filter_map(chart).map(area).sum();
    figures.iter().map(|figure| whole / (figure.period.x * figure.period.y)).sum()
}

/// Centre of a figure on a face.
struct FigurePlacement {
    figure: u32,
    face: u32,
    /// Repetition number along x and y.
    repetition_number: [i64; 2],
    /// Position in space.
    at: DVec3,
    /// Whether it lies outside the face, where the plane is not continued.
    is_outer: bool,
}

/// Figures on the faces that the camera may see.
#[must_use]
pub(crate) fn decals(
    lit: &Lit,
    ground: &HatchRegions,
    offset: Vec2,
    chart: &(dyn Fn(u32) -> Option<Chart> + Sync),
    figures: &[Figure],
) -> Vec<Decal> {
    const FACES_PER_TASK: usize = 1 << 10;
    let mesh = lit.mesh;
    let middles: Vec<DVec2> = figures.iter().map(figure_centre).collect();
    let faces = mesh.triangles.len();
    let anchors: Vec<Vec<FigurePlacement>> = (0..faces.div_ceil(FACES_PER_TASK))
        .into_par_iter()
        .with_max_len(1)
        .map(|chunk| {
            let mut placements = Vec::new();
            for face in chunk * FACES_PER_TASK..((chunk + 1) * FACES_PER_TASK).min(faces) {
                let Some(own) = chart(face as u32).filter(|_| !mesh.is_degenerate(FaceId(face as u32)))
                else {
                    continue;
                };
                for (number, figure) in figures.iter().enumerate() {
                    place_on_face(
                        mesh,
                        face as u32,
                        &own,
                        (number as u32, figure, middles[number]),
                        &mut placements,
                    );
                }
            }
            placements
        })
        .collect();
    let inside = shows_inside(lit);
    let shows = |face: u32| lit.view.facing[face as usize] || inside[mesh.face_part[face as usize].index()];
    let walker = Walker { lit, chart };
    let mut anchors: Vec<FigurePlacement> = anchors.into_iter().flatten().collect();
    let outer: Vec<Vec<FigurePlacement>> = (0..faces.div_ceil(FACES_PER_TASK))
        .into_par_iter()
        .with_max_len(1)
        .map(|chunk| {
            let face_range = chunk * FACES_PER_TASK..((chunk + 1) * FACES_PER_TASK).min(faces);
            face_range.flat_map(|face| walker.beyond_border(face as u32, figures, &middles)).collect()
        })
        .collect();
    add_outer(lit, chart, outer.into_iter().flatten().collect(), &mut anchors);
    let anchors = drop_crowded(lit, chart, figures, anchors);
    let laid: Vec<PlacedFigure> = anchors
        .par_iter()
        .with_min_len(64)
        .filter(|anchor| shows(anchor.face))
        .filter_map(|anchor| {
            let figure = &figures[anchor.figure as usize];
            let [i, j] = anchor.repetition_number.map(|k| k as f64);
            walker.lay(anchor, figure, (figure.period * DVec2::new(i, j), offset), shows)
        })
        .collect();
    let samples: Vec<(Point, f64)> =
        laid.iter().flat_map(|laid| laid.visibility_samples.iter().copied()).collect();
    let mut visibility = are_visible(lit, offset, &samples).into_iter();
    let decal = |laid: PlacedFigure| {
        let is_visible: Vec<bool> = visibility.by_ref().take(laid.visibility_samples.len()).collect();
        let on = laid
            .visibility_samples
            .iter()
            .zip(is_visible)
            .filter(|(_, seen)| *seen)
            .map(|((p, _), _)| ground.cell_at(*p));
        let mut facets: Vec<u32> =
            on.filter(|cell| *cell != PAPER).map(|cell| ground.cells[cell as usize].facet).collect();
        facets.sort_unstable();
        facets.dedup();
        (!facets.is_empty()).then_some(Decal { figure: laid.figure, lines: laid.lines, facets })
    };
    laid.into_iter().filter_map(decal).collect()
}

/// Figure on the page, with surface points to be tested for visibility.
struct PlacedFigure {
    figure: u32,
    lines: Vec<Vec<Point>>,
    visibility_samples: Vec<(Point, f64)>,
}

/// Centre of a figure's bounding box.
fn figure_centre(figure: &Figure) -> DVec2 {
    let points = || figure.lines.iter().flatten();
    let low = points().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = points().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    (low + high) / 2.0
}

/// Adds the figures whose centres lie on a face.
fn place_on_face(
    mesh: &Mesh,
    face: u32,
    chart: &Chart,
    (number, figure, middle): (u32, &Figure, DVec2),
    found: &mut Vec<FigurePlacement>,
) {
    let corners = chart.corners.map(|p| (p - middle) / figure.period);
    let [a, b, c] = corners;
    let (low, high) = (a.min(b).min(c).ceil(), a.max(b).max(c).floor());
    let whole = (b - a).perp_dot(c - a);
    let size = high - low + 1.0;
    if !(whole.abs() > 0.0 && whole.is_finite() && size.x.max(1.0) * size.y.max(1.0) < 4.0 * MAX_FIGURES) {
        return;
    }
    let solid = mesh.corners(FaceId(face));
    for j in low.y as i64..=high.y as i64 {
        for i in low.x as i64..=high.x as i64 {
            let p = DVec2::new(i as f64, j as f64);
            let parts = [signed_area(b, c, p), signed_area(c, a, p), signed_area(a, b, p)];
            // A point on a side belongs to exactly one of its two faces.
            let is_in = parts.iter().all(|(part, along)| match whole > 0.0 {
                true => *part > 0.0 || (*part == 0.0 && *along),
                false => *part < 0.0 || (*part == 0.0 && *along),
            });
            if is_in {
                let at = (0..3).map(|k| solid[k] * (parts[k].0 / whole)).sum();
                found.push(FigurePlacement {
                    figure: number,
                    face,
                    repetition_number: [i, j],
                    at,
                    is_outer: false,
                });
            }
        }
    }
}

/// Twice the signed area between a side and a point, and which of the two faces owns points on the side. The
/// magnitude is exactly the same from both faces.
fn signed_area(a: DVec2, b: DVec2, p: DVec2) -> (f64, bool) {
    if (a.x, a.y) < (b.x, b.y) { ((b - a).perp_dot(p - a), true) } else { (-(a - b).perp_dot(p - b), false) }
}

/// Adds figures outside the border of the plane, each once.
fn add_outer(
    lit: &Lit,
    chart: &(dyn Fn(u32) -> Option<Chart> + Sync),
    outer: Vec<FigurePlacement>,
    anchors: &mut Vec<FigurePlacement>,
) {
    let key = |anchor: &FigurePlacement| {
        let name = chart(anchor.face).map_or(0, |chart| chart.name);
        (lit.mesh.face_part[anchor.face as usize], name, anchor.figure, anchor.repetition_number)
    };
    if outer.is_empty() {
        return;
    }
    let mut known: BTreeMap<_, Vec<DVec3>> = BTreeMap::new();
    anchors.iter().for_each(|anchor| known.entry(key(anchor)).or_default().push(anchor.at));
    for anchor in outer {
        let there = known.entry(key(&anchor)).or_default();
        let near = unit(lit.mesh, chart, anchor.face) / 2.0;
        if there.iter().all(|at| at.distance(anchor.at) > near) {
            there.push(anchor.at);
            anchors.push(anchor);
        }
    }
}

/// Length in space of a unit of the plane on a face.
fn unit(mesh: &Mesh, chart: &(dyn Fn(u32) -> Option<Chart> + Sync), face: u32) -> f64 {
    let [a, b, c] = mesh.corners(FaceId(face));
    let area = |chart: Chart| {
        let [p, q, r] = chart.corners;
        (q - p).perp_dot(r - p).abs()
    };
    ((b - a).cross(c - a).length() / chart(face).map_or(1.0, area)).sqrt()
}

/// Drops figures too close to one in another chart. The order depends on the plane, not on faces or view.
fn drop_crowded(
    lit: &Lit,
    chart: &(dyn Fn(u32) -> Option<Chart> + Sync),
    figures: &[Figure],
    mut anchors: Vec<FigurePlacement>,
) -> Vec<FigurePlacement> {
    let mesh = lit.mesh;
    let name = |face: u32| chart(face).map_or(0, |chart| chart.name);
    let names: Vec<u32> = anchors.iter().map(|anchor| name(anchor.face)).collect();
    if names.iter().all(|name| *name == names[0]) {
        return anchors;
    }
    let extent = |figure: &Figure| {
        let middle = figure_centre(figure);
        figure.lines.iter().flatten().map(|p| (*p - middle).abs().max_element()).fold(0.0, f64::max)
    };
    let reaches: Vec<f64> = figures.iter().map(extent).collect();
    let normal = |face: u32| mesh.area_vector(FaceId(face)).normalize_or_zero();
    let part = |anchor: &FigurePlacement| mesh.face_part[anchor.face as usize];
    anchors.sort_by_key(|anchor| {
        (
            anchor.is_outer,
            part(anchor),
            name(anchor.face),
            anchor.figure,
            anchor.repetition_number,
            anchor.face,
        )
    });
    let widest = reaches.iter().copied().fold(0.0, f64::max);
    let cell = |p: DVec3, size: f64| (p / size).floor().to_array().map(|v| v as i64);
    let mut kept_anchors: BTreeMap<(u32, [i64; 3]), Vec<usize>> = BTreeMap::new();
    let mut stays = vec![true; anchors.len()];
    for (k, anchor) in anchors.iter().enumerate() {
        let part = part(anchor).index() as u32;
        let unit = unit(mesh, chart, anchor.face);
        let size = 2.0 * widest * unit;
        if !(size > 0.0 && size.is_finite()) {
            continue;
        }
        let chart_name = name(anchor.face);
        let [x, y, z] = cell(anchor.at, size);
        let around = (0..27).map(|n| [x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1]);
        let is_near = |other_number: &usize| {
            let other_anchor = &anchors[*other_number];
            let reach = (reaches[anchor.figure as usize] + reaches[other_anchor.figure as usize])
                * unit
                * MIN_SPACING_RATIO;
            name(other_anchor.face) != chart_name
                && anchor.at.distance(other_anchor.at) < reach
                && normal(anchor.face).dot(normal(other_anchor.face)) > MIN_NORMAL_COSINE
        };
        stays[k] = !around.filter_map(|cell| kept_anchors.get(&(part, cell))).flatten().any(is_near);
        if stays[k] {
            kept_anchors.entry((part, [x, y, z])).or_default().push(k);
        }
    }
    let mut stays = stays.into_iter();
    anchors.retain(|_| stays.next().unwrap_or(true));
    anchors
}

/// Projection of figures to the page.
impl Walker<'_> {
    /// Projects a figure around its centre; none if a point lies behind the camera.
    fn lay(
        &self,
        anchor: &FigurePlacement,
        figure: &Figure,
        (shift, offset): (DVec2, Vec2),
        shows: impl Fn(u32) -> bool,
    ) -> Option<PlacedFigure> {
        let frame = &self.lit.view.frame;
        let on_page = |p: DVec3| {
            let image = frame.image_from_local(p);
            image.is_finite().then(|| (Point::new(image.x, image.y) + offset, image.z))
        };
        let mut asked = if anchor.is_outer { Vec::new() } else { vec![on_page(anchor.at)?] };
        let mut lines = Vec::with_capacity(figure.lines.len());
        for line in &figure.lines {
            let mut points = Vec::with_capacity(line.len());
            let mut face = anchor.face;
            let every = line.len().div_ceil(VISIBILITY_SAMPLES_PER_LINE);
            for (k, p) in line.iter().enumerate() {
                // Consecutive points are mostly on the same face.
                let (at, there, is_on) = match self.find(face, *p + shift) {
                    Some(at) => (at, face, true),
                    None => self.walk(anchor.face, *p + shift, &shows)?,
                };
                let (point, nearness) = on_page(at)?;
                points.push(point);
                if is_on {
                    face = there;
                    if k % every == 0 {
                        asked.push((point, nearness));
                    }
                }
            }
            lines.push(points);
        }
        Some(PlacedFigure { figure: anchor.figure, lines, visibility_samples: asked })
    }

    /// Figures whose centres lie outside a face at the border of the plane.
    fn beyond_border(&self, face: u32, figures: &[Figure], middles: &[DVec2]) -> Vec<FigurePlacement> {
        let mut found = Vec::new();
        let is_degenerate = self.lit.mesh.is_degenerate(FaceId(face));
        let Some(own) = (self.chart)(face).filter(|_| !is_degenerate) else { return found };
        if (0..3).all(|corner| self.next(face, &own, corner).is_some()) {
            return found;
        }
        let [a, b, c] = own.corners;
        for (number, (figure, middle)) in figures.iter().zip(middles).enumerate() {
            let points = figure.lines.iter().flatten();
            let half = points.fold(DVec2::ZERO, |most, p| most.max((*p - *middle).abs()));
            let low = ((a.min(b).min(c) - half - *middle) / figure.period).ceil();
            let high = ((a.max(b).max(c) + half - *middle) / figure.period).floor();
            let size = high - low + 1.0;
            let many = size.x.max(1.0) * size.y.max(1.0);
            if many.is_nan() || many >= MAX_FIGURES {
                continue;
            }
            for j in low.y as i64..=high.y as i64 {
                for i in low.x as i64..=high.x as i64 {
                    let p = *middle + figure.period * DVec2::new(i as f64, j as f64);
                    // Figures on a face are known already, unless they lie exactly on the border.
                    if let Some((at, last, is_on)) = self.walk(face, p, |_| true) {
                        let (figure, repetition) = (number as u32, [i, j]);
                        found.push(FigurePlacement {
                            figure,
                            face: last,
                            repetition_number: repetition,
                            at,
                            is_outer: !is_on,
                        });
                    }
                }
            }
        }
        found
    }
}
