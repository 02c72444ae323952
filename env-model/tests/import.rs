//! Match logs become scenes: the samples, numbers read by other means, made-up logs, broken logs.

use std::fs;
use std::io::{Read, Write};
use std::sync::LazyLock;

use env_model::import::{ImportError, Imported, Place, Side, rcg, ssl};
use env_model::{Point, Scene, Shape, World};
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use proptest::prelude::*;

fn sample(name: &str) -> Vec<u8> {
    fs::read(format!("{}/../configs/data/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn rcg_sample() -> Vec<u8> {
    sample("robocup2d-heliosbase-selfplay.rcg.gz")
}

fn ssl_sample() -> Vec<u8> {
    sample("ssl-divB-6v6-simulated.log.gz")
}

fn unzipped(bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    GzDecoder::new(bytes).read_to_end(&mut out).unwrap();
    out
}

fn zipped(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn cycles(log: &[u8], cycles: &[u64], side: Side) -> Result<Imported, ImportError> {
    rcg::scenes("game.rcg", log, &rcg::Request { name: "game", cycles, side, target: None })
}

fn request(frames: &[u64], team: ssl::Team, robot: u32) -> ssl::Request<'_> {
    ssl::Request { name: "game", frames, team, robot, attack: None, target: None }
}

fn frames(log: &[u8], numbers: &[u64], team: ssl::Team, robot: u32) -> Result<Imported, ImportError> {
    ssl::scenes("game.log", log, &request(numbers, team, robot))
}

fn blue_3(log: &[u8], number: u64) -> Result<Imported, ImportError> {
    frames(log, &[number], ssl::Team::Blue, 3)
}

fn disc(scene: &Scene, label: &str) -> ([f64; 2], f64) {
    let found = scene.obstacles.iter().find(|o| o.label.as_deref() == Some(label));
    let Shape::Disc { centre, radius } = found.unwrap_or_else(|| panic!("no {label}")).shape else { panic!() };
    (centre, radius)
}

fn assert_usable(scene: &Scene) {
    let world = World::new(scene).unwrap();
    scene.validate_ends(&world).unwrap();
    assert_eq!(Scene::from_toml("copy", &scene.to_toml()).unwrap(), *scene, "the copy that results keep");
}

mod robocup_2d {
    use super::*;

    #[test]
    fn every_cycle_of_the_sample_makes_a_valid_scene() {
        let log = unzipped(&rcg_sample());
        let all: Vec<u64> = (1..=1200).filter(|c| *c != 600).collect(); // the halves end at 599 and 1200
        for side in [Side::Left, Side::Right] {
            let Imported { scenes, notes } = cycles(&log, &all, side).unwrap();
            assert_eq!(scenes.len(), 1199);
            for scene in &scenes {
                assert_eq!(scene.obstacles.len(), 21, "{}", scene.name);
            }
            scenes.iter().step_by(20).for_each(assert_usable); // the importer itself has looked at all
            // Of the overlaps that a script found (8 left, 15 right), all but 718, 1.9e-7 m, deserve a word.
            assert_eq!(notes.len(), if side == Side::Left { 7 } else { 14 }, "{notes:#?}");
        }
    }

    /// `zgrep '^(show 470 '`: ball (4.0962, 27.3728); l5 (-8.378, 25.5147), 12.6 away, l8 (17.4937, 21.977)
    /// 14.4; r9 (6.0491, 26.4805) is the right side's nearest.
    #[test]
    fn cycle_470_is_what_the_log_says() {
        let log = rcg_sample();
        let left = &cycles(&log, &[470], Side::Left).unwrap().scenes[0];
        assert_eq!((left.name.as_str(), left.unit.as_str(), left.robot_radius), ("game-c0470-left", "m", 0.3));
        assert_eq!((left.start, left.goal), ([-8.378, 25.5147], [52.5, 0.0]));
        let field = left.field.unwrap();
        assert_eq!((field.min, field.max), ([-57.5, -39.0], [57.5, 39.0]));
        assert_eq!(disc(left, "teammate 1"), ([-49.742, 4.0299], 0.3));
        assert_eq!(disc(left, "opponent 9"), ([6.0491, 26.4805], 0.3));
        assert_eq!(disc(left, "opponent 11"), ([3.2635, 9.109], 0.3));
        assert!(left.obstacles.iter().all(|o| o.label.as_deref() != Some("teammate 5")), "the start is no obstacle");
        let right = &cycles(&log, &[470], Side::Right).unwrap().scenes[0];
        assert_eq!((right.start, right.goal), ([6.0491, 26.4805], [-52.5, 0.0]));
        assert_eq!(disc(right, "opponent 5"), ([-8.378, 25.5147], 0.3));
    }

    /// Line 742: l11 (-10.4577, -0.5785) and l6 (-10.6606, -0.0139), √(0.2029² + 0.5646²) = 0.599951 apart.
    #[test]
    fn what_overlaps_the_start_is_drawn_smaller_and_said() {
        let Imported { scenes, notes } = cycles(&rcg_sample(), &[629], Side::Left).unwrap();
        assert_eq!(scenes[0].start, [-10.4577, -0.5785]);
        let (centre, radius) = disc(&scenes[0], "teammate 6");
        let apart = (Point::from(centre) - scenes[0].start()).norm();
        assert!((radius - (apart - 0.3)).abs() < 1e-12, "rounding of a difference of metres");
        assert_eq!(disc(&scenes[0], "teammate 10").1, 0.3, "nobody else");
        let expected = "game-c0629-left: teammate 6 overlaps the start by 0.000049: radius 0.299951 instead of 0.3";
        assert_eq!(notes, [expected]);
    }

    const SMALL: &str = "ULG5
(server_param (player_size 0.25)(coach_msg_file \"a ) b\")(pitch_length 90))
(player_param (player_types 2))
(player_type (id 1)(player_size 0.2))
(playmode 0 before_kick_off)
(team 0 A B 0 0)
(show 7 ((b) 1 2 0 0) ((l 1) 0 0x9 -40 0 0 0 0 0 (v h 90) (s 1 1 1) (fl 3) (c 0 0)) ((l 2) 1 0x1 0 2 0 0 0 0 3 4 (v l 90) (f l 3)) ((l 3) 0 0 1 2 0 0 0 0) ((r 2) 1 0x1 2 2.5 0 0 0 0))
(msg 7 1 \"(goal_l 1\")
(show 7 ((b) 9 9 0 0) ((l 2) 1 0x1 9 9 0 0 0 0))
(show 9 (pm 3) (tm A B 0 0) ((b) -40 0 0 0) ((l 1) 0 0x9 -40 1 0 0 0 0) ((l 2) 1 0x1 -40 -1 0 0 0 0))
";

    #[test]
    fn parameters_disabled_players_stopped_cycles_and_old_spellings() {
        let scene = &cycles(SMALL.as_bytes(), &[7], Side::Left).unwrap().scenes[0];
        assert_eq!(scene.start, [0.0, 2.0], "not the disabled l3 at the ball, not the cycle's second line");
        assert_eq!((scene.robot_radius, scene.obstacles.len()), (0.2, 2));
        assert_eq!(disc(scene, "teammate 1"), ([-40.0, 0.0], 0.25), "a type without a size has the server's");
        assert_eq!(disc(scene, "opponent 2"), ([2.0, 2.5], 0.2));
        assert_eq!((scene.goal, scene.field.unwrap().max), ([45.0, 0.0], [50.0, 39.0]));
        let tie = &cycles(SMALL.as_bytes(), &[9], Side::Left).unwrap().scenes[0];
        assert_eq!(tie.start, [-40.0, 1.0], "the lower number");
        let windows = SMALL.replace('\n', "\r\n");
        assert_eq!(cycles(windows.as_bytes(), &[7], Side::Left).unwrap().scenes[0], *scene);
        let marked = format!("\u{feff}{SMALL}");
        assert_eq!(cycles(marked.as_bytes(), &[7], Side::Left).unwrap().scenes[0], *scene, "a byte order mark");
        let target = rcg::Request { name: "n", cycles: &[7], side: Side::Right, target: Some([-3.0, 4.0]) };
        let scene = &rcg::scenes("f", SMALL.as_bytes(), &target).unwrap().scenes[0];
        assert_eq!((scene.start, scene.goal, scene.name.as_str()), ([2.0, 2.5], [-3.0, 4.0], "n-c0007-right"));
    }

    #[test]
    fn mistakes_are_named_with_their_line() {
        let cases = [
            ("ULG5", "ULG3", "game.rcg:1: begins with \"ULG3\"; expected ULG4, ULG5 or ULG6"),
            ("(show 7 ((b) 1", "(show 7 ((b) one", "game.rcg:7: found \"one\"; expected a number"),
            ("(show 7 ((b) 1", "(show 7 ((b) nan", "game.rcg:7: found NaN; expected a finite number"),
            ("(show 7 ((b) 1", "(show -7 ((b) 1", "game.rcg:7: found \"-7\"; expected a cycle"),
            ("((b) 1 2 0 0) ", "", "game.rcg:7: a cycle without a ball"),
            ("(l 3) 0 0 1", "(l 2) 0 0 1", "game.rcg:7: player 2 of the left side twice"),
            ("(l 3) 0 0 1", "(l 12) 0 0 1", "game.rcg:7: player 12; expected 1 to 11"),
            ("(l 3) 0 0 1", "(l 3) 0 zero 1", "game.rcg:7: found \"zero\"; expected a player's state"),
            ("(l 3) 0 0 1", "(k 3) 0 0 1", "game.rcg:7: found \"k\"; expected b, l or r"),
            ("2.5 0 0 0 0))", "2.5 0 0 0 0)", "game.rcg:7: the line is cut short"),
            ("2.5 0 0 0 0))", "2.5 0 0 0 0)))", "game.rcg:7: found \")\"; expected the end of the line"),
            ("(goal_l 1\")", "(goal", "game.rcg:8: the line is cut short"),
            ("(player_size 0.2)", "(player_size -1)", "game.rcg:4: a size of -1; expected a number above 0"),
            ("(team 0", "team 0", "game.rcg:6: found \"team\"; expected ("),
            ("(l 2) 1 0x1 0 2", "(l 2) 1 0x1 2.1 2.5", "game.rcg:7: cycle 7: opponent 2 at (2.000, 2.500) stands on"),
            ("(r 2) 1 0x1 2 2.5", "(r 2) 1 0x1 45 0.3", "game.rcg:7: cycle 7: goal (45.000, 0.000) is 0.1000 inside"),
            ("(l 2) 1 0x1 0 2", "(l 2) 1 0 0 2", "game-c0007-left"),
        ];
        for (from, to, expected) in cases {
            assert!(SMALL.contains(from), "{from}");
            let message = match cycles(SMALL.replacen(from, to, 1).as_bytes(), &[7], Side::Left) {
                Ok(imported) => imported.scenes[0].name.clone(),
                Err(e) => e.to_string(),
            };
            assert!(message.starts_with(expected), "{to}:\n  {message}\n  {expected}");
        }
        let missing = |cycle| cycles(SMALL.as_bytes(), &[7, cycle], Side::Left).unwrap_err().to_string();
        assert_eq!(missing(10), "game.rcg: cycle 10: not in the log; expected cycles from 7 to 9");
        assert_eq!(missing(8), "game.rcg: cycle 8: not in the log; expected cycles from 7 to 9, this one left out");
        let nobody = cycles(SMALL.as_bytes(), &[9], Side::Right).unwrap_err().to_string();
        assert_eq!(nobody, "game.rcg:10: cycle 9: the right side has no player on the field; expected at least one");
        for empty in ["", "ULG4", "ULG4\n(team 0 A B 0 0)\n"] {
            assert!(matches!(cycles(empty.as_bytes(), &[7], Side::Left), Err(ImportError::Log { .. })), "{empty:?}");
        }
    }
}

mod small_size {
    use super::*;
    use ssl::Team::{Blue, Yellow};

    #[test]
    fn every_robot_in_every_fourth_frame_of_the_sample_makes_a_valid_scene() {
        let log = unzipped(&ssl_sample());
        let mut count = 0;
        for (team, robot) in [Blue, Yellow].into_iter().flat_map(|team| (0..11).map(move |robot| (team, robot))) {
            let mut wanted: Vec<u64> = (0..647).step_by(4).collect();
            let scenes = loop {
                match frames(&log, &wanted, team, robot) {
                    Ok(imported) => break imported.scenes,
                    // Lost by the simulated camera.
                    Err(ImportError::Instant { number, message, .. }) if message.starts_with("no robot") => {
                        wanted.retain(|frame| *frame != number);
                    }
                    Err(e) => panic!("{e}"),
                }
            };
            scenes.iter().step_by(25).for_each(assert_usable);
            count += scenes.len();
        }
        assert_eq!(count, 3492, "sightings, as counted by a script of its own");
    }

    /// Decoded by a script: frame 10 is the message at byte 16241, camera frame 75.
    #[test]
    fn frame_10_is_what_the_log_says() {
        let Imported { scenes, notes } = blue_3(&ssl_sample(), 10).unwrap();
        let scene = &scenes[0];
        assert_eq!((scene.name.as_str(), scene.unit.as_str(), scene.robot_radius), ("game-f0010-blue3", "m", 0.09));
        assert_eq!(scene.start, [-4.10040185546875, -1.4240992431640625]);
        assert_eq!(scene.goal, [4.5, 0.0]);
        let field = scene.field.unwrap();
        assert_eq!((field.min, field.max), ([-4.8, -3.3], [4.8, 3.3]));
        assert_eq!(scene.obstacles.len(), 21);
        assert_eq!(scene.obstacles[0].label.as_deref(), Some("opponent 0"));
        assert_eq!(disc(scene, "opponent 0"), ([0.8017661743164063, -2.0270457763671875], 0.09));
        assert_eq!(disc(scene, "teammate 10").0, [1.301_381_225_585_937_5, -2.801_381_103_515_625]);
        assert!(
            notes[0].starts_with(
                "game: the log does not say who defends which half; blue is taken to attack the right goal"
            ),
            "{notes:?}"
        );
        let yellow = &frames(&ssl_sample(), &[10], Yellow, 0).unwrap().scenes[0];
        assert_eq!((yellow.start, yellow.goal), ([0.8017661743164063, -2.0270457763671875], [-4.5, 0.0]));
        let attack = ssl::Request { attack: Some(Side::Left), ..request(&[10], Blue, 3) };
        let said = ssl::scenes("f", &ssl_sample()[..], &attack).unwrap();
        assert_eq!((said.scenes[0].goal, said.notes.len()), ([-4.5, 0.0], 0));
    }

    /// Frame 348 has yellow 3 at (-1317.0256, 1086.8209) and yellow 5 at (-1485.8267, 1053.0641): 172.143 mm apart.
    #[test]
    fn what_overlaps_the_start_is_drawn_smaller_and_said() {
        let Imported { scenes, notes } = frames(&ssl_sample(), &[348], Yellow, 3).unwrap();
        let radius = disc(&scenes[0], "teammate 5").1;
        assert!((radius - 0.082_143).abs() < 1e-6, "{radius}: the script printed mm to seven digits");
        assert_eq!(
            notes[0],
            "game-f0348-yellow3: teammate 5 overlaps the start by 0.007857: radius 0.082143 instead of 0.09"
        );
    }

    #[test]
    fn what_is_not_there_is_said_with_what_is() {
        let log = ssl_sample();
        let error = blue_3(&log, 647).unwrap_err().to_string();
        assert_eq!(error, "game.log: frame 647: not in the log; expected frames from 0 to 646");
        let error = frames(&log, &[21], Blue, 0).unwrap_err().to_string();
        let expected = "game.log: byte 34299 (decompressed): frame 21: no robot blue 0; expected one of: \
                        blue 1, 2, 3, 4, 5, 7, 9, 10; yellow ";
        assert!(error.starts_with(expected), "{error}");
    }

    /// Protobuf by hand, so that reader and test share nothing: key, then the value.
    fn field(number: u8, wire: u8, value: &[u8]) -> Vec<u8> {
        let mut out = vec![number << 3 | wire];
        if wire == 2 {
            assert!(value.len() < 128 * 128, "two bytes of length");
            out.extend([value.len() as u8 | 0x80, (value.len() >> 7) as u8]);
        }
        out.extend(value);
        out
    }

    fn float(number: u8, value: f32) -> Vec<u8> {
        field(number, 5, &value.to_le_bytes())
    }

    fn int(number: u8, value: u16) -> Vec<u8> {
        field(number, 0, &[value as u8 | 0x80, (value >> 7) as u8 | 0x80, (value >> 14) as u8])
    }

    /// (team, number, x, y, confidence)
    type Robot = (ssl::Team, Option<u16>, f32, f32, f32);

    fn detection(camera: u16, time: f64, robots: &[Robot]) -> Vec<u8> {
        let mut frame = [int(1, 7000), field(2, 1, &time.to_le_bytes()), int(4, camera)].concat();
        for &(team, number, x, y, confidence) in robots {
            let id = number.map_or(Vec::new(), |n| int(2, n));
            let robot = [float(1, confidence), id, float(3, x), float(4, y), float(6, 0.0), float(7, 0.0)].concat();
            frame.extend(field(if team == Yellow { 6 } else { 7 }, 2, &robot));
        }
        field(1, 2, &frame)
    }

    /// Division B, size given by the lines alone.
    fn geometry() -> Vec<u8> {
        let point = |x: f32, y: f32| [float(1, x), float(2, y)].concat();
        let line = |name: &str, a: [f32; 2], b: [f32; 2]| {
            let parts = [
                field(1, 2, name.as_bytes()),
                field(2, 2, &point(a[0], a[1])),
                field(3, 2, &point(b[0], b[1])),
                float(4, 10.0),
            ];
            field(6, 2, &parts.concat())
        };
        let lines = [
            line("TopTouchLine", [-4500.0, 3000.0], [4500.0, 3000.0]),
            line("BottomTouchLine", [-4500.0, -3000.0], [4500.0, -3000.0]),
        ];
        field(2, 2, &field(1, 2, &lines.concat()))
    }

    fn log(messages: &[(i32, Vec<u8>)]) -> Vec<u8> {
        let mut out = b"SSL_LOG_FILE\0\0\0\x01".to_vec();
        for (kind, payload) in messages {
            out.extend(1_i64.to_be_bytes());
            out.extend(kind.to_be_bytes());
            out.extend((payload.len() as i32).to_be_bytes());
            out.extend(payload);
        }
        out
    }

    const BLUE_3: Robot = (Blue, Some(3), -1000.0, 500.0, 0.9);
    const YELLOW_1: Robot = (Yellow, Some(1), 2000.0, 0.0, 0.8);

    /// Two cameras, the first frame empty, two packets lost, geometry last.
    fn two_cameras() -> Vec<u8> {
        let nearer = (Yellow, Some(1), 2010.0, 0.0, 0.7);
        log(&[
            (4, detection(0, 5.000, &[])),
            (4, detection(1, 5.001, &[])),
            (1, vec![9; 70_000]),
            (4, detection(0, 5.016, &[BLUE_3, YELLOW_1])),
            (4, detection(1, 5.017, &[nearer, (Yellow, None, 3000.0, 1000.0, 0.5), BLUE_3])),
            (4, detection(1, 5.033, &[(Blue, Some(4), 0.0, 0.0, 1.0)])),
            (4, detection(0, 5.048, &[BLUE_3])),
            (4, detection(1, 5.049, &[(Yellow, Some(1), 2500.0, 0.0, 0.7)])),
            (4, geometry()),
        ])
    }

    #[test]
    fn cameras_are_merged_and_empty_frames_count() {
        let bytes = two_cameras();
        let scene = &blue_3(&bytes, 1).unwrap().scenes[0];
        assert_eq!((scene.start, scene.goal), ([-1.0, 0.5], [4.5, 0.0]));
        assert_eq!(disc(scene, "opponent 1").0, [2.0, 0.0], "the more confident camera");
        assert_eq!(disc(scene, "opponent").0, [3.0, 1.0], "without a number");
        assert_eq!(scene.obstacles.len(), 2);
        assert_eq!(scene.field.unwrap().max, [4.8, 3.3], "from the lines");
        let error = blue_3(&bytes, 0).unwrap_err().to_string();
        assert!(error.ends_with("frame 0: no robot blue 3; expected one of: blue none; yellow none"), "{error}");
        let error = blue_3(&bytes, 2).unwrap_err().to_string();
        assert!(error.ends_with("frame 2: no robot blue 3; expected one of: blue 4; yellow none"), "{error}");
        assert_eq!(disc(&blue_3(&bytes, 3).unwrap().scenes[0], "opponent 1").0, [2.5, 0.0]);
        let error = blue_3(&bytes, 4).unwrap_err().to_string();
        assert!(error.ends_with("frame 4: not in the log; expected frames from 0 to 3"), "{error}");
        assert_eq!(blue_3(&zipped(&bytes), 1).unwrap(), blue_3(&bytes, 1).unwrap(), "gzip changes nothing");
    }

    #[test]
    fn the_referee_says_who_attacks_where() {
        let blue_on_the_right = |yes: u8| (3, [int(4, 0), field(10, 0, &[yes])].concat());
        let seen = || (4, detection(0, 5.0, &[BLUE_3, YELLOW_1]));
        let goal = |messages: &[(i32, Vec<u8>)], frame| {
            let imported = blue_3(&log(messages), frame).unwrap();
            assert!(imported.notes.is_empty(), "{:?}", imported.notes);
            imported.scenes[0].goal[0]
        };
        let halves = [(4, geometry()), seen(), blue_on_the_right(1), seen(), blue_on_the_right(0), seen()];
        assert_eq!([0, 1, 2].map(|frame| goal(&halves, frame)), [-4.5, -4.5, 4.5]);
        let yellow = ssl::scenes("f", &log(&halves)[..], &request(&[2], Yellow, 1)).unwrap();
        assert_eq!(yellow.scenes[0].goal[0], -4.5);
    }

    #[test]
    fn mistakes_are_named_with_their_byte() {
        let robot = |robot: Robot| log(&[(4, geometry()), (4, detection(0, 5.0, &[BLUE_3, robot]))]);
        let no_x = field(7, 2, &[float(1, 1.0), float(4, 0.0)].concat());
        let no_x = field(1, 2, &[field(2, 1, &[0; 8]), int(4, 0), no_x].concat());
        let second = 16 + 16 + geometry().len();
        let cases = [
            (
                b"SSL_LOG_FILM\0\0\0\x01".to_vec(),
                "game.log: byte 0: begins with \"SSL_LOG_FILM\"; expected SSL_LOG_FILE".into(),
            ),
            (b"SSL_LOG_FILE\0\0".to_vec(), "game.log: byte 0: begins with".into()),
            (b"SSL_LOG_FILE\0\0\0\x02".to_vec(), "game.log: byte 12: log version 2; expected 1".into()),
            (log(&[]), "game.log: byte 16: the log ends without the size of the pitch".into()),
            (
                log(&[(2, detection(0, 5.0, &[BLUE_3]))]),
                format!(
                    "game.log: byte {}: the log ends without the size of the pitch; expected a packet with geometry \
                     (vision of 2010, messages of type 2, is not supported; expected that of 2014, type 4)",
                    32 + detection(0, 5.0, &[BLUE_3]).len()
                ),
            ),
            (log(&[(4, geometry())]), "game.log: frame 0: not in the log; it has no frames at all".into()),
            (log(&[(9, vec![])]), "game.log: byte 16: a message of type 9; expected 0 to 6".into()),
            (
                log(&[(4, vec![0; 65_536])]),
                "game.log: byte 16: a message of 65536 bytes; expected at most 65535".into(),
            ),
            (
                log(&[(4, geometry()), (4, vec![0x0a, 9])]),
                format!("game.log: byte {second}: a corrupt message of type 4:"),
            ),
            (
                log(&[(4, geometry()), (4, no_x)]),
                format!("game.log: byte {second}: a robot without confidence, x or y"),
            ),
            (
                log(&[(4, detection(64, 5.0, &[]))]),
                "game.log: byte 16: a camera_id of 64; expected less than 64".into(),
            ),
            (log(&[(4, field(1, 2, &int(4, 0)))]), "game.log: byte 16: a detection without t_capture".into()),
            (
                robot((Yellow, Some(1), -1050.0, 500.0, 1.0)),
                format!("game.log: byte {second}: frame 0: opponent 1 at (-1.050, 0.500) stands on the start"),
            ),
            (robot((Yellow, Some(1), f32::NAN, 0.0, 1.0)), format!("game.log: byte {second}: frame 0: obstacle 0")),
            (
                robot((Yellow, Some(1), 4500.0, 0.0, 1.0)),
                format!(
                    "game.log: byte {second}: frame 0: goal (4.500, 0.000) is 0.1800 inside obstacle 0 (\"opponent 1\")"
                ),
            ),
        ];
        for (bytes, expected) in cases {
            let error = blue_3(&bytes, 0).err().unwrap_or_else(|| panic!("accepted: {expected}")).to_string();
            assert!(error.starts_with(&expected), "\n  {error}\n  {expected}");
        }
        let mut huge = log(&[(4, vec![])]);
        huge[28..32].copy_from_slice(&i32::MAX.to_be_bytes());
        assert!(blue_3(&huge, 0).unwrap_err().to_string().contains("a message of 2147483647 bytes; expected at most"));
        huge[28..32].copy_from_slice(&(-1_i32).to_be_bytes());
        assert!(blue_3(&huge, 0).unwrap_err().to_string().contains("a message of -1 bytes; expected at least 0"));
    }

    /// Nested 10⁴ deep: a decoder that followed it would need a frame of its stack for each.
    #[test]
    fn nesting_does_not_reach_the_stack() {
        let mut nested = Vec::new();
        for _ in 0..10_000 {
            nested.extend([0x1b]); // an unknown group begins
        }
        assert!(blue_3(&log(&[(4, nested)]), 0).unwrap_err().to_string().contains("corrupt message"));
    }
}

/// Truncated, flipped, exploding.
mod broken {
    use super::*;

    /// The bound that the project sets itself is 256 MiB; the importers need a few hundred kilobytes,
    /// most of it the decompressor's.
    const MOST_MEMORY: u64 = 8 << 20;

    fn bounded<T>(mut work: impl FnMut() -> T) -> T {
        let mut result = None;
        let used = allocation_counter::measure(|| result = Some(work()));
        assert!(used.bytes_max < MOST_MEMORY, "{} bytes", used.bytes_max);
        result.unwrap()
    }

    fn rcg_of(log: &[u8]) -> Result<Imported, ImportError> {
        bounded(|| cycles(log, &[1, 2], Side::Left))
    }

    fn ssl_of(log: &[u8]) -> Result<Imported, ImportError> {
        bounded(|| frames(log, &[0, 3], ssl::Team::Blue, 3))
    }

    /// The head of the sample with three cycles, 28 kB.
    fn rcg_small() -> Vec<u8> {
        static SMALL: LazyLock<Vec<u8>> = LazyLock::new(|| {
            let whole = unzipped(&rcg_sample());
            whole.split_inclusive(|b| *b == b'\n').take(26).collect::<Vec<_>>().concat()
        });
        SMALL.clone()
    }

    /// The first five messages of the sample, 6.5 kB.
    fn ssl_small() -> Vec<u8> {
        static SMALL: LazyLock<Vec<u8>> = LazyLock::new(|| unzipped(&ssl_sample())[..8109].to_vec());
        SMALL.clone()
    }

    fn place_of(error: &ImportError) -> Place {
        match error {
            ImportError::Log { place, .. } => *place,
            ImportError::Instant { .. } => panic!("{error}"),
        }
    }

    #[test]
    fn the_heads_of_the_samples_are_sound() {
        assert_eq!(rcg_of(&rcg_small()).unwrap().scenes.len(), 2);
        assert_eq!(ssl_of(&ssl_small()).unwrap().scenes.len(), 2);
    }

    #[test]
    fn a_cut_is_found_wherever_it_is() {
        let (rcg, ssl) = (rcg_small(), ssl_small());
        for step in 0..100 {
            // Not at the end of a line or message, where nothing is missing.
            let cut = rcg.len() * step / 100;
            let line = 1 + rcg[..cut].iter().filter(|b| **b == b'\n').count() as u64;
            if cut > 0 && rcg[cut - 1] != b'\n' && rcg[cut] != b'\n' {
                assert_eq!(place_of(&rcg_of(&rcg[..cut]).unwrap_err()), Place::Line(line), "{cut}");
            }
            let cut = 17 + (ssl.len() - 17) * step / 100;
            let begins = [16, 1655, 3294, 4933, 6538]; // of messages
            if !begins.contains(&cut) {
                let offset = *begins.iter().rfind(|b| **b < cut).unwrap() as u64;
                assert_eq!(place_of(&ssl_of(&ssl[..cut]).unwrap_err()), Place::Byte { offset, decompressed: false });
            }
        }
        let (rcg, ssl) = (zipped(&rcg), zipped(&ssl));
        for step in 0..50 {
            let cut = rcg.len() * step / 50;
            assert!(rcg_of(&rcg[..cut]).is_err(), "{cut}");
            let cut = ssl.len() * step / 50;
            assert!(ssl_of(&ssl[..cut]).is_err(), "{cut}");
        }
        for lost in 1..=20 {
            // The last bytes of gzip hold checksum and length.
            place_of(&rcg_of(&rcg[..rcg.len() - lost]).unwrap_err());
            place_of(&ssl_of(&ssl[..ssl.len() - lost]).unwrap_err());
        }
    }

    #[test]
    fn what_follows_a_compressed_log_is_said() {
        let (rcg, ssl) = (rcg_small(), ssl_small());
        for trailing in [&b"\0"[..], b"x", b"garbage, and more than the trailer's eight bytes", &[0; 512]] {
            let after = |log: &[u8]| [&zipped(log), trailing].concat();
            let expected = "cannot be read: trailing bytes after the end of the compressed log; expected none";
            for error in [rcg_of(&after(&rcg)).unwrap_err(), ssl_of(&after(&ssl)).unwrap_err()] {
                assert!(error.to_string().ends_with(expected), "{error}");
            }
        }
        let parts = |log: &[u8]| [zipped(&log[..1000]), zipped(&[]), zipped(&log[1000..])].concat();
        assert_eq!(rcg_of(&parts(&rcg)), rcg_of(&rcg), "gzip files may be joined");
        assert_eq!(ssl_of(&parts(&ssl)), ssl_of(&ssl), "gzip files may be joined");
        let cut = parts(&rcg);
        let error = rcg_of(&cut[..cut.len() - 9]).unwrap_err().to_string();
        assert!(error.ends_with("the compressed log is cut short"), "{error}");
    }

    /// 200 MiB of one letter, zipped to 200 kB.
    #[test]
    fn bombs_do_not_explode() {
        let bomb = |head: &[u8], filling: u8, mebibytes: usize| {
            let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
            encoder.write_all(head).unwrap();
            let filling = vec![filling; 1 << 20];
            (0..mebibytes).for_each(|_| encoder.write_all(&filling).unwrap());
            encoder.finish().unwrap()
        };
        let error = rcg_of(&bomb(b"ULG6\n", b'(', 200)).unwrap_err().to_string();
        assert_eq!(error, "game.rcg:2: cannot be read: a line of more than 1048576 bytes");
        let error = rcg_of(&bomb(b"ULG6\n", b'\n', 20)).unwrap_err().to_string();
        assert!(error.contains("the log ends without any (show …) line"), "{error}");
        let types: String = (0..2000).map(|id| format!("(player_type (id {id})(player_size 1))\n")).collect();
        let error = rcg_of(format!("ULG6\n{types}").as_bytes()).unwrap_err().to_string();
        assert!(error.starts_with("game.rcg:1002: player type 1000 and one more"), "{error}");
        // Zeros are blank messages without end.
        let error = ssl_of(&bomb(b"SSL_LOG_FILE\0\0\0\x01", 0, 20)).unwrap_err().to_string();
        assert!(error.contains("byte 20971536 (decompressed): the log ends without the size"), "{error}");
        // Robots of two bytes each grow most when decoded.
        let mut robots = b"SSL_LOG_FILE\0\0\0\x01\0\0\0\0\0\0\0\0\0\0\0\x04\0\0\xff\xff".to_vec();
        robots.extend([0x0a, 0xfb, 0xff, 0x03]);
        robots.extend(std::iter::repeat_n([0x3a, 0x00], 32_765).flatten());
        robots.push(0);
        let error = ssl_of(&robots).unwrap_err().to_string();
        assert!(error.contains("byte 16: "), "{error}");
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

        /// Whatever comes out, it comes out: no panic, little memory, and scenes only when they are sound.
        #[test]
        fn flipped_bits_never_panic(
            flips in prop::collection::vec((0.0..1.0, 0_u8..8), 1..6),
            keep in prop_oneof![Just(1.0), 0.0..1.0],
        ) {
            let broken = |log: &[u8]| {
                let mut log = log[..(log.len() as f64 * keep) as usize].to_vec();
                let length = log.len() as f64;
                for (at, bit) in &flips {
                    if let Some(byte) = log.get_mut((at * length) as usize) {
                        *byte ^= 1 << bit;
                    }
                }
                log
            };
            let (rcg, ssl) = (rcg_small(), ssl_small());
            let (rcg, ssl) = (broken(&rcg), broken(&ssl));
            for result in [rcg_of(&rcg), rcg_of(&zipped(&rcg)), ssl_of(&ssl), ssl_of(&zipped(&ssl))] {
                for scene in result.into_iter().flat_map(|imported| imported.scenes) {
                    scene.validate_ends(&World::new(&scene).unwrap()).unwrap();
                }
            }
            let (rcg, ssl) = (broken(&zipped(&rcg_small())), broken(&zipped(&ssl_small())));
            let _ = (rcg_of(&rcg), ssl_of(&ssl));
        }
    }
}
