//! A small castle: a keep in a yard, four round towers, battlements, a gatehouse and its steps.

use std::f64::consts::PI;

use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::castle_parts::{
    ASH, FLAG, GLASS, GOLD, GRASS, ROOF, SANDSTONE, SLATE, STONE, WOOD, battlement, facing, flag, quoins,
    round_tower, window,
};
use crate::geometry::outline::{arc, arch, at, rectangle};
use crate::geometry::part::{Part, together};
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{block, pillar, prism, turned};

/// Half the distance between the towers, and the height of the walls.
const HALF: f64 = 9.0;
const WALL_TOP: f64 = 5.2;

/// All parts, z up, with the gate facing -y.
pub fn castle() -> Vec<Part> {
    let mut parts = vec![Part::new("ground", GRASS, ground())];
    walls(&mut parts);
    towers(&mut parts);
    gatehouse(&mut parts);
    keep(&mut parts);
    parts.push(Part::new("trees", GRASS, trees()));
    parts
}

/// Low round hill.
fn ground() -> Solid {
    turned(&[(0.0, -1.6), (17.0, -1.6), (17.0, -1.2), (15.8, -0.5), (14.6, 0.0), (0.0, 0.0)], 96)
}

/// Three plain curtain walls and two next to the gate, each with battlements and a plinth.
fn walls(parts: &mut Vec<Part>) {
    let sides = [("back", 0.0, 1.0), ("left", -1.0, 0.0), ("right", 1.0, 0.0)];
    for (name, x, y) in sides {
        let wall =
            battlement(2.0 * HALF, 1.1, WALL_TOP, 11).moved(facing(x, y)).shifted(HALF * x, HALF * y, 0.0);
        parts.push(Part::new(&format!("wall-{name}"), STONE, wall));
    }
    let piece = battlement(6.4, 1.1, WALL_TOP, 4);
    let front =
        [-1.0, 1.0].map(|side| piece.clone().moved(facing(0.0, -1.0)).shifted(5.8 * side, -HALF, 0.0));
    parts.push(Part::new("wall-front", STONE, together(front)));
    let slits = [(-1.0, 0.0), (1.0, 0.0)].into_iter().flat_map(|(x, y)| {
        [-3.6, 0.0, 3.6].map(|along| {
            let place = DVec3::new((HALF + 0.56) * x, along, 2.3);
            slit().moved(facing(x, y)).shifted(place.x, place.y, place.z)
        })
    });
    let front = [-5.4, 5.4].map(|x| slit().moved(facing(0.0, -1.0)).shifted(x, -HALF - 0.56, 2.3));
    parts.push(Part::new("arrow-slits", GLASS, together(slits.chain(front))));
    let stones = [-5.9, 5.9].map(|x| {
        quoins(5.0, 3.6, if x < 0.0 { 11 } else { 5 }).moved(facing(0.0, -1.0)).shifted(x, -HALF - 0.55, 0.4)
    });
    let sides = [(-1.0, 0.0, 7), (1.0, 0.0, 3)]
        .map(|(x, y, seed)| quoins(13.0, 3.6, seed).moved(facing(x, y)).shifted((HALF + 0.55) * x, 0.0, 0.4));
    parts.push(Part::new("wall-stones", SANDSTONE, together(stones.into_iter().chain(sides))));
}

/// Cross-shaped arrow slit in the plane y = 0, with its foot at the origin.
fn slit() -> Solid {
    let (w, b) = (0.07, 0.3);
    let cross = [(w, 0.0), (w, 0.75), (b, 0.75), (b, 0.92), (w, 0.92), (w, 1.3)];
    let mut outline: Vec<DVec2> = cross.iter().map(|&(x, z)| at(x, z)).collect();
    outline.extend(cross.iter().rev().map(|&(x, z)| at(-x, z)));
    upright(prism(&outline, &[], -0.02, 0.04))
}

