//! Motion lines: the paths that vertices of moving bodies have taken up to a moment of a clip.
//!
//! Source: Adam Lake, Carl Marshall, Mark Harris and Marc Blackstein, "Stylized rendering techniques for
//! scalable real-time 3D animation", NPAR 2000, section 5. Their translation buffer is filled frame by frame.
//! Here the clips are sampled at earlier times, so a moment looks the same whether or not others were drawn
//! before it.
//! 1. Bodies are parts, or what one joint of a skin moves; names, the file or their speed select them
//!    ([`moving_bodies`]).
//! 2. Lines start at vertices spread over the body, the same at all times ([`line_starts`]).
//! 3. Each line follows its vertex, or the middle of the body, back in time.
//!
//! Files, in reading order: [`options`] the `[motion]` table; [`moving_bodies`]; [`line_starts`].
//!
//! ```
//! use ligne::animate::{Animator, FrameSpec};
//! use ligne::animation::{Playing, Rigged};
//! use ligne::drawing::{LayerKind, Page};
//! use ligne::{Camera, Style};
//!
//! let model = Rigged::open("examples/models/brick.glb")?;
//! let mut style = Style::load("ink")?;
//! style.set("motion.enabled", true)?;
//! let camera = Camera::three_quarter().fit(&model.scene);
//! let moment = FrameSpec { playing: vec![Playing::all(0, 1.0)], camera, page: Page::px(1000.0, 1000.0) };
//! let (drawing, _) = Animator::new(&model, &style).draw(&moment)?;
//! assert!(drawing.layers.iter().any(|layer| layer.kind == LayerKind::Motion));
//! # Ok::<(), ligne::Error>(())
//! ```

mod line_starts;
mod moving_bodies;
pub(crate) mod options;
mod tolerances;

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::animation::{Playing, PosedVertices, Rigged};
use crate::error::Error;
use crate::geometry::numbers::portable_math::cos;
use crate::scene::{Mover, Scene, Trail};
use line_starts::LineStarts;
use moving_bodies::{BodySelection, MovingBody, bodies};

pub use options::FadeBy;
pub(crate) use options::{MotionOptions, Speed, TrailPath};

/// Points of a trail per segment. Long segments of bent trails are therefore drawn as curves.
pub(crate) const POINTS_PER_SEGMENT: usize = 4;

/// The scene while clips play, as [`Rigged::posed`] gives it. If the options enable motion lines, it includes
/// the bodies that may leave them. `seed` selects the vertices where lines start.
///
/// # Errors
/// As [`Rigged::posed`].
pub(crate) fn posed(
    rigged: &Rigged,
    playing: &[Playing],
    options: &MotionOptions,
    seed: u64,
) -> Result<Scene, Error> {
    let mut scene = rigged.posed(playing)?;
    if options.enabled && !playing.is_empty() {
        scene.movers = Some(movers(rigged, playing, options, seed, &mut scene));
    }
    Ok(scene)
}

/// The bodies that move at a moment and may leave lines, with the trails of their vertices.
fn movers(
    rigged: &Rigged,
    playing: &[Playing],
    options: &MotionOptions,
    seed: u64,
    scene: &mut Scene,
) -> Vec<Mover> {
    let (choice, step) = (BodySelection::new(rigged, options), 1.0 / options.rate);
    let (now, before) = (rigged.at(playing), rigged.at(&earlier(playing, step)));
    // Index of each part of the file among the visible parts.
    let mut visible_numbers = 0..;
    let visible_index: Vec<Option<usize>> = (0..rigged.scene.parts.len())
        .map(|part| now.is_shown(part).then(|| visible_numbers.next()).flatten())
        .collect();
    let moving: Vec<(usize, MovingBody, LineStarts, bool)> =
        bodies(rigged, |part| now.differs(&before, part))
            .into_par_iter()
            .filter_map(|body| {
                let part_index = visible_index.get(body.part).copied().flatten()?;
                let starts = LineStarts::new(rigged, &body, options, seed);
                let speed = starts.speed(body.part, [&now, &before], step);
                let chosen = choice.selects(&body, speed);
                let leaves =
                    speed > 0.0 && (chosen || choice.by_page_speed) && has_extent(scene, part_index, &body);
                leaves.then_some((part_index, body, starts, chosen))
            })
            .collect();
    for (_, body, starts, _) in &moving {
        for number in &starts.missing {
            let part = rigged.scene.parts.get(body.part).map_or("", |part| &part.name);
            scene
                .warnings
                .note(format!("a motion line begins at vertex {number}, which part '{part}' lacks"));
        }
    }
    if moving.is_empty() {
        return Vec::new();
    }
    let longest = moving.iter().flat_map(|(_, _, starts, _)| &starts.lines).map(|line| line.segments).max();
    let interval = step / POINTS_PER_SEGMENT as f64;
    let buffer: Vec<PosedVertices> = (0..longest.unwrap_or(0) * POINTS_PER_SEGMENT + 1)
        .into_par_iter()
        .map(|k| rigged.at(&earlier(playing, interval * k as f64)))
        .collect();
    let above: Vec<Option<usize>> = moving.iter().map(|(_, body, ..)| above(rigged, body, &moving)).collect();
    moving
        .into_par_iter()
        .zip(above)
        .map(|((moving_part, body, starts, chosen), above)| Mover {
            part: moving_part,
            material: starts.material,
            identity: body.identity,
            above,
            chosen,
            interval,
            trails: trails(body.part, &starts, options, &buffer),
            body: if options.over { Vec::new() } else { triangles(scene, moving_part, &body) },
        })
        .collect()
}

