//! Region paths: one closed path per region, in the layers `fills` and `shadows`.

use std::sync::Arc;

use crate::parallel::prelude::*;
use kurbo::{Affine, BezPath, ParamCurve, ParamCurveDeriv, PathEl, PathSeg, Point, Vec2};

use super::gradient_regions::gradient;
use crate::drawing::{Layer, LayerKind, Mark, Paint, Provenance, Unit};
use crate::geometry::plane::planar_distance::unit;
use crate::light::Shading;
use crate::regions::{Region, RegionOptions, Regions, Seams, SurfaceLabel};

/// Names, colours and unit, as needed for painting.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PaintContext<'a> {
    /// Unit of the page.
    pub unit: Unit,
    /// Position of the regions' frame on the page.
    pub offset: Vec2,
    /// Part names, indexed by [`crate::mesh::PartId`].
    pub parts: &'a [Arc<str>],
    /// Material names, indexed by [`crate::mesh::MaterialId`].
    pub materials: &'a [Arc<str>],
    /// Colours of tones.
    pub shading: &'a Shading,
}

/// Paints regions into the layers `fills` and `shadows`. Empty layers are left out.
///
/// Narrow regions come first. With [`Seams::Underlap`] each extends a little under those painted after it.
/// Wide regions have room for that, so nothing shows on their other side.
#[must_use]
pub(crate) fn paint(regions: &Regions, context: &PaintContext, options: &RegionOptions) -> Vec<Layer> {
    let lengths: Vec<f64> = regions.borders.par_iter().with_min_len(16).map(|b| length(&b.path)).collect();
    let mut order: Vec<u32> = (0..regions.regions.len() as u32).collect();
    let key = |k: u32| {
        let region = &regions.regions[k as usize];
        let around: f64 = region.loops.iter().flatten().map(|(border, _)| lengths[*border as usize]).sum();
        // Bits sort like positive numbers.
        (region.label.cast, (region.area / around.max(f64::MIN_POSITIVE)).to_bits(), k)
    };
    order.sort_by_cached_key(|k| key(*k));
    let mut rank = vec![0u32; order.len()];
    for (place, k) in order.iter().enumerate() {
        rank[*k as usize] = place as u32;
    }
    let reach = match options.seams {
        Seams::Underlap => options.underlap.in_unit(context.unit).max(0.0),
        Seams::Exact => 0.0,
    };
    let marks: Vec<(bool, Mark)> = order
        .par_iter()
        .with_min_len(4)
        .with_max_len(8)
        .map(|k| {
            let region = &regions.regions[*k as usize];
            let mut path = outline(regions, *k, &rank, reach);
            path.apply_affine(Affine::translate(context.offset));
            (region.label.cast, mark(region, path, context))
        })
        .collect();
    let layer = |kind: LayerKind, cast: bool| {
        let own = marks.iter().filter(|(is_cast, _)| *is_cast == cast).map(|(_, mark)| mark.clone());
        Layer { kind, pen: None, ordered: false, marks: own.collect() }
    };
    let layers = [layer(LayerKind::Fills, false), layer(LayerKind::Shadows, true)];
    layers.into_iter().filter(|layer| !layer.marks.is_empty()).collect()
}

/// Outlines of the picked regions, extended by `reach` under picked neighbours that come later.
pub(crate) fn outlines(
    regions: &Regions,
    offset: Vec2,
    reach: f64,
    pick: impl Fn(&Region) -> bool,
) -> Vec<(BezPath, Region)> {
    let numbers = (1..).zip(&regions.regions);
    let rank: Vec<u32> = numbers.map(|(number, region)| if pick(region) { number } else { 0 }).collect();
    let numbered = regions.regions.iter().enumerate().filter(|(_, region)| pick(region));
    numbered
        .map(|(k, region)| {
            let mut path = outline(regions, k as u32, &rank, reach);
            path.apply_affine(Affine::translate(offset));
            (path, region.clone())
        })
        .collect()
}

/// Approximate length of a path: for each curve, the mean of its chord and its control polygon.
fn length(path: &BezPath) -> f64 {
    let way = |a: Point, b: Point| (b - a).hypot2().sqrt();
    let of = |segment: PathSeg| match segment {
        PathSeg::Line(line) => way(line.p0, line.p1),
        PathSeg::Quad(quad) => {
            f64::midpoint(way(quad.p0, quad.p2), way(quad.p0, quad.p1) + way(quad.p1, quad.p2))
        }
        PathSeg::Cubic(cubic) => {
            let handles = way(cubic.p0, cubic.p1) + way(cubic.p1, cubic.p2) + way(cubic.p2, cubic.p3);
            f64::midpoint(way(cubic.p0, cubic.p3), handles)
        }
    };
    path.segments().map(of).sum()
}

fn mark(region: &Region, path: BezPath, context: &PaintContext) -> Mark {
    let look = region.label;
    let colour = |tone: u16| context.shading.colour(look.paint, tone);
    let paint = match &region.ramp {
        Some(ramp) => Paint::Gradient(gradient(ramp, colour, context.offset)),
        None => Paint::Fill(colour(look.tone)),
    };
    Mark { path, paint, provenance: provenance(look, context) }
}

