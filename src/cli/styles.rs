//! `ligne styles`: lists the built-in styles, prints one, or draws a model in many.

use clap::Args;

use super::draw::contact_sheet;
use super::options::style_keys;
use super::print;
use crate::cli::draw::contact_sheet::StyleSheetArgs;
use crate::error::Error;
use crate::style::Style;

/// Options of `ligne styles`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  ligne styles                            list the styles
  ligne styles ink > mine.toml            start your own style
  ligne styles ink --all                  list every key of a style, with its value and help
  ligne styles --keys 'lines.*'           list keys with type, default and allowed values
  ligne styles --sheet all.svg gear.obj   draw a model in all styles, side by side
  ligne styles --sheet some.png gear.obj --style 'ink,*pencil*,mine.toml' --azimuth -20 --size 400")]
pub(crate) struct StylesArgs {
    /// Style to print; with --sheet, the model to draw
    #[arg(value_name = "NAME|MODEL")]
    name: Option<String>,

    #[command(flatten)]
    sheet: StyleSheetArgs,

    /// Print every key of a style, with its value and help; NAME may be a style sheet
    #[arg(long, requires = "name", conflicts_with = "sheet")]
    all: bool,

    /// List style keys that match, such as 'pen.*' [default: all]
    #[arg(long, value_name = "GLOB", num_args = 0..=1, default_missing_value = "*",
        conflicts_with_all = ["name", "sheet", "all"])]
    keys: Option<String>,

    /// Print the keys of --keys as JSON
    #[arg(long, requires = "keys")]
    json: bool,

    /// Print the page docs/reference/style-keys.md
    #[arg(long, hide = true, requires = "keys", conflicts_with = "json")]
    reference: bool,
}

/// Lists the styles with their descriptions, prints a style or its keys, or draws a sheet.
pub(crate) fn run(args: &StylesArgs) -> Result<(), Error> {
    if let (Some(out), Some(model)) = (&args.sheet.sheet, &args.name) {
        return contact_sheet::of_styles(&args.sheet, out, model);
    }
    if let Some(glob) = &args.keys {
        return print(style_keys::list(glob, args.json, args.reference)?.as_bytes());
    }
    if let Some(name) = args.name.as_ref().filter(|_| args.all) {
        return print(Style::full_sheet(name)?.as_bytes());
    }
    let names = Style::names().collect::<Vec<_>>();
    let Some(name) = &args.name else {
        let width = names.iter().map(|name| name.len()).max().unwrap_or(0);
        let mut list = String::new();
        for name in names {
            let idea = Style::sheet_text(name).map_or("", sheet_summary);
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

/// Description of a style sheet: its first comment line.
fn sheet_summary(sheet: &str) -> &str {
    sheet.lines().find_map(|line| line.trim().strip_prefix('#')).map_or("", str::trim)
}

#[cfg(test)]
mod tests {
    #[test]
    fn sheet_summary_is_the_first_comment() {
        assert_eq!(super::sheet_summary("\n# Black ink.\n# More.\nseed = 1 # no"), "Black ink.");
        assert_eq!(super::sheet_summary("seed = 1"), "");
    }
}
