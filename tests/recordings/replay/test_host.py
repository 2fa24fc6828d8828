"""The host of a replay, on the in-process bus: its messages, its replies, and a recording of it."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from recordings.container.key_selection import KeySelection
from recordings.reading.recording import open_recording
from recordings.recorder.part_sink import PartSink
from recordings.recorder.recorder import Recorder
from recordings.replay.host import ReplayHost
from recordings.replay.replay import Replay, ReplaySettings
from runtime.bus.contract import NoReplyError, PresenceKind
from schemas.errors import TouchlineError
from schemas.messages.replay import ReplayOperation, ReplayRequest
from schemas.messages.setup import SetupRequest
from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import ActionName
from schemas.topics import ACTION, EVENT, REPLAY_CONTROL, SETUP, WORLD
from support.in_process_bus import InProcessBus, SharedState
from support.stepped_clock import SteppedClock


class Room:
    """A replay and those who listen to it, in one process, on one clock."""

    def __init__(self, match: str = "friendly") -> None:
        self.medium, self.clock, self.match = SharedState(), SteppedClock(), match

    def seat(self) -> InProcessBus:
        return self.medium.open_bus(self.match, SteppedClock())

    def host(self, path: Path, **wanted) -> ReplayHost:
        opened = Replay(ReplaySettings(path, **wanted))
        self.host_bus = self.medium.open_bus(self.match, self.clock)
        return ReplayHost(
            self.host_bus, opened.recording.manifest.setup, lambda **more: opened.player(self.clock, **more)
        )

    def run(self, host: ReplayHost, seconds: float, step: float = 0.01) -> None:
        end = self.clock.now() + seconds
        while self.clock.now() < end:
            host.pump()
            self.clock.sleep_until(self.clock.now() + step)


@pytest.fixture
def room() -> Iterator[Room]:
    yield Room()


def test_a_recording_of_a_replay_has_equal_payloads_in_equal_order(recorded, room, tmp_path):
    """Record, replay, record: keys, payloads and simulated times are the same, and nothing is lost."""
    path = tmp_path / "again.mcap"
    bus = room.seat()
    recorder = Recorder(bus, PartSink(path, bus.clock))
    host = room.host(recorded.path, rate=None)
    recorder.pump()
    host.pump()
    host.run(lambda _: recorder.pump())
    room.host_bus.close()
    recorder.run(lambda: False)
    again = open_recording(path, whole=True)
    assert again.manifest.setup == recorded.manifest.setup
    assert again.result.lost == again.result.missed_before_start == 0
    facts = [(one.key, one.payload, one.log_ns) for one in recorded.messages()]
    assert [(one.key, one.payload, one.log_ns) for one in again.messages()] == facts


def test_as_fast_as_possible_does_not_run_away_from_a_recorder(recorded, room, monkeypatch):
    monkeypatch.setattr("recordings.replay.listeners.RUN_AHEAD_TICKS", 20)
    bus = room.seat()
    sink = PartSink(recorded.path.with_name("late.mcap"), bus.clock)
    recorder = Recorder(bus, sink)
    host = room.host(recorded.path, rate=None, paused=True)
    worlds = room.seat().subscribe(WORLD)
    for _ in range(3):
        recorder.pump()
        host.pump()
    host.player.control(ReplayRequest(operation=ReplayOperation.PLAY))
    for _ in range(5):
        host.pump()
    heard = 0
    while worlds.receive() is not None:
        heard += 1
    assert 20 <= heard <= 23
    for _ in range(200):
        recorder.pump()
        host.pump()
    while worlds.receive() is not None:
        heard += 1
    assert heard == 200
    sink.abandon()


def test_a_recorder_that_is_silent_is_left_behind(recorded, room, monkeypatch):
    monkeypatch.setattr("recordings.replay.listeners.RUN_AHEAD_TICKS", 20)
    seat = room.seat()
    seat.declare_alive("recorder", "stuck")
    host = room.host(recorded.path, rate=None)
    host.run()
    assert host.player.status().messages == len(list(recorded.messages()))


def test_it_is_present_as_a_host_and_as_a_replay(recorded, room):
    watch = room.seat().watch_alive()
    room.host(recorded.path, paused=True)
    present = {(presence.kind, presence.name) for presence in iter(watch.receive, None)}
    assert {(PresenceKind.HOST, "host"), (PresenceKind.REPLAY, "replay")} <= present


def test_it_tells_how_the_match_was_set_up_under_the_name_it_is_replayed_by(recorded):
    room = Room("replay_friendly")
    host = room.host(recorded.path, paused=True)
    answer = room.seat().query(SETUP, SetupRequest())
    host.pump()
    setup = answer.result(0.0)
    assert setup.match == "replay_friendly"
    assert setup == recorded.manifest.setup.replace(match="replay_friendly")


def test_it_runs_beside_a_live_match_that_hears_none_of_it(recorded):
    room = Room("replay_friendly")
    live = room.medium.open_bus("friendly", SteppedClock()).subscribe(WORLD)
    replayed = room.seat().subscribe(WORLD)
    room.host(recorded.path, rate=None).run()
    assert live.receive() is None
    assert replayed.receive() is not None


def test_a_seek_is_done_and_answered(recorded, room):
    host, asker = room.host(recorded.path), room.seat()
    room.run(host, 0.5)
    answer = asker.query(REPLAY_CONTROL, ReplayRequest(operation=ReplayOperation.SEEK, to="goal:1-0.5"))
    host.pump()
    assert answer.result(0.0).time == pytest.approx(1.48)
    answer = asker.query(REPLAY_CONTROL, ReplayRequest(operation=ReplayOperation.SEEK, to="goal:2"))
    host.pump()
    reply = answer.result(0.0)
    assert not reply.accepted and "goal happened 1 times" in reply.reason


def test_an_invalid_request_is_refused_with_the_reason(recorded, room):
    host = room.host(recorded.path)
    answer = room.seat().query(REPLAY_CONTROL, SetupRequest(version="9.0"))
    host.pump()
    with pytest.raises(NoReplyError, match="9"):
        answer.result(0.0)


def test_who_wants_to_change_it_is_refused(recorded, room):
    host = room.host(recorded.path)
    answer = room.seat().query(ACTION, RefereeAction(action=ActionName.STOP))
    host.pump()
    reply = answer.result(0.0)
    assert not reply.accepted and "replay" in reply.reason


def test_a_newcomer_gets_the_latched_messages_while_it_is_paused(recorded, room):
    host = room.host(recorded.path, start="1.0", paused=True)
    room.run(host, 3.0)
    late = room.seat()
    worlds, events = late.subscribe(WORLD), late.subscribe(EVENT)
    room.run(host, 1.1)
    assert worlds.receive().message().tick == 50
    assert events.receive() is None


def test_a_paused_replay_publishes_no_message_twice_while_a_recorder_listens(recorded, room):
    host = room.host(recorded.path, start="1.0", paused=True)
    recorder = room.seat()
    recorder.declare_alive("recorder", "recorder")
    room.run(host, 1.0)
    worlds = recorder.subscribe(WORLD)
    room.run(host, 5.0, 0.1)
    assert worlds.receive() is None


def test_it_follows_a_match_that_is_still_recorded(rig, room, wait_until_written):
    """Time-shift: seconds behind, paused while the match goes on, and to the end when it is over."""
    rig.play(range(100))
    wait_until_written(rig)
    host = room.host(rig.path, follow=True, behind=1.0)
    worlds = room.seat().subscribe(WORLD)
    newest = host.player.end_ns / 1e9
    room.run(host, 0.5)
    assert worlds.receive().message().time == pytest.approx(newest - 1.0, abs=0.03)
    host.player.control(ReplayRequest(operation=ReplayOperation.PAUSE))
    rig.play(range(100, 200))
    rig.leave()
    room.run(host, 2.0)
    host.player.control(ReplayRequest(operation=ReplayOperation.PLAY))
    room.run(host, 6.0)
    assert host.player.ended
    heard = []
    while (received := worlds.receive()) is not None:
        heard.append(received.message().tick)
    assert list(dict.fromkeys(heard)) == list(range(heard[0], 200))  # a paused replay repeats its latched messages


@pytest.mark.parametrize(
    ("wanted", "word"),
    [
        ({"start": "99"}, "--from 99 is after the end"),
        ({"start": "2", "end": "1"}, "--to 1 is before the beginning"),
        ({"selection": KeySelection(("wrld",))}, 'did you mean "world"'),
        ({"selection": KeySelection((), ("robot/blue1/command",))}, "matches no key"),
        ({"follow": True, "loop": True}, "--follow and --loop"),
        ({"start": "goal:7"}, "goal happened 1 times"),
    ],
)
def test_an_impossible_replay_is_reported_in_one_line(recorded, wanted, word):
    with pytest.raises(TouchlineError) as error:
        Replay(ReplaySettings(recorded.path, **wanted))
    assert word in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("selection", "keys"),
    [
        (KeySelection(("world", "game/event")), {"world", "game/event"}),
        (KeySelection(("robot/cyan$*/command",)), {"robot/cyan1/command", "robot/cyan2/command"}),
        (KeySelection(("game/**",), ("game/state",)), {"game/event"}),
    ],
)
def test_keys_are_chosen_by_expressions(recorded, selection, keys):
    opened, heard = Replay(ReplaySettings(recorded.path, rate=None, selection=selection)), []
    player = opened.player(SteppedClock(), publish=heard.append)
    while not player.ended:
        player.pump()
    assert {one.key for one in heard} == keys