/// Turns a prism over (x, z) upright, with its height towards -y.
fn upright(solid: Solid) -> Solid {
    solid.moved(DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y)))
}

fn towers(parts: &mut Vec<Part>) {
    let corners = [
        ("south-west", -1.0, -1.0),
        ("south-east", 1.0, -1.0),
        ("north-east", 1.0, 1.0),
        ("north-west", -1.0, 1.0),
    ];
    for (name, x, y) in corners {
        let tower = round_tower(2.1, 8.6, 4.6);
        let turn = facing_angle;
        let at_corner = |solid: Solid| solid.shifted(HALF * x, HALF * y, 0.0);
        parts.push(Part::new(&format!("tower-{name}"), STONE, at_corner(tower.stone)));
        parts.push(Part::new(&format!("tower-{name}-trim"), SANDSTONE, at_corner(tower.trim)));
        parts.push(Part::new(&format!("tower-{name}-roof"), ROOF, at_corner(tower.roof)));
        let outward = libm::atan2(y, x);
        let windows =
            [(-0.75, 3.0), (0.75, 3.0), (0.0, 5.6), (-1.5, 5.6), (1.5, 5.6)].map(|(aside, height)| {
                let way = libm::cos(outward + aside);
                let across = libm::sin(outward + aside);
                window(0.5, 1.1).0.moved(turn(outward + aside)).shifted(2.12 * way, 2.12 * across, height)
            });
        parts.push(Part::new(&format!("tower-{name}-windows"), GLASS, at_corner(together(windows))));
        let top = tower.top;
        let (pole, cloth) = flag(1.7, 1.0);
        parts.push(Part::new(&format!("tower-{name}-pole"), GOLD, at_corner(pole.shifted(0.0, 0.0, top))));
        parts.push(Part::new(&format!("tower-{name}-flag"), FLAG, at_corner(cloth.shifted(0.0, 0.0, top))));
    }
}

/// Like [`facing`], with a direction given by its angle from x.
fn facing_angle(angle: f64) -> DAffine3 {
    facing(libm::cos(angle), libm::sin(angle))
}

