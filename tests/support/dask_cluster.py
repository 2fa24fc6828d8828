"""A Dask scheduler and two workers as processes on loopback."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

from support.process_story import descendants, wait_for


class Cluster:
    """A scheduler and two workers as processes."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._programs: list[subprocess.Popen[bytes]] = []
        file = folder / "scheduler.json"
        self._start("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(file))
        wait_for(file.exists, "a scheduler's file")
        self.address: str = wait_for(lambda: json.loads(file.read_text() or "{}").get("address"), "its address")
        self.workers = [self._worker(number) for number in range(2)]

    def _worker(self, number: int) -> subprocess.Popen[bytes]:
        options = ("--nthreads", "1", "--no-nanny", "--no-dashboard", "--name", f"worker{number}")
        return self._start("worker", self.address, "--host", "127.0.0.1", *options)

    def _start(self, kind: str, *options: str) -> subprocess.Popen[bytes]:
        with (self._folder / f"{kind}-{len(self._programs)}.log").open("wb") as log:
            program = subprocess.Popen(
                [sys.executable, "-m", "dask", kind, *options], cwd=self._folder, stdout=log, stderr=log
            )
        self._programs.append(program)
        return program

    def close(self) -> None:
        for program in reversed(self._programs):
            children = descendants(program.pid)
            program.kill()
            program.wait()
            for child in children:
                try:
                    os.kill(child, signal.SIGKILL)
                except ProcessLookupError:
                    continue
