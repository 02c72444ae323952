"""A planner to copy: replace `find_path` by your own. The page is docs/external-planners.md."""

import json
import math
import sys
import time
from itertools import pairwise


def find_path(scene: dict, settings: dict, seed: int, budget: dict) -> list[list[float]]:
    """The waypoints from start to goal, both included; [] when there is none.

    This one goes straight, or by way of the point `detour` = [x, y].
    """
    via = [settings["detour"]] if "detour" in settings else []
    return [scene["start"], *via, scene["goal"]]


def answer(request: dict) -> dict:
    """One run: checks the settings, plans, and says what it took."""
    unknown = set(request["settings"]) - {"detour"}
    if unknown:
        return {"error": f"unknown settings {sorted(unknown)}; expected detour = [x, y]"}
    began = time.perf_counter()
    path = find_path(request["scene"], request["settings"], request["seed"], request["budget"])
    if not path:
        return {"status": "not_found"}
    evaluations = 1
    time_us = (time.perf_counter() - began) * 1e6
    cost = sum(math.dist(a, b) for a, b in pairwise(path))
    return {
        "status": "solved",
        "path": path,
        "evaluations": evaluations,
        "time_us": time_us,
        "progress": [[evaluations, time_us, cost]],
    }


for line in sys.stdin:
    request = json.loads(line)
    print(json.dumps({"id": request["id"], **answer(request)}), flush=True)
