//! [`SheetPage`]: the keys of a technical sheet.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use crate::geometry::names::glob::Glob;
use crate::page::figure::Models;
use crate::page::page_size::PageSize;
use crate::page::sheet::frame::title_block::TitleKeys;
use crate::page::sheet::view::projection_method::ProjectionMethod;
use crate::page::sheet::view::view_side::ViewSide;

/// A technical sheet in a page file.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct SheetPage {
    /// Size of the sheet. Sheets larger than A4 are in landscape format. Default: A3.
    pub size: Option<PageSize>,
    /// One or more models.
    pub model: Models,
    /// Unit of the model: `mm`, `cm`, `m`, `in` or `ft`. Default: m for glTF, mm otherwise.
    pub unit: Option<Spanned<String>>,
    /// Unit of the dimensions: `mm`, `cm`, `m`, `in` or `ft`. Default: that of the model if it is in or ft,
    /// mm otherwise.
    pub dimension_unit: Option<Spanned<String>>,
    /// Maximum number of decimals in dimensions, 0 to 9. Default: 2 in mm, 3 in other units.
    pub decimals: Option<Spanned<i64>>,
    /// Whether dimensions use a decimal comma. Default: no, a point.
    pub decimal_comma: bool,
    /// Style of the views. Default: technical.
    pub style: Option<Spanned<String>>,
    /// Changes to the style, each `KEY=VALUE`.
    pub set: Vec<Spanned<String>>,
    /// Font of all texts. Default: technical.
    pub font: Option<Spanned<String>>,
    /// First- or third-angle projection. Default: first.
    pub projection: ProjectionMethod,
    /// Scale of the views, such as `1:5`. Default: the largest of the standard series that fits.
    pub scale: Option<Spanned<String>>,
    /// The views. Default: front, top, left and iso.
    pub views: Option<Vec<Spanned<String>>>,
    /// Whether hidden edges are drawn dashed. Default: no.
    pub hidden: bool,
    /// Whether the overall length, height and depth are dimensioned. Default: yes.
    pub overall: Option<bool>,
    /// Whether centre lines of whole cylinders are drawn. Default: yes if the model is a single part or
    /// `dimensions` is `auto`.
    #[serde(alias = "center_lines")]
    pub centre_lines: Option<bool>,
    /// Texts of the title block.
    pub title: TitleKeys,
    /// Section views.
    pub section: Vec<SectionKeys>,
    /// Detail views: circled areas at a larger scale.
    pub detail: Vec<DetailKeys>,
    /// The exploded view.
    pub exploded: Option<ExplodedKeys>,
    /// Whether there is a parts list made from part names, or the file (CSV or TOML) with its rows. Default:
    /// no.
    pub parts_list: Option<Spanned<ListKeys>>,
    /// Name of the view with the balloons of the parts list, or `none`. Default: exploded if there is such a
    /// view, else iso.
    pub balloons: Option<Spanned<String>>,
    /// Automatic dimensions: `none`, `overall` or `auto`. `auto` adds diameters of whole cylinders that are
    /// seen end-on, and positions of holes. Default: overall.
    pub dimensions: Option<Spanned<String>>,
    /// Named points for dimensions, in model units.
    pub points: BTreeMap<String, [f64; 3]>,
    /// Dimensions: lengths, diameters and radii.
    pub dimension: Vec<Spanned<DimensionKeys>>,
    /// Notes.
    pub notes: Vec<String>,
}

/// Source of a parts list.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(
    untagged,
    expecting = "this is not a parts list; write true, false, or the path of a file such as \"parts.csv\""
)]
pub(crate) enum ListKeys {
    /// Made from part names if true; no list if false.
    Named(bool),
    /// The path of a file.
    File(String),
}

/// A section view.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SectionKeys {
    /// Cutting plane: `x`, `y=12.5`, `z=30%`, `normal:1,0,1@5mm`. The half that the normal points to is
    /// removed, and the view looks from there.
    pub plane: Spanned<String>,
    /// Letter of the section. Default: the next one.
    pub label: Option<String>,
    /// Parts that are not cut.
    #[serde(default)]
    pub uncut: Vec<String>,
}

/// A detail view.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DetailKeys {
    /// Name of the view that contains the detail. Default: the first view.
    pub of: Option<Spanned<String>>,
    /// Centre of the detail, in model units.
    pub at: [f64; 3],
    /// Radius of the detail, in model units.
    pub radius: Spanned<f64>,
    /// Scale of the detail. Default: five times the scale of the sheet.
    pub scale: Option<Spanned<String>>,
    /// Letter of the detail. Default: the next one.
    pub label: Option<String>,
}

/// The exploded view.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct ExplodedKeys {
    /// Axis of the explosion: x, y, z, or three numbers such as 1,0,1. Default: chosen automatically.
    pub axis: Option<Spanned<String>>,
    /// Factor of all distances. Default: 1.
    pub factor: Option<Spanned<f64>>,
    /// Named view that shows the explosion. Default: iso.
    pub view: Option<Spanned<String>>,
    /// Settings of single parts.
    pub part: Vec<PartExplosionKeys>,
}

/// Explosion settings of the parts whose names match. Values that are not set are computed.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PartExplosionKeys {
    /// Pattern for part names.
    pub name: Spanned<Glob>,
    /// Direction of movement: x, -y, or three numbers such as 1,0,1.
    pub along: Option<Spanned<String>>,
    /// Distance in model units; 0 keeps the parts in place.
    pub distance: Option<Spanned<f64>>,
    /// Order along the axis: of two overlapping parts with an order, the one with the larger number moves
    /// farther.
    pub order: Option<Spanned<f64>>,
    /// Name of a group; the parts of a group move together.
    pub group: Option<String>,
}

/// A dimension: a length, a diameter or a radius in a view.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DimensionKeys {
    /// Name of the view. Default: front.
    pub of: Option<Spanned<String>>,
    /// First point of a length.
    pub from: Option<Spanned<PlaceKeys>>,
    /// Second point of a length.
    pub to: Option<Spanned<PlaceKeys>>,
    /// A point near the cylinder whose diameter or radius is shown; the cylinder with the nearest surface is
    /// used.
    pub at: Option<Spanned<PlaceKeys>>,
    /// What is measured: `horizontal`, `vertical`, `aligned`, `diameter` or `radius`. Default: aligned.
    pub measure: Option<DimensionKind>,
    /// Distance of the dimension line from its points in mm, to the right or below if positive. Default: in a
    /// row with others, on `side`.
    pub offset: Option<f64>,
    /// Side of the view for the dimension: `left`, `right`, `above` or `below`. Default: below, or left for
    /// vertical lengths.
    pub side: Option<ViewSide>,
    /// Text that replaces the length.
    pub text: Option<String>,
}

/// A point on the model: coordinates in model units, the name of a point, or a side of a part such as
/// `housing.left`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(
    untagged,
    expecting = "this is not a place; write a point such as [0, 10, 5], or a name such as \"housing.left\""
)]
pub(crate) enum PlaceKeys {
    /// Coordinates.
    Point([f64; 3]),
    /// The name of a point in `[page.points]`; or `left`, `right`, `top`, `bottom` or `centre` of the model,
    /// or of the parts named before the dot.
    Named(String),
}

/// The quantity that a dimension measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum DimensionKind {
    /// Horizontal distance on the page.
    Horizontal,
    /// Vertical distance on the page.
    Vertical,
    /// Distance between two points: in the plane of the view, or along an axis of the model in a pictorial
    /// view.
    #[default]
    Aligned,
    /// Diameter of a cylinder.
    Diameter,
    /// Radius of a cylinder.
    Radius,
}
