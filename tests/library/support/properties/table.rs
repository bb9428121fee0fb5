//! The table of properties: each row lists ways to draw, subjects, changes, and bounds on the difference.

use super::InvarianceRow;
use super::bound::Bound;
use super::change::{Change, ReversedFaces};
use super::option_set::*;
use super::sheets::two_sheets;
use super::subject::{self, Subject};
use crate::library::support::scenes::random_scenes::ALL_SCENE_KINDS;

/// Kinds of random scenes that the rows use.
pub(crate) const SCENE_KINDS: [&str; 5] = ["boxes", "tori", "soup", "interpenetrating", "mixture"];
/// Kinds of random scenes with flat faces only.
const FLAT_SCENE_KINDS: [&str; 3] = ["boxes", "tetrahedra", "soup"];
/// Kinds of random cameras that the rows use.
pub(crate) const CAMERA_KINDS: [&str; 3] = ["perspective", "orthographic", "cutting"];

/// Ink with mesh contours, with the default contours, and with smooth contours.
const INKS: [OptionSet; 3] = [INK_MESH, INK, INK_SMOOTH];
const STYLES: [OptionSet; 10] =
    [INK, INK_FROM_IMAGE, TECHNICAL, TOON, COMIC, PENCIL, PEN, SUGGESTIVE, ENGRAVING, STIPPLE];

type Changes = &'static [(Change, &'static [Bound])];

const EQUAL_BYTES: &[Bound] = &[Bound::Bytes];
/// Compared with a drawing on two threads.
const THREADS: Changes = &[(Change::Threads(1), EQUAL_BYTES), (Change::Threads(4), EQUAL_BYTES)];
const RENUMBERED: Changes = &[(Change::Renumbered, EQUAL_BYTES)];
const SHUFFLED: Changes = &[(Change::AllShuffled, EQUAL_BYTES)];

const REVERSED: Changes = &[
    (Change::FacesReversed(ReversedFaces::All), EQUAL_BYTES),
    (Change::FacesReversed(ReversedFaces::OfEveryOtherGeometry), EQUAL_BYTES),
    (Change::FacesReversed(ReversedFaces::Random), EQUAL_BYTES),
];

const EXACT_BOUNDS: &[Bound] = &[Bound::by_class(1e-6, 0.02)];
/// At 1e6, coordinates are exact to about 1e-10 world units, and a unit covers some hundred px.
const FAR_BOUNDS: &[Bound] = &[Bound::by_class(1e-5, 0.05)];
/// The new vertices lie in their planes up to rounding.
const SPLIT_BOUNDS: &[Bound] = &[Bound::by_class(1e-6, 0.05)];
const SPLIT_DRAWING_BOUNDS: &[Bound] = &[Bound::by_class_and_part(1e-5, 0.01)];

/// Smooth lines may lie 0.1 px apart, because rounding may decide whether an edge is split.
///
/// An edge is split if its arc is higher than 0.08 px, and a symmetrical solid has many edges at that limit.
/// 30 px of some 3,000 px may differ: on an open surface seen edge-on, rounding may decide whether a ripple
/// of the mesh is drawn.
const SMOOTH_LINE_BOUNDS: &[Bound] = &[Bound::by_class(0.1, 30.0)];

/// Stroke length per part agrees except for random stroke ends. Measured: 0.0024 of the total.
///
/// If one of four parts had no strokes, 0.25 would be missing.
const STROKE_DENSITY_BOUNDS: &[Bound] = &[Bound::Strokes { share: 0.01 }];

/// Rounding may decide where a chain begins and where an arc is split, but not what is visible.
///
/// The end of a line may run 3 px too far. Lines are compared by class only: if parts of equal size
/// intersect, their positions decide which part owns the line.
const INK_LINE_BOUND: Bound = Bound::by_class_with_share(0.5, 3.0, 0.003);
const INK_LINE_BOUNDS: &[Bound] = &[INK_LINE_BOUND];

/// New orders of the parts, each with the bounds to test.
const fn part_orders(owned: &'static [Bound]) -> [(Change, &'static [Bound]); 4] {
    [
        (Change::PartsShuffled { seed: 47 }, owned),
        (Change::PartsShuffled { seed: 48 }, owned),
        (Change::PartsShuffled { seed: 49 }, owned),
        (Change::PartsReversed, owned),
    ]
}
const REORDERED: Changes = &part_orders(&[Bound::Bytes, Bound::IntersectionLengths { least: 3 }]);
const REORDERED_CUBES: Changes = &part_orders(&[Bound::Bytes, Bound::IntersectionLengths { least: 2 }]);

