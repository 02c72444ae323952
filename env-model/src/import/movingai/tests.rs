use std::f64::consts::SQRT_2;

use super::cover::{Rectangle, pinches, rectangles};
use super::*;
use crate::Point;

/// Both ways round the block in the middle, a pinch at the right.
const MAP: &str = "type octile\nheight 6\nwidth 8\nmap\n........\n.@@@..T.\n.@.@.O..\n.@@@....\n........\nGGSSWW..\n";

fn map(rows: &str) -> Map {
    let rows: Vec<&str> = rows.split_whitespace().collect();
    let text = format!("type octile\nheight {}\nwidth {}\nmap\n{}\n", rows.len(), rows[0].len(), rows.join("\n"));
    Map::parse("t.map", &text).unwrap()
}

fn problem(start: [usize; 2], goal: [usize; 2]) -> Problem {
    Problem { line: 2, bucket: 0, map: "t.map".into(), size: [8, 6], start, goal, length: 0.0, tolerance: 1e-6 }
}

#[test]
fn rows_are_counted_from_the_top() {
    let map = Map::parse("t.map", MAP).unwrap();
    assert_eq!((map.width(), map.height(), map.grid().size()), (8, 6, 1.0));
    let (upper_left, tree) = (map.cell(0, 0), map.cell(6, 1));
    assert_eq!(map.grid().centre(upper_left), Point::new(0.5, 5.5));
    assert_eq!((map.grid().centre(tree), map.letter(tree)), (Point::new(6.5, 4.5), 'T'));
}

#[test]
fn line_ends_and_blank_lines_do_not_matter() {
    let windows = MAP.replace('\n', "\r\n") + "\r\n\r\n";
    assert_eq!(Map::parse("t.map", &windows), Map::parse("t.map", MAP));
}

