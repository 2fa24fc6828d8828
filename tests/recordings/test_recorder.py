from mcap.reader import make_reader
from mcap.records import Message, Metadata
from mcap.stream_reader import StreamReader

from recordings.manifest import Ended
from recordings.reader import open_recording
from recordings.writer import RecordingWriter
from schemas.bus.contract import Bus, Received, Stamp
from schemas.control import RecorderDeed, RecorderRequest
from schemas.game import Phase, Score
from schemas.host import Health
from schemas.topics import COMMAND, CONTROL, EVENT, HEALTH, MINUTES, ORDER, PROGRESS, SIGHT, WORLD
from schemas.world import World


def records(path):
    with path.open("rb") as file:
        return list(StreamReader(file, validate_crcs=True).records)


def stock_messages(path):
    with path.open("rb") as file:
        return [(channel, message) for _, channel, message in make_reader(file).iter_messages(log_time_order=False)]


def reports(bus: Bus):
    return bus.subscribe(PROGRESS)


def test_nothing_is_lost_and_each_key_keeps_its_order(stage):
    stage.play(range(300), pump_every=7)
    summary = stage.leave()

    by_key: dict[str, list[bytes]] = {}
    for recorded in stage.read().messages():
        by_key.setdefault(recorded.key, []).append(recorded.payload)
    assert [World.decode(payload).tick for payload in by_key["world"]] == list(range(300))
    assert {len(payloads) for payloads in by_key.values()} == {300}
    assert len(by_key) == 6
    assert summary.result.messages == 1800
    assert summary.result.lost == 0
    assert summary.result.missed_before_start == 0


def test_ticks_stand_one_after_another_however_seldom_the_recorder_looks(stage):
    stage.play(range(100), pump_every=40)
    stage.leave()

    ticks = [round(recorded.time / 0.02) for recorded in stage.read().messages()]
    assert ticks == [tick for tick in range(100) for _ in range(6)]


def test_the_order_of_the_file_does_not_depend_on_when_the_recorder_looks(make_stage, tmp_path):
    orders = []
    for pump_every in (1, 13):
        stage = make_stage(path=tmp_path / f"{pump_every}.mcap")
        stage.begin()
        stage.play(range(80), pump_every)
        stage.leave()
        orders.append([(recorded.key, recorded.sequence, recorded.log_ns) for recorded in stage.read().messages()])
    assert orders[0] == orders[1]


def test_the_file_opens_with_the_stock_reader_and_carries_sequence_and_times(stage):
    stage.host.bus.clock.sleep_until(5.0)
    stage.play(range(50))
    stage.leave()

    worlds = [message for channel, message in stock_messages(stage.path) if channel.topic == "world"]
    assert [message.sequence for message in worlds] == list(range(50))
    assert [message.log_time for message in worlds] == [tick * 20_000_000 for tick in range(50)]
    assert {message.publish_time for message in worlds} == {5_000_000_000}


def test_channels_say_what_they_carry(stage):
    stage.play(range(3))
    stage.leave()

    channel = next(c for c, _ in stock_messages(stage.path) if c.topic == "robot/cyan1/command")
    assert channel.message_encoding == "json"
    assert channel.metadata == {
        "key": "touchline/friendly/robot/cyan1/command",
        "topic": "command",
        "row": "robot/{robot}/command",
        "message": "Command",
        "version": "1.0",
        "robot": "cyan1",
        "side": "cyan",
        "team": "Team cyan",
        "model": "standard",
    }


def test_each_message_model_is_registered_once(stage):
    stage.play(range(3))
    stage.leave()

    with stage.path.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert sorted((schema.name, schema.encoding) for schema in summary.schemas.values()) == [
        ("foxglove.FrameTransforms", "protobuf"),
        ("foxglove.SceneUpdate", "protobuf"),
        ("touchline.Applied", "jsonschema"),
        ("touchline.Command", "jsonschema"),
        ("touchline.World", "jsonschema"),
    ]


def test_the_manifest_stands_before_the_first_message_and_the_result_after_the_last(stage):
    stage.play(range(100))
    stage.leave()

    found = records(stage.path)
    named = [(index, record.name) for index, record in enumerate(found) if isinstance(record, Metadata)]
    messages = [index for index, record in enumerate(found) if isinstance(record, Message)]
    assert [name for _, name in named] == ["manifest", "result"]
    assert named[0][0] < messages[0]
    assert named[1][0] > messages[-1]


def test_log_time_never_runs_backward_though_simulated_time_does(stage):
    stage.play(range(50, 100))
    stage.play(range(10))
    stage.play(range(95, 110))
    stage.leave()

    times = [message.log_time for _, message in stock_messages(stage.path)]
    assert times == sorted(times)
    worlds = [message for recorded, message in stage.read().decoded("world")]
    assert [world.tick for world in worlds] == [*range(50, 100), *range(10), *range(95, 110)]


