"""Drives OMPL (the Open Motion Planning Library) through its Python package.

The world and the protocol are those of `../plain-python`: every motion is
tested exactly against the shapes, by OMPL's `MotionValidator`, not at sampled
points. What counts as what:

- evaluations: motions and single states tested, which are the collision checks
  too. OMPL does not count how often it asks for a cost. Beyond the budget
  nothing is tested: every motion is refused.
- iterations: how often OMPL asked whether to stop, which it does at least once
  a turn of its main loop.

Sources: Sucan, Moll & Kavraki, *The Open Motion Planning Library* (2012),
doi:10.1109/MRA.2012.2205651; https://ompl.kavrakilab.org.
"""

import math
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ompl import base, geometric, util

sys.path.append(str(Path(__file__).resolve().parent.parent / "plain-python"))
from touchline_protocol import Point, Run, path_length, read_settings, serve
from world import World

# Whether each improves its path for as long as it may run.
PLANNERS = {"RRTConnect": False, "RRTstar": True, "InformedRRTstar": True, "BITstar": True}
WITH_RANGE = ("RRTConnect", "RRTstar", "InformedRRTstar")


@dataclass
class Settings:
    """What `[planner.LABEL]` may set."""

    planner: str = "RRTConnect"
    range: float = 0.0  # longest motion, scene units; 0: OMPL's choice, a fifth of the space's diagonal
    checks: int = 5000  # motions and states tested before the planner stops of itself

    def __post_init__(self) -> None:
        if self.planner not in PLANNERS:
            raise ValueError(f"planner = {self.planner!r}: expected one of {', '.join(PLANNERS)}")
        if not (math.isfinite(self.range) and self.range >= 0.0):
            raise ValueError(f"range = {self.range}: expected at least 0")
        if self.range > 0.0 and self.planner not in WITH_RANGE:
            raise ValueError(f"range = {self.range}: {self.planner} has none; expected 0")
        if self.checks < 1:
            raise ValueError(f"checks = {self.checks}: expected at least 1")


def point(state: base.State) -> Point:
    """A state of the plane as a point."""
    return (state[0], state[1])


class Counter:
    """Counts what is tested, and says when nothing more may be."""

    def __init__(self, run: Run, most: float) -> None:
        self.run, self.most = run, most

    def spent(self) -> bool:
        """Whether as much has been tested as may be."""
        return self.run.evaluations >= self.most

    def count(self) -> bool:
        """Counts one test, unless all is spent."""
        allowed = not self.spent()
        self.run.evaluations += allowed
        return allowed


class Validity(base.StateValidityChecker):
    """Exact test of a single state."""

    def __init__(self, space: base.SpaceInformation, world: World, counter: Counter) -> None:
        super().__init__(space)
        self.world, self.counter = world, counter

    def isValid(self, state: base.State) -> bool:  # noqa: N802
        """Whether the robot can stand there. Untested ones pass: OMPL may draw until one does; no motion follows."""
        return not self.counter.count() or self.world.free(point(state))


class Motions(base.MotionValidator):
    """Exact test of a motion."""

    def __init__(self, space: base.SpaceInformation, world: World, counter: Counter) -> None:
        super().__init__(space)
        self.world, self.counter = world, counter

    def checkMotion(self, a: base.State, b: base.State) -> bool:  # noqa: N802
        """Whether the robot can go straight from `a` to `b`."""
        return self.counter.count() and self.world.clear(point(a), point(b))


class Search:
    """One run of one of OMPL's planners. Keeps what OMPL only borrows alive until it has ended."""

    def __init__(self, world: World, settings: Settings, run: Run) -> None:
        self.run = run
        self.counter = Counter(run, min(settings.checks, run.max_evaluations))
        self.anytime = PLANNERS[settings.planner]
        plane = base.RealVectorStateSpace(2)
        bounds = base.RealVectorBounds(2)
        for k in (0, 1):
            bounds.setLow(k, world.low[k])
            bounds.setHigh(k, world.high[k])
        plane.setBounds(bounds)
        space = base.SpaceInformation(plane)
        self.checks = (Validity(space, world, self.counter), Motions(space, world, self.counter))
        space.setStateValidityChecker(self.checks[0])
        space.setMotionValidator(self.checks[1])
        space.setup()
        self.problem = base.ProblemDefinition(space)
        ends = plane.allocState(), plane.allocState()
        for state, p in zip(ends, (world.start, world.goal), strict=True):
            state[0], state[1] = p
        self.problem.setStartAndGoalStates(*ends)
        self.problem.setOptimizationObjective(base.PathLengthOptimizationObjective(space))
        self.planner = getattr(geometric, settings.planner)(space)
        if settings.range > 0.0:
            self.planner.setRange(settings.range)
        self.planner.setProblemDefinition(self.problem)
        self.planner.setup()

    def stop(self) -> bool:
        """OMPL's question once a turn; the best cost so far is read on the way."""
        if self.anytime and math.isfinite(cost := self.planner.bestCost().value()):
            self.run.found(cost)
        if self.run.spent() or self.counter.spent():
            return True
        self.run.iterations += 1
        return False

    def solve(self) -> list[Point]:
        """The best path, or none."""
        self.planner.solve(base.PlannerTerminationCondition(self.stop))
        if not self.problem.hasExactSolution():
            return []
        path = self.problem.getSolutionPath()
        points = [point(path.getState(i)) for i in range(path.getStateCount())]
        self.run.found(path_length(points))
        return points


def plan(request: dict[str, Any]) -> dict[str, Any]:
    """Answers one request."""
    settings = read_settings(Settings, request["settings"])
    run = Run.within(request["budget"])
    world = World(request["scene"])
    # OMPL seeds its generators, one for each sampler, from this one: 1 … 2147483562 all differ.
    util.RNG.setSeed(1 + request["seed"] % 2147483562)
    return run.answer(Search(world, settings, run).solve(), world.checks)


if __name__ == "__main__":
    util.setLogLevel(util.LogLevel.LOG_NONE)
    serve(plan)
