"""Matches in one process: brains, sights and commands as over the bus, and nothing that two robots share."""

import math
from collections.abc import Iterator
from typing import Any

import msgspec
import pytest

from message_examples import examples
from robot_agent.teams.simple import Simple
from schemas.config.match_config import load_match
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.radio import Motion, Radio
from schemas.messages.sight import ReceivedRadio, Sight
from schemas.messages.soccer.game import DisciplinaryRecord
from schemas.soccer.game import OffField
from schemas.wire.message import BadMessageError
from touchline import Brain, Briefing
from touchline.play.play_match import InProcessMatch


class OverBytes(InProcessMatch):
    """A match whose sights and commands cross as on the bus."""

    def answers(self) -> dict[str, Command]:
        sights = self.simulation.now.sights
        return {
            name: Command.decode(brain.act(Sight.decode(sights[name])).encode()) for name, brain in self.brains.items()
        }


def played(kind: type[InProcessMatch], brain: type[Brain]) -> tuple[str, list[str]]:
    """The chain of 1 s of a match of two a side with this brain for cyan1, and all sights of its teammate."""
    noted: list[str] = []

    class Teammate(Simple):
        def act(self, sight: Sight) -> Command:
            noted.append(repr(sight))
            return super().act(sight)

    config = load_match(None, {"teams.cyan.size": 2, "teams.magenta.size": 2, "seed": 7})
    match = kind(config, {"cyan1": brain, "cyan2": Teammate})
    for _ in range(50):
        match.step()
    match.close()
    return match.simulation.now.applied["chain"], noted


class Meddler:
    """Changes what it is given and what it has sent, and gives whole numbers."""

    def __init__(self, briefing: Briefing) -> None:
        self.sent: list[dict[str, Any]] = []

    def act(self, sight: Sight) -> Command:
        for before in self.sent:
            before["plan"] = "another"
        sight.obstacles.clear()
        for message in sight.radio.values():
            message.extra["plan"] = "mine"
        sight.radio.clear()
        sight.game.robots["cyan2"] = DisciplinaryRecord(red=1, off_field=OffField.RED_CARD)
        sight.outcome.refused.append("all of it")
        self.sent.append({"plan": "first", "tick": sight.tick})
        drive = Drive().replace(vx=1, omega=2)
        return Command(answers_tick=sight.tick).replace(drive=drive, radio=Radio().replace(extra=self.sent[-1]))


def containers(value: Any) -> Iterator[list[Any] | dict[Any, Any]]:
    """All lists and mappings in a message."""
    if isinstance(value, list | dict):
        yield value
        for one in value.values() if isinstance(value, dict) else value:
            yield from containers(one)
    if isinstance(value, msgspec.Struct):
        for name in value.__struct_fields__:
            yield from containers(getattr(value, name))


def test_a_copy_of_a_sight_shares_no_list_and_no_mapping() -> None:
    sight = examples()[Sight]
    sight = sight.replace(
        radio={"cyan1": ReceivedRadio(age=0.1, extra={"plan": 1})},
        game=sight.game.replace(robots={"cyan3": DisciplinaryRecord(yellow=1)}),
        outcome=sight.outcome.replace(refused=["kick: the ball is not held"]),
    )
    shared = {id(one) for one in containers(sight)}
    copied = sight.own_copy()
    assert copied == sight and repr(copied) == repr(sight)
    assert len(shared) >= 7 and shared.isdisjoint(id(one) for one in containers(copied))


def test_a_match_over_messages_is_the_match_over_bytes() -> None:
    assert played(InProcessMatch, Simple) == played(OverBytes, Simple)


def test_what_a_brain_changes_in_its_sight_or_its_command_reaches_nobody_else() -> None:
    chain, sights = played(InProcessMatch, Meddler)
    assert (chain, sights) == played(OverBytes, Meddler)
    assert "first" in sights[-1] and "another" not in "".join(sights)


@pytest.mark.parametrize(
    "change",
    [
        {"drive": Drive().replace(vx=math.nan)},
        {"drive": Drive().replace(vy="1")},
        {"drive": Drive().replace(omega=51.0)},
        {"drive": None},
        {"kick": Kick(mode=KickMode.LOB, speed=8.0).replace(mode="high")},
        {"radio": Radio().replace(extra={"plan": [1]})},
        {"radio": Radio().replace(self=Motion(x=math.inf, y=0.0, heading=0.0))},
        {"answers_tick": -1},
        {"version": "3.0"},
        {"dribble": object()},
    ],
)
def test_a_command_that_no_host_accepts_is_refused_in_the_same_words(change: dict[str, Any]) -> None:
    class Wrong:
        def __init__(self, briefing: Briefing) -> None:
            pass

        def act(self, sight: Sight) -> Command:
            return Command(answers_tick=sight.tick).replace(**change)

    said = []
    for kind in (InProcessMatch, OverBytes):
        with pytest.raises((BadMessageError, TypeError)) as error:
            played(kind, Wrong)
        said.append((error.type, str(error.value)))
    assert said[0] == said[1]
