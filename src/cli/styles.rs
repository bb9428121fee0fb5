//! `ligne styles`: the built-in styles, or the text of one.

use clap::Args;

use super::print;
use crate::error::Error;
use crate::style::Style;

/// What was typed.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  ligne styles                        list the styles
  ligne styles ink > mine.toml        start a style of your own")]
pub(super) struct StylesArgs {
    /// The style whose text is shown
    name: Option<String>,
}

/// Lists the styles with the idea of each, or shows a sheet.
pub(super) fn run(args: &StylesArgs) -> Result<(), Error> {
    let names: Vec<&str> = Style::names().collect();
    let Some(name) = &args.name else {
        let width = names.iter().map(|name| name.len()).max().unwrap_or(0);
        let mut list = String::new();
        for name in names {
            let idea = Style::idea(name).unwrap_or_default();
            list.push_str(format!("{name:width$}  {idea}").trim_end());
            list.push('\n');
        }
        return print(list.as_bytes());
    };
    let text = Style::sheet_text(name).ok_or_else(|| {
        Error::new(format!("there is no built-in style `{name}`"))
            .remedy(format!("the styles are {}", names.join(", ")))
    })?;
    print(text.as_bytes())
}
