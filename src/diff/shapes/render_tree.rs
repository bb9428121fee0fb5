//! [`Drawn`]: a file as the renderer reads it, once for smooth edges and once for sharp ones.

use std::sync::OnceLock;

use rustc_hash::FxHashMap;
use usvg::{ImageHrefResolver, Options, ShapeRendering, Tree};

/// A file as the renderer reads it.
#[derive(Debug)]
pub(crate) struct Drawn {
    smooth: Tree,
    /// Made when it is needed, where it differs.
    crisp: OnceLock<Option<Tree>>,
    markup: String,
    /// What stands for a text or a picture, by id, and whether it is a text.
    stand_ins: FxHashMap<String, bool>,
}

/// Two pictures are equal where their files are.
impl PartialEq for Drawn {
    fn eq(&self, other: &Self) -> bool {
        self.markup == other.markup
    }
}

impl Drawn {
    /// Reads a file that was written anew.
    ///
    /// # Errors
    /// Where it is no drawing.
    pub(crate) fn new(markup: String, stand_ins: FxHashMap<String, bool>) -> Result<Self, usvg::Error> {
        let smooth = tree(&markup, ShapeRendering::GeometricPrecision)?;
        Ok(Self { smooth, crisp: OnceLock::new(), markup, stand_ins })
    }

    /// With smooth edges, but for those that the file says are sharp.
    pub(crate) fn smooth(&self) -> &Tree {
        &self.smooth
    }

    /// The same with sharp edges, where the renderer paints them.
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

    /// Whether an element stands for a text, or for a picture.
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
        // Nothing is read from the disk, and no picture is decoded.
        image_href_resolver: ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..Options::default()
    };
    Tree::from_str(markup, &options)
}
