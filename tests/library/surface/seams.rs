//! Seams between surfaces that were triangulated separately are not drawn, while intended gaps and steps
//! stay; drawings of the solid without seams are the reference.

use std::f64::consts::TAU;

use crate::library::support::pipeline::{exact_options, orthographic, perspective, run_stages, scene};
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::solids::{Solid, cuboid};
use glam::DVec3;
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::lines::{LineKind, LineOptions};
use ligne::mesh::{DihedralCosines, EdgeFaces, Mesh, Soup};

pub(crate) fn mesh(solid: &Solid) -> Mesh {
    Mesh::build(Soup {
        positions: solid.positions.clone(),
        triangles: solid.triangles.clone(),
        ..Soup::default()
    })
}

/// Returns the number of edges with one face, and of edges that turn by more than the given angle.
pub(crate) fn count_open_and_sharp_edges(mesh: &Mesh, degrees: f64) -> [usize; 2] {
    let turns = DihedralCosines::of(mesh);
    let count = |holds: &dyn Fn(usize) -> bool| (0..mesh.edges.len()).filter(|edge| holds(*edge)).count();
    [
        count(&|edge| matches!(mesh.edges.faces(edge), EdgeFaces::One(_))),
        count(&|edge| f64::from(turns.at(mesh, edge)) < cos(degrees.to_radians())),
    ]
}

/// Adds a rectangle with its own vertices.
pub(crate) fn add_tile(solid: &mut Solid, corner: DVec3, u: DVec3, v: DVec3) {
    solid.add(Solid {
        positions: vec![corner, corner + u, corner + u + v, corner + v],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    });
}

/// A tube around the z axis with a given number of sides.
fn tube(around: u32, from: f64, to: f64) -> Solid {
    let at = |k: u32, z: f64| {
        let turn = TAU * f64::from(k) / f64::from(around);
        DVec3::new(cos(turn), sin(turn), z)
    };
    let mut solid = Solid::default();
    for k in 0..around {
        let next = (k + 1) % around;
        solid.add(Solid {
            positions: vec![at(k, from), at(next, from), at(next, to), at(k, to)],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
        });
    }
    solid
}

#[test]
fn curved_seams_with_different_chords_are_not_drawn() {
    let mut two = tube(24, -1.0, 0.0);
    two.add(tube(37, 0.0, 1.0));
    // Only the far ends are open.
    assert_eq!(count_open_and_sharp_edges(&mesh(&two), 45.0), [24 + 37, 0]);
    let drawn = run_stages(
        &scene([two]),
        &perspective(DVec3::new(5.0, 1.0, 1.5), DVec3::ZERO, 40.0),
        &LineOptions::default(),
    );
    let middle = drawn.view.frame.width / 2.0;
    let across = drawn.visible_segments_of_kind(LineKind::Border);
    assert!(!across.is_empty() && across.iter().flatten().all(|p| (p.x - middle).abs() > 100.0));
}

/// A square plate with a polygonal hole of `chords` sides (a multiple of four), and a hole wall with `wall`
/// sides. The wall is wider by the sagitta of a chord. Hole corners are joined to the four plate corners.
fn plate_with_a_hole(chords: u32, wall: u32, turned: f64) -> Solid {
    let at = |count: u32, k: u32, from: f64| {
        let angle = from + f64::from(k % count) / f64::from(count) * TAU;
        DVec3::new(cos(angle), sin(angle), 0.0)
    };
    let mut solid = Solid::default();
    // The last chords of each quarter make thin triangles with its plate corner.
    let corner = |quarter: u32| at(4, quarter, 0.05) * 20.0;
    let quarter = |k: u32| k * 4 / chords;
    for k in 0..chords {
        let [from, to] = [k, k + 1].map(|k| at(chords, k, 0.0));
        let own = corner(quarter(k));
        solid.add(Solid { positions: vec![from, own, to], triangles: vec![[0, 1, 2]] });
        if quarter(k + 1) != quarter(k) {
            solid.add(Solid { positions: vec![to, own, corner(quarter(k) + 1)], triangles: vec![[0, 1, 2]] });
        }
    }
    for k in 0..wall {
        let wider = 2.0 - cos(TAU / f64::from(chords * 2));
        let [from, to] = [k, k + 1].map(|k| at(wall, k, turned) * wider);
        add_tile(&mut solid, from, to - from, DVec3::NEG_Z);
    }
    solid
}

#[test]
fn sewing_does_not_flip_or_tilt_faces() {
    let mut sewn = 0;
    for (chords, wall) in [(12, 16), (16, 12), (8, 20), (20, 9), (24, 7), (40, 11), (12, 31)] {
        for turned in [0.02, 0.05, 0.11, 0.2] {
            let solid = plate_with_a_hole(chords, wall, turned);
            let mesh = mesh(&solid);
            sewn += mesh.triangles.len() - solid.triangles.len();
            for (face, normal) in mesh.triangles.iter().zip(&mesh.face_normals) {
                let is_plate = face.iter().all(|v| mesh.positions[*v as usize].z + mesh.origin.z > -1e-9);
                assert!(!is_plate || normal[2] > 0.9, "{chords} {wall} {turned}: {normal:?}");
            }
        }
    }
    assert!(sewn > 50, "{sewn}");
}

