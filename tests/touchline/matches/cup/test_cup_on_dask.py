"""A cup on a Dask scheduler with two real workers, of which one is killed."""

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from support.cups import CUP, ShownLines, mini_cup
from support.dask_cluster import Cluster
from touchline.matches.engine.executors.chosen_executor import chosen_executor
from touchline.matches.engine.outcome import to_json
from touchline.matches.engine.store import RunStore

pytest.importorskip("distributed", reason='needs Dask: pip install "touchline[cluster]"')
pytestmark = [pytest.mark.processes, pytest.mark.timeout(240)]


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Cluster]:
    made = Cluster(tmp_path)
    yield made
    made.close()


class LosesWorker(ShownLines):
    """Kills a worker as soon as the first match has ended."""

    def __init__(self, cluster: Cluster) -> None:
        super().__init__()
        self._cluster = cluster

    def ended(self, sentence: str, *, failed: bool = False) -> None:
        super().ended(sentence, failed=failed)
        if len(self.lines) == 1:
            self._cluster.workers[0].kill()


def stored(folder: Path) -> dict[str, bytes]:
    with RunStore(folder, read_only=True) as store:
        return {identity: to_json(outcome) for identity, outcome in store.outcomes().items()}


def test_a_cup_on_two_workers_of_which_one_is_killed_has_the_bytes_of_the_undisturbed_one(
    cluster: Cluster, undisturbed: Path, tmp_path: Path
) -> None:
    (tmp_path / "mini.toml").write_text(CUP)
    progress = LosesWorker(cluster)
    with chosen_executor(0, cluster.address) as chosen, closing(mini_cup(tmp_path)) as run:
        state = run.play(chosen.executor, progress, chosen.remote)
    assert state.is_complete and len(progress.lines) == 3
    out, alone = tmp_path / "out", undisturbed / "out"
    assert stored(out) == stored(alone)
    assert (out / "result.json").read_bytes() == (alone / "result.json").read_bytes()
    assert {file.name for file in (out / "recordings").iterdir()} == {"league_1.mcap", "league_2.mcap", "league_3.mcap"}
