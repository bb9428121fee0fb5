//! [`PageFile`]: a page file, with each page read by the keys of its kind.
//!
//! `[page]` holds one page or several (`[[page]]`), each with `kind = "comic"` or `kind = "sheet"`. `pages`
//! names further page files, which are read in turn; cycles are errors.

use std::fs;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::comic::{self, ComicPage};
use super::composed_page::ComposedPage;
use super::model_reader::ModelReader;
use super::page_source::PageSource;
use super::print_inks::PrintInks;
use super::sheet::{self, SheetPage};
use crate::error::Error;
use crate::scene::Scene;
use crate::style::toml_reader::{self, TomlFault};

/// Kinds of page.
const PAGE_KINDS: [&str; 2] = ["comic", "sheet"];

/// Keys of a page file.
const FILE_KEYS: [&str; 2] = ["page", "pages"];

/// Maximum number of pages, including those of the files that it names.
const MAX_PAGES: usize = 2000;

/// A page file that has been read.
#[derive(Debug, Clone)]
pub struct PageFile {
    /// Each page with the file that contains it.
    pages: Vec<(PageSource, PageKind)>,
    /// The page files that were read.
    files: Vec<PathBuf>,
}

/// The keys of a page, by kind.
#[derive(Debug, Clone)]
enum PageKind {
    Comic(Box<ComicPage>),
    Sheet(Box<SheetPage>),
}

impl PageFile {
    /// Reads a page file and the files that it names.
    ///
    /// # Errors
    /// Returns an error if a file cannot be read or names itself. The error names the line, the wrong key and
    /// the nearest known key.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let mut read = Self { pages: Vec::new(), files: Vec::new() };
        read.add_file(path.as_ref().to_path_buf(), &mut Vec::new())?;
        Ok(read)
    }

    /// Reads the text of a page file. Paths in it are relative to the folder of `path`, which need not exist.
    ///
    /// # Errors
    /// The same as those of [`PageFile::open`].
    pub fn from_text(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let mut read = Self { pages: Vec::new(), files: Vec::new() };
        let source = PageSource {
            path: path.as_ref().to_path_buf(),
            text: text.to_owned(),
            models: ModelReader::default(),
        };
        read.add(source, &mut Vec::new())?;
        Ok(read)
    }

    /// Sets a reader for models in other formats; it returns `None` for formats that it does not support.
    #[must_use]
    pub fn reading_models(
        mut self,
        read: impl Fn(&Path) -> Result<Option<Scene>, Error> + Send + Sync + 'static,
    ) -> Self {
        let reader = ModelReader::new(read);
        for (source, _) in &mut self.pages {
            source.models = reader.clone();
        }
        self
    }

    /// Number of pages.
    #[must_use]
    pub fn len(&self) -> usize {
        self.pages.len()
    }

    /// Whether there are no pages; always false for a file that was read.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pages.is_empty()
    }

    /// The files that the pages are made from: page files, models, style sheets, camera records.
    #[must_use]
    pub fn inputs(&self) -> Vec<PathBuf> {
        let mut files = self.files.clone();
        for (source, kind) in &self.pages {
            files.extend(match kind {
                PageKind::Comic(page) => page.inputs(source),
                PageKind::Sheet(page) => page.inputs(source),
            });
        }
        files.sort();
        files.dedup();
        files
    }

    /// The inks that the pages request.
    ///
    /// # Errors
    /// Returns an error if a key is invalid, or differs from that of an earlier page.
    pub fn print(&self) -> Result<PrintInks, Error> {
        let mut print = PrintInks::default();
        for (source, kind) in &self.pages {
            if let PageKind::Comic(page) = kind {
                print.add(&page.print(), source)?;
            }
        }
        Ok(print)
    }

    /// Draws all pages in order.
    ///
    /// # Errors
    /// Returns an error with its line if a model, style, font or camera cannot be read, or keys contradict
    /// each other.
    pub fn compose(&self) -> Result<Vec<ComposedPage>, Error> {
        let compose = |(source, kind): &(PageSource, PageKind)| match kind {
            PageKind::Comic(page) => comic::compose(page, source),
            PageKind::Sheet(page) => sheet::compose(page, source),
        };
        self.pages.iter().map(compose).collect()
    }

    /// Reads a file; `above` are the files that lead to it.
    fn add_file(&mut self, path: PathBuf, above: &mut Vec<PathBuf>) -> Result<(), Error> {
        let bytes = fs::read(&path).map_err(|error| {
            Error::io("cannot read the page file", error)
                .in_file(&path)
                .remedy("check the path; `ligne page --new comic OUT.toml` writes a page file to start from")
        })?;
        let text = Error::utf8_text(bytes, &path, "the page file")?;
        self.files.push(path.clone());
        above.push(fs::canonicalize(&path).unwrap_or_else(|_| path.clone()));
        self.add(PageSource { path, text, models: ModelReader::default() }, above)?;
        above.pop();
        Ok(())
    }

    fn add(&mut self, source: PageSource, above: &mut Vec<PathBuf>) -> Result<(), Error> {
        let document = DeTable::parse(&source.text).map_err(|error| source.read_error(&error.into()))?;
        let mut pages = Vec::new();
        let mut named = None;
        for (key, value) in document.into_inner() {
            match &**key.get_ref() {
                "page" => pages = page_values(value),
                "pages" => named = Some(value),
                other => {
                    let word = Spanned::new(key.span(), other.to_owned());
                    return Err(source.unknown(&word, "key", &FILE_KEYS));
                }
            }
        }
        for page in pages {
            let kind = read_page(page, &source)?;
            self.pages.push((source.clone(), kind));
        }
        let named: Vec<Spanned<String>> = match named {
            Some(named) => read(named).map_err(|error| source.read_error(&error))?,
            None => Vec::new(),
        };
        for path in &named {
            let found = source.existing(path, "page file")?;
            if above.contains(&fs::canonicalize(&found).unwrap_or_else(|_| found.clone())) {
                let message = format!("`{}` leads back to a page file that names it", path.get_ref());
                return Err(source.fault(&path.span(), &message, "let no page file hold itself"));
            }
            self.add_file(found, above)?;
            if self.pages.len() > MAX_PAGES {
                let message = format!("these are more than {MAX_PAGES} pages");
                return Err(source.fault(&path.span(), &message, "part them into several files"));
            }
        }
        if self.pages.is_empty() {
            let advice = "begin a page with the line [page], then kind = \"comic\" or kind = \"sheet\"";
            return Err(Error::new("there is no page").in_file(&source.path).remedy(advice));
        }
        Ok(())
    }
}

