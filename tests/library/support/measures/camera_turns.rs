//! Stability of a drawing under a small turn of the camera: the share of lines that stay on their surface
//! points.

use glam::{DAffine3, DVec3};
use kurbo::Point;
use ligne::chains::{self, Chain, ChainOptions};
use ligne::drawing::Unit;
use ligne::lines::{HiddenLines, LineKind, LineOptions, Surface};
use ligne::mesh::Mesh;
use ligne::scene::{Camera, Scene, UpAxis};

use super::line_picture::SegmentGrid;
use crate::library::support::references::contour_stops::build_view_map;
use crate::library::support::references::textbook_camera::TextbookCamera;

/// Maximum distance of a drawn line from its surface line due to smoothing, simplifying and fitting, px.
const LINE_PRECISION_PX: f64 = 0.25;
/// Lines without ink within this distance are gone, px.
const MAX_DISTANCE_PX: f64 = 6.0;
/// Minimum lost length of a line that counts as popping, px.
const MIN_POP_LENGTH_PX: f64 = 5.0;

/// Line length of two drawings, and how much of it each finds in the other.
#[derive(Debug, Clone, Default)]
pub(crate) struct Stability {
    /// Total length of the lines of both drawings, px.
    pub length: f64,
    /// Length within the tolerance of the other drawing, px: twice the image motion of the surface point,
    /// plus [`LINE_PRECISION_PX`].
    pub stable_length: f64,
    /// Lines of either drawing that disappear in part or entirely.
    pub pops: Vec<PoppingLine>,
}

/// A line that occurs in one drawing only, or that jumps.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PoppingLine {
    pub kind: LineKind,
    /// Lost length and total length, px.
    pub lost_length: f64,
    pub length: f64,
    /// Centroid of the lost part.
    pub place: Point,
    /// Whether the line belongs to the first drawing.
    pub first: bool,
}

impl std::fmt::Display for PoppingLine {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let Self { kind, lost_length: gone, length, place, first } = self;
        let which = if *first { "first" } else { "second" };
        let (kind, x, y) = (kind.name(), place.x, place.y);
        write!(f, "{gone:.1} of {length:.1} px of a {kind} of the {which} drawing at ({x:.1}, {y:.1})")
    }
}

impl Stability {
    /// The share of length that stays, percent.
    pub(crate) fn stable_percent(&self) -> f64 {
        100.0 * self.stable_length / self.length.max(f64::MIN_POSITIVE)
    }

    pub(crate) fn add(&mut self, other: Self) {
        self.length += other.length;
        self.stable_length += other.stable_length;
        self.pops.extend(other.pops);
    }
}

/// The camera turned about the vertical axis through its target.
pub(crate) fn turn_camera(camera: &Camera, scene: &Scene, degrees: f64) -> Camera {
    let up = if scene.up == UpAxis::Y { DVec3::Y } else { DVec3::Z };
    let turn = DAffine3::from_axis_angle(up, degrees.to_radians());
    let eye = camera.target + turn.transform_vector3(camera.eye - camera.target);
    Camera { eye, up: turn.transform_vector3(camera.up), ..*camera }
}

/// Compares the default drawings from two cameras.
pub(crate) fn compare_cameras(surface: &Surface, options: &LineOptions, cameras: [&Camera; 2]) -> Stability {
    let drawings = cameras.map(|camera| {
        let map = build_view_map(surface, camera, options);
        let mut chains = chains::link(&map, &ChainOptions::default(), Unit::Px, HiddenLines::None);
        chains.retain(|c| c.invisibility == 0);
        chains
    });
    let eyes = cameras.map(TextbookCamera::new);
    let mut result = Stability::default();
    for (from, to) in [(0, 1), (1, 0)] {
        let ink = SegmentGrid::new(
            drawings[to].iter().flat_map(chain_segments).map(|(s, _)| s).collect(),
            MAX_DISTANCE_PX,
        );
        for chain in &drawings[from] {
            let (mut length, mut gone, mut place) = (0.0, 0.0, Point::ZERO.to_vec2());
            for (p, depth, part) in sample_chain(chain) {
                let moved = (eyes[to].project(eyes[from].unproject(p, depth)) - p).hypot();
                length += part;
                if ink.distance(p) > 2.0 * moved + LINE_PRECISION_PX {
                    gone += part;
                    place += p.to_vec2() * part;
                }
            }
            result.length += length;
            result.stable_length += length - gone;
            if gone >= MIN_POP_LENGTH_PX {
                let place = (place / gone).to_point();
                result.pops.push(PoppingLine {
                    kind: chain.kind,
                    lost_length: gone,
                    length,
                    place,
                    first: from == 0,
                });
            }
        }
    }
    result
}

/// The surface of a scene for `options`.
pub(crate) fn prepare_surface(scene: &Scene, options: &LineOptions) -> Surface {
    Surface::new(Mesh::build(scene.to_soup()), options)
}

/// The segments of a chain, with the depths at their ends.
fn chain_segments(chain: &Chain) -> impl Iterator<Item = ([Point; 2], [f64; 2])> + '_ {
    let n = chain.points.len();
    let sides = if chain.closed { n } else { n.saturating_sub(1) };
    (0..sides).map(move |i| {
        let j = (i + 1) % n;
        ([chain.points[i], chain.points[j]], [chain.samples[i].depth, chain.samples[j].depth])
    })
}

/// Samples along a chain every half px: position, depth, and length represented.
fn sample_chain(chain: &Chain) -> Vec<(Point, f64, f64)> {
    let mut found = Vec::new();
    for ([a, b], [from, to]) in chain_segments(chain) {
        let length = (b - a).hypot();
        let count = (length / 0.5).ceil().max(1.0);
        for k in 0..count as usize {
            let t = (k as f64 + 0.5) / count;
            found.push((a.lerp(b, t), from + (to - from) * t, length / count));
        }
    }
    found
}
