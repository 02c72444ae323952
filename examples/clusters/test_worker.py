"""Tests the client of `touchline worker`: `test_worker.py TOUCHLINE`."""

import stat
import sys
import tempfile
import unittest
from pathlib import Path

from touchline_worker import Worker

SCENE = {"name": "empty", "unit": "m", "robot_radius": 0.0, "start": [0.0, 0.0], "goal": [3.0, 4.0]}
REQUEST = {"kind": "straight-line", "scene": SCENE, "settings": {}, "seed": 7, "budget": {}}


class Client(unittest.TestCase):
    """What the client makes of good and bad workers."""

    program = ""

    def worker(self, program: str) -> Worker:
        """A client that is closed when the test ends."""
        worker = Worker(program)
        self.addCleanup(worker.close)
        return worker

    def script(self, text: str) -> str:
        """An executable that ignores its arguments and does this."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        file = Path(folder.name) / "worker"
        file.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
        file.chmod(file.stat().st_mode | stat.S_IXUSR)
        return str(file)

    def test_asks_again_and_again(self) -> None:
        """One process answers all; an error is that of its request alone."""
        worker = self.worker(self.program)
        first = worker.ask(REQUEST, 60.0)
        process = worker.process
        self.assertEqual(first["path"], [[0.0, 0.0], [3.0, 4.0]])
        self.assertIn("no-such-planner", worker.ask({**REQUEST, "kind": "no-such-planner"}, 60.0)["error"])
        self.assertEqual(worker.ask(REQUEST, 60.0)["path"], first["path"])
        self.assertIs(worker.process, process)

    def test_replaces_the_dead(self) -> None:
        """A worker that dies is told of and started again."""
        worker = self.worker(self.script("read line; exit 3"))
        for _ in range(2):
            answer = worker.ask(REQUEST, 60.0)
            self.assertEqual(answer, {"status": "crashed", "error": "the worker ended with exit code 3"})

    def test_waits_no_longer_than_asked(self) -> None:
        """A silent worker is ended."""
        worker = self.worker(self.script("exec sleep 60"))
        self.assertEqual(worker.ask(REQUEST, 0.2)["status"], "timeout")
        self.assertIsNone(worker.process)

    def test_refuses_an_answer_to_another_request(self) -> None:
        """The numbers must agree."""
        worker = self.worker(self.script("""read line; echo '{"id": 8, "status": "not_found"}'; read line"""))
        self.assertIn("expected 1", worker.ask(REQUEST, 60.0)["error"])


if __name__ == "__main__":
    Client.program = sys.argv.pop()
    unittest.main()
