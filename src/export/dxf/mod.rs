//! DXF: one polyline, line, arc or circle for each stroke, in layers by the kind of line.
//!
//! Source: Autodesk, DXF Reference, releases 12 (AC1009) and 2000 (AC1015). Cutting and milling programs read
//! polylines and arcs, but fail on splines and on curves split into many segments. So curves become lines and
//! arcs, and nothing is written twice. Coordinates have y up, with the page's lower left corner at (0, 0).
//!
//! 1. `dxf_source` selects the marks and the unit of length.
//! 2. `arc_recovery` finds the arcs that cubics stand for; `arc_fitting` fits lines and arcs to all other
//!    curves.
//! 3. `layer_table` gives each kind of line a layer with its most common pen; `colour_index` finds the nearest
//!    numbered colour.
//! 4. `entities` writes the strokes and fills; `tables` and `objects` write the rest of the file.
//!
//! `group_codes` writes pairs of code and value, the only content of a DXF file.

mod arc_fitting;
mod arc_recovery;
mod colour_index;
mod dxf_source;
mod entities;
mod group_codes;
mod layer_table;
mod objects;
mod tables;

pub use dxf_source::{DxfLength, DxfOptions, DxfVersion};

use crate::drawing::Drawing;
use dxf_source::{DxfSource, is_exported, is_exported_layer};
use entities::DxfEntities;
use group_codes::GroupCodes;
use layer_table::DxfLayers;

impl Drawing {
    /// Writes the drawing as a DXF file. Lines of varying width are written by their axis, and gradients by
    /// their middle colour. Pictures and paper are left out, and in release 12 also fills
    /// ([`Self::left_out_of_dxf`]).
    ///
    /// Circles of the model are circles if the style is [to scale](crate::Style::to_scale). The same drawing
    /// gives the same bytes.
    ///
    /// ```
    /// use ligne::export::{DxfOptions, DxfVersion};
    /// use ligne::{Camera, Scene, Style, render};
    ///
    /// let scene = Scene::open("examples/models/gear.obj")?;
    /// let drawing = render(&scene, &Camera::three_quarter().fit(&scene), &Style::default().to_scale())?;
    /// let dxf = drawing.to_dxf(&DxfOptions::default().with_version(DxfVersion::R2000));
    /// assert!(dxf.starts_with(b"0\r\nSECTION"));
    /// # Ok::<(), ligne::Error>(())
    /// ```
    #[must_use]
    pub fn to_dxf(&self, options: &DxfOptions) -> Vec<u8> {
        let sheet = DxfSource::new(self, options);
        let layers = DxfLayers::of(&sheet);
        let entities = DxfEntities::of(&sheet, &layers);
        let mut tags = GroupCodes::default();
        tables::header(&mut tags, &sheet, entities.next_handle);
        tables::write(&mut tags, &sheet, &layers);
        tables::blocks(&mut tags, sheet.version);
        tags.section("ENTITIES");
        tags.extend(&entities.tags);
        tags.end_section();
        if sheet.version == DxfVersion::R2000 {
            objects::write(&mut tags);
        }
        tags.text(0, "EOF");
        tags.into_bytes()
    }

    /// Number of marks that the file leaves out: pictures, and in release 12 fills.
    #[must_use]
    pub fn left_out_of_dxf(&self, options: &DxfOptions) -> usize {
        let drawn = self.layers.iter().filter(|layer| is_exported_layer(layer.kind));
        drawn.flat_map(|layer| &layer.marks).filter(|mark| !is_exported(mark, options.version)).count()
    }
}
