//! Compact lists for data that is indexed by number.
//!
//! Files: [`csr_lists`] lists of lists in compressed sparse row (CSR) form, filled by a counting sort;
//! [`disjoint_sets`] concurrent union-find; [`group_sums`] parallel sums over groups; [`linked_lines`] pieces
//! followed from link to link.

pub(crate) mod csr_lists;
pub(crate) mod disjoint_sets;
pub(crate) mod group_sums;
pub(crate) mod linked_lines;
