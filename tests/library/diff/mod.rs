//! Comparison of drawings: verdicts, causes, bounded work, and the canonical form.

mod approved_drawings;
mod canonical_form;
mod canonical_form_of_others;
mod causes;
mod comparison_properties;
mod hostile_files;
mod picture_changes;
mod verdicts;
