//! A file parsed for the renderer, once with smooth and once with crisp edges.

use std::sync::OnceLock;

use rustc_hash::FxHashMap;
use usvg::{ImageHrefResolver, Options, ShapeRendering, Tree};

/// A file parsed for the renderer.
#[derive(Debug)]
pub(crate) struct RenderTree {
    smooth: Tree,
    /// Parsed with crisp edges on first use, if that differs.
    crisp: OnceLock<Option<Tree>>,
    markup: String,
    /// Ids of texts and pictures, and whether each is a text.
    stand_ins: FxHashMap<String, bool>,
}

/// Compares the markup only.
impl PartialEq for RenderTree {
    fn eq(&self, other: &Self) -> bool {
        self.markup == other.markup
    }
}

impl RenderTree {
    /// Parses a file prepared for the renderer.
    ///
    /// # Errors
    /// If it is not a drawing.
    pub(crate) fn new(markup: String, stand_ins: FxHashMap<String, bool>) -> Result<Self, usvg::Error> {
        let smooth = tree(&markup, ShapeRendering::GeometricPrecision)?;
        Ok(Self { smooth, crisp: OnceLock::new(), markup, stand_ins })
    }

    /// With smooth edges, except where the file requests crisp ones.
    pub(crate) fn smooth(&self) -> &Tree {
        &self.smooth
    }

    /// With crisp edges.
    pub(crate) fn crisp(&self) -> &Tree {
        let tree = &self.smooth;
        let plain = tree.linear_gradients().is_empty()
            && tree.radial_gradients().is_empty()
            && tree.patterns().is_empty()
            && tree.masks().is_empty()
            && tree.filters().is_empty()
            && !self.markup.contains("blend-mode");
        if plain {
            return tree;
        }
        let crisp = self.crisp.get_or_init(|| tree_of(&self.markup));
        crisp.as_ref().unwrap_or(tree)
    }

    /// Whether an id stands for a text (`true`) or a picture (`false`); `None` for other elements.
    pub(crate) fn stand_in(&self, id: &str) -> Option<bool> {
        self.stand_ins.get(id).copied()
    }
}

fn tree_of(markup: &str) -> Option<Tree> {
    tree(markup, ShapeRendering::CrispEdges).ok()
}

fn tree(markup: &str, shape_rendering: ShapeRendering) -> Result<Tree, usvg::Error> {
    let options = Options {
        shape_rendering,
        // Do not read files or decode pictures.
        image_href_resolver: ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..Options::default()
    };
    Tree::from_str(markup, &options)
}
