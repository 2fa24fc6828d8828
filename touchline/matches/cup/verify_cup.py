"""Verifies a cup: its matches by their recordings, the files of its teams, and the table that follows from them."""

import json
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import closing, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from schemas.errors import TouchlineError
from schemas.side import Side
from touchline.launch.confinement.team_code import team_code
from touchline.matches.cup.cup_plan import CupPlan, config_with, digests_of, stored_plan
from touchline.matches.cup.cup_state import CupState
from touchline.matches.cup.report import RESULT, report_of
from touchline.matches.cup.site import standings
from touchline.matches.engine.outcome import Failed, Played
from touchline.matches.engine.progress import ProgressDisplay
from touchline.matches.engine.store import RunStore
from touchline.matches.engine.verify import Depth, sampled, verify_run

_COMPARED = ("complete", "winner", "tables", "matches")
"""Parts of the result; ratings are left out, because their last digits depend on the library that fits them."""


@dataclass(frozen=True, slots=True)
class CupVerdict:
    """What was found."""

    faults: list[str]
    """One line for each thing that does not fit; empty if all fits."""
    notes: list[str]
    """What could not be checked."""
    simulated: int
    """Number of matches that were simulated again."""
    ticks: int
    """Number of ticks of these."""


def verify_cup(
    folder: Path,
    executor: Executor,
    sample: int | None = None,
    code_folder: Path | None = None,
    progress: ProgressDisplay | None = None,
) -> CupVerdict:
    """Check a cup: its files and its table, and `sample` of its matches, drawn at random, by their recordings.

    Args:
        folder: the cup's.
        executor: where matches are checked.
        sample: number of matches whose recordings are read and simulated again; None for all.
        code_folder: where teams are looked for; by default where they were when the cup was played.
        progress: shows each match that was checked.

    Raises:
        TouchlineError: the folder has no cup.
    """
    folder = folder.absolute()
    with closing(RunStore(folder, read_only=True)) as store:
        plan, outcomes = stored_plan(store), store.outcomes()
    if plan is None:
        raise TouchlineError(f"{folder}: its cup has not begun; nothing can be verified")
    plan = replace(plan, code_folder=code_folder or plan.code_folder)
    state = plan.state(outcomes)
    matches = [plan.match(one.slot) for one in state.matches]
    known = {one.identity for one in matches}
    faults = [
        f"{identity}: a stored outcome is of no match of the cup" for identity in outcomes if identity not in known
    ]
    played, failed = (
        [one for one in matches if isinstance(outcomes.get(one.identity), kind)] for kind in (Played, Failed)
    )
    again = sampled(played, sample)
    unread = [(one.label, one.recording) for one in played if one not in again]
    faults += [f"{name}: its recording is gone" for name, path in unread if path is not None and not path.exists()]
    code_faults, notes = _code_checks(plan)
    faults += code_faults
    ticks = 0
    for check in verify_run([*failed, *again], outcomes, folder, executor, Depth(code=False), progress):
        faults += [f"{check.label}: {fault}" for fault in check.faults]
        ticks += check.ticks
    faults += _table_faults(state, folder)
    return CupVerdict(faults, notes, len(again), ticks)


def _code_checks(plan: CupPlan) -> tuple[list[str], list[str]]:
    """Faults and notes on the files of the teams."""
    faults, notes = [], []
    now = digests_of(plan.cup, plan.code_folder)
    for team in plan.cup.teams:
        if now[team.name] == plan.digests.get(team.name):
            continue
        if team_code(config_with(team, plan.cup), Side.CYAN, plan.code_folder).own:
            faults.append(f'the files of team "{team.name}" have changed since the cup began')
        else:
            notes.append(f'the files of team "{team.name}" are not here, or of another version; they were not checked')
    return faults, notes


def _table_faults(state: CupState, folder: Path) -> Iterator[str]:
    """What differs between the published result and the one that follows from the matches."""
    try:
        published = dict(json.loads((folder / RESULT).read_text("utf-8")))
        page = (folder / "index.html").read_text("utf-8")
    except (OSError, ValueError, TypeError) as error:
        yield f"{RESULT}: {error}; play the cup with --resume, which writes it again"
        return
    found: dict[str, Any] = json.loads(json.dumps(report_of(state)))
    for part in _COMPARED:
        if published.get(part) != found[part]:
            yield f"{RESULT}: {_difference(part, published.get(part), found[part])}"
    for stage, rows in state.schedule.tables.items():
        if standings(rows) not in page:
            yield f"index.html: its table of {stage} is not the one that follows from the matches"


def _difference(part: str, published: Any, found: Any) -> str:
    """The first difference in a part of the result."""
    if part == "matches" and isinstance(published, list) and len(published) == len(found):
        for one, other in zip(published, found, strict=True):
            if one != other:
                return f"match {other['match']} is not the stored one"
    with suppress(AttributeError, TypeError):  # of what is no table
        for stage, rows in found.items() if part == "tables" else ():
            for row, other in zip(published.get(stage, []), rows, strict=False):
                if row != other:
                    return f"place {other['place']} of {stage} is {row.get('team')}, and {other['team']} by the matches"
    return f"{part} is not the one that follows from the matches"