/// The pages under the key `page`, one or more.
fn page_values(value: Spanned<DeValue>) -> Vec<Spanned<DeValue>> {
    let span = value.span();
    match value.into_inner() {
        DeValue::Array(pages) => pages.into_iter().collect(),
        one => vec![Spanned::new(span, one)],
    }
}

fn read<T: DeserializeOwned>(value: Spanned<DeValue>) -> Result<T, TomlFault> {
    toml_reader::from_value(value)
}

/// Reads one page by the keys of its `kind`.
fn read_page(mut page: Spanned<DeValue>, source: &PageSource) -> Result<PageKind, Error> {
    let span = page.span();
    let advice = "write kind = \"comic\" or kind = \"sheet\"";
    let DeValue::Table(table) = page.get_mut() else {
        return Err(source.fault(&span, "a page is a table", "begin it with a line [page]"));
    };
    let kind = table
        .remove("kind")
        .ok_or_else(|| source.fault(&span, "the kind of this page is missing", advice))?;
    let Some(name) = kind.get_ref().as_str() else {
        return Err(source.fault(&kind.span(), "this does not fit here", advice));
    };
    let made = match name {
        "comic" => read(page).map(|page| PageKind::Comic(Box::new(page))),
        "sheet" => read(page).map(|page| PageKind::Sheet(Box::new(page))),
        other => {
            let word = Spanned::new(kind.span(), other.to_owned());
            return Err(source.unknown(&word, "kind of page", &PAGE_KINDS));
        }
    };
    made.map_err(|error| source.read_error(&error))
}
