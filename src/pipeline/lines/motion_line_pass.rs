//! Motion lines: trails of moving bodies, hidden by everything in front of them.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use glam::DVec3;

use crate::chains::{self, Chain, ChainOptions};
use crate::drawing::{Layer, Length, Unit};
use crate::geometry::numbers::noise::hash;
use crate::geometry::plane::planar_distance::length;
use crate::lines::{FeatureLines, FeatureSegment, HiddenLines, LineKind, NO_FACE, Role};
use crate::mesh::{MaterialId, Mesh, PartId, Soup};
use crate::motion::{MotionOptions, POINTS_PER_SEGMENT, Speed};
use crate::scene::{Camera, Mover, Scene, Trail};
use crate::strokes::{self, InkContext, Pen};
use crate::style::Style;
use crate::surface::MeshSource;
use crate::view::{Frame, View};
use crate::visibility::{self, BodyLines, ViewMap};

/// Warning where motion lines are on, but the scene has no animation time.
pub(crate) const NO_MOMENT: &str = "no motion lines: nothing moves; give --animation and --time";

/// Warning where bodies move, but none of their lines is visible.
pub(crate) const NONE_SEEN: &str =
    "no motion lines: they are hidden, outside the frame, or slower than motion.speed";

/// Motion trails of a view.
pub(crate) struct Trails<'a> {
    chains: Vec<Chain>,
    /// For each feature segment, the entry of the style's list that applies to its line.
    rules: Vec<Option<usize>>,
    /// For each feature segment, a stable number of its line.
    names: Vec<u64>,
    style: &'a Style,
}

impl<'a> Trails<'a> {
    /// The trails that a mesh leaves visible; `None` if the style or the scene has none.
    ///
    /// `unit` is the unit of the page. `centre` moves them from the camera's frame to the page.
    pub(crate) fn of(
        (mesh, view, camera): (&Mesh, &View, &Camera),
        scene: &Scene,
        style: &'a Style,
        unit: Unit,
        centre: impl FnOnce(&mut ViewMap),
    ) -> Option<Self> {
        let options = &style.motion;
        let movers = scene.movers.as_deref().filter(|_| options.enabled)?;
        let mut lines = FeatureLines::default();
        let (mut rules, mut names, mut bodies) = (Vec::new(), Vec::new(), Vec::new());
        let leaving: Vec<bool> =
            movers.iter().map(|mover| leaves_lines(mover, options, &view.frame, mesh.origin, unit)).collect();
        for (mover, share) in movers.iter().zip(shares(movers, &leaving, options.lines as usize)) {
            let first = lines.segments.len() as u32;
            for trail in mover.trails.iter().filter(|trail| trail.line < share || (trail.named && share > 0))
            {
                let before = lines.segments.len();
                add(&mut lines, mesh, scene, mover, trail);
                let name = hash(mover.identity, &[trail.line as u64]).max(1);
                rules.extend((before..lines.segments.len()).map(|_| trail.rule));
                names.extend((before..lines.segments.len()).map(|_| name));
            }
            let segments = first..lines.segments.len() as u32;
            if !mover.body.is_empty() && !segments.is_empty() {
                bodies.push(BodyLines { segments, body: Mesh::build(soup(&mover.body)) });
            }
        }
        let mut map = visibility::build_motion_lines(mesh, view, camera, &lines, &bodies);
        centre(&mut map);
        let tidy = style.chain.tidy.in_unit(unit);
        // Trails of different lines are never joined, however close their ends.
        let exact = ChainOptions { tidy: Length::px(0.0), ..style.chain.clone() };
        let mut chains = chains::link(&map, &exact, unit, HiddenLines::None);
        chains
            .retain(|chain| chain.points.windows(2).map(|two| length(two[1] - two[0])).sum::<f64>() >= tidy);
        for chain in &mut chains {
            chain.identity = names.get(chain.segment as usize).copied().unwrap_or_default();
        }
        Some(Self { chains, rules, names, style })
    }

