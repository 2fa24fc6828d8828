"""The cup file: one frozen `CupConfig` from TOML, with errors that name file, key, value and remedy."""

import json
from collections.abc import Mapping
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, field_validator, model_validator

from schemas.config.config_model import ConfigModel
from schemas.config.match_config import MatchConfig, load_match
from schemas.config.match_parts import DEFAULT_SIZE, PROGRAM_KINDS
from schemas.config.roster import MAX_ROBOTS
from schemas.config.task import GameName
from schemas.config.toml_file import read_tables, validate_tables, with_files
from schemas.errors import TouchlineError, did_you_mean
from schemas.wire.message import Name
from touchline.matches.cup.formats.swiss import most_rounds
from touchline.matches.cup.standings import Points
from touchline.matches.cup.tie_breaks import CRITERIA, DEFAULT_ORDER, ORDERS, Ranking
from touchline.matches.engine.planned_match import Way

REMEDIES = {
    "name": "a cup's name has lower-case letters, digits and _",
    "seed": "a whole number from 0 to 2^31 - 1",
    "teams": "write [[teams]] above each team; a cup has 2 to 64",
    "teams.name": "1 to 40 characters",
    "teams.digest": "32 hexadecimal digits, as touchline tournament digest prints them",
    "format.kind": 'one of "round-robin", "groups", "knock-out", "swiss"',
    "format.best_of": "1 to 15 matches",
    "way": 'one of "in_process", "processes"',
}
"""Key → remedy for an invalid value."""
_OWN_KEYS = ("teams", "seed", "name", "pace", "record")
"""Keys of a match file that a cup decides itself."""
_FILES = ("scene", "profile", "profile_tables", "rules", "rule_book_tables")
"""Keys of a match that are read from files."""
MOST_TEAMS = 64


class FormatKind(StrEnum):
    """How teams meet."""

    ROUND_ROBIN = "round-robin"
    GROUPS = "groups"
    KNOCK_OUT = "knock-out"
    SWISS = "swiss"


class TeamEntry(ConfigModel):
    """A team of the cup; the order of teams is their seeding, the strongest first."""

    name: Annotated[str, Field(min_length=1, max_length=40)]
    """Name, for display; unique in the cup."""
    brain: str | None = None
    """The name of a shipped team, `module:Class` of a brain in Python, or `policy:FILE`."""
    command: list[str] | None = None
    """Command line of a program in any language, which joins on the network."""
    stdio: list[str] | None = None
    """Command line of a program that reads sights and writes commands as lines."""
    process: Literal["robot", "team"] = "robot"
    """With `way = "processes"`: a process for each robot, or one for all robots of the team."""
    version: str = ""
    """Version of the team, for display."""
    digest: Annotated[str, Field(pattern=r"^([0-9a-f]{32})?$")] = ""
    """Digest of its files as they were submitted; with other files, the cup does not begin."""
    challenge: float = 0.0
    """Points of the technical challenge, a tie-break."""
    size: Annotated[int, Field(ge=1, le=MAX_ROBOTS)] | None = None
    """Number of robots; None for the cup's."""

    @model_validator(mode="before")
    @classmethod
    def _refuse_remote(cls, content: Any) -> Any:
        if isinstance(content, dict) and "remote" in content:
            raise ValueError(
                "a remote team cannot be started again after a crash, and nobody can check which program played; "
                "give its brain, command or stdio, or play single matches with touchline match --remote"
            )
        return content

    @model_validator(mode="after")
    def _check_one_program(self) -> "TeamEntry":
        given = [kind for kind in PROGRAM_KINDS if getattr(self, kind) is not None]
        if len(given) != 1:
            found = " and ".join(given) or "none"
            raise ValueError(f'"{self.name}" has {found}; give one of brain, command and stdio')
        if self.process == "team" and self.brain is None:
            raise ValueError(f'"{self.name}" has {given[0]}; process = "team" is for a brain, leave it out')
        return self


