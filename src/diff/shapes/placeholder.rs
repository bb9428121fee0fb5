//! Placeholders for texts and pictures. The renderer has no fonts or decoders, so texts are compared by their
//! words, pictures by their bytes, and both by all properties that change their look.

use std::collections::BTreeMap;
use std::hash::{Hash, Hasher};
use std::sync::{Arc, LazyLock};

use kurbo::BezPath;
use rustc_hash::FxHasher;
use usvg::roxmltree::Node;

use crate::colour::srgb::Colour;
use crate::diff::markup::cascade::Cascade;
use crate::diff::markup::css_sheet::{self, Declaration};
use crate::error::Error;

/// Start of the description of a linked picture; the target follows in backticks.
pub(crate) const LINKED_PICTURE_PREFIX: &str = "the picture linked as `";

/// Properties and values that differ from the initial value.
pub(crate) type Details = BTreeMap<String, String>;
/// Inherited properties.
pub(crate) type Props = BTreeMap<&'static str, String>;
/// Known properties with their initial values.
type Initial = BTreeMap<&'static str, &'static str>;

/// Reads a table of properties with their initial values.
fn initial(table: &'static str) -> Initial {
    table.split(' ').filter_map(|row| row.split_once('=')).collect()
}

/// Inherited properties of texts and pictures, with initial values.
static INHERITED_PROPERTIES: LazyLock<Initial> = LazyLock::new(|| {
    initial(
        "font= font-family= font-size=medium font-size-adjust=none font-style=normal font-weight=normal \
     font-variant=normal font-stretch=normal font-kerning=auto font-feature-settings=normal \
     letter-spacing=normal word-spacing=normal text-anchor=start text-transform=none text-orientation=mixed \
     text-indent=0 text-rendering=auto text-shadow=none direction=ltr writing-mode=horizontal-tb \
     glyph-orientation-vertical=auto glyph-orientation-horizontal=auto dominant-baseline=auto \
     white-space=normal color=#000000 fill=#000000 fill-opacity=1 fill-rule=nonzero stroke=none \
     stroke-opacity=1 stroke-width=1 stroke-dasharray=none stroke-dashoffset=0 stroke-linecap=butt \
     stroke-linejoin=miter stroke-miterlimit=4 paint-order=normal visibility=visible image-rendering=auto",
    )
});
/// Properties and attributes that are not inherited, with initial values.
static OWN_PROPERTIES: LazyLock<Initial> = LazyLock::new(|| {
    initial(
        "text-decoration=none text-decoration-line=none text-decoration-style=solid text-decoration-color= \
     baseline-shift=0 alignment-baseline=auto unicode-bidi=normal opacity=1 filter=none clip-path=none \
     mask=none display=inline x= y= dx=0 dy=0 rotate=0 textLength= lengthAdjust=spacing startOffset=0 \
     method=align spacing=exact side=left",
    )
});
/// Properties already set on the rectangle of a text.
const BOX_PROPERTIES: [&str; 8] =
    ["opacity", "filter", "clip-path", "mask", "display", "visibility", "x", "y"];
/// Elements that only describe their parent.
const DESCRIPTIVE_ELEMENTS: [&str; 3] = ["title", "desc", "metadata"];