/// For the joint of a body, the index of its closest ancestor among the bodies of the same part.
fn above(rigged: &Rigged, body: &MovingBody, all: &[(usize, MovingBody, LineStarts, bool)]) -> Option<usize> {
    let mut node = body.node;
    loop {
        node = rigged.rig.nodes.get(node)?.parent?;
        let of_node = |(_, other, ..): &(usize, MovingBody, LineStarts, bool)| {
            other.part == body.part && other.node == node
        };
        if let Some(place) = all.iter().position(of_node) {
            return Some(place);
        }
    }
}

/// The same clips at an earlier time.
pub(crate) fn earlier(playing: &[Playing], seconds: f64) -> Vec<Playing> {
    playing.iter().map(|own| Playing { time: own.time - seconds, ..*own }).collect()
}

/// The trails of the vertices where lines start.
fn trails(part: usize, starts: &LineStarts, options: &MotionOptions, buffer: &[PosedVertices]) -> Vec<Trail> {
    let middle = |moment: &PosedVertices| {
        let anchor_positions: Vec<DVec3> =
            starts.anchors.iter().filter_map(|vertex| moment.place(part, *vertex)).collect();
        anchor_positions.iter().sum::<DVec3>() / anchor_positions.len().max(1) as f64
    };
    let centre_path: Vec<DVec3> = match options.path {
        TrailPath::Vertex => Vec::new(),
        TrailPath::Body => buffer.iter().map(middle).collect(),
    };
    // A body scaled to zero appears from nothing. Its trail starts where it has a size.
    let positions_at = |moment: &PosedVertices| {
        let places = starts.anchors.iter().filter_map(|vertex| moment.place(part, *vertex));
        places.collect::<Vec<DVec3>>()
    };
    let sized =
        buffer.iter().position(|moment| is_point(positions_at(moment).into_iter())).unwrap_or(buffer.len());
    let lines = starts.lines.iter().filter(|line| line.visible);
    lines
        .map(|line| {
            let count = (line.segments * POINTS_PER_SEGMENT + 1).min(sized);
            let vertex_position = |moment: &PosedVertices| moment.place(part, line.vertex);
            let mut points: Vec<DVec3> =
                match (options.path, buffer.first().and_then(vertex_position), centre_path.first()) {
                    (TrailPath::Body, Some(here), Some(now)) => {
                        centre_path.iter().take(count).map(|then| here + (*then - *now)).collect()
                    }
                    _ => buffer.iter().take(count).map_while(vertex_position).collect(),
                };
            end_at_turn(&mut points, options.turn);
            Trail { line: line.number, named: line.named, rule: line.rule, points }
        })
        .collect()
}

/// Cuts a trail where its direction first differs from the latest one by more than `degrees`.
fn end_at_turn(points: &mut Vec<DVec3>, degrees: f64) {
    if degrees >= 180.0 {
        return;
    }
    let least = cos(degrees.to_radians());
    let mut now: Option<DVec3> = None;
    let turns = |pair: &[DVec3; 2]| {
        let Some(way) = (pair[0] - pair[1]).try_normalize() else { return false };
        way.dot(*now.get_or_insert(way)) < least
    };
    if let Some(end) = points.array_windows().position(turns) {
        points.truncate(end + 1);
    }
}

