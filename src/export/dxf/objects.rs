//! Fixed handles of release 2000, and the OBJECTS section.

use super::group_codes::Tags;

/// Handle of the root dictionary.
const ROOT: u32 = 0xC;
/// Handle of the group dictionary.
const GROUPS: u32 = 0xD;

/// Handle of the block record of model space.
pub(crate) const MODEL_SPACE: u32 = 0x1A;
/// Handle of the block record of paper space.
pub(crate) const PAPER_SPACE: u32 = 0x1B;

/// First handle of blocks.
pub(crate) const FIRST_OF_BLOCKS: u32 = 0x1C;
/// First handle of tables and their entries.
pub(crate) const FIRST_OF_TABLES: u32 = 0x20;

/// First handle of entities. Tables have fewer entries than the gap before it.
pub(crate) const FIRST_FREE: u32 = 0x200;

/// Writes the OBJECTS section.
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
