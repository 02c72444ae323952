//! Game logs of the Small Size League (`.log`): SSL-Vision packets as they were sent.
//!
//! Frames are counted from 0 through the whole log, empty ones included, after the
//! packets of several cameras are merged (`capture`); the frame numbers that
//! cameras send are not used. A robot seen by two cameras is where the more
//! confident one saw it (ties: the one that came first); a robot without a number
//! is an obstacle each time it is seen. The pitch is that of the last usable
//! geometry in the log, wherever it stands. Millimetres become metres.
//!
//! Format: SSL game-log and SSL-Vision protocols of the `RoboCup` Small Size League.

mod capture;
mod geometry;
mod log;
mod messages;

use std::collections::{BTreeMap, BTreeSet};
use std::io::Read;

use prost::Message as _;
use serde::Deserialize;

use super::instant::{Body, Instant};
use super::{ImportError, Imported, Place, Side};
use crate::Scene;
use capture::{Captures, MOST_CAMERAS};
use geometry::Geometry;
use messages::{DetectionFrame, DetectionRobot, Referee, WrapperPacket};

/// In logs that do not say: blue defends the half of x < 0.
const BLUE_ATTACKS: Side = Side::Right;

/// One of the two teams.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Team {
    /// Blue markers.
    Blue,
    /// Yellow markers.
    Yellow,
}

impl Team {
    /// The name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Blue => "blue",
            Self::Yellow => "yellow",
        }
    }

    /// The goal that this team attacks when blue attacks `blue`.
    const fn attacks(self, blue: Side) -> Side {
        match self {
            Self::Blue => blue,
            Self::Yellow => blue.opposite(),
        }
    }
}

/// What to take from a log.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// What names of scenes begin with; frame 10 of blue 3 becomes `NAME-f0010-blue3`.
    pub name: &'a str,
    /// A scene for each of these frames, in this order.
    pub frames: &'a [u64],
    /// Whose robot is the start.
    pub team: Team,
    /// The robot that is the start.
    pub robot: u32,
    /// The side whose goal the team attacks; `None` to find out, see [`scenes`].
    pub attack: Option<Side>,
    /// The goal, metres; `None` for the centre of the goal mouth that the team attacks.
    pub target: Option<[f64; 2]>,
}

/// The scenes of `request` in `log`, which messages call `file`. Reads to the end of the log.
///
/// Start: the robot. Obstacles: all other robots, opponents first, by number, discs of
/// the geometry's `max_robot_radius` (0.09 m where it is unset), labelled `opponent 3` or
/// `teammate 3`. Field: the pitch with its boundary (0.3 m where it is unset). A robot
/// that overlaps the start is drawn smaller and a note says so.
///
/// Vision does not say which goal a team attacks. Unless [`Request::attack`] does, the
/// last word of the referee before the frame counts, or else the first after it; in a log
/// without a referee blue attacks the right goal (the referee's `blue_team_on_positive_half`
/// at its default), and a note says so. It is not guessed from where the robots
/// stand, which would change from frame to frame.
///
/// Errors: a log that cannot be read, with the byte; a frame that the log has not or in
/// which the robot is missing, or that makes no valid scene.
pub fn scenes(file: &str, log: impl Read, request: &Request<'_>) -> Result<Imported, ImportError> {
    let log = Match::read(file, log, request.frames)?;
    let mut notes = Vec::new();
    let scene = |&number: &u64| {
        let frame = log.frames.get(&number);
        let place = frame.map(|frame| frame.place);
        let made = match frame {
            Some(frame) => log.scene(number, frame, request, &mut notes),
            None => Err(match log.count {
                0 => "not in the log; it has no frames at all".to_owned(),
                count => format!("not in the log; expected frames from 0 to {}", count - 1),
            }),
        };
        made.map_err(|message| ImportError::Instant { file: file.to_owned(), place, unit: "frame", number, message })
    };
    let scenes = request.frames.iter().map(scene).collect::<Result<_, _>>()?;
    notes.extend(log.guess(request));
    Ok(Imported { scenes, notes })
}