/// A sentence that explains why no body leaves lines at a moment; `None` if one does.
#[must_use]
pub(crate) fn no_lines_reason(
    rigged: &Rigged,
    playing: &[Playing],
    options: &MotionOptions,
    scene: &Scene,
) -> Option<String> {
    if !scene.movers.as_ref()?.is_empty() {
        return None;
    }
    let (choice, step) = (BodySelection::new(rigged, options), 1.0 / options.rate);
    let (now, before) = (rigged.at(playing), rigged.at(&earlier(playing, step)));
    let speed =
        |body: &MovingBody| LineStarts::new(rigged, body, options, 0).speed(body.part, [&now, &before], step);
    let moving = bodies(rigged, |part| now.is_shown(part) && now.differs(&before, part));
    let fastest = moving.iter().map(|body| (speed(body), body)).filter(|(speed, _)| *speed > 0.0);
    let Some((speed, body)) = fastest.max_by(|a, b| a.0.total_cmp(&b.0)) else {
        return Some("no motion lines: nothing moves at this moment; choose another --time".to_owned());
    };
    let name = rigged.scene.parts.get(body.part).map_or("", |part| &part.name);
    let reason = match choice.speed {
        _ if choice.by_page_speed || choice.selects(body, speed) => {
            "all moving parts have no size at this moment".to_owned()
        }
        Some(least) => format!(
            "the fastest part, '{name}', goes {speed:.3} units a second, not more than {least:.3}; \
             set motion.speed lower, or name parts with motion.parts"
        ),
        None => format!("motion.parts does not name the moving parts, such as '{name}'"),
    };
    Some(format!("no motion lines: {reason}"))
}

/// Least height of a triangle with area, as a share of its longest side. Bodies scaled to zero have flatter
/// ones, by rounding.
const MIN_HEIGHT_OF_SIDE: f64 = crate::mesh::tolerances::DEGENERATE_HEIGHT_OF_PART;

/// Whether a body has a size.
///
/// It has none after scaling to zero: all its triangles lack area, or all vertices of a joint coincide.
/// Bodies of wires always have one.
fn has_extent(scene: &Scene, place: usize, body: &MovingBody) -> bool {
    if body.is_joint() {
        let part = scene.parts.get(place);
        let geometry = part.and_then(|part| scene.geometries.get(part.geometry));
        let positions = geometry.map_or(&[][..], |geometry| &geometry.positions);
        let own = (0_u32..).zip(positions).filter(|(vertex, _)| body.holds(*vertex)).map(|(_, place)| *place);
        return !is_point(own);
    }
    let faces = triangles(scene, place, body);
    let has_area = |[a, b, c]: &[DVec3; 3]| {
        let sides = [*b - *a, *c - *a, *c - *b];
        let longest = sides.iter().map(|side| side.length_squared()).fold(0.0, f64::max);
        sides[0].cross(sides[1]).length() > MIN_HEIGHT_OF_SIDE * longest
    };
    faces.is_empty() || faces.iter().any(has_area)
}

/// Whether several positions coincide except for rounding.
fn is_point(mut places: impl Iterator<Item = DVec3>) -> bool {
    let Some(first) = places.next() else { return false };
    let mut count = 1;
    let is_same = places.all(|place| {
        count += 1;
        place.distance(first) <= MIN_HEIGHT_OF_SIDE * first.abs().max(place.abs()).max_element()
    });
    is_same && count > 1
}

/// The triangles of a body, world.
fn triangles(scene: &Scene, place: usize, body: &MovingBody) -> Vec<[DVec3; 3]> {
    let Some(part) = scene.parts.get(place) else { return Vec::new() };
    let Some(geometry) = scene.geometries.get(part.geometry) else { return Vec::new() };
    let corner = |vertex: u32| {
        let position = geometry.positions.get(vertex as usize)?;
        Some(part.world_from_part.transform_point3(*position))
    };
    let own = geometry.triangles.iter().filter(|corners| corners.iter().any(|corner| body.holds(*corner)));
    let placed = own.filter_map(|corners| {
        let [a, b, c] = corners.map(corner);
        Some([a?, b?, c?])
    });
    placed.collect()
}
