//! Tests of `ligne draw`: single models, batches, several views, framing and reports.

mod batch;
mod contact_sheets;
mod degenerate_parts;
mod draw_model;
mod framing;
mod hints;
mod section_and_explode;
mod shorthand;
mod step_file;
mod step_models;
mod web_pages;
