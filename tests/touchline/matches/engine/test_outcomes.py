"""How planned matches end, and whose fault it is if they do not."""

import faulthandler
import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.side import Side
from schemas.wire.part import encode
from support.free_match import free_match
from support.process_story import descendants, is_running, wait_for
from support.stepped_clock import SteppedClock
from touchline.matches.engine import hang_watch
from touchline.matches.engine.code_digest import code_digest
from touchline.matches.engine.fresh_process import DiedProcessError, FreshProcesses
from touchline.matches.engine.hang_watch import HangWatch, Note
from touchline.matches.engine.in_process import outcome_of_death
from touchline.matches.engine.inputs_only import with_inputs_only
from touchline.matches.engine.measurement import measured
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome, Played, from_json
from touchline.matches.engine.plan import ListPlan
from touchline.matches.engine.planned_match import PlannedMatch, Way
from touchline.matches.engine.play import play
from touchline.matches.engine.play_list import play_list
from touchline.matches.engine.run import run_plan
from touchline.timing import HANG_RENEW_S
from touchline.verify.resimulate import verify

MatchOf = Callable[..., MatchConfig]


def in_fresh_process(planned: PlannedMatch) -> Outcome:
    """Play a match in a process of its own."""
    with FreshProcesses(1) as executor:
        outcome: Outcome = executor.submit(play, planned).result()
        return outcome


def interrupts_of(_: Path) -> tuple[bool, bool]:
    """Whether Ctrl-C is kept from the fork server, and from what this process starts."""
    masks = [Path(f"/proc/{one}/status").read_text() for one in (os.getppid(), os.getpid())]
    blocked = [int(mask.partition("SigBlk:")[2].split()[0], 16) for mask in masks]
    server, own = (bool(one >> (signal.SIGINT - 1) & 1) for one in blocked)
    return server, own


def test_ctrl_c_reaches_the_command_and_not_the_fork_server_that_still_imports() -> None:
    with FreshProcesses(1) as executor:
        assert executor.submit(interrupts_of).result() == (True, False)


def test_a_match_has_the_same_outcome_each_time_and_as_json(match_of: MatchOf, folder: Path) -> None:
    planned = PlannedMatch(match_of(), brain_folder=folder)
    first, again = play(planned), play(planned)
    assert isinstance(first, Played)
    assert encode(first) == encode(again)
    assert from_json(encode(first)) == first


def test_the_identity_depends_on_configuration_and_code_alone(match_of: MatchOf, folder: Path, tmp_path: Path) -> None:
    planned = PlannedMatch(match_of(), brain_folder=folder)
    elsewhere = replace(planned, label="final", recording=tmp_path / "a.mcap", way=Way.PROCESSES)
    assert elsewhere.identity == planned.identity
    assert replace(planned, config=match_of(**{"teams.magenta.process": "team"})).identity == planned.identity
    assert replace(planned, config=match_of(seed=2)).identity != planned.identity
    assert replace(planned, config=match_of(**{"radio.loss": 0.5})).identity != planned.identity
    assert replace(planned, code={Side.CYAN: "0" * 32}).identity != planned.identity


@pytest.mark.parametrize(
    ("brain", "kind", "words"),
    [
        ("Raises", FailureKind.CRASHED, "magenta1, tick 10: ValueError: no idea"),
        ("NotBuilt", FailureKind.DID_NOT_START, "raised RuntimeError: no plan"),
    ],
)
def test_a_match_that_a_team_cannot_play_has_failed_by_its_fault(
    match_of: MatchOf, folder: Path, tmp_path: Path, brain: str, kind: FailureKind, words: str
) -> None:
    outcome = play(PlannedMatch(match_of(magenta=brain), brain_folder=folder, logs=tmp_path / "logs"))
    assert isinstance(outcome, Failed)
    assert (outcome.kind, outcome.culprits) == (kind, (Side.MAGENTA,))
    assert words in outcome.reason
    assert "planned_brains.py" in Path(outcome.evidence or "").read_text()


