//! Lines found in the image, and the maps for finding them.

use std::borrow::Cow;

use crate::drawing::{Length, Unit};
use crate::light::ShadingNormals;
use crate::lines::image::SoupNormals;
use crate::lines::{FeatureLines, Source, Surface, image};
use crate::style::Style;
use crate::view::View;
use crate::view::raster::NormalDepthMaps;
use crate::visibility::{self, ViewMap};

/// The maps of a view, at the resolution of the style.
pub(crate) fn maps(surface: &Surface, view: &View, style: &Style, unit: Unit) -> NormalDepthMaps {
    let normals = ShadingNormals::new(&surface.mesh, &surface.hard, &surface.smooth);
    let per_unit = style.lines.image.samples / Length::px(1.0).in_unit(unit);
    let loose = SoupNormals::new(&surface.mesh, view, style.lines.crease_deg, |face| normals.of(face));
    let normals_of = |face| loose.normals(face).unwrap_or_else(|| normals.of(face));
    let mut maps = NormalDepthMaps::new(&surface.mesh, view, per_unit, normals_of);
    if !loose.is_empty() {
        maps.close_hairlines(|face| loose.is_loose(face));
    }
    maps
}

/// Adds the lines found in the image to those found on the surface.
pub(crate) fn add_image_lines<'a>(
    map: &mut ViewMap,
    lines: &'a FeatureLines,
    surface: &Surface,
    view: &View,
    style: &Style,
    unit: Unit,
) -> Cow<'a, FeatureLines> {
    let options = &style.lines;
    if !options.enabled || options.source == Source::Object {
        return Cow::Borrowed(lines);
    }
    let maps = maps(surface, view, style, unit);
    let edges = image::edges(&maps, &options.image);
    let found = image::trace(&surface.mesh, &maps, &edges, &options.image);
    let mut lines = lines.clone();
    visibility::assembly::image_edges::join(
        map,
        &mut lines,
        &found,
        &surface.mesh,
        view,
        options.source == Source::Both,
    );
    Cow::Owned(lines)
}
