//! Animated boxes, and the motion lines of their drawings.

use glam::{DAffine3, DQuat, DVec3};
use kurbo::{ParamCurve, PathSeg, Point};
use libm::{cos, sin};
use ligne::animation::rig::{GeometryRig, Node, Placement};
use ligne::animation::{
    AnimationTarget, Clip, ClipChannel, Interpolation, NodeProperty, Playing, Rig, Rigged, Track,
};
use ligne::drawing::{Drawing, LayerKind, Mark, Paint};
use ligne::{Camera, Scene, Style, motion, render};

use super::solids::{Solid, cuboid};
use crate::library::support::pipeline::{orthographic, scene_of_geometries, solid_geometry};

/// Duration of a clip, and default time span of motion lines, seconds.
pub(crate) const CLIP_SECONDS: f64 = 4.0;
pub(crate) const DEFAULT_TRAIL_SECONDS: f64 = 20.0 / 24.0;

/// An animation channel of a node, linear between keys.
pub(crate) fn linear_channel(
    node: usize,
    property: NodeProperty,
    times: &[f64],
    values: &[f64],
) -> ClipChannel {
    let track = Track::new(times.into(), values.into(), Interpolation::Linear).unwrap();
    ClipChannel { target: AnimationTarget::Node(node, property), track }
}

/// A channel that translates a node at constant speed, in world units per second.
pub(crate) fn translation_channel(node: usize, speed: DVec3) -> ClipChannel {
    let ends = [DVec3::ZERO, speed * CLIP_SECONDS].concat_all();
    linear_channel(node, NodeProperty::Translation, &[0.0, CLIP_SECONDS], &ends)
}

/// A channel that turns a node about z at constant speed, in degrees per second.
pub(crate) fn rotation_channel(node: usize, degrees: f64) -> ClipChannel {
    let times: Vec<f64> = (0..=40).map(|k| f64::from(k) / 10.0).collect();
    let turn = |time: &f64| {
        let half = (degrees * time / 2.0).to_radians();
        [0.0, 0.0, sin(half), cos(half)]
    };
    let values: Vec<f64> = times.iter().flat_map(turn).collect();
    linear_channel(node, NodeProperty::Rotation, &times, &values)
}

/// Concatenates the coordinates of vectors.
pub(crate) trait ConcatAll {
    fn concat_all(self) -> Vec<f64>;
}

impl ConcatAll for [DVec3; 2] {
    fn concat_all(self) -> Vec<f64> {
        self.iter().flat_map(|v| v.to_array()).collect()
    }
}

/// A node with the identity transform.
pub(crate) fn identity_node(name: &str, parent: Option<usize>) -> Node {
    let (translation, rotation, scale) = (DVec3::ZERO, DQuat::IDENTITY, DVec3::ONE);
    let rest = Placement::Parts { translation, rotation, scale };
    Node { name: name.to_owned(), leaves_lines: false, parent, rest, weights: Vec::new(), visible: true }
}

/// A rigged scene with one node per solid, and one clip of `channels`.
pub(crate) fn rig_solids(solids: Vec<Solid>, channels: Vec<ClipChannel>) -> Rigged {
    let count = solids.len();
    let scene = scene_of_geometries(solids.into_iter().map(solid_geometry).collect());
    let nodes = (0..count).map(|k| identity_node(&format!("node {k}"), None)).collect();
    let forms = (0..count).map(|node| GeometryRig { node, ..GeometryRig::default() }).collect();
    let parts = (0..count).map(|node| (node, DAffine3::IDENTITY)).collect();
    let clips = vec![Clip { name: "go".to_owned(), channels }];
    Rigged { scene, rig: Rig { nodes, order: (0..count).collect(), forms, parts, clips, ..Rig::default() } }
}

/// The ink style with motion lines and overrides.
pub(crate) fn motion_style(changes: &[&str]) -> Style {
    let all = [&["motion.enabled=true"], changes].concat();
    Style::load_with("ink", &all.iter().map(|change| (*change).to_owned()).collect::<Vec<_>>()).unwrap()
}

/// The scene posed at a time, with its motion.
pub(crate) fn posed_scene(rigged: &Rigged, time: f64, style: &Style) -> Scene {
    motion::posed(rigged, &[Playing::all(0, time)], &style.motion, style.seed).unwrap()
}

/// The drawing of the scene at a time.
pub(crate) fn draw_at(rigged: &Rigged, time: f64, camera: &Camera, style: &Style) -> Drawing {
    render(&posed_scene(rigged, time, style), camera, style).unwrap()
}

/// The motion lines of a drawing.
pub(crate) fn motion_lines(drawing: &Drawing) -> Vec<&Mark> {
    let marks = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Motion).flat_map(|l| &l.marks);
    marks.inspect(|mark| assert_eq!(mark.provenance.classes, ["motion"])).collect()
}

/// Points along the centre line of a mark, 1001 per curve segment.
pub(crate) fn points_along(mark: &Mark) -> Vec<Point> {
    let path = match &mark.paint {
        Paint::Outline(outline) => &outline.axis,
        _ => &mark.path,
    };
    path.segments().flat_map(|s: PathSeg| (0..=1000).map(move |k| s.eval(f64::from(k) / 1000.0))).collect()
}

/// The two ends of a motion line, ordered so that it runs in the direction `back`.
pub(crate) fn motion_line_ends(mark: &Mark, back: kurbo::Vec2) -> [Point; 2] {
    let points = points_along(mark);
    let (first, last) = (points[0], points[points.len() - 1]);
    if (last - first).dot(back) > 0.0 { [first, last] } else { [last, first] }
}

/// The direction of motion lines of objects that move to the right.
pub(crate) const TRAIL_LEFT: kurbo::Vec2 = kurbo::Vec2::new(-1.0, 0.0);

/// An orthographic camera in front of the xy plane, at 100 px per unit, with the origin in the middle.
pub(crate) fn front_camera() -> Camera {
    orthographic(DVec3::Z * 50.0, DVec3::ZERO, 10.0)
}

/// A unit cube about the origin.
pub(crate) fn unit_cube() -> Solid {
    cuboid(DVec3::splat(-0.5), DVec3::splat(0.5))
}