def test_a_robot_that_claims_to_be_far_ahead_does_not_drag_the_time_of_the_file_along(stage):
    stage.play(range(10))
    stage.host.robots.clock.sim_ns = 10**18
    stage.host.writers["robot/cyan1/command"].put_payload(b"{}")
    stage.play(range(10, 60))
    stage.leave()

    assert max(message.log_time for _, message in stock_messages(stage.path)) == 59 * 20_000_000


def test_a_sender_without_simulated_time_is_recorded_at_the_hosts(make_stage):
    stage = make_stage()
    coach = stage.host.bus.medium.seat("friendly", type(stage.host.bus.clock)())
    order = coach.publisher(ORDER, side="cyan")
    stage.begin()
    stage.play(range(50))
    stage.recorder.pump()
    order.put_payload(b'{"version":"1.0","sequence":1}')
    stage.host.relay(49)
    stage.recorder.pump()
    stage.play(range(50, 100))
    stage.leave()

    (recorded,) = stage.read().messages("team/cyan/order")
    assert recorded.log_ns == 49 * 20_000_000


def test_a_gap_in_the_sequence_is_counted_on_its_key(stage):
    stage.play(range(10))
    world = stage.host.writers["world"]
    world._writer._sequence += 4
    stage.play(range(10, 20))
    summary = stage.leave()

    counts = summary.result.keys
    assert counts["world"].lost == 4
    assert counts["host/applied"].lost == 0
    assert summary.result.lost == 4
    assert stage.read().result.keys["world"].lost == 4


def test_what_was_sent_before_the_recorder_came_is_counted_apart(stage):
    for name in ("world", "host/applied"):
        stage.host.writers[name]._writer._sequence = 30
    stage.play(range(30, 40))
    summary = stage.leave()

    assert summary.result.keys["world"].missed_before_start == 30
    assert summary.result.missed_before_start == 60
    assert summary.result.lost == 0


def test_a_payload_that_cannot_be_read_is_recorded_as_it_is(stage):
    junk = b'{"answers_tick": "soon", \xff\xfe'
    stage.play(range(5))
    stage.host.writers["robot/cyan2/command"].put_payload(junk)
    stage.host.writers["host/applied"].put_payload(junk)
    stage.host.relay(4)
    stage.recorder.pump()
    stage.play(range(5, 10))
    summary = stage.leave()

    recording = stage.read()
    assert junk in [recorded.payload for recorded in recording.messages("robot/cyan2/command")]
    assert len(list(recording.decoded("robot/cyan2/command"))) == 10
    assert recording.unreadable == {"robot/cyan2/command": 1}
    assert summary.result.unreadable == {"host/applied": 1}
    assert summary.result.tick == 9


def test_a_message_without_a_stamp_is_recorded_and_counted_as_unstamped(stage):
    stage.play(range(5))
    for reader in stage.recorder_bus.medium.subscriptions["friendly/" + COMMAND.key]:
        reader.bring("robot/cyan1/command", Received(COMMAND, "robot/cyan1/command", b"{}", None))
    stage.host.relay(5)
    summary = stage.leave()

    assert summary.result.keys["robot/cyan1/command"].unstamped == 1
    assert summary.result.keys["robot/cyan1/command"].messages == 6


def test_sights_are_recorded_on_demand_and_then_all_of_them(make_stage, tmp_path):
    for sights, expected in ((True, 30), (False, 0)):
        stage = make_stage(sights=sights, path=tmp_path / f"{sights}.mcap")
        stage.begin()
        sight = stage.host.bus.publisher(SIGHT, robot="cyan1")
        for _ in range(30):
            sight.put_payload(b"{}")
        stage.leave()
        assert len(list(stage.read().messages("robot/cyan1/sight"))) == expected
        assert stage.read().manifest.sights is sights


def test_the_setup_is_asked_for_again_until_the_host_answers(make_stage):
    stage = make_stage()
    stage.host.play(0)
    for _ in range(20):
        stage.recorder.pump()
        stage.recorder_bus.clock.sleep_until(stage.recorder_bus.clock.now() + 0.1)
    stage.host.answer()
    stage.recorder.pump()
    stage.leave()

    recording = stage.read()
    assert recording.manifest.setup == stage.host.setup
    assert len(list(recording.messages("world"))) == 1


def test_without_an_answer_the_recording_begins_all_the_same(make_stage):
    stage = make_stage()
    stage.play(range(10))
    clock = stage.recorder_bus.clock
    clock.sleep_until(30.0)
    stage.recorder.pump()
    stage.leave()

    assert stage.read().manifest.setup is None
    assert len(list(stage.read().messages("world"))) == 10


