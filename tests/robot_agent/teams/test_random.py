"""The team that acts at random within the rules."""

import math
from collections import Counter

import pytest

from robot_agent.sdk.skills.keep_out import Area
from robot_agent.teams.set_piece import required_distance
from schemas.config.match_config import load_match
from schemas.soccer.game import EventKind, Point, TeamPhase
from touchline.play.play_match import play_match

RANDOM = "robot_agent.teams.random:Random"
SPOTS = {
    TeamPhase.OUR_KICK_OFF: (0.0, 0.0),
    TeamPhase.THEIR_KICK_OFF: (0.0, 0.0),
    TeamPhase.OUR_THROW_IN: (3.0, 6.85),
    TeamPhase.THEIR_THROW_IN: (-3.0, -6.85),
    TeamPhase.THEIR_CORNER: (-10.7, -6.7),
    TeamPhase.THEIR_GOAL_KICK: (7.4, 3.5),
    TeamPhase.THEIR_FREE_KICK: (-7.4, 0.0),
    TeamPhase.DROP_BALL: (1.5, -2.0),
}


@pytest.mark.parametrize("phase", SPOTS)
def test_before_start_its_robots_take_legal_places(squad, setup, phase):
    made, (x, y) = squad("random"), SPOTS[phase]
    for _ in range(350):
        made.move(made.act(ball=(x, y), phase=phase, running=False, spot=Point(x=x, y=y)))
    away = {name: math.dist(pose[:2], (x, y)) - setup.robot.radius for name, pose in made.poses.items()}
    taker = min(away, key=away.get) if phase.ours else None
    area = Area.penalty(setup.pitch)
    for name, (at_x, at_y, _) in made.poses.items():
        assert name == taker or away[name] >= required_distance(phase, setup.restarts), name
        assert name == "cyan1" or not area.has(math.copysign(1.0, at_x), at_x, at_y)
        assert "kick_off" not in phase or at_x < 0.0


def test_its_robots_do_different_things_one_after_the_other(squad):
    made, seen = squad("random"), Counter()
    for _ in range(1000):
        commands = made.act(ball=(1.0, 1.0))
        made.move(commands)
        seen.update(heard.intention for heard in made.said.values())
    assert {"drive about", "go for the ball", "keep"} <= set(seen)


def test_a_robot_with_the_ball_carries_it_or_kicks_it_anywhere(squad):
    made, kicks, drives = squad("random", {1: (-10.5, 0.0, 0.0), 2: (0.0, 0.0, 0.0)}), [], []
    for _ in range(1500):
        command = made.act(ball=(0.35, 0.0), holding=True)["cyan2"]
        made.poses["cyan2"] = (0.0, 0.0, made.poses["cyan2"][2] + 0.02 * command.drive.omega)
        kicks += [command.kick] if command.kick is not None else []
        drives.append(math.hypot(command.drive.vx, command.drive.vy))
    assert len({kick.speed for kick in kicks}) > 3
    assert max(drives) > 1.0


def test_a_match_of_two_random_teams_goes_on_after_each_stop_and_is_equal_when_played_again():
    teams = {side: {"brain": RANDOM, "size": 3} for side in ("cyan", "magenta")}
    config = load_match(None, {"seed": 3, "rules": "msl", "duration": 8.0, "teams": teams})
    chains: list[str] = []
    events = play_match(config, watch=lambda tick: chains.append(tick.applied["chain"])).events
    stops = [event for event in events if event.kind is EventKind.STOP]
    starts = [event for event in events if event.kind is EventKind.START]
    assert len(starts) >= len(stops) > 0
    again = play_match(config, until=1.5)
    assert again.chain == chains[again.ticks - 1]
