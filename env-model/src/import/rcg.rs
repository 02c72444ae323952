//! `RoboCup` 2D game logs (`.rcg`), text versions 4 to 6 (`ULG4` … `ULG6`).
//!
//! A line a message: `(server_param (key value)…)`, `(player_type (id 3)(player_size 0.3)…)`,
//! `(show T ((b) x y vx vy) ((l 1) type 0xSTATE x y …)…)`; metres, the left team
//! defends the goal at x < 0 throughout. While play is stopped the server shows
//! a cycle several times: the first one counts. Players of state 0 are
//! disabled, that is, not on the field. The bytes of `(f l 3)` and `(fl 3)`,
//! whichever a program writes, and all else that follows a position are passed
//! over. The pitch is 105 × 68 m and players have a radius of 0.3 m, unless the
//! log's parameters say otherwise; the free margin is 5 m wide.
//!
//! Format: rcssserver and rcssmonitor of the `RoboCup` Soccer Simulator.

mod list;

use std::collections::BTreeMap;
use std::io::{self, Read};

use super::instant::{Body, Instant, Pitch};
use super::stream::{Stream, explain};
use super::{ImportError, Imported, Place, Side};
use crate::{Point, Scene};
use list::{Reader, Token};

/// A server sends 18; a log of nothing else must not fill the memory.
const MOST_PLAYER_TYPES: usize = 1000;

/// Some editors put it in front of UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// What to take from a log.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// What names of scenes begin with; cycle 120 of the left side becomes `NAME-c0120-left`.
    pub name: &'a str,
    /// A scene for each of these cycles, in this order.
    pub cycles: &'a [u64],
    /// Whose robot is the start: the player of this side nearest to the ball (ties: the lower number).
    pub side: Side,
    /// The goal, metres; `None` for the centre of the goal mouth that the side attacks.
    pub target: Option<[f64; 2]>,
}

/// The scenes of `request` in `log`, which messages call `file`. Reads to the end of the log.
///
/// Start: see [`Request::side`]. Obstacles: all other players, discs of their type's
/// size, labelled `opponent 3` or `teammate 3`. Field: the pitch with its margin. A player
/// who overlaps the start is drawn smaller and a note says so.
///
/// Errors: a log that cannot be read, with the line; a cycle that the log has not, or in
/// which the side has no player, or that makes no valid scene.
pub fn scenes(file: &str, log: impl Read, request: &Request<'_>) -> Result<Imported, ImportError> {
    let log = read(file, log, request.cycles)?;
    let mut notes = Vec::new();
    let scene = |&cycle: &u64| {
        let instant = |place, message| ImportError::Instant {
            file: file.to_owned(),
            place,
            unit: "cycle",
            number: cycle,
            message,
        };
        let Some(show) = log.shows.get(&cycle) else {
            return Err(instant(None, log.absent(cycle)));
        };
        log.scene(cycle, show, request, &mut notes).map_err(|message| instant(Some(Place::Line(show.line)), message))
    };
    let scenes = request.cycles.iter().map(scene).collect::<Result<_, _>>()?;
    Ok(Imported { scenes, notes })
}

/// What is kept of a log.
struct Log {
    pitch: Pitch,
    player_size: f64,
    /// By id, for the types that say it.
    type_sizes: BTreeMap<i64, f64>,
    /// The first `show` of each wanted cycle.
    shows: BTreeMap<u64, Show>,
    /// First and last cycle in the log.
    range: Option<(u64, u64)>,
}

struct Show {
    line: u64,
    ball: [f64; 2],
    /// Those on the field.
    players: Vec<Player>,
}

struct Player {
    side: Side,
    number: u8,
    kind: i64,
    at: [f64; 2],
}

fn read(file: &str, log: impl Read, wanted: &[u64]) -> Result<Log, ImportError> {
    let mut number = 1;
    let at = |line: u64, message: String| ImportError::Log { file: file.to_owned(), place: Place::Line(line), message };
    let io_at = |line: u64| move |e: io::Error| at(line, explain(&e));
    let mut stream = Stream::new(log).map_err(io_at(1))?;
    let mut line = Vec::new();
    stream.line(&mut line).map_err(io_at(1))?;
    if line.starts_with(BYTE_ORDER_MARK) {
        line.drain(..BYTE_ORDER_MARK.len());
    }
    if !matches!(&line[..], b"ULG4" | b"ULG5" | b"ULG6") {
        let found = String::from_utf8_lossy(&line[..line.len().min(8)]).into_owned();
        return Err(at(1, format!("begins with {found:?}; expected ULG4, ULG5 or ULG6 (a text log of RoboCup 2D)")));
    }
    let mut log = Log {
        pitch: Pitch { length: 105.0, width: 68.0, margin: 5.0 },
        player_size: 0.3,
        type_sizes: BTreeMap::new(),
        shows: BTreeMap::new(),
        range: None,
    };
    loop {
        number += 1;
        if !stream.line(&mut line).map_err(io_at(number))? {
            break;
        }
        if !line.is_empty() {
            log.take(number, &line, wanted).map_err(|message| at(number, message))?;
        }
    }
    if log.range.is_none() {
        return Err(at(number, "the log ends without any (show …) line".to_owned()));
    }
    Ok(log)
}