def test_progress_is_reported_after_25_ticks_though_no_time_has_passed(stage):
    heard = reports(stage.host.bus)
    for tick in range(60):
        stage.host.play(tick)
        if tick in (10, 30):
            stage.recorder.pump()

    ticks = [received.message().tick for received in iter(heard.receive, None)]
    assert ticks == [30]


def test_progress_is_reported_when_the_host_has_fallen_silent(stage):
    heard = reports(stage.host.bus)
    stage.host.play(0)
    stage.recorder.pump()
    stage.recorder.pump()

    report = heard.receive().message()
    assert (report.tick, report.messages, report.lost) == (0, 6, 0)


def test_progress_is_reported_every_50_ms_of_wall_time(stage):
    heard = reports(stage.host.bus)
    clock = stage.recorder_bus.clock
    for _ in range(100):
        clock.sleep_until(clock.now() + 0.01)
        stage.recorder.pump()

    count = len(list(iter(heard.receive, None)))
    assert 16 <= count <= 21


def test_a_recorder_that_joins_late_is_not_behind_by_what_was_before_it(stage):
    heard = reports(stage.host.bus)
    stage.host.minutes.publisher(HEALTH).put(Health(tick=5000, time=100.0, pace="lockstep", real_time_factor=1.0))
    stage.host.minutes.send()
    stage.recorder.pump()
    stage.recorder.pump()

    assert heard.receive().message().tick == 5000


def look_for(stage, seconds: float) -> None:
    """Nothing comes for so long, and the recorder looks all the while."""
    clock = stage.recorder_bus.clock
    for _ in range(round(seconds / 0.05)):
        clock.sleep_until(clock.now() + 0.05)
        stage.recorder.pump()


class Detour:
    """Keeps back what comes to a recorder in one topic, as a broken link does; it is fetched later."""

    def __init__(self, stage, topic) -> None:
        (self._reader,) = stage.recorder_bus.medium.subscriptions[f"friendly/{topic.key}"]
        self._bring, self._kept = self._reader.bring, []
        self._reader.bring = lambda *message: self._kept.append(message)

    def end(self) -> None:
        self._reader.bring = self._bring
        for message in self._kept:
            self._bring(*message)


def play_with_sights(stage, ticks: range, pump_every: int) -> None:
    """As `Stage.play`, with a sight in each tick."""
    if (key := "robot/cyan1/sight") not in stage.host.writers:
        stage.host.writers[key] = stage.host.bus.publisher(SIGHT, robot="cyan1")
    for tick in ticks:
        stage.play(range(tick, tick + 1), pump_every=1000)
        stage.host.writers[key].put_payload(b"{}")
        if tick % pump_every == 0:
            stage.recorder.pump()


def test_a_tick_counts_as_taken_in_when_the_minutes_of_it_have_come(make_stage):
    """Or a host would run away from a recorder, or leave the match, while they are fetched still."""
    stage = make_stage(sights=True)
    stage.begin()
    heard = reports(stage.host.bus)
    play_with_sights(stage, range(40), pump_every=1)
    detour = Detour(stage, MINUTES)
    play_with_sights(stage, range(40, 80), pump_every=1)
    look_for(stage, 0.2)
    assert [report.message().tick for report in iter(heard.receive, None)][-1] == 39
    detour.end()
    look_for(stage, 0.2)
    assert [report.message().tick for report in iter(heard.receive, None)][-1] == 79


def test_a_host_that_stands_still_leaves_nothing_unwritten_for_long(stage):
    stage.play(range(4), pump_every=1)
    look_for(stage, 1.0)
    stage.output.abandon()

    assert len(list(open_recording(stage.path.with_name("match.mcap.part")).messages("world"))) == 4


def test_what_is_fetched_again_after_a_stall_stands_where_it_belongs(make_stage):
    """Topics are fetched one by one: what came of the others has to wait, however long the recorder stood still."""
    stage = make_stage(sights=True)
    stage.begin()
    play_with_sights(stage, range(20), pump_every=1)
    minutes, sights = Detour(stage, MINUTES), Detour(stage, SIGHT)
    play_with_sights(stage, range(20, 31), pump_every=1000)
    stage.host.goal(30)
    play_with_sights(stage, range(31, 80), pump_every=1000)
    clock = stage.recorder_bus.clock
    clock.sleep_until(clock.now() + 3.0)
    look_for(stage, 0.2)
    minutes.end()
    look_for(stage, 0.6)
    sights.end()
    look_for(stage, 2.0)
    stage.leave()

    recording = stage.read()
    assert (recording.result.lost, recording.result.keys["world"].messages) == (0, 80)
    ticks = [round(recorded.time / 0.02) for recorded in recording.messages() if recorded.key != EVENT.key]
    assert ticks == [tick for tick in range(80) for _ in range(7)]
    assert [round(recorded.time / 0.02) for recorded in recording.messages(EVENT.key)] == [30]


