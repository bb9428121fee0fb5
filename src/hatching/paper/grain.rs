//! [`grain`] and [`speckle`]: paper tooth, as specks on the paper and as gaps in pencil strokes.
//!
//! The tooth belongs to the paper. Each square of a grid on the page has one speck at a random position, so
//! strokes that cross the same spot are broken by the same specks.

use kurbo::{BezPath, PathEl, Point, Vec2};

use crate::colour::srgb::Colour;
use crate::drawing::{Layer, LayerKind, Length, Mark, Page, Paint, Provenance};
use crate::geometry::numbers::noise::{hash, unit_interval};
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::geometry::plane::polyline_path::add_polygon;

/// Specks on the paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grain {
    /// Number of specks in a square of 100 px. Default: 24.
    pub density: f64,
    /// How much darker than the paper the darkest specks are, 0 to 1. Default: 0.5.
    pub contrast: f64,
    /// Random seed of the sheet.
    pub seed: u64,
}

impl Default for Grain {
    fn default() -> Self {
        Self { density: 24.0, contrast: 0.5, seed: 0 }
    }
}

/// The layer of specks on a page. It has one mark for each of three tints, one of them lighter than the paper
/// unless the paper is white. `None` if there are no specks.
#[must_use]
pub(crate) fn grain(page: &Page, options: &Grain) -> Option<Layer> {
    let paths = specks(page, options)?;
    let paper = page.background.unwrap_or(Colour::WHITE);
    let [dark, darker] = [0.5, 1.0].map(|part| paper.darker(1.0 - options.contrast * part));
    let light = if paper == Colour::WHITE { dark } else { paper.mix(Colour::WHITE, options.contrast) };
    let mark = |(path, colour)| Mark {
        path,
        paint: Paint::Fill(colour),
        provenance: Provenance { classes: vec!["grain"], ..Provenance::default() },
    };
    let marks = paths.into_iter().zip([light, dark, darker]).filter(|(path, _)| !path.elements().is_empty());
    Some(Layer { kind: LayerKind::Paper, pen: None, ordered: false, marks: marks.map(mark).collect() })
}

/// Specks scattered over a page, split at random into three groups. `None` if there are none.
pub(crate) fn specks(page: &Page, options: &Grain) -> Option<[BezPath; 3]> {
    let px = Length::px(1.0).in_unit(page.unit);
    let area = page.width * page.height / (px * px);
    let count = (area * options.density / 1e4).min(MAX_SPECKS);
    if count.is_nan() || count < 1.0 {
        return None;
    }
    let side = (area / count).sqrt() * px;
    let [columns, rows] = [page.width, page.height].map(|length| (length / side).ceil() as i64);
    let mut paths = [(); 3].map(|()| BezPath::new());
    for row in 0..rows {
        for k in 0..columns {
            // Rows alternate in direction, so that consecutive specks are close.
            let column = if row % 2 == 0 { k } else { columns - 1 - k };
            let chance = SquareNoise::new(options.seed, column, row);
            let corner = Vec2::new(column as f64, row as f64);
            let at = Point::ORIGIN + (corner + Vec2::new(chance.of(0), chance.of(1))) * side;
            if at.x < page.width && at.y < page.height {
                let size = (MIN_SPECK_PX + (MAX_SPECK_PX - MIN_SPECK_PX) * chance.of(2)) * px;
                let corners = 3 + (chance.of(4) * 4.0) as u64;
                speck(&mut paths[(chance.of(3) * 3.0) as usize % 3], at, size / 2.0, corners, &chance);
            }
        }
    }
    Some(paths)
}

/// Greatest number of specks on a page. Denser grain is thinned to it.
const MAX_SPECKS: f64 = 8000.0;

/// Range of speck widths.
const MIN_SPECK_PX: f64 = 0.4;
const MAX_SPECK_PX: f64 = 1.8;

/// Gaps in pencil strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tooth {
    /// Share of the stroke area that is left out, 0 to about 0.3.
    pub amount: f64,
    /// Random seed of the sheet.
    pub seed: u64,
    /// The length of a px in user units.
    pub px: f64,
}

/// Specks along strokes, given by their centre lines and widths. Fill them with the paper's colour over the
/// strokes.
#[must_use]
pub(crate) fn speckle(strokes: &[(BezPath, f64)], tooth: &Tooth) -> BezPath {
    let side = TOOTH_SQUARE_PX * tooth.px;
    let mut path = BezPath::new();
    if side.is_nan() || side <= 0.0 || tooth.amount <= 0.0 {
        return path;
    }
    // Larger amounts use wider specks.
    let mean = SPECK_WIDTH_OF_SQUARE + SPECK_WIDTH_PER_AMOUNT * tooth.amount;
    let speck_density = tooth.amount / (SPECK_AREA_OF_WIDTH_SQUARED * mean * mean);
    let mut squares: Vec<[i64; 2]> = Vec::new();
    for (stroke, width) in strokes {
        let reach = width / 2.0;
        along(stroke, side / 2.0, |at| {
            let [low, high] = [-reach, reach].map(|by| (at.to_vec2() + Vec2::new(by, by)) / side);
            for row in low.y.floor() as i64..=high.y.floor() as i64 {
                for column in low.x.floor() as i64..=high.x.floor() as i64 {
                    let chance = SquareNoise::new(tooth.seed, column, row);
                    let is_wanted = chance.of(0) < speck_density * chance.rough(tooth.seed);
                    if is_wanted && (chance.place(side) - at).hypot2() <= reach * reach {
                        squares.push([row, column]);
                    }
                }
            }
        });
    }
    squares.sort_unstable();
    squares.dedup();
    for [row, column] in squares {
        let chance = SquareNoise::new(tooth.seed, column, row);
        let size = mean * side * (0.75 + 0.5 * chance.of(2));
        speck(&mut path, chance.place(side), size / 2.0, 3 + (chance.of(5) * 2.0) as u64, &chance);
    }
    path
}

