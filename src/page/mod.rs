//! Pages: several drawings composed as comic panels or on a technical sheet, as a page file describes them.
//!
//! 1. [`page_file`] reads a page file and sends each page to the reader of its kind.
//! 2. [`comic`] draws a page of panels with speech balloons; [`sheet`] draws a technical sheet. Both draw
//!    models with [`figure`].
//! 3. The result is a `ComposedPage`: a composition in mm and its warnings.
//!
//! Files, in reading order: [`page_file`]; [`page_source`] for errors and paths; [`page_size`] and
//! [`mm_length`] for values; `tolerances`; [`print_inks`]; [`model_reader`] for formats of the caller;
//! [`composed_page`].
//!
//! Folders: [`figure`] (models, camera, style), [`layout`] (panels of a page), [`balloon_placement`] (places
//! of speech balloons, for `comic::lettering`), [`comic`], [`sheet`] (its numbered balloons are in
//! `sheet::part_balloons`).
//!
//! ```
//! use ligne::page::PageFile;
//!
//! let file = PageFile::from_text("[page]\nkind = 'comic'\nsize = 'A5'\nlayout = '1 / 1'\n", "a.toml")?;
//! let [page] = file.compose()?.try_into().map_err(|_| ligne::Error::new("one page"))?;
//! assert_eq!([page.composition.page.width, page.composition.page.height], [148.0, 210.0]);
//! # Ok::<(), ligne::Error>(())
//! ```

pub(crate) mod balloon_placement;
pub(crate) mod comic;
pub(crate) mod composed_page;
pub(crate) mod figure;
pub(crate) mod layout;
pub(crate) mod mm_length;
pub(crate) mod model_reader;
pub(crate) mod page_file;
pub(crate) mod page_size;
pub(crate) mod page_source;
pub(crate) mod print_inks;
pub(crate) mod sheet;
mod tolerances;

pub use composed_page::ComposedPage;
pub use model_reader::ModelReader;
pub use page_file::PageFile;
pub use page_source::PageSource;
pub use print_inks::PrintInks;