/// What is kept of a log.
struct Match {
    geometry: Geometry,
    /// Frames in the log.
    count: u64,
    /// The wanted ones.
    frames: BTreeMap<u64, Frame>,
    /// The goal that blue attacks, by the referee's first word.
    first_referee: Option<Side>,
}

struct Frame {
    /// Its first packet.
    place: Place,
    robots: BTreeMap<(Team, u32), Seen>,
    unnumbered: Vec<(Team, Seen)>,
    /// The goal that blue attacks, by the referee's last word before the frame.
    referee: Option<Side>,
}

#[derive(Debug, Clone, Copy)]
struct Seen {
    /// Metres.
    at: [f64; 2],
    confidence: f32,
}

impl Match {
    fn read(file: &str, log: impl Read, wanted: &[u64]) -> Result<Self, ImportError> {
        let wanted: BTreeSet<u64> = wanted.iter().copied().collect();
        let mut seen = Sightings { captures: Captures::new(), frames: BTreeMap::new() };
        let (mut geometry, mut referee, mut first_referee) = (None, None, None);
        let mut old_vision = false;
        let mut log = log::Log::open(file, log)?;
        while let Some(log::Message { kind, place, payload }) = log.next()? {
            let corrupt = |message: String| ImportError::Log { file: file.to_owned(), place, message };
            let undecodable = |e: prost::DecodeError| corrupt(format!("a corrupt message of type {kind}: {e}"));
            match kind {
                log::VISION => {
                    let packet = WrapperPacket::decode(payload).map_err(undecodable)?;
                    let size = packet.geometry.and_then(|g| g.field);
                    geometry = size.and_then(|size| Geometry::new(&size)).or(geometry);
                    if let Some(detection) = packet.detection {
                        seen.add(&detection, place, &wanted, referee).map_err(corrupt)?;
                    }
                }
                log::REFEREE => {
                    let word = Referee::decode(payload).map_err(undecodable)?;
                    let side = |on_right| if on_right { Side::Left } else { Side::Right };
                    referee = word.blue_team_on_positive_half.map(side).or(referee);
                    first_referee = first_referee.or(referee);
                }
                log::VISION_2010 => old_vision = true,
                _ => {}
            }
        }
        let Some(geometry) = geometry else {
            let mut message = "the log ends without the size of the pitch; expected a packet with geometry".to_owned();
            if old_vision {
                message
                    .push_str(" (vision of 2010, messages of type 2, is not supported; expected that of 2014, type 4)");
            }
            return Err(ImportError::Log { file: file.to_owned(), place: log.place(), message });
        };
        let Sightings { captures, frames } = seen;
        Ok(Self { geometry, count: captures.count(), frames, first_referee })
    }
    /// The goal that the request's team attacks.
    fn attack(&self, frame: &Frame, request: &Request<'_>) -> Side {
        let blue = frame.referee.or(self.first_referee).unwrap_or(BLUE_ATTACKS);
        request.attack.unwrap_or(request.team.attacks(blue))
    }

    /// A note, when the goal is only guessed.
    fn guess(&self, request: &Request<'_>) -> Option<String> {
        let said = request.target.is_some() || request.attack.is_some() || self.first_referee.is_some();
        let side = request.team.attacks(BLUE_ATTACKS);
        (!said).then(|| {
            format!(
                "{}: the log does not say who defends which half; {} is taken to attack the {} goal, \
                 attack = \"{}\" says otherwise",
                request.name,
                request.team.name(),
                side.name(),
                side.opposite().name()
            )
        })
    }

