//! Header, tables and blocks of a DXF file.

use super::colour_index;
use super::dxf_source::{DxfSource, DxfVersion};
use super::group_codes::GroupCodes;
use super::layer_table::{CONTINUOUS, DEFAULT_LAYER, DxfLayers};
use super::objects::{self, MODEL_SPACE, PAPER_SPACE};

/// Application name of the extended data that holds part names.
pub(crate) const APPLICATION: &str = "LIGNE";

/// Value of `$INSUNITS` for millimetres.
const MILLIMETRES: usize = 4;
/// Value of `$INSUNITS` for lengths without a unit.
const UNITLESS: usize = 0;

/// Writes the HEADER section, and an empty CLASSES section in release 2000.
pub(crate) fn header(tags: &mut GroupCodes, sheet: &DxfSource, next_handle: u32) {
    let modern = sheet.version == DxfVersion::R2000;
    let variable = |tags: &mut GroupCodes, name: &str, code: u16, value: usize| {
        tags.text(9, name);
        tags.whole(code, value);
    };
    tags.section("HEADER");
    tags.text(9, "$ACADVER");
    tags.text(1, if modern { "AC1015" } else { "AC1009" });
    if modern {
        tags.text(9, "$HANDSEED");
        tags.handle(5, next_handle);
        variable(tags, "$INSUNITS", 70, if sheet.in_mm { MILLIMETRES } else { UNITLESS });
    }
    variable(tags, "$MEASUREMENT", 70, 1);
    tags.text(9, "$LTSCALE");
    tags.number(40, 1.0);
    for (name, at) in [("$EXTMIN", sheet.corners[0]), ("$EXTMAX", sheet.corners[1])] {
        tags.text(9, name);
        tags.point_in_space(10, at);
    }
    for (name, at) in [("$LIMMIN", sheet.corners[0]), ("$LIMMAX", sheet.corners[1])] {
        tags.text(9, name);
        tags.point(10, at);
    }
    tags.end_section();
    if modern {
        tags.section("CLASSES");
        tags.end_section();
    }
}

/// Writer of tables. In release 2000, entries have handles and subclasses.
struct Tables<'a> {
    tags: &'a mut GroupCodes,
    modern: bool,
    handle: u32,
}

impl Tables<'_> {
    fn take(&mut self) -> u32 {
        self.handle += 1;
        self.handle - 1
    }

    /// Writes a table with its entries.
    fn table(&mut self, name: &str, count: usize, entries: impl FnOnce(&mut Self, u32)) {
        self.tags.text(0, "TABLE");
        self.tags.text(2, name);
        let owner = self.take();
        if self.modern {
            self.tags.handle(5, owner);
            self.tags.handle(330, 0);
            self.tags.text(100, "AcDbSymbolTable");
        }
        self.tags.whole(70, count);
        if self.modern && name == "DIMSTYLE" {
            self.tags.text(100, "AcDbDimStyleTable");
        }
        entries(self, owner);
        self.tags.text(0, "ENDTAB");
    }

    /// Writes the start of a table entry with the next handle.
    fn entry(&mut self, kind: &str, class: &str, owner: u32, name: &str) {
        let handle = self.take();
        self.entry_of(handle, kind, class, owner, name);
    }

    /// Writes the start of a table entry with a given handle.
    fn entry_of(&mut self, handle: u32, kind: &str, class: &str, owner: u32, name: &str) {
        self.tags.text(0, kind);
        if self.modern {
            self.tags.handle(if kind == "DIMSTYLE" { 105 } else { 5 }, handle);
            self.tags.handle(330, owner);
            self.tags.text(100, "AcDbSymbolTableRecord");
            self.tags.text(100, class);
        }
        self.tags.text(2, name);
    }
}

/// Writes the tables of a drawing.
pub(crate) fn write(tags: &mut GroupCodes, sheet: &DxfSource, layers: &DxfLayers) {
    let modern = sheet.version == DxfVersion::R2000;
    tags.section("TABLES");
    let mut tables = Tables { tags, modern, handle: objects::FIRST_TABLE_HANDLE };
    tables.table("VPORT", 1, |tables, owner| active_view(tables, owner, sheet.corners));
    let patterns = patterns(layers);
    let extra = if modern { 3 } else { 1 };
    tables.table("LTYPE", patterns.len() + extra, |tables, owner| {
        let names = if modern { &["ByBlock", "ByLayer", CONTINUOUS][..] } else { &[CONTINUOUS][..] };
        for name in names {
            line_type(tables, owner, name, "", &[]);
        }
        for (name, pattern) in &patterns {
            line_type(tables, owner, name, "dashes as drawn", pattern);
        }
    });
    tables.table("LAYER", layers.list.len() + 1, |tables, owner| {
        layer(tables, owner, DEFAULT_LAYER, CONTINUOUS, colour_index::BLACK, None);
        for entry in &layers.list {
            layer(tables, owner, &entry.name, &entry.line_type(), entry.pen.colour, entry.pen.weight);
        }
    });
    tables.table("STYLE", 1, |tables, owner| {
        tables.entry("STYLE", "AcDbTextStyleTableRecord", owner, "STANDARD");
        tables.tags.whole(70, 0);
        for (code, value) in [(40, 0.0), (41, 1.0), (50, 0.0)] {
            tables.tags.number(code, value);
        }
        tables.tags.whole(71, 0);
        tables.tags.number(42, 2.5);
        tables.tags.text(3, "txt");
        tables.tags.text(4, "");
    });
    tables.table("VIEW", 0, |_, _| {});
    tables.table("UCS", 0, |_, _| {});
    tables.table("APPID", 2, |tables, owner| {
        for name in ["ACAD", APPLICATION] {
            tables.entry("APPID", "AcDbRegAppTableRecord", owner, name);
            tables.tags.whole(70, 0);
        }
    });
    tables.table("DIMSTYLE", 1, |tables, owner| {
        tables.entry("DIMSTYLE", "AcDbDimStyleTableRecord", owner, "STANDARD");
        tables.tags.whole(70, 0);
    });
    if modern {
        tables.table("BLOCK_RECORD", 2, |tables, owner| {
            for (handle, name) in [(MODEL_SPACE, "*Model_Space"), (PAPER_SPACE, "*Paper_Space")] {
                tables.entry_of(handle, "BLOCK_RECORD", "AcDbBlockTableRecord", owner, name);
            }
        });
    }
    tags.end_section();
}

