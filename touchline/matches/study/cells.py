"""The cells of a study: combinations of levels, each with the match that is played in it."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

from schemas.config.match_config import MatchConfig, load_match
from schemas.config.shipped_teams import brain_of
from schemas.config.toml_file import with_files
from schemas.errors import TouchlineError
from schemas.side import Side
from touchline.matches.series.plan import with_brains
from touchline.matches.study.study_config import Study

SHORT_KEYS = {"noise": "noise.preset"}
"""Key of a study → the key of a match file that it stands for."""


@dataclass(frozen=True, slots=True)
class Cell:
    """One combination of levels."""

    levels: Mapping[str, Any]
    """Key of the study → its level; empty in a study without factors."""
    config: MatchConfig
    """The match, without the seed."""

    @property
    def label(self) -> str:
        """All levels in one line."""
        return ", ".join(f"{key} = {level_text(level)}" for key, level in self.levels.items()) or "all matches"


def level_text(level: Any) -> str:
    """A level as it is shown: text as it is, anything else as JSON."""
    return level if isinstance(level, str) else json.dumps(level, ensure_ascii=False)


def combinations(study: Study) -> list[dict[str, Any]]:
    """The levels of each cell, the first factor varying slowest."""
    if study.cells:
        return study.cells
    return [dict(zip(study.factors, levels, strict=True)) for levels in product(*study.factors.values())]


def cells_of(study: Study, folder: Path) -> list[Cell]:
    """The cells of a study whose file is in `folder`.

    Raises:
        TouchlineError: a level is not valid in a match file.
    """
    match = folder / study.match if study.match is not None else None
    return [Cell(levels, _config(study, levels, match, folder)) for levels in combinations(study)]


def _config(study: Study, levels: Mapping[str, Any], match: Path | None, folder: Path) -> MatchConfig:
    keys = with_files({SHORT_KEYS.get(key, key): value for key, value in {**study.settings, **levels}.items()}, folder)
    teams = {side: keys.pop(side.value) for side in Side if side.value in keys}
    for side, team in teams.items():
        if not isinstance(team, str):
            raise TouchlineError(f"{side} is {team!r}; give the name of a shipped team, module:Class or policy:FILE")
    config = load_match(match, keys)
    return with_brains(config, {side: brain_of(team) for side, team in teams.items()})
