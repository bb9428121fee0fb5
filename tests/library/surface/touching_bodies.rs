//! Bodies that touch along an edge or lie in one plane: the lines do not depend on how the file stores them.
//! Rewritten files are compared on shared vertices, face order and the position of zero-area faces.

use glam::{DAffine3, DVec3};
use ligne::scene::Camera;

use crate::library::support::rewriting::body::{Body, Face};
use crate::library::support::rewriting::model::{RandomModel, ViewChoice};
use crate::library::support::rewriting::relations::Relation;
use crate::library::support::rewriting::shapes::cuboid;
use crate::library::support::rewriting::trial::Trial;

/// Views from above, from below, edge-on, and in perspective.
fn sights() -> [ViewChoice; 6] {
    [
        ViewChoice::Angles(30.0, 35.0),
        ViewChoice::Angles(200.0, -25.0),
        ViewChoice::AlongAxis(DVec3::X),
        ViewChoice::AlongAxis(DVec3::Y),
        ViewChoice::AlongAxis(DVec3::NEG_Z),
        ViewChoice::Direction { to_eye: DVec3::new(-0.5, 0.3, -0.8), is_parallel: false },
    ]
}

/// A box, given by its lowest corner and its size.
fn box_at(low: [f64; 3], size: [f64; 3], colour: u8) -> Body {
    cuboid(DVec3::from(size)).moved(|p| p + DVec3::from(low)).coloured(colour)
}

/// A flat polygon.
fn sheet(corners: &[[f64; 3]], colour: u8) -> Body {
    let points = corners.iter().map(|corner| DVec3::from(*corner)).collect();
    let face = Face { corners: (0..corners.len() as u32).collect(), colour };
    Body { points, faces: vec![face], ..Body::default() }
}

/// Draws the bodies in all views and compares each drawing with those of the rewritten files.
fn assert_alike(bodies: &[Body], relations: &[Relation], seeds: std::ops::Range<u64>) {
    let (mut made, mut faults) = (0, Vec::new());
    for sight in sights() {
        for seed in seeds.clone() {
            let bodies =
                bodies.iter().zip(0..).map(|(body, k)| Body { part: format!("part{k}"), ..body.clone() });
            let mut model = RandomModel {
                kind: "bodies that touch".into(),
                seed,
                bodies: bodies.collect(),
                world_from_model: DAffine3::IDENTITY,
                view: sight,
                camera: Camera::three_quarter(),
            };
            model.fit_camera();
            let trials = Trial::run_all(&model, relations);
            made += trials.len();
            let found = trials.iter().filter(|trial| trial.outcome.is_failure());
            faults.extend(found.map(|fault| format!("{sight:?}, {}", fault.description())));
        }
    }
    assert!(faults.is_empty(), "{} of {made} differ\n{}", faults.len(), faults.join("\n"));
}

/// Rewrites that change shared vertices and the order of faces.
const EDGE_REWRITES: [Relation; 5] = [
    Relation::VertexInEdge,
    Relation::VertexInEdgeOneSided,
    Relation::Turned,
    Relation::OtherOrder,
    Relation::GroupPerFace,
];

#[test]
fn lines_of_boxes_with_a_common_edge_do_not_depend_on_shared_vertices() {
    let ground = box_at([0.0; 3], [4.0, 1.0, 2.0], 0);
    // In order: over the whole top, over half of it (a corner lies in the middle of the edge), side by side,
    // and along an edge only.
    for (low, size, colour) in [
        ([0.0, 1.0, 0.0], [4.0, 2.0, 2.0], 0),
        ([0.0, 1.0, 0.0], [2.0, 2.0, 2.0], 1),
        ([4.0, 0.0, 0.0], [1.0, 1.0, 2.0], 1),
        ([4.0, 1.0, 0.0], [2.0, 1.0, 2.0], 0),
    ] {
        assert_alike(&[ground.clone(), box_at(low, size, colour)], &EDGE_REWRITES, 0..2);
    }
}

#[test]
fn lines_of_a_sheet_on_a_box_edge_do_not_depend_on_shared_vertices() {
    let ground = box_at([0.0; 3], [4.0, 1.0, 2.0], 0);
    let side = [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0], [0.0, 1.0, 2.0], [0.0, 1.0, 0.0]];
    let flap = [[0.0, 1.0, 0.0], [4.0, 1.0, 0.0], [4.0, 2.5, -1.0], [0.0, 2.5, -1.0]];
    let level = [[0.0, 1.0, 0.0], [0.0, 1.0, 2.0], [-3.0, 1.0, 2.0], [-3.0, 1.0, 0.0]];
    for corners in [side, flap, level] {
        assert_alike(&[ground.clone(), sheet(&corners, 1)], &EDGE_REWRITES, 0..3);
    }
}

#[test]
fn material_lines_at_an_edge_of_two_overlaps_do_not_depend_on_the_file() {
    // Blocks of other colours, sunk into the top and into a side. Both reach past the edge between them.
    let bodies = [
        box_at([0.0; 3], [2.0, 2.0, 2.0], 0),
        box_at([1.0, 1.0, 0.5], [2.0, 1.0, 0.5], 1),
        box_at([0.5, 1.0, 1.25], [1.5, 2.0, 0.5], 2),
    ];
    let relations =
        [Relation::Turned, Relation::OtherOrder, Relation::OtherDiagonals, Relation::VertexInEdgeOneSided];
    assert_alike(&bodies, &relations, 0..4);
}

#[test]
fn zero_area_faces_along_a_decal_change_no_line() {
    let wall = box_at([0.0; 3], [4.0, 3.0, 1.0], 0);
    let decal = sheet(&[[0.5, 0.5, 1.0], [1.5, 0.5, 1.0], [1.5, 2.5, 1.0], [0.5, 2.5, 1.0]], 1);
    assert_alike(&[wall, decal], &[Relation::FacesWithoutArea], 0..24);
}

#[test]
fn lines_of_a_bent_sheet_do_not_depend_on_winding() {
    let corners = [
        [0.0, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [3.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [3.0, 2.0, 1.5],
        [0.0, 2.0, 1.5],
    ];
    let mut bent = sheet(&corners, 0);
    bent.faces =
        [[0, 1, 2, 3], [3, 2, 4, 5]].map(|corners| Face { corners: corners.to_vec(), colour: 0 }).to_vec();
    let relations =
        [Relation::AllReversed, Relation::ObjSinglePrecision, Relation::GlbSinglePrecision, Relation::Turned];
    assert_alike(&[bent], &relations, 0..3);
}