/// Gatehouse: two half-round turrets, the arch between them, the gate with its bands, and the steps.
fn gatehouse(parts: &mut Vec<Part>) {
    let front = -HALF - 1.1;
    let sill = at(0.0, 1.0);
    let hole = arch(sill, 2.6, 2.9, 36);
    let body = prism(&rectangle(at(-2.3, 0.0), at(2.3, 6.2)), &[hole], 0.0, 0.8);
    let body = upright(body).shifted(0.0, front + 0.4, 0.0);
    let back = block(DVec3::new(-2.3, front + 0.4, 0.0), DVec3::new(2.3, front + 2.9, 6.2));
    let crown = battlement(4.6, 0.6, 1.0, 4).shifted(0.0, front - 0.1, 6.0);
    parts.push(Part::new("gatehouse", STONE, together([body, back, crown])));

    let mut ring = arc(at(0.0, 2.6), 1.62, 0.0, PI, 36);
    ring.extend(arc(at(0.0, 2.6), 1.3, PI, 0.0, 36));
    let ring = upright(prism(&ring, &[], 0.0, 0.15)).shifted(0.0, front - 0.4, 0.0);
    let key =
        upright(prism(&[at(-0.16, 3.82), at(0.16, 3.82), at(0.24, 4.4), at(-0.24, 4.4)], &[], 0.0, 0.24))
            .shifted(0.0, front - 0.4, 0.0);
    let posts = [-1.46, 1.46].map(|x| pillar(DVec3::new(x, front - 0.45, 1.0), DVec3::new(0.32, 0.3, 1.6)));
    let shield = upright(prism(&shield(), &[], 0.0, 0.14)).shifted(0.0, front - 0.4, 4.55);
    parts.push(Part::new("gate-arch", SANDSTONE, together([ring, key].into_iter().chain(posts))));
    parts.push(Part::new("shield", GOLD, shield));

    let door =
        upright(prism(&arch(at(0.0, 0.95), 2.7, 2.98, 36), &[], 0.0, 0.2)).shifted(0.0, front + 0.3, 0.0);
    parts.push(Part::new("gate", WOOD, door));
    let bars = (0..4).map(|i| {
        let x = -0.9 + 0.6 * f64::from(i);
        block(DVec3::new(x - 0.06, front - 0.02, 1.0), DVec3::new(x + 0.06, front + 0.12, 3.8))
    });
    let bands = (0..5).map(|i| {
        let z = 1.35 + 0.55 * f64::from(i);
        block(DVec3::new(-1.32, front - 0.05, z - 0.05), DVec3::new(1.32, front + 0.1, z + 0.05))
    });
    parts.push(Part::new("portcullis", SLATE, together(bars.chain(bands))));

    for (name, x) in [("gate-turret-left", -2.7), ("gate-turret-right", 2.7)] {
        let turret = round_tower(1.05, 6.8, 2.6);
        let place = |solid: Solid| solid.shifted(x, front, 0.0);
        parts.push(Part::new(name, STONE, place(turret.stone)));
        parts.push(Part::new(&format!("{name}-trim"), SANDSTONE, place(turret.trim)));
        parts.push(Part::new(&format!("{name}-roof"), ROOF, place(turret.roof)));
        let slits = [1.6, 4.0].map(|z| slit().shifted(0.0, -1.05, z));
        parts.push(Part::new(&format!("{name}-slits"), GLASS, place(together(slits))));
        let ball = pillar(DVec3::new(0.0, 0.0, turret.top), DVec3::new(0.08, 0.08, 0.7));
        parts.push(Part::new(&format!("{name}-spike"), GOLD, place(ball)));
    }

    // Flight of steps up to the gate, extruded from its side view.
    let mut side = vec![at(-3.0, -0.3), at(0.0, -0.3), at(0.0, 1.0)];
    for step in 0..5 {
        let (y, z) = (-0.6 * f64::from(step + 1), 1.0 - 0.2 * f64::from(step));
        side.extend([at(y, z), at(y, z - 0.2)]);
    }
    side.pop();
    let across = DAffine3::from_mat3(DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X));
    let flight = prism(&side, &[], -1.6, 1.6).moved(across).shifted(0.0, front - 0.4, 0.0);
    let cheeks = [-1.8, 1.8].map(|x| {
        let slope =
            [at(-3.3, -0.3), at(0.0, -0.3), at(0.0, 1.35), at(-0.6, 1.35), at(-3.0, 0.45), at(-3.3, 0.45)];
        prism(&slope, &[], -0.2, 0.2).moved(across).shifted(x, front - 0.4, 0.0)
    });
    parts.push(Part::new("steps", SANDSTONE, together([flight].into_iter().chain(cheeks))));
}

/// Heraldic shield around the origin, with a flat top and a pointed foot.
fn shield() -> Vec<DVec2> {
    let mut outline = arc(at(-0.55, 0.9), 1.1, -PI / 3.0, 0.0, 10);
    outline.extend([at(0.55, 1.2), at(-0.55, 1.2)]);
    outline.extend(arc(at(0.55, 0.9), 1.1, PI, 4.0 * PI / 3.0, 10));
    outline.pop();
    outline
}

