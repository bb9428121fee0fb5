//! [`CompletionValues`]: values for shell completion of an option that also accepts other values.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Arg, Command, Error};

/// Parser with a list of values for shell completion.
#[derive(Clone)]
pub(crate) struct CompletionValues<T> {
    values: Vec<&'static str>,
    /// Values that are computed when needed.
    late: Option<fn() -> &'static [&'static str]>,
    parse: fn(&str) -> Result<T, String>,
}

impl<T> CompletionValues<T> {
    pub(crate) fn new(
        values: impl IntoIterator<Item = &'static str>,
        parse: fn(&str) -> Result<T, String>,
    ) -> Self {
        Self { values: values.into_iter().collect(), late: None, parse }
    }

    /// Parser whose completion values are computed when needed.
    pub(crate) fn late(
        values: fn() -> &'static [&'static str],
        parse: fn(&str) -> Result<T, String>,
    ) -> Self {
        Self { values: Vec::new(), late: Some(values), parse }
    }
}

impl<T: Clone + Send + Sync + 'static> TypedValueParser for CompletionValues<T> {
    type Value = T;

    fn parse_ref(&self, command: &Command, option: Option<&Arg>, value: &OsStr) -> Result<T, Error> {
        let Some(text) = value.to_str() else {
            return Err(Error::new(ErrorKind::InvalidUtf8).with_cmd(command));
        };
        (self.parse)(text).map_err(|message| {
            let option = option.map(ToString::to_string).unwrap_or_default();
            let message = format!("invalid value '{text}' for '{option}': {message}\n");
            Error::raw(ErrorKind::ValueValidation, message).with_cmd(command)
        })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let late = self.late.map_or(&[][..], |values| values());
        Some(Box::new(self.values.iter().chain(late).map(PossibleValue::new)))
    }
}
