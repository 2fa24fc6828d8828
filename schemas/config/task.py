"""The task of a match file: what is scored, who is controlled, and the zones that the score names.

The text of the score's module is embedded like a profile: a config is self-contained, so that a recording can be judged
again where the module's file is not, or has changed since.
"""

import ast
import math
from collections.abc import Iterable
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, StringConstraints, model_validator

from schemas.config.config_model import ConfigModel
from schemas.errors import TouchlineError, did_you_mean
from schemas.frames import rotate
from schemas.side import Side
from schemas.wire.message import Name


class GameName(StrEnum):
    """A game that a match can be played by."""

    SOCCER = "soccer"
    FREE = "free"


REMEDIES = {
    "game": f"one of {', '.join(GameName)}",
    "task": "write [task], and below it score",
    "task.side": "cyan or magenta",
    "task.score": 'write "module:function"',
    "task.zones": "write [[task.zones]] above each zone",
    "task.zones.place": "x and y of the centre in m",
    "task.zones.size": "x and y of a rectangle in m",
}
"""Key → remedy for an invalid value."""


Extent = Annotated[float, Field(gt=0, le=100)]
"""m."""


class Zone(ConfigModel):
    """A part of the floor, which the score names and viewers draw: a circle or a rectangle."""

    name: Name
    """Name of the zone."""
    place: Annotated[list[float], Field(min_length=2, max_length=2)]
    """x and y of its centre in m, field frame."""
    radius: Extent | None = None
    """Radius of a circle in m; None for a rectangle."""
    size: Annotated[list[Extent], Field(min_length=2, max_length=2)] | None = None
    """Size of a rectangle in m: x along its heading, y across; None for a circle."""
    heading: float = 0.0
    """Direction of a rectangle's `size` x in the field frame, in rad."""

    @model_validator(mode="after")
    def _check_shape(self) -> "Zone":
        if (self.radius is None) == (self.size is None):
            raise ValueError(f'zone "{self.name}": give radius or size = [x, y]')
        return self

    def contains(self, x: float, y: float) -> bool:
        """Whether a point of the field frame, m, lies in the zone or on its edge."""
        away_x, away_y = x - self.place[0], y - self.place[1]
        if self.size is None:
            return math.hypot(away_x, away_y) <= (self.radius or 0.0)
        along, across = rotate(away_x, away_y, -self.heading)
        return abs(along) <= self.size[0] / 2 and abs(across) <= self.size[1] / 2


class TaskConfig(ConfigModel):
    """A task: a score of the match, whatever its game is, which can end it.

    With a task, the `duration` of the match is the simulated time after which it ends, and the start of its scene is
    drawn from the seed, as the scene's `vary` allows.
    """

    score: Annotated[str, Field(pattern=r"^[A-Za-z_][\w.]*:[A-Za-z_]\w*$")]
    """`module:function` that scores each tick, see `sim_host.task.score`; the module is a file beside the match file or
    in the current directory."""
    unit: Annotated[str, StringConstraints(max_length=20)] = ""
    """Unit of the score, for display."""
    side: Side = Side.CYAN
    """The side that does the task: its robots are played by the brain or the policy that is scored."""
    zones: Annotated[list[Zone], Field(max_length=100)] = Field(default_factory=list)
    """Parts of the floor that the score names."""
    program: str = Field(default="", repr=False)
    """Text of the score's module; a match file gives none."""

    @model_validator(mode="after")
    def _check_names(self) -> "TaskConfig":
        names = [zone.name for zone in self.zones]
        if doubled := next((name for name in names if names.count(name) > 1), None):
            raise ValueError(f'two zones are named "{doubled}"; every zone has a name of its own')
        return self


def score_text(value: float | None, unit: str) -> str:
    """A score with its unit, for people: `0.25 m`; a dash before the first tick."""
    return f"{value:.6g} {unit}".rstrip() if value is not None else "–"


def with_program(content: dict[str, Any], where: str, folders: Iterable[Path]) -> dict[str, Any]:
    """The content of a match file with the text of its score's module.

    Args:
        where: names the match file.
        folders: where the module is looked for.

    Raises:
        TouchlineError: there is no such module, it is no Python, or it has no such function.
    """
    task = content.get("task")
    score = task.get("score") if isinstance(task, dict) else None
    if not isinstance(task, dict) or not isinstance(score, str) or ":" not in score:
        return content  # the validator names what is wrong
    if "program" in task:
        raise TouchlineError(f'{where}: task.program is not for match files; write task.score = "module:function"')
    module, _, name = score.partition(":")
    file = _file_of(module, f'{where}: task.score is "{score}"', folders)
    program, names = _read(file, f'{where}: task.score is "{score}"')
    if name not in names:
        hint = did_you_mean(name, names) if names else "it defines none"
        raise TouchlineError(f'{where}: task.score is "{score}"; {file} has no function {name}; {hint}')
    return content | {"task": {**task, "program": program}}


def _file_of(module: str, fault: str, folders: Iterable[Path]) -> Path:
    folders = list(dict.fromkeys(folder.resolve() for folder in folders))
    stem = Path(*module.split(".")).with_suffix(".py")
    for folder in folders:
        if (folder / stem).is_file():
            return folder / stem
    raise TouchlineError(f"{fault}; there is no {stem} in {' or '.join(map(str, folders))}; put its file there")


def _read(file: Path, fault: str) -> tuple[str, list[str]]:
    """The text of a module, and the functions that it defines."""
    try:
        program = file.read_text("utf-8")
        tree = ast.parse(program)
    except SyntaxError as error:
        raise TouchlineError(f"{fault}; {error.msg} ({file}, line {error.lineno})") from None
    except ValueError as error:  # other bytes than those of a text
        raise TouchlineError(f"{fault}; {error} ({file})") from None
    return program, [node.name for node in tree.body if isinstance(node, ast.FunctionDef)]
