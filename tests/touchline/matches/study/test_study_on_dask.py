"""A study on a Dask scheduler with two workers, on loopback."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner

pytest.importorskip("scipy", reason="experiments need the extra study")
pytest.importorskip("pyarrow", reason="experiments need the extra study")
pytest.importorskip("distributed", reason='needs Dask: pip install "touchline[cluster]"')

from support.dask_cluster import Cluster
from touchline.command_line import app

pytestmark = [pytest.mark.processes, pytest.mark.timeout(240)]

STUDY = """
seeds = "1-2"
both_sides = false
responses = ["distance", "worlds"]
[settings]
duration = 1.0
cyan = "runner:Runner"
teams.cyan.size = 1
teams.magenta.size = 1
[factors]
teams.cyan.parameters.speed = [0.5, 1.0]
[functions]
worlds = "counts:worlds"
"""
BRAIN = """
from touchline import Command, Drive


class Runner:
    def __init__(self, briefing):
        self.speed = briefing.parameters["speed"]

    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vx=self.speed))
"""


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Cluster]:
    made = Cluster(tmp_path)
    yield made
    made.close()


def test_two_dask_workers_and_local_processes_give_the_same_table_to_the_byte(
    cluster: Cluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    home = tmp_path / "home"
    home.mkdir()
    (home / "try.toml").write_text(STUDY)
    (home / "runner.py").write_text(BRAIN)
    (home / "counts.py").write_text("def worlds(recording):\n    return sum(1 for _ in recording.decoded('world'))\n")
    monkeypatch.chdir(home)  # paths are relative, and the workers have another current directory
    for folder, where in (("there", ("--dask", cluster.address)), ("here", ("--jobs", "2"))):
        result = CliRunner().invoke(app, ["experiment", "run", "try.toml", "--into", folder, *where])
        assert result.exit_code == 0, (result.output, result.exception)
    assert Path("there/results.csv").read_bytes() == Path("here/results.csv").read_bytes()
    recordings = [{path.name for path in Path(folder).glob("recordings/*.mcap")} for folder in ("there", "here")]
    assert len(recordings[0]) == 4
    assert recordings[0] == recordings[1]
    result = CliRunner().invoke(app, ["experiment", "verify", "there", "--jobs", "2"])
    assert result.exit_code == 0, (result.output, result.exception)
    assert "identical: 4 matches simulated again; the table of results is the same to the byte" in result.stdout
