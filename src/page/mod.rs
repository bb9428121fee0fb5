//! Pages: several drawings composed as comic panels or on a technical sheet, as a page file says.
//!
//! ```
//! use ligne::page::PageFile;
//!
//! let file = PageFile::from_text("[page]\nkind = 'comic'\nsize = 'A5'\nlayout = '1 / 1'\n", "a.toml")?;
//! let [page] = file.compose()?.try_into().map_err(|_| ligne::Error::new("one page"))?;
//! assert_eq!([page.composition.page.width, page.composition.page.height], [148.0, 210.0]);
//! # Ok::<(), ligne::Error>(())
//! ```

pub mod comic;
pub mod composed;
pub mod figure;
pub mod file;
pub mod layout;
pub mod length;
pub mod model_reader;
pub mod placing;
pub mod print;
pub mod sheet;
pub mod size;
pub mod source;

pub use composed::Composed;
pub use file::PageFile;
pub use model_reader::ModelReader;
pub use print::Print;
pub use source::Source;
