"""The player: times and order of its messages, and its controls."""

import math

import pytest

from recordings.replay.player import LATCHED_TOPICS
from schemas.messages.replay import ReplayOperation, ReplayRequest

TICK = 0.02


def ask(make_player_rig, operation: ReplayOperation, **more):
    return make_player_rig.player.control(ReplayRequest(operation=operation, **more))


@pytest.mark.parametrize("rate", [0.25, 1.0, 7.0, 1000.0, math.inf])
def test_at_any_rate_all_messages_are_published_in_the_recorded_order(make_player_rig, recorded, rate):
    played = make_player_rig(rate=rate)
    played.finish()
    assert played.published == list(recorded.messages())


@pytest.mark.parametrize("rate", [0.5, 1.0, 4.0])
def test_messages_are_spaced_as_they_were(make_player_rig, rate):
    """A message is published not before its time, and at the first poll after it; polls are 1 ms apart."""
    played, said_at = make_player_rig(rate=rate), []
    for _ in range(round(4.2 / rate / 0.001)):
        before = len(played.published)
        played.player.pump()
        said_at += [(one.time, played.clock.now()) for one in played.published[before:]]
        played.clock.sleep_until(played.clock.now() + 0.001)
    assert len(said_at) == len(played.published) > 1000
    assert all(-1e-9 <= at - time / rate <= 0.001 + 1e-9 for time, at in said_at)


def test_as_fast_as_possible_takes_no_time(make_player_rig):
    played = make_player_rig(rate=math.inf)
    played.finish()
    assert played.clock.now() == 0.0


def test_it_plays_from_one_time_up_to_and_with_another(make_player_rig):
    played = make_player_rig(1.0, 2.0)
    played.finish()
    assert played.ticks()[0] == 49  # how things stand where it begins
    assert played.ticks()[1:] == list(range(50, 101))
    assert played.clock.now() == pytest.approx(1.0, abs=0.002)


def test_before_it_begins_in_the_middle_it_publishes_latched_messages_and_no_event(make_player_rig, recorded):
    played = make_player_rig(3.0)
    played.player.pump()
    told = [one for one in played.published if one.time < 3.0]
    newest = {one.key: one for one in recorded.messages() if one.time < 3.0 and one.topic.key in LATCHED_TOPICS}
    assert sorted(told) == sorted(newest.values())
    assert "game/state" in newest and "game/event" not in newest


def test_a_paused_replay_publishes_nothing_and_resumes_where_it_was(make_player_rig):
    played = make_player_rig()
    played.run(1.0)
    ask(played, ReplayOperation.PAUSE)
    count = len(played.published)
    played.run(5.0, 0.1)
    assert len(played.published) == count
    ask(played, ReplayOperation.PLAY)
    played.finish()
    assert played.ticks() == list(range(200))
    assert played.clock.now() == pytest.approx(199 * TICK + 5.0, abs=0.01)


def test_a_replay_that_begins_paused_publishes_nothing(make_player_rig):
    played = make_player_rig(paused=True)
    played.run(1.0, 0.1)
    assert played.published == []


def test_a_step_publishes_one_tick_with_all_its_messages(make_player_rig, recorded):
    played = make_player_rig(paused=True)
    ask(played, ReplayOperation.STEP)
    played.run(0.1)
    assert played.published == [one for one in recorded.messages() if one.time == 0.0]
    ask(played, ReplayOperation.STEP, ticks=3)
    played.run(0.1)
    assert played.ticks() == [0, 1, 2, 3]
    assert played.player.paused


def test_a_step_pauses_what_is_played(make_player_rig):
    played = make_player_rig()
    played.run(0.5)
    ask(played, ReplayOperation.STEP)
    played.run(1.0)
    assert played.ticks() == list(range(27))
    assert played.player.paused


