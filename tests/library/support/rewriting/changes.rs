//! Changes to a model that must not change its drawing: faces reversed, split, duplicated or reordered, and
//! hidden bodies.

use glam::DVec3;

use super::body::{Body, Face};
use super::model::RandomModel;
use super::shapes::cuboid;
use crate::library::support::scenes::random_dice::Dice;

/// A random selection of at least one of `count` items, and not of all if there are several.
fn random_selection(count: usize, dice: &mut Dice) -> Vec<bool> {
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

/// Reverses all faces.
pub(crate) fn reverse_all_faces(model: &mut RandomModel) {
    model.bodies.iter_mut().for_each(Body::reverse);
}

/// Reverses some bodies, but not all; `None` for a single body.
pub(crate) fn reverse_some_bodies(model: &mut RandomModel, dice: &mut Dice) -> Option<()> {
    let chosen = random_selection(model.bodies.len(), dice);
    let bodies = model.bodies.iter_mut().zip(chosen).filter(|(_, is_chosen)| *is_chosen);
    bodies.for_each(|(body, _)| body.reverse());
    (model.bodies.len() > 1).then_some(())
}

/// Triangulates each face. Another `start` gives other diagonals.
pub(crate) fn triangulate_faces(model: &mut RandomModel, start: usize) {
    for body in &mut model.bodies {
        let cut = |face: &Face| {
            let triangles = body.triangles(face, start).into_iter();
            triangles.map(|t| Face { corners: t.to_vec(), ..*face }).collect::<Vec<_>>()
        };
        body.faces = body.faces.iter().flat_map(cut).collect();
    }
}

/// The bodies without rounded surfaces; `None` if there are none.
fn flat_bodies(model: &mut RandomModel) -> Option<Vec<&mut Body>> {
    let flat: Vec<&mut Body> = model.bodies.iter_mut().filter(|body| !body.is_round).collect();
    (!flat.is_empty()).then_some(flat)
}

/// Splits some faces of flat bodies into triangles around interior points.
pub(crate) fn split_faces(model: &mut RandomModel, dice: &mut Dice) -> Option<()> {
    for body in flat_bodies(model)? {
        let chosen = random_selection(body.faces.len(), dice);
        for (face, is_chosen) in std::mem::take(&mut body.faces).into_iter().zip(chosen) {
            if !is_chosen {
                body.faces.push(face);
                continue;
            }
            for [a, b, c] in body.triangles(&face, dice.below(face.corners.len())) {
                // Dividing by four keeps the coordinates short.
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

/// Inserts vertices at the middle of some edges of flat bodies, in both faces of the edge or in one.
pub(crate) fn insert_edge_vertices(
    model: &mut RandomModel,
    on_both_sides: bool,
    dice: &mut Dice,
) -> Option<()> {
    for body in flat_bodies(model)? {
        let mut edges: Vec<[u32; 2]> = body.faces.iter().flat_map(directed_edges).collect();
        // Keep each edge once, in its first direction.
        let mut known = std::collections::BTreeSet::new();
        edges.retain(|[a, b]| known.insert([*a.min(b), *a.max(b)]));
        let chosen = random_selection(edges.len(), dice);
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

/// The directed edges of a face.
fn directed_edges(face: &Face) -> Vec<[u32; 2]> {
    let next = face.corners.iter().cycle().skip(1);
    face.corners.iter().zip(next).map(|(a, b)| [*a, *b]).collect()
}

/// Duplicates some faces.
pub(crate) fn duplicate_faces(model: &mut RandomModel, dice: &mut Dice) {
    for body in &mut model.bodies {
        let chosen = random_selection(body.faces.len(), dice);
        let doubles = body.faces.iter().zip(chosen).filter(|(_, is_chosen)| *is_chosen);
        let doubles: Vec<Face> = doubles.map(|(face, _)| face.clone()).collect();
        body.faces.extend(doubles);
    }
}

/// Adds degenerate faces: with a repeated corner, or with three corners on one edge.
pub(crate) fn add_degenerate_faces(model: &mut RandomModel, dice: &mut Dice) {
    for body in &mut model.bodies {
        for _ in 0..3 {
            let face = &body.faces[dice.below(body.faces.len())];
            let (colour, [a, b]) = (face.colour, directed_edges(face)[dice.below(face.corners.len())]);
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

/// Shuffles parts, bodies, faces and vertices, and rotates the corners of faces.
pub(crate) fn shuffle_model(model: &mut RandomModel, dice: &mut Dice) {
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

/// Adds a small box inside a closed body, as a separate part or in the same part; `None` if no body has room.
pub(crate) fn add_hidden_body(model: &mut RandomModel, dice: &mut Dice) -> Option<()> {
    let with_room: Vec<usize> = (0..model.bodies.len()).filter(|k| model.bodies[*k].core.is_some()).collect();
    let host = *with_room.get(dice.below(with_room.len().max(1)))?;
    let [low, high] = model.bodies[host].core?;
    let hidden = cuboid(high - low).moved(|p: DVec3| p + low);
    let part = if dice.below(2) == 0 { model.bodies[host].part.clone() } else { "hidden".into() };
    model.bodies.insert(host + 1, Body { part, ..hidden });
    Some(())
}
