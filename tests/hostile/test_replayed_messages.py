"""Old messages that an account records and sends again on keys that it may write: no effect, and each is counted."""

import pytest

from schemas.config.match_config import MatchConfig
from schemas.messages.recorder import RecorderProgress
from schemas.topics import COMMAND, INVALID, RECORDER_PROGRESS, WORLD
from support.host_rig import TEAMS, HostRig

TICKS = 40


class Recording:
    """The messages of a topic, and a writer that sends them again with the numbers that they had."""

    def __init__(self, rig, topic, **chunks):
        self._messages = rig.outside.subscribe(topic, **chunks)
        self._writer = rig.outside.publisher(topic, **chunks)
        self.payloads = []

    def listen(self):
        self.payloads += [received.payload for received in iter(self._messages.receive, None)]

    def send(self, payloads):
        """Send these messages; the numbers go on from the last call, the first is 0."""
        for payload in payloads:
            self._writer.put_payload(payload)


@pytest.fixture(params=["lockstep", "realtime"])
def rig_of(request):
    made = []

    def make():
        config = MatchConfig.model_validate({"seed": 7, "teams": TEAMS, "pace": request.param})
        made.append(HostRig(config, settings={"has_accounts": True}))
        made[-1].join_all()
        return made[-1]

    yield make
    for rig in made:
        rig.host.simulation.close()


def undisturbed(rig_of):
    """The true states of the match without any replay, and the counts of cyan1 after it."""
    rig = rig_of()
    worlds = rig.listen(WORLD)
    rig.begin()
    rig.ticks(TICKS)
    return worlds.all(), rig.health().robots


def test_commands_of_earlier_ticks_have_no_effect_and_are_counted_as_double(rig_of):
    expected, without = undisturbed(rig_of)
    rig = rig_of()
    worlds, recording = rig.listen(WORLD), Recording(rig, COMMAND, robot="cyan1")
    rig.begin()
    rig.ticks(10)
    recording.listen()
    recorded = recording.payloads[:]
    for _ in range(TICKS - 10):
        recording.send(recorded[:1])
        rig.ticks(1)
    assert worlds.all() == expected
    health = rig.health()
    robot = health.robots["cyan1"]
    assert robot.duplicates == without["cyan1"].duplicates + TICKS - 10
    assert (robot.answers, robot.missed, robot.late) == (
        without["cyan1"].answers,
        without["cyan1"].missed,
        without["cyan1"].late,
    )
    assert robot.lost_commands == 0
    assert health.robots["magenta1"] == without["magenta1"]
    assert health.accounts["cyan"].messages > health.accounts["magenta"].messages


def test_commands_of_an_earlier_match_that_are_for_later_ticks_have_no_effect_and_are_counted_as_invalid(rig_of):
    earlier = rig_of()
    recording = Recording(earlier, COMMAND, robot="cyan1")
    earlier.begin()
    earlier.ticks(2 * TICKS)
    recording.listen()
    recorded = recording.payloads[TICKS + 5 :]

    expected, _ = undisturbed(rig_of)
    rig = rig_of()
    worlds, invalid, writer = rig.listen(WORLD), rig.listen(INVALID), Recording(rig, COMMAND, robot="cyan1")
    rig.begin()
    rig.ticks(5)
    writer.send(recorded)
    rig.ticks(TICKS - 5)
    assert worlds.all() == expected
    assert rig.health().robots["cyan1"].invalid == len(recorded)
    assert all("the newest sight is" in message.reason for message in invalid.all())


def test_progress_of_an_earlier_tick_neither_sets_a_recorder_back_nor_holds_the_host(rig_of):
    rig = rig_of()
    recorder = rig.record()
    rig.begin()
    rig.ticks(TICKS)
    before = rig.clock.now()
    replayed = rig.outside.publisher(RECORDER_PROGRESS, name="recorder")
    for _ in range(20):
        replayed.put(RecorderProgress(tick=1, messages=0, lost=0))
    recorder.pump()
    rig.ticks(1)
    assert rig.health().recorders["recorder"] <= 2
    assert rig.clock.now() - before < 2.0
    assert rig.health().accounts["recorder"].messages >= 20
