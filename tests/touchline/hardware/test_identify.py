"""The numbers of a robot from a recording, against those of the simulated hardware; and a recording as hardware."""

import cmath
import json
import math
import random
import re
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from pytest import approx
from typer.testing import CliRunner

from recordings.container.mcap_writer import mcap_writer
from robot_agent.hardware.guard import HardwareError, HardwareGuard
from robot_agent.hardware.settings import HardwareSettings
from robot_agent.process.hardware_runner import RunnerWithoutHost
from robot_agent.sdk.contract import Briefing
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive
from support.in_process_bus import SharedState
from support.messages import make_setup
from support.stepped_board import track_on_board
from support.stepped_clock import SteppedClock
from touchline.commands.cli.command_line import app
from touchline.hardware.identify import identify, profile_text
from touchline.hardware.replayed import Replayed
from touchline.hardware.robot_track import read_track

ROOT = Path(__file__).parents[3]
POSTS = ((2.0, 3.0), (-3.0, 1.0), (0.0, -4.0))
SETUP = make_setup()
MODEL = SETUP.model_of("cyan2")
LIMITS = {"max_speed": 4.0, "max_turn_rate": 9.0, "acceleration": 20.0, "deceleration": 20.0, "turn_acceleration": 60.0}
LOOSE = replace(MODEL, drive=replace(MODEL.drive, **LIMITS))
LOOSE_SETUP = SETUP.replace(drive=LOOSE.drive, models={"standard": LOOSE})


def shaker():
    """The brain of docs/real_robots.md."""
    page = (ROOT / "docs" / "real_robots.md").read_text("utf-8")
    names = {}
    exec(next(text for text in re.findall(r"```python\n(.*?)```", page, re.DOTALL) if "Shaker" in text), names)
    return names["Shaker"](Briefing.of("cyan2", LOOSE_SETUP))


def driven(brain, seconds, **numbers):
    return track_on_board(brain, "cyan2", LOOSE_SETUP, seconds, **numbers)


@pytest.mark.parametrize(
    "true",
    [
        {"max_speed": 3.0, "acceleration": 2.2, "turn_acceleration": 9.0, "latency": 0.05, "picture_delay": 0.08},
        pytest.param(
            {"max_speed": 1.5, "acceleration": 3.5, "turn_acceleration": 15.0, "latency": 0.1, "picture_delay": 0.16},
            marks=pytest.mark.long,
        ),
    ],
)
def test_each_number_of_the_simulated_hardware_is_found_within_five_percent(true):
    noise = {"position_noise": 0.012, "heading_noise": 0.009}
    found = identify(driven(shaker(), 60.0, posts=POSTS, **noise, **true), LOOSE)
    for name in ("max_speed", "acceleration", "turn_acceleration", "latency"):
        assert getattr(found, name) == approx(true[name], rel=0.05), name
    assert found.deceleration == approx(true["acceleration"], rel=0.05)
    assert found.camera_delay == approx(true["picture_delay"], rel=0.05)
    assert found.position_noise == approx(noise["position_noise"], rel=0.05)
    assert found.heading_noise == approx(noise["heading_noise"], rel=0.05)


def test_the_numbers_are_the_same_where_robot_and_board_are_late_as_on_a_busy_machine():
    true = {"max_speed": 3.0, "acceleration": 2.2, "turn_acceleration": 9.0, "latency": 0.05, "picture_delay": 0.08}
    noise = {"position_noise": 0.012, "heading_noise": 0.009}
    track = driven(shaker(), 60.0, late=random.Random(3), posts=POSTS, **noise, **true)
    steps = sorted(after.time - before.time for before, after in pairwise(track.sights))
    assert steps[len(steps) // 20] < 0.015 and steps[-len(steps) // 20] > 0.025
    found = identify(track, LOOSE)
    for name in ("max_speed", "acceleration", "turn_acceleration"):
        assert getattr(found, name) == approx(true[name], rel=0.05), name
    assert found.latency == approx(true["latency"], abs=0.005)  # a board that is late follows later
    assert found.camera_delay == approx(true["picture_delay"], rel=0.05)
    assert found.position_noise == approx(noise["position_noise"], rel=0.05)
    assert found.heading_noise == approx(noise["heading_noise"], rel=0.05)


def test_what_a_recording_does_not_show_is_left_out_of_the_profile_that_it_makes(tmp_path):
    found = identify(driven(shaker(), 30.0, max_speed=9.0), LOOSE)
    assert (found.max_speed, found.max_turn_rate, found.camera_delay) == (None, None, None)
    (tmp_path / "mine.toml").write_text(profile_text(found, "msl", "identified in run.mcap"))
    profile = load_profile(str(tmp_path / "mine.toml"))
    assert profile.drive.max_speed == load_profile("msl").drive.max_speed
    assert profile.drive.acceleration == approx(found.acceleration, rel=1e-3)
    assert profile.origins["sensing.own_position"] == "identified in run.mcap"


class Still:
    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive())


