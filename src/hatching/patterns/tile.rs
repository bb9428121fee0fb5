//! [`Tile`]: the lines and filled shapes that a pattern repeats.

use kurbo::{BezPath, Point, Shape};

use crate::colour::darkness_map::{DarknessMap, OutlineTracing};
use crate::colour::pixel_picture::Picture;
use crate::geometry::plane::polyline_path::polygon;
use crate::hatching::clip::polygon_clip::{WindingRule, unite_shapes};
use crate::hatching::tolerances;

/// Tile of a pattern. Its width is 1; y points down.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Tile {
    /// Lines drawn with the pattern's width.
    pub lines: Vec<Vec<Point>>,
    /// Filled shapes. Each is an island and its holes. All islands have one orientation, and holes the other.
    pub shapes: Vec<Vec<Vec<Point>>>,
    /// Height of the tile.
    pub height: f64,
}

/// Side of the square for the path data of a tile.
const PATH_SQUARE_SIDE: f64 = 10.0;

/// Flattening tolerance of lines and of filled shapes as a share of the side. Shapes are larger and need a
/// finer one.
const LINE_FLATNESS_OF_SIDE: f64 = 0.002;
const SHAPE_FLATNESS_OF_SIDE: f64 = 0.0005;

/// Greatest number of points in all lines and shapes of a tile.
const MAX_POINTS: usize = 10_000;

/// Greatest number of pixels of a traced picture.
const MAX_PIXELS: usize = 1 << 18;

/// Initial tolerance of traced outlines, pixels. It doubles until the outlines have few enough points.
const TRACE_TOLERANCE_PIXELS: f64 = 0.1;

/// Least area of traced islands and holes, pixels. Smaller ones are dropped.
const MIN_ISLAND_AREA_PIXELS: f64 = 1.5;

impl Tile {
    /// A tile of SVG path data in a square of side 10: lines, or filled shapes if `filling` is set.
    ///
    /// # Errors
    /// Describes the fault of the path.
    pub(crate) fn of_path(path: &BezPath, filling: Option<WindingRule>) -> Result<Self, String> {
        if let Some(filling) = filling {
            return Self::of_shapes(&[(path.clone(), filling)], [PATH_SQUARE_SIDE; 2]);
        }
        let mut lines = flattened(path, LINE_FLATNESS_OF_SIDE * PATH_SQUARE_SIDE, PATH_SQUARE_SIDE)?;
        lines
            .iter_mut()
            .flatten()
            .for_each(|p| *p = Point::new(p.x / PATH_SQUARE_SIDE, p.y / PATH_SQUARE_SIDE));
        Self { lines, shapes: Vec::new(), height: 1.0 }.checked()
    }

    /// A tile of filled shapes in a box from (0, 0) to the given size.
    ///
    /// # Errors
    /// Describes the fault of the shapes.
    pub(crate) fn of_shapes(
        shapes: &[(BezPath, WindingRule)],
        [width, height]: [f64; 2],
    ) -> Result<Self, String> {
        if !(width > 0.0
            && height > 0.0
            && (tolerances::MIN_TILE_ASPECT..=tolerances::MAX_TILE_ASPECT).contains(&(height / width)))
        {
            return Err("has no size to repeat".to_owned());
        }
        let rings = |(path, filling): &(BezPath, WindingRule)| {
            let mut rings = flattened(path, SHAPE_FLATNESS_OF_SIDE * width.min(height), width.max(height))?;
            for ring in &mut rings {
                ring.iter_mut().for_each(|p| *p = Point::new(p.x / width, p.y / width));
                if ring.len() > 1 && ring.first() == ring.last() {
                    ring.pop();
                }
            }
            Ok((rings, *filling))
        };
        let shapes: Vec<(Vec<Vec<Point>>, WindingRule)> =
            shapes.iter().map(rings).collect::<Result<_, String>>()?;
        let count: usize = shapes.iter().flat_map(|(rings, _)| rings).map(Vec::len).sum();
        if count > MAX_POINTS {
            return Err("has too many curves".to_owned());
        }
        if shapes.iter().flat_map(|(rings, _)| rings).flatten().any(|p| !is_near(*p)) {
            return Err(OUTSIDE_TILE_ERROR.to_owned());
        }
        let rings = unite_shapes(&shapes).unwrap_or_default();
        if rings.is_empty() {
            return Err("has no dark area".to_owned());
        }
        Self { lines: Vec::new(), shapes: islands(rings), height: height / width }.checked()
    }

