//! Buffers of a view: they propose, exact geometry decides.
