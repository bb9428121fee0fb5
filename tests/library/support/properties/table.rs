//! The table of properties: each row lists ways to draw, subjects, changes, and bounds on the difference.

use super::Row;
use super::bound::Bound;
use super::change::{Change, Turned};
use super::option_set::*;
use super::sheets::sheets;
use super::subject::{self, Subject};
use crate::support::scenes::random_scenes::SCENES;

/// Kinds of random scenes that the rows use.
pub const KINDS: [&str; 5] = ["boxes", "tori", "soup", "interpenetrating", "mixture"];
/// Kinds of random scenes with flat faces only.
const FLAT_KINDS: [&str; 3] = ["boxes", "tetrahedra", "soup"];
/// Kinds of random cameras that the rows use.
pub const CAMERAS: [&str; 3] = ["perspective", "orthographic", "cutting"];

/// Ink with mesh contours, with the default contours, and with smooth contours.
const INKS: [OptionSet; 3] = [INK_MESH, INK, INK_SMOOTH];
const STYLES: [OptionSet; 10] =
    [INK, IMAGE, TECHNICAL, TOON, COMIC, PENCIL, PEN, SUGGESTIVE, ENGRAVING, STIPPLE];

type Changes = &'static [(Change, &'static [Bound])];

const BYTES: &[Bound] = &[Bound::Bytes];
/// Compared with a drawing on two threads.
const THREADS: Changes = &[(Change::Threads(1), BYTES), (Change::Threads(4), BYTES)];
const RENUMBERED: Changes = &[(Change::Renumbered, BYTES)];
const SHUFFLED: Changes = &[(Change::AllShuffled, BYTES)];

const WOUND: Changes = &[
    (Change::FacesTurned(Turned::All), BYTES),
    (Change::FacesTurned(Turned::OfEveryOtherShape), BYTES),
    (Change::FacesTurned(Turned::Some), BYTES),
];

const EXACTLY: &[Bound] = &[Bound::by_class(1e-6, 0.02)];
/// At 1e6, coordinates are exact to about 1e-10 world units, and a unit covers some hundred px.
const FAR_AWAY: &[Bound] = &[Bound::by_class(1e-5, 0.05)];
/// The new vertices lie in their planes up to rounding.
const CUT: &[Bound] = &[Bound::by_class(1e-6, 0.05)];
const CUT_AND_DRAWN: &[Bound] = &[Bound::by_class_and_part(1e-5, 0.01)];

/// Smooth lines may lie 0.1 px apart, because rounding may decide whether an edge is split.
///
/// An edge is split if its arc is higher than 0.08 px, and a symmetrical solid has many edges at that limit.
/// 30 px of some 3,000 px may differ: on an open surface seen edge-on, rounding may decide whether a ripple
/// of the mesh is drawn.
const SMOOTHLY: &[Bound] = &[Bound::by_class(0.1, 30.0)];

/// Stroke length per part agrees except for random stroke ends. Measured: 0.0024 of the total.
///
/// If one of four parts had no strokes, 0.25 would be missing.
const AS_DENSE: &[Bound] = &[Bound::Strokes { share: 0.01 }];

/// Rounding may decide where a chain begins and where an arc is split, but not what is visible.
///
/// The end of a line may run 3 px too far. Lines are compared by class only: if parts of equal size
/// intersect, their positions decide which part owns the line.
const INKED_LINES: Bound = Bound::by_class_but_for(0.5, 3.0, 0.003);
const INKED: &[Bound] = &[INKED_LINES];

/// New orders of the parts, each with the bounds to test.
const fn reordered(owned: &'static [Bound]) -> [(Change, &'static [Bound]); 4] {
    [
        (Change::PartsShuffled { seed: 47 }, owned),
        (Change::PartsShuffled { seed: 48 }, owned),
        (Change::PartsShuffled { seed: 49 }, owned),
        (Change::PartsReversed, owned),
    ]
}
const OWNED: Changes = &reordered(&[Bound::Bytes, Bound::Owners { least: 3 }]);
const CUBES_OWNED: Changes = &reordered(&[Bound::Bytes, Bound::Owners { least: 2 }]);

