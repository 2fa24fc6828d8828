from coach_gateway.view import MatchView
from schemas.bus.contract import Bus, Received
from schemas.bus.in_process import Medium
from schemas.clock import SteppedClock
from schemas.game import EventKind, GameEvent, GameState, Phase, Score
from schemas.host import Health
from schemas.topics import EVENT, HEALTH, STATE


def seats() -> tuple[Bus, MatchView]:
    medium = Medium()
    return medium.seat("friendly", SteppedClock()), MatchView(medium.seat("friendly", SteppedClock()))


def state(tick: int, phase: Phase = Phase.PLAY) -> GameState:
    return GameState(tick=tick, time=tick * 0.02, phase=phase, score=Score(cyan=1))


def goal(tick: int) -> GameEvent:
    return GameEvent(tick=tick, time=tick * 0.02, clock=tick * 0.02, kind=EventKind.GOAL, rule="goal", text="goal")


def test_the_newest_state_and_health_and_every_event_are_kept() -> None:
    host, view = seats()
    states, events, healths = host.publisher(STATE), host.publisher(EVENT), host.publisher(HEALTH)
    for tick in (1, 2):
        states.put(state(tick))
        events.put(goal(tick))
        healths.put(Health(tick=tick, time=tick * 0.02, pace="lockstep", real_time_factor=5.0))
    assert len(view.update()) == 6
    assert view.state == state(2)
    assert view.health is not None and view.health.tick == 2
    assert view.events == [goal(1), goal(2)]
    assert view.update() == []


def test_a_match_is_finished_when_full_time_was_seen() -> None:
    host, view = seats()
    states = host.publisher(STATE)
    states.put(state(1))
    view.update()
    assert not view.finished
    states.put(state(2, Phase.FULL_TIME))
    view.update()
    assert view.finished


def test_what_was_missed_is_completed_by_whoever_kept_it_and_nothing_is_there_twice() -> None:
    host, view = seats()
    for topic, message in ((EVENT, goal(1)), (STATE, state(2))):
        host.publisher(topic).put(message)
    view.update()
    said = [(EVENT, goal(1)), (STATE, state(1)), (EVENT, goal(2)), (STATE, state(3, Phase.FULL_TIME))]
    kept = [Received(topic, topic.key, message.encode(), None) for topic, message in said]
    assert view.complete([*kept, Received(STATE, STATE.key, b"{", None)]) == [goal(2), state(3, Phase.FULL_TIME)]
    assert view.events == [goal(1), goal(2)]
    assert view.finished
    assert view.unreadable == 1


def test_the_real_time_factor_is_simulated_over_wall_time_of_what_was_played() -> None:
    host, view = seats()
    states = host.publisher(STATE)
    states.put(state(0, Phase.PRE_GAME))
    host.clock.sleep_until(100.0)  # waiting for the robots is no play
    states.put(state(50))
    host.clock.sleep_until(102.0)
    states.put(state(550))
    view.update()
    assert view.wall_s == 2.0
    assert view.real_time_factor == 5.0


def test_nothing_seen_has_no_speed() -> None:
    _, view = seats()
    assert (view.wall_s, view.real_time_factor) == (0.0, 0.0)


def test_what_cannot_be_read_is_counted_and_left_out() -> None:
    host, view = seats()
    host.publisher(STATE).put_payload(b"{")
    assert view.update() == []
    assert view.unreadable == 1


def test_waiting_for_a_state_ends_after_its_patience() -> None:
    _, view = seats()
    assert view.wait_for_state(3.0) is None
    assert 3.0 <= view.bus.clock.now() < 3.1


def test_the_first_state_of_many_that_come_is_not_taken_for_the_newest() -> None:
    """The host's cache may tell a late reader all of them, the oldest first, and not at once."""
    bus = Medium().seat("friendly", SteppedClock())
    view = MatchView(bus)
    states = [
        GameState(tick=tick, time=tick * 0.02, phase=Phase.PLAY, clock=0.0, score=Score()) for tick in (1, 50, 600)
    ]
    coming = iter([None, states[0], None, states[1], None, None, states[2]])

    def update() -> list[object]:
        view.state = next(coming, None) or view.state
        return []

    view.update = update
    assert view.wait_for_state(3.0) is states[2]
