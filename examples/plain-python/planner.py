"""A planner in plain Python: A* on a lattice, then random shortcuts until the budget is spent.

A* (Hart, Nilsson & Raphael 1968) finds a first path over lattice points, eight
moves, every move tested exactly. Where there is none the spacing is halved.
Shortcuts (Geraerts & Overmars 2007) then join two random points of the path
straight wherever that is clear, which never lengthens it.
"""

import heapq
import math
import random
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from touchline_protocol import Point, Run, path_length, read_settings, serve
from world import World

MOVES = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]


@dataclass
class Settings:
    """What `[planner.LABEL]` may set."""

    cells: int = 24  # lattice spacings along the longer side of the search box
    halvings: int = 3  # how often the spacing is halved while there is no path
    shortcuts: int = 400  # shortcuts tried

    def __post_init__(self) -> None:
        for name, least in (("cells", 2), ("halvings", 0), ("shortcuts", 0)):
            if getattr(self, name) < least:
                raise ValueError(f"{name} = {getattr(self, name)}: expected at least {least}")


def lattice_path(world: World, spacing: float, run: Run) -> list[Point]:
    """The shortest path over the lattice through the start, or none; ends early when the budget is spent."""

    def place(node: tuple[int, int]) -> Point:
        return (world.start[0] + spacing * node[0], world.start[1] + spacing * node[1])

    origin = (0, 0)
    cost = {origin: 0.0}
    parent: dict[tuple[int, int], tuple[int, int]] = {}
    closed: set[tuple[int, int]] = set()
    queue = [(math.dist(world.start, world.goal), origin)]
    while queue and not run.spent():
        node = heapq.heappop(queue)[1]
        if node in closed:
            continue
        closed.add(node)
        here = place(node)
        if math.dist(here, world.goal) <= 1.5 * spacing and world.clear(here, world.goal):
            path = [world.goal, here]
            while node != origin:
                node = parent[node]
                path.append(place(node))
            return path[::-1]
        for i, j in MOVES:
            there = (node[0] + i, node[1] + j)
            g = cost[node] + spacing * math.hypot(i, j)
            if there in closed or g >= cost.get(there, math.inf) or not world.contains(place(there)):
                continue
            if world.clear(here, place(there)):
                cost[there] = g
                parent[there] = node
                heapq.heappush(queue, (g + math.dist(place(there), world.goal), there))
    return []


def point_at(path: list[Point], along: float) -> tuple[int, Point]:
    """The point at arc length `along`, and the index of the segment that it lies on."""
    for index, (a, b) in enumerate(pairwise(path)):
        length = math.dist(a, b)
        if along <= length:
            t = along / length if length > 0.0 else 0.0
            return index, (a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]))
        along -= length
    return len(path) - 2, path[-1]


def shortcut(path: list[Point], world: World, rng: random.Random) -> list[Point]:
    """The path with two random points of it joined straight, or itself where that is not clear."""
    length = path_length(path)
    low, high = sorted((rng.random() * length, rng.random() * length))
    (i, a), (j, b) = point_at(path, low), point_at(path, high)
    if i == j or not world.clear(a, b):
        return path
    return [*path[: i + 1], a, b, *path[j + 1 :]]


def plan(request: dict[str, Any]) -> dict[str, Any]:
    """Answers one request."""
    settings = read_settings(Settings, request["settings"])
    run = Run.within(request["budget"])
    world = World(request["scene"])
    spacing = max(world.high[0] - world.low[0], world.high[1] - world.low[1]) / settings.cells
    path: list[Point] = []
    for halving in range(settings.halvings + 1):
        path = path or lattice_path(world, spacing / 2**halving, run)
    if path:
        run.evaluations = 1
        run.found(path_length(path))
        rng = random.Random(request["seed"])
        while run.iterations < settings.shortcuts and not run.spent():
            path = shortcut(path, world, rng)
            run.iterations += 1
            run.evaluations += 1
            run.found(path_length(path))
    return run.answer(path, world.checks)


if __name__ == "__main__":
    serve(plan)
