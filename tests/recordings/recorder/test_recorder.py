from collections.abc import Callable

from mcap.reader import make_reader
from mcap.records import Message, Metadata
from mcap.stream_reader import StreamReader

from recordings.container.manifest import EndReason
from recordings.reading.recording import open_recording
from recordings.recorder.recording_writer import RecordingWriter
from runtime.bus.contract import Bus, ReceivedMessage, Stamp
from schemas.messages.health import Health
from schemas.messages.world import World
from schemas.soccer.game import Phase, Score
from schemas.topics import COMMAND, EVENT, HEALTH, ORDER, RECORD_BATCH, RECORDER_PROGRESS, SIGHT, WORLD


def records(path):
    with path.open("rb") as file:
        return list(StreamReader(file, validate_crcs=True).records)


def stock_messages(path):
    with path.open("rb") as file:
        return [(channel, message) for _, channel, message in make_reader(file).iter_messages(log_time_order=False)]


def reports(bus: Bus):
    return bus.subscribe(RECORDER_PROGRESS)


def test_nothing_is_lost_and_each_key_keeps_its_order(rig):
    rig.play(range(300), pump_every=7)
    summary = rig.leave()

    by_key: dict[str, list[bytes]] = {}
    for recorded in rig.read().messages():
        by_key.setdefault(recorded.key, []).append(recorded.payload)
    assert [World.decode(payload).tick for payload in by_key["world"]] == list(range(300))
    assert {len(payloads) for payloads in by_key.values()} == {300}
    assert len(by_key) == 6
    assert summary.result.messages == 1800
    assert summary.result.lost == 0
    assert summary.result.missed_before_start == 0


def test_ticks_stand_one_after_another_however_seldom_the_recorder_looks(rig):
    rig.play(range(100), pump_every=40)
    rig.leave()

    ticks = [round(recorded.time / 0.02) for recorded in rig.read().messages()]
    assert ticks == [tick for tick in range(100) for _ in range(6)]


def test_the_file_opens_with_the_stock_reader_and_carries_sequence_and_times(rig):
    rig.host.bus.clock.sleep_until(5.0)
    rig.play(range(50))
    rig.leave()

    worlds = [message for channel, message in stock_messages(rig.path) if channel.topic == "world"]
    assert [message.sequence for message in worlds] == list(range(50))
    assert [message.log_time for message in worlds] == [tick * 20_000_000 for tick in range(50)]
    assert {message.publish_time for message in worlds} == {5_000_000_000}


def test_channels_say_what_they_carry(rig):
    rig.play(range(3))
    rig.leave()

    channel = next(c for c, _ in stock_messages(rig.path) if c.topic == "robot/cyan1/command")
    assert channel.message_encoding == "json"
    assert channel.metadata == {
        "key": "touchline/friendly/robot/cyan1/command",
        "topic": "command",
        "row": "robot/{robot}/command",
        "message": "Command",
        "version": "2.0",
        "robot": "cyan1",
        "side": "cyan",
        "team": "Team cyan",
        "model": "standard",
    }


def test_each_message_model_is_registered_once(rig):
    rig.play(range(3))
    rig.leave()

    with rig.path.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert sorted((schema.name, schema.encoding) for schema in summary.schemas.values()) == [
        ("foxglove.FrameTransforms", "protobuf"),
        ("foxglove.SceneUpdate", "protobuf"),
        ("touchline.Applied", "jsonschema"),
        ("touchline.Command", "jsonschema"),
        ("touchline.World", "jsonschema"),
    ]


def test_the_manifest_stands_before_the_first_message_and_the_result_after_the_last(rig):
    rig.play(range(100))
    rig.leave()

    found = records(rig.path)
    named = [(index, record.name) for index, record in enumerate(found) if isinstance(record, Metadata)]
    messages = [index for index, record in enumerate(found) if isinstance(record, Message)]
    assert [name for _, name in named] == ["manifest", "manifest_copy", "result"]
    assert named[1][0] < messages[0]
    assert named[2][0] > messages[-1]


