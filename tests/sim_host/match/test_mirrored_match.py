"""A mirrored match is the mirrored match: brains, kick-off, start poses and all random draws exchanged.

Until a robot touches the ball or another robot, both are equal to rounding. From then on they differ by what the
engine leaves in its search for contact points, which depends on the direction in the field; contacts multiply it.
"""

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import NamedTuple

import pytest

from schemas.config.match_config import MatchConfig, load_match
from schemas.messages.soccer.game import GameEvent
from schemas.side import Side
from sim_host.match import subsystems
from sim_host.match.world_fields import Fields
from sim_host.sensing.random_streams import Floats, RandomStreams, StreamId, Words
from touchline.play.play_match import InProcessMatch

TEAMS = {"simple": "robot_agent.teams.simple:Simple", "nubot": "robot_agent.teams.nubot:NuBot"}
ROUNDING = 1e-9
"""m."""
NEAR = 0.5
"""m; robots whose centres are this near may touch: their hulls have a radius of 0.245 m."""
AFTER_A_KICK_OFF = 2e-3
"""m; between robots and balls of two matches 4 s after the start, with a handful of contacts."""


def config(cyan: str, magenta: str, kick_off: Side) -> MatchConfig:
    """A match of the profile `msl`, with its noise and its radio."""
    teams = {side.value: {"brain": TEAMS[team]} for side, team in zip(Side, (cyan, magenta), strict=True)}
    return load_match(None, {"teams": teams, "referee": {"kick_off": kick_off.value}})


def swapped(text: str) -> str:
    """A text with the colours exchanged."""
    return text.replace("cyan", "\0").replace("magenta", "cyan").replace("\0", "magenta")


class ExchangedStreams(RandomStreams):
    """Random streams in which each robot has the draws of its counterpart: draws are keyed by the names of robots."""

    def pairwise_uniforms(
        self, stream: StreamId, robots: Sequence[str], others: Sequence[str], ticks: Sequence[int]
    ) -> Floats:
        return super().pairwise_uniforms(stream, robots, [swapped(name) for name in others], ticks)

    def _uniforms(self, stream: StreamId, robots: Sequence[str], ticks: Sequence[int], index: Words) -> Floats:
        return super()._uniforms(stream, [swapped(name) for name in robots], ticks, index)


def with_exchanged_draws(config: MatchConfig) -> InProcessMatch:
    """A match in which the colours have exchanged their draws."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(subsystems, "RandomStreams", ExchangedStreams)
        return InProcessMatch(config)


class Step(NamedTuple):
    """One tick of both matches."""

    time: float
    apart: float
    """m; greatest distance of a body from its mirrored counterpart."""
    touched: bool
    """A robot has touched the ball or another robot."""
    events: tuple[list[GameEvent], list[GameEvent]]
    sights: tuple[Mapping[str, bytes], Mapping[str, bytes]]


def closest_robots(world: Fields) -> float:
    """m between the centres of the two robots that are closest to each other."""
    places = [(robot["x"], robot["y"]) for robot in world["robots"].values()]
    return min(math.dist(one, other) for one, other in combinations(places, 2))


def side_by_side(one: MatchConfig, other: MatchConfig, seconds: float) -> Iterator[Step]:
    """Both matches tick by tick."""
    matches = InProcessMatch(one), with_exchanged_draws(other)
    touched = False
    for _ in range(round(seconds / matches[0].simulation.profile.time.tick)):
        here, there = (match.step() for match in matches)
        bodies, counterparts = ({**tick.world["robots"], "ball": tick.world["ball"]} for tick in (here, there))
        apart = max(
            math.hypot(body["x"] + counterparts[swapped(name)]["x"], body["y"] + counterparts[swapped(name)]["y"])
            for name, body in bodies.items()
        )
        touched = touched or bool(here.world.get("touches")) or closest_robots(here.world) < NEAR
        yield Step(here.time, apart, touched, (list(here.events), list(there.events)), (here.sights, there.sights))
    for match in matches:
        match.simulation.close()


@pytest.mark.slow
@pytest.mark.parametrize("kick_off", Side)
@pytest.mark.parametrize(
    "teams", [("simple", "nubot"), pytest.param(("nubot", "nubot"), marks=pytest.mark.long)], ids=" – ".join
)
def test_with_sides_brains_and_kick_off_exchanged_a_match_is_the_mirrored_match(teams, kick_off: Side) -> None:
    cyan, magenta = teams
    events: tuple[list[GameEvent], list[GameEvent]] = ([], [])
    for step in side_by_side(config(cyan, magenta, kick_off), config(magenta, cyan, kick_off.opponent), 4.0):
        assert step.apart < (AFTER_A_KICK_OFF if step.touched else ROUNDING), f"at {step.time:.2f} s"
        if not step.touched:
            here, there = step.sights
            assert {name: json.loads(sight) for name, sight in here.items()} == {
                swapped(name): json.loads(swapped(sight.decode())) for name, sight in there.items()
            }
        for seen, new in zip(events, step.events, strict=True):
            seen.extend(new)
    assert step.touched and len(events[0]) >= 2
    facts = [[(event.tick, event.kind, event.rule, event.side, event.robot) for event in seen] for seen in events]
    assert facts[0] == [
        (tick, kind, rule, side and side.opponent, robot and swapped(robot))
        for tick, kind, rule, side, robot in facts[1]
    ]


def test_no_zero_that_a_robot_perceives_has_a_sign() -> None:
    """A minus before a zero would tell a robot which half of the field it plays in. What teammates write is theirs."""
    for step in side_by_side(config("simple", "nubot", Side.CYAN), config("nubot", "simple", Side.MAGENTA), 2.5):
        for sights in step.sights:
            perceived = [json.loads(sight) | {"radio": None} for sight in sights.values()]
            assert "-0.0," not in json.dumps(perceived) and "-0.0}" not in json.dumps(perceived)
