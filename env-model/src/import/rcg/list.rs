//! Bracketed lists, read left to right without recursion: nesting costs a counter.

use std::str::FromStr;

use super::unexpected;

/// A piece of a line.
pub(super) enum Token<'l> {
    Open,
    Close,
    /// A word, a number, or what stands between quotes.
    Atom(&'l [u8]),
}

/// What is left of a line.
pub(super) struct Reader<'l> {
    rest: &'l [u8],
}

const CUT_SHORT: &str = "the line is cut short";

impl<'l> Reader<'l> {
    pub(super) fn new(line: &'l [u8]) -> Self {
        Self { rest: line }
    }

    pub(super) fn token(&mut self) -> Result<Token<'l>, String> {
        self.rest = self.rest.trim_ascii_start();
        let (&first, after) = self.rest.split_first().ok_or(CUT_SHORT)?;
        let (token, rest) = match first {
            b'(' => (Token::Open, after),
            b')' => (Token::Close, after),
            b'"' => {
                let end = after.iter().position(|b| *b == b'"').ok_or(CUT_SHORT)?;
                (Token::Atom(&after[..end]), &after[end + 1..])
            }
            _ => {
                let ends = |b: &u8| b.is_ascii_whitespace() || b"()\"".contains(b);
                let (atom, rest) = self.rest.split_at(self.rest.iter().position(ends).unwrap_or(self.rest.len()));
                (Token::Atom(atom), rest)
            }
        };
        self.rest = rest;
        Ok(token)
    }

    pub(super) fn open(&mut self) -> Result<(), String> {
        match self.token()? {
            Token::Open => Ok(()),
            Token::Close => Err(unexpected(b")", "(")),
            Token::Atom(atom) => Err(unexpected(atom, "(")),
        }
    }

    pub(super) fn close(&mut self) -> Result<(), String> {
        match self.token()? {
            Token::Close => Ok(()),
            Token::Open => Err(unexpected(b"(", ")")),
            Token::Atom(atom) => Err(unexpected(atom, ")")),
        }
    }

    pub(super) fn atom(&mut self) -> Result<&'l [u8], String> {
        match self.token()? {
            Token::Atom(atom) => Ok(atom),
            Token::Open => Err(unexpected(b"(", "a word")),
            Token::Close => Err(unexpected(b")", "a word")),
        }
    }

    pub(super) fn number<T: FromStr>(&mut self, what: &str) -> Result<T, String> {
        let atom = self.atom()?;
        let number = str::from_utf8(atom).ok().and_then(|text| text.parse().ok());
        number.ok_or_else(|| unexpected(atom, what))
    }

    fn finite(&mut self) -> Result<f64, String> {
        let number: f64 = self.number("a number")?;
        if number.is_finite() { Ok(number) } else { Err(format!("found {number}; expected a finite number")) }
    }

    /// `x y`.
    pub(super) fn position(&mut self) -> Result<[f64; 2], String> {
        Ok([self.finite()?, self.finite()?])
    }

    /// A length above 0.
    pub(super) fn size(&mut self) -> Result<f64, String> {
        let size = self.finite()?;
        if size > 0.0 { Ok(size) } else { Err(format!("a size of {size}; expected a number above 0")) }
    }

    /// A player's state: hexadecimal, `0x` before all but 0.
    pub(super) fn state(&mut self) -> Result<u32, String> {
        let atom = self.atom()?;
        let digits = atom.strip_prefix(b"0x").unwrap_or(atom);
        let state = str::from_utf8(digits).ok().and_then(|text| u32::from_str_radix(text, 16).ok());
        state.ok_or_else(|| unexpected(atom, "a player's state such as 0x1"))
    }

    /// Passes over the rest of the list that is open, its end included.
    pub(super) fn close_after_rest(&mut self) -> Result<(), String> {
        let mut depth = 1_u64;
        while depth > 0 {
            match self.token()? {
                Token::Open => depth += 1,
                Token::Close => depth -= 1,
                Token::Atom(_) => {}
            }
        }
        Ok(())
    }

    /// The lists `(key …)` up to the end of the list that is open. `take` may read from what follows the key.
    pub(super) fn entries(
        &mut self,
        mut take: impl FnMut(&[u8], &mut Self) -> Result<(), String>,
    ) -> Result<(), String> {
        loop {
            match self.token()? {
                Token::Close => return Ok(()),
                Token::Open => {}
                Token::Atom(atom) => return Err(unexpected(atom, "(key value)")),
            }
            let key = self.atom()?;
            take(key, self)?;
            self.close_after_rest()?;
        }
    }

    /// Nothing may be left.
    pub(super) fn end(&self) -> Result<(), String> {
        match self.rest.trim_ascii() {
            [] => Ok(()),
            rest => Err(unexpected(rest, "the end of the line")),
        }
    }
}
