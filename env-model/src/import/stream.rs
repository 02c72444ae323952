//! A log as a stream of bytes: decompressed where need be, counted, bounded.

use std::io::{self, BufRead, BufReader, Cursor, ErrorKind, Read};

use flate2::bufread::GzDecoder;

/// Longest log, bytes after decompression. Matches take 1 to 2 GB; a few
/// megabytes of malice decompress to more than any time limit.
const MOST_BYTES: u64 = 4 << 30;

/// Longest line, bytes. The longest in use, server parameters, are about 2¹³ long.
const MOST_LINE: u64 = 1 << 20;

const GZIP_MAGIC: [u8; 2] = [0x1f, 0x8b];

/// Reads a log from its beginning, once.
pub(super) struct Stream<'r> {
    inner: Box<dyn BufRead + 'r>,
    offset: u64,
    decompressed: bool,
}

impl<'r> Stream<'r> {
    pub(super) fn new(mut reader: impl Read + 'r) -> io::Result<Self> {
        let mut magic = Vec::new();
        reader.by_ref().take(2).read_to_end(&mut magic)?;
        let decompressed = magic == GZIP_MAGIC;
        let whole = Cursor::new(magic).chain(reader);
        let inner: Box<dyn BufRead + 'r> = match decompressed {
            true => Box::new(BufReader::new(Members { current: Some(GzDecoder::new(BufReader::new(whole))) })),
            false => Box::new(BufReader::new(whole)),
        };
        Ok(Self { inner, offset: 0, decompressed })
    }

    /// Bytes read so far, after decompression.
    pub(super) fn offset(&self) -> u64 {
        self.offset
    }

    /// Whether offsets are those of the decompressed log.
    pub(super) fn decompressed(&self) -> bool {
        self.decompressed
    }

    /// Fills `buffer` as far as the log goes: less than all of it only at the end.
    pub(super) fn fill(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut filled = 0;
        while filled < buffer.len() {
            match self.inner.read(&mut buffer[filled..]) {
                Ok(0) => break,
                Ok(n) => filled += n,
                Err(e) if e.kind() == ErrorKind::Interrupted => {}
                Err(e) => return Err(e),
            }
        }
        self.count(filled as u64)?;
        Ok(filled)
    }

    /// Passes over `count` bytes; returns fewer only at the end.
    pub(super) fn skip(&mut self, count: u64) -> io::Result<u64> {
        let skipped = io::copy(&mut self.inner.by_ref().take(count), &mut io::sink())?;
        self.count(skipped)?;
        Ok(skipped)
    }

    /// Reads a line without its end into `line`; false when there is none left.
    pub(super) fn line(&mut self, line: &mut Vec<u8>) -> io::Result<bool> {
        line.clear();
        let read = self.inner.by_ref().take(MOST_LINE).read_until(b'\n', line)? as u64;
        self.count(read)?;
        if read == MOST_LINE && line.last() != Some(&b'\n') {
            return Err(io::Error::other(format!("a line of more than {MOST_LINE} bytes")));
        }
        while line.last().is_some_and(|b| matches!(b, b'\n' | b'\r')) {
            line.pop();
        }
        Ok(read > 0)
    }

    fn count(&mut self, read: u64) -> io::Result<()> {
        self.offset += read;
        if self.offset > MOST_BYTES {
            return Err(io::Error::other(format!("a log of more than {MOST_BYTES} bytes (decompressed)")));
        }
        Ok(())
    }
}

/// The parts of a gzip file, one after the other; there is nothing else in it.
struct Members<R> {
    /// `None` after the last.
    current: Option<GzDecoder<R>>,
}

impl<R: BufRead> Read for Members<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        while let Some(member) = &mut self.current {
            let read = member.read(buffer)?;
            if read > 0 || buffer.is_empty() {
                return Ok(read);
            }
            let Some(next) = member.get_mut().fill_buf()?.first().copied() else { break };
            if next != GZIP_MAGIC[0] {
                return Err(io::Error::other("trailing bytes after the end of the compressed log; expected none"));
            }
            self.current = self.current.take().map(|member| GzDecoder::new(member.into_inner()));
        }
        self.current = None;
        Ok(0)
    }
}

/// What an error of [`Stream`] says to the log's reader.
pub(super) fn explain(error: &io::Error) -> String {
    match error.kind() {
        // Plain files end without an error; only the decompressor misses something.
        ErrorKind::UnexpectedEof => "the compressed log is cut short".to_owned(),
        _ => format!("cannot be read: {error}"),
    }
}
