//! [`ModelReader`]: models in formats that only the caller can read.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use crate::error::Error;
use crate::scene::Scene;

type Read = dyn Fn(&Path) -> Result<Option<Scene>, Error> + Send + Sync;

/// Reads models in formats that only the caller can read; none unless set.
#[derive(Clone, Default)]
pub struct ModelReader(Option<Arc<Read>>);

impl ModelReader {
    /// A reader that returns `None` for models in other formats.
    pub fn new(read: impl Fn(&Path) -> Result<Option<Scene>, Error> + Send + Sync + 'static) -> Self {
        Self(Some(Arc::new(read)))
    }

    /// The model, if it is in such a format.
    ///
    /// # Errors
    /// Those of the reader.
    pub fn read(&self, path: &Path) -> Result<Option<Scene>, Error> {
        self.0.as_ref().map_or(Ok(None), |read| read(path))
    }
}

impl fmt::Debug for ModelReader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("ModelReader").field(&self.0.is_some()).finish()
    }
}
