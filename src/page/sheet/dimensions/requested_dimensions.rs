//! [`add_requested`]: the dimensions that a page file requests, between points, sides and centres of parts.
//!
//! 1. Keys name points: coordinates, named points, or a side of a part, which is its outermost drawn point in
//!    the view.
//! 2. A diameter or radius uses the nearest cylinder that is seen end-on.
//! 3. A length is measured by `true_length`. It goes to a row, or gets its own line if it is slanted or has
//!    an offset.

use glam::DVec3;
use kurbo::{Point, Vec2};
use toml::Spanned;

use super::dimension_set::{DiameterLeader, DimensionSet, SlantedLength};
use crate::error::Error;
use crate::geometry::names::glob::Glob;
use crate::geometry::space::bounds::Bounds;
use crate::mesh::Mesh;
use crate::page::page_source::PageSource;
use crate::page::sheet::arrangement::view_plan::ViewPlan;
use crate::page::sheet::keys::sheet_keys::{DimensionKeys, DimensionKind, PlaceKeys, SheetPage};
use crate::page::sheet::lengths::length_precision::{LengthPrecision, MeasuredPoint};
use crate::page::sheet::lengths::true_length::{Foreshortening, REFUSED_IN_EXPLODED_VIEW, true_length};
use crate::page::sheet::view::sheet_view::SheetView;
use crate::page::sheet::view::view_side::ViewSide;
use crate::page::tolerances;
use crate::scene::Scene;
use crate::surface::{Cylinder, cylinders};

/// The sides that the name of a place may end with.
const PLACE_ENDS: [&str; 5] = ["left", "right", "top", "bottom", "centre"];

/// Adds the requested dimensions.
pub(crate) fn add_requested(
    sheet: &SheetPage,
    plan: &ViewPlan,
    measures: &mut DimensionSet,
    source: &PageSource,
) -> Result<(), Error> {
    let mut cached_cylinders: Option<Vec<Cylinder>> = None;
    for keys in &sheet.dimension {
        let (span, keys) = (keys.span(), keys.get_ref());
        let view = match &keys.of {
            Some(name) => plan.view(name, source)?,
            None => plan.view(&Spanned::new(span.clone(), "front".to_owned()), source)?,
        };
        let sheet_view = &plan.views[view].sight;
        let scene = &plan.sets[0].scene;
        let resolve_point = |place_keys: &Option<Spanned<PlaceKeys>>, key: &str| match place_keys {
            Some(told) => resolve_place(told, sheet, scene, sheet_view, source),
            None => Err(source.fault(
                &span,
                &format!("this dimension has no `{key}`"),
                "write a point such as [0, 0, 0]",
            )),
        };
        let measure = keys.measure.unwrap_or_default();
        if matches!(measure, DimensionKind::Diameter | DimensionKind::Radius) {
            if plan.foreshortening(view) == Foreshortening::Moved {
                return Err(source.fault(&span, REFUSED_IN_EXPLODED_VIEW[0], REFUSED_IN_EXPLODED_VIEW[1]));
            }
            let point_on_cylinder = resolve_point(&keys.at, "at")?.at;
            let scene_cylinders =
                cached_cylinders.get_or_insert_with(|| cylinders(&Mesh::build(scene.to_soup())));
            let nearest_leader = nearest_cylinder_leader(
                scene_cylinders,
                point_on_cylinder,
                (measure, keys),
                (plan, sheet_view),
            );
            let at_span = keys.at.as_ref().map_or(span, Spanned::span);
            let remedy = "name a point on a cylinder that is seen along its axis in this view";
            let leader = nearest_leader
                .ok_or_else(|| source.fault(&at_span, "there is no cylinder in this view", remedy))?;
            measures.diameters.push((view, leader));
            continue;
        }
        let (from, to) = (resolve_point(&keys.from, "from")?, resolve_point(&keys.to, "to")?);
        let length = true_length([from, to], measure, sheet_view, plan.foreshortening(view));
        let (length, precision) = length.map_err(|[message, advice]| source.fault(&span, message, advice))?;
        let text = keys.text.clone().unwrap_or_else(|| plan.values.written(length, precision));
        let ends = [from, to].map(|p| sheet_view.to_page(p.at));
        add_length(ends, (measure, text), keys, view, measures);
    }
    Ok(())
}

