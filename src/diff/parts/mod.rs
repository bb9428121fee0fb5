//! Parts as a whole: those that have another name.
//!
//! 1. A part of the old drawing and one of the new drawing are one part if neither name is in the other drawing, and every mark that
//!    lies where it lay and lost the one name has the other.
//! 2. The old drawing is compared again with the new name, so that what else became of the part is told of it.
//! 3. The name itself is one finding.

mod renamed;

pub(super) use self::renamed::{Renamed, renamed};
