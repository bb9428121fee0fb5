//! Handles of what every file of release 2000 has, and the objects at its end.

use super::group_codes::Tags;

/// The dictionary that all objects hang on, and that of groups in it.
const ROOT: u32 = 0xC;
const GROUPS: u32 = 0xD;

/// The block records of the model's space and of the sheet.
pub(crate) const MODEL_SPACE: u32 = 0x1A;
pub(crate) const PAPER_SPACE: u32 = 0x1B;

/// The blocks themselves begin here, tables and their entries there.
pub(crate) const FIRST_OF_BLOCKS: u32 = 0x1C;
pub(crate) const FIRST_OF_TABLES: u32 = 0x20;

/// Entities begin here: tables have fewer entries.
pub(crate) const FIRST_FREE: u32 = 0x200;

pub(crate) fn write(tags: &mut Tags) {
    tags.section("OBJECTS");
    dictionary(tags, ROOT, 0);
    tags.text(3, "ACAD_GROUP");
    tags.handle(350, GROUPS);
    dictionary(tags, GROUPS, ROOT);
    tags.end_section();
}

fn dictionary(tags: &mut Tags, handle: u32, owner: u32) {
    tags.text(0, "DICTIONARY");
    tags.handle(5, handle);
    tags.handle(330, owner);
    tags.text(100, "AcDbDictionary");
    tags.whole(281, 1);
}