def test_a_sender_without_simulated_time_is_recorded_at_the_hosts(make_rig):
    rig = make_rig()
    coach = rig.host.bus.shared_state.open_bus("friendly", type(rig.host.bus.clock)())
    order = coach.publisher(ORDER, side="cyan")
    rig.begin()
    rig.play(range(50))
    rig.recorder.pump()
    order.put_payload(b'{"version":"2.0","sequence":1}')
    rig.host.relay(49)
    rig.recorder.pump()
    rig.play(range(50, 100))
    rig.leave()

    (recorded,) = rig.read().messages("team/cyan/order")
    assert recorded.log_ns == 49 * 20_000_000


def test_a_payload_that_cannot_be_read_is_recorded_as_it_is(rig):
    junk = b'{"answers_tick": "soon", \xff\xfe'
    rig.play(range(5))
    rig.host.writers["robot/cyan2/command"].put_payload(junk)
    rig.host.writers["host/applied"].put_payload(junk)
    rig.host.relay(4)
    rig.recorder.pump()
    rig.play(range(5, 10))
    summary = rig.leave()

    recording = rig.read()
    assert junk in [recorded.payload for recorded in recording.messages("robot/cyan2/command")]
    assert len(list(recording.decoded("robot/cyan2/command"))) == 10
    assert recording.unreadable == {"robot/cyan2/command": 1}
    assert summary.result.unreadable == {"host/applied": 1}
    assert summary.result.tick == 9


def test_a_message_without_a_stamp_is_recorded_and_counted_as_unstamped(rig):
    rig.play(range(5))
    for reader in rig.recorder_bus.shared_state.subscriptions["friendly/" + COMMAND.key]:
        reader.deliver("robot/cyan1/command", ReceivedMessage(COMMAND, "robot/cyan1/command", b"{}", None))
    rig.host.relay(5)
    summary = rig.leave()

    assert summary.result.keys["robot/cyan1/command"].unstamped == 1
    assert summary.result.keys["robot/cyan1/command"].messages == 6


def test_sights_are_recorded_on_demand_and_then_all_of_them(make_rig, tmp_path):
    for sights, expected in ((True, 30), (False, 0)):
        rig = make_rig(sights=sights, path=tmp_path / f"{sights}.mcap")
        rig.begin()
        sight = rig.host.batches.recorded_publisher(SIGHT, robot="cyan1")
        for _ in range(30):
            sight.put_payload(b"{}")
        rig.leave()
        assert len(list(rig.read().messages("robot/cyan1/sight"))) == expected
        assert rig.read().manifest.sights is sights


def test_a_recorder_of_sights_asks_the_host_for_them(make_rig, tmp_path):
    for sights in (True, False):
        rig = make_rig(sights=sights, path=tmp_path / f"{sights}.mcap")
        heard = reports(rig.host.bus)
        rig.begin()
        rig.play(range(30))
        assert heard.receive().message().sights is sights


def test_the_setup_is_asked_for_again_until_the_host_answers(make_rig):
    rig = make_rig()
    rig.host.play(0)
    for _ in range(20):
        rig.recorder.pump()
        rig.recorder_bus.clock.sleep_until(rig.recorder_bus.clock.now() + 0.1)
    rig.host.answer()
    rig.recorder.pump()
    rig.leave()

    recording = rig.read()
    assert recording.manifest.setup == rig.host.setup
    assert len(list(recording.messages("world"))) == 1


def test_without_an_answer_the_recording_begins_all_the_same(make_rig):
    rig = make_rig()
    rig.play(range(10))
    clock = rig.recorder_bus.clock
    clock.sleep_until(30.0)
    rig.recorder.pump()
    rig.leave()

    assert rig.read().manifest.setup is None
    assert len(list(rig.read().messages("world"))) == 10


def test_progress_is_reported_after_25_ticks_though_no_time_has_passed(rig):
    heard = reports(rig.host.bus)
    for tick in range(60):
        rig.host.play(tick)
        if tick in (10, 30):
            rig.recorder.pump()

    ticks = [received.message().tick for received in iter(heard.receive, None)]
    assert ticks == [30]


def test_progress_is_reported_when_the_host_has_fallen_silent(rig):
    heard = reports(rig.host.bus)
    rig.host.play(0)
    rig.recorder.pump()
    rig.recorder.pump()

    report = heard.receive().message()
    assert (report.tick, report.messages, report.lost) == (0, 6, 0)


