"""A task by its name or its file: who does it, and the match of each of its episodes."""

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

from schemas.config.match_config import MatchConfig, load_match
from schemas.config.task import TaskConfig
from schemas.errors import TouchlineError, did_you_mean
from schemas.side import Side

_SHIPPED = resources.files("touchline") / "tasks"


@dataclass(frozen=True, slots=True)
class Task:
    """A match file with a score."""

    config: MatchConfig
    folder: Path
    """Where its brains are looked for first."""

    @property
    def name(self) -> str:
        """Its name."""
        return self.config.name

    @property
    def description(self) -> str:
        """What is done and scored, in one sentence: that of its scene."""
        return self.config.scene.description if self.config.scene is not None else ""

    @property
    def scored(self) -> TaskConfig:
        """Its score and its zones."""
        assert self.config.task is not None  # as `load_task` checks
        return self.config.task

    @property
    def side(self) -> Side:
        """The side that does it."""
        return self.scored.side

    @property
    def robots(self) -> list[str]:
        """The robots that do it."""
        return self.config.robots(self.side)

    @property
    def unit(self) -> str:
        """Unit of its score."""
        return self.scored.unit

    def episode(self, seed: int) -> MatchConfig:
        """The match of a seed."""
        return self.config.model_copy(update={"seed": seed})


def shipped_tasks() -> list[str]:
    """The names of the tasks that ship."""
    return sorted(file.name.removesuffix(".toml") for file in _SHIPPED.iterdir() if file.name.endswith(".toml"))


def load_task(name: str | Path, brain: str | None = None, overrides: Mapping[str, Any] | None = None) -> Task:
    """A shipped task by its name, or one of a user from the path of its match file.

    Args:
        name: the name, or a path that ends in `.toml`.
        brain: who does it, in place of the brain in its file: `module:Class` or `policy:FILE`.
        overrides: keys of its match file, with dots.

    Raises:
        TouchlineError: there is no such task, or its file is invalid or has no table `task`.
    """
    path = Path(name)
    if path.suffix != ".toml":
        if (name := str(name)) not in (known := shipped_tasks()):
            raise TouchlineError(f'no task is named "{name}"; give a name or a .toml file; {did_you_mean(name, known)}')
        path = Path(str(_SHIPPED / f"{name}.toml"))
    config = load_match(path, dict(overrides or {}))
    if config.task is None:
        raise TouchlineError(f'{name} is a match without a score; write [task], and below it score = "module:function"')
    if brain is None:
        return Task(config, path.parent)
    side = config.task.side.value
    return Task(load_match(path, {**(overrides or {}), f"teams.{side}.brain": brain}), path.parent)