@pytest.mark.parametrize(("seconds", "text"), [(3.0, "60 s are better"), (12.0, "the demands hardly change")])
def test_a_recording_that_shows_too_little_is_refused_with_what_to_do(seconds, text):
    with pytest.raises(TouchlineError, match=text):
        identify(driven(Still(), seconds), LOOSE)


def written(track, path):
    """A recording of keys with this track."""
    with path.open("wb") as file:
        mcap = mcap_writer(file)
        mcap.start(profile="", library="")
        channels = [
            mcap.register_channel(f"touchline/friendly/robot/{track.robot}/{end}", "json", 0)
            for end in ("sight", "command")
        ]
        for sight, command in zip(track.sights, track.commands, strict=True):
            for channel, message in zip(channels, (sight, command), strict=True):
                mcap.add_message(channel, round(1e9 * sight.time), message.encode(), round(1e9 * sight.time))
        mcap.finish()
    return path


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    track = driven(shaker(), 12.0, ball=(1.0, 1.0), posts=POSTS, picture_delay=0.04)
    return track, written(track, tmp_path_factory.mktemp("run") / "run.mcap")


def test_a_recording_of_keys_has_the_track_of_its_robot(recorded):
    track, path = recorded
    assert read_track(path, "cyan2") == track
    with pytest.raises(TouchlineError, match=r'no sights of cyan1; did you mean "cyan2"\?'):
        read_track(path, "cyan1")


def test_the_command_writes_a_profile_that_a_match_can_be_played_with(recorded, tmp_path):
    _, path = recorded
    made = tmp_path / "mine.toml"
    done = CliRunner().invoke(app, ["identify", str(path), "--robot", "cyan2", "--out", str(made)])
    assert done.exit_code == 0 and "latency of commands" in done.stdout
    assert load_match(None, {"profile": str(made)}).load_profile().sensing.latency == approx(0.04, abs=0.01)
    refused = CliRunner().invoke(app, ["identify", str(path), "--robot", "cyan2", "--out", str(path / "profile.toml")])
    assert (refused.exit_code, refused.stderr.count("\n")) == (2, 1)
    printed = CliRunner().invoke(app, ["identify", str(path), "--robot", "cyan2", "--json"]).stdout
    assert json.loads(printed)["turn_acceleration"] > 1.0


class Watching(Still):
    def __init__(self):
        self.seen = []

    def act(self, sight):
        self.seen.append(sight)
        return super().act(sight)


def test_a_recording_as_hardware_shows_a_brain_the_sights_of_the_recording(recorded):
    track, path = recorded
    clock = SteppedClock()
    hardware = Replayed(MODEL, recording=str(path), robot="cyan2")
    guard = HardwareGuard(hardware, HardwareSettings(hardware="replayed"), MODEL, "cyan2", clock, armed=True)
    guard.start()
    bus = SharedState().open_bus("friendly", clock)
    runner = RunnerWithoutHost(guard, SETUP, bus, Watching(), "cyan2")
    with pytest.raises(HardwareError, match=r"the recording has ended after 12\.00 s"):
        while True:
            sight = runner.next_sight(None)
            if sight is not None:
                runner.answer(sight)
    pairs = list(zip(runner.brain.seen, track.sights[1:], strict=False))[20:]
    assert len(pairs) > 500
    for again, before in random.Random(1).sample(pairs, 100):
        assert (again.self.x, again.self.heading) == approx((before.self.x, before.self.heading), abs=1e-6)
        assert again.ball.x == approx(before.ball.x, abs=0.002) and again.ball.age == approx(before.ball.age, abs=1e-6)
        places = [(one.x, one.y) for one in again.obstacles]
        assert all(min(math.dist((one.x, one.y), place) for place in places) < 0.002 for one in before.obstacles)


def test_a_recording_of_one_sight_is_hardware_for_its_time(recorded, tmp_path):
    track, _ = recorded
    one = track._replace(sights=track.sights[50:51], commands=track.commands[50:51])
    hardware = Replayed(MODEL, recording=str(written(one, tmp_path / "one.mcap")), robot="cyan2")
    ball, robot = hardware.sense(0.0).picture.ball, track.sights[50].self
    turned = complex(ball.x, ball.y) * cmath.exp(1j * robot.heading) + complex(robot.x, robot.y)
    assert (turned.real, turned.imag) == approx((track.sights[50].ball.x, track.sights[50].ball.y), abs=1e-9)
    with pytest.raises(EOFError):
        hardware.sense(0.02)
