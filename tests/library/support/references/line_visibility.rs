//! Reference for the visibility of a polyhedron's lines: one ray per sample along every line.

use kurbo::{Point, Vec2};
use ligne::scene::{Camera, Scene};
use rayon::prelude::*;

use super::polyhedron_lines::{ReferenceLine, ReferenceLineKind, feature_lines};
use super::ray_casts::{Occluder, RayCaster, circle_points, project_point};
use super::textbook_camera::TextbookCamera;
use super::triangle_scene::TriangleScene;

/// Edges with at least this angle may be drawn as creases.
const MIN_CREASE_DEG: f64 = 15.0;
/// Maximum distance between samples, px.
const MAX_SAMPLE_STEP_PX: f64 = 1.0;
/// If a shift by this distance changes the visibility, the sample counts as unsure, px.
const VISIBILITY_SHIFT_PX: f64 = 0.75;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SampleVisibility {
    Visible,
    Hidden,
    /// Too close to call.
    Unsure,
}

/// A sample: a short piece of a line.
pub(crate) struct LineSample {
    pub at: Point,
    /// Vector from the middle to the end of the piece.
    pub half: Vec2,
    pub line: u32,
    pub state: SampleVisibility,
    /// Whether another connected component clearly hides it.
    pub hidden_by_other_component: bool,
    /// Whether it is a contour or border with background on one side.
    pub is_silhouette: bool,
}

impl LineSample {
    pub(crate) fn length(&self) -> f64 {
        2.0 * self.half.hypot2().sqrt()
    }

    pub(crate) fn segment(&self) -> [Point; 2] {
        [self.at - self.half, self.at + self.half]
    }
}

/// The lines of a view and the samples along them, in line order.
pub(crate) struct ReferenceLines {
    pub lines: Vec<ReferenceLine>,
    pub samples: Vec<LineSample>,
}

impl ReferenceLines {
    pub(crate) fn of(scene: &Scene, camera: &Camera) -> Self {
        let polygons = TriangleScene::of(scene);
        let eye = TextbookCamera::new(camera);
        let rays = RayCaster::new(&polygons, &eye, camera.width, camera.height);
        let lines = feature_lines(&polygons, &eye, MIN_CREASE_DEG);
        let frame = kurbo::Rect::new(0.0, 0.0, camera.width, camera.height);
        let along =
            |(id, line)| sample_line(&rays, id, line).into_iter().filter(|place| frame.contains(place.at));
        let places = lines.par_iter().enumerate().flat_map_iter(along).collect();
        Self { lines, samples: places }
    }

    pub(crate) fn kind(&self, place: &LineSample) -> ReferenceLineKind {
        self.lines[place.line as usize].kind
    }

    /// The pieces of the samples that satisfy `wanted`.
    pub(crate) fn segments_where(&self, wanted: impl Fn(&LineSample) -> bool) -> Vec<[Point; 2]> {
        self.samples.iter().filter(|place| wanted(place)).map(LineSample::segment).collect()
    }
}

fn sample_line(rays: &RayCaster, id: usize, line: &ReferenceLine) -> Vec<LineSample> {
    let [(a, near_a), (b, near_b)] = line.ends.map(|end| project_point(rays.camera, end));
    let length = (b - a).hypot2().sqrt();
    let count = (length / MAX_SAMPLE_STEP_PX).ceil().max(1.0) as usize;
    let half = (b - a) / (2.0 * count as f64);
    let share = |k: usize| (k as f64 + 0.5) / count as f64;
    let hidden: Vec<Occluder> = (0..count)
        .map(|k| {
            rays.occluder_at(a.lerp(b, share(k)), near_a + (near_b - near_a) * share(k), |f| {
                contact_distance(rays, line, f)
            })
        })
        .collect();
    let reach = (VISIBILITY_SHIFT_PX / (length / count as f64).max(1e-9)).ceil().min(count as f64) as usize;
    (0..count)
        .map(|k| {
            let (at, nearness) = (a.lerp(b, share(k)), near_a + (near_b - near_a) * share(k));
            let is_hidden = hidden[k] == Occluder::Surface;
            let clears = |touching: &dyn Fn(u32) -> Option<f64>| {
                [VISIBILITY_SHIFT_PX, VISIBILITY_SHIFT_PX / 2.0].into_iter().any(|radius| {
                    circle_points(at, radius)
                        .any(|p| rays.occluder_at(p, nearness, touching) != Occluder::Surface)
                })
            };
            let near = k.saturating_sub(reach)..(k + reach + 1).min(count);
            let changes = hidden[near].iter().any(|other| (*other == Occluder::Surface) != is_hidden);
            let touches = hidden[k] == Occluder::Contact;
            let state = match is_hidden {
                true if changes || clears(&|face| contact_distance(rays, line, face)) => {
                    SampleVisibility::Unsure
                }
                true => SampleVisibility::Hidden,
                false if changes || touches || line.unsure => SampleVisibility::Unsure,
                false => SampleVisibility::Visible,
            };
            let others = |face: u32| other_component_contact_distance(rays, line, face);
            let behind_others = state == SampleVisibility::Hidden
                && rays.occluder_at(at, nearness, others) == Occluder::Surface
                && !clears(&others);
            let beside = Vec2::new(-half.y, half.x) / half.hypot2().sqrt().max(1e-12);
            let is_outline = matches!(line.kind, ReferenceLineKind::Contour | ReferenceLineKind::Border)
                && !is_hidden
                && [-1.0, 1.0].into_iter().any(|side| rays.is_background(at + beside * side));
            LineSample {
                at,
                half,
                line: id as u32,
                state,
                hidden_by_other_component: behind_others,
                is_silhouette: is_outline,
            }
        })
        .collect()
}

/// Depth distance within which a face does not hide a line; `None` for the line's own faces.
///
/// The distance is smaller for faces that share one end of the line.
fn contact_distance(rays: &RayCaster, line: &ReferenceLine, face: u32) -> Option<f64> {
    if line.hosts.contains(&face) {
        return None;
    }
    let own = &rays.polygons.faces[face as usize];
    match line.corners.iter().filter(|corner| own.contains(corner)).count() {
        0 => Some(rays.contact_distance()),
        1 => Some(1e-4 * rays.contact_distance()),
        _ => None,
    }
}

/// The contact distance for faces of other components; `None` for those of the line's own component.
fn other_component_contact_distance(rays: &RayCaster, line: &ReferenceLine, face: u32) -> Option<f64> {
    let piece = &rays.polygons.component;
    let own = line.hosts.iter().any(|host| piece[*host as usize] == piece[face as usize]);
    (!own).then_some(rays.contact_distance())
}