/// The side of the squares that hold one speck each.
const TOOTH_SQUARE_PX: f64 = 1.5;

/// Mean speck width as a share of its square, and its increase per unit of amount.
const SPECK_WIDTH_OF_SQUARE: f64 = 0.8;
const SPECK_WIDTH_PER_AMOUNT: f64 = 0.6;

/// Mean visible area of a speck as a share of its width squared, without the area outside the stroke.
/// Measured value.
const SPECK_AREA_OF_WIDTH_SQUARED: f64 = 0.27;

/// Calls `call` for points along a path, at most `step` apart.
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

/// Random numbers of one square of the grid.
struct SquareNoise {
    column: i64,
    row: i64,
    seed: u64,
}

impl SquareNoise {
    fn new(seed: u64, column: i64, row: i64) -> Self {
        Self { column, row, seed: hash(seed, &[column, row].map(i64::cast_unsigned)) }
    }

    /// A random number from 0 to 1, different for each word.
    fn of(&self, word: u64) -> f64 {
        unit_interval(hash(self.seed, &[word]))
    }

    /// Position of the square's speck.
    fn place(&self, side: f64) -> Point {
        Point::new((self.column as f64 + self.of(3)) * side, (self.row as f64 + self.of(4)) * side)
    }

    /// Local roughness of the paper: 0 to 2, 1 on average.
    fn rough(&self, seed: u64) -> f64 {
        let patch = [self.column, self.row].map(|k| k.div_euclid(ROUGHNESS_PATCH_SQUARES).cast_unsigned());
        2.0 * unit_interval(hash(seed, &[patch[0], patch[1], 1]))
    }
}

/// Side of a patch of equal roughness, squares.
const ROUGHNESS_PATCH_SQUARES: i64 = 3;

/// Adds a polygon, stretched and turned at random.
fn speck(path: &mut BezPath, at: Point, radius: f64, corners: u64, chance: &SquareNoise) {
    let turn = std::f64::consts::TAU * chance.of(6);
    let (along, flat) = (Vec2::new(cos(turn), sin(turn)), 0.5 + 0.5 * chance.of(7));
    let corner = |k: u64| {
        let angle = std::f64::consts::TAU * (k as f64 + 0.6 * chance.of(8 + k)) / corners as f64;
        let (x, y) = (radius * cos(angle), radius * flat * sin(angle));
        at + Vec2::new(along.x * x - along.y * y, along.y * x + along.x * y)
    };
    add_polygon(path, (0..corners).map(corner));
}

#[cfg(test)]
mod tests {
    use kurbo::Shape;

    use super::*;
    use crate::drawing::Unit;

    const PAGE: Page = Page { width: 600.0, height: 400.0, unit: Unit::Px, background: None };

    fn specks(path: &BezPath) -> Vec<BezPath> {
        let ends = path.elements().split_inclusive(|element| matches!(element, PathEl::ClosePath));
        ends.map(|speck| speck.iter().copied().collect()).collect()
    }

    #[test]
    fn grain_has_the_wanted_number_and_size_of_specks() {
        let layer = grain(&PAGE, &Grain::default()).expect("specks");
        assert_eq!(layer.marks.len(), 3);
        let all: Vec<BezPath> = layer.marks.iter().flat_map(|mark| specks(&mark.path)).collect();
        assert!((all.len() as f64 - 24.0 * 24.0).abs() < 20.0, "{}", all.len());
        for speck in &all {
            let around = speck.bounding_box();
            assert!(around.width() <= MAX_SPECK_PX && around.height() <= MAX_SPECK_PX);
            assert!((4..=7).contains(&speck.elements().len()));
        }
        assert_eq!(grain(&PAGE, &Grain { density: 0.0, ..Grain::default() }), None);
    }

    #[test]
    fn grain_is_the_same_in_px_and_mm() {
        let scale = 25.4 / 96.0;
        let page = Page { width: 600.0 * scale, height: 400.0 * scale, unit: Unit::Mm, background: None };
        let [px, mm] = [PAGE, page].map(|page| grain(&page, &Grain::default()).expect("specks"));
        for (px, mm) in px.marks.iter().zip(&mm.marks) {
            let [px, mm] = [px, mm].map(|mark| mark.path.bounding_box());
            assert!((px.x1 * scale - mm.x1).abs() < 1e-6 && (px.y0 * scale - mm.y0).abs() < 1e-6);
        }
    }

    #[test]
    fn speckle_removes_the_wanted_share_of_ink() {
        let mut stroke = BezPath::new();
        stroke.move_to((10.0, 10.0));
        stroke.curve_to((300.0, 40.0), (500.0, 250.0), (560.0, 390.0));
        let ink = stroke.perimeter(0.01) * 4.0;
        for amount in [0.05, 0.1, 0.2] {
            let tooth = Tooth { amount, seed: 3, px: 1.0 };
            let path = speckle(&[(stroke.clone(), 4.0)], &tooth);
            let lost = specks(&path).iter().map(|speck| speck.area().abs()).sum::<f64>() / ink;
            assert!((0.6..1.5).contains(&(lost / amount)), "{amount}: {lost}");
            // Drawing the same stroke twice gives the same holes.
            assert_eq!(speckle(&[(stroke.clone(), 4.0), (stroke.clone(), 4.0)], &tooth), path);
        }
        assert!(speckle(&[(stroke, 4.0)], &Tooth { amount: 0.0, seed: 3, px: 1.0 }).elements().is_empty());
    }
}
