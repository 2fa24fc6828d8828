from coach_gateway.match.follower import MatchFollower
from schemas.bus.contract import Bus, ReceivedMessage
from schemas.bus.in_process_bus import Medium
from schemas.game import EventKind, GameEvent, GameState, Phase, Score
from schemas.messages.host import Health
from schemas.process.clock import SteppedClock
from schemas.topics import EVENT, HEALTH, STATE


def seats() -> tuple[Bus, MatchFollower]:
    medium = Medium()
    return medium.open_bus("friendly", SteppedClock()), MatchFollower(medium.open_bus("friendly", SteppedClock()))


def state(tick: int, phase: Phase = Phase.PLAY) -> GameState:
    return GameState(tick=tick, time=tick * 0.02, phase=phase, score=Score(cyan=1))


def goal(tick: int) -> GameEvent:
    return GameEvent(tick=tick, time=tick * 0.02, clock=tick * 0.02, kind=EventKind.GOAL, rule="goal", text="goal")


def test_the_newest_state_and_health_and_every_event_are_kept() -> None:
    host, follower = seats()
    states, events, healths = host.publisher(STATE), host.publisher(EVENT), host.publisher(HEALTH)
    for tick in (1, 2):
        states.put(state(tick))
        events.put(goal(tick))
        healths.put(Health(tick=tick, time=tick * 0.02, pace="lockstep", real_time_factor=5.0))
    assert len(follower.update()) == 6
    assert follower.state == state(2)
    assert follower.health is not None and follower.health.tick == 2
    assert follower.events == [goal(1), goal(2)]
    assert follower.update() == []


def test_a_match_is_finished_when_full_time_was_seen() -> None:
    host, follower = seats()
    states = host.publisher(STATE)
    states.put(state(1))
    follower.update()
    assert not follower.finished
    states.put(state(2, Phase.FULL_TIME))
    follower.update()
    assert follower.finished


def test_what_was_missed_is_completed_by_whoever_kept_it_and_nothing_is_there_twice() -> None:
    host, follower = seats()
    for topic, message in ((EVENT, goal(1)), (STATE, state(2))):
        host.publisher(topic).put(message)
    follower.update()
    said = [(EVENT, goal(1)), (STATE, state(1)), (EVENT, goal(2)), (STATE, state(3, Phase.FULL_TIME))]
    kept = [ReceivedMessage(topic, topic.key, message.encode(), None) for topic, message in said]
    assert follower.complete([*kept, ReceivedMessage(STATE, STATE.key, b"{", None)]) == [
        goal(2),
        state(3, Phase.FULL_TIME),
    ]
    assert follower.events == [goal(1), goal(2)]
    assert follower.finished
    assert follower.unreadable == 1


def test_the_real_time_factor_is_simulated_over_wall_time_of_what_was_played() -> None:
    host, follower = seats()
    states = host.publisher(STATE)
    states.put(state(0, Phase.PRE_GAME))
    host.clock.sleep_until(100.0)  # waiting for the robots is no play
    states.put(state(50))
    host.clock.sleep_until(102.0)
    states.put(state(550))
    follower.update()
    assert follower.wall_s == 2.0
    assert follower.real_time_factor == 5.0


def test_nothing_seen_has_no_speed() -> None:
    _, follower = seats()
    assert (follower.wall_s, follower.real_time_factor) == (0.0, 0.0)


def test_what_cannot_be_read_is_counted_and_left_out() -> None:
    host, follower = seats()
    host.publisher(STATE).put_payload(b"{")
    assert follower.update() == []
    assert follower.unreadable == 1


def test_waiting_for_a_state_ends_after_its_patience() -> None:
    _, follower = seats()
    assert follower.wait_for_state(3.0) is None
    assert 3.0 <= follower.bus.clock.now() < 3.1


def test_the_first_state_of_many_that_come_is_not_taken_for_the_newest() -> None:
    """The host's cache may tell a late reader all of them, the oldest first, and not at once."""
    bus = Medium().open_bus("friendly", SteppedClock())
    follower = MatchFollower(bus)
    states = [
        GameState(tick=tick, time=tick * 0.02, phase=Phase.PLAY, clock=0.0, score=Score()) for tick in (1, 50, 600)
    ]
    coming = iter([None, states[0], None, states[1], None, None, states[2]])

    def update() -> list[object]:
        follower.state = next(coming, None) or follower.state
        return []

    follower.update = update
    assert follower.wait_for_state(3.0) is states[2]