/// The point on the model that a key names.
fn resolve_place(
    place_keys: &Spanned<PlaceKeys>,
    sheet: &SheetPage,
    scene: &Scene,
    sheet_view: &SheetView,
    source: &PageSource,
) -> Result<MeasuredPoint, Error> {
    let finite_point = |p: &[f64; 3]| {
        let advice = "write three numbers such as [0, 12.5, 3]";
        let is_finite = p.iter().all(|x| x.is_finite());
        let point = is_finite.then(|| MeasuredPoint::exact(DVec3::from_array(*p)));
        point.ok_or_else(|| source.fault(&place_keys.span(), "this is not a point", advice))
    };
    let name = match place_keys.get_ref() {
        PlaceKeys::Point(p) => return finite_point(p),
        PlaceKeys::Named(name) => name,
    };
    if let Some(p) = sheet.points.get(name) {
        return finite_point(p);
    }
    let (part, end) = name.rsplit_once('.').unwrap_or(("*", name));
    let end = if end == "center" { "centre" } else { end };
    if !PLACE_ENDS.contains(&end) {
        let known: Vec<&str> = sheet.points.keys().map(String::as_str).chain(PLACE_ENDS).collect();
        return Err(source.unknown(&Spanned::new(place_keys.span(), name.clone()), "place", &known));
    }
    let glob = Glob::new(part);
    let points = MeasuredPoint::of_parts(scene, |part| glob.matches(&part.name));
    if points.is_empty() {
        let message = format!("there is no part `{part}`");
        return Err(source.fault(
            &place_keys.span(),
            &message,
            "`ligne info MODEL` lists them; * matches any text",
        ));
    }
    let [right, up, _] = sheet_view.axes();
    let outermost = |direction: DVec3| {
        points.iter().copied().max_by(|a, b| a.at.dot(direction).total_cmp(&b.at.dot(direction)))
    };
    let end_point = match end {
        "left" => outermost(-right),
        "right" => outermost(right),
        "top" => outermost(up),
        "bottom" => outermost(-up),
        _ => Some(box_centre(&points)),
    };
    Ok(end_point.unwrap_or(MeasuredPoint::exact(DVec3::ZERO)))
}

/// The centre of the bounding box of some points, with their coarsest step.
fn box_centre(points: &[MeasuredPoint]) -> MeasuredPoint {
    let at = Bounds::of(points.iter().map(|p| p.at)).middle();
    MeasuredPoint { at, step: points.iter().map(|p| p.step).fold(0.0, f64::max) }
}

/// The leader of the cylinder that is seen end-on and whose surface is nearest to a point.
fn nearest_cylinder_leader(
    cylinders: &[Cylinder],
    at: DVec3,
    (measure, keys): (DimensionKind, &DimensionKeys),
    (plan, sheet_view): (&ViewPlan, &SheetView),
) -> Option<DiameterLeader> {
    let forward = sheet_view.axes()[2];
    let squared_distance = |cylinder: &Cylinder| {
        let offset = at - cylinder.point;
        let along = offset.dot(cylinder.axis);
        let radial_distance = (offset - cylinder.axis * along).length() - cylinder.radius;
        let axial_distance = (along - along.clamp(cylinder.ends[0], cylinder.ends[1])).abs();
        radial_distance * radial_distance + axial_distance * axial_distance
    };
    let is_end_on = |cylinder: &&Cylinder| cylinder.axis.dot(forward).abs() > tolerances::MIN_END_ON_COSINE;
    let end_on_cylinders = cylinders.iter().filter(is_end_on);
    let nearest = end_on_cylinders.min_by(|a, b| squared_distance(a).total_cmp(&squared_distance(b)))?;
    let is_radius = measure == DimensionKind::Radius;
    let (sign, length) = if is_radius { ("R", nearest.radius) } else { ("⌀", 2.0 * nearest.radius) };
    let text = keys.text.clone().unwrap_or_else(|| {
        format!("{sign}{}", plan.values.written(length, LengthPrecision::of_cylinder(nearest)))
    });
    let (centre, radius) = (sheet_view.to_page(nearest.point), nearest.radius * sheet_view.mm_per_unit);
    Some(DiameterLeader { centre, radius, text, pitch: None })
}

/// Adds a length, in a row if it is horizontal or vertical and has no offset.
fn add_length(
    ends: [Point; 2],
    (measure, text): (DimensionKind, String),
    keys: &DimensionKeys,
    view: usize,
    measures: &mut DimensionSet,
) {
    let line_vector = match measure {
        DimensionKind::Horizontal => Vec2::new(1.0, 0.0),
        DimensionKind::Vertical => Vec2::new(0.0, 1.0),
        _ => ends[1] - ends[0],
    };
    let length = line_vector.hypot2().sqrt();
    if length.is_nan() || length <= 0.0 {
        return;
    }
    let along = line_vector / length;
    let is_horizontal = along.y.abs() < tolerances::MAX_ZERO_COMPONENT;
    if keys.offset.is_none() && (is_horizontal || along.x.abs() < tolerances::MAX_ZERO_COMPONENT) {
        let side = keys.side.filter(|side| side.is_across() == is_horizontal);
        let side = side.unwrap_or(if is_horizontal { ViewSide::Below } else { ViewSide::Left });
        measures.add(view, ends, side, text);
        return;
    }
    measures.slanted.push((view, SlantedLength { ends, along, offset: keys.offset, text }));
}
