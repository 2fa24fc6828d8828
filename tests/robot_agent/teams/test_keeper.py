"""The goalkeepers of the shipped teams against shots and balls that lie near the goal, in matches in one process."""

import itertools
import math

import pytest

from robot_agent.sdk.bodies import DriveLimits
from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.skills.go_to import drive
from robot_agent.soccer.skills.kick_at import kick_at
from schemas.config.match_config import load_match
from schemas.messages.command import Command, Drive, KickMode
from schemas.soccer.game import EventKind
from sim_host.match.simulation import Simulation
from touchline.play.play_match import play_match

TEAMS = {name.lower(): f"robot_agent.teams.{name.lower()}:{name}" for name in ("Simple", "NuBot", "Reference")}
SCENE = """
description = "A kicker and a goalkeeper."
[game]
phase = "play"
[ball]
x = {x}
y = {y}
[[robots]]
name = "cyan2"
side = "cyan"
x = {robot_x}
y = {y}
[[robots]]
name = "magenta1"
side = "magenta"
x = {keeper_x}
y = 0.0
heading = 3.141592653589793
keeper = true
[[robots]]
name = "magenta2"
side = "magenta"
x = -9.0
y = -6.0
"""


class Kicker:
    """Takes the ball before it, aims, and kicks once; without a mode it stands still."""

    def __init__(self, briefing, mode, aim):
        self.pitch, self.limits = briefing.setup.pitch, DriveLimits.of(briefing.setup)
        self.mode, self.aim, self.has_kicked, self.held = mode, aim, False, 0

    def act(self, sight):
        motion, kick = Drive(), None
        self.held = self.held + 1 if sight.holding else 0
        if self.mode is not None and not self.has_kicked:
            motion = drive(sight.self, 0.4, 0.0, 0.0, self.limits)
            if sight.holding:
                motion, kick = kick_at(sight.self, (self.pitch.goal_line, self.aim), 12.0, 0.1, self.limits, self.mode)
                kick = kick if self.held > 25 else None
                self.has_kicked = kick is not None
        return Command(answers_tick=sight.tick, drive=motion, dribble=not self.has_kicked, kick=kick)


def play(folder, team, ball, *, mode=None, aim=0.0, keeper_x=10.7, until=5.0, watch=None):
    """The events of a kick at the goal that the team's goalkeeper keeps; its teammate stands still, far away."""
    (x, y), scene = ball, folder / "scene.toml"
    robot_x = x - 0.36 if mode is not None else -9.0
    scene.write_text(SCENE.format(x=x, y=y, robot_x=robot_x, keeper_x=keeper_x))
    config = load_match(None, {"seed": 1, "scene": str(scene), "teams": {"magenta": {"brain": TEAMS[team]}}})
    setup = Simulation(config).setup()
    kicker, still = (
        Kicker(Briefing.of(name, setup), kicks, aim) for name, kicks in (("cyan2", mode), ("magenta2", None))
    )
    return play_match(config, {"cyan2": kicker, "magenta2": still}, watch=watch, until=until).events


@pytest.mark.parametrize("team", TEAMS)
def test_of_six_lobs_over_the_keeper_at_most_one_scores(tmp_path, team):
    """Of 96, 94 did: the keeper stood before the line, where they pass above it."""
    goals = [
        any(event.kind is EventKind.GOAL for event in play(tmp_path, team, ball, mode=KickMode.LOB, aim=aim))
        for ball, aim in itertools.product(((4.4, 0.0), (6.4, 2.5)), (-0.7, 0.0, 0.7))
    ]
    assert sum(goals) <= 1


@pytest.mark.parametrize("team", TEAMS)
@pytest.mark.parametrize("ball", [(10.2, 0.6), (9.6, -2.0), (9.0, 1.0)])
def test_a_keeper_fetches_a_ball_that_lies_in_its_penalty_area_and_plays_it_out(tmp_path, team, ball):
    """One lay 51 cm behind a guarding keeper for 9.8 s."""
    places = []
    play(tmp_path, team, ball, until=6.0, watch=lambda tick: places.append(tick.world["ball"]))
    assert min(math.hypot(place["x"], 0.0) for place in places) < 8.0