def test_a_breakpoint_is_skipped_as_in_every_process_without_a_terminal(match_of: MatchOf, folder: Path) -> None:
    assert isinstance(in_fresh_process(PlannedMatch(match_of("Breaks"), brain_folder=folder)), Played)


def test_a_brain_that_does_not_answer_is_named_with_its_stack(match_of: MatchOf, folder: Path, tmp_path: Path) -> None:
    """Also one that catches every exception, that holds the interpreter's lock, or that is never built."""
    hung, silent = FailureKind.HUNG, "cyan1: no answer within 0.5 s"
    ends = {
        "CatchesAll": (hung, silent),
        "HoldsTheLock": (hung, silent),
        "HangsAtFirst": (FailureKind.DID_NOT_START, "cyan1 is not built: no answer within 1 s"),
    }
    wait = {"patience.attendance": 1.0}
    planned = [
        PlannedMatch(match_of(brain, **wait), brain_folder=folder, logs=tmp_path / brain, hang_s=0.5, label=brain)
        for brain in ends
    ]
    with FreshProcesses(2) as executor:
        outcomes = run_plan(ListPlan(tuple(planned)), executor, None, lambda one, _: one.label)
    for one in planned:
        outcome = outcomes[one.identity]
        assert isinstance(outcome, Failed)
        assert (outcome.kind, outcome.reason, outcome.culprits) == (*ends[one.label], (Side.CYAN,))
        assert "planned_brains.py" in Path(outcome.evidence or "").read_text()
    with pytest.raises(TouchlineError, match="cyan1 is not built: no answer within 1 s"):  # before the first match
        play_list(planned[-1:], 1, "", lambda *_: "", json=True)


RESTS = """
import os, sys, time
from pathlib import Path
from touchline.matches.engine.fresh_process import FreshProcesses

def rest(file, note):
    file.with_suffix(".draft").write_text(str(os.getpid()))
    file.with_suffix(".draft").rename(file)
    time.sleep(600.0)

if __name__ == "__main__":
    from rests import rest
    FreshProcesses(1).submit(rest, Path(sys.argv[1]))
"""


def test_a_process_of_a_match_ends_when_those_who_wait_for_it_are_killed(tmp_path: Path) -> None:
    file = tmp_path / "pid"
    (tmp_path / "rests.py").write_text(RESTS)
    waiting = subprocess.Popen([sys.executable, str(tmp_path / "rests.py"), str(file)], start_new_session=True)
    try:
        wait_for(file.exists)
        waiting.kill()
        wait_for(lambda: not is_running(int(file.read_text())))
    finally:
        waiting.kill()
        waiting.wait()


