//! [`SheetPage`]: the keys of a technical sheet.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use crate::geometry::names::glob::Glob;
use crate::page::figure::Models;
use crate::page::page_size::Size;
use crate::page::sheet::frame::title_block::TitleKeys;
use crate::page::sheet::view::projection_method::Method;
use crate::page::sheet::view::view_side::Side;

/// What a page file tells of a technical sheet.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SheetPage {
    /// Its size. Sheets larger than A4 lie on their longer side. Default: A3.
    pub size: Option<Size>,
    /// The model, or several.
    pub model: Models,
    /// What a unit of the model is: `mm`, `cm`, `m`, `in` or `ft`. Default: m in glTF, mm elsewhere.
    pub unit: Option<Spanned<String>>,
    /// The unit of the dimensions: `mm`, `cm`, `m`, `in` or `ft`. Default: in or ft if the model is in that unit, else mm.
    pub dimension_unit: Option<Spanned<String>>,
    /// How many decimals dimensions have at most, 0 to 9. Default: 2 in mm, 3 in other units.
    pub decimals: Option<Spanned<i64>>,
    /// Whether dimensions have a decimal comma. Default: a point.
    pub decimal_comma: bool,
    /// The style of the views. Default: technical.
    pub style: Option<Spanned<String>>,
    /// Changes to the style: `KEY=VALUE` each.
    pub set: Vec<Spanned<String>>,
    /// The font of all letters. Default: technical.
    pub font: Option<Spanned<String>>,
    /// First- or third-angle projection. Default: first.
    pub projection: Method,
    /// The scale of the views, such as `1:5`. Default: the largest of the series that fits.
    pub scale: Option<Spanned<String>>,
    /// The views. Default: front, top, left and iso.
    pub views: Option<Vec<Spanned<String>>>,
    /// Whether edges that are hidden are drawn dashed. Default: no.
    pub hidden: bool,
    /// Whether the length, the height and the depth of the whole are told. Default: yes.
    pub overall: Option<bool>,
    /// Whether axes of whole cylinders are drawn. Default: where the model is a single part.
    #[serde(alias = "center_lines")]
    pub centre_lines: Option<bool>,
    /// What the title block says.
    pub title: TitleKeys,
    /// Views of the model cut open.
    pub section: Vec<SectionKeys>,
    /// Places shown larger, in circles.
    pub detail: Vec<DetailKeys>,
    /// The model taken apart.
    pub exploded: Option<ExplodedKeys>,
    /// Whether there is a parts list from the names of parts, or the file (CSV or TOML) with its rows. Default: no.
    pub parts_list: Option<Spanned<ListKeys>>,
    /// The view that has the balloons of the parts list. Default: exploded if there is such a view, else iso.
    pub balloons: Option<Spanned<String>>,
    /// What views tell by themselves: `none`, `overall`, or `auto`: also the diameters of whole cylinders that are seen along their axes,
    /// and where holes are. Default: overall.
    pub dimensions: Option<Spanned<String>>,
    /// Points that dimensions name, in units of the model.
    pub points: BTreeMap<String, [f64; 3]>,
    /// Lengths and diameters in views.
    pub dimension: Vec<Spanned<DimensionKeys>>,
    /// Notes.
    pub notes: Vec<String>,
}

/// Where a parts list comes from.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(
    untagged,
    expecting = "this is not a parts list; write true, false, or the path of a file such as \"parts.csv\""
)]
pub enum ListKeys {
    /// From the names of parts, or none.
    Named(bool),
    /// From a file.
    File(String),
}

/// A view of the model cut open.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SectionKeys {
    /// The plane: `x`, `y=12.5`, `z=30%`, `normal:1,0,1@5mm`. What its normal points at is taken away, and looked at from there.
    pub plane: Spanned<String>,
    /// Its letter. Default: the next one.
    pub label: Option<String>,
    /// Parts that are not cut.
    #[serde(default)]
    pub uncut: Vec<String>,
}

/// A place shown larger.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DetailKeys {
    /// The view it is in. Default: front.
    pub of: Option<Spanned<String>>,
    /// The middle of it, in units of the model.
    pub at: [f64; 3],
    /// Its radius in units of the model.
    pub radius: Spanned<f64>,
    /// Its scale. Default: the second larger one of the series.
    pub scale: Option<Spanned<String>>,
    /// Its letter. Default: the next one.
    pub label: Option<String>,
}

/// The model taken apart.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ExplodedKeys {
    /// Along which axis: x, y, z, or three numbers such as 1,0,1. Default: the best one.
    pub axis: Option<Spanned<String>>,
    /// How far. Default: 1.
    pub factor: Option<Spanned<f64>>,
    /// From where it is seen. Default: iso.
    pub view: Option<Spanned<String>>,
    /// How single parts come apart.
    pub part: Vec<PartExplosionKeys>,
}

/// How parts come apart whose name matches. Values that are not set are found.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PartExplosionKeys {
    /// The pattern for their names.
    pub name: Spanned<Glob>,
    /// The direction of their way: x, -y, or three numbers such as 1,0,1.
    pub along: Option<Spanned<String>>,
    /// How far they move, in units of the model; 0 has them stay.
    pub distance: Option<Spanned<f64>>,
    /// Their place: of two parts that have one and overlap, that with the greater one comes to stand farther along the axis.
    pub order: Option<Spanned<f64>>,
    /// Parts of one group stay together.
    pub group: Option<String>,
}

/// A length or a diameter in a view.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DimensionKeys {
    /// The view it is in. Default: front.
    pub of: Option<Spanned<String>>,
    /// From here.
    pub from: Option<Spanned<PlaceKeys>>,
    /// To there.
    pub to: Option<Spanned<PlaceKeys>>,
    /// Where the cylinder is whose diameter or radius is told: the one whose surface is nearest.
    pub at: Option<Spanned<PlaceKeys>>,
    /// Which length: `horizontal`, `vertical` or `aligned`; or `diameter` or `radius` of a cylinder. Default: aligned.
    pub measure: Option<Measure>,
    /// How far beside the points its line is, mm, to the right or below if above 0. Default: in a row with others, on `side`.
    pub offset: Option<f64>,
    /// The side of the view it stands on: `left`, `right`, `above` or `below`. Default: below, or left where it is vertical.
    pub side: Option<Side>,
    /// What it says in place of the length.
    pub text: Option<String>,
}

/// A place on the model: a point in its units, or the name of one, or of a side of a part: `housing.left`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(
    untagged,
    expecting = "this is not a place; write a point such as [0, 10, 5], or a name such as \"housing.left\""
)]
pub enum PlaceKeys {
    /// A point.
    Point([f64; 3]),
    /// A point of `[page.points]`; or `left`, `right`, `top`, `bottom` or `centre` of what is seen, or of parts whose name stands before it.
    Named(String),
}

/// What is told of a model in a view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Measure {
    /// Across the page.
    Horizontal,
    /// Down the page.
    Vertical,
    /// From point to point: in the plane of the view, or along an axis of the model in a pictorial view.
    #[default]
    Aligned,
    /// How thick a cylinder is.
    Diameter,
    /// Half of that.
    Radius,
}