    /// A tile of the areas of a picture that are darker than `level`, 0 to 1.
    ///
    /// # Errors
    /// Describes the fault of the picture.
    pub(crate) fn of_picture(picture: &Picture, level: f64) -> Result<Self, String> {
        let whole = DarknessMap::of(picture);
        let times = (MAX_PIXELS as f64 / (whole.width * whole.height) as f64).sqrt().min(1.0);
        let [width, height] =
            [whole.width, whole.height].map(|count| (count as f64 * times).floor() as usize);
        let shades = whole.at_most(width, height);
        let wide = shades.width as f64;
        let mut tracing = OutlineTracing {
            level,
            scale: [1.0; 2],
            tolerance: TRACE_TOLERANCE_PIXELS,
            speck: MIN_ISLAND_AREA_PIXELS,
            repeats: true,
        };
        while tracing.tolerance < wide {
            let rings = shades.outlines(&tracing).ok_or("has an outline with too many corners")?;
            if rings.is_empty() {
                return Err(format!("has nothing darker than {level}"));
            }
            if rings.iter().map(Vec::len).sum::<usize>() <= MAX_POINTS {
                let place = |p: &Point| Point::new(p.x / wide, p.y / wide);
                let rings = rings.iter().map(|ring| ring.iter().map(place).collect()).collect();
                let height = shades.height as f64 / wide;
                return Ok(Self { lines: Vec::new(), shapes: islands(rings), height });
            }
            (tracing.tolerance, tracing.speck) = (2.0 * tracing.tolerance, 4.0 * tracing.speck);
        }
        Err("has an outline with too many corners".to_owned())
    }

    fn checked(self) -> Result<Self, String> {
        let points = || self.lines.iter().chain(self.shapes.iter().flatten()).flatten();
        match points().count() {
            1..=MAX_POINTS if points().all(|p| is_near(*p)) => Ok(self),
            1..=MAX_POINTS => Err(OUTSIDE_TILE_ERROR.to_owned()),
            _ => Err("has no lines, or too many".to_owned()),
        }
    }
}

/// Greatest distance of control points from the origin, in tile sizes.
const MAX_CONTROL_POINT_TILES: f64 = 100.0;

const OUTSIDE_TILE_ERROR: &str = "extends far outside its square";

fn is_near(p: Point) -> bool {
    p.is_finite() && p.x.abs() <= PATH_SQUARE_SIDE && p.y.abs() <= PATH_SQUARE_SIDE
}

/// The polylines of a path, each of at least two points. Fails if the path is far larger than the tile.
fn flattened(path: &BezPath, tolerance: f64, size: f64) -> Result<Vec<Vec<Point>>, String> {
    let extent = path.control_box();
    let far = [extent.x0, extent.y0, extent.x1, extent.y1].map(f64::abs).into_iter().fold(0.0, f64::max);
    if !(path.is_finite() && far <= MAX_CONTROL_POINT_TILES * size) {
        return Err(OUTSIDE_TILE_ERROR.to_owned());
    }
    let mut lines: Vec<Vec<Point>> = Vec::new();
    kurbo::flatten(path, tolerance, |element| match element {
        kurbo::PathEl::MoveTo(p) => lines.push(vec![p]),
        kurbo::PathEl::LineTo(p) => lines.last_mut().into_iter().for_each(|line| line.push(p)),
        kurbo::PathEl::ClosePath => lines.last_mut().into_iter().for_each(|line| line.push(line[0])),
        kurbo::PathEl::QuadTo(..) | kurbo::PathEl::CurveTo(..) => {}
    });
    lines.retain(|line| line.len() > 1);
    Ok(lines)
}

