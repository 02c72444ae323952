"""Tests the planner in plain Python: `python3 -m unittest` in this folder."""

import json
import math
import random
import subprocess
import sys
import tomllib
import unittest
from itertools import pairwise
from pathlib import Path
from typing import Any

import planner
from world import World, segment_segment

HERE = Path(__file__).resolve().parent
SCENES = HERE.parent.parent / "configs" / "scenes"
NAMES = ("lu-sun-2012", "mixed-shapes", "trap", "corridor", "fang-2009-polygons")


def request(scene: dict[str, Any], **changes: Any) -> dict[str, Any]:
    """A request with the given fields in place of the usual ones."""
    return {"protocol": 1, "id": 5, "scene": scene, "settings": {}, "seed": 7, "budget": {}, **changes}


def scene(name: str) -> dict[str, Any]:
    """One of the project's scenes."""
    return tomllib.loads((SCENES / f"{name}.toml").read_text(encoding="utf-8"))


def at(a: list[float], b: list[float], t: float) -> list[float]:
    """The point a share t of the way from a to b."""
    return [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]


class Geometry(unittest.TestCase):
    """Against numbers worked by hand, and against sampled points."""

    def test_segments(self) -> None:
        """Crossing, touching, parallel, one past the end of the other: 3-4-5 triangles."""
        self.assertEqual(segment_segment((0, 0), (2, 2), (0, 2), (2, 0)), 0.0)
        self.assertEqual(segment_segment((0, 0), (2, 0), (1, 0), (1, 5)), 0.0)
        self.assertEqual(segment_segment((0, 0), (2, 0), (0, 3), (2, 3)), 3.0)
        self.assertEqual(segment_segment((0, 0), (2, 0), (5, 4), (9, 9)), 5.0)

    def test_shapes(self) -> None:
        """Distances of the segment from (-4, 0) to (-2, 0)."""
        a, b = (-4.0, 0.0), (-2.0, 0.0)
        base = {"start": [-9.0, 9.0], "goal": [9.0, 9.0]}
        shapes = [
            ({"disc": {"centre": [0.0, 0.0], "radius": 0.5}}, 1.5),
            ({"capsule": {"from": [1.0, 4.0], "to": [3.0, 4.0], "radius": 1.0}}, 4.0),
            ({"polygon": [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]}, 1.0),
            ({"polygon": [[-9.0, -2.0], [0.0, -2.0], [0.0, 2.0], [-9.0, 2.0]]}, 0.0),
        ]
        for obstacle, expected in shapes:
            with self.subTest(obstacle=obstacle):
                self.assertEqual(World({**base, "obstacle": [obstacle]}).distances[0](a, b), expected)

    def test_a_clear_segment_has_only_free_points(self) -> None:
        """And a blocked one comes within reach of what blocks it, seen at 200 points."""
        rng = random.Random(1)
        found = {True: 0, False: 0}
        world = World(scene("mixed-shapes"))
        for _ in range(150):
            a, b = ([rng.uniform(-2.9, 2.9), rng.uniform(-1.9, 1.9)] for _ in range(2))
            clear = world.clear(tuple(a), tuple(b))
            points = [tuple(at(a, b, k / 200)) for k in range(201)]
            inside_field = all(world.contains(p) for p in points)
            nearest = min(d(p, p) for d in world.distances for p in points) if inside_field else -1.0
            found[clear] += 1
            if clear:
                self.assertGreater(nearest, world.least)
            else:
                # The nearest of 200 points is within half a step of the nearest of all.
                self.assertLessEqual(nearest, world.least + math.dist(a, b) / 400)
        self.assertGreater(min(found.values()), 20)

    def test_start_in_an_obstacle(self) -> None:
        """Is refused by name."""
        for name in ("start", "goal"):
            blocked = {**scene("trap"), name: [0.0, 0.75]}
            with self.assertRaisesRegex(ValueError, f"{name} .0.0000, 0.7500. is in an obstacle"):
                World(blocked)


