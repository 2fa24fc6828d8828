"""A run on a Dask scheduler with real workers, on loopback."""

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec
from pathlib import Path

import pytest

from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.wire.part import encode
from support.dask_cluster import Cluster
from touchline.matches.engine.dask_cluster import dask_cluster
from touchline.matches.engine.outcome import Outcome
from touchline.matches.engine.plan import ListPlan
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.run import run_plan

pytestmark = [
    pytest.mark.skipif(find_spec("distributed") is None, reason='needs Dask: pip install "touchline[cluster]"'),
    pytest.mark.processes,
    pytest.mark.timeout(240),
]


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

    def __call__(self, planned: PlannedMatch, outcome: Outcome) -> str:
        del planned, outcome
        self.ended_matches += 1
        if self.ended_matches == 1:
            self._cluster.workers[0].kill()
        return ""


def test_a_run_on_two_workers_of_which_one_is_killed_ends_with_the_same_outcomes(
    cluster: Cluster, match_of: Callable[..., MatchConfig], folder: Path, tmp_path: Path
) -> None:
    plan = ListPlan(tuple(PlannedMatch(match_of(seed=seed), brain_folder=folder) for seed in range(1, 9)))
    log = LosesWorker(cluster)
    with dask_cluster(cluster.address) as (executor, _):
        there = run_plan(plan, executor, None, log, is_remote=True)
    with ThreadPoolExecutor(1) as executor:
        here = run_plan(plan, executor, None, LosesWorker(cluster))
    assert {name: encode(one) for name, one in there.items()} == {name: encode(one) for name, one in here.items()}
    assert log.ended_matches == 8


def test_a_scheduler_that_does_not_answer_is_named() -> None:
    with pytest.raises(TouchlineError, match="no scheduler answers"), dask_cluster("tcp://127.0.0.1:9", connect_s=0.5):
        pass