/// Rows of the default run.
pub const ROWS: &[Row] = &[
    // Bare lines of the view map.
    Row {
        options: &[EXACT],
        subjects: || subject::random(&KINDS, &CAMERAS, 11),
        unchanged_by: &[
            (Change::RIGID, EXACTLY),
            (Change::size(1e-6), EXACTLY),
            (Change::size(1e9), EXACTLY),
            (Change::FAR, FAR_AWAY),
        ],
        least: 10,
    },
    Row {
        options: &[EXACT],
        subjects: || subject::random(&KINDS, &CAMERAS, 12),
        unchanged_by: &[(Change::Renumbered, BYTES), (Change::AllShuffled, &[Bound::by_class(1e-9, 0.02)])],
        least: 10,
    },
    Row {
        options: &[EXACT],
        subjects: || subject::random(&KINDS, &CAMERAS, 13),
        unchanged_by: &[(Change::FacesSplit, CUT)],
        least: 10,
    },
    Row {
        options: &[EXACT],
        subjects: || subject::hard(14..15),
        unchanged_by: &[(Change::RIGID, EXACTLY), (Change::FAR, FAR_AWAY)],
        least: 40,
    },
    Row {
        options: &[EXACT],
        subjects: subject::shells,
        unchanged_by: &[(Change::HiddenThings { places: 2 }, &[Bound::by_class(1e-9, 1e-6)])],
        least: 4,
    },
    Row {
        options: &[SMOOTH_LINES],
        subjects: || subject::round(3),
        unchanged_by: &[
            (Change::RIGID, SMOOTHLY),
            (Change::size(1e-5), SMOOTHLY),
            (Change::size(1e7), SMOOTHLY),
            (Change::Renumbered, BYTES),
        ],
        least: 41,
    },
    // Ink with three kinds of contours.
    Row {
        options: &INKS,
        subjects: || subject::hard(13..14),
        unchanged_by: &[
            (Change::RIGID, INKED),
            (Change::turned_size(1e-3), INKED),
            (Change::turned_size(1e4), INKED),
        ],
        least: 40,
    },
    Row { options: &INKS, subjects: || subject::hard(11..13), unchanged_by: SHUFFLED, least: 40 },
    Row {
        options: &INKS,
        subjects: || subject::beside_a_wall(10),
        unchanged_by: &[
            (Change::HiddenThings { places: 1 }, BYTES),
            (Change::HiddenThings { places: 2 }, BYTES),
        ],
        least: 40,
    },
    Row {
        options: &[INK_MESH, INK, TOON],
        subjects: || subject::random(&FLAT_KINDS, &CAMERAS, 13),
        unchanged_by: &[(Change::FacesSplit, CUT_AND_DRAWN)],
        least: 40,
    },
    // Fills and hatching.
    Row {
        options: &[TOON],
        subjects: || subject::few_in_small(subject::hard(13..14)),
        unchanged_by: &[
            (Change::RIGID, &[INKED_LINES, Bound::Areas { share: 1e-3 }]),
            (Change::AllShuffled, BYTES),
        ],
        least: 40,
    },
    Row {
        options: &[PEN],
        subjects: || subject::few_in_small(subject::hard(13..14)),
        unchanged_by: &[
            (Change::RIGID, &[INKED_LINES, Bound::Strokes { share: 1e-3 }]),
            (Change::AllShuffled, BYTES),
        ],
        least: 40,
    },
    Row {
        options: &[TOON],
        subjects: || subject::few_in_small(subject::beside_a_wall(10)),
        unchanged_by: &[(Change::HiddenThings { places: 2 }, BYTES)],
        least: 40,
    },
    Row {
        options: &[PEN],
        subjects: || subject::few_in_small(subject::beside_a_wall(10)),
        // Shadows are recomputed.
        unchanged_by: &[(
            Change::HiddenThings { places: 2 },
            &[Bound::by_class_and_part(0.01, 0.05), Bound::Strokes { share: 1e-4 }],
        )],
        least: 40,
    },
    // Ownership of the lines where two parts intersect.
    Row { options: &[TECHNICAL], subjects: subject::through_each_other, unchanged_by: OWNED, least: 40 },
    Row {
        options: &[TECHNICAL],
        subjects: || vec![subject::equal_cubes()],
        unchanged_by: CUBES_OWNED,
        least: 40,
    },
    Row {
        options: &[TECHNICAL],
        subjects: || subject::examples(&["castle.obj"], 500.0),
        unchanged_by: OWNED,
        least: 40,
    },
    // Numbering in files.
    Row {
        options: &STYLES,
        subjects: || subject::examples(&["bear.ply", "knot.ply", "bracket.stl"], 300.0),
        unchanged_by: SHUFFLED,
        least: 40,
    },
    Row {
        options: &[INK, TOON, PENCIL],
        subjects: || subject::examples(&["gear.obj", "castle.obj"], 300.0),
        unchanged_by: SHUFFLED,
        least: 40,
    },
    Row {
        options: &[TECHNICAL, COMIC, STIPPLE],
        subjects: || subject::examples(&["pump.glb", "trellis.obj"], 300.0),
        // The order of the parts affects the drawing.
        unchanged_by: RENUMBERED,
        least: 40,
    },
    Row {
        options: &STYLES,
        subjects: || vec![Subject::framed("sheets", sheets(), 300.0)],
        unchanged_by: SHUFFLED,
        least: 10,
    },
    // Winding of closed surfaces.
    Row { options: &BUILT_IN, subjects: subject::along_faces, unchanged_by: WOUND, least: 10 },
    Row {
        options: &[RIDGES, APPARENT, SUGGESTIVE],
        subjects: subject::round_closed,
        unchanged_by: WOUND,
        least: 10,
    },
    // Open surfaces have no outside and keep the winding of most of their faces. The visible side decides
    // what is a ridge, so lines agree up to rounding. The even saddle z = x² − y² is left out: along its
    // diagonals, the two principal curvatures have equal size. It is also a ruled surface, and along its
    // straight lines the curvature towards the camera is constant. There, rounding decides whether an inner
    // line is drawn.
    Row {
        options: &[RIDGES, APPARENT, SUGGESTIVE],
        subjects: subject::round_open,
        unchanged_by: &[
            (Change::FacesTurned(Turned::All), EXACTLY),
            (Change::FacesTurned(Turned::OfEveryOtherShape), EXACTLY),
            (Change::FacesTurned(Turned::Some), EXACTLY),
        ],
        least: 10,
    },
    Row {
        options: &[EXACT, INK],
        subjects: || subject::random(&["boxes", "tori", "tetrahedra", "interpenetrating"], &CAMERAS, 15),
        unchanged_by: WOUND,
        least: 10,
    },
    Row {
        options: &[INK, TOON, RIDGES],
        subjects: || subject::examples(&["knot.ply", "bracket.stl"], 300.0),
        unchanged_by: WOUND,
        least: 40,
    },
    // Winding of flat sheets.
    Row {
        options: &[TOON, PEN],
        subjects: || vec![subject::upright_sheets()],
        unchanged_by: &[
            (Change::FacesTurned(Turned::All), BYTES),
            (Change::FacesTurned(Turned::OfEveryOtherShape), BYTES),
        ],
        least: 10,
    },
    // A sheet keeps its winding, so reversed faces start rows of strokes at the other end. The strokes vary
    // differently there, at the same density.
    Row {
        options: &[PENCIL_OBJECT],
        subjects: || vec![subject::upright_sheets()],
        unchanged_by: &[
            (Change::FacesTurned(Turned::All), AS_DENSE),
            (Change::FacesTurned(Turned::OfEveryOtherShape), AS_DENSE),
        ],
        least: 10,
    },
    // Threads.
    Row {
        options: &[INK, TECHNICAL],
        subjects: || subject::random(&SCENES, &["perspective"], 21),
        unchanged_by: THREADS,
        least: 40,
    },
    Row {
        options: &[TECHNICAL],
        subjects: || {
            let edge = ["edge/self-intersecting.obj", "edge/soup.stl"];
            subject::shared(&[&edge[..], &["organic/suzanne.obj", "scene/Duck.glb"]].concat(), 1000.0)
        },
        unchanged_by: THREADS,
        least: 10,
    },
    Row { options: &[INK_SMOOTH], subjects: || subject::round(1), unchanged_by: THREADS, least: 40 },
    Row {
        options: &[PENCIL, ENGRAVING, IMAGE],
        subjects: || vec![subject::ring()],
        unchanged_by: THREADS,
        least: 40,
    },
    Row { options: &[HAND], subjects: || vec![subject::ring_with_box()], unchanged_by: THREADS, least: 40 },
    Row { options: &[GOOCH], subjects: || vec![subject::ring_with_ball()], unchanged_by: THREADS, least: 40 },
];

