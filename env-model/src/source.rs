//! Errors in files that say where: file, line, column, what was expected.

use std::fmt;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A place in a text, both counted from 1; columns count characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Located {
    /// Line.
    pub line: usize,
    /// Column.
    pub column: usize,
}

impl Located {
    /// The place of byte `offset` in `text`.
    pub fn of(text: &str, offset: usize) -> Self {
        let mut offset = offset.min(text.len());
        while !text.is_char_boundary(offset) {
            offset -= 1;
        }
        let before = &text[..offset];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        Self { line: before.matches('\n').count() + 1, column: before[line_start..].chars().count() + 1 }
    }
}

/// What is wrong with a file, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileError {
    /// The file as the user named it.
    pub path: String,
    /// The place, when it is known.
    pub at: Option<Located>,
    /// What is wrong and what was expected.
    pub message: String,
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.at {
            Some(at) => write!(f, "{}:{}:{}: {}", self.path, at.line, at.column, self.message),
            None => write!(f, "{}: {}", self.path, self.message),
        }
    }
}

impl std::error::Error for FileError {}

/// A text and its name, from which errors are made.
#[derive(Debug, Clone, Copy)]
pub struct Source<'a> {
    /// The file as the user named it.
    pub path: &'a str,
    /// Its whole text.
    pub text: &'a str,
}

impl<'a> Source<'a> {
    /// An error at the beginning of `span`.
    pub fn error_at(&self, span: Range<usize>, message: impl Into<String>) -> FileError {
        FileError { path: self.path.to_owned(), at: Some(Located::of(self.text, span.start)), message: message.into() }
    }

    /// A TOML error with its place.
    pub fn toml_error(&self, error: &toml::de::Error) -> FileError {
        let at = error.span().map(|span| Located::of(self.text, span.start));
        FileError { path: self.path.to_owned(), at, message: error.message().replace('\n', "; ") }
    }

    /// Parses the text as TOML, keeping the place of every value.
    pub fn parse_toml(&self) -> Result<Spanned<DeTable<'a>>, FileError> {
        DeTable::parse(self.text).map_err(|e| self.toml_error(&e))
    }
}

/// One step into a TOML document.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Key<'a> {
    /// A table's key.
    Name(&'a str),
    /// An array's element.
    Index(usize),
}

/// The span of the value at `path`, or of the deepest part of `path` that exists.
pub fn span_of(table: &Spanned<DeTable<'_>>, path: &[Key<'_>]) -> Range<usize> {
    let mut span = table.span();
    let mut at: Option<&Spanned<DeValue<'_>>> = None;
    for key in path {
        let next = match (at, key) {
            (None, Key::Name(name)) => table.get_ref().get(*name),
            (Some(value), Key::Name(name)) => value.get_ref().get(name),
            (Some(value), Key::Index(i)) => value.get_ref().get(*i),
            (None, Key::Index(_)) => None,
        };
        let Some(next) = next else { break };
        span = next.span();
        at = Some(next);
    }
    span
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_from_one_and_in_characters() {
        let text = "a = 1\nname = \"球\" x";
        assert_eq!(Located::of(text, 0), Located { line: 1, column: 1 });
        let x = text.find('x').unwrap();
        assert_eq!(Located::of(text, x), Located { line: 2, column: 12 });
        assert_eq!(Located::of(text, 999).line, 2, "past the end is the end");
    }
}
