"""Plans that are played to their end, whatever happens meanwhile."""

import multiprocessing
import os
import random
import signal
import sqlite3
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from schemas.config.match_config import MatchConfig
from schemas.errors import MatchFailedError, TouchlineError
from schemas.side import Side
from schemas.wire.part import encode
from touchline.matches.engine.code_digest import code_digest
from touchline.matches.engine.fresh_process import DiedProcessError, FreshProcesses
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome, Played
from touchline.matches.engine.plan import ListPlan
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.run import run_plan
from touchline.matches.engine.session import session_of
from touchline.matches.engine.store import RunStore
from touchline.matches.engine.verify import Depth, check_match, sampled, verify_run

MatchOf = Callable[..., MatchConfig]
Matches = Callable[..., tuple[PlannedMatch, ...]]


@dataclass
class Log:
    """Notes which matches have ended."""

    ended_labels: list[str] = field(default_factory=list)

    def __call__(self, planned: PlannedMatch, outcome: Outcome) -> str:
        del outcome
        self.ended_labels.append(planned.label)
        return planned.label


@pytest.fixture(scope="module")
def matches(match_of: MatchOf, folder: Path) -> Matches:
    """As many matches of seeds from 1."""

    def planned(number: int, recordings: Path | None = None) -> tuple[PlannedMatch, ...]:
        files = {seed: recordings / f"{seed}.mcap" if recordings else None for seed in range(1, number + 1)}
        return tuple(
            PlannedMatch(match_of(seed=seed), brain_folder=folder, recording=file, label=f"seed {seed}")
            for seed, file in files.items()
        )

    return planned


def swapped(sides: Mapping[Side, Any]) -> dict[Side, Any]:
    return {side: sides[side.opponent] for side in Side}


def bytes_of(outcomes: Mapping[str, Outcome]) -> dict[str, bytes]:
    return {identity: encode(outcome) for identity, outcome in sorted(outcomes.items())}


def test_all_executors_give_the_same_bytes(matches: Matches, tmp_path: Path) -> None:
    plan = ListPlan(matches(2))
    results = []
    executors: list[tuple[Executor, bool]] = [
        (ThreadPoolExecutor(1), False),
        (FreshProcesses(1), False),
        (FreshProcesses(4), False),
        (ThreadPoolExecutor(2), True),
    ]
    for number, (executor, is_remote) in enumerate(executors):
        with executor, closing(RunStore(tmp_path / str(number))) as store:
            results.append(bytes_of(run_plan(plan, executor, store, Log(), is_remote=is_remote)))
    assert all(result == results[0] for result in results)
    assert len(results[0]) == 2


def test_recordings_of_other_machines_come_back(matches: Matches, tmp_path: Path) -> None:
    plan = ListPlan(matches(1, tmp_path / "recordings"))
    with ThreadPoolExecutor(1) as executor, closing(RunStore(tmp_path)) as store:
        (outcome,) = run_plan(plan, executor, store, Log(), is_remote=True).values()
    assert isinstance(outcome, Played)
    assert outcome.recording == "recordings/1.mcap"
    assert (tmp_path / "recordings" / "1.mcap").stat().st_size > 1000


@dataclass(frozen=True)
class Final:
    """The second match is that of the seed which the goals of the first decide."""

    first: PlannedMatch
    second: PlannedMatch

    def due(self, outcomes: Mapping[str, Outcome]) -> Sequence[PlannedMatch]:
        order = [self.first] if self.first.identity not in outcomes else [self.second]
        return [one for one in order if one.identity not in outcomes]


def test_a_plan_may_depend_on_outcomes(matches: Matches, tmp_path: Path) -> None:
    first, second = matches(2)
    log = Log()
    with ThreadPoolExecutor(1) as executor:
        run_plan(Final(first, second), executor, None, log)
    assert log.ended_labels == ["seed 1", "seed 2"]


