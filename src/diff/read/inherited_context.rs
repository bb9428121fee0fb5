//! Layer, drawing, part and properties that an element inherits from its ancestors.

use std::sync::Arc;

use usvg::roxmltree::Node;

use crate::diff::shapes::label::Label;
use crate::diff::shapes::placeholder::Props;
use crate::drawing::LayerKind;

/// Layers that this program writes.
const KNOWN_LAYERS: [LayerKind; 9] = [
    LayerKind::Paper,
    LayerKind::Fills,
    LayerKind::Shadows,
    LayerKind::Hatching,
    LayerKind::Motion,
    LayerKind::HiddenLines,
    LayerKind::Lines,
    LayerKind::Tooth,
    LayerKind::Callouts,
];

/// Namespace of the attributes that mark layers.
const INKSCAPE_NAMESPACE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// State inherited from ancestors.
#[derive(Debug, Clone, Default)]
pub(crate) struct InheritedContext {
    pub layer: Arc<str>,
    pub drawing: Option<Arc<str>>,
    pub part: Option<Arc<str>>,
    /// Inherited properties of texts and pictures.
    pub props: Arc<Props>,
}

impl InheritedContext {
    /// State for the children of an element, or for the element itself.
    pub(crate) fn enter(&self, node: Node) -> Self {
        let mut inner = self.clone();
        if node.attribute((INKSCAPE_NAMESPACE, "groupmode")) == Some("layer") {
            let id = node.attribute("id").unwrap_or_default();
            let label = node.attribute((INKSCAPE_NAMESPACE, "label")).unwrap_or(id);
            let known = known_layer(id).or(known_layer(label));
            // On a page of several drawings, a layer around known layers is one of the drawings.
            if known.is_some() && !self.layer.is_empty() && known_layer(&self.layer).is_none() {
                inner.drawing = Some(Arc::clone(&self.layer));
            }
            inner.layer = Arc::from(known.unwrap_or(label));
        }
        if let Some(part) = node.attribute("data-part") {
            inner.part = Some(Arc::from(part));
        }
        inner
    }

    /// Label of an element with these classes.
    pub(crate) fn label(&self, classes: Vec<Arc<str>>) -> Arc<Label> {
        let Self { layer, drawing, part, .. } = self.clone();
        Arc::new(Label { layer, drawing, classes, part })
    }
}

/// The layer of this program that an id denotes. The id may have a prefix and a pen number.
fn known_layer(id: &str) -> Option<&'static str> {
    let stem = id.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches('-');
    // The paper's plain colour is a layer below its grain.
    let stem = stem.trim_end_matches("-colour");
    let ends = |kind: &&LayerKind| {
        stem.strip_suffix(kind.id()).is_some_and(|before| before.is_empty() || before.ends_with(['-', '_']))
    };
    // `hidden-lines` also ends with `lines`, so the longest id wins.
    KNOWN_LAYERS.iter().filter(ends).map(|kind| kind.id()).max_by_key(|id| id.len())
}

#[cfg(test)]
mod tests {
    use super::known_layer;

    #[test]
    fn known_layer_recognizes_prefixed_and_suffixed_layer_names() {
        assert_eq!(known_layer("lines"), Some("lines"));
        assert_eq!(known_layer("hidden-lines"), Some("hidden-lines"));
        assert_eq!(known_layer("page2-hidden-lines-3"), Some("hidden-lines"));
        assert_eq!(known_layer("paper-colour"), Some("paper"));
        assert_eq!(known_layer("outlines"), None);
        assert_eq!(known_layer("sketch"), None);
    }
}