def test_progress_is_reported_every_50_ms_of_wall_time(rig):
    heard = reports(rig.host.bus)
    clock = rig.recorder_bus.clock
    for _ in range(100):
        clock.sleep_until(clock.now() + 0.01)
        rig.recorder.pump()

    count = len(list(iter(heard.receive, None)))
    assert 16 <= count <= 21


def test_a_recorder_that_joins_late_is_not_behind_by_what_was_before_it(rig):
    heard = reports(rig.host.bus)
    rig.host.batches.publisher(HEALTH).put(Health(tick=5000, time=100.0, pace="lockstep", real_time_factor=1.0))
    rig.host.batches.end_tick(5000)
    rig.host.batches.send()
    rig.recorder.pump()
    rig.recorder.pump()

    assert heard.receive().message().tick == 5000


def look_for(rig, seconds: float) -> None:
    """Nothing comes for so long, and the recorder looks all the while."""
    clock = rig.recorder_bus.clock
    for _ in range(round(seconds / 0.05)):
        clock.sleep_until(clock.now() + 0.05)
        rig.recorder.pump()


def break_link(rig) -> Callable[[], None]:
    """Lose all batches from now on, until what is returned is called."""
    (reader,) = rig.recorder_bus.shared_state.subscriptions[f"friendly/{RECORD_BATCH.key}"]
    bring, reader.deliver = reader.deliver, lambda *message: None

    def mend() -> None:
        reader.deliver = bring

    return mend


def look_and_answer(rig, seconds: float) -> None:
    """The recorder looks for so long, and the host answers what it asks."""
    clock = rig.recorder_bus.clock
    for _ in range(round(seconds / 0.05)):
        clock.sleep_until(clock.now() + 0.05)
        rig.recorder.pump()
        rig.host.answer()


def ticks_of(recording, key: str) -> list[int]:
    return [round(recorded.time / 0.02) for recorded in recording.messages(key)]


def test_a_tick_counts_as_taken_in_when_all_batches_up_to_it_have_come(rig):
    """Or a host would run away from a recorder, or leave the match, while they are fetched still."""
    heard = reports(rig.host.bus)
    rig.play(range(40))
    mend = break_link(rig)
    rig.play(range(40, 80))
    mend()
    rig.play(range(80, 90))
    look_for(rig, 0.2)
    assert [report.message().tick for report in iter(heard.receive, None)][-1] == 39
    look_and_answer(rig, 0.5)
    assert [report.message().tick for report in iter(heard.receive, None)][-1] == 89


def test_a_recorder_that_missed_batches_has_them_again_and_its_file_is_whole(rig):
    rig.play(range(20))
    mend = break_link(rig)
    rig.play(range(20, 50))
    rig.host.goal(50)
    rig.play(range(50, 80))
    mend()
    rig.play(range(80, 100))
    look_and_answer(rig, 1.0)
    rig.leave()

    recording = rig.read()
    result = recording.result
    assert (result.lost, result.lost_batches, result.missed_before_start) == (0, 0, 0)
    ticks = [round(recorded.time / 0.02) for recorded in recording.messages() if recorded.key != EVENT.key]
    assert ticks == [tick for tick in range(100) for _ in range(6)]
    assert ticks_of(recording, EVENT.key) == [49]


def test_what_the_host_keeps_no_more_is_counted_as_lost_on_each_key(rig, monkeypatch):
    monkeypatch.setattr("runtime.bus.batch_publisher.KEPT_BATCHES", 10)
    rig.play(range(20))
    mend = break_link(rig)
    rig.play(range(20, 60))
    mend()
    rig.play(range(60, 65))
    look_and_answer(rig, 1.0)
    rig.leave()

    recording = rig.read()
    kept = [*range(20), *range(55, 65)]
    assert ticks_of(recording, WORLD.key) == kept
    assert {count.lost for count in recording.result.keys.values()} == {35}
    assert recording.result.lost == 6 * 35
    assert recording.result.lost_batches == 35
    times = [recorded.log_ns for recorded in recording.messages()]
    assert times == sorted(times)


def test_a_host_that_stands_still_leaves_nothing_unwritten_for_long(rig):
    rig.play(range(4), pump_every=1)
    look_for(rig, 1.0)
    rig.sink.abandon()

    assert len(list(open_recording(rig.path).messages("world"))) == 4