    /// The layer of motion lines.
    pub(crate) fn ink(&self, context: &InkContext) -> Vec<Layer> {
        let options = &self.style.motion;
        let pen = |chain: &Chain| {
            let rule = self.rules.get(chain.segment as usize).copied().flatten();
            let change = rule.and_then(|rule| options.line.get(rule));
            Pen {
                width: change.and_then(|change| change.width).unwrap_or(options.width),
                colour: change.and_then(|change| change.colour).unwrap_or(options.colour),
                fade: options.taper,
                ..Pen::default()
            }
        };
        let context = InkContext { names: &self.names, ..*context };
        strokes::ink_motion(&self.chains, &context, &self.style.stroke, pen)
    }
}

/// Whether a mover leaves lines: it always does, or its lines start faster on the page than the style's
/// limit.
fn leaves_lines(mover: &Mover, options: &MotionOptions, frame: &Frame, origin: DVec3, unit: Unit) -> bool {
    let Some(Speed::Page(least)) = options.speed.filter(|_| !mover.chosen) else { return mover.chosen };
    let way = |trail: &Trail| {
        let ends = [trail.points.first()?, trail.points.get(POINTS_PER_SEGMENT)?];
        let [now, before] = ends.map(|point| frame.image_from_local(*point - origin));
        let way = (now - before).truncate().length();
        (!way.is_nan() && !before.z.is_nan() && !now.z.is_nan()).then_some(way)
    };
    let ways: Vec<f64> = mover.trails.iter().filter_map(way).collect();
    let seconds = mover.interval * POINTS_PER_SEGMENT as f64;
    ways.iter().sum::<f64>() / ways.len().max(1) as f64 / seconds > least.in_unit(unit)
}

/// Number of lines of each mover.
///
/// A mover that leaves none gets 0, and one that moves alone gets all. Connected movers, such as the joints
/// of an arm, share the lines of one body, the outermost first.
fn shares(movers: &[Mover], leaving: &[bool], lines: usize) -> Vec<usize> {
    let above = |mover: usize| movers[mover].above.filter(|above| leaving[*above]);
    let way = |mover: usize| std::iter::successors(Some(mover), |at| above(*at));
    let mut limbs: BTreeMap<usize, Vec<(Reverse<usize>, usize)>> = BTreeMap::new();
    for mover in (0..movers.len()).filter(|mover| leaving[*mover]) {
        let innermost = way(mover).last().unwrap_or(mover);
        limbs.entry(innermost).or_default().push((Reverse(way(mover).count()), mover));
    }
    let mut shares = vec![0; movers.len()];
    for mut limb in limbs.into_values() {
        limb.sort_unstable();
        let count = limb.len();
        for (rank, (_, mover)) in limb.into_iter().enumerate() {
            let share = lines / count + usize::from(rank < lines % count);
            shares[mover] = if count == 1 { usize::MAX } else { share };
        }
    }
    shares
}

/// Adds a trail to the lines. Points where it stands still are dropped.
fn add(lines: &mut FeatureLines, mesh: &Mesh, scene: &Scene, mover: &Mover, trail: &Trail) {
    let mut points = trail.points.clone();
    points.dedup();
    let count = points.len();
    if count < 2 {
        return;
    }
    let first = (mesh.positions.len() + lines.points.len()) as u32;
    lines.points.extend(points.iter().map(|point| *point - mesh.origin));
    lines.strengths.extend((0..count).map(|k| 1.0 - k as f32 / (count - 1) as f32));
    let material = mover.material.map_or(scene.materials.len(), |material| material as usize);
    lines.segments.extend((first..).take(count - 1).map(|from| FeatureSegment {
        ends: [from, from + 1],
        hosts: [NO_FACE; 2],
        kind: LineKind::Motion,
        both_seen: true,
        smooth: true,
        origin: MeshSource::default(),
        role: Role::Line,
        strength: 180.0,
        part: PartId::from(mover.part),
        material: MaterialId::from(material),
    }));
}

/// Separate triangles as a mesh soup.
fn soup(triangles: &[[DVec3; 3]]) -> Soup {
    let count = triangles.len();
    Soup {
        positions: triangles.as_flattened().to_vec(),
        triangles: (0..count as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect(),
        triangle_part: vec![PartId(0); count],
        triangle_material: vec![MaterialId(0); count],
        ..Soup::default()
    }
}