/// Properties of an element in order of increasing precedence: attributes, style sheets, own style, important
/// declarations.
fn cascaded_properties(node: Node, declared: &[Declaration], known: &Initial) -> Vec<(&'static str, String)> {
    let own = css_sheet::declarations(node.attribute("style").unwrap_or_default()).unwrap_or_default();
    let attributes = node.attributes().filter(|a| a.namespace().is_none()).map(|a| (a.name(), a.value()));
    let listed = |important: bool| {
        let all = declared.iter().chain(&own).filter(move |d| d.important == important);
        all.map(|d| (d.name, d.value))
    };
    let all = attributes.chain(listed(false)).chain(listed(true));
    let find = |name: &str| known.get_key_value(name).map(|(known, _)| *known);
    let mut said: Vec<(&'static str, String)> =
        all.filter_map(|(name, value)| Some((find(name)?, normal(node, name, value)))).collect();
    if node.attributes().any(|a| a.name() == "space" && a.value() == "preserve") {
        said.extend(find("white-space").map(|name| (name, "pre".to_owned())));
    }
    said
}

/// Properties inherited by the children of an element.
pub(crate) fn inherit(around: &Arc<Props>, node: Node, declared: &[Declaration]) -> Arc<Props> {
    let said = cascaded_properties(node, declared, &INHERITED_PROPERTIES);
    if said.is_empty() {
        return Arc::clone(around);
    }
    let mut props = (**around).clone();
    props.extend(said.into_iter().filter(|(_, value)| value != "inherit"));
    Arc::new(props)
}

/// Text with single spaces.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A value in normal form: numbers and colours in one notation, references by the content of their target.
fn normal(node: Node, name: &str, value: &str) -> String {
    let value = one_line(value);
    if matches!(name, "fill" | "stroke" | "color")
        && let Some(colour) = Colour::parse(&value)
    {
        return colour.hex();
    }
    if let Some(id) = value.strip_prefix("url(").and_then(|rest| rest.split(')').next()) {
        let id = id.trim_matches(['"', '\'', ' ']).trim_start_matches('#');
        return referred(node, id);
    }
    let number = |word: &str| match word.trim_end_matches("px").parse::<f64>() {
        Ok(number) => format!("{number}"),
        Err(_) => word.to_owned(),
    };
    let words = value.split([' ', ',']).filter(|word| !word.is_empty());
    let value = words.map(number).collect::<Vec<_>>().join(" ");
    match (name, value.as_str()) {
        ("font-weight", "400") | ("letter-spacing" | "word-spacing", "0") => "normal".to_owned(),
        ("font-weight", "700") => "bold".to_owned(),
        ("writing-mode", "lr-tb" | "lr") => "horizontal-tb".to_owned(),
        ("baseline-shift", "baseline") => "0".to_owned(),
        ("display", "block") => "inline".to_owned(),
        _ => value,
    }
}

/// Hash of a referenced element: by its text, or for a path by its geometry.
fn referred(node: Node, id: &str) -> String {
    let document = node.document();
    let target = document.descendants().find(|node| node.attribute("id") == Some(id));
    let text = || target.and_then(|target| document.input_text().get(target.range())).unwrap_or_default();
    let number = target.and_then(course).map_or_else(|| hash(text()), hash);
    format!("element {:08x}", number as u32)
}

/// Geometry and attributes of a path without children.
fn course(path: Node) -> Option<String> {
    let data = path.attribute("d").filter(|_| !path.has_children())?;
    let course = BezPath::from_svg(data).ok()?.to_svg();
    let others =
        path.attributes().filter(|a| a.name() != "d").map(|a| format!(" {}={}", a.name(), a.value()));
    Some(format!("{}{} {course}", path.tag_name().name(), others.collect::<String>()))
}

fn hash(text: impl Hash) -> u64 {
    let mut hasher = FxHasher::default();
    text.hash(&mut hasher);
    hasher.finish()
}

/// Description of a text or a picture, and the properties that change its look.
pub(crate) struct Placeholder {
    pub words: String,
    pub details: Details,
}

impl Placeholder {
    /// Two colours derived from a hash of the description and the properties.
    pub(crate) fn colours(&self) -> [String; 2] {
        let hash = hash((&self.words, &self.details));
        [hash, hash >> 24].map(|part| format!("#{:06x}", part & 0xff_ffff))
    }
}

/// Description of a text.
///
/// # Errors
/// If the style sheets exceed their limits.
pub(crate) fn text(
    node: Node,
    around: &Props,
    declared: &[Declaration],
    cascade: &Cascade,
) -> Result<Placeholder, Error> {
    let mut text = TextRuns::default();
    let mut props = around.clone();
    props.extend(cascaded_properties(node, declared, &INHERITED_PROPERTIES));
    props.extend(cascaded_properties(node, declared, &OWN_PROPERTIES).into_iter().filter(|(name, value)| {
        // The rectangle has a single position, so positions per letter are part of the properties.
        !BOX_PROPERTIES.contains(name) || matches!(*name, "x" | "y") && value.contains(' ')
    }));
    let preserved = props.get("white-space").is_some_and(|value| value.starts_with("pre"));
    text.inside(node, &props, cascade)?;
    let all: String = text.runs.iter().map(|(_, run)| run.as_str()).collect();
    let words = match preserved {
        true => all,
        false => one_line(&all),
    };
    let run = |(props, run): &(Props, String)| (details(props), one_line(run));
    let runs: Vec<(Details, String)> = text.runs.iter().map(run).collect();
    let details = match runs.as_slice() {
        [(only, _)] => only.clone(),
        [] => details(&props),
        several => {
            let mut details = details(&props);
            details.insert("spans".to_owned(), format!("{} as {:08x}", several.len(), hash(&runs) as u32));
            details
        }
    };
    Ok(Placeholder { words: format!("the text `{words}`"), details })
}

/// A text split into runs of equal properties.
#[derive(Default)]
struct TextRuns {
    /// Pieces of text with equal properties.
    runs: Vec<(Props, String)>,
}

impl TextRuns {
    /// Collects the runs of an element and its children.
    fn inside(&mut self, node: Node, props: &Props, cascade: &Cascade) -> Result<(), Error> {
        for child in node.children() {
            if child.is_text() {
                let text = child.text().unwrap_or_default();
                match self.runs.last_mut() {
                    Some((last, run)) if last == props || text.trim().is_empty() => run.push_str(text),
                    _ if text.trim().is_empty() => {}
                    _ => self.runs.push((props.clone(), text.to_owned())),
                }
                continue;
            }
            if !child.is_element() || DESCRIPTIVE_ELEMENTS.contains(&child.tag_name().name()) {
                continue;
            }
            let declared = cascade.declared(child)?;
            let mut inner = props.clone();
            // Letter positions apply only to the piece that sets them.
            inner.retain(|name, _| !matches!(*name, "x" | "y" | "dx" | "dy" | "rotate"));
            for (name, value) in cascaded_properties(child, &declared, &INHERITED_PROPERTIES)
                .into_iter()
                .chain(cascaded_properties(child, &declared, &OWN_PROPERTIES))
            {
                // Text decorations accumulate through nested elements.
                match inner.get_mut(name) {
                    Some(outer) if name.starts_with("text-decoration") => {
                        if value != "none" {
                            *outer = format!("{outer} {value}");
                        }
                    }
                    _ => drop(inner.insert(name, value)),
                }
            }
            let href =
                child.attributes().find(|a| a.name() == "href").filter(|_| child.has_tag_name("textPath"));
            if let Some(href) = href {
                inner.insert("href", referred(child, href.value().trim_start_matches('#')));
            }
            if inner.get("display").is_none_or(|display| display != "none") {
                self.inside(child, &inner, cascade)?;
            }
        }
        Ok(())
    }
}

/// The properties that are visible and differ from their initial value.
fn details(props: &Props) -> Details {
    let initial = |name: &str| INHERITED_PROPERTIES.get(name).or(OWN_PROPERTIES.get(name)).copied();
    let stroked = props.get("stroke").is_some_and(|stroke| stroke != "none");
    let shown = |(name, value): &(&&str, &String)| {
        let counts = stroked || !name.starts_with("stroke");
        counts
            && initial(name) != Some(value.as_str())
            && !matches!(**name, "visibility" | "image-rendering" | "color")
    };
    let mut details: Details =
        props.iter().filter(shown).map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
    if props.get("visibility").is_some_and(|value| value != "visible") {
        details.insert("visibility".to_owned(), "hidden".to_owned());
    }
    if [props.get("fill"), props.get("stroke")].iter().flatten().any(|paint| *paint == "currentColor") {
        details.insert("color".to_owned(), props.get("color").cloned().unwrap_or_default());
    }
    details
}

/// Description of a picture; `None` if it draws nothing.
pub(crate) fn picture(node: Node, around: &Props, declared: &[Declaration]) -> Option<Placeholder> {
    let href = node.attributes().find(|a| a.name() == "href").map(|a| a.value().trim())?;
    if href.is_empty() {
        return None;
    }
    let words = if href.starts_with("data:") || href.contains('`') {
        // Editors break the base64 text into lines.
        let letters: String = href.split_ascii_whitespace().collect();
        format!("the picture {:016x}", hash(letters))
    } else {
        format!("{LINKED_PICTURE_PREFIX}{href}`")
    };
    let mut details = Details::new();
    let fitted = node.attribute("preserveAspectRatio").unwrap_or_default();
    let fitted = fitted.split_whitespace().filter(|word| *word != "meet").collect::<Vec<_>>().join(" ");
    if !matches!(fitted.as_str(), "" | "xMidYMid") {
        details.insert("fitted".to_owned(), fitted);
    }
    let mut props = around.clone();
    props.extend(cascaded_properties(node, declared, &INHERITED_PROPERTIES));
    if let Some(smooth) = props.get("image-rendering").filter(|value| *value != "auto") {
        details.insert("image-rendering".to_owned(), smooth.clone());
    }
    Some(Placeholder { words, details })
}
