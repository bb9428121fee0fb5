//! [`grain`] and [`speckle`]: the paper's tooth, as specks on the paper and as gaps in pencil strokes.
//!
//! The tooth belongs to the paper: one speck in each square of a grid that lies on the page, where chance
//! wants it. Strokes that cross the same place are broken by the same specks.

use kurbo::{BezPath, PathEl, Point, Vec2};

use crate::drawing::{Layer, LayerKind, Length, Mark, Page, Paint, Provenance};
use crate::math::colour::Colour;
use crate::math::function::{cos, sin};
use crate::math::noise::{hash, unit};

/// Specks on the paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grain {
    /// How many in a square of 100 px. Default: 24.
    pub density: f64,
    /// How much darker than the paper the darkest are, 0 to 1. Default: 0.2.
    pub contrast: f64,
    /// The sheet of paper.
    pub seed: u64,
}

impl Default for Grain {
    fn default() -> Self {
        Self { density: 24.0, contrast: 0.2, seed: 0 }
    }
}

/// The layer of specks on a page: a mark for each of three tints, one of them lighter than the paper unless
/// that is white. None if there are none.
#[must_use]
pub fn grain(page: &Page, options: &Grain) -> Option<Layer> {
    let px = Length::px(1.0).in_unit(page.unit);
    let area = page.width * page.height / (px * px);
    let count = (area * options.density / 1e4).min(MOST_SPECKS);
    if count.is_nan() || count < 1.0 {
        return None;
    }
    let side = (area / count).sqrt() * px;
    let [columns, rows] = [page.width, page.height].map(|length| (length / side).ceil() as i64);
    let mut paths = [(); 3].map(|()| BezPath::new());
    for row in 0..rows {
        for k in 0..columns {
            // To and fro, so that what follows each other is near.
            let column = if row % 2 == 0 { k } else { columns - 1 - k };
            let chance = Chance::new(options.seed, column, row);
            let corner = Vec2::new(column as f64, row as f64);
            let at = Point::ORIGIN + (corner + Vec2::new(chance.of(0), chance.of(1))) * side;
            if at.x < page.width && at.y < page.height {
                let size = (SMALLEST_PX + (LARGEST_PX - SMALLEST_PX) * chance.of(2)) * px;
                let corners = 3 + (chance.of(4) * 4.0) as u64;
                speck(&mut paths[(chance.of(3) * 3.0) as usize % 3], at, size / 2.0, corners, &chance);
            }
        }
    }
    let paper = page.background.unwrap_or(Colour::WHITE);
    let [dark, darker] = [0.5, 1.0].map(|part| paper.darker(1.0 - options.contrast * part));
    let light = if paper == Colour::WHITE { dark } else { paper.mix(Colour::WHITE, options.contrast) };
    let mark = |(path, colour)| Mark {
        path,
        paint: Paint::Fill(colour),
        provenance: Provenance { classes: vec!["grain"], ..Provenance::default() },
    };
    let marks = paths.into_iter().zip([light, dark, darker]).filter(|(path, _)| !path.elements().is_empty());
    Some(Layer { kind: LayerKind::Paper, pen: None, marks: marks.map(mark).collect() })
}

/// Pages with more specks than this are drawn with this many.
const MOST_SPECKS: f64 = 4000.0;

/// How wide specks are.
const SMALLEST_PX: f64 = 0.3;
const LARGEST_PX: f64 = 1.2;

/// Gaps in pencil strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tooth {
    /// The part of the strokes' area that is left out, 0 to about 0.3.
    pub amount: f64,
    /// The sheet of paper.
    pub seed: u64,
    /// The length of a px in user units.
    pub px: f64,
}

