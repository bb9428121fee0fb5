//! [`StrokeOptions`]: the default pen and the rules that change it by kind, visibility and name.
//!
//! In a style sheet these are the tables `[pen]`, `[pen.NAME]`, `[[rule]]` and `[layers]`.

use serde::Deserialize;

use std::sync::Arc;

use super::ink_context::InkContext;
use super::pen::{Pen, PenChange};
use super::pen_choice::{LineInfo, PenChoice};
use crate::chains::Chain;
use crate::colour::srgb::Colour;
use crate::geometry::names::glob::Glob;
use crate::lines::LineKind;
use crate::mesh::{MaterialId, PartId};

/// Choice of ink for chains.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct StrokeOptions {
    /// Pen that rules start from.
    pub pen: Pen,
    /// Rules, applied in order. Later rules override single fields of earlier ones.
    pub rules: Vec<Rule>,
    /// Layers and their order.
    pub layers: LayerOptions,
    /// Function that changes the pen after all rules.
    pub choice: Option<PenChoice>,
}

/// Change of pen for some chains.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Rule {
    /// Condition on the chains. Without conditions the rule covers all.
    pub when: Condition,
    /// Changes of the pen.
    pub pen: PenChange,
}

/// Condition of a rule. Every field that is set must hold.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Condition {
    /// Kinds of line; empty means every kind.
    pub kinds: Vec<LineKind>,
    /// Whether the line is hidden behind surfaces.
    pub hidden: Option<bool>,
    /// Whether one side of the line is background.
    pub silhouette: Option<bool>,
    /// Whether both surfaces at the line face the camera.
    pub both_seen: Option<bool>,
    /// Name of the part.
    pub part: Option<Glob>,
    /// Name of the material.
    pub material: Option<Glob>,
}

/// Division of lines into layers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum LayersBy {
    /// One layer of visible lines and one of hidden lines.
    #[default]
    Visibility,
    /// These layers, split by pen. Layers are named by number, width and colour.
    Pen,
}

/// Order of the marks in a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum MarkOrder {
    /// Weak kinds first, so that outlines paint over the lines that end at them.
    #[default]
    Strength,
    /// Short pen-up ways between the end of a path and the start of the next.
    Travel,
}

/// Layers and their order: the `[layers]` table of a style sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct LayerOptions {
    /// Division into layers. Default: visibility.
    pub by: LayersBy,
    /// Order inside a layer. Default: strength.
    pub order: MarkOrder,
}

/// Rules with their name patterns already matched against the names of the scene.
pub(crate) struct Selection<'a> {
    options: &'a StrokeOptions,
    /// Width of veiled lines as a share of their pen's width.
    behind_glass: f64,
    /// The scene and the page, if a function changes pens.
    context: Option<&'a InkContext<'a>>,
    /// For each rule, whether each part matches.
    parts: Vec<Vec<bool>>,
    /// For each rule, whether each material matches.
    materials: Vec<Vec<bool>>,
}

impl StrokeOptions {
    /// Matches the patterns of all rules once, so that a chain needs only lookups.
    pub(crate) fn selection<'a>(&'a self, context: &'a InkContext) -> Selection<'a> {
        let InkContext { parts, materials, behind_glass, .. } = *context;
        Selection { context: Some(context), ..self.selection_for(parts, materials, behind_glass) }
    }

    /// The same from the names of parts and materials.
    pub(crate) fn selection_for<'a>(
        &'a self,
        parts: &[Arc<str>],
        materials: &[(Arc<str>, Colour)],
        behind_glass: f64,
    ) -> Selection<'a> {
        let fits = |glob: &Option<Glob>, name: &str| glob.as_ref().is_none_or(|glob| glob.matches(name));
        let parts = |rule: &Rule| parts.iter().map(|name| fits(&rule.when.part, name)).collect();
        let materials =
            |rule: &Rule| materials.iter().map(|(name, _)| fits(&rule.when.material, name)).collect();
        Selection {
            options: self,
            behind_glass,
            context: None,
            parts: self.rules.iter().map(parts).collect(),
            materials: self.rules.iter().map(materials).collect(),
        }
    }
}

/// Properties of a line that conditions of rules test.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LineTraits {
    pub kind: LineKind,
    pub hidden: bool,
    pub silhouette: bool,
    pub both_seen: bool,
    pub veiled: bool,
    pub part: PartId,
    pub material: MaterialId,
}

impl Selection<'_> {
    /// The pen of a chain, starting from `pen`.
    pub(crate) fn pen(&self, chain: &Chain, pen: Pen) -> Pen {
        let Chain { kind, silhouette, both_seen, veiled, part, material, .. } = *chain;
        let hidden = chain.invisibility > 0;
        let mut pen =
            self.pen_of(&LineTraits { kind, hidden, silhouette, both_seen, veiled, part, material }, pen);
        if let (Some(choice), Some(context)) = (&self.options.choice, self.context) {
            let part = context.parts.get(part.index()).map_or("", |name| name);
            let material = context.materials.get(material.index()).map_or("", |(name, _)| name);
            let line = LineInfo::of(chain, [part, material], context.depths, context.unit);
            (choice.0)(&line, &mut pen);
        }
        pen
    }

    /// The pen of a line, starting from `pen`.
    pub(crate) fn pen_of(&self, line: &LineTraits, mut pen: Pen) -> Pen {
        let behind = if line.veiled { self.behind_glass } else { 1.0 };
        let named = |table: &[bool], index: usize, glob: &Option<Glob>| {
            table.get(index).copied().unwrap_or(glob.is_none())
        };
        for ((rule, parts), materials) in self.options.rules.iter().zip(&self.parts).zip(&self.materials) {
            let when = &rule.when;
            if (when.kinds.is_empty() || when.kinds.contains(&line.kind))
                && when.hidden.is_none_or(|hidden| hidden == line.hidden)
                && when.silhouette.is_none_or(|silhouette| silhouette == line.silhouette)
                && when.both_seen.is_none_or(|both| both == line.both_seen)
                && named(parts, line.part.index(), &when.part)
                && named(materials, line.material.index(), &when.material)
            {
                rule.pen.apply(&mut pen);
            }
        }
        pen.width.value *= behind;
        pen
    }
}