/// Rows of the default run.
pub(crate) const ROWS: &[InvarianceRow] = &[
    // Bare lines of the view map.
    InvarianceRow {
        options: &[EXACT_LINES],
        subjects: || subject::random_subjects(&SCENE_KINDS, &CAMERA_KINDS, 11),
        unchanged_by: &[
            (Change::RIGID_MOTION, EXACT_BOUNDS),
            (Change::scaled(1e-6), EXACT_BOUNDS),
            (Change::scaled(1e9), EXACT_BOUNDS),
            (Change::FAR_TRANSLATION, FAR_BOUNDS),
        ],
        min_segments: 10,
    },
    InvarianceRow {
        options: &[EXACT_LINES],
        subjects: || subject::random_subjects(&SCENE_KINDS, &CAMERA_KINDS, 12),
        unchanged_by: &[
            (Change::Renumbered, EQUAL_BYTES),
            (Change::AllShuffled, &[Bound::by_class(1e-9, 0.02)]),
        ],
        min_segments: 10,
    },
    InvarianceRow {
        options: &[EXACT_LINES],
        subjects: || subject::random_subjects(&SCENE_KINDS, &CAMERA_KINDS, 13),
        unchanged_by: &[(Change::FacesSplit, SPLIT_BOUNDS)],
        min_segments: 10,
    },
    InvarianceRow {
        options: &[EXACT_LINES],
        subjects: || subject::hard_subjects(14..15),
        unchanged_by: &[(Change::RIGID_MOTION, EXACT_BOUNDS), (Change::FAR_TRANSLATION, FAR_BOUNDS)],
        min_segments: 40,
    },
    InvarianceRow {
        options: &[EXACT_LINES],
        subjects: subject::box_shells,
        unchanged_by: &[(Change::HiddenObjects { places: 2 }, &[Bound::by_class(1e-9, 1e-6)])],
        min_segments: 4,
    },
    InvarianceRow {
        options: &[SMOOTH_LINES],
        subjects: || subject::rounded(3),
        unchanged_by: &[
            (Change::RIGID_MOTION, SMOOTH_LINE_BOUNDS),
            (Change::scaled(1e-5), SMOOTH_LINE_BOUNDS),
            (Change::scaled(1e7), SMOOTH_LINE_BOUNDS),
            (Change::Renumbered, EQUAL_BYTES),
        ],
        min_segments: 41,
    },
    // Ink with three kinds of contours.
    InvarianceRow {
        options: &INKS,
        subjects: || subject::hard_subjects(13..14),
        unchanged_by: &[
            (Change::RIGID_MOTION, INK_LINE_BOUNDS),
            (Change::turned_and_scaled(1e-3), INK_LINE_BOUNDS),
            (Change::turned_and_scaled(1e4), INK_LINE_BOUNDS),
        ],
        min_segments: 40,
    },
    InvarianceRow {
        options: &INKS,
        subjects: || subject::hard_subjects(11..13),
        unchanged_by: SHUFFLED,
        min_segments: 40,
    },
    InvarianceRow {
        options: &INKS,
        subjects: || subject::next_to_wall(10),
        unchanged_by: &[
            (Change::HiddenObjects { places: 1 }, EQUAL_BYTES),
            (Change::HiddenObjects { places: 2 }, EQUAL_BYTES),
        ],
        min_segments: 40,
    },
    InvarianceRow {
        options: &[INK_MESH, INK, TOON],
        subjects: || subject::random_subjects(&FLAT_SCENE_KINDS, &CAMERA_KINDS, 13),
        unchanged_by: &[(Change::FacesSplit, SPLIT_DRAWING_BOUNDS)],
        min_segments: 40,
    },
    // Fills and hatching.
    InvarianceRow {
        options: &[TOON],
        subjects: || subject::every_second_on_small_page(subject::hard_subjects(13..14)),
        unchanged_by: &[
            (Change::RIGID_MOTION, &[INK_LINE_BOUND, Bound::Areas { share: 1e-3 }]),
            (Change::AllShuffled, EQUAL_BYTES),
        ],
        min_segments: 40,
    },
    InvarianceRow {
        options: &[PEN],
        subjects: || subject::every_second_on_small_page(subject::hard_subjects(13..14)),
        unchanged_by: &[
            (Change::RIGID_MOTION, &[INK_LINE_BOUND, Bound::Strokes { share: 1e-3 }]),
            (Change::AllShuffled, EQUAL_BYTES),
        ],
        min_segments: 40,
    },
    InvarianceRow {
        options: &[TOON],
        subjects: || subject::every_second_on_small_page(subject::next_to_wall(10)),
        unchanged_by: &[(Change::HiddenObjects { places: 2 }, EQUAL_BYTES)],
        min_segments: 40,
    },
    InvarianceRow {
        options: &[PEN],
        subjects: || subject::every_second_on_small_page(subject::next_to_wall(10)),
        // Shadows are recomputed.
        unchanged_by: &[(
            Change::HiddenObjects { places: 2 },
            &[Bound::by_class_and_part(0.01, 0.05), Bound::Strokes { share: 1e-4 }],
        )],
        min_segments: 40,
    },
    // Ownership of the lines where two parts intersect.
    InvarianceRow {
        options: &[TECHNICAL],
        subjects: subject::intersecting_solids,
        unchanged_by: REORDERED,
        min_segments: 40,
    },
    InvarianceRow {
        options: &[TECHNICAL],
        subjects: || vec![subject::equal_cubes()],
        unchanged_by: REORDERED_CUBES,
        min_segments: 40,
    },
    InvarianceRow {
        options: &[TECHNICAL],
        subjects: || subject::examples(&["castle.obj"], 500.0),
        unchanged_by: REORDERED,
        min_segments: 40,
    },
    // Numbering in files.
    InvarianceRow {
        options: &STYLES,
        subjects: || subject::examples(&["bear.ply", "knot.ply", "bracket.stl"], 300.0),
        unchanged_by: SHUFFLED,
        min_segments: 40,
    },
    InvarianceRow {
        options: &[INK, TOON, PENCIL],
        subjects: || subject::examples(&["gear.obj", "castle.obj"], 300.0),
        unchanged_by: SHUFFLED,
        min_segments: 40,
    },
    InvarianceRow {
        options: &[TECHNICAL, COMIC, STIPPLE],
        subjects: || subject::examples(&["pump.glb", "trellis.obj"], 300.0),
        // The order of the parts affects the drawing.
        unchanged_by: RENUMBERED,
        min_segments: 40,
    },
    InvarianceRow {
        options: &STYLES,
        subjects: || vec![Subject::framed("sheets", two_sheets(), 300.0)],
        unchanged_by: SHUFFLED,
        min_segments: 10,
    },
    // Winding of closed surfaces.
    InvarianceRow {
        options: &BUILT_IN,
        subjects: subject::along_faces,
        unchanged_by: REVERSED,
        min_segments: 10,
    },
    InvarianceRow {
        options: &[RIDGES, APPARENT, SUGGESTIVE],
        subjects: subject::rounded_closed,
        unchanged_by: REVERSED,
        min_segments: 10,
    },
    // Open surfaces have no outside and keep the winding of most of their faces. The visible side decides
    // what is a ridge, so lines agree up to rounding. The even saddle z = x² − y² is left out: along its
    // diagonals, the two principal curvatures have equal size. It is also a ruled surface, and along its
    // straight lines the curvature towards the camera is constant. There, rounding decides whether an inner
    // line is drawn.
    InvarianceRow {
        options: &[RIDGES, APPARENT, SUGGESTIVE],
        subjects: subject::open_surfaces,
        unchanged_by: &[
            (Change::FacesReversed(ReversedFaces::All), EXACT_BOUNDS),
            (Change::FacesReversed(ReversedFaces::OfEveryOtherGeometry), EXACT_BOUNDS),
            (Change::FacesReversed(ReversedFaces::Random), EXACT_BOUNDS),
        ],
        min_segments: 10,
    },
    InvarianceRow {
        options: &[EXACT_LINES, INK],
        subjects: || {
            subject::random_subjects(&["boxes", "tori", "tetrahedra", "interpenetrating"], &CAMERA_KINDS, 15)
        },
        unchanged_by: REVERSED,
        min_segments: 10,
    },
    InvarianceRow {
        options: &[INK, TOON, RIDGES],
        subjects: || subject::examples(&["knot.ply", "bracket.stl"], 300.0),
        unchanged_by: REVERSED,
        min_segments: 40,
    },
    // Winding of flat sheets.
    InvarianceRow {
        options: &[TOON, PEN],
        subjects: || vec![subject::upright_sheets()],
        unchanged_by: &[
            (Change::FacesReversed(ReversedFaces::All), EQUAL_BYTES),
            (Change::FacesReversed(ReversedFaces::OfEveryOtherGeometry), EQUAL_BYTES),
        ],
        min_segments: 10,
    },
    // A sheet keeps its winding, so reversed faces start rows of strokes at the other end. The strokes vary
    // differently there, at the same density.
    InvarianceRow {
        options: &[PENCIL_OBJECT],
        subjects: || vec![subject::upright_sheets()],
        unchanged_by: &[
            (Change::FacesReversed(ReversedFaces::All), STROKE_DENSITY_BOUNDS),
            (Change::FacesReversed(ReversedFaces::OfEveryOtherGeometry), STROKE_DENSITY_BOUNDS),
        ],
        min_segments: 10,
    },
    // Threads.
    InvarianceRow {
        options: &[INK, TECHNICAL],
        subjects: || subject::random_subjects(&ALL_SCENE_KINDS, &["perspective"], 21),
        unchanged_by: THREADS,
        min_segments: 40,
    },
    InvarianceRow {
        options: &[TECHNICAL],
        subjects: || {
            let edge = ["edge/self-intersecting.obj", "edge/soup.stl"];
            subject::shared(&[&edge[..], &["organic/suzanne.obj", "scene/Duck.glb"]].concat(), 1000.0)
        },
        unchanged_by: THREADS,
        min_segments: 10,
    },
    InvarianceRow {
        options: &[INK_SMOOTH],
        subjects: || subject::rounded(1),
        unchanged_by: THREADS,
        min_segments: 40,
    },
    InvarianceRow {
        options: &[PENCIL, ENGRAVING, INK_FROM_IMAGE],
        subjects: || vec![subject::ring()],
        unchanged_by: THREADS,
        min_segments: 40,
    },
    InvarianceRow {
        options: &[HAND_DRAWN_INK],
        subjects: || vec![subject::ring_with_box()],
        unchanged_by: THREADS,
        min_segments: 40,
    },
    InvarianceRow {
        options: &[GOOCH],
        subjects: || vec![subject::ring_with_ball()],
        unchanged_by: THREADS,
        min_segments: 40,
    },
];