def test_a_goal_is_on_the_disk_before_the_recording_ends(rig, monkeypatch):
    synced = []
    monkeypatch.setattr(RecordingWriter, "sync", lambda self: synced.append(True))
    rig.play(range(20))
    rig.host.goal(20)
    rig.play(range(20, 22))
    assert synced == [True]
    rig.play(range(22, 60))
    assert synced == [True]


def test_the_result_of_a_match_that_was_played_to_its_end(recorded):
    result = recorded.result
    assert result.ended is EndReason.FULL_TIME
    assert result.phase is Phase.FULL_TIME
    assert result.score == Score(cyan=1)
    assert result.events == 1
    assert result.tick == 199
    assert result.time == 199 * 0.02


def test_a_recorder_that_waits_for_its_host_to_return_ends_on_request_as_without_a_host(rig):
    clock = rig.recorder_bus.clock
    rig.play(range(10))
    rig.host.batches.send()
    rig.host.bus.close()
    summary = rig.recorder.run(lambda: clock.now() >= 1.0)
    assert clock.now() < 2.0
    assert summary.result.ended is EndReason.HOST_GONE
    assert len(list(rig.read().messages("world"))) == 10


def test_a_recorder_polls_at_once_when_the_match_is_over(rig):
    """Otherwise five times a second: a look costs more than what it finds."""
    clock, recorder, looks = rig.recorder_bus.clock, rig.recorder, []
    pump = recorder.pump

    def look() -> int:
        looks.append(round(clock.now(), 3))
        return pump()

    def stop() -> bool:
        now = round(clock.now(), 3)
        if now == 0.65:
            rig.host.referee(0, Phase.FULL_TIME, Score())
        return now >= 0.8

    recorder.pump = look
    recorder.run(stop)
    assert looks[:7] == [0.0, 0.2, 0.4, 0.6, 0.65, 0.7, 0.75]


def test_the_recording_ends_on_request(rig):
    rig.play(range(10))
    summary = rig.recorder.run(lambda: True)
    assert summary.result.ended is EndReason.STOPPED
    assert len(list(rig.read().messages("world"))) == 10


def test_a_recorder_without_a_link_waits_for_nothing_more(rig):
    """What had come before the link ended is taken in; with a link it waits a moment for what is on its way."""
    clock, bus = rig.recorder_bus.clock, rig.recorder_bus
    rig.play(range(20))
    began = clock.now()
    rig.recorder.drain(10.0)
    assert clock.now() - began >= 0.25
    for tick in range(20, 30):
        rig.host.play(tick)
    bus.connected = lambda: False
    began = clock.now()
    rig.recorder.drain(10.0)
    assert clock.now() == began
    rig.recorder.finish()
    assert [World.decode(recorded.payload).tick for recorded in rig.read().messages(WORLD.key)] == list(range(30))


def test_the_manifest_names_config_versions_and_mathematics(recorded):
    manifest = recorded.manifest
    assert manifest.config.seed == 7
    assert manifest.setup.teams["cyan"].name == "Team cyan"
    assert {"touchline", "python", "mcap", "numpy", "platform", "machine"} <= set(manifest.versions)
    assert len(manifest.libm) == 16
    with recorded.path.open("rb") as file:
        assert make_reader(file).get_header().library.startswith("touchline/")


def test_match_file_profile_rules_and_whole_schemas_are_attached(recorded):
    assert sorted(recorded.attachments) == ["match.json", "message_schemas.json", "profile.json", "rules.json"]
    assert b'"$defs"' in recorded.attachments["message_schemas.json"]
    assert b'"seed":7' in recorded.attachments["match.json"]


def test_a_stamp_counts_modulo_the_32_bits_of_the_file(rig):
    rig.host.batches.add_received(ReceivedMessage(WORLD, "world", b"{}", Stamp(2**32 + 5, 1, 0)))
    rig.leave()
    (recorded,) = rig.read().messages("world")
    assert recorded.sequence == 5


def test_batches_that_cannot_be_read_are_counted_and_passed_over(rig):
    rig.play(range(5))
    publisher = rig.host.bus.publisher(RECORD_BATCH)
    publisher.put_payload(b'{"version":"2.0","tick":5,"entries":[{"key":"robot/cyan1/command","octets":"a"}]}')
    rig.play(range(5, 10))
    summary = rig.leave()
    assert summary.result.unreadable == {"host/record_batch": 1}
    assert summary.result.keys["robot/cyan1/command"].messages == 10
