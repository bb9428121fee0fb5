//! `ligne diff` and `ligne test`: findings, causes, cases and approval.

mod diff_causes;
mod diff_command;
mod test_cases;
