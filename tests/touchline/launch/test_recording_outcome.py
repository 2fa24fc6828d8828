import signal
from pathlib import Path

import pytest

from runtime.bus.contract import ReceivedMessage, Stamp
from runtime.bus.outcome_file import write_outcome
from schemas.config.match_config import load_match
from schemas.messages.soccer.game import GameState
from schemas.soccer.game import Phase, Score
from schemas.topics import STATE
from support.brisk import BRISK
from support.recorded_match import record_match
from touchline.launch.processes.programs import MatchPlan
from touchline.launch.recording_outcome import finished_recording, outcome_of, unfinished_recording

PATH, LOG = Path("runs/a/match.mcap"), Path("runs/a/recorder.log")


def test_a_finished_recording_without_losses_is_whole() -> None:
    assert not finished_recording(PATH, {}).fault


def test_messages_that_did_not_reach_the_host_are_no_fault_of_the_recording() -> None:
    outcome = finished_recording(PATH, {"robot/cyan1/command": 3, "team/cyan/order": 1})
    assert not outcome.fault
    assert outcome.losses == {"robot/cyan1/command": 3, "team/cyan/order": 1}


def test_a_recording_that_misses_messages_of_the_host_names_them() -> None:
    outcome = finished_recording(PATH, {"world": 8, "host/applied": 8, "robot/cyan1/command": 8})
    assert outcome.fault == (
        "the recording misses 24 messages (world 8, host/applied 8, robot/cyan1/command 8): "
        "the host no longer kept them when the recorder asked; runs/a/match.mcap has all others"
    )


def test_an_unfinished_recording_is_named_with_the_recorders_log() -> None:
    outcome = unfinished_recording(PATH, [PATH], "the recorder was ended by SIGKILL", LOG)
    assert outcome.path == PATH
    assert outcome.fault == (
        "the recording is not complete: the recorder was ended by SIGKILL; "
        "runs/a/match.mcap has what was written; the recorder's log is runs/a/recorder.log"
    )


def test_a_recording_of_which_nothing_is_left_is_lost() -> None:
    outcome = unfinished_recording(PATH, [], "no host answers there", LOG)
    assert outcome.path is None
    assert outcome.fault == (
        "the recording runs/a/match.mcap is lost: no host answers there; the recorder's log is runs/a/recorder.log"
    )


@pytest.mark.parametrize(
    ("status", "log", "fault"),
    [
        (1, ["touchline: disk full"], "runs/a/match.mcap is lost: disk full;"),
        (1, [], "runs/a/match.mcap is lost: the recorder ended with status 1;"),  # its log was on the full disk
        (-signal.SIGKILL, ["a line"], "runs/a/match.mcap is lost: the recorder was ended by SIGKILL;"),
        (0, ["a line"], "runs/a/match.mcap is lost: it is missing;"),
    ],
)
def test_what_a_recorder_ended_with_is_the_reason(status: int, log: list[str], fault: str) -> None:
    plan = MatchPlan(load_match(None), None, PATH.parent, PATH)
    assert fault in outcome_of(plan, status, log).fault


def test_a_recording_that_ends_before_the_match_is_not_called_whole(tmp_path: Path) -> None:
    """Another recorder's file of this path had 272 of 1,201 ticks, and the match said that nothing is lost."""
    config = load_match(None, {"duration": 2.0, "teams.cyan.size": 1, "teams.magenta.size": 1, "rules": BRISK})
    path = tmp_path / "match.mcap"
    plan = MatchPlan(config, None, tmp_path, path)
    record_match(path, config, until=1.0)
    for tick, fault in ((50, ""), (200, "it ends with tick 50, the match with tick 200 or a later one")):
        over = GameState(tick=tick, time=tick / 50, phase=Phase.FULL_TIME, clock=1.0, score=Score())
        write_outcome(plan.outcome, [ReceivedMessage(STATE, STATE.key, over.encode(), Stamp(1, 1, 1))])
        assert fault in outcome_of(plan, 0, []).fault
        assert bool(fault) == bool(outcome_of(plan, 0, []).fault)
