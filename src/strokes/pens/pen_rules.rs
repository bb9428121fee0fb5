//! [`StrokeOptions`]: the default pen and the rules that change it, by kind, visibility and name.
//!
//! In a style sheet these are the tables `[pen]`, `[pen.NAME]`, `[[rule]]` and `[layers]`.

use serde::Deserialize;

use std::sync::Arc;

use super::ink_context::InkContext;
use super::pen::{Pen, PenChange};
use crate::chains::Chain;
use crate::colour::srgb::Colour;
use crate::geometry::names::glob::Glob;
use crate::lines::LineKind;
use crate::mesh::{MaterialId, PartId};

/// How chains get their ink.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StrokeOptions {
    /// The pen that rules start from.
    pub pen: Pen,
    /// Applied in order; later ones override single fields of earlier ones.
    pub rules: Vec<Rule>,
    /// Which layers there are and how they are ordered.
    pub layers: LayerOptions,
}

/// A change of pen for some chains.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Rule {
    /// Which chains; no condition means all.
    pub when: Condition,
    /// What changes.
    pub pen: PenChange,
}

/// Which chains a rule is for: all that is named must hold.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Condition {
    /// Kinds of line; empty = every kind.
    pub kinds: Vec<LineKind>,
    /// Behind surfaces, or visible.
    pub hidden: Option<bool>,
    /// Whether there is background on one side of the line.
    pub silhouette: Option<bool>,
    /// Whether both surfaces that meet in the line face the eye.
    pub both_seen: Option<bool>,
    /// Name of the part.
    pub part: Option<Glob>,
    /// Name of the material.
    pub material: Option<Glob>,
}

/// What layers hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LayersBy {
    /// One layer of visible lines, one of hidden ones.
    #[default]
    Visibility,
    /// Those, split to one layer for each pen, named by number, width and colour.
    Pen,
}

/// The order of the marks of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Order {
    /// Weak kinds first, so that outlines paint over the lines that end at them.
    #[default]
    Strength,
    /// Short ways between the end of a path and the start of the next.
    Travel,
}

/// Which layers there are and how they are ordered: the `[layers]` table of a style sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LayerOptions {
    /// What layers hold. Default: visibility.
    pub by: LayersBy,
    /// The order inside a layer. Default: strength.
    pub order: Order,
}

/// The rules with their name patterns already tried on the names of the scene.
pub(crate) struct Selection<'a> {
    options: &'a StrokeOptions,
    /// The part of their pen's width that veiled lines have.
    behind_glass: f64,
    /// For each rule, whether each part fits.
    parts: Vec<Vec<bool>>,
    /// For each rule, whether each material fits.
    materials: Vec<Vec<bool>>,
}

impl StrokeOptions {
    /// Tries the patterns of all rules once, so that a chain costs only lookups.
    pub(crate) fn selection<'a>(&'a self, context: &InkContext) -> Selection<'a> {
        let InkContext { parts, materials, behind_glass, .. } = *context;
        self.selection_for(parts, materials, behind_glass)
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
            parts: self.rules.iter().map(parts).collect(),
            materials: self.rules.iter().map(materials).collect(),
        }
    }
}

/// The conditions of rules for a line.
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
    /// The pen of a chain, from the one that rules start from.
    pub(crate) fn pen(&self, chain: &Chain, pen: Pen) -> Pen {
        let Chain { kind, silhouette, both_seen, veiled, part, material, .. } = *chain;
        let hidden = chain.invisibility > 0;
        self.pen_of(&LineTraits { kind, hidden, silhouette, both_seen, veiled, part, material }, pen)
    }

    /// The pen of a line, from the one that rules start from.
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
