"""A client of `touchline worker`: asks it to plan, one request after another. Standard library only."""

import json
import queue
import subprocess
import threading
from contextlib import suppress
from typing import Any


class Worker:
    """One `touchline worker` process, started at the first request and again after it has ended.

    Not to be shared between threads: an answer follows its request. What the
    worker says on standard error goes to that of this process.
    """

    def __init__(self, program: str) -> None:
        """`program` is the `touchline` executable."""
        self.program = program
        self.asked = 0
        self.process: subprocess.Popen[str] | None = None

    def ask(self, request: dict[str, Any], timeout: float) -> dict[str, Any]:
        """The answer to `request` (kind, scene, settings, seed, budget), waited for at most `timeout` seconds.

        A worker that dies or stays silent gives `{"error": …}` with the status
        that the bench would record, and is replaced before the next request.
        """
        if self.process is None:
            self._start()
        self.asked += 1
        line = json.dumps({"protocol": 1, "id": self.asked, **request}, allow_nan=False)
        # Writing blocks once the pipe is full, so that it belongs to what is waited for.
        threading.Thread(target=self._send, args=(self.process, line), daemon=True).start()
        try:
            text = self.lines.get(timeout=timeout)
        except queue.Empty:
            self.close()
            return {"status": "timeout", "error": f"no answer within {timeout:g} s"}
        if text is None:
            code = self.process.wait()
            self.close()
            return {"status": "crashed", "error": f"the worker ended with exit code {code}"}
        answer = json.loads(text)
        if answer.get("id") != self.asked:
            self.close()
            return {"status": "error", "error": f"answer to request {answer.get('id')}; expected {self.asked}"}
        return answer

    def close(self) -> None:
        """Ends the process."""
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            with suppress(OSError):
                self.process.stdin.close()
            self.process = None

    def _start(self) -> None:
        self.process = subprocess.Popen(
            [self.program, "worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            encoding="utf-8",
        )
        self.lines: queue.Queue[str | None] = queue.Queue()
        threading.Thread(target=self._receive, args=(self.process, self.lines), daemon=True).start()

    @staticmethod
    def _send(process: subprocess.Popen[str], line: str) -> None:
        # Where the process has ended, the reader says so.
        with suppress(OSError, ValueError):
            process.stdin.write(line + "\n")
            process.stdin.flush()

    @staticmethod
    def _receive(process: subprocess.Popen[str], lines: "queue.Queue[str | None]") -> None:
        with process.stdout:
            for line in process.stdout:
                lines.put(line)
        lines.put(None)