/// Provenance of a region with the given label.
pub(crate) fn provenance(look: SurfaceLabel, context: &PaintContext) -> Provenance {
    let (part, material) = (look.part.index(), look.material.index());
    let names = Provenance::of_names(context.parts.get(part), context.materials.get(material));
    Provenance { tone: Some(look.tone), ..names }
}

/// Loops of a region, offset outward by `reach` along borders with regions painted later.
fn outline(regions: &Regions, number: u32, rank: &[u32], reach: f64) -> BezPath {
    let mut path = BezPath::new();
    for uses in &regions.regions[number as usize].loops {
        let mut begun = false;
        for (border, along) in uses {
            let border = &regions.borders[*border as usize];
            let other = border.sides[usize::from(*along)];
            let later = other.is_some_and(|other| rank[other as usize] > rank[number as usize]);
            let mut piece = if *along { border.path.clone() } else { border.path.reverse_subpaths() };
            if later && reach > 0.0 {
                piece = offset_outward(&piece, reach, border.closed);
            }
            append(&mut path, &piece, &mut begun);
        }
        if begun {
            path.close_path();
        }
    }
    path
}

/// Appends an open or closed piece to the current loop.
pub(crate) fn append(path: &mut BezPath, piece: &BezPath, begun: &mut bool) {
    let mut at = match path.elements().last() {
        Some(last) if *begun => last.end_point(),
        _ => None,
    };
    for element in piece.elements() {
        match *element {
            PathEl::MoveTo(p) if !*begun => {
                path.move_to(p);
                *begun = true;
                at = Some(p);
            }
            // The end of the previous border, or close to it if that was offset.
            PathEl::MoveTo(p) | PathEl::LineTo(p) => {
                if at != Some(p) {
                    path.line_to(p);
                }
                at = Some(p);
            }
            PathEl::ClosePath => {}
            element => {
                path.push(element);
                at = element.end_point();
            }
        }
    }
}

/// Offsets a path by `reach` to its left on the page (y down), which is outward. Sharp corners are cut off or
/// crossed over, so their sides keep the full distance.
fn offset_outward(path: &BezPath, reach: f64, closed: bool) -> BezPath {
    let segments: Vec<PathSeg> = path.segments().collect();
    let directions: Vec<[Vec2; 2]> = segments.iter().map(ends).collect();
    let n = segments.len();
    // Offset of an end of a segment, given the direction of the adjacent one.
    let shift =
        |own: Vec2, next: Option<Vec2>| next.and_then(|next| mitre(own, next)).unwrap_or(normal(own)) * reach;
    let mut out = BezPath::new();
    for (k, segment) in segments.iter().enumerate() {
        let before = if k > 0 { Some(k - 1) } else { closed.then_some(n - 1) };
        let after = if k + 1 < n { Some(k + 1) } else { closed.then_some(0) };
        let from = shift(directions[k][0], before.map(|b| directions[b][1]));
        let to = shift(directions[k][1], after.map(|a| directions[a][0]));
        let start = segment.start() + from;
        if k == 0 {
            out.move_to(start);
        } else if out.elements().last().and_then(PathEl::end_point) != Some(start) {
            out.line_to(start);
        }
        match *segment {
            PathSeg::Line(line) => out.line_to(line.p1 + to),
            PathSeg::Quad(quad) => out.quad_to(quad.p1 + (from + to) / 2.0, quad.p2 + to),
            PathSeg::Cubic(cubic) => out.curve_to(cubic.p1 + from, cubic.p2 + to, cubic.p3 + to),
        }
    }
    if closed && n > 0 {
        out.close_path();
    }
    out
}

/// Unit directions at both ends of a segment.
fn ends(segment: &PathSeg) -> [Vec2; 2] {
    let chord = unit(segment.end() - segment.start());
    let at = |t: f64| {
        let way = match segment {
            PathSeg::Line(line) => line.p1 - line.p0,
            PathSeg::Quad(quad) => quad.deriv().eval(t).to_vec2(),
            PathSeg::Cubic(cubic) => cubic.deriv().eval(t).to_vec2(),
        };
        let way = unit(way);
        if way == Vec2::ZERO { chord } else { way }
    };
    [at(0.0), at(1.0)]
}

/// Unit vector to the outside of a region whose border has this direction.
fn normal(way: Vec2) -> Vec2 {
    Vec2::new(way.y, -way.x)
}

/// Mitre of a blunt corner: the offset that moves both sides by one.
fn mitre(a: Vec2, b: Vec2) -> Option<Vec2> {
    let middle = unit(normal(a) + normal(b));
    let cosine = middle.dot(normal(a));
    (cosine > 0.5).then(|| middle / cosine)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offset_outward_grows_a_square_on_all_sides() {
        // Turns from x to y, so the inside is on the right on the page.
        let square = BezPath::from_vec(vec![
            PathEl::MoveTo(Point::new(0.0, 0.0)),
            PathEl::LineTo(Point::new(10.0, 0.0)),
            PathEl::LineTo(Point::new(10.0, 10.0)),
            PathEl::LineTo(Point::new(0.0, 10.0)),
            PathEl::ClosePath,
        ]);
        let grown = offset_outward(&square, 1.0, true);
        let area = kurbo::Shape::area(&grown);
        assert!((area - 144.0).abs() < 1e-9, "{area}: {}", grown.to_svg());
    }
}