#[test]
fn a_straight_side_next_to_a_rounded_corner_is_not_sewn() {
    // A plate with a long side that ends in a rounded corner.
    let mut plate = Solid { positions: vec![DVec3::new(0.0, 9.0, 0.0), DVec3::ZERO], ..Solid::default() };
    plate.positions.extend((0..=4).map(|k| {
        let turn = TAU / 4.0 * f64::from(k) / 4.0;
        DVec3::new(9.0 + sin(turn), 1.0 - cos(turn), 0.0)
    }));
    plate.positions.push(DVec3::new(10.0, 9.0, 0.0));
    plate.triangles = (1..plate.positions.len() as u32 - 1).map(|k| [0, k, k + 1]).collect();
    let faces = plate.triangles.len();
    // A separate triangle with a side near the plate's, running in the opposite direction.
    plate.add(Solid {
        positions: [[5.0, -0.3, 0.1], [4.0, -0.3, 0.1], [4.5, -1.0, 0.1]].map(DVec3::from).to_vec(),
        triangles: vec![[0, 1, 2]],
    });
    assert_eq!(mesh(&plate).triangles.len(), faces + 1, "no face is cut");
}

#[test]
fn nearby_seam_vertices_are_welded() {
    // Offsets as large as those of programs that triangulate each surface separately.
    let mut dice = Dice::new(11);
    let mut two = tube(24, -1.0, 0.0);
    two.add(
        tube(24, 0.0, 1.0).moved(|p| if p.z == 0.0 { p * 1.00004 + DVec3::new(0.0, 2e-5, -3e-5) } else { p }),
    );
    two.add(tube(24, 1.0, 1.5).moved(|p| DVec3::new(p.x, p.y + 5e-5, p.z - 3e-5)));
    assert_eq!(count_open_and_sharp_edges(&mesh(&two), 45.0), [2 * 24, 0]);
    // A strip narrower than the tolerance is not a seam.
    let narrow = tube(24, 0.0, 5e-5);
    let turned = dice.direction();
    assert_eq!(count_open_and_sharp_edges(&mesh(&narrow.moved(|p| p + turned)), 45.0)[0], 2 * 24);
}

#[test]
fn intended_gaps_stay_open() {
    for gap in [0.01, 0.05] {
        let mut two = tube(24, -1.0, -gap);
        two.add(tube(37, 0.0, 1.0));
        assert_eq!(count_open_and_sharp_edges(&mesh(&two), 45.0)[0], 2 * (24 + 37), "{gap}");
    }
    let mut tiles = Solid::default();
    add_tile(&mut tiles, DVec3::ZERO, DVec3::X, DVec3::Y);
    add_tile(&mut tiles, DVec3::new(-0.3, 1.001, 0.0), DVec3::X * 1.5, DVec3::Y);
    assert_eq!(count_open_and_sharp_edges(&mesh(&tiles), 45.0)[0], 8);
}

#[test]
fn faces_with_discontinuous_uvs_are_not_sewn() {
    let mut tiles = Solid::default();
    add_tile(&mut tiles, DVec3::ZERO, DVec3::X, DVec3::Y);
    add_tile(&mut tiles, DVec3::new(0.0, 1.0, 0.0), DVec3::X * 0.25, DVec3::Y);
    add_tile(&mut tiles, DVec3::new(0.25, 1.0, 0.0), DVec3::X * 0.75, DVec3::Y);
    for shift in [0.0, 0.25] {
        // In the second round, the second and third tiles take their colours from another place in the
        // picture.
        let uv = |(k, p): (usize, &DVec3)| [p.x as f32, p.y as f32 + if k < 4 { 0.0 } else { shift }];
        let mesh = Mesh::build(Soup {
            positions: tiles.positions.clone(),
            triangles: tiles.triangles.clone(),
            uvs: tiles.positions.iter().enumerate().map(uv).collect(),
            corner_uvs: tiles.triangles.clone(),
            ..Soup::default()
        });
        assert_eq!(count_open_and_sharp_edges(&mesh, 45.0)[0], if shift == 0.0 { 7 } else { 10 });
        for (triangle, uvs) in mesh.triangles.iter().zip(&mesh.corner_uvs) {
            for (v, uv) in triangle.iter().zip(uvs) {
                let place = mesh.positions[*v as usize] + mesh.origin;
                assert_eq!(mesh.uvs[*uv as usize][0], place.x as f32);
            }
        }
    }
}