/// Rows of the long run: shared models with defects and rare features.
///
/// They include open and twisted surfaces, intersecting, duplicate and degenerate faces, textures, vertex
/// colours, wires and instances.
pub(crate) const LONG_ROWS: &[InvarianceRow] = &[
    InvarianceRow {
        options: &STYLES,
        subjects: || {
            let solids = ["edge/nonmanifold.obj", "edge/degenerate.obj", "edge/coplanar.obj"];
            subject::shared(&[&solids[..], &["edge/primitive-modes.gltf"]].concat(), 300.0)
        },
        unchanged_by: RENUMBERED,
        min_segments: 1,
    },
    InvarianceRow {
        options: &[TECHNICAL, COMIC, PEN],
        subjects: || {
            let plain = ["edge/soup.stl", "edge/gpu-instancing.glb", "organic/suzanne.obj"];
            let coloured = ["features/BoxVertexColors.glb", "scene/cakeBirthday.glb"];
            subject::shared(&[&plain[..], &coloured].concat(), 300.0)
        },
        unchanged_by: RENUMBERED,
        min_segments: 1,
    },
    InvarianceRow {
        options: &[TOON],
        subjects: || subject::shared(&["edge/colours-ascii.ply"], 300.0),
        unchanged_by: RENUMBERED,
        min_segments: 1,
    },
    InvarianceRow {
        options: &[INK, SUGGESTIVE],
        subjects: || subject::shared(&["edge/moebius.obj", "edge/self-intersecting.obj"], 300.0),
        unchanged_by: RENUMBERED,
        min_segments: 1,
    },
    InvarianceRow {
        options: &[TOON, PENCIL],
        subjects: || subject::shared(&["scene/CesiumMilkTruck.glb"], 300.0),
        unchanged_by: RENUMBERED,
        min_segments: 1,
    },
];
