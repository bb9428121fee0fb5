//! The parts list: equal parts of a scene are counted as one item.
//!
//! 1. [`parts_list_items`] groups parts of one material by geometry or name, if their shapes are congruent.
//! 2. `congruence` compares two shapes up to a rotation and a translation, within the rounding of the file.
//! 3. `parts_list_file` replaces the rows by those of a CSV or TOML file, if the page names one.
//!
//! The table is drawn by `frame::parts_table`.

mod congruence;
pub(crate) mod parts_list_file;
pub(crate) mod parts_list_items;
