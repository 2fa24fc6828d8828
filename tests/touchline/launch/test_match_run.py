"""Matches whose host, recorder and robots are small programs of this file, over a real bus on loopback."""

import io
import signal
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from runtime.bus.contract import ReceivedMessage, Stamp
from runtime.process.clock import WallClock
from schemas.config.match_config import load_match
from schemas.errors import MatchFailedError, TouchlineError
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.soccer.game import EventKind, Phase, Score
from schemas.topics import EVENT, STATE
from touchline.launch import match_run, recording_outcome
from touchline.launch.match_run import InterruptedMatchError, MatchRun
from touchline.launch.processes.process_table import Process, ProcessKind
from touchline.launch.processes.programs import MatchPlan
from touchline.launch.result import MatchResult
from touchline.launch.terminal.screen import Screen

pytestmark = pytest.mark.processes

HOST = """
import os, pathlib, signal, sys
from runtime.bus.announcement import Announcement, announced
from runtime.bus.zenoh.bus import open_host
from runtime.process.clock import WallClock
from schemas.soccer.game import EventKind, Phase, Score
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.topics import EVENT, RECORDER_PROGRESS, STATE

def play(announcement, seen, phase):
    clock = WallClock()
    with (
        open_host("friendly", clock, "tcp/127.0.0.1:0") as bus,
        announced(Announcement(endpoint=bus.endpoint, match="friendly", pid=1, folder="."), pathlib.Path(announcement)),
    ):
        states, events, progress = bus.publisher(STATE), bus.publisher(EVENT), bus.subscribe(RECORDER_PROGRESS)
        while not pathlib.Path(seen).exists():
            states.put(GameState(tick=1, time=0.02, phase=Phase.PLAY, clock=0.02))
            clock.sleep_until(clock.now() + 0.02)
        events.put(GameEvent(tick=20, time=0.4, clock=0.4, kind=EventKind.GOAL, rule="goal", text="goal by cyan3"))
        states.put(GameState(tick=21, time=0.42, phase=phase, clock=0.4, score=Score(cyan=1)))
        yield progress
"""
FULL_TIME = HOST + "\nfor _ in play(*sys.argv[1:], Phase.FULL_TIME): pass\n"
CUT_SHORT = HOST + "\nfor _ in play(*sys.argv[1:], Phase.PLAY): pass\n"
DIES = HOST + "\nfor _ in play(*sys.argv[1:], Phase.PLAY): sys.exit('the roof came down')\n"
KILLED = HOST + "\nfor _ in play(*sys.argv[1:], Phase.PLAY): os.kill(os.getpid(), signal.SIGKILL)\n"
INTERRUPTED = (
    HOST + "\nfor _ in play(*sys.argv[1:], Phase.PLAY):\n    os.kill(os.getppid(), signal.SIGINT)\n    signal.pause()\n"
)
WAITS_FOR_ITS_RECORDER = f"""{HOST}
for progress in play(*sys.argv[1:], Phase.FULL_TIME):
    while not (received := progress.receive(1.0)) or not received.message().leaving:
        pass
    print(received.chunks["name"], "leaves", file=sys.stderr)
"""
WRONG = "import sys; sys.stderr.write('pybullet says hello\\ntouchline: profile is odd; mend it\\n'); sys.exit(2)"
ENDS_LATE = f"""{HOST}
for _ in play(*sys.argv[1:], Phase.FULL_TIME):
    while not pathlib.Path(sys.argv[2]).with_name("left").exists():
        signal.sigtimedwait((), 0.02)
"""
RESTS = "import signal; signal.pause()"
LEAVES_AT_FULL_TIME = """
import pathlib, signal
while not pathlib.Path("over").exists():
    signal.sigtimedwait((), 0.02)
"""
CRASHES = "import sys; sys.exit('brain raised')"
RECORDS = "import pathlib, sys; pathlib.Path(sys.argv[1]).write_bytes(b'recorded')"


class WatchedScreen(Screen):
    """Leaves files for the programs, so that what they do next comes in time.

    `seen`: play is seen, and `awaited` was printed; `over`: full time is seen; `left`: after that, a robot's end.
    """

    def __init__(self, words: io.StringIO, clock: WallClock, seen: Path, awaited: str) -> None:
        super().__init__(words, clock)
        self._words = words
        self._seen = seen
        self._awaited = awaited

    def status(self, line: str) -> None:
        super().status(line)
        if "  play" in line and self._awaited in self._words.getvalue():
            self._seen.touch()
        if "  full time" in line:
            self._seen.with_name("over").touch()
            if "cyan1 ended with status 0" in self._words.getvalue():
                self._seen.with_name("left").touch()


class Stage:
    """One match on a screen that can be read afterwards."""

    def __init__(
        self,
        folder: Path,
        monkeypatch: pytest.MonkeyPatch,
        host: str,
        agent: str = RESTS,
        recorder: str = RECORDS,
        **overrides: object,
    ) -> None:
        recording = folder / "match.mcap"
        self.plan = MatchPlan(load_match(None, overrides), None, folder, recording)
        self.words = io.StringIO()
        python = (sys.executable, "-c")
        hosts = (*python, host, str(self.plan.announcement), str(folder / "seen"))
        clients = [
            Process("cyan1", ProcessKind.AGENT, (*python, agent), {}, restarts=3),
            Process("recorder", ProcessKind.RECORDER, (*python, recorder, str(recording)), {}),
        ]
        monkeypatch.setattr(match_run, "host_process", lambda plan: Process("host", ProcessKind.HOST, hosts, {}))
        monkeypatch.setattr(match_run, "client_processes", lambda plan: clients)
        monkeypatch.setattr(recording_outcome, "losses_of", lambda *_: {"world": 2})

    def play(self, awaited: str = "") -> MatchResult:
        clock = WallClock()
        screen = WatchedScreen(self.words, clock, self.plan.folder / "seen", awaited)
        return MatchRun(self.plan, screen, clock).play()