/// Keep: a tall house with buttresses, battlements and a hipped roof.
fn keep(parts: &mut Vec<Part>) {
    let (half, top) = (3.6, 10.6);
    let body = pillar(DVec3::new(0.0, 1.2, 0.0), DVec3::new(2.0 * half, 2.0 * half, top));
    let buttresses = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(x, y)| pillar(DVec3::new(half * x, 1.2 + half * y, 0.0), DVec3::new(1.3, 1.3, top + 1.45)));
    let crown = [(0.0, -1.0), (0.0, 1.0), (-1.0, 0.0), (1.0, 0.0)].map(|(x, y)| {
        battlement(2.0 * half, 0.5, 1.3, 6).moved(facing(x, y)).shifted(
            (half + 0.1) * x,
            1.2 + (half + 0.1) * y,
            top,
        )
    });
    parts.push(Part::new("keep", ASH, together([body].into_iter().chain(buttresses).chain(crown))));
    let courses = [(3.6, 0.24), (7.2, 0.24), (top - 0.1, 0.35)]
        .map(|(z, h)| pillar(DVec3::new(0.0, 1.2, z), DVec3::new(2.0 * half + 0.5, 2.0 * half + 0.5, h)));
    parts.push(Part::new("keep-courses", SANDSTONE, together(courses)));
    let caps = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(x, y)| spire(1.7, 2.3).shifted(half * x, 1.2 + half * y, top + 1.45));
    parts.push(Part::new("keep-caps", ROOF, together(caps)));
    parts.push(Part::new("keep-roof", SLATE, spire(6.0, 4.6).shifted(0.0, 1.2, top + 0.2)));
    let (pole, cloth) = flag(3.2, 2.0);
    parts.push(Part::new("keep-pole", GOLD, pole.shifted(0.0, 1.2, top + 4.6)));
    parts.push(Part::new("keep-flag", FLAG, cloth.shifted(0.0, 1.2, top + 4.6)));

    let mut panes = Vec::new();
    let mut frames = Vec::new();
    for (x, y) in [(0.0, -1.0), (0.0, 1.0), (-1.0, 0.0), (1.0, 0.0)] {
        for (along, z) in [(-1.5, 4.5), (1.5, 4.5), (-1.5, 8.0), (0.0, 8.0), (1.5, 8.0)] {
            let (pane, frame) = window(0.8, 1.9);
            let place = |solid: Solid| solid.shifted(0.0, 0.0, z).moved(facing_shift(x, y, along, half));
            panes.push(place(pane));
            frames.push(place(frame));
        }
    }
    parts.push(Part::new("keep-windows", GLASS, together(panes)));
    parts.push(Part::new("keep-frames", SANDSTONE, together(frames)));
}

/// Shift onto the side of the keep that faces (x, y), `along` from its centre.
fn facing_shift(x: f64, y: f64, along: f64, half: f64) -> DAffine3 {
    let onto = facing(x, y);
    let aside = onto.transform_vector3(DVec3::X) * along;
    DAffine3::from_translation(DVec3::new(half * x, 1.2 + half * y, 0.0) + aside) * onto
}

/// Four-sided pyramid with small eaves.
fn spire(width: f64, height: f64) -> Solid {
    let mut solid = Solid::default();
    let half = width / 2.0;
    let foot = rectangle(at(-half, -half), at(half, half));
    let low = solid.ring(foot.iter().map(|point| point.extend(0.0)));
    let eave = solid.ring(foot.iter().map(|point| point.extend(0.15)));
    let tip = solid.ring([DVec3::Z * height]);
    solid.band(&low, &eave);
    solid.band(&eave, &tip);
    let under: Vec<u32> = low.into_iter().rev().collect();
    solid.plate(&under, &[]);
    solid
}

/// A few clipped trees on the hill.
fn trees() -> Solid {
    let places = [
        (-4.6, -12.4, 1.0),
        (-6.6, -12.0, 0.75),
        (5.0, -12.5, 0.9),
        (12.9, -4.0, 0.9),
        (13.2, -1.6, 0.7),
        (-13.0, 1.5, 1.0),
    ];
    let tree = |(x, y, size): (f64, f64, f64)| {
        let profile =
            [(0.0, 0.0), (0.16, 0.0), (0.16, 0.5), (0.75, 0.5), (0.42, 1.2), (0.6, 1.2), (0.0, 2.6)];
        let scaled: Vec<(f64, f64)> = profile.iter().map(|&(r, z)| (r * size, z * size)).collect();
        turned(&scaled, 20).shifted(x, y, -0.05)
    };
    together(places.map(tree))
}
