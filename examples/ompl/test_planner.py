"""Tests what drives OMPL: `python3 -m unittest` in this folder, with OMPL installed."""

import math
import tomllib
import unittest
from itertools import pairwise
from pathlib import Path
from typing import Any

import planner
from ompl import util
from world import World

SCENES = Path(__file__).resolve().parent.parent.parent / "configs" / "scenes"


def request(name: str, settings: dict[str, Any], budget: dict[str, float], seed: int = 7) -> dict[str, Any]:
    """A request for one of the project's scenes."""
    scene = tomllib.loads((SCENES / f"{name}.toml").read_text(encoding="utf-8"))
    return {"protocol": 1, "id": 1, "scene": scene, "settings": settings, "seed": seed, "budget": budget}


class Ompl(unittest.TestCase):
    """Each planner, on a scene with every shape."""

    @classmethod
    def setUpClass(cls) -> None:
        """OMPL says nothing."""
        util.setLogLevel(util.LogLevel.LOG_NONE)

    def test_paths_are_clear_and_budgets_kept(self) -> None:
        """Every motion is clear by the exact test; nothing is tested beyond the budget; progress falls to the cost."""
        for name, anytime in planner.PLANNERS.items():
            with self.subTest(planner=name):
                asked = request("mixed-shapes", {"planner": name}, {"evaluations": 1500})
                answer = planner.plan(asked)
                world, path = World(asked["scene"]), answer["path"]
                self.assertEqual((path[0], path[-1]), (world.start, world.goal))
                self.assertTrue(all(world.clear(a, b) for a, b in pairwise(path)))
                self.assertEqual(answer["status"], "budget_spent" if anytime else "solved")
                self.assertLessEqual(answer["evaluations"], 1500)
                # Start and goal are looked at once more, when the world is compiled.
                self.assertEqual(answer["collision_checks"], answer["evaluations"] + 2)
                costs = [cost for _, _, cost in answer["progress"]]
                self.assertEqual(costs, sorted(costs, reverse=True))
                self.assertAlmostEqual(sum(map(math.dist, path, path[1:])), answer["cost"], delta=1e-9 * answer["cost"])
                self.assertEqual(len(costs) > 1, anytime)

    def test_the_seed_decides(self) -> None:
        """In one process, whatever ran before; seeds that differ by 2^32 differ."""
        for name in planner.PLANNERS:
            with self.subTest(planner=name):
                seeds = (2**52 + 5, 9, 2**52 + 5, 2**52 + 5 + 2**32)
                asked = [request("trap", {"planner": name}, {"evaluations": 400}, seed) for seed in seeds]
                first, _, again, other = (planner.plan(r)["path"] for r in asked)
                self.assertEqual(first, again)
                self.assertNotEqual(first, other)

    def test_iterations_and_time_end_it(self) -> None:
        """The rest of the budget; a deadline is overshot by no more than one turn, here by less than half a second."""
        turns = planner.plan(request("trap", {"planner": "RRTstar"}, {"iterations": 50}))
        self.assertEqual((turns["status"], turns["iterations"]), ("budget_spent", 50))
        timed = planner.plan(request("trap", {"planner": "BITstar"}, {"time_ms": 30.0}))
        self.assertEqual(timed["status"], "budget_spent")
        self.assertLess(timed["progress"][-1][1], 530_000.0)

    def test_settings_are_read_strictly(self) -> None:
        """What is wrong and what was expected."""
        for settings, message in (
            ({"planner": "RRT**"}, "expected one of RRTConnect, RRTstar, InformedRRTstar, BITstar"),
            ({"planner": "BITstar", "range": 1.0}, "BITstar has none; expected 0"),
            ({"range": -1.0}, "expected at least 0"),
            ({"checks": 0}, "expected at least 1"),
        ):
            with self.subTest(settings=settings), self.assertRaisesRegex(ValueError, message.replace("*", r"\*")):
                planner.plan(request("trap", settings, {}))


if __name__ == "__main__":
    unittest.main()