def test_the_time_of_a_brain_begins_anew_at_most_once_in_a_while(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each time costs a thread in C."""
    clock, begun = SteppedClock(), []
    clock.sleep_until(100.0)
    monkeypatch.setattr(faulthandler, "dump_traceback_later", lambda seconds, **_: begun.append((clock.now(), seconds)))
    monkeypatch.setattr(hang_watch, "WallClock", lambda: clock)
    with closing(HangWatch(tmp_path, 5.0)) as watch:
        for step in range(5):
            clock.sleep_until(100.0 + step * HANG_RENEW_S / 2)
            watch.note("cyan1")
    assert begun == [(100.0 + step * HANG_RENEW_S, 5.0 + HANG_RENEW_S) for step in range(3)]


def test_a_process_that_is_slow_while_no_brain_has_control_is_nobodys_fault(match_of: MatchOf) -> None:
    error = DiedProcessError("its process ended with status 1", 1, Note(acting="", stack="in step"))
    outcome = outcome_of_death(PlannedMatch(match_of()), error)
    assert (outcome.kind, outcome.culprits) == (FailureKind.WORKER, ())


@pytest.mark.parametrize(
    ("status", "kind"),
    [
        (1, FailureKind.CRASHED),
        (254, FailureKind.CRASHED),
        (255, FailureKind.WORKER),
        (0, FailureKind.CRASHED),
        (-signal.SIGSEGV, FailureKind.CRASHED),
        (-signal.SIGXCPU, FailureKind.CRASHED),
        (-signal.SIGKILL, FailureKind.WORKER),
        (-signal.SIGTERM, FailureKind.WORKER),
    ],
)
def test_a_process_that_ended_itself_is_the_fault_of_who_acted_and_one_that_was_ended_is_not(
    match_of: MatchOf, status: int, kind: FailureKind
) -> None:
    error = DiedProcessError("its process has ended", status, Note(acting="magenta1"))
    outcome = outcome_of_death(PlannedMatch(match_of()), error)
    at_fault = kind is FailureKind.CRASHED
    assert outcome.kind is kind
    assert outcome.culprits == ((Side.MAGENTA,) if at_fault else ())
    assert outcome.reason == ("magenta1: " if at_fault else "") + "its process has ended"


def test_what_an_earlier_attempt_has_left_is_removed(match_of: MatchOf, folder: Path, tmp_path: Path) -> None:
    logs, recording = tmp_path / "logs", tmp_path / "match.mcap"
    logs.mkdir()
    (logs / "endpoint.json").write_text("tcp/127.0.0.1:1")
    recording.write_text("half of a recording")
    outcome = play(PlannedMatch(match_of("Raises"), brain_folder=folder, logs=logs, recording=recording))
    assert isinstance(outcome, Failed)
    assert [one.name for one in logs.iterdir()] == ["traceback.txt"]
    played = play(PlannedMatch(match_of(), brain_folder=folder, logs=logs, recording=recording))
    assert isinstance(played, Played)
    assert not logs.exists()


def test_a_recording_of_inputs_alone_is_smaller_and_can_be_simulated_again(
    match_of: MatchOf, folder: Path, tmp_path: Path
) -> None:
    whole = PlannedMatch(match_of(), brain_folder=folder, recording=tmp_path / "whole.mcap")
    inputs = replace(whole, config=with_inputs_only(whole.config), recording=tmp_path / "inputs.mcap")
    assert whole.recording is not None
    assert inputs.recording is not None
    played, again = play(whole), play(inputs)
    assert isinstance(played, Played)
    assert isinstance(again, Played)
    assert played.chain == again.chain
    assert inputs.recording.stat().st_size < whole.recording.stat().st_size
    assert verify(inputs.recording).identical


def test_what_is_measured_while_a_match_is_played_is_what_its_recording_shows(
    match_of: MatchOf, folder: Path, tmp_path: Path
) -> None:
    planned = PlannedMatch(match_of(), brain_folder=folder, recording=tmp_path / "match.mcap")
    assert measured(tmp_path / "match.mcap", play(planned).identity) == replace(
        play(planned), recording=str(tmp_path / "match.mcap")
    )


def test_changed_files_of_a_team_are_not_played(match_of: MatchOf, folder: Path, tmp_path: Path) -> None:
    config = match_of()
    (tmp_path / "planned_brains.py").write_text((folder / "planned_brains.py").read_text())
    digest = code_digest(config, Side.CYAN, tmp_path)
    assert digest == code_digest(config, Side.CYAN, folder)
    (tmp_path / "planned_brains.py").write_text("# changed\n" + (folder / "planned_brains.py").read_text())
    outcome = play(PlannedMatch(config, {Side.CYAN: digest}, brain_folder=tmp_path))
    assert isinstance(outcome, Failed)
    assert "the files of Forward are not those of the plan" in outcome.reason
    assert (outcome.kind, outcome.culprits) == (FailureKind.WORKER, ())


def test_other_weights_give_the_team_of_a_policy_another_digest(match_of: MatchOf, tmp_path: Path) -> None:
    config = match_of(**{"teams.cyan.brain": "policy:kick.npz"})
    digests = []
    for weights in (b"of yesterday", b"of today"):
        (tmp_path / "kick.npz").write_bytes(weights)
        digests.append(code_digest(config, Side.CYAN, tmp_path))
    assert digests[0] != digests[1]


def test_what_tools_leave_in_the_folder_of_a_team_is_no_part_of_its_digest(match_of: MatchOf, tmp_path: Path) -> None:
    config = match_of(**{"teams.cyan.brain": "own.team:Own"})
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "team.py").write_text("class Own: ...")
    digest = code_digest(config, Side.CYAN, tmp_path)
    for name in ("__pycache__", ".pytest_cache", "runs"):
        (tmp_path / "own" / name).mkdir()
        (tmp_path / "own" / name / "left").write_text("left")
    assert code_digest(config, Side.CYAN, tmp_path) == digest
    (tmp_path / "own" / "numbers.toml").write_text("speed = 2.0")
    assert code_digest(config, Side.CYAN, tmp_path) != digest


@pytest.mark.processes
def test_processes_and_one_process_play_the_same_match(match_of: MatchOf, folder: Path, tmp_path: Path) -> None:
    planned = PlannedMatch(match_of(), brain_folder=folder)
    over_zenoh = replace(planned, way=Way.PROCESSES, recording=tmp_path / "match.mcap", logs=tmp_path / "logs")
    here, there = play(planned), in_fresh_process(over_zenoh)
    assert isinstance(here, Played)
    assert isinstance(there, Played), there
    assert there.chain == here.chain
    assert there.goals == here.goals
    assert verify(tmp_path / "match.mcap").identical
    left = [path for path in (tmp_path / "logs").rglob("*") if path.is_file()]
    assert left and {path.suffix for path in left} == {".log"}, "no credentials, in a folder that is published"


@pytest.mark.processes
def test_a_match_that_is_cancelled_leaves_no_process(match_of: MatchOf, folder: Path, tmp_path: Path) -> None:
    long = match_of(duration=600.0)
    planned = PlannedMatch(long, way=Way.PROCESSES, brain_folder=folder, logs=tmp_path / "logs")
    executor = FreshProcesses(1)
    future = executor.submit(play, planned)
    wait_for((tmp_path / "logs" / "cyan1.log").exists, "a robot")
    programs = [pid for pid in descendants(os.getpid()) if "logs/host.json" in command_line(pid)]
    assert len(programs) == 1
    executor.shutdown(cancel_futures=True)
    assert isinstance(future.exception(), DiedProcessError)
    wait_for(lambda: not any(map(is_running, programs)), "the end of the host")


def end_slowly(done: Path, _: Path) -> None:
    """Return at once, in a process that goes on for a while and is deaf to SIGTERM."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    threading.Thread(target=time.sleep, args=[60.0]).start()
    done.touch()


def test_a_run_that_ends_just_as_a_match_has_ended_is_tidy(tmp_path: Path) -> None:
    threads = threading.active_count()
    executor = FreshProcesses(1)
    future = executor.submit(end_slowly, done := tmp_path / "done")
    wait_for(done.exists, "the end of the function")
    time.sleep(0.3)  # for its result to be read
    executor.shutdown(cancel_futures=True)
    with pytest.raises(DiedProcessError, match="it was ended with the run"):
        future.result()
    wait_for(lambda: threading.active_count() <= threads, "the end of all threads, none by an exception")


def command_line(pid: int) -> str:
    """The words of a process; empty if it has ended."""
    try:
        return Path(f"/proc/{pid}/cmdline").read_text()
    except OSError:
        return ""


def test_a_match_whose_score_fails_has_failed_by_nobody_s_fault(folder: Path, tmp_path: Path) -> None:
    config = free_match(
        tmp_path, "def count(now):\n    return now.nothing\n", **{"teams.cyan.brain": "planned_brains:Forward"}
    )
    outcome = play(PlannedMatch(config, brain_folder=folder, logs=tmp_path / "logs"))
    assert isinstance(outcome, Failed) and not outcome.culprits
    line = """task.score is "tally:count"; it raised AttributeError: .*'nothing' \\(tally.py, line 2\\) at tick 1"""
    assert re.fullmatch(line, outcome.reason)
