//! [`ModelReader`]: reads models in formats that only the caller supports.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use crate::error::Error;
use crate::scene::Scene;

type ReadModel = dyn Fn(&Path) -> Result<Option<Scene>, Error> + Send + Sync;

/// A function that reads models in further formats; by default there is none.
#[derive(Clone, Default)]
pub struct ModelReader(Option<Arc<ReadModel>>);

impl ModelReader {
    /// Wraps a function that returns `None` for formats that it does not support.
    pub fn new(read: impl Fn(&Path) -> Result<Option<Scene>, Error> + Send + Sync + 'static) -> Self {
        Self(Some(Arc::new(read)))
    }

    /// Reads a model; `None` if its format is not supported.
    ///
    /// # Errors
    /// The errors of the wrapped function.
    pub fn read(&self, path: &Path) -> Result<Option<Scene>, Error> {
        self.0.as_ref().map_or(Ok(None), |read| read(path))
    }
}

impl fmt::Debug for ModelReader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("ModelReader").field(&self.0.is_some()).finish()
    }
}