class Interrupted(Executor):
    """Ends the first of 1,500 matches when all have begun, and signals this process a while later."""

    def __init__(self, after: float) -> None:
        self.futures: list[Future[Outcome]] = []
        self._after = after
        self._signal: threading.Thread | None = None

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        self.futures.append(Future())
        if len(self.futures) == 1500:
            self.futures[0].set_result(Failed("0", FailureKind.CRASHED, "no ball"))
            self._signal = threading.Thread(target=self._interrupt)
            self._signal.start()
        return self.futures[-1]

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        if self._signal is not None:
            self._signal.join()

    def _interrupt(self) -> None:
        time.sleep(self._after)
        os.kill(os.getpid(), signal.SIGTERM)


def test_an_interrupt_at_any_moment_leaves_no_match_that_cannot_be_ended(matches: Matches) -> None:
    (one,) = matches(1)
    plan = ListPlan(tuple(replace(one, code={Side.CYAN: f"{number}"}) for number in range(1500)))
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        for moment in range(0, 20, 3):
            with Interrupted(0.0002 * moment) as executor, pytest.raises(KeyboardInterrupt):
                run_plan(plan, executor, None, Log())
            ended = threading.Thread(target=lambda: [one.cancel() for one in executor.futures], daemon=True)
            ended.start()
            ended.join(10.0)
            assert not ended.is_alive()
    finally:
        signal.signal(signal.SIGTERM, before)


def test_a_finished_match_is_not_played_again(matches: Matches, tmp_path: Path) -> None:
    few, all_of_them = (ListPlan(matches(number)) for number in (2, 4))
    log = Log()
    with ThreadPoolExecutor(1) as executor:
        with closing(RunStore(tmp_path)) as store:
            run_plan(few, executor, store, Log())
        with closing(RunStore(tmp_path)) as store:
            outcomes = run_plan(all_of_them, executor, store, log)
    assert log.ended_labels == ["seed 3", "seed 4"]
    assert len(outcomes) == 4


@pytest.mark.parametrize(
    ("brain", "kind", "culprits", "reason"),
    [
        ("Dies", FailureKind.CRASHED, (Side.MAGENTA,), "magenta1: its process ended with status 0"),
        ("IsTerminated", FailureKind.WORKER, (), "its process was ended by SIGTERM"),
    ],
)
def test_a_match_whose_process_ends_costs_itself_alone(
    matches: Matches,
    match_of: MatchOf,
    folder: Path,
    tmp_path: Path,
    brain: str,
    kind: FailureKind,
    culprits: tuple[Side, ...],
    reason: str,
) -> None:
    lost = PlannedMatch(match_of(magenta=brain), brain_folder=folder, label="lost")
    with FreshProcesses(2) as executor:
        outcomes = run_plan(ListPlan((lost, *matches(2))), executor, None, Log())
    assert [isinstance(one, Played) for one in outcomes.values()].count(True) == 2
    failed = outcomes[lost.identity]
    assert isinstance(failed, Failed)
    assert (failed.kind, failed.culprits, failed.reason) == (kind, culprits, reason)


def test_a_match_whose_worker_was_lost_is_played_when_the_run_goes_on(matches: Matches, tmp_path: Path) -> None:
    one, other = matches(2)
    with closing(RunStore(tmp_path)) as store:
        store.add(Failed(one.identity, FailureKind.WORKER, "no disk"))
        store.add(Failed(other.identity, FailureKind.CRASHED, "no idea", (Side.CYAN,)))
        log = Log()
        with ThreadPoolExecutor(1) as executor:
            outcomes = run_plan(ListPlan((one, other)), executor, store, log)
        assert store.outcomes() == outcomes
    assert log.ended_labels == ["seed 1"]
    assert isinstance(outcomes[one.identity], Played)


