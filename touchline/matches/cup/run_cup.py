"""Plays a cup: what is due is played, each outcome is stored at once, and the pages follow."""

import json
from concurrent.futures import Executor
from pathlib import Path

from schemas.errors import TouchlineError
from touchline.matches.cup.cup_config import CupConfig
from touchline.matches.cup.cup_plan import CupPlan, check_submitted, digests_of, match_config, store_plan, stored_plan
from touchline.matches.cup.cup_state import CupState, state_of
from touchline.matches.cup.report import RESULT, match_line, report_of
from touchline.matches.cup.site import Site
from touchline.matches.engine.outcome import Outcome
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.progress import ProgressDisplay
from touchline.matches.engine.run import run_plan
from touchline.matches.engine.store import RunStore


class CupRun:
    """A cup that is played in a folder; to be closed."""

    def __init__(self, cup: CupConfig, code_folder: Path, folder: Path, *, resume: bool) -> None:
        """Begin a cup, or go on with the one of the folder.

        Raises:
            TouchlineError: a team or a key is invalid; the folder has a cup already, or another one.
        """
        digests = digests_of(cup, code_folder)
        check_submitted(cup, digests)
        self.plan = CupPlan(cup, code_folder.absolute(), folder.absolute(), digests, cup.read_files())
        for slot in state_of(cup, lambda _: None).due[:1]:
            match_config(cup, slot)
        self._store = RunStore(folder.absolute())
        try:
            self._begin(folder, resume=resume)
        except BaseException:
            self._store.close()
            raise
        self._site = Site(folder, digests)
        self._outcomes = self._store.outcomes()

    def close(self) -> None:
        """Free the folder."""
        self._store.close()

    @property
    def state(self) -> CupState:
        """How far the cup is."""
        return self.plan.state(self._outcomes)

    def play(self, executor: Executor, progress: ProgressDisplay | None = None, *, is_remote: bool = False) -> CupState:
        """Play all matches that have no outcome yet; pages are written after each.

        `is_remote`: the workers do not see the folder of the cup.
        """
        self._site.write(self.state, running=True)

        def told(planned: PlannedMatch, outcome: Outcome) -> str:
            self._outcomes[planned.identity] = outcome
            state = self.state
            self._site.write(state, running=True)
            (match,) = (one for one in state.matches if one.slot.name == planned.label)
            reason = match.ended.reason if match.ended is not None else None
            return match_line(match) + (f"   {reason}" if reason is not None else "")

        try:
            run_plan(self.plan, executor, self._store, told, progress, is_remote=is_remote)
        finally:
            state = self.state
            self._site.write(state, running=False)
            text = json.dumps(report_of(state), ensure_ascii=False, indent=1)
            (self.plan.folder / RESULT).write_text(text, "utf-8")
        return state

    def _begin(self, folder: Path, *, resume: bool) -> None:
        """Check the cup of the folder, or store this one.

        Raises:
            TouchlineError: the cup cannot be begun or resumed.
        """
        plan, store = self.plan, self._store
        stored = stored_plan(store)
        if stored is None:
            store_plan(store, plan)
            return
        if not resume:
            raise TouchlineError(f"{folder}: has a cup already; add --resume to go on, or give another --out")
        if stored.cup != plan.cup:
            raise TouchlineError(f"{folder}: its cup is another one than that of the file; give another --out")
        if stored.files not in (None, plan.files):
            raise TouchlineError(
                f"{folder}: its scene, profile or rule book has changed since; restore it, or give another --out"
            )
        for team, digest in stored.digests.items():
            if plan.digests[team] != digest:
                raise TouchlineError(
                    f'the files of team "{team}" have changed since the cup began; restore them, or give another --out'
                )
        store.forget_lost()
