//! Bytes: a [`crate::drawing::Drawing`] as SVG or PNG.