def test_teams_whose_files_have_the_same_name_do_not_meet(
    matches: Matches, match_of: MatchOf, folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", [one for one in sys.path if Path(one) != folder])  # a match was played here before
    text = (folder / "planned_brains.py").read_text()
    (tmp_path / "planned_brains.py").write_text(text.replace("vx=1.0", "vx=-1.0"))
    forward, backward = (
        PlannedMatch(match_of(), {Side.CYAN: code_digest(match_of(), Side.CYAN, home)}, brain_folder=home)
        for home in (folder, tmp_path)
    )
    with FreshProcesses(1) as executor:
        outcomes = run_plan(ListPlan((forward, backward, *matches(1))), executor, None, Log())
    chains = [one.chain for one in outcomes.values() if isinstance(one, Played)]
    assert len(chains) == 3, outcomes[backward.identity]
    assert chains[0] != chains[1]
    assert chains[0] == chains[2]


def _loaded_modules(note: Path) -> set[str]:
    assert note.is_dir()
    return set(sys.modules)


def test_a_process_of_a_match_begins_with_the_modules_of_a_match(match_of: MatchOf) -> None:
    with FreshProcesses(1) as executor:
        loaded = executor.submit(_loaded_modules).result()
    assert {"pybullet", "robot_agent.teams.simple.team", "recordings.soccer.stats.match_statistics"} <= loaded


class KilledWorkerError(Exception):
    """Of a library that knows its own exceptions only, as Dask does."""


class LostWorkers(ThreadPoolExecutor):
    """Workers that are lost with each match."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        def lose() -> None:
            raise KilledWorkerError("lost three times")

        return super().submit(lose)


def test_an_exception_of_the_executor_fails_the_match_and_not_the_run(matches: Matches, tmp_path: Path) -> None:
    plan = ListPlan(matches(2))
    with LostWorkers(1) as executor:
        outcomes = run_plan(plan, executor, None, Log())
    assert len(outcomes) == 2
    for outcome in outcomes.values():
        assert isinstance(outcome, Failed) and outcome.kind is FailureKind.WORKER and not outcome.culprits
        assert outcome.reason == "its worker failed: KilledWorkerError: lost three times"


def test_a_match_whose_worker_is_lost_is_begun_three_times(matches: Matches) -> None:
    plan = ListPlan(matches(2))
    begun = []

    class Counted(LostWorkers):
        def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
            begun.append(args[0].label)
            return super().submit(fn, *args, **kwargs)

    log = Log()
    with Counted(1) as executor:
        run_plan(plan, executor, None, log)
    assert sorted(begun) == ["seed 1"] * 3 + ["seed 2"] * 3
    assert sorted(log.ended_labels) == ["seed 1", "seed 2"]


@dataclass
class Shown:
    """Notes what is shown of a run."""

    counts: list[tuple[int, int, int]] = field(default_factory=list)
    lines: list[tuple[str, bool]] = field(default_factory=list)

    def planned(self, done: int, due: int, failed: int = 0) -> None:
        self.counts.append((done, due, failed))

    def ended(self, sentence: str, *, failed: bool = False) -> None:
        self.lines.append((sentence, failed))


class Given(ThreadPoolExecutor):
    """Matches have ended as the test says: label → outcome."""

    outcomes: Mapping[str, Outcome]

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        return super().submit(lambda: self.outcomes[args[0].label])


def test_a_run_shows_how_many_matches_are_done_due_and_failed_with_those_of_before(
    matches: Matches, tmp_path: Path
) -> None:
    before, failed, played = matches(3)
    shown, executor = Shown(), Given(1)
    executor.outcomes = {
        "seed 2": Failed(failed.identity, FailureKind.CRASHED, "no idea"),
        "seed 3": Played(played.identity, None, 0.5, "0" * 32, missed={"cyan1": 3}),
    }
    with executor, closing(RunStore(tmp_path)) as store:
        store.add(Failed(before.identity, FailureKind.HUNG, "no answer"))
        run_plan(ListPlan((before, failed, played)), executor, store, Log(), shown)
    assert shown.counts[0] == (1, 2, 1)
    assert shown.counts[-1] == (3, 0, 2)
    (third, is_third_failed), second = sorted(shown.lines, key=lambda line: line[1])
    assert second == ("seed 2", True)
    assert third.startswith("seed 3; ") and "cyan1 3" in third and not is_third_failed


def test_who_reads_a_run_that_has_ended_writes_nothing_into_its_folder(tmp_path: Path) -> None:
    with closing(RunStore(tmp_path)) as store:
        store.set_document("cup", "its plan")
    with closing(RunStore(tmp_path, read_only=True)) as store:
        assert store.document("cup") == "its plan"
        assert {one.name for one in tmp_path.iterdir()} == {"run.sqlite", "run.lock"}


def test_a_folder_that_holds_no_run_is_neither_read_nor_written_over(tmp_path: Path) -> None:
    with pytest.raises(TouchlineError, match=r"has no run\.sqlite; give the folder of a run"):
        RunStore(tmp_path / "none", read_only=True)
    assert not (tmp_path / "none").exists()
    (tmp_path / "file").write_text("")
    with pytest.raises(TouchlineError, match=r"file: cannot be used for a run .*; give another folder"):
        RunStore(tmp_path / "file")
    (tmp_path / "run.sqlite").write_text("notes of a user, and no database at all")
    with pytest.raises(TouchlineError, match="cannot be used for a run"):
        RunStore(tmp_path)
    assert (tmp_path / "run.sqlite").read_text().startswith("notes of a user")


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), sqlite3.OperationalError("disk is full")])
def test_a_full_disk_ends_a_run_with_one_line(error: Exception) -> None:
    lost = pytest.raises(MatchFailedError, match="no stored result is lost")
    with session_of("cup", 1) as session, lost, session.interruptible():
        raise error


def test_equal_matches_in_a_plan_are_refused(matches: Matches) -> None:
    (one,) = matches(1)
    with pytest.raises(TouchlineError, match='has "seed 1" and "seed 1", which are the same match'):
        ListPlan((one, one))


def test_two_processes_do_not_play_the_same_run(tmp_path: Path) -> None:
    with closing(RunStore(tmp_path)), pytest.raises(TouchlineError, match="another process plays this run"):
        RunStore(tmp_path)
    RunStore(tmp_path).close()


def _play_in_child(plan: ListPlan, folder: Path) -> None:
    os.setpgrp()
    with ThreadPoolExecutor(1) as executor, closing(RunStore(folder)) as store:
        run_plan(plan, executor, store, Log())


def test_a_run_that_is_killed_at_any_instant_ends_as_an_undisturbed_one(matches: Matches, tmp_path: Path) -> None:
    """Killed 8 times, each time a random while after it has begun, and resumed."""
    plan = ListPlan(matches(4))
    with ThreadPoolExecutor(1) as executor, closing(RunStore(tmp_path / "undisturbed")) as store:
        wanted = bytes_of(run_plan(plan, executor, store, Log()))
    draw = random.Random(7)
    context = multiprocessing.get_context("fork")
    for _ in range(8):
        child = context.Process(target=_play_in_child, args=(plan, tmp_path / "killed"))
        child.start()
        child.join(draw.uniform(0.02, 0.5))
        if child.pid is not None and child.is_alive():
            os.kill(child.pid, signal.SIGKILL)
        child.join()
    with ThreadPoolExecutor(1) as executor, closing(RunStore(tmp_path / "killed")) as store:
        assert bytes_of(run_plan(plan, executor, store, Log())) == wanted


def test_a_run_is_verified_and_the_match_that_does_not_fit_is_named(matches: Matches, tmp_path: Path) -> None:
    planned = matches(3, tmp_path / "recordings")
    with ThreadPoolExecutor(1) as executor, closing(RunStore(tmp_path)) as store:
        outcomes = run_plan(ListPlan(planned), executor, store, Log())
        assert not [check for check in verify_run(planned, outcomes, tmp_path, executor) if check.faults]
        (tmp_path / "recordings" / "2.mcap").write_bytes((tmp_path / "recordings" / "3.mcap").read_bytes())
        (found,) = (check for check in verify_run(planned, outcomes, tmp_path, executor) if check.faults)
    assert found.label == "seed 2"
    assert "its configuration is not that of the plan" in found.faults[0]


def test_a_match_without_a_recording_is_verified_by_playing_it_again(matches: Matches, tmp_path: Path) -> None:
    planned = matches(1)
    with ThreadPoolExecutor(1) as executor, closing(RunStore(tmp_path)) as store:
        outcomes = run_plan(ListPlan(planned), executor, store, Log())
        assert not [check for check in verify_run(planned, outcomes, tmp_path, executor) if check.faults]
        (identity, played) = next(iter(outcomes.items()))
        assert isinstance(played, Played)
        forged = {identity: replace(played, chain="0" * 32)}
        (check,) = verify_run(planned, forged, tmp_path, executor)
    assert check.faults == (f"played again, it was another match: its hash chain ends with {played.chain}",)


def test_figures_in_the_table_that_are_not_those_of_the_recording_are_found(matches: Matches, tmp_path: Path) -> None:
    planned = matches(1, tmp_path / "recordings")
    with ThreadPoolExecutor(1) as executor:
        outcomes = run_plan(ListPlan(planned), executor, None, Log())
        ((identity, played),) = outcomes.items()
        assert isinstance(played, Played)
        forged = {identity: replace(played, figures=replace(played.figures, sides=swapped(played.figures.sides)))}
        (check,) = verify_run(planned, forged, tmp_path, executor)
        (untouched,) = verify_run(planned, outcomes, tmp_path, executor)
    assert check.faults == ("its figures are not those of its recording, such as cards and penalties",)
    assert untouched.faults == ()


def test_a_match_that_was_not_played_and_evidence_that_is_gone_are_faults(matches: Matches, tmp_path: Path) -> None:
    missing, failed = matches(2)
    outcome = Failed(failed.identity, FailureKind.CRASHED, "no idea", (Side.CYAN,), "logs/2")
    assert check_match(missing, None, tmp_path).faults == ("it was not played",)
    assert check_match(failed, outcome, tmp_path).faults == ("its evidence logs/2 is gone",)
    (tmp_path / "logs" / "2").mkdir(parents=True)
    assert check_match(failed, outcome, tmp_path).faults == ()
    assert check_match(failed, replace(outcome, evidence=None), tmp_path).faults == ()


def test_digests_of_teams_are_compared_unless_code_is_left_out(matches: Matches, folder: Path, tmp_path: Path) -> None:
    (one,) = matches(1)
    planned = replace(one, code={Side.MAGENTA: "0" * 32, Side.CYAN: code_digest(one.config, Side.CYAN, folder)})
    outcome = Failed(planned.identity, FailureKind.CRASHED, "no idea")
    assert check_match(planned, outcome, tmp_path).faults == ("the files of Still have changed since then",)
    assert check_match(planned, outcome, tmp_path, Depth(code=False)).faults == ()


def test_a_match_that_fails_when_it_is_played_again_is_a_fault(match_of: MatchOf, folder: Path, tmp_path: Path) -> None:
    planned = PlannedMatch(match_of("Raises"), brain_folder=folder)
    check = check_match(planned, Played(planned.identity, None, 0.5, "0" * 32), tmp_path)
    (fault,) = check.faults
    assert fault.startswith("played again, it failed: cyan1, tick 10: ValueError: no idea")
    assert (check.ticks, check.again) == (0, None)


def test_a_sample_is_so_many_of_the_matches_in_their_order_and_nobody_knows_which(matches: Matches) -> None:
    all_of_them = list(matches(20))
    drawn = sampled(all_of_them, 5)
    assert len(drawn) == 5
    assert drawn == [one for one in all_of_them if one in drawn]
    assert {one.config.seed for _ in range(200) for one in sampled(all_of_them, 5)} == set(range(1, 21))
    assert sampled(all_of_them, 30) == sampled(all_of_them, None) == all_of_them


def test_a_check_whose_process_is_lost_is_a_fault_but_for_a_match_that_had_failed(
    matches: Matches, tmp_path: Path
) -> None:
    def submit(*_: object) -> "Future[None]":
        lost: Future[None] = Future()
        lost.set_exception(DiedProcessError("its process was killed"))
        return lost

    stored, failed = matches(2)
    outcomes: Any = {stored.identity: None}
    executor: Any = SimpleNamespace(submit=submit)
    checks = verify_run([stored, failed], outcomes, tmp_path, executor, Depth(failures=True))
    assert {check.label: check.faults for check in checks} == {
        stored.label: ("it could not be checked: its process was killed",),
        failed.label: (),
    }
