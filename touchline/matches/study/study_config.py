"""The study file: what is varied, what is measured, and how many matches are played."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, field_validator, model_validator

from schemas.config.config_model import ConfigModel
from schemas.config.toml_file import read_tables, validate_tables
from schemas.errors import TouchlineError
from schemas.wire.message import Name
from touchline.matches.engine.planned_match import Way
from touchline.matches.series.seeds import seeds_of

FunctionPath = Annotated[str, Field(pattern=r"^[A-Za-z_][\w.]*:[A-Za-z_]\w*$")]

REMEDIES = {
    "name": "lower-case letters, digits and _",
    "seeds": 'a range and single seeds in quotes, such as "1-20" or "1-10,31"',
    "factors": 'write key = [level, level] below [factors], for example "radio.loss" = [0, 0.2]',
    "cells": 'write [[cells]] above each cell, and below it key = level, for example "radio.loss" = 0.2',
    "settings": "write [settings], and below it keys of a match file",
    "functions": 'write name = "module:function" below [functions]',
    "way": '"in_process" or "processes"',
    "record": 'true, false or "inputs"',
    "responses": 'names of figures, for example ["goals.difference", "goals"]',
    "until_interval": "width of the interval of the first response, above 0",
    "most_seeds": "most seeds of a cell, from 2",
}
"""Key → remedy for an invalid value."""

DEFAULT_RESPONSES = ("goals.difference", "goals", "passes_completed", "shots")


class Study(ConfigModel):
    """A study; `load_study` reads it from a file."""

    name: Name
    """Name of the study, for its folder."""
    title: str = ""
    """Heading of the report; where it is empty, the name."""
    question: str = ""
    """What the study is to answer, printed at the head of the report."""
    match: str | None = None
    """Path of the match file, from the folder of the study file; None for a five-a-side friendly."""
    seeds: str = "1-10"
    """Seeds of each cell: the same ones in all cells."""
    both_sides: bool = True
    """Each seed is played twice, the second time with the teams on each other's side."""
    way: Way = Way.IN_PROCESS
    """How the matches are played: each in one process, or with processes, for teams whose programs need them."""
    settings: dict[str, Any] = Field(default_factory=dict)
    """Keys of the match file with the value that they have in all cells."""
    factors: dict[str, Annotated[list[Any], Field(min_length=1)]] = Field(default_factory=dict)
    """Key of the match file → its levels; the cells are all combinations."""
    cells: list[dict[str, Any]] = Field(default_factory=list)
    """The cells one by one, in place of factors: each has a level for the same keys."""
    responses: Annotated[list[str], Field(min_length=1)] = list(DEFAULT_RESPONSES)
    """Figures that the report compares; the table of results has all figures. The first is the primary one."""
    functions: dict[Name, FunctionPath] = Field(default_factory=dict)
    """Name of a response → `module:function`, which is called with the recording of a match and returns a number."""
    record: bool | Literal["inputs"] = False
    """Each match leaves its recording in the folder of the study; `inputs` for one that has no more than it takes to
    simulate the match again."""
    until_interval: Annotated[float, Field(gt=0)] | None = None
    """Seeds are added until the 95 % interval of the primary response is at most this wide; None for `seeds` alone."""
    most_seeds: Annotated[int, Field(ge=2, le=100_000)] = 200
    """Most seeds of a cell that `until_interval` may lead to."""

    @field_validator("seeds")
    @classmethod
    def _check_seeds(cls, seeds: str) -> str:
        try:
            seeds_of(seeds)
        except TouchlineError as error:
            raise ValueError(str(error).partition(", ")[2] or str(error)) from None
        return seeds

    @field_validator("settings", "factors", mode="before")
    @classmethod
    def _flatten(cls, tables: Any) -> Any:
        return with_dotted_keys(tables) if isinstance(tables, dict) else tables

    @field_validator("cells", mode="before")
    @classmethod
    def _flatten_each(cls, cells: Any) -> Any:
        if not isinstance(cells, list):
            return cells
        return [with_dotted_keys(cell) if isinstance(cell, dict) else cell for cell in cells]

    @model_validator(mode="after")
    def _check(self) -> "Study":
        if self.factors and self.cells:
            raise ValueError("factors and cells are both given; a study has one or the other")
        for key, levels in self.factors.items():
            if any(level in levels[:place] for place, level in enumerate(levels)):
                raise ValueError(f"factors.{key} has a level twice; equal levels give equal matches")
        for cell in self.cells:
            if set(cell) != set(self.cells[0]):
                one, other = (", ".join(keys) for keys in (self.cells[0], cell))
                raise ValueError(f"cells have different keys, {one} and {other}; give each all")
        if self.functions and self.record == "inputs":
            raise ValueError('record is "inputs", and functions need whole recordings; leave record out')
        if self.both_sides and "score" in self.responses:
            raise ValueError('responses has "score", of one side\'s task; write both_sides = false')
        varied = [*self.factors, *(self.cells[0] if self.cells else ())]
        if doubled := next((key for key in varied if key in self.settings), None):
            raise ValueError(f"{doubled} is both a setting and varied; leave one out")
        if fixed := next((key for key in (*varied, *self.settings) if key == "seed"), None):
            raise ValueError(f'{fixed} is not for factors; write seeds = "1-20"')
        return self

    @property
    def first_seeds(self) -> list[int]:
        """The seeds that are played in any case."""
        return seeds_of(self.seeds)

    @property
    def matches_of_seed(self) -> int:
        """How many matches a seed has in each cell."""
        return 2 if self.both_sides else 1

    @property
    def primary(self) -> str:
        """The response that `until_interval` is about."""
        return self.responses[0]


def load_study(path: Path, overrides: Mapping[str, Any] | None = None) -> Study:
    """The study of a file; `overrides` replace its values.

    Raises:
        TouchlineError: one line that names file, key, value and remedy.
    """
    content = {"name": path.stem} | read_tables(path, "a study file") | dict(overrides or {})
    return validate_tables(Study, content, str(path), REMEDIES)


def with_dotted_keys(tables: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested tables as one, with keys such as `radio.loss`."""
    flat: dict[str, Any] = {}
    for key, value in tables.items():
        if isinstance(value, dict) and value:
            flat |= with_dotted_keys(value, f"{prefix}{key}.")
        else:
            flat[f"{prefix}{key}"] = value
    return flat