/// Specks along strokes, given by their middle lines and widths, to be filled with the colour of the paper
/// over them.
#[must_use]
pub fn speckle(strokes: &[(BezPath, f64)], tooth: &Tooth) -> BezPath {
    let side = TOOTH_PX * tooth.px;
    let mut path = BezPath::new();
    if side.is_nan() || side <= 0.0 || tooth.amount <= 0.0 {
        return path;
    }
    // Where much is left out, specks are wider.
    let mean = NARROW_OF_SQUARE + WIDER * tooth.amount;
    let wanted = tooth.amount / (SPECK_OF_WIDTH * mean * mean);
    let mut places: Vec<[i64; 2]> = Vec::new();
    for (stroke, width) in strokes {
        let reach = width / 2.0;
        along(stroke, side / 2.0, |at| {
            let [low, high] = [-reach, reach].map(|by| (at.to_vec2() + Vec2::new(by, by)) / side);
            for row in low.y.floor() as i64..=high.y.floor() as i64 {
                for column in low.x.floor() as i64..=high.x.floor() as i64 {
                    let chance = Chance::new(tooth.seed, column, row);
                    let is_wanted = chance.of(0) < wanted * chance.rough(tooth.seed);
                    if is_wanted && (chance.place(side) - at).hypot2() <= reach * reach {
                        places.push([row, column]);
                    }
                }
            }
        });
    }
    places.sort_unstable();
    places.dedup();
    for [row, column] in places {
        let chance = Chance::new(tooth.seed, column, row);
        let size = mean * side * (0.75 + 0.5 * chance.of(2));
        speck(&mut path, chance.place(side), size / 2.0, 3 + (chance.of(5) * 2.0) as u64, &chance);
    }
    path
}

/// The side of the squares with one hole of the tooth each.
const TOOTH_PX: f64 = 1.5;

/// The mean width of specks, as a part of their squares, and how it grows with what is left out.
const NARROW_OF_SQUARE: f64 = 0.8;
const WIDER: f64 = 0.6;

/// The mean area of a speck, as a part of the square of its width, with what lies beside the stroke taken
/// off: measured.
const SPECK_OF_WIDTH: f64 = 0.27;

/// Calls for points along a path, no farther apart than `step`.
fn along(path: &BezPath, step: f64, mut call: impl FnMut(Point)) {
    let (mut start, mut at) = (Point::ORIGIN, Point::ORIGIN);
    kurbo::flatten(path, step / 4.0, |element| {
        let to = match element {
            PathEl::MoveTo(p) => {
                (start, at) = (p, p);
                return;
            }
            PathEl::ClosePath => start,
            element => element.end_point().unwrap_or(at),
        };
        let way = to - at;
        let count = (way.hypot2().sqrt() / step).ceil().max(1.0);
        for k in 0..=count as u64 {
            call(at + way * (k as f64 / count));
        }
        at = to;
    });
}

/// What chance says of a square of the grid.
struct Chance {
    column: i64,
    row: i64,
    seed: u64,
}

impl Chance {
    fn new(seed: u64, column: i64, row: i64) -> Self {
        Self { column, row, seed: hash(seed, &[column, row].map(i64::cast_unsigned)) }
    }

    /// A number from 0 to 1, another one for each word.
    fn of(&self, word: u64) -> f64 {
        unit(hash(self.seed, &[word]))
    }

    /// Where the speck of the square lies.
    fn place(&self, side: f64) -> Point {
        Point::new((self.column as f64 + self.of(3)) * side, (self.row as f64 + self.of(4)) * side)
    }

    /// How rough the paper is around: 0 to 2, 1 on average.
    fn rough(&self, seed: u64) -> f64 {
        let patch = [self.column, self.row].map(|k| k.div_euclid(PATCH).cast_unsigned());
        2.0 * unit(hash(seed, &[patch[0], patch[1], 1]))
    }
}

/// Roughness changes from patch to patch of this many squares.
const PATCH: i64 = 3;

/// Adds a polygon, stretched and turned by chance.
fn speck(path: &mut BezPath, at: Point, radius: f64, corners: u64, chance: &Chance) {
    let turn = std::f64::consts::TAU * chance.of(6);
    let (along, flat) = (Vec2::new(cos(turn), sin(turn)), 0.5 + 0.5 * chance.of(7));
    for k in 0..corners {
        let angle = std::f64::consts::TAU * (k as f64 + 0.6 * chance.of(8 + k)) / corners as f64;
        let (x, y) = (radius * cos(angle), radius * flat * sin(angle));
        let corner = at + Vec2::new(along.x * x - along.y * y, along.y * x + along.x * y);
        if k == 0 { path.move_to(corner) } else { path.line_to(corner) }
    }
    path.close_path();
}
