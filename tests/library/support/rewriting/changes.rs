//! The same bodies written otherwise: faces reversed, cut, doubled, or in another order, and a body that is hidden.

use glam::DVec3;

use super::body::{Body, Face};
use super::model::Model;
use super::shapes::cuboid;
use crate::support::scenes::random_dice::Dice;

/// A random choice of at least one of `count` things, and of fewer than all if there are several.
fn some_of(count: usize, dice: &mut Dice) -> Vec<bool> {
    let mut chosen: Vec<bool> = (0..count).map(|_| dice.below(2) == 0).collect();
    if let Some(last) = count.checked_sub(1) {
        let sure = dice.below(count);
        chosen[sure] = true;
        if chosen.iter().all(|is| *is) && last > 0 {
            chosen[(sure + 1) % count] = false;
        }
    }
    chosen
}

pub fn all_reversed(model: &mut Model) {
    model.bodies.iter_mut().for_each(Body::reverse);
}

/// Reverses some bodies, but not all; `None` for a single body.
pub fn some_reversed(model: &mut Model, dice: &mut Dice) -> Option<()> {
    let chosen = some_of(model.bodies.len(), dice);
    let bodies = model.bodies.iter_mut().zip(chosen).filter(|(_, is_chosen)| *is_chosen);
    bodies.for_each(|(body, _)| body.reverse());
    (model.bodies.len() > 1).then_some(())
}

/// Each face as triangles. Another `start` gives other diagonals.
pub fn triangulated(model: &mut Model, start: usize) {
    for body in &mut model.bodies {
        let cut = |face: &Face| {
            let triangles = body.triangles(face, start).into_iter();
            triangles.map(|t| Face { corners: t.to_vec(), ..*face }).collect::<Vec<_>>()
        };
        body.faces = body.faces.iter().flat_map(cut).collect();
    }
}

fn flat_bodies(model: &mut Model) -> Option<Vec<&mut Body>> {
    let flat: Vec<&mut Body> = model.bodies.iter_mut().filter(|body| !body.is_round).collect();
    (!flat.is_empty()).then_some(flat)
}

/// Cuts some faces of flat bodies into triangles about points inside.
pub fn faces_split(model: &mut Model, dice: &mut Dice) -> Option<()> {
    for body in flat_bodies(model)? {
        let chosen = some_of(body.faces.len(), dice);
        for (face, is_chosen) in std::mem::take(&mut body.faces).into_iter().zip(chosen) {
            if !is_chosen {
                body.faces.push(face);
                continue;
            }
            for [a, b, c] in body.triangles(&face, dice.below(face.corners.len())) {
                // Halves and quarters keep the coordinates short.
                let [p, q, r] = [a, b, c].map(|corner| body.points[corner as usize]);
                body.points.push((p + q + r * 2.0) / 4.0);
                let middle = body.points.len() as u32 - 1;
                let parts = [[a, b, middle], [b, c, middle], [c, a, middle]];
                body.faces.extend(parts.map(|part| Face { corners: part.to_vec(), ..face }));
            }
        }
    }
    Some(())
}

/// Puts vertices into the middle of some edges of flat bodies: into both faces of the edge, or into one.
pub fn vertices_in_edges(model: &mut Model, on_both_sides: bool, dice: &mut Dice) -> Option<()> {
    for body in flat_bodies(model)? {
        let mut edges: Vec<[u32; 2]> = body.faces.iter().flat_map(sides).collect();
        // Each edge once, the way that comes first.
        let mut known = std::collections::BTreeSet::new();
        edges.retain(|[a, b]| known.insert([*a.min(b), *a.max(b)]));
        let chosen = some_of(edges.len(), dice);
        for ([a, b], _) in edges.into_iter().zip(chosen).filter(|(_, is_chosen)| *is_chosen) {
            let middle = body.points.len() as u32;
            body.points.push(body.points[a as usize].midpoint(body.points[b as usize]));
            for face in &mut body.faces {
                let count = face.corners.len();
                let side = (0..count).find(|k| {
                    let ends = [face.corners[*k], face.corners[(k + 1) % count]];
                    ends == [a, b] || on_both_sides && ends == [b, a]
                });
                if let Some(side) = side {
                    face.corners.insert(side + 1, middle);
                }
            }
        }
    }
    Some(())
}

/// The sides of a face from corner to corner.
fn sides(face: &Face) -> Vec<[u32; 2]> {
    let next = face.corners.iter().cycle().skip(1);
    face.corners.iter().zip(next).map(|(a, b)| [*a, *b]).collect()
}

/// Writes some faces twice.
pub fn faces_doubled(model: &mut Model, dice: &mut Dice) {
    for body in &mut model.bodies {
        let chosen = some_of(body.faces.len(), dice);
        let doubles = body.faces.iter().zip(chosen).filter(|(_, is_chosen)| *is_chosen);
        let doubles: Vec<Face> = doubles.map(|(face, _)| face.clone()).collect();
        body.faces.extend(doubles);
    }
}

/// Adds faces without area: with a corner twice, and with all corners on an edge.
pub fn faces_without_area(model: &mut Model, dice: &mut Dice) {
    for body in &mut model.bodies {
        for _ in 0..3 {
            let face = &body.faces[dice.below(body.faces.len())];
            let (colour, [a, b]) = (face.colour, sides(face)[dice.below(face.corners.len())]);
            let corners = if dice.below(2) == 0 {
                vec![a, b, b]
            } else {
                body.points.push(body.points[a as usize].midpoint(body.points[b as usize]));
                vec![a, body.points.len() as u32 - 1, b]
            };
            body.faces.push(Face { corners, colour });
        }
    }
}

/// Parts, bodies, faces and vertices in another order; faces begin at another corner.
pub fn reordered(model: &mut Model, dice: &mut Dice) {
    let parts: Vec<Vec<Body>> = model.parts().map(<[Body]>::to_vec).collect();
    let parts = dice.shuffled(parts);
    model.bodies = parts.into_iter().flat_map(|part| dice.shuffled(part)).collect();
    for body in &mut model.bodies {
        let order = dice.shuffled((0..body.points.len() as u32).collect());
        let points = std::mem::take(&mut body.points);
        let mut numbers = vec![0; order.len()];
        for (new, old) in (0_u32..).zip(&order) {
            numbers[*old as usize] = new;
            body.points.push(points[*old as usize]);
        }
        body.faces = dice.shuffled(std::mem::take(&mut body.faces));
        for face in &mut body.faces {
            face.corners.iter_mut().for_each(|corner| *corner = numbers[*corner as usize]);
            let start = dice.below(face.corners.len());
            face.corners.rotate_left(start);
        }
    }
}

/// Adds a small box inside a closed body, as a part or in the part of that body; `None` if no body has room.
pub fn hidden_body_added(model: &mut Model, dice: &mut Dice) -> Option<()> {
    let with_room: Vec<usize> = (0..model.bodies.len()).filter(|k| model.bodies[*k].core.is_some()).collect();
    let host = *with_room.get(dice.below(with_room.len().max(1)))?;
    let [low, high] = model.bodies[host].core?;
    let hidden = cuboid(high - low).moved(|p: DVec3| p + low);
    let part = if dice.below(2) == 0 { model.bodies[host].part.clone() } else { "hidden".into() };
    model.bodies.insert(host + 1, Body { part, ..hidden });
    Some(())
}
