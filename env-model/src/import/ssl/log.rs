//! The messages of an SSL game log, one after the other.
//!
//! `SSL_LOG_FILE`, int32 version 1; then for each message int64 time of receipt (ns),
//! int32 type, int32 size, the payload. Big-endian.

use std::io::{self, Read};

use crate::import::stream::{Stream, explain};
use crate::import::{ImportError, Place};

const MAGIC: &[u8; 12] = b"SSL_LOG_FILE";
/// The most that a datagram holds, and every message that is read was one.
const MOST_PAYLOAD: usize = 65_535;

pub(super) const VISION_2010: i32 = 2;
pub(super) const REFEREE: i32 = 3;
pub(super) const VISION: i32 = 4;
/// 0 blank, 1 unknown, 2 vision 2010, 3 referee 2013, 4 vision 2014, 5 tracker 2020, 6 index 2021.
const TYPES: std::ops::RangeInclusive<i32> = 0..=6;

/// A log, read from its beginning.
pub(super) struct Log<'r> {
    file: &'r str,
    stream: Stream<'r>,
    payload: Vec<u8>,
}

/// What one message says.
pub(super) struct Message<'l> {
    pub kind: i32,
    pub place: Place,
    /// Empty for types that nobody here reads.
    pub payload: &'l [u8],
}

impl<'r> Log<'r> {
    pub(super) fn open(file: &'r str, log: impl Read + 'r) -> Result<Self, ImportError> {
        let stream = Stream::new(log).map_err(|e| ImportError::Log {
            file: file.to_owned(),
            place: Place::Byte { offset: 0, decompressed: false },
            message: explain(&e),
        })?;
        let mut log = Self { file, stream, payload: Vec::new() };
        let mut header = [0; 16];
        let read = log.fill(&mut header)?;
        let (magic, version) = header.split_at(MAGIC.len());
        if read < header.len() || magic != MAGIC {
            let found = String::from_utf8_lossy(&header[..read.min(MAGIC.len())]).into_owned();
            let message = format!("begins with {found:?}; expected SSL_LOG_FILE and a version (an SSL game log)");
            return Err(log.error(log.place_at(0), message));
        }
        if version != [0, 0, 0, 1] {
            let version = i32::from_be_bytes([version[0], version[1], version[2], version[3]]);
            return Err(log.error(log.place_at(12), format!("log version {version}; expected 1")));
        }
        Ok(log)
    }

    /// The next message; `None` at the end.
    pub(super) fn next(&mut self) -> Result<Option<Message<'_>>, ImportError> {
        let place = self.place();
        let mut header = [0; 16];
        match self.fill(&mut header)? {
            0 => return Ok(None),
            16 => {}
            read => {
                return Err(
                    self.error(place, format!("the log is cut short: {read} bytes of a message's header of 16"))
                );
            }
        }
        let int = |at: usize| i32::from_be_bytes([header[at], header[at + 1], header[at + 2], header[at + 3]]);
        let (kind, size) = (int(8), int(12));
        if !TYPES.contains(&kind) {
            return Err(self.error(place, format!("a message of type {kind}; expected 0 to 6")));
        }
        let Ok(size) = usize::try_from(size) else {
            return Err(self.error(place, format!("a message of {size} bytes; expected at least 0")));
        };
        let read = if matches!(kind, REFEREE | VISION) {
            if size > MOST_PAYLOAD {
                let message = format!("a message of {size} bytes; expected at most {MOST_PAYLOAD}, one datagram");
                return Err(self.error(place, message));
            }
            self.payload.resize(size, 0);
            self.stream.fill(&mut self.payload)
        } else {
            self.payload.clear();
            self.stream.skip(size as u64).map(|skipped| skipped as usize)
        };
        let read = read.map_err(|e| self.io_error(&e))?;
        if read < size {
            return Err(self.error(place, format!("the log is cut short: {read} bytes of a message of {size}")));
        }
        Ok(Some(Message { kind, place, payload: &self.payload }))
    }

    /// Where the log has been read to.
    pub(super) fn place(&self) -> Place {
        self.place_at(self.stream.offset())
    }

    fn place_at(&self, offset: u64) -> Place {
        Place::Byte { offset, decompressed: self.stream.decompressed() }
    }

    fn fill(&mut self, buffer: &mut [u8]) -> Result<usize, ImportError> {
        self.stream.fill(buffer).map_err(|e| self.io_error(&e))
    }

    fn io_error(&self, error: &io::Error) -> ImportError {
        self.error(self.place(), explain(error))
    }

    fn error(&self, place: Place, message: String) -> ImportError {
        ImportError::Log { file: self.file.to_owned(), place, message }
    }
}
