//! Exit status of errors: whether to correct the input or to repeat the call.

use std::error::Error as _;
use std::io::{self, ErrorKind};

use crate::cli::{EXIT_TRY_LATER, EXIT_WRONG};
use crate::error::{self, Error};

/// I/O errors that persist until the user intervenes.
const PERMANENT_ERRORS: [ErrorKind; 11] = [
    ErrorKind::NotFound,
    ErrorKind::PermissionDenied,
    ErrorKind::AlreadyExists,
    ErrorKind::IsADirectory,
    ErrorKind::NotADirectory,
    ErrorKind::DirectoryNotEmpty,
    ErrorKind::InvalidInput,
    ErrorKind::InvalidData,
    ErrorKind::InvalidFilename,
    ErrorKind::UnexpectedEof,
    ErrorKind::Unsupported,
];

/// Exit status for an error.
pub(crate) fn of_error(error: &Error) -> u8 {
    if is_temporary(error) { EXIT_TRY_LATER } else { EXIT_WRONG }
}

/// Whether the same call may succeed later.
pub(crate) fn is_temporary(error: &Error) -> bool {
    let source = error.source().and_then(|source| source.downcast_ref::<io::Error>());
    error.kind == error::ErrorKind::Io
        && source.is_some_and(|source| !PERMANENT_ERRORS.contains(&source.kind()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exit_status_separates_temporary_from_permanent_errors() {
        let of = |kind: ErrorKind| of_error(&Error::io("cannot write", kind.into()));
        assert_eq!(
            [ErrorKind::StorageFull, ErrorKind::TimedOut, ErrorKind::Other].map(of),
            [EXIT_TRY_LATER; 3]
        );
        assert_eq!([ErrorKind::NotFound, ErrorKind::IsADirectory].map(of), [EXIT_WRONG; 2]);
        assert_eq!(of_error(&Error::new("the file is empty")), EXIT_WRONG);
    }
}
