//! Tests of the comparison of drawings: verdicts, common causes, bounded work, and the canonical form of SVG.

mod approved_drawings;
mod canonical_form;
mod canonical_form_of_others;
mod causes;
mod comparison_properties;
mod hostile_files;
mod picture_changes;
mod verdicts;
