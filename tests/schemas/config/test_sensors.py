"""Sensors of a profile and of types of robots: what is inherited, and one line for what is wrong."""

import tomllib
from pathlib import Path

import pytest

from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.sensors.contact import Bumper
from schemas.config.sensors.range import RangeFinder
from schemas.errors import TouchlineError


def number(value: float, unit: str = "m") -> str:
    return f'{{ value = {value}, unit = "{unit}", origin = "test" }}'


FRONT = f"""
[robot.sensors.front]
kind = "range"
beams = {number(9, "1")}
span = {number(3.0, "rad")}
max_distance = {number(8.0)}
"""


def profile_of(tmp_path: Path, tables: str):
    path = tmp_path / "own.toml"
    path.write_text('extends = "msl"\n' + tables)
    return load_profile(str(path))


def test_a_type_has_the_standard_robots_sensors_with_changes_of_its_own(tmp_path: Path) -> None:
    changes = f"[types.slow.sensors.front]\nbeams = {number(3, '1')}\n"
    profile = profile_of(tmp_path, FRONT + changes + '[types.slow.sensors.bumper]\nkind = "contact"\n')
    front = RangeFinder(beams=9, span=3.0, max_distance=8.0)
    assert profile.sensors_of("standard") == profile.sensors_of("keeper") == {"front": front}
    slow = RangeFinder(beams=3, span=3.0, max_distance=8.0)
    assert profile.sensors_of("slow") == {"front": slow, "bumper": Bumper()}
    assert profile.origins["robot.sensors.front.beams"] == profile.origins["types.slow.sensors.front.beams"] == "test"
    match = tomllib.loads(f"[blind.sensors.front]\nmax_distance = {number(1.0)}\n")
    blind = RangeFinder(beams=9, span=3.0, max_distance=1.0)
    assert profile.with_types(match, "match").sensors_of("blind") == {"front": blind}
    assert load_profile("msl").sensors == {}


def test_a_profile_that_extends_another_changes_its_sensors(tmp_path: Path) -> None:
    (tmp_path / "base.toml").write_text('extends = "msl"\n' + FRONT)
    path = tmp_path / "child.toml"
    path.write_text(f'extends = "{tmp_path / "base.toml"}"\n[robot.sensors.front]\nnoise = {number(0.02)}\n')
    assert load_profile(str(path)).sensors_of("keeper")["front"] == RangeFinder(
        beams=9, span=3.0, max_distance=8.0, noise=0.02
    )


@pytest.mark.parametrize(
    ("tables", "place", "words"),
    [
        ('[robot.sensors.front]\nkind = "rang"', "robot.sensors.front.kind is 'rang'", 'did you mean "range"?'),
        ("[robot.sensors.front]\n", "robot.sensors.front.kind is missing", "range, compass"),
        ('[robot.sensors.front]\nkind = "range"', "robot.sensors.front.beams is missing", 'unit = "1"'),
        (FRONT + f"nois = {number(1)}", "robot.sensors.front.nois is not known", "noise"),
        (FRONT + f"x = {number(0.3)}", "robot.sensors.front is at x 0.3 m", "outside its robot"),
        (FRONT + f"height = {number(0.9)}", "robot.sensors.front is at x 0 m, y 0 m, height 0.9", "0.798 m high"),
        (FRONT.replace("value = 9", "value = 490"), "robot.sensors: the readings of front have 510", "at most 500"),
        (FRONT.replace("front", "Front"), "robot.sensors.Front is no name", "lower-case"),
        ("[robot]\nsensors = 3\n", "robot.sensors is 3", "write a table"),
        ("[types.slow]\nsensors = 3\n", "types.slow.sensors is 3", "write a table"),
        ("[types.slow.sensor.x]\n", "types.slow.sensor is not known", "sensors"),
    ],
)
def test_a_wrong_sensor_is_named_with_its_place(tmp_path: Path, tables: str, place: str, words: str) -> None:
    with pytest.raises(TouchlineError) as error:
        profile_of(tmp_path, tables)
    sentence = str(error.value)
    assert f"own.toml: {place}" in sentence and words in sentence and "\n" not in sentence


def test_a_wrong_sensor_of_a_match_is_named_with_its_place() -> None:
    match = load_match(None, {"types": {"blind": {"sensors": {"eye": {"kind": "sonar"}}}}})
    with pytest.raises(TouchlineError, match=r"a match: types\.blind.sensors.eye.kind is 'sonar'; known: range, comp"):
        load_profile("msl").with_types(match.types, "a match")
