"""The plan of a series: its matches, each with all that determines it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import TeamConfig, TeamConfigs
from schemas.config.task import GameName
from schemas.errors import TouchlineError
from schemas.side import Side
from touchline.matches.engine.planned_match import PlannedMatch


@dataclass(frozen=True, slots=True)
class SeedMatch:
    """A match of a seed: of a series, or of a cell of a study."""

    planned: PlannedMatch
    swapped: bool = False
    """Whether the teams have changed sides: the first plays in magenta."""
    cell: int = 0
    """Number of its cell, from 0."""

    @property
    def identity(self) -> str:
        """A digest of all that determines the match but the programs: equal for equal configurations."""
        return self.planned.identity

    @property
    def seed(self) -> int:
        """Seed of all random numbers of the match."""
        return self.planned.config.seed

    @property
    def sides(self) -> tuple[Side, Side]:
        """The sides that the first and the second team play on."""
        return (Side.MAGENTA, Side.CYAN) if self.swapped else (Side.CYAN, Side.MAGENTA)


@dataclass(frozen=True, slots=True)
class SeriesPlan:
    """A series between two teams."""

    teams: tuple[str, str]
    """Names of the first team, in cyan unless sides are swapped, and of the second."""
    matches: tuple[SeedMatch, ...]


def plan_series(
    config: MatchConfig,
    seeds: Iterable[int],
    *,
    both_sides: bool = False,
    brain_folder: Path | None = None,
    record: Path | None = None,
) -> SeriesPlan:
    """One match for each seed; with `both_sides` two, the second with the teams on each other's side.

    `record` is the folder for recordings, if there shall be any.

    Raises:
        TouchlineError: a team is none that a match in one process can play, or the game has no goals.
    """
    if config.game is not GameName.SOCCER:
        raise TouchlineError(
            f'game is "{config.game}", and a series counts goals; measure it with touchline experiment'
        )
    for side in Side:
        if config.team(side).brain is None and config.team(side).stdio is None:
            kind = "remote" if config.team(side).remote else "a program on the network"
            raise TouchlineError(
                f"teams.{side} is {kind}; a series plays brains in Python and stdio programs: "
                f"give --{side} module:Class"
            )
    variants = {False: config, True: with_sides_swapped(config)} if both_sides else {False: config}
    matches = (
        SeedMatch(_planned(one.model_copy(update={"seed": seed}), swapped, brain_folder, record), swapped)
        for seed in seeds
        for swapped, one in variants.items()
    )
    return SeriesPlan(team_names(config), tuple(matches))


def _planned(config: MatchConfig, swapped: bool, brain_folder: Path | None, record: Path | None) -> PlannedMatch:
    name = f"seed_{config.seed}{'_swapped' if swapped else ''}.mcap"
    return PlannedMatch(
        config,
        brain_folder=brain_folder,
        recording=record / name if record is not None else None,
        label=f"seed {config.seed}{', sides swapped' if swapped else ''}",
    )


def with_brains(config: MatchConfig, brains: Mapping[Side, str]) -> MatchConfig:
    """The match with these brains in place of the programs of the file; size, names and types of the robots stay."""
    teams = {
        side.value: config.team(side).model_copy(
            update={"name": brain.partition(":")[2], "brain": brain, "command": None, "stdio": None, "remote": False}
        )
        for side, brain in brains.items()
    }
    return config.model_copy(update={"teams": config.teams.model_copy(update=teams)})


def team_names(config: MatchConfig) -> tuple[str, str]:
    """The names of cyan's and magenta's team; teams of the same name are told apart by a number."""
    first, second = (config.team(side).name or side.value for side in Side)
    return (first, second) if first != second else (f"{first} (1)", f"{second} (2)")


def with_sides_swapped(config: MatchConfig) -> MatchConfig:
    """The match with each team on the other side; seed, scene and kick-off stay."""
    teams = TeamConfigs(
        cyan=_renamed(config.teams.magenta, Side.MAGENTA, Side.CYAN),
        magenta=_renamed(config.teams.cyan, Side.CYAN, Side.MAGENTA),
    )
    return config.model_copy(update={"teams": teams})


def _renamed(team: TeamConfig, before: Side, now: Side) -> TeamConfig:
    """A team on its other side: robots that are named after the side are named after the new one."""
    if team.robots or not team.types:
        return team
    types = {robot.replace(before.value, now.value, 1): kind for robot, kind in team.types.items()}
    return team.model_copy(update={"types": types})