Staged = Callable[..., Stage]


@pytest.fixture
def stage(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Staged:
    return partial(Stage, tmp_path, monkeypatch)


def test_a_match_that_reaches_full_time_has_score_events_and_recording(stage: Staged) -> None:
    match = stage(FULL_TIME)
    result = match.play()
    assert (result.state.score.cyan, result.state.score.magenta) == (1, 0)
    assert (result.ticks, result.duration_s) == (21, 0.42)
    assert [event.text for event in result.events] == ["goal by cyan3"]
    assert result.recording.path == match.plan.recording
    assert result.recording.losses == {"world": 2}
    assert "misses 2 messages" in result.recording.fault
    assert " 0:00.4  goal: goal by cyan3" in match.words.getvalue()


def test_a_host_learns_that_its_recorder_will_not_come_back(stage: Staged, tmp_path: Path) -> None:
    match = stage(WAITS_FOR_ITS_RECORDER, recorder="import sys; sys.exit('disk full')")
    assert "disk full" in match.play().recording.fault
    assert "recorder ended with status 1; not started again" in match.words.getvalue()
    assert (tmp_path / "host.log").read_text().splitlines()[-1] == "recorder leaves"


def test_a_match_ends_when_a_side_has_no_robot_left_with_the_reason(stage: Staged) -> None:
    match = stage(CUT_SHORT, agent=CRASHES, **{"teams.cyan.size": 1, "teams.cyan.name": "Lions"})
    reason = r"^match ended .*: no robot of Lions \(cyan\) is left; cyan1: brain raised; logs are in "
    with pytest.raises(MatchFailedError, match=reason):
        match.play(awaited="what is never shown")
    assert "cyan1 ended with status 1; not started again" in match.words.getvalue()


def test_robots_that_leave_after_full_time_before_their_host_ends_end_no_match(
    stage: Staged, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A host that waits for links with unsent data takes as long to end as its robots' patience lasts."""
    monkeypatch.chdir(tmp_path)
    match = stage(ENDS_LATE, agent=LEAVES_AT_FULL_TIME, **{"teams.cyan.size": 1})
    assert match.play().state.score.cyan == 1
    assert (tmp_path / "left").exists()


def test_the_error_of_a_host_with_wrong_input_is_shown_unchanged(stage: Staged) -> None:
    with pytest.raises(TouchlineError, match=r"^profile is odd; mend it$"):
        stage(WRONG).play()


def test_a_recorder_that_waits_for_a_host_that_could_not_start_is_ended(stage: Staged) -> None:
    match = stage(WRONG, recorder=RESTS)
    began = WallClock().now()
    with pytest.raises(TouchlineError):
        match.play()
    assert WallClock().now() - began < 20.0  # not the half minute that a recorder has after a match


@pytest.mark.parametrize(("host", "how"), [(DIES, "ended with status 1"), (KILLED, "was ended by SIGKILL")])
def test_a_host_that_dies_ends_the_match_with_its_last_words(stage: Staged, host: str, how: str) -> None:
    match = stage(host)
    with pytest.raises(MatchFailedError, match=rf"match abandoned: the host {how}; its log is .*host\.log"):
        match.play()
    assert ("  host: the roof came down" in match.words.getvalue()) is (host is DIES)


def test_a_host_that_was_ended_before_full_time_leaves_no_result(stage: Staged) -> None:
    with pytest.raises(MatchFailedError, match="the host was ended before full time"):
        stage(CUT_SHORT).play()


def test_the_end_of_a_match_that_was_missed_in_a_stall_is_taken_from_what_the_host_left(
    stage: Staged, monkeypatch: pytest.MonkeyPatch
) -> None:
    goal = GameEvent(tick=20, time=0.4, clock=0.4, kind=EventKind.GOAL, rule="goal", text="goal by cyan3")
    end = GameEvent(tick=60, time=1.2, clock=1.2, kind=EventKind.FULL_TIME, rule="clock", text="full time")
    over = GameState(tick=60, time=1.2, phase=Phase.FULL_TIME, clock=1.2, score=Score(cyan=1))
    published = [
        ReceivedMessage(topic, topic.key, message.encode(), Stamp(number, number, 0))
        for number, (topic, message) in enumerate([(EVENT, goal), (EVENT, end), (STATE, over)])
    ]
    match = stage(CUT_SHORT)
    monkeypatch.setattr(match_run, "read_outcome", lambda path: published)
    result = match.play()
    assert (result.state.score.cyan, result.ticks, result.duration_s) == (1, 60, 1.2)
    assert [event.text for event in result.events] == ["goal by cyan3", "full time"]
    assert match.words.getvalue().count("goal by cyan3") == 1
    assert "full time" in match.words.getvalue()


def test_ctrl_c_ends_all_processes_and_is_passed_on(stage: Staged) -> None:
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(InterruptedMatchError) as stopped:
        stage(INTERRUPTED).play()
    assert stopped.value.number == signal.SIGINT
    assert signal.getsignal(signal.SIGINT) is before
