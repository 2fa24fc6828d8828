"""A ghost: a robot that repeats its recorded inputs and ignores the running match.

    python -m touchline.play.ghost RECORDING.mcap

It is a program of lines: briefing and sights on standard input, a command for each sight on standard output.
"""

import json
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from recordings.reading.recording import Recording, open_recording
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.messages.applied import Applied
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from schemas.side import Side
from schemas.topics import APPLIED


class Ghost:
    """Answers the sight of tick k with the recorded input of tick k + 1; rests if that input is not recorded."""

    def __init__(self, robot: str, recorded: Iterable[Applied]) -> None:
        """`recorded` yields the inputs of a match, in order; it is read lazily."""
        self._robot = robot
        self._recorded = iter(recorded)
        self._next = next(self._recorded, None)

    def act(self, sight: Sight) -> Command:
        """The recorded input of this robot at the tick after the sight."""
        wanted = sight.tick + 1
        while self._next is not None and self._next.tick < wanted:
            self._next = next(self._recorded, None)
        recorded_input = (
            self._next.inputs.get(self._robot) if self._next is not None and self._next.tick == wanted else None
        )
        if recorded_input is None:
            return Command(answers_tick=sight.tick)
        return Command(
            answers_tick=sight.tick,
            drive=recorded_input.drive,
            dribble=recorded_input.dribble,
            kick=recorded_input.kick,
        )


def inputs_of(recording: Recording) -> Iterator[Applied]:
    """The inputs of a recorded match, tick by tick."""
    return (applied for _, applied in recording.decoded(APPLIED.key))


def teams_of(ghosts: Iterable[str]) -> dict[str, dict[str, Any]]:
    """The teams of a match file for ghosts such as `magenta=FILE`: side → team, with the recorded robots.

    Raises:
        TouchlineError: not a side and a recording, a side twice, or a recording without the match setup.
    """
    teams: dict[str, dict[str, Any]] = {}
    for ghost in ghosts:
        word, _, file = ghost.partition("=")
        if word not in list(Side) or not file:
            raise TouchlineError(f'--ghost is "{ghost}"; write it as magenta=RECORDING.mcap')
        if word in teams:
            raise TouchlineError(f'--ghost is "{ghost}", and another one plays {word}; leave one of them out')
        team = open_recording(Path(file)).setup.teams[Side(word)]
        teams[word] = {
            "name": f"{team.name}, recorded",
            "stdio": [sys.executable, "-P", "-m", "touchline.play.ghost", str(Path(file).resolve())],
            "size": max(1, len(team.robots)),
            "robots": team.robots,
            "types": team.types,
        }
    return teams


def check_ghosts(config: MatchConfig, ghosts: Iterable[str]) -> None:
    """Check that the recordings can be played in this match.

    Raises:
        TouchlineError: the tick length differs, or the robots of that side differ.
    """
    tick = config.load_profile().time.tick
    for ghost in ghosts:
        word, _, file = ghost.partition("=")
        setup = open_recording(Path(file)).manifest.setup
        if setup is not None and setup.time.tick != tick:
            raise TouchlineError(
                f"--ghost {ghost}: its ticks last {setup.time.tick:g} s, those of this match {tick:g} s; "
                f"play it with --profile {setup.profile}"
            )
        robots = setup.teams[Side(word)].robots if setup is not None else []
        strangers = [name for name in config.robots(Side(word)) if name not in robots]
        if strangers:
            raise TouchlineError(f"--ghost {ghost}: {', '.join(strangers)} did not play there; name another recording")


def main() -> None:
    """Play the robot of the briefing until the end of the input."""
    briefing, lines = json.loads(sys.stdin.buffer.readline()), sys.stdin.buffer
    ghost = Ghost(briefing["robot"], inputs_of(open_recording(Path(sys.argv[1]))))
    for line in lines:
        sys.stdout.buffer.write(ghost.act(Sight.decode(line)).encode() + b"\n")
        sys.stdout.buffer.flush()


if __name__ == "__main__":
    main()
