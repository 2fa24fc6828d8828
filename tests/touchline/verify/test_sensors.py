"""A match with sensors of the table: verify reads them again."""

from collections.abc import Callable
from pathlib import Path

import pytest

from schemas.config.match_config import load_match
from touchline.verify.resimulate import verify

PROFILE = """
extends = "msl"
[robot.sensors.front]
kind = "range"
beams = { value = 20, unit = "1", origin = "test" }
span = { value = 6.0, unit = "rad", origin = "test" }
max_distance = { value = 30.0, unit = "m", origin = "test" }
noise = { value = 0.02, unit = "m", origin = "test" }
dropout = { value = 0.1, unit = "1", origin = "test" }
rate = { value = 7.0, unit = "Hz", origin = "test" }
[robot.sensors.bumper]
kind = "contact"
[robot.sensors.north]
kind = "compass"
drift = { value = 0.1, unit = "rad", origin = "test" }
"""


@pytest.fixture(scope="module")
def sensing(tmp_path_factory: pytest.TempPathFactory, match_recorder: Callable[..., None]) -> Path:
    """A match of two a side with three sensors each."""
    folder = tmp_path_factory.mktemp("sensing")
    (folder / "sensing.toml").write_text(PROFILE)
    overrides = {"teams.cyan.size": 2, "teams.magenta.size": 2, "profile": str(folder / "sensing.toml")}
    match_recorder(folder / "match.mcap", load_match(None, {"seed": 3, **overrides}), until=3.0)
    return folder / "match.mcap"


def test_readings_are_the_same_again(sensing: Path) -> None:
    verdict = verify(sensing)
    assert verdict.difference is None and not any("sensor" in one for one in verdict.not_checked)


def test_a_changed_reading_is_reported(sensing: Path, edited, at_tick) -> None:
    def nearer(fields):
        fields["sensors"]["cyan2"]["north"]["heading"] += 0.001
        return fields

    difference = verify(edited(sensing, "world", at_tick(101, nearer))).difference
    assert difference is not None and difference.tick == 101
    assert [(one.of, one.field) for one in difference.details] == [("cyan2", "sensors.north")]


def test_a_reading_that_was_left_out_is_reported(sensing: Path, edited, at_tick) -> None:
    def without(fields):
        del fields["sensors"]["magenta1"]
        return fields

    difference = verify(edited(sensing, "world", at_tick(50, without))).difference
    assert difference is not None and difference.tick == 50
