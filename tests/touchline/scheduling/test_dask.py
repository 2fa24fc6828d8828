"""A run on a Dask scheduler with real workers, on loopback."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from support.process_story import descendants, wait_for
from touchline.scheduling.executors import dask_cluster
from touchline.scheduling.executors.this_process import ThisProcess
from touchline.scheduling.outcome import Outcome, to_json
from touchline.scheduling.plan import ListPlan
from touchline.scheduling.planned_match import PlannedMatch
from touchline.scheduling.run import Remote, run_plan
from touchline.scheduling.store import MemoryStore

pytest.importorskip("distributed", reason='needs Dask: pip install "touchline[cluster]"')
pytestmark = [pytest.mark.processes, pytest.mark.timeout(240)]


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
                [sys.executable, "-m", "dask", kind, *options],
                cwd=self._folder,
                stdout=log,
                stderr=log,
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


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Cluster]:
    made = Cluster(tmp_path)
    yield made
    made.close()


class LosesWorker:
    """Kills a worker as soon as the first match has ended."""

    def __init__(self, cluster: Cluster) -> None:
        self._cluster = cluster
        self.ended_matches = 0

    def planned(self, done: int, due: int) -> None:
        del done, due

    def ended(self, planned: PlannedMatch, outcome: Outcome) -> None:
        del planned, outcome
        self.ended_matches += 1
        if self.ended_matches == 1:
            self._cluster.workers[0].kill()


def test_a_run_on_two_workers_of_which_one_is_killed_ends_with_the_same_outcomes(
    cluster: Cluster, match_of: Callable[..., MatchConfig], folder: Path, tmp_path: Path
) -> None:
    plan = ListPlan(tuple(PlannedMatch(match_of(seed=seed), brain_folder=folder) for seed in range(1, 9)))
    log = LosesWorker(cluster)
    with dask_cluster.DaskCluster(cluster.address) as executor:
        there = run_plan(plan, executor, MemoryStore(tmp_path), log, remote=Remote())
    with ThisProcess() as executor:
        here = run_plan(plan, executor, MemoryStore(tmp_path), LosesWorker(cluster))
    assert {name: to_json(one) for name, one in there.items()} == {name: to_json(one) for name, one in here.items()}
    assert log.ended_matches == 8


def test_a_scheduler_that_does_not_answer_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dask_cluster, "CONNECT_S", 0.5)
    with pytest.raises(TouchlineError, match="no scheduler answers"):
        dask_cluster.DaskCluster("tcp://127.0.0.1:9")
