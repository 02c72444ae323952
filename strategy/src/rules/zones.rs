//! Where the rules keep robots out, as obstacles inflated by a robot's radius.

use env_model::{Core, Inflated, Point, Polygon};

use super::Command;
use crate::League;
use crate::league::ROBOT_RADIUS;
use crate::roles::Role;

/// "Defense Area Distance" (SSL rules 2026): in STOP and at free kicks, so far from the opposing defence area, in m.
pub const DEFENCE_AREA_DISTANCE: f64 = 0.2;
/// "Ball Distance": in STOP and at the opponents' free kicks, so far from the ball, in m.
pub const BALL_DISTANCE: f64 = 0.5;
/// "Ball Placement Interference": so far from the line between the ball and where it is to be placed, in m.
pub const PLACEMENT_DISTANCE: f64 = 0.5;
/// "Kick-Off": radius of the centre circle, in m.
pub const CENTRE_CIRCLE: f64 = 0.5;

/// The ball, as far as rules mind it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// Where it is.
    pub at: Point,
    /// Where it is to be placed, in ball placement.
    pub target: Option<Point>,
}

/// Where a robot in `role` must not be at `command`; a robot is in a zone where any part of it is.
///
/// Defence areas reach behind the goal line as far as the border: nobody passes behind a goal. In play, the opposing
/// one is kept out of as well: attackers must not touch the ball there.
pub fn zones(league: League, command: Command, role: Role, ball: Option<Ball>) -> Vec<Inflated> {
    let mut zones = Vec::new();
    if matches!(command, Command::Off | Command::Halt) {
        return zones;
    }
    if role != Role::Keeper {
        zones.push(defence_area(league, -1.0, 0.0));
    }
    let near = match command {
        Command::Stop | Command::DirectFreeOwn | Command::DirectFreeOpponent => DEFENCE_AREA_DISTANCE,
        _ => 0.0,
    };
    zones.push(defence_area(league, 1.0, near));
    let round = |core: Core, distance: f64| Inflated { core, radius: distance + ROBOT_RADIUS };
    if role == Role::Taker && matches!(command, Command::KickoffOwn | Command::BallPlacementOwn) {
        return zones;
    }
    match command {
        Command::Stop | Command::DirectFreeOpponent => {
            zones.extend(ball.map(|ball| round(Core::Point(ball.at), BALL_DISTANCE)));
        }
        Command::KickoffOpponent | Command::KickoffOwn => {
            zones.push(opposing_half(league));
            zones.push(round(Core::Point(Point::origin()), CENTRE_CIRCLE));
        }
        Command::BallPlacementOpponent | Command::BallPlacementOwn => {
            zones.extend(ball.map(|Ball { at, target }| {
                let core = target.filter(|t| *t != at).map_or(Core::Point(at), |t| Core::Segment(at, t));
                round(core, PLACEMENT_DISTANCE)
            }));
        }
        _ => {}
    }
    zones
}

/// The defence area on the side of `sign`, grown by `distance`.
pub(crate) fn defence_area(league: League, sign: f64, distance: f64) -> Inflated {
    let [depth, width] = league.defence_area();
    let (line, border) = (league.half_size()[0], league.field().max[0]);
    rectangle([sign * (line - depth), sign * border], 0.5 * width, distance)
}

fn opposing_half(league: League) -> Inflated {
    let [x, y] = league.field().max;
    rectangle([0.0, x], y, 0.0)
}