class FormatConfig(ConfigModel):
    """The format of the cup."""

    kind: FormatKind = FormatKind.ROUND_ROBIN
    """How teams meet."""
    double: bool = False
    """Round robin and groups: each pair meets twice, on swapped sides."""
    best_of: Annotated[int, Field(ge=1, le=15)] = 1
    """Matches of each pair that count as one fixture, on swapped sides in each second one; of a league, all are
    played."""
    knock_out_best_of: Annotated[int, Field(ge=1, le=15)] | None = None
    """The same in the knock-out: odd, and over as soon as one team cannot be caught up with; None for `best_of`."""
    groups: Annotated[int, Field(ge=1, le=16)] = 2
    """Number of groups."""
    advance: Annotated[int, Field(ge=1, le=16)] = 2
    """Teams of each group that go on to the knock-out."""
    rounds: Annotated[int, Field(ge=1, le=32)] | None = None
    """Rounds of a Swiss tournament; None for as many as can be paired without a repetition."""
    third_place: bool = True
    """Knock-out: the losers of the semi-finals meet."""

    @property
    def has_knock_out(self) -> bool:
        """Whether the format ends with a knock-out."""
        return self.kind in (FormatKind.GROUPS, FormatKind.KNOCK_OUT)

    @property
    def knock_out_matches(self) -> int:
        """Most matches of a fixture in the knock-out."""
        return self.knock_out_best_of or self.best_of


class TableConfig(ConfigModel):
    """Points and tie-breaks; by default the rule book's."""

    win: Annotated[int, Field(ge=0, le=100)] = 3
    draw: Annotated[int, Field(ge=0, le=100)] = 1
    loss: Annotated[int, Field(ge=0, le=100)] = 0
    order: str | list[str] | None = None
    """A rule book whose order of tie-breaks applies, or the criteria themselves; None for the match's."""

    @field_validator("order")
    @classmethod
    def _check_order(cls, order: str | list[str] | None) -> str | list[str] | None:
        if isinstance(order, str) and order not in ORDERS:
            raise ValueError(f"{did_you_mean(order, ORDERS)} Or list criteria: {', '.join(CRITERIA)}")
        unknown = next((one for one in order if one not in CRITERIA), None) if isinstance(order, list) else None
        if unknown is not None:
            raise ValueError(f'"{unknown}" is no criterion; {did_you_mean(unknown, CRITERIA)}')
        return order


class SignificanceConfig(ConfigModel):
    """`--until-significant`: rounds are added to a round robin until the order of the ratings is significant."""

    budget: Annotated[int, Field(ge=1, le=100_000)] = 200
    """Most matches."""