@pytest.mark.parametrize("to", [0.0, 1.0, 2.0, 3.5])
def test_after_a_seek_it_publishes_the_latched_messages_and_goes_on_from_there(make_player_rig, to):
    played = make_player_rig()
    played.run(0.3)
    count = len(played.published)
    reply = ask(played, ReplayOperation.SEEK, to=str(to))
    assert reply.accepted and reply.time == pytest.approx(to)
    latched = played.published[count:]
    assert {one.key for one in latched} >= {"world", "game/state", "host/applied", "robot/cyan1/command"}
    assert max(one.time for one in latched) == pytest.approx(to)
    assert len({one.key for one in latched}) == len(latched)
    count = len(played.published)
    played.finish()
    assert played.ticks(count) == list(range(round(to / TICK), 200))


def test_a_seek_from_here_goes_so_far_and_stays_within_the_recording(make_player_rig):
    played = make_player_rig(paused=True)
    assert ask(played, ReplayOperation.SEEK, by=2.0).time == pytest.approx(2.0)
    assert ask(played, ReplayOperation.SEEK, by=-0.5).time == pytest.approx(1.5)
    assert ask(played, ReplayOperation.SEEK, by=-9.0).time == 0.0
    for far in (99.0, 1e300, 1.7e308):
        assert ask(played, ReplayOperation.SEEK, by=far).time == pytest.approx(199 * TICK)
        assert ask(played, ReplayOperation.SEEK, by=-far).time == 0.0


def test_the_highest_rate_that_a_number_can_say_plays_all_that_there_is(make_player_rig):
    played = make_player_rig(rate=1.7e308)
    played.run(0.1)
    assert played.player.ended


def test_a_change_of_rate_moves_it_on_from_where_it_is(make_player_rig):
    played = make_player_rig()
    played.run(1.0)
    ask(played, ReplayOperation.RATE, rate=4.0)
    played.run(0.5)
    assert played.player.position_ns / 1e9 == pytest.approx(3.0, abs=0.01)
    assert ask(played, ReplayOperation.RATE).rate is None
    played.finish()
    assert played.ticks() == list(range(200))
    assert played.clock.now() == pytest.approx(1.5, abs=0.01)


def test_it_begins_again_at_the_end_when_it_loops(make_player_rig):
    played = make_player_rig(0.0, 0.98, loop=True)
    played.run(2.5)
    ticks = [tick for tick, after in zip(played.ticks(), [*played.ticks()[1:], None], strict=True) if tick != after]
    assert ticks[:101] == [*range(50), *range(50), 0]
    ask(played, ReplayOperation.LOOP)
    played.finish()
    assert played.ticks()[-1] == 49


def test_a_replay_with_stay_remains_at_its_end_and_can_seek_back(make_player_rig):
    played = make_player_rig(stay=True, rate=math.inf)
    played.run(1.0, 0.1)
    assert not played.player.ended and played.player.paused
    ask(played, ReplayOperation.SEEK, to="3.96")
    ask(played, ReplayOperation.PLAY)
    played.run(0.1)
    assert played.ticks()[-2:] == [198, 199]


def test_latched_messages_can_be_published_again(make_player_rig):
    played = make_player_rig()
    played.run(1.0)
    count = len(played.published)
    played.player.republish_latched()
    assert played.ticks(count) == [50]
    assert {one.key for one in played.published[count:]} == {
        one.key for one in played.published if one.topic.key in LATCHED_TOPICS
    }


@pytest.mark.parametrize(
    ("request_", "word"),
    [
        (ReplayRequest(operation=ReplayOperation.SEEK), "either to, a target, or by"),
        (ReplayRequest(operation=ReplayOperation.SEEK, to="1", by=1.0), "either to, a target, or by"),
    ],
)
def test_what_cannot_be_done_is_refused_with_the_reason(make_player_rig, request_, word):
    played = make_player_rig()
    reply = played.player.control(request_)
    assert not reply.accepted and word in reply.reason


def test_it_publishes_no_new_tick_before_there_is_room(make_player_rig):
    room = [True]
    played = make_player_rig(rate=math.inf, can_publish=lambda: room[0])
    played.player.pump()
    room[0] = False
    played.player.pump()
    said = played.ticks()
    played.run(3.0, 0.1)
    assert played.ticks() in (said, [*said, said[-1] + 1])
    room[0] = True
    played.finish()
    assert played.ticks() == list(range(200))
