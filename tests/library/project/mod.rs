//! Rules of the source and of the built-in styles.

mod architecture;
mod public_items;
mod style_keys;
mod style_sheets;
