//! Fixed handles of release 2000, and the OBJECTS section.

use super::group_codes::GroupCodes;

/// Handle of the root dictionary.
const ROOT_DICTIONARY: u32 = 0xC;
/// Handle of the group dictionary.
const GROUP_DICTIONARY: u32 = 0xD;

/// Handle of the block record of model space.
pub(crate) const MODEL_SPACE: u32 = 0x1A;
/// Handle of the block record of paper space.
pub(crate) const PAPER_SPACE: u32 = 0x1B;

/// First handle of blocks.
pub(crate) const FIRST_BLOCK_HANDLE: u32 = 0x1C;
/// First handle of tables and their entries.
pub(crate) const FIRST_TABLE_HANDLE: u32 = 0x20;

/// First handle of entities. Tables have fewer entries than the gap before it.
pub(crate) const FIRST_ENTITY_HANDLE: u32 = 0x200;

/// Writes the OBJECTS section.
pub(crate) fn write(tags: &mut GroupCodes) {
    tags.section("OBJECTS");
    dictionary(tags, ROOT_DICTIONARY, 0);
    tags.text(3, "ACAD_GROUP");
    tags.handle(350, GROUP_DICTIONARY);
    dictionary(tags, GROUP_DICTIONARY, ROOT_DICTIONARY);
    tags.end_section();
}

fn dictionary(tags: &mut GroupCodes, handle: u32, owner: u32) {
    tags.text(0, "DICTIONARY");
    tags.handle(5, handle);
    tags.handle(330, owner);
    tags.text(100, "AcDbDictionary");
    tags.whole(281, 1);
}
