//! `ligne styles`: the built-in styles, or the text of one.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{print, styles_sheet};
use crate::error::Error;
use crate::style::Style;

/// What was typed.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  ligne styles                            list the styles
  ligne styles ink > mine.toml            start your own style
  ligne styles --sheet all.svg gear.obj   draw a model in all styles, side by side")]
pub(super) struct StylesArgs {
    /// Style to print; with --sheet, the model to draw
    #[arg(value_name = "NAME|MODEL")]
    name: Option<String>,

    /// Draw a model in all styles on one sheet: .svg, .svgz, .png or .pdf; - for SVG on standard output
    #[arg(long, value_name = "OUT", requires = "name")]
    sheet: Option<PathBuf>,
}

/// Lists the styles with the idea of each, or shows a sheet.
pub(super) fn run(args: &StylesArgs) -> Result<(), Error> {
    if let (Some(out), Some(model)) = (&args.sheet, &args.name) {
        return styles_sheet::run(out, Path::new(model));
    }
    let names = Style::names().collect::<Vec<_>>();
    let Some(name) = &args.name else {
        let width = names.iter().map(|name| name.len()).max().unwrap_or(0);
        let mut list = String::new();
        for name in names {
            let idea = Style::sheet_text(name).map_or("", idea);
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

/// The idea of a sheet: its first comment line.
fn idea(sheet: &str) -> &str {
    sheet.lines().find_map(|line| line.trim().strip_prefix('#')).map_or("", str::trim)
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_idea_is_the_first_comment() {
        assert_eq!(super::idea("\n# Black ink.\n# More.\nseed = 1 # no"), "Black ink.");
        assert_eq!(super::idea("seed = 1"), "");
    }
}
