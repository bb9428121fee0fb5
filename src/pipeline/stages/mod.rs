//! Pictures of intermediate results, for looking into the pipeline.
//!
//! Marks have the class of their kind or reason, and a title that describes them.
//!
//! Files, in reading order: [`stage`] the stages by name; [`stage_marks`] colours and marks; [`facing_bands`]
//! bands of n·v; [`zero_sets`] contours before hiding; [`edge_strengths`] view edges by strength;
//! [`removed_lines`] what tidying removed.

mod edge_strengths;
mod facing_bands;
mod removed_lines;
pub(crate) mod stage;
mod stage_marks;
mod zero_sets;

use kurbo::{Point, Vec2};

use super::Stage;
use crate::chains::Chain;
use crate::colour::srgb::Colour;
use crate::drawing::{Layer, LayerKind, Length, Mark, Page};
use crate::lines::{FeatureLines, LineKind, Surface};
use crate::pipeline::view::page_transform::margin;
use crate::style::Style;
use crate::view::View;
use crate::visibility::{GapOcclusion, ViewMap};
use stage_marks::{HUES, line, polyline};

/// Results of the stages of one drawing.
pub(crate) struct StageInputs<'a> {
    pub surface: &'a Surface,
    pub view: &'a View,
    pub lines: &'a FeatureLines,
    pub gap_occlusion: &'a GapOcclusion<'a>,
    /// View map, centred on the page.
    pub map: &'a ViewMap,
    pub chains: &'a [Chain],
    pub style: &'a Style,
    pub page: &'a Page,
}

/// Draws the result of one stage.
pub(crate) fn draw(stage: Stage, inputs: &StageInputs) -> Vec<Layer> {
    match stage {
        Stage::Field => facing_bands::draw(inputs),
        Stage::Zeros => zero_sets::draw(inputs),
        Stage::Lines => of_lines(inputs),
        Stage::ViewMap => of_view_map(inputs),
        Stage::Strengths => edge_strengths::draw(inputs),
        Stage::Chains => of_chains(inputs),
        Stage::Removed => removed_lines::draw(inputs),
    }
}

impl StageInputs<'_> {
    /// Offset from the camera's frame to the page.
    fn margin(&self) -> Vec2 {
        margin(&self.view.frame, self.page)
    }

    /// A length in px, converted to the page's unit.
    fn px(&self, px: f64) -> f64 {
        Length::px(px).in_unit(self.page.unit)
    }

    /// Width of thin lines.
    fn thin(&self) -> f64 {
        self.px(0.8)
    }

    /// The part of a feature segment inside the page, from its start to its end.
    fn segment(&self, segment: u32) -> Option<[Point; 2]> {
        let mesh = &self.surface.mesh;
        let ends = self.lines.segments[segment as usize].ends;
        let [a, b] = ends.map(|end| self.lines.position(mesh, end));
        let ([a, b], _) = self.view.frame.clip_segment(a, b)?;
        let (start, end) = self.view.frame.clip_to_page(a, b)?;
        let point = |t: f64| Point::new(a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t) + self.margin();
        Some([start, end].map(point))
    }
}

/// Colour of a kind of line.
fn kind_colour(kind: LineKind) -> Colour {
    HUES[kind as usize % HUES.len()]
}

/// All feature lines, hidden or not, with one colour per kind.
fn of_lines(inputs: &StageInputs) -> Vec<Layer> {
    let marks = (0..inputs.lines.segments.len() as u32).filter_map(|s| {
        let kind = inputs.lines.segments[s as usize].kind;
        Some(line(polyline(&inputs.segment(s)?), kind_colour(kind), inputs.thin(), &[kind.name()], None))
    });
    layers([(LayerKind::Lines, marks.collect())])
}

/// Every view edge separately. Visible edges have the colour of their kind. Hidden ones are pale, in a layer
/// below.
fn of_view_map(inputs: &StageInputs) -> Vec<Layer> {
    let (mut hidden, mut visible) = (Vec::new(), Vec::new());
    for edge in &inputs.map.edges {
        let ends = [edge.start, edge.end].map(|v| inputs.map.vertices[v.index()].position);
        let colour = if edge.silhouette { Colour::BLACK } else { kind_colour(edge.kind) };
        push(polyline(&ends), colour, edge.kind, edge.invisibility, inputs.thin(), &mut hidden, &mut visible);
    }
    layers([(LayerKind::HiddenLines, hidden), (LayerKind::Lines, visible)])
}

/// Every chain, in eight colours that repeat.
fn of_chains(inputs: &StageInputs) -> Vec<Layer> {
    let (mut hidden, mut visible) = (Vec::new(), Vec::new());
    for (i, chain) in inputs.chains.iter().enumerate() {
        let (colour, path) = (HUES[i % HUES.len()], chain.path.clone());
        let width = if chain.invisibility == 0 { 1.5 * inputs.thin() } else { inputs.thin() };
        push(path, colour, chain.kind, chain.invisibility, width, &mut hidden, &mut visible);
    }
    layers([(LayerKind::HiddenLines, hidden), (LayerKind::Lines, visible)])
}

/// Adds a line to the visible ones, or, pale and thin, to the hidden ones.
fn push(
    path: kurbo::BezPath,
    colour: Colour,
    kind: LineKind,
    invisibility: u16,
    width: f64,
    hidden: &mut Vec<Mark>,
    visible: &mut Vec<Mark>,
) {
    if invisibility == 0 {
        visible.push(line(path, colour, width, &[kind.name()], None));
    } else {
        let mut mark = line(path, Colour { a: 70, ..colour }, width / 2.0, &[kind.name()], None);
        mark.provenance.invisibility = invisibility;
        hidden.push(mark);
    }
}

/// The layers that have marks, back to front.
fn layers<const N: usize>(of: [(LayerKind, Vec<Mark>); N]) -> Vec<Layer> {
    of.into_iter()
        .filter(|(_, marks)| !marks.is_empty())
        .map(|(kind, marks)| Layer { kind, pen: None, ordered: false, marks })
        .collect()
}