/// A wedge of a given angle along x, with extra vertices on its sharp edge on both sides.
fn wedge(degrees: f64, corners: [&[f64]; 2]) -> Solid {
    let (half, long) = (degrees.to_radians() / 2.0, 3.0);
    let far = [-half, half].map(|turn| DVec3::new(0.0, cos(turn), sin(turn)) * 2.0);
    let mut solid = Solid::default();
    let mut polygon = |points: &[DVec3]| {
        let triangles = (2..points.len() as u32).map(|k| [0, k - 1, k]).collect();
        solid.add(Solid { positions: points.to_vec(), triangles });
    };
    let at = |p: DVec3, x: f64| p + DVec3::X * x;
    // A fan around a far corner, so that no triangle has all its corners on the sharp edge.
    for (k, own) in corners.into_iter().enumerate() {
        let mut points = vec![at(far[k], 0.0), DVec3::ZERO];
        points.extend(own.iter().map(|x| at(DVec3::ZERO, *x)));
        points.extend([at(DVec3::ZERO, long), at(far[k], long)]);
        if k == 0 {
            points[1..].reverse();
        }
        polygon(&points);
    }
    polygon(&[far[0], far[1], at(far[1], long), at(far[0], long)]);
    polygon(&[DVec3::ZERO, far[1], far[0]]);
    polygon(&[at(DVec3::ZERO, long), at(far[0], long), at(far[1], long)]);
    solid
}

#[test]
fn t_vertices_in_an_edge_are_sewn_at_any_dihedral_angle() {
    let mut dice = Dice::new(3);
    for degrees in [3.0, 20.0, 45.0, 59.0, 61.0, 90.0, 130.0] {
        for corners in
            [[&[1.0][..], &[]], [&[], &[0.4, 2.2]], [&[1.0], &[2.0]], [&[0.5, 1.0, 2.9], &[0.7, 0.8]]]
        {
            let turn = dice.turn();
            // At full precision and rounded to six decimals.
            for rounded in [false, true] {
                let round = |p: DVec3| if rounded { (p * 1e6).round() / 1e6 } else { p };
                let [own, plain] = [corners, [&[][..], &[][..]]]
                    .map(|corners| wedge(degrees, corners).moved(|p| round(turn * p)));
                let open = count_open_and_sharp_edges(&mesh(&own), 45.0)[0];
                assert_eq!(open, 0, "{degrees} degrees, {corners:?}, rounded: {rounded}");
                let way = dice.direction() * 9.0;
                let [own, plain] = [own, plain].map(|solid| {
                    let drawn =
                        run_stages(&scene([solid]), &perspective(way, DVec3::ZERO, 40.0), &exact_options());
                    assert!(drawn.visible_segments_of_kind(LineKind::Border).is_empty());
                    [drawn.visible_segments(), drawn.silhouette_segments()]
                        .map(|lines| lines.iter().map(|[a, b]| a.distance(*b)).sum::<f64>())
                });
                let off = [0, 1].map(|k| (own[k] - plain[k]).abs());
                assert!(
                    off[0] < 0.01 && off[1] < 0.01,
                    "{degrees} degrees, {corners:?}: {own:?} and {plain:?}"
                );
            }
        }
    }
}

#[test]
fn front_and_back_of_a_thin_card_are_not_sewn() {
    // Front and back are closer than the seam tolerance. Each is divided at a different place.
    let mut card = Solid::default();
    for (z, part) in [(0.0, 0.3), (5e-5, 0.6)] {
        let mut side = Solid::default();
        add_tile(&mut side, DVec3::Z * z, DVec3::X * part, DVec3::Y);
        add_tile(&mut side, DVec3::new(part, 0.0, z), DVec3::X * (1.0 - part), DVec3::Y);
        if z == 0.0 {
            side.triangles.iter_mut().for_each(|triangle| triangle.reverse());
        }
        card.add(side);
    }
    let own = mesh(&card);
    assert_eq!((own.triangles.len(), count_open_and_sharp_edges(&own, 45.0)[0]), (8, 12));
}

#[test]
fn surfaces_of_different_parts_are_not_sewn() {
    let solid = |low: f64, high: f64| {
        let mut solid = Solid::default();
        add_tile(&mut solid, DVec3::new(low, low, 0.0), DVec3::X * (high - low), DVec3::Y);
        solid
    };
    let drawn = run_stages(
        &scene([solid(0.0, 1.0), solid(1.0, 3.0)]),
        &orthographic(DVec3::new(0.0, 0.0, 9.0), DVec3::ZERO, 9.0),
        &exact_options(),
    );
    assert_eq!(drawn.mesh.triangles.len(), 4);
}

#[test]
fn low_steps_keep_their_sharp_edges() {
    let mut plate = cuboid(DVec3::ZERO, DVec3::new(1.0, 1.0, 0.2));
    // A tile half a pixel high on the plate, without a bottom.
    let mut tile = cuboid(DVec3::new(0.3, 0.3, 0.2), DVec3::new(0.7, 0.7, 0.2005));
    tile.triangles.drain(0..2);
    plate.add(tile);
    assert_eq!(count_open_and_sharp_edges(&mesh(&plate), 45.0)[1], 12 + 8);
}
