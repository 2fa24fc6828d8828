"""The gate before hardware: scenes that a team plays alone, and why it is rejected."""

import json
import re
import time

import pytest
from typer.testing import CliRunner

from runtime.process.clock import WallClock
from schemas.config.match_config import load_match
from schemas.errors import TouchlineError
from schemas.frames import to_body
from schemas.messages.command import Command, Drive
from schemas.side import Side
from touchline.commands.cli.command_line import app
from touchline.team.check.hardware_gate import pass_gate, pass_scenes, random_scene
from touchline.team.check.subject import Subject


class Resting:
    def __init__(self, briefing):
        self.briefing = briefing

    def act(self, sight):
        return Command(answers_tick=sight.tick)


class Ahead(Resting):
    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vx=9.0))


class Gathering(Resting):
    place = 0.0, 0.0

    def act(self, sight):
        me = sight.self
        vx, vy = to_body(self.place[0] - me.x, self.place[1] - me.y, me.heading)
        return Command(answers_tick=sight.tick, drive=Drive(vx=vx, vy=vy))


class AtThePost(Gathering):
    place = 11.1, -1.2


class Slow(Resting):
    def act(self, sight):
        if self.briefing.number == 1 and sight.tick % 10 == 1:
            time.sleep(0.05)
        return super().act(sight)


class Hanging(Resting):
    def act(self, sight):
        while sight.tick > 10:
            pass
        return super().act(sight)


class Raising(Resting):
    def act(self, sight):
        raise RuntimeError("no plan")


def passed(brain, seed=1, seconds=5.0, clearance=None, **match):
    config = load_match(None, {"teams.cyan.remote": True, **match})
    subject = Subject(config, f"{__name__}:{brain}")
    return pass_gate(subject, seed, seconds, WallClock(), clearance)


def test_a_team_that_rests_may_run():
    result = passed("Resting")
    assert (result.rejected, result.clamped) == ("", 0) and result.clearance > 0.49


@pytest.mark.parametrize(
    ("brain", "why"),
    [
        ("Ahead", r"tick \d+: cyan\d touches the boundary"),
        ("Gathering", r"tick \d+: cyan\d touches cyan\d"),
        ("Slow", r"tick \d*1: cyan1 takes \d+ ms to decide; one decision in a hundred takes .* a tick lasts 20 ms"),
        ("Raising", r"cyan1: act raised at tick 0.*no plan"),
    ],
)
def test_a_team_that_would_harm_robots_is_rejected_with_the_tick(brain, why):
    result = passed(brain, seconds=4.0 if brain == "Slow" else 20.0)
    assert re.fullmatch(why, result.rejected), result.rejected
    assert brain != "Ahead" or result.clamped > 100


@pytest.mark.parametrize("brain", ["Ahead", "Gathering"])
def test_with_the_filter_for_clearance_the_same_team_may_run(brain):
    result = passed(brain, seconds=20.0, clearance=0.15)
    assert result.rejected == "" and result.clearance < 0.3


def test_an_obstacle_of_the_match_file_counts_and_is_named():
    post = {"name": "post", "shape": "cylinder", "place": [0.0, 0.0], "radius": 1.0, "height": 1.0}
    result = passed("Gathering", seconds=20.0, obstacles=[post], **{"teams.cyan.size": 1})
    assert re.fullmatch(r"tick \d+: cyan1 touches post", result.rejected)


def test_a_goal_counts_and_the_filter_keeps_off_it():
    alone = {"seconds": 20.0, "teams.cyan.size": 1}
    assert re.fullmatch(r"tick \d+: cyan1 touches a goal", passed("AtThePost", **alone).rejected)
    kept_off = passed("AtThePost", clearance=0.15, **alone)
    assert kept_off.rejected == "" and 0.05 < kept_off.clearance < 0.3


def test_a_robot_beside_a_wall_does_not_touch_it():
    wall = {"name": "wall", "shape": "box", "place": [0.0, 2.2], "size": [5.0, 0.1, 0.5]}
    result = passed("Gathering", seconds=20.0, obstacles=[wall], **{"teams.cyan.size": 1})
    assert result.rejected == "" and 0.0 < result.clearance < 2.0


def test_scenes_differ_by_seed_alone_and_have_room_between_robots():
    config = load_match(None, {"teams.cyan.size": 5})
    scenes = [random_scene(config, config.load_profile(), seed) for seed in (1, 1, 2)]
    assert scenes[0].robots == scenes[1].robots != scenes[2].robots
    assert [one.name for one in scenes[0].of(Side.CYAN)] == config.robots(Side.CYAN)
    posts = [
        {"name": f"post{x}_{y}", "shape": "cylinder", "place": [x, y], "radius": 1.0, "height": 1.0}
        for x in range(0, 22, 2)
        for y in range(0, 14, 2)
    ]
    for post in posts:
        post["place"] = [post["place"][0] - 10.0, post["place"][1] - 6.0]
    crowded = load_match(None, {"obstacles": posts})
    with pytest.raises(TouchlineError, match=r"no room for cyan1; name a match file with fewer robots or obstacles"):
        random_scene(crowded, crowded.load_profile(), 1)


def test_a_brain_that_does_not_return_is_rejected_and_the_next_scene_is_played():
    subject = Subject(load_match(None, {"teams.cyan.remote": True}), f"{__name__}:Hanging")
    results = list(pass_scenes(subject, 2, 1.0, hang_s=2.0))
    assert [one.seed for one in results] == [1, 2]
    why = r"cyan1: act at tick 11 has not returned after 2 s \(\S+test_hardware_gate.py, line \d+\)"
    assert all(re.fullmatch(why, one.rejected) and one.clearance is None for one in results), results


def test_the_command_says_run_or_rejected_by_its_status():
    run = CliRunner()
    done = run.invoke(app, ["check", f"{__name__}:Resting", "--for-hardware", "2", "--seconds", "1"])
    assert done.exit_code == 0 and done.stdout.endswith("run: 2 scenes without a fault\n")
    done = run.invoke(app, ["check", f"{__name__}:Raising", "--for-hardware", "2", "--json"])
    assert done.exit_code == 1 and not json.loads(done.stdout)["run"]
    done = run.invoke(app, ["check", "simple", "--clearance", "0.1"])
    assert done.exit_code == 2 and "add --for-hardware SCENES" in done.stderr