fn rectangle([from, to]: [f64; 2], half_width: f64, distance: f64) -> Inflated {
    let corners = [[from, -half_width], [to, -half_width], [to, half_width], [from, half_width]];
    let polygon = Polygon::new(corners.map(Point::from).to_vec()).expect("a rectangle is a simple polygon");
    Inflated { core: Core::Polygon(polygon), radius: distance + ROBOT_RADIUS }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a robot at `p` is in a zone.
    fn inside(command: Command, role: Role, ball: Option<Ball>, p: [f64; 2]) -> bool {
        zones(League::DivisionA, command, role, ball).iter().any(|z| z.point_clearance(p.into()) < 0.0)
    }

    const BALL: Ball = Ball { at: Point::new(1.0, 1.0), target: Some(Point::new(3.0, 1.0)) };

    #[test]
    fn defence_areas_are_the_keepers() {
        // 12 m field, 1.8 m deep: the area begins at 4.2, a robot's centre stays 0.09 before it.
        for role in [Role::Field, Role::Defender, Role::Attacker, Role::Taker] {
            assert!(inside(Command::Running, role, None, [-4.111, 0.0]));
            assert!(!inside(Command::Running, role, None, [-4.109, 0.0]));
        }
        assert!(!inside(Command::Running, Role::Keeper, None, [-5.9, 0.0]));
        assert!(inside(Command::Running, Role::Keeper, None, [5.9, 0.0]), "the opponents' is not");
        // 3.6 m wide: 1.8 + 0.09.
        assert!(inside(Command::Running, Role::Field, None, [-5.0, 1.889]));
        assert!(!inside(Command::Running, Role::Field, None, [-5.0, 1.891]));
        // Behind the goal.
        assert!(inside(Command::Running, Role::Field, None, [-6.2, 0.0]));
    }

    #[test]
    fn the_opposing_area_is_wider_in_stop_and_at_free_kicks() {
        for command in [Command::Stop, Command::DirectFreeOwn, Command::DirectFreeOpponent] {
            assert!(inside(command, Role::Attacker, None, [3.911, 0.0]), "{command:?}");
            assert!(!inside(command, Role::Attacker, None, [3.909, 0.0]), "{command:?}");
            assert!(!inside(command, Role::Attacker, None, [-4.109, 0.0]), "{command:?}: the own one is not");
        }
        assert!(!inside(Command::Running, Role::Attacker, None, [4.109, 0.0]));
        // Division B: 9 m, 1 m deep: 3.5 − 0.09.
        let b = zones(League::DivisionB, Command::Running, Role::Field, None);
        let free = |x: f64| b.iter().all(|z| z.point_clearance(Point::new(x, 0.0)) >= 0.0);
        assert!(free(3.409) && !free(3.411));
    }

    #[test]
    fn half_a_metre_from_the_ball() {
        for command in [Command::Stop, Command::DirectFreeOpponent] {
            for role in [Role::Field, Role::Keeper, Role::Taker] {
                assert!(inside(command, role, Some(BALL), [1.0, 1.589]), "{command:?} {role:?}");
                assert!(!inside(command, role, Some(BALL), [1.0, 1.591]), "{command:?} {role:?}");
            }
        }
        for command in [Command::Running, Command::DirectFreeOwn, Command::Off, Command::Halt] {
            assert!(!inside(command, Role::Field, Some(BALL), [1.0, 1.1]), "{command:?}");
        }
    }

    #[test]
    fn a_capsule_round_ball_placement() {
        for command in [Command::BallPlacementOwn, Command::BallPlacementOpponent] {
            for (p, within) in
                [([2.0, 1.589], true), ([2.0, 1.591], false), ([0.411, 1.0], true), ([0.409, 1.0], false)]
            {
                assert_eq!(inside(command, Role::Field, Some(BALL), p), within, "{command:?} {p:?}");
            }
            // Round at the end: (3 + 0.59 cos 45°, 1 + 0.59 sin 45°) = (3.4172, 1.4172).
            assert!(inside(command, Role::Field, Some(BALL), [3.416, 1.416]));
            assert!(!inside(command, Role::Field, Some(BALL), [3.418, 1.418]));
        }
        assert!(!inside(Command::BallPlacementOwn, Role::Taker, Some(BALL), [2.0, 1.0]));
        assert!(inside(Command::BallPlacementOpponent, Role::Taker, Some(BALL), [2.0, 1.0]));
        let placed = Ball { target: Some(BALL.at), ..BALL };
        assert!(inside(Command::BallPlacementOwn, Role::Field, Some(placed), [1.0, 1.589]), "a disc at last");
    }

    #[test]
    fn kick_off_from_the_own_half() {
        assert!(inside(Command::KickoffOwn, Role::Field, None, [-0.089, 2.0]));
        assert!(!inside(Command::KickoffOwn, Role::Field, None, [-0.091, 2.0]));
        assert!(inside(Command::KickoffOwn, Role::Field, None, [-0.589, 0.0]));
        assert!(!inside(Command::KickoffOwn, Role::Field, None, [-0.591, 0.0]));
        assert!(!inside(Command::KickoffOwn, Role::Taker, None, [0.1, 0.0]));
        assert!(inside(Command::KickoffOpponent, Role::Taker, None, [-0.1, 0.0]));
    }
}
