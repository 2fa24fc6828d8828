"""Plays a list of matches that nobody resumes, with progress, until they have ended or are interrupted."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from schemas.errors import TouchlineError
from touchline.matches.engine.fresh_process import DiedProcessError
from touchline.matches.engine.in_process import outcome_of_death, why_not_built
from touchline.matches.engine.outcome import Outcome
from touchline.matches.engine.plan import ListPlan
from touchline.matches.engine.planned_match import PlannedMatch, Way
from touchline.matches.engine.run import run_plan
from touchline.matches.engine.session import session_of


@dataclass(frozen=True, slots=True)
class PlayedList:
    """What came of the matches."""

    outcomes: dict[str, Outcome]
    """Identity → outcome of all that have ended."""
    is_interrupted: bool
    """Whether Ctrl-C or SIGTERM came before the last one had ended."""


def play_list(
    matches: Sequence[PlannedMatch],
    jobs: int,
    title: str,
    sentence_of: Callable[[PlannedMatch, Outcome], str],
    *,
    json: bool,
) -> PlayedList:
    """Play matches on this machine, `jobs` at a time; 0 for one per core. `sentence_of` is shown for each.

    Each pair of teams that plays in one process is built once before, in a process that ends where one hangs, so that
    an error in a team is reported before the first match.

    Raises:
        TouchlineError: two matches are the same, a team cannot be built, or `jobs` is negative.
    """
    plan = ListPlan(tuple(matches))
    in_process = [one for one in reversed(matches) if one.way is Way.IN_PROCESS]
    outcomes: dict[str, Outcome] = {}

    def told(planned: PlannedMatch, outcome: Outcome) -> str:
        outcomes[planned.identity] = outcome
        return sentence_of(planned, outcome)

    with session_of(title, jobs, json=json) as session, session.interruptible():
        for one in {one.config.teams.model_dump_json(): one for one in in_process}.values():
            try:
                reason = session.executor.submit(why_not_built, one).result()
            except DiedProcessError as error:
                reason = outcome_of_death(one, error).reason
            if reason:
                raise TouchlineError(reason)
        run_plan(plan, session.executor, None, told, session.progress)
    return PlayedList(outcomes, session.is_interrupted)