class Planning(unittest.TestCase):
    """The planner itself, on the project's scenes."""

    def test_paths_are_clear_and_improve(self) -> None:
        """From start to goal; the cost is the length, and progress falls to it."""
        for name in NAMES:
            with self.subTest(scene=name):
                answer = planner.plan(request(scene(name)))
                world, path = World(scene(name)), answer["path"]
                self.assertEqual((answer["status"], path[0], path[-1]), ("solved", world.start, world.goal))
                self.assertTrue(all(world.clear(a, b) for a, b in pairwise(path)))
                costs = [cost for _, _, cost in answer["progress"]]
                self.assertEqual(costs, sorted(costs, reverse=True))
                self.assertEqual(costs[-1], answer["cost"])
                self.assertAlmostEqual(sum(map(math.dist, path, path[1:])), answer["cost"], delta=1e-9 * answer["cost"])
                self.assertLess(costs[-1], costs[0])

    def test_budgets_are_kept(self) -> None:
        """Each of the three; a smaller one is the beginning of a larger one."""
        whole = planner.plan(request(scene("mixed-shapes")))
        some = planner.plan(request(scene("mixed-shapes"), budget={"evaluations": 40}))
        self.assertEqual((some["status"], some["evaluations"]), ("budget_spent", 40))
        begun = [(n, cost) for n, _, cost in whole["progress"] if n <= 40]
        self.assertEqual([(n, cost) for n, _, cost in some["progress"]], begun)
        few = planner.plan(request(scene("mixed-shapes"), budget={"iterations": 3}))
        self.assertEqual((few["status"], few["iterations"]), ("budget_spent", 3))
        none = planner.plan(request(scene("mixed-shapes"), budget={"time_ms": 1e-6}))
        self.assertEqual((none["status"], none["path"]), ("budget_spent", []))

    def test_the_seed_decides(self) -> None:
        """The same one gives the same path; another one another."""
        first, again, other = (planner.plan(request(scene("trap"), seed=seed))["path"] for seed in (7, 7, 8))
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)

    def test_no_way(self) -> None:
        """A goal walled in is not found."""
        wall = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
        ring = [
            {"capsule": {"from": a, "to": b, "radius": 0.1}} for a, b in zip(wall, wall[1:] + wall[:1], strict=True)
        ]
        closed = {"start": [-3.0, 0.0], "goal": [0.0, 0.0], "obstacle": ring}
        answer = planner.plan(request(closed, settings={"halvings": 1}))
        self.assertEqual((answer["status"], answer["path"]), ("not_found", []))

    def test_settings_are_read_strictly(self) -> None:
        """What is wrong and what was expected."""
        for settings, message in (
            ({"cellz": 3}, "unknown setting 'cellz'; expected one of cells, halvings, shortcuts"),
            ({"cells": 2.5}, "cells = 2.5: expected int, like 24"),
            ({"cells": True}, "cells = True: expected int, like 24"),
            ({"cells": 1}, "cells = 1: expected at least 2"),
        ):
            with self.subTest(settings=settings), self.assertRaises(ValueError) as raised:
                planner.plan(request(scene("trap"), settings=settings))
            self.assertEqual(str(raised.exception), message)


class Protocol(unittest.TestCase):
    """As the bench sees it."""

    def test_lines_in_lines_out(self) -> None:
        """An answer a request, in turn; an error is that of its request alone."""
        requests = [request(scene("trap"), id=n, settings={"cells": cells}) for n, cells in ((1, 24), (2, 0), (3, 24))]
        lines = "".join(json.dumps(r) + "\n" for r in requests)
        command = [sys.executable, str(HERE / "planner.py")]
        done = subprocess.run(command, input=lines, capture_output=True, text=True, check=True)
        answers = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([a["id"] for a in answers], [1, 2, 3])
        self.assertEqual(answers[1], {"id": 2, "error": "cells = 0: expected at least 2"})
        self.assertEqual(answers[0]["path"], answers[2]["path"])


if __name__ == "__main__":
    unittest.main()
