"""The planner's side of Touchline's worker protocol: one request a line in, one answer a line out."""

import json
import math
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field, fields
from itertools import pairwise
from typing import Any, TypeVar

Point = tuple[float, float]
Settings = TypeVar("Settings")


def read_settings(kind: type[Settings], table: dict[str, Any]) -> Settings:
    """The settings of a request as the dataclass `kind`; a ValueError names what is wrong and what was expected."""
    defaults = {f.name: f.default for f in fields(kind)}
    for name, value in table.items():
        if name not in defaults:
            raise ValueError(f"unknown setting {name!r}; expected one of {', '.join(sorted(defaults))}")
        wanted = type(defaults[name])
        whole_for_float = wanted is float and type(value) is int
        if type(value) is not wanted and not whole_for_float:
            raise ValueError(f"{name} = {value!r}: expected {wanted.__name__}, like {defaults[name]!r}")
    return kind(**table)


@dataclass
class Run:
    """One run: what it may spend, what it has spent, and how its best cost fell."""

    max_iterations: float
    max_evaluations: float
    max_seconds: float
    started: float = field(default_factory=time.perf_counter)
    iterations: int = 0
    evaluations: int = 0
    best: float = math.inf
    progress: list[list[float]] = field(default_factory=list)

    @classmethod
    def within(cls, budget: dict[str, float]) -> "Run":
        """A run within the budget of a request; a limit that the request does not name is none."""
        return cls(
            max_iterations=budget.get("iterations", math.inf),
            max_evaluations=budget.get("evaluations", math.inf),
            max_seconds=budget.get("time_ms", math.inf) / 1e3,
        )

    def seconds(self) -> float:
        """Seconds since the request was read."""
        return time.perf_counter() - self.started

    def spent(self) -> bool:
        """Whether any limit of the budget has been reached."""
        return (
            self.iterations >= self.max_iterations
            or self.evaluations >= self.max_evaluations
            or self.seconds() >= self.max_seconds
        )

    def found(self, cost: float) -> None:
        """Notes a path of this cost in the progress, if it is the best so far."""
        if cost < self.best:
            self.best = cost
            self.progress.append([self.evaluations, self.seconds() * 1e6, cost])

    def answer(self, path: list[Point], collision_checks: int) -> dict[str, Any]:
        """The answer's fields for `path`; an empty one is none found."""
        if self.spent():
            status = "budget_spent"
        else:
            status = "solved" if path else "not_found"
        answer: dict[str, Any] = {
            "status": status,
            "path": path,
            "iterations": self.iterations,
            "evaluations": self.evaluations,
            "collision_checks": collision_checks,
            "time_us": self.seconds() * 1e6,
            "progress": self.progress,
        }
        if path:
            answer["cost"] = self.best
        return answer


def path_length(path: list[Point]) -> float:
    """The sum of the segments' lengths."""
    return sum(math.dist(a, b) for a, b in pairwise(path))


def serve(plan: Callable[[dict[str, Any]], dict[str, Any]]) -> None:
    """Answers requests until the input ends.

    A ValueError is an error of that request and is answered as such. Any other
    exception is a fault of the planner: it ends the process, and the bench
    shows its last lines on standard error.
    """
    for line in sys.stdin:
        request = json.loads(line)
        if request["protocol"] != 1:
            raise SystemExit(f"protocol {request['protocol']} is not spoken here; expected 1")
        try:
            answer = plan(request)
        except ValueError as error:
            answer = {"error": str(error)}
        print(json.dumps({"id": request["id"], **answer}, allow_nan=False), flush=True)
