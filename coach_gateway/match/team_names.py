"""The teams' names in texts for people, in place of the sides' where the match file gives names."""

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass

from schemas.config.match_config import MatchConfig
from schemas.config.task import score_text
from schemas.messages.setup import Setup
from schemas.side import Side
from schemas.soccer.game import Score

_SIDES = re.compile(rf"\b({'|'.join(Side)})\b")


def printable(text: str) -> str:
    """A text from the network as one line without control characters, which a terminal would obey."""
    return "".join(letter if letter.isprintable() else "\N{REPLACEMENT CHARACTER}" for letter in text)


@dataclass(frozen=True, slots=True)
class TeamNames:
    """The names of both teams; a team without a name is called as its side."""

    cyan: str = Side.CYAN.value
    magenta: str = Side.MAGENTA.value
    playing: tuple[Side, ...] = tuple(Side)
    """The sides that have robots."""
    unit: str = ""
    """Unit of the score of a task."""
    has_goals: bool = True
    """Whether the game has goals; one without has only the score of its task."""

    @classmethod
    def of(
        cls, names: Mapping[Side, str], playing: Collection[Side] = tuple(Side), unit: str = "", *, goals: bool = True
    ) -> "TeamNames":
        """Two different names: a name that both teams have, or that is the other side's, gets its side."""
        shown = {side: printable(names[side]).strip() or side.value for side in Side}
        is_same = shown[Side.CYAN].casefold() == shown[Side.MAGENTA].casefold()
        for side in Side:
            if is_same or shown[side].casefold() == side.opponent.value:
                shown[side] = f"{shown[side]} ({side.value})"
        sides = tuple(side for side in Side if side in playing)
        return cls(shown[Side.CYAN], shown[Side.MAGENTA], sides, printable(unit), goals)

    @classmethod
    def of_match(cls, config: MatchConfig) -> "TeamNames":
        """The names in a match file."""
        playing = [side for side in Side if config.robots(side)]
        unit = config.task.unit if config.task is not None else ""
        return cls.of({side: config.team(side).name for side in Side}, playing, unit, goals=config.free is None)

    @classmethod
    def of_setup(cls, setup: Setup) -> "TeamNames":
        """The names that a host publishes."""
        playing = [side for side in Side if setup.teams[side].robots]
        unit = setup.task.unit if setup.task is not None else ""
        return cls.of({side: setup.teams[side].name for side in Side}, playing, unit, goals=setup.free is None)

    def __getitem__(self, side: Side) -> str:
        return self.cyan if side is Side.CYAN else self.magenta

    def with_side(self, side: Side) -> str:
        """A team with its side, `Lions (cyan)`; the side alone if the team has no name."""
        suffix = f" ({side.value})"
        name = self[side].removesuffix(suffix)
        return name if name == side.value else name + suffix

    def score(self, score: Score, value: float | None = None) -> str:
        """`Lions 2 : 0 NuBot`; the `value` of a task as `score 0.25 m`, after the goals where the game has any."""
        goals = [f"{self.cyan} {score.cyan} : {score.magenta} {self.magenta}"] if self.has_goals else []
        task = [] if value is None and self.has_goals else [f"score {score_text(value, self.unit)}"]
        return ", ".join([*goals, *task])

    def in_text(self, text: str) -> str:
        """The text of an event with the teams' names in place of the sides'; names of robots stay."""
        return _SIDES.sub(lambda side: self[Side(side[0])], text)

    def __str__(self) -> str:
        """The teams that have robots, with their sides."""
        return " – ".join(self.with_side(side) for side in self.playing)


SIDES_ALONE = TeamNames()
"""For a match whose names are not known."""