/// Groups rings into islands, each with the holes inside it.
fn islands(rings: Vec<Vec<Point>>) -> Vec<Vec<Vec<Point>>> {
    let path = |ring: &[Point]| polygon(ring.iter().copied());
    let areas: Vec<f64> = rings.iter().map(|ring| path(ring).area()).collect();
    // The total area of islands exceeds that of their holes, so the sum has the islands' sign.
    let turn = areas.iter().sum::<f64>().signum();
    let (outer, holes): (Vec<usize>, Vec<usize>) = (0..rings.len()).partition(|k| areas[*k] * turn > 0.0);
    let outlines: Vec<BezPath> = outer.iter().map(|k| path(&rings[*k])).collect();
    let mut islands: Vec<Vec<Vec<Point>>> = outer.iter().map(|k| vec![rings[*k].clone()]).collect();
    for hole in holes {
        // A point inside the hole, next to one of its sides.
        let Some(p) = within(&rings[hole], &path(&rings[hole])) else { continue };
        let around = (0..outer.len()).filter(|k| outlines[*k].contains(p));
        let least = around.min_by(|a, b| areas[outer[*a]].abs().total_cmp(&areas[outer[*b]].abs()));
        if let Some(island) = least {
            islands[island].push(rings[hole].clone());
        }
    }
    islands
}

/// A point inside a ring.
fn within(ring: &[Point], path: &BezPath) -> Option<Point> {
    let sides = (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]]);
    let beside = sides.flat_map(|[a, b]| {
        let across = (b - a) * tolerances::INSIDE_PROBE_OF_SIDE;
        let across = kurbo::Vec2::new(-across.y, across.x);
        [a.midpoint(b) + across, a.midpoint(b) - across]
    });
    beside.into_iter().find(|p| path.contains(*p))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::srgb::Colour;
    use crate::geometry::plane::polylines::ring_area;

    fn tile_area(tile: &Tile) -> f64 {
        tile.shapes.iter().flatten().map(|ring| ring_area(ring)).sum::<f64>().abs()
    }

    #[test]
    fn tile_merges_overlapping_shapes_and_assigns_holes_to_islands() {
        let path = |text: &str| BezPath::from_svg(text).unwrap();
        // Two overlapping squares of opposite orientation, and a frame with a square in it.
        let shapes = [
            (path("M0 0H4V4H0Z"), WindingRule::NonZero),
            (path("M2 2V6H6V2Z"), WindingRule::NonZero),
            (path("M10 10H18V18H10ZM12 12H16V16H12ZM13 13H15V15H13Z"), WindingRule::EvenOdd),
        ];
        let tile = Tile::of_shapes(&shapes, [20.0, 40.0]).unwrap();
        let mut rings: Vec<usize> = tile.shapes.iter().map(Vec::len).collect();
        rings.sort_unstable();
        assert_eq!((rings, tile.height), (vec![1, 1, 2], 2.0));
        assert!(
            (tile_area(&tile) * 400.0 - (28.0 + 48.0 + 4.0)).abs() < 1e-3,
            "{}",
            tile_area(&tile) * 400.0
        );
    }

    #[test]
    fn tile_of_a_picture_has_the_ink_area_of_the_picture() {
        let size = 48;
        let shade = |k: usize| {
            let [x, y] = [k % size, k / size].map(|v| v as f64 + 0.5 - 24.0);
            let far = (x * x + y * y).sqrt();
            let ink = (14.5 - far).clamp(0.0, 1.0).min((far - 5.5).clamp(0.0, 1.0));
            let grey = (255.0 - 255.0 * ink).round() as u8;
            Colour::rgb(grey, grey, grey)
        };
        let picture = Picture { width: size, height: size, pixels: (0..size * size).map(shade).collect() };
        let tile = Tile::of_picture(&picture, 0.5).unwrap();
        assert!(tile.shapes.len() == 1 && tile.shapes[0].len() == 2);
        let wanted = std::f64::consts::PI * (14.0 * 14.0 - 6.0 * 6.0) / (48.0 * 48.0);
        assert!((tile_area(&tile) / wanted - 1.0).abs() < 0.01, "{} {wanted}", tile_area(&tile));
        let white = Picture { width: 2, height: 2, pixels: vec![Colour::WHITE; 4] };
        assert!(Tile::of_picture(&white, 0.5).unwrap_err().contains("nothing darker"));
    }
}
