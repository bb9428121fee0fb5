//! One view: the visibility of its lines, and its place on the page.
//!
//! 1. The surface is refined for the camera and projected; feature lines and tone borders are found.
//! 2. The view map decides what is visible ([`visibility_pass`]).
//! 3. The camera's frame is centred on the page ([`page_transform`]).
//!
//! Files, in reading order: [`visibility_pass`]; [`page_transform`].

pub(crate) mod page_transform;
pub(crate) mod visibility_pass;