impl Log {
    /// Takes what is of interest from a line.
    fn take(&mut self, number: u64, line: &[u8], wanted: &[u64]) -> Result<(), String> {
        let mut reader = Reader::new(line);
        reader.open()?;
        match reader.atom()? {
            b"show" => {
                let cycle: u64 = reader.number("a cycle")?;
                let show = Show::read(number, &mut reader)?;
                let (first, last) = self.range.unwrap_or((cycle, cycle));
                self.range = Some((first.min(cycle), last.max(cycle)));
                if wanted.contains(&cycle) {
                    self.shows.entry(cycle).or_insert(show);
                }
            }
            b"server_param" => reader.entries(|key, reader| {
                let size = match key {
                    b"player_size" => &mut self.player_size,
                    b"pitch_length" => &mut self.pitch.length,
                    b"pitch_width" => &mut self.pitch.width,
                    b"pitch_margin" => &mut self.pitch.margin,
                    _ => return Ok(()),
                };
                *size = reader.size()?;
                Ok(())
            })?,
            b"player_type" => {
                let (mut id, mut size) = (None, None);
                reader.entries(|key, reader| {
                    match key {
                        b"id" => id = Some(reader.number("a player type")?),
                        b"player_size" => size = Some(reader.size()?),
                        _ => {}
                    }
                    Ok(())
                })?;
                if let (Some(id), Some(size)) = (id, size) {
                    self.type_sizes.insert(id, size);
                }
                if self.type_sizes.len() > MOST_PLAYER_TYPES {
                    return Err(format!("player type {MOST_PLAYER_TYPES} and one more; expected fewer"));
                }
            }
            // What coaches and referees say need not be a list.
            b"msg" => return if line.ends_with(b")") { Ok(()) } else { Err("the line is cut short".to_owned()) },
            _ => reader.close_after_rest()?,
        }
        reader.end()
    }

    /// What to say when `cycle` is not in the log.
    fn absent(&self, cycle: u64) -> String {
        let (first, last) = self.range.expect("a log without shows is refused");
        let skipped = if (first..=last).contains(&cycle) { ", this one left out" } else { "" };
        format!("not in the log; expected cycles from {first} to {last}{skipped}")
    }

    fn radius(&self, player: &Player) -> f64 {
        self.type_sizes.get(&player.kind).copied().unwrap_or(self.player_size)
    }

    fn scene(&self, cycle: u64, show: &Show, request: &Request<'_>, notes: &mut Vec<String>) -> Result<Scene, String> {
        let &Request { name, side, target, .. } = request;
        let from_ball = |p: &Player| (Point::from(p.at) - Point::from(show.ball)).norm_squared();
        let own = show.players.iter().filter(|p| p.side == side);
        let robot = own.min_by(|p, q| from_ball(p).total_cmp(&from_ball(q)).then(p.number.cmp(&q.number)));
        let Some(robot) = robot else {
            return Err(format!("the {} side has no player on the field; expected at least one", side.name()));
        };
        let body = |p: &Player| Body {
            centre: p.at,
            radius: self.radius(p),
            label: format!("{} {}", if p.side == side { "teammate" } else { "opponent" }, p.number),
        };
        let others = show.players.iter().filter(|p| (p.side, p.number) != (side, robot.number));
        let instant = Instant {
            name: format!("{name}-c{cycle:04}-{}", side.name()),
            pitch: self.pitch,
            robot: body(robot),
            others: others.map(body).collect(),
            goal: target.unwrap_or(self.pitch.goal(side.opposite())),
        };
        instant.scene(notes)
    }
}

impl Show {
    /// What follows `(show T`: `((b) x y …)`, `((l 1) type state x y …)`, and in old logs `(pm …)` or `(tm …)`.
    fn read(line: u64, reader: &mut Reader<'_>) -> Result<Self, String> {
        let mut ball = None;
        let mut players: Vec<Player> = Vec::new();
        loop {
            match reader.token()? {
                Token::Close => break,
                Token::Open => {}
                Token::Atom(atom) => return Err(unexpected(atom, "a list")),
            }
            match reader.token()? {
                Token::Open => {}
                Token::Atom(_) => {
                    reader.close_after_rest()?;
                    continue;
                }
                Token::Close => return Err("an empty list; expected a player or the ball".to_owned()),
            }
            let side = match reader.atom()? {
                b"b" => {
                    reader.close()?;
                    if ball.replace(reader.position()?).is_some() {
                        return Err("a second ball; expected one".to_owned());
                    }
                    reader.close_after_rest()?;
                    continue;
                }
                b"l" => Side::Left,
                b"r" => Side::Right,
                other => return Err(unexpected(other, "b, l or r")),
            };
            let number: u8 = reader.number("a player's number")?;
            if !(1..=11).contains(&number) {
                return Err(format!("player {number}; expected 1 to 11"));
            }
            reader.close()?;
            let kind = reader.number("a player type")?;
            let state = reader.state()?;
            let at = reader.position()?;
            reader.close_after_rest()?;
            if players.iter().any(|p| (p.side, p.number) == (side, number)) {
                return Err(format!("player {number} of the {} side twice; expected once", side.name()));
            }
            if state != 0 {
                players.push(Player { side, number, kind, at });
            }
        }
        let ball = ball.ok_or("a cycle without a ball; expected ((b) x y …)")?;
        Ok(Self { line, ball, players })
    }
}

fn unexpected(found: &[u8], expected: &str) -> String {
    format!("found {:?}; expected {expected}", String::from_utf8_lossy(&found[..found.len().min(40)]))
}
