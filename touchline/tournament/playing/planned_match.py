"""A match of a cup with all that determines it, and an identity that depends on nothing else."""

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path

from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import TeamConfig, TeamConfigs
from schemas.side import Side
from touchline.launch.team_code import team_code
from touchline.series.team_names import brain_of
from touchline.tournament.cup_config import PROCESSES, CupConfig, TeamEntry
from touchline.tournament.cup_state import Slot


@dataclass(frozen=True, slots=True)
class PlannedMatch:
    """A match that can be played now."""

    slot: Slot
    config: MatchConfig
    way: str
    identity: str
    """Digest of the config, the way to play and the files of both teams."""
    code_folder: Path
    """Where brains and programs are looked for first: the folder of the cup file."""
    recording: Path
    evidence: Path
    """The folder of what explains a failure."""


def plan_match(cup: CupConfig, slot: Slot, code_folder: Path, folder: Path, digests: dict[str, str]) -> PlannedMatch:
    """The match of a slot; `folder` is that of the cup.

    Raises:
        TouchlineError: a team is none that ships, or a key of the match is invalid.
    """
    config = match_config(cup, slot)
    content = {"config": config.model_dump(mode="json"), "way": cup.way, "code": [digests[one] for one in slot.sides]}
    identity = hashlib.blake2b(json.dumps(content, sort_keys=True).encode(), digest_size=16).hexdigest()
    return PlannedMatch(
        slot=slot,
        config=config,
        way=cup.way,
        identity=identity,
        code_folder=code_folder,
        recording=folder / "recordings" / f"{slot.file_name}.mcap",
        evidence=folder / "evidence" / slot.file_name,
    )


def match_config(cup: CupConfig, slot: Slot) -> MatchConfig:
    """The config of a match; its name is that of the cup, so that its place in the cup is no part of it.

    Raises:
        TouchlineError: a team is none that ships, or a key of the match is invalid.
    """
    entries = {team.name: team for team in cup.teams}
    config = cup.match_config(name=cup.name, seed=slot.seed(cup))
    teams = [_team(entries[name], cup) for name in slot.sides]
    changes: dict[str, object] = {"teams": TeamConfigs(cyan=teams[0], magenta=teams[1])}
    if cup.way == PROCESSES:
        changes["record"] = config.record.model_copy(update={"wait": True})
    if slot.fixture.decisive:
        changes["referee"] = config.referee.model_copy(update={"winner": True})
    return MatchConfig.model_validate(config.model_copy(update=changes).model_dump())


def digest_of(cup: CupConfig, team: TeamEntry, code_folder: Path) -> str:
    """The digest of a team's files; of a team that ships, and of an installed one, that of its name.

    Raises:
        TouchlineError: the team is none that ships.
    """
    config = MatchConfig(teams=TeamConfigs(cyan=_team(team, cup)))
    digest = hashlib.blake2b(digest_size=16)
    own = team_code(config, Side.CYAN, code_folder).own
    for path in own:
        for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
            if file.is_file() and "__pycache__" not in file.parts:
                digest.update(f"{file.relative_to(path.parent)}\0".encode() + file.read_bytes() + b"\0")
    if not own:
        digest.update(json.dumps([team.brain or "", *(team.command or team.stdio or [])]).encode())
    return digest.hexdigest()


def _team(entry: TeamEntry, cup: CupConfig) -> TeamConfig:
    brain = brain_of(entry.brain) if entry.brain is not None else None
    return TeamConfig(
        name=entry.name,
        brain=brain,
        command=entry.command,
        stdio=entry.stdio,
        size=entry.size or cup.size,
    )
