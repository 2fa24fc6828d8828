"""Prints the transcript of docs/robot.md: `python docs/generate/robot_transcript.py`.

It is that of a match of examples/stdio_robot; numbers are rounded to three decimals, lines broken to the page width.
"""

import json
import textwrap
from pathlib import Path
from typing import Any

from robot_agent.process.stdio.command_line import command_line
from robot_agent.process.stdio.program import StdioProgram, briefing_line
from robot_agent.sdk.contract import Briefing
from schemas.config.match_config import load_match
from schemas.messages.command import Command
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from touchline.play.play_match import play_match

MATCH = Path(__file__).resolve().parents[2] / "examples" / "stdio_robot" / "javascript.toml"
SHOWN = (0, 1, 100, 150, 151, 152)
"""Ticks whose lines are printed."""
WIDTH = 118
_SETUP = ("match", "pace", "time", "pitch", "robot", "drive", "kicker")
"""The parts of the setup that are printed."""


class Noted:
    """A program whose lines are noted."""

    def __init__(self, program: StdioProgram) -> None:
        self.program = program
        self.lines: list[str] = []

    def act(self, sight: Sight) -> Command:
        """The command of the program."""
        command = self.program.act(sight)
        if sight.tick in SHOWN:
            self.lines += [
                *line("<", rounded(json.loads(sight.encode()))),
                *line(">", rounded(without_defaults(command))),
                "",
            ]
        return command


def transcript() -> str:
    """The lines of the first three seconds of the match."""
    config = load_match(MATCH)
    assert config.teams.cyan.stdio is not None
    setup = Setup.of(config, config.load_profile(), config.load_rule_book())
    briefing = Briefing.of("cyan1", setup)
    first = json.loads(briefing_line(briefing))
    parts = {name: rounded(first["setup"][name]) for name in _SETUP}
    text = json.dumps({**first, "setup": parts}, separators=(",", ":"))
    noted = Noted(StdioProgram(command_line(config.teams.cyan.stdio, MATCH.parent), briefing))
    play_match(config, {"cyan1": noted}, until=(SHOWN[-1] + 1) * setup.time.tick)
    noted.program.close()
    return "\n".join([*line("<", text.removesuffix("}}") + ",…}}"), "", *noted.lines]).rstrip() + "\n"


def line(mark: str, content: Any) -> list[str]:
    """One line of the program, with a mark of its direction, broken to the width of the page."""
    text = content if isinstance(content, str) else json.dumps(content, separators=(",", ":"))
    spaced = text.replace(",", ", ").replace("  ", " ")
    lines = textwrap.wrap(spaced, WIDTH - 2, break_long_words=False, break_on_hyphens=False)
    return [f"{mark} {lines[0]}", *(f"  {rest}" for rest in lines[1:])]


def rounded(value: Any) -> Any:
    """The same JSON value with numbers of at most three decimals."""
    if isinstance(value, dict):
        return {key: rounded(one) for key, one in value.items()}
    if isinstance(value, list):
        return [rounded(one) for one in value]
    return round(value, 3) + 0.0 if isinstance(value, float) else value


def without_defaults(command: Command) -> dict[str, Any]:
    """The fields that the program has written, as far as they differ from their defaults."""
    plain, default = command.plain(), Command(answers_tick=command.answers_tick).plain()
    return {name: value for name, value in plain.items() if name == "answers_tick" or value != default[name]}


if __name__ == "__main__":
    print(transcript(), end="")