/// Rows of the long run: shared models with defects and rare features.
///
/// They include open and twisted surfaces, intersecting, duplicate and degenerate faces, textures, vertex
/// colours, wires and instances.
pub const LONG_ROWS: &[Row] = &[
    Row {
        options: &STYLES,
        subjects: || {
            let solids = ["edge/nonmanifold.obj", "edge/degenerate.obj", "edge/coplanar.obj"];
            subject::shared(&[&solids[..], &["edge/primitive-modes.gltf"]].concat(), 300.0)
        },
        unchanged_by: RENUMBERED,
        least: 1,
    },
    Row {
        options: &[TECHNICAL, COMIC, PEN],
        subjects: || {
            let plain = ["edge/soup.stl", "edge/gpu-instancing.glb", "organic/suzanne.obj"];
            let coloured = ["features/BoxVertexColors.glb", "scene/cakeBirthday.glb"];
            subject::shared(&[&plain[..], &coloured].concat(), 300.0)
        },
        unchanged_by: RENUMBERED,
        least: 1,
    },
    Row {
        options: &[TOON],
        subjects: || subject::shared(&["edge/colours-ascii.ply"], 300.0),
        unchanged_by: RENUMBERED,
        least: 1,
    },
    Row {
        options: &[INK, SUGGESTIVE],
        subjects: || subject::shared(&["edge/moebius.obj", "edge/self-intersecting.obj"], 300.0),
        unchanged_by: RENUMBERED,
        least: 1,
    },
    Row {
        options: &[TOON, PENCIL],
        subjects: || subject::shared(&["scene/CesiumMilkTruck.glb"], 300.0),
        unchanged_by: RENUMBERED,
        least: 1,
    },
];