    fn scene(
        &self,
        number: u64,
        frame: &Frame,
        request: &Request<'_>,
        notes: &mut Vec<String>,
    ) -> Result<Scene, String> {
        let &Request { name, team, robot, .. } = request;
        let Some(seen) = frame.robots.get(&(team, robot)) else {
            return Err(format!("no robot {} {robot}; expected one of: {}", team.name(), frame.present()));
        };
        let Geometry { pitch, robot_radius } = self.geometry;
        let role = |other: Team| if other == team { "teammate" } else { "opponent" };
        let body = |label: String, seen: &Seen| Body { centre: seen.at, radius: robot_radius, label };
        let numbered = frame.robots.iter().filter(|(key, _)| **key != (team, robot));
        let mut others: Vec<(Team, Body)> = numbered
            .map(|(&(other, number), seen)| (other, body(format!("{} {number}", role(other)), seen)))
            .chain(frame.unnumbered.iter().map(|(other, seen)| (*other, body(role(*other).to_owned(), seen))))
            .collect();
        others.sort_by_key(|(other, _)| *other == team);
        let instant = Instant {
            name: format!("{name}-f{number:04}-{}{robot}", team.name()),
            pitch,
            robot: body(String::new(), seen),
            others: others.into_iter().map(|(_, body)| body).collect(),
            goal: request.target.unwrap_or(pitch.goal(self.attack(frame, request))),
        };
        instant.scene(notes)
    }
}

/// What the cameras have seen so far.
struct Sightings {
    captures: Captures,
    frames: BTreeMap<u64, Frame>,
}

impl Sightings {
    /// Takes one camera's packet.
    fn add(
        &mut self,
        detection: &DetectionFrame,
        place: Place,
        wanted: &BTreeSet<u64>,
        referee: Option<Side>,
    ) -> Result<(), String> {
        let camera = detection.camera_id.ok_or("a detection without camera_id; expected one")?;
        let time = detection.t_capture.ok_or("a detection without t_capture; expected one")?;
        let camera = usize::try_from(camera).ok().filter(|c| *c < MOST_CAMERAS);
        let camera = camera.ok_or_else(|| {
            format!("a camera_id of {}; expected less than {MOST_CAMERAS}", detection.camera_id.unwrap_or_default())
        })?;
        let number = self.captures.frame_of(camera, time);
        let mut frame = wanted.contains(&number).then(|| {
            let new = || Frame { place, robots: BTreeMap::new(), unnumbered: Vec::new(), referee };
            self.frames.entry(number).or_insert_with(new)
        });
        for (team, robots) in [(Team::Blue, &detection.robots_blue), (Team::Yellow, &detection.robots_yellow)] {
            for robot in robots {
                let seen = Seen::new(robot).ok_or("a robot without confidence, x or y; expected all three")?;
                if let Some(frame) = &mut frame {
                    frame.add(team, robot.robot_id, seen);
                }
            }
        }
        Ok(())
    }
}

impl Seen {
    fn new(robot: &DetectionRobot) -> Option<Self> {
        let at = [f64::from(robot.x?) / 1000.0, f64::from(robot.y?) / 1000.0];
        Some(Self { at, confidence: robot.confidence? })
    }
}

impl Frame {
    fn add(&mut self, team: Team, number: Option<u32>, seen: Seen) {
        let Some(number) = number else {
            self.unnumbered.push((team, seen));
            return;
        };
        let known = self.robots.entry((team, number)).or_insert(seen);
        if seen.confidence > known.confidence {
            *known = seen;
        }
    }

    /// `blue 0, 1, 3; yellow none`
    fn present(&self) -> String {
        let of = |team: Team| {
            let numbers: Vec<String> =
                self.robots.keys().filter(|key| key.0 == team).map(|key| key.1.to_string()).collect();
            let numbers = if numbers.is_empty() { "none".to_owned() } else { numbers.join(", ") };
            format!("{} {numbers}", team.name())
        };
        format!("{}; {}", of(Team::Blue), of(Team::Yellow))
    }
}