/// Names and dash patterns of the line types used by layers.
fn patterns(layers: &DxfLayers) -> Vec<(String, Vec<f64>)> {
    let dashed = layers.list.iter().filter(|entry| !entry.pen.dash.is_empty());
    dashed.map(|entry| (entry.line_type(), entry.pen.dash.clone())).collect()
}

/// Writes the viewport that shows the whole page.
fn active_view(tables: &mut Tables, owner: u32, [low, high]: [[f64; 2]; 2]) {
    let [width, height] = [high[0] - low[0], high[1] - low[1]];
    tables.entry("VPORT", "AcDbViewportTableRecord", owner, "*ACTIVE");
    let tags = &mut *tables.tags;
    tags.whole(70, 0);
    for (code, point) in [
        (10, [0.0, 0.0]),
        (11, [1.0, 1.0]),
        (12, [low[0] + width / 2.0, low[1] + height / 2.0]),
        (13, [0.0, 0.0]),
        (14, [1.0, 1.0]),
        (15, [1.0, 1.0]),
    ] {
        tags.point(code, point);
    }
    for (code, towards) in [(16, 1.0), (17, 0.0)] {
        tags.point(code, [0.0, 0.0]);
        tags.number(code + 20, towards);
    }
    for (code, value) in
        [(40, height), (41, width / height), (42, 50.0), (43, 0.0), (44, 0.0), (50, 0.0), (51, 0.0)]
    {
        tags.number(code, value);
    }
    for (code, value) in [(71, 0), (72, 100), (73, 1), (74, 1), (75, 0), (76, 0), (77, 0), (78, 0)] {
        tags.whole(code, value);
    }
}

/// Writes a line type; `pattern` holds dashes and gaps in turn.
fn line_type(tables: &mut Tables, owner: u32, name: &str, told: &str, pattern: &[f64]) {
    tables.entry("LTYPE", "AcDbLinetypeTableRecord", owner, name);
    let tags = &mut *tables.tags;
    tags.whole(70, 0);
    tags.text(3, told);
    tags.whole(72, 65);
    tags.whole(73, pattern.len());
    tags.number(40, pattern.iter().sum());
    for (number, length) in pattern.iter().enumerate() {
        tags.number(49, if number % 2 == 0 { *length } else { -length });
        if tables.modern {
            tags.whole(74, 0);
        }
    }
}

fn layer(tables: &mut Tables, owner: u32, name: &str, line_type: &str, colour: u8, weight: Option<u16>) {
    tables.entry("LAYER", "AcDbLayerTableRecord", owner, name);
    tables.tags.whole(70, 0);
    tables.tags.whole(62, usize::from(colour));
    tables.tags.text(6, line_type);
    if let Some(weight) = weight.filter(|_| tables.modern) {
        tables.tags.whole(370, usize::from(weight));
    }
}

/// Writes the mandatory blocks: model space, which contains the drawing, and an empty paper space.
pub(crate) fn blocks(tags: &mut GroupCodes, version: DxfVersion) {
    tags.section("BLOCKS");
    if version == DxfVersion::R2000 {
        for (space, record, name) in [(0, MODEL_SPACE, "*Model_Space"), (2, PAPER_SPACE, "*Paper_Space")] {
            for (step, kind, class) in [(0, "BLOCK", "AcDbBlockBegin"), (1, "ENDBLK", "AcDbBlockEnd")] {
                tags.text(0, kind);
                tags.handle(5, objects::FIRST_BLOCK_HANDLE + space + step);
                tags.handle(330, record);
                tags.text(100, "AcDbEntity");
                tags.text(8, DEFAULT_LAYER);
                tags.text(100, class);
                if step == 0 {
                    tags.text(2, name);
                    tags.whole(70, 0);
                    tags.point_in_space(10, [0.0, 0.0]);
                    tags.text(3, name);
                    tags.text(1, "");
                }
            }
        }
    }
    tags.end_section();
}