#[test]
fn mistakes_in_maps_are_named_with_their_line() {
    let cases = [
        ("type octile", "type tile", "m.map:1: found \"type tile\"; expected \"type octile\""),
        ("height 6", "height six", "m.map:2: height six; expected a whole number from 1 to 10000"),
        ("height 6", "height 0", "m.map:2: height 0; expected"),
        ("height 6\n", "", "m.map:3: \"map\" before height and width are known"),
        ("width 8", "breadth 8", "m.map:3: found \"breadth 8\"; expected \"height H\""),
        (".@@@..T.", ".@@@..T", "m.map:6: a row of 7 cells; expected 8"),
        (".@@@..T.", ".@@@..x.", "m.map:6: found 'x' in column 7; expected one of . G S W @ O T"),
        ("GGSSWW..\n", "", "m.map:10: the file ends; expected row 6 of 6"),
        ("GGSSWW..\n", "GGSSWW..\n........\n", "m.map:11: \"........\" after the last row; expected the end"),
    ];
    for (from, to, expected) in cases {
        assert!(MAP.contains(from));
        let message = Map::parse("m.map", &MAP.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(message.contains(expected), "{to}: {message}");
    }
}

#[test]
fn scenarios_of_either_line_end_and_version() {
    let text = "version 1\n0\tmaps/t.map\t8\t6\t0\t0\t7\t5\t9.07106781\n\n3\tt.map\t8\t6\t1\t0\t1\t5\t7\n";
    let read = problems("s.scen", text).unwrap();
    assert_eq!(read.len(), 2);
    let Problem { line, bucket, map, size, start, goal, length, .. } = read[0].clone();
    assert_eq!((line, bucket, &map[..], size, start, goal), (2, 0, "maps/t.map", [8, 6], [0, 0], [7, 5]));
    assert_eq!((length, read[1].line, read[1].bucket), (9.071_067_81, 4, 3));
    assert_eq!(problems("s.scen", &text.replace('\n', "\r\n").replace("version 1", "version 1.0")).unwrap(), read);
}

#[test]
fn printed_lengths_say_how_exact_they_are() {
    let of = |printed: &str| {
        let text = format!("version 1\n0\tm\t9\t9\t0\t0\t1\t1\t{printed}\n");
        problems("s.scen", &text).unwrap()[0].tolerance
    };
    assert_eq!((of("3.41421"), of("3.41421356"), of("7")), (1e-5, 1e-6, 1e-6));
    assert_eq!(of("2000.12345678"), 2.000_123_456_78e-4, "√2 in single precision");
}

#[test]
fn mistakes_in_scenarios_are_named_with_their_line() {
    let good = "version 1\n0\tt.map\t8\t6\t0\t0\t7\t5\t9.07\n";
    let cases = [
        ("version 1", "version 2", "s.scen:1: found \"version 2\"; expected \"version 1\""),
        ("\t5\t", " 5 ", "s.scen:2: 7 fields; expected nine, separated by tabs"),
        ("t.map", "", "s.scen:2: no map; expected the name"),
        ("\t8\t", "\t0\t", "s.scen:2: width 0; expected 1 to 10000"),
        ("\t7\t", "\t-7\t", "s.scen:2: goal x \"-7\"; expected a whole number of at least 0"),
        ("9.07", "inf", "s.scen:2: optimal length \"inf\"; expected a number"),
    ];
    for (from, to, expected) in cases {
        let message = problems("s.scen", &good.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(message.contains(expected), "{to:?}: {message}");
    }
    assert!(problems("s.scen", "").unwrap_err().to_string().contains("s.scen:1: found \"\""));
}

/// Whether the open rectangle holds a point given in halves of a cell.
fn holds(r: &Rectangle, x: isize, y: isize) -> bool {
    (2 * r.left < x) && (x < 2 * r.right + 2) && (2 * r.low < y) && (y < 2 * r.high + 2)
}

/// The rectangles' union against the definition, at every middle, side and corner of a cell: inside
/// exactly where all the cells that meet there are blocked.
#[test]
fn rectangles_cover_the_interior_and_nothing_else() {
    let maps = [
        "....  .@@.  .@..  ....",
        "@@@@ @..@ @.@@ @@@@",
        "@",
        ".@.@ @.@. .@.@",
        "@.....@@ @@.@@@@. .@@@.@@@ @@@@@@.@ ..@@@..@",
    ];
    for rows in maps {
        let map = map(rows);
        let grid = map.grid();
        let blocked: Vec<bool> = (0..grid.len()).map(|cell| map.letter(cell) == '@').collect();
        let found = rectangles(grid, &blocked);
        let (columns, height) = (grid.columns() as isize, grid.rows() as isize);
        let at = |c: isize, r: isize| {
            !(0..columns).contains(&c) || !(0..height).contains(&r) || blocked[grid.cell(c as usize, r as usize)]
        };
        for y in 0..=2 * height {
            for x in 0..=2 * columns {
                // A whole number n of cells lies between cells n − 1 and n; floor and ceil of x/2 − ½ tell both.
                let (left, right) = ((x - 1).div_euclid(2), x.div_euclid(2));
                let (low, high) = ((y - 1).div_euclid(2), y.div_euclid(2));
                let interior = at(left, low) && at(left, high) && at(right, low) && at(right, high);
                assert_eq!(found.iter().any(|r| holds(r, x, y)), interior, "{rows}: ({x}, {y}) halves, {found:?}");
            }
        }
    }
    assert_eq!(rectangles(map("@@@@ @@@@").grid(), &[true; 8]).len(), 1);
}

#[test]
fn pinches_are_where_blocked_cells_touch_at_a_corner_only() {
    let map = map("..@. ..@. .@.. ....");
    let blocked: Vec<bool> = (0..16).map(|cell| map.letter(cell) == '@').collect();
    assert_eq!(pinches(map.grid(), &blocked), [[2, 2]]);
}

#[test]
fn neither_pinches_nor_sides_nor_the_border_let_a_point_through() {
    // A wall from border to border, by sides and by a corner.
    let map = map("...@.. ...@.. ..@... ..@@.. ...@..");
    let scene = scene("wall", &map, &problem([0, 0], [1, 4])).unwrap().scene;
    let world = World::new(&scene).unwrap();
    let p = Point::new;
    for (a, b) in [
        (p(2.5, 3.5), p(3.5, 2.5)), // through the pinch
        (p(2.0, 1.0), p(4.5, 1.0)), // along the side between two rows
        (p(1.5, 2.0), p(3.5, 2.0)),
        (p(2.0, 5.0), p(5.0, 5.0)), // along the border
        (p(2.0, 0.0), p(5.0, 0.0)),
    ] {
        assert!(!world.segment_free(a, b), "{a} {b}");
    }
    assert!(world.segment_free(p(3.0, 3.1), p(3.0, 5.0)), "along a wall");
}

#[test]
fn octile_lengths_worked_by_hand() {
    let map = Map::parse("t.map", MAP).unwrap();
    let length = |start, goal| scene("x", &map, &problem(start, goal)).unwrap().octile;
    let close = |found: Option<f64>, expected: f64| assert!((found.unwrap() - expected).abs() < 1e-12, "{found:?}");
    close(length([0, 0], [7, 0]), 7.0);
    // Round the block by its left or right, no corner cut: 2 + 4 + 2.
    close(length([2, 0], [2, 4]), 8.0);
    // No cutting of the corner of (1, 3): down, then right.
    close(length([0, 3], [1, 4]), 2.0);
    close(length([0, 4], [1, 5]), SQRT_2);
    // Not between O and T: up, two to the right, two down, left.
    close(length([5, 1], [6, 2]), 6.0);
    assert_eq!(length([2, 2], [2, 0]), None, "walled in");
}

#[test]
fn terrain_decides_by_the_start() {
    let map = Map::parse("t.map", MAP).unwrap();
    let import = |start, goal| scene("x", &map, &problem(start, goal));
    assert_eq!(import([0, 5], [3, 5]).unwrap().octile, Some(3.0), "swamp is passable from the ground");
    assert_eq!(import([4, 5], [5, 5]).unwrap().octile, Some(1.0), "water from water");
    let message = import([0, 5], [4, 5]).unwrap_err();
    assert!(message.contains("goal (4, 5) is on 'W', blocked for this start"), "{message}");
    let message = import([4, 5], [6, 5]).unwrap_err();
    assert!(message.contains("goal (6, 5) is on '.', blocked for this start"), "{message}");
    let message = import([1, 1], [0, 0]).unwrap_err();
    assert!(message.contains("start (1, 1) is on '@'"), "{message}");
    let message = import([0, 0], [8, 0]).unwrap_err();
    assert!(message.contains("goal (8, 0) is off the map; expected less than (8, 6)"), "{message}");
    let message = import([0, 0], [0, 0]).unwrap_err();
    assert!(message.contains("same point"), "{message}");
}

#[test]
fn maps_are_stretched_to_the_size_a_scenario_states() {
    let small = map("@. .T");
    let large = small.scaled(4, 4);
    assert_eq!(large, map("@@.. @@.. ..TT ..TT"));
    assert_eq!(large.scaled(2, 2), small);
}
