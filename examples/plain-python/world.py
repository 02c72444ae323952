"""A scene compiled for its robot: exact tests of points and segments against discs, capsules and polygons.

A segment is clear when it keeps farther from every obstacle than the robot's
radius, and when the robot's whole disc stays in the field. The field is convex,
so that the ends of a segment decide for the whole of it.
"""

import math
from collections.abc import Callable
from typing import Any

Point = tuple[float, float]
Distance = Callable[[Point, Point], float]


def point_segment(p: Point, a: Point, b: Point) -> float:
    """The distance of `p` from the segment `ab`."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    t = 0.0 if square == 0.0 else ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square
    t = min(1.0, max(0.0, t))
    return math.hypot(a[0] + t * dx - p[0], a[1] + t * dy - p[1])


def side(a: Point, b: Point, p: Point) -> float:
    """Positive when `p` lies left of the line from `a` to `b`, negative when right of it."""
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def segment_segment(a: Point, b: Point, c: Point, d: Point) -> float:
    """The distance between the segments `ab` and `cd`; 0 where they cross."""
    if side(a, b, c) * side(a, b, d) < 0.0 and side(c, d, a) * side(c, d, b) < 0.0:
        return 0.0
    return min(point_segment(a, c, d), point_segment(b, c, d), point_segment(c, a, b), point_segment(d, a, b))


def inside(p: Point, polygon: list[Point]) -> bool:
    """Whether `p` lies in the polygon, by the number of edges to its right (even-odd rule)."""
    odd = False
    for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        if (a[1] > p[1]) != (b[1] > p[1]) and p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]):
            odd = not odd
    return odd


def from_disc(disc: dict[str, Any]) -> Distance:
    """The distance of a segment from a disc; negative when it goes through."""
    centre, radius = tuple(disc["centre"]), disc["radius"]
    return lambda a, b: point_segment(centre, a, b) - radius


def from_capsule(capsule: dict[str, Any]) -> Distance:
    """The distance of a segment from the points within a radius of another segment."""
    c, d, radius = tuple(capsule["from"]), tuple(capsule["to"]), capsule["radius"]
    return lambda a, b: segment_segment(a, b, c, d) - radius


def from_polygon(vertices: list[list[float]]) -> Distance:
    """The distance of a segment from a simple polygon, convex or not; 0 when it touches or enters it."""
    polygon = [(v[0], v[1]) for v in vertices]
    edges = list(zip(polygon, polygon[1:] + polygon[:1], strict=True))

    def distance(a: Point, b: Point) -> float:
        # A segment that crosses no edge is inside as a whole or not at all.
        return 0.0 if inside(a, polygon) else min(segment_segment(a, b, c, d) for c, d in edges)

    return distance


SHAPES: dict[str, Callable[[Any], Distance]] = {"disc": from_disc, "capsule": from_capsule, "polygon": from_polygon}


def bounding_points(obstacle: dict[str, Any]) -> list[Point]:
    """Corners of a box round the obstacle."""
    if "polygon" in obstacle:
        return [(v[0], v[1]) for v in obstacle["polygon"]]
    if "disc" in obstacle:
        centres, radius = [obstacle["disc"]["centre"]], obstacle["disc"]["radius"]
    else:
        capsule = obstacle["capsule"]
        centres, radius = [capsule["from"], capsule["to"]], capsule["radius"]
    return [(x + s * radius, y + s * radius) for x, y in centres for s in (-1.0, 1.0)]


class World:
    """Answers what a planner asks: is this segment clear, and within which box may it search."""

    def __init__(self, scene: dict[str, Any]) -> None:
        """Compiles the `scene` of a request; a ValueError when its start or goal is not free."""
        self.start: Point = (scene["start"][0], scene["start"][1])
        self.goal: Point = (scene["goal"][0], scene["goal"][1])
        self.radius: float = scene.get("robot_radius", 0.0)
        self.checks = 0
        obstacles = scene.get("obstacle", [])
        self.distances = [SHAPES[shape](o[shape]) for o in obstacles for shape in SHAPES if shape in o]
        self.field: dict[str, list[float]] | None = scene.get("field")
        points = [self.start, self.goal, *(p for o in obstacles for p in bounding_points(o))]
        low, high = [tuple(pick(p[k] for p in points) for k in (0, 1)) for pick in (min, max)]
        size = math.dist(low, high)
        # A hair more than the radius, so that rounding never takes a crossing for a touch.
        self.least = self.radius + 1e-12 * size
        if self.field:
            self.low = tuple(x + self.least for x in self.field["min"])
            self.high = tuple(x - self.least for x in self.field["max"])
        else:
            margin = 0.25 * max(high[0] - low[0], high[1] - low[1])
            self.low = tuple(x - margin for x in low)
            self.high = tuple(x + margin for x in high)
        for name, p in (("start", self.start), ("goal", self.goal)):
            if not self.free(p):
                raise ValueError(f"{name} ({p[0]:.4f}, {p[1]:.4f}) is in an obstacle or outside the field")

    def clear(self, a: Point, b: Point) -> bool:
        """Whether the robot can go straight from `a` to `b`; counted in `checks`."""
        self.checks += 1
        if self.field and not (self.contains(a) and self.contains(b)):
            return False
        return all(distance(a, b) > self.least for distance in self.distances)

    def free(self, p: Point) -> bool:
        """Whether the robot can stand at `p`; counted in `checks`."""
        return self.clear(p, p)

    def contains(self, p: Point) -> bool:
        """Whether `p` lies in the box `low` … `high` in which to search."""
        return self.low[0] <= p[0] <= self.high[0] and self.low[1] <= p[1] <= self.high[1]