def test_a_goal_is_on_the_disk_before_the_recording_ends(stage, monkeypatch):
    synced = []
    monkeypatch.setattr(RecordingWriter, "sync", lambda self: synced.append(True))
    stage.play(range(20))
    stage.host.goal(20)
    stage.play(range(20, 22))
    stage.recorder.pump()
    assert synced == []
    stage.play(range(22, 60))
    stage.recorder.pump()
    stage.play(range(60, 90))
    assert synced == [True]


def test_the_result_of_a_match_that_was_played_to_its_end(recorded):
    result = recorded.result
    assert result.ended is Ended.FULL_TIME
    assert result.phase is Phase.FULL_TIME
    assert result.score == Score(cyan=1)
    assert result.events == 1
    assert result.tick == 199
    assert result.time == 199 * 0.02


def test_the_recording_ends_when_the_host_leaves_early(stage):
    stage.play(range(10))
    assert stage.leave().result.ended is Ended.HOST_GONE


def test_a_recorder_that_rests_looks_at_once_when_it_is_asked_something_and_when_the_match_is_over(stage):
    """Otherwise five times a second: a look costs more than what it finds."""
    clock, recorder, looks = stage.recorder_bus.clock, stage.recorder, []
    pump = recorder.pump

    def look() -> int:
        looks.append(round(clock.now(), 3))
        return pump()

    def stop() -> bool:
        now = round(clock.now(), 3)
        if now == 0.3:
            stage.host.bus.ask(CONTROL, RecorderRequest(deed=RecorderDeed.STATUS), name="recorder")
        elif now == 0.65:
            stage.host.referee(0, Phase.FULL_TIME, Score())
        return now >= 0.8

    recorder.pump = look
    recorder.run(stop)
    assert looks[:7] == [0.0, 0.2, 0.3, 0.5, 0.65, 0.7, 0.75]


def test_the_recording_ends_when_it_is_told_to(stage):
    stage.play(range(10))
    summary = stage.recorder.run(lambda: True)
    assert summary.result.ended is Ended.STOPPED
    assert len(list(stage.read().messages("world"))) == 10


def test_a_recorder_without_a_link_waits_for_nothing_more(stage):
    """What had come before the link ended is taken in; with a link it waits a moment for what is on its way."""
    clock, bus = stage.recorder_bus.clock, stage.recorder_bus
    stage.play(range(20))
    began = clock.now()
    stage.recorder.drain(10.0)
    assert clock.now() - began >= 0.25
    for tick in range(20, 30):
        stage.host.play(tick)
    bus.connected = lambda: False
    began = clock.now()
    stage.recorder.drain(10.0)
    assert clock.now() == began
    stage.recorder.finish()
    assert [World.decode(recorded.payload).tick for recorded in stage.read().messages(WORLD.key)] == list(range(30))


def test_the_recorder_is_seen_to_be_alive(stage):
    watch = stage.host.bus.watch_alive()
    present = {(presence.kind, presence.name) for presence in iter(watch.receive, None)}
    assert ("recorder", "recorder") in present


def test_the_manifest_names_config_versions_and_mathematics(recorded):
    manifest = recorded.manifest
    assert manifest.config.seed == 7
    assert manifest.setup.teams["cyan"].name == "Team cyan"
    assert {"touchline", "python", "mcap", "numpy", "platform", "machine"} <= set(manifest.versions)
    assert len(manifest.libm) == 16
    assert recorded.library.startswith("touchline/")


def test_match_file_profile_rules_and_whole_schemas_are_attached(recorded):
    assert sorted(recorded.attachments) == [
        "match.json",
        "message_schemas.json",
        "profile.json",
        "rules.toml",
    ]
    assert b'"$defs"' in recorded.attachments["message_schemas.json"]
    assert b'"seed":7' in recorded.attachments["match.json"]


def test_a_stamp_counts_modulo_the_32_bits_of_the_file(stage):
    stage.host.minutes.note(Received(WORLD, "world", b"{}", Stamp(2**32 + 5, 1, 0)))
    stage.leave()
    (recorded,) = stage.read().messages("world")
    assert recorded.sequence == 5


def test_minutes_that_cannot_be_read_are_counted_and_passed_over(stage):
    stage.play(range(5))
    odd = b'{"version":"1.0","tick":5,"entries":[{"key":"robot/cyan1/command","octets":"a"}]}'
    stage.host.bus.publisher(MINUTES).put_payload(odd)
    stage.play(range(5, 10))
    summary = stage.leave()
    assert summary.result.unreadable == {"host/minutes": 1}
    assert summary.result.keys["robot/cyan1/command"].messages == 10
