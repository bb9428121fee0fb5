//! Compact lists for data that is indexed by number.
//!
//! Files: [`csr_lists`] lists of lists in compressed sparse row (CSR) form, filled by a counting sort;
//! [`rank_bitset`] a set of numbers, one bit each, that counts its members before a number in constant time.

pub(crate) mod csr_lists;
pub(crate) mod rank_bitset;
