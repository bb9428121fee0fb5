//! Labels of details, and titles of views.

use kurbo::{Point, Rect, Vec2};

use crate::error::Error;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::page::sheet::canvas::annotation_board::AnnotationBoard;
use crate::page::sheet::canvas::paper_occupancy::{Clearance, ConvexShape, OccupantKind};
use crate::page::sheet::canvas::sheet_canvas::THIN_LINE_MM;
use crate::page::tolerances::MAX_CIRCLE_ERROR_MM;

/// Letter height, mm.
const LETTER_HEIGHT_MM: f64 = 5.0;

/// First length of a leader, step size of the length, mm, and maximum number of steps.
const FIRST_LEADER_LENGTH_MM: f64 = 4.0;
const LEADER_STEP_MM: f64 = 2.0;
const MAX_LEADER_STEPS: u32 = 60;

/// Number of leader directions, from the upper right to both sides.
const LEADER_DIRECTIONS: u32 = 48;

/// Distance from a view to its title, and how far the title moves up at most, mm.
const TITLE_GAP_MM: f64 = 3.0;
const MAX_TITLE_SHIFT_MM: u32 = 400;

/// Draws the circle around a detail.
pub(crate) fn draw_circle(centre: Point, radius: f64, board: &mut AnnotationBoard) {
    let circle = kurbo::Circle::new(centre, radius);
    board.take_path(&kurbo::Shape::to_path(&circle, MAX_CIRCLE_ERROR_MM), THIN_LINE_MM, OccupantKind::Line);
    board.ink.circle(centre, radius, THIN_LINE_MM);
}

/// Writes the letter of a detail, with a leader to its circle.
pub(crate) fn draw_detail_label(
    label: &str,
    centre: Point,
    radius: f64,
    board: &mut AnnotationBoard,
) -> Result<(), Error> {
    let word = board.word(label, LETTER_HEIGHT_MM)?;
    for clear in [Clearance::Leaders, Clearance::Texts] {
        for step in 0..MAX_LEADER_STEPS {
            for k in 0..LEADER_DIRECTIONS {
                let aside = if k % 2 == 0 { -f64::from(k / 2) } else { f64::from(k.div_ceil(2)) };
                let turn = std::f64::consts::TAU * (0.125 + aside / f64::from(LEADER_DIRECTIONS));
                let out = Vec2::new(cos(turn), -sin(turn));
                let from = centre + out * radius;
                let to = from + out * (FIRST_LEADER_LENGTH_MM + LEADER_STEP_MM * f64::from(step));
                // The letter stands past the end of the leader.
                let half = word.bounds.size().to_vec2() / 2.0;
                let clearance = 0.8 + (out.x * half.x).abs() + (out.y * half.y).abs();
                let place = word.centred(to + out * clearance);
                let is_free = board.is_free(&word, place)
                    && board
                        .taken
                        .is_free(&ConvexShape::line(from + out * 0.5, to, THIN_LINE_MM).wider(0.3), clear);
                if is_free {
                    board.line(from, to, THIN_LINE_MM, OccupantKind::Leader);
                    board.write(&word, place);
                    return Ok(());
                }
            }
        }
    }
    board.unplaced.push(format!("the letter of the detail `{label}`"));
    Ok(())
}

/// Writes the title of a view above it.
pub(crate) fn draw_title(words: &str, rect: Rect, board: &mut AnnotationBoard) -> Result<(), Error> {
    let word = board.word(words, LETTER_HEIGHT_MM)?;
    let half = word.bounds.height() / 2.0;
    let middle = |k: u32| Point::new(rect.center().x, rect.y0 - TITLE_GAP_MM - half - f64::from(k));
    let place =
        (0..MAX_TITLE_SHIFT_MM).map(|k| word.centred(middle(k))).find(|place| board.is_free(&word, *place));
    match place {
        Some(place) => board.write(&word, place),
        None => board.unplaced.push(format!("the title `{words}`")),
    }
    Ok(())
}