class CupConfig(ConfigModel):
    """The complete description of a cup."""

    name: Name = "cup"
    """Name of the cup, and of its folder."""
    title: str = ""
    """Title of its pages; the name where it is empty."""
    seed: Annotated[int, Field(ge=0, lt=2**31)] = 1
    """Seed from which the seeds of all matches follow, and the lots."""
    way: Way = Way.IN_PROCESS
    """How matches are played: brains in Python and stdio programs in one process, or each robot in a process."""
    size: Annotated[int, Field(ge=1, le=MAX_ROBOTS)] = DEFAULT_SIZE
    """Number of robots of each team."""
    hang: Annotated[float, Field(ge=1, le=3600)] = 20.0
    """Wall time in s for one decision of a brain, after which its team forfeits; `patience.attendance` to build it."""
    format: FormatConfig = FormatConfig()
    """The format."""
    table: TableConfig = TableConfig()
    """Points and tie-breaks."""
    until_significant: SignificanceConfig | None = None
    """Rounds are added until the order of the ratings is significant; None for the plain format."""
    match: dict[str, Any] = Field(default_factory=dict)
    """Keys of a match file that all matches have: duration, rules, profile, noise and so on."""
    teams: Annotated[list[TeamEntry], Field(min_length=2, max_length=MOST_TEAMS)]
    """The teams, the strongest first: groups, byes and brackets follow from the order."""

    @model_validator(mode="after")
    def _check(self) -> "CupConfig":
        names = [team.name for team in self.teams]
        for name in names:
            if names.count(name) > 1:
                raise ValueError(f'two teams are named "{name}"; every team of a cup has its own name')
        own = next((key for key in self.match if key in _OWN_KEYS), None)
        if own is not None:
            raise ValueError(f"match.{own} is decided by the cup; leave it out")
        if self.match.get("game", GameName.SOCCER) != GameName.SOCCER:
            raise ValueError(f'match.game is "{self.match["game"]}", and a cup counts goals; leave it out')
        for team in self.teams:
            if self.way is Way.IN_PROCESS and team.command is not None:
                raise ValueError(f'team "{team.name}" is a program on the network; write way = "{Way.PROCESSES}"')
        if problem := _format_problem(self.format, len(names)):
            raise ValueError(problem)
        if self.until_significant is not None and self.format.kind is not FormatKind.ROUND_ROBIN:
            raise ValueError(f"until_significant is for round-robin, and format.kind is {self.format.kind}; change one")
        return self

    @property
    def names(self) -> list[str]:
        """Names of the teams, the strongest first."""
        return [team.name for team in self.teams]

    @property
    def ranking(self) -> Ranking:
        """How teams are ranked."""
        order = self.table.order
        if order is None:
            rules = self.match.get("rules", "friendly")
            order = rules if rules in ORDERS else DEFAULT_ORDER
        return Ranking(
            order=ORDERS[order] if isinstance(order, str) else tuple(order),
            points=Points(self.table.win, self.table.draw, self.table.loss),
            challenge={team.name: team.challenge for team in self.teams},
            seed=self.seed,
        )

    def match_config(self, files: Mapping[str, Any] | None = None, **keys: Any) -> MatchConfig:
        """A match of the cup, with these further keys; `files` is in place of what `[match]` names.

        Raises:
            TouchlineError: a key of `[match]` is invalid.
        """
        if files is None:
            return load_match(None, {**self.match, **keys})
        own = {key: value for key, value in self.match.items() if key not in files}
        return MatchConfig.model_validate(load_match(None, {**own, **keys}).model_dump() | dict(files))

    def read_files(self) -> dict[str, Any]:
        """Scene, profile and rule book of the matches, as JSON: a cup goes on with these, and without the files.

        Raises:
            TouchlineError: a key of `[match]` is invalid.
        """
        return dict(json.loads(self.match_config().model_dump_json(include=set(_FILES))))


def load_cup(path: Path) -> CupConfig:
    """The cup of a file.

    Raises:
        TouchlineError: one line that names file, key, value and remedy.
    """
    content = read_tables(path, "a cup file")
    if isinstance(content.get("match"), dict):
        content["match"] = with_files(content["match"], path.parent)
    cup = validate_tables(CupConfig, content, str(path), REMEDIES)
    try:
        cup.match_config()
    except TouchlineError as error:
        raise TouchlineError(f"{path}: {str(error).replace('match: ', 'match.', 1)}") from None
    return cup


def _format_problem(chosen: FormatConfig, teams: int) -> str | None:
    """One line if the format does not fit to itself or the number of teams."""
    if chosen.has_knock_out and chosen.knock_out_matches % 2 == 0:
        key = "knock_out_best_of" if chosen.knock_out_best_of is not None else "best_of"
        return f"format.{key} is {chosen.knock_out_matches}; a knock-out needs an odd number of matches"
    if chosen.kind is FormatKind.GROUPS:
        smallest = teams // chosen.groups
        if smallest < 2:
            return f"format.groups is {chosen.groups}; with {teams} teams at most {teams // 2}, so that each has two"
        if chosen.advance > smallest:
            return f"format.advance is {chosen.advance}; the smallest group has {smallest} teams"
        if chosen.advance * chosen.groups < 2:
            return "format.advance is 1 of one group; a knock-out needs two teams"
    if chosen.kind is FormatKind.SWISS and (chosen.rounds or 1) > most_rounds(teams):
        most = most_rounds(teams)
        return f"format.rounds is {chosen.rounds}; with {teams} teams at most {most}; round-robin plays all pairs"
    return None
