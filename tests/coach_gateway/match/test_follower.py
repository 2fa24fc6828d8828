import pytest

from coach_gateway.match.follower import MatchFollower, MatchNews
from coach_gateway.timing import STATE_SETTLES_S
from runtime.bus.contract import Bus, ReceivedMessage
from runtime.process.clock import WallClock
from schemas.messages.coach import ActiveOrder, CoachOrder
from schemas.messages.health import Health
from schemas.messages.radio import Belief, Radio
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.messages.world import BallTruth, World
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase, Score
from schemas.topics import ACTIVE_ORDER, BELIEF, EVENT, HEALTH, STATE, WORLD
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock


def seats() -> tuple[Bus, MatchFollower]:
    medium = SharedState()
    return medium.open_bus("friendly", SteppedClock()), MatchFollower(medium.open_bus("friendly", SteppedClock()))


def detailed() -> tuple[SharedState, Bus, MatchFollower]:
    medium = SharedState()
    host = medium.open_bus("friendly", WallClock())
    return medium, host, MatchFollower(medium.open_bus("friendly", SteppedClock()), details=True)


def world(tick: int) -> World:
    return World(tick=tick, time=tick * 0.02, robots={}, ball=BallTruth(x=tick, y=0, z=0.11, vx=0, vy=0, vz=0))


def belief(tick: int, role: str) -> Belief:
    return Belief(tick=tick, time=tick * 0.02, robot="cyan1", radio=Radio(role=role))


def state(tick: int, phase: Phase = Phase.PLAY) -> GameState:
    return GameState(tick=tick, time=tick * 0.02, phase=phase, score=Score(cyan=1))


def goal(tick: int) -> GameEvent:
    return GameEvent(tick=tick, time=tick * 0.02, clock=tick * 0.02, kind=EventKind.GOAL, rule="goal", text="goal")


def test_a_state_is_waited_for_until_it_is_settled_or_patience_ends() -> None:
    host, follower = seats()
    assert follower.wait_for_state(2.0) is None
    clock = follower.bus.clock
    assert clock.now() == pytest.approx(2.0, abs=0.1)
    host.publisher(STATE).put(state(1))
    assert follower.wait_for_state(100.0) == state(1)
    assert clock.now() == pytest.approx(2.0 + STATE_SETTLES_S, abs=0.2)


def test_the_newest_state_and_health_and_every_event_are_kept() -> None:
    host, follower = seats()
    states, events, healths = host.publisher(STATE), host.publisher(EVENT), host.publisher(HEALTH)
    for tick in (1, 2):
        states.put(state(tick))
        events.put(goal(tick))
        healths.put(Health(tick=tick, time=tick * 0.02, pace="lockstep", real_time_factor=5.0))
    assert len(follower.update().messages) == 6
    assert follower.state == state(2)
    assert follower.health is not None and follower.health.tick == 2
    assert follower.events == [goal(1), goal(2)]
    assert follower.update().messages == []


def test_a_match_is_finished_when_full_time_was_seen() -> None:
    host, follower = seats()
    states = host.publisher(STATE)
    states.put(state(1))
    follower.update()
    assert not follower.finished
    states.put(state(2, Phase.FULL_TIME))
    follower.update()
    assert follower.finished


def test_missed_messages_are_completed_from_a_recording_and_none_is_there_twice() -> None:
    host, follower = seats()
    for topic, message in ((EVENT, goal(1)), (STATE, state(2))):
        host.publisher(topic).put(message)
    follower.update()
    said = [(EVENT, goal(1)), (STATE, state(1)), (EVENT, goal(2)), (STATE, state(3, Phase.FULL_TIME))]
    kept = [ReceivedMessage(topic, topic.key, message.encode(), None) for topic, message in said]
    assert follower.merge_recorded([*kept, ReceivedMessage(STATE, STATE.key, b"{", None)]) == [
        goal(2),
        state(3, Phase.FULL_TIME),
    ]
    assert follower.events == [goal(1), goal(2)]
    assert follower.finished


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


def test_the_speed_is_zero_before_anything_was_seen() -> None:
    _, follower = seats()
    assert (follower.wall_s, follower.real_time_factor) == (0.0, 0.0)


def test_unreadable_messages_are_left_out() -> None:
    host, follower = seats()
    host.publisher(STATE).put_payload(b"{")
    assert follower.update().messages == []


def test_waiting_for_a_state_ends_after_its_patience() -> None:
    _, follower = seats()
    assert follower.wait_for_state(3.0) is None
    assert 3.0 <= follower.bus.clock.now() < 3.1


def test_the_first_state_of_many_that_come_is_not_taken_for_the_newest() -> None:
    """The host's cache may deliver all of them to a late subscriber, the oldest first, and not at once."""
    bus = SharedState().open_bus("friendly", SteppedClock())
    follower = MatchFollower(bus)
    states = [
        GameState(tick=tick, time=tick * 0.02, phase=Phase.PLAY, clock=0.0, score=Score()) for tick in (1, 50, 600)
    ]
    coming = iter([None, states[0], None, states[1], None, None, states[2]])

    def update() -> MatchNews:
        follower.state = next(coming, None) or follower.state
        return MatchNews()

    follower.update = update
    assert follower.wait_for_state(3.0) is states[2]


def test_worlds_beliefs_orders_and_past_events_belong_to_the_details() -> None:
    medium = SharedState()
    host = medium.open_bus("friendly", WallClock())
    host.publisher(EVENT).put(goal(1))
    outline = MatchFollower(medium.open_bus("friendly", SteppedClock()))
    details = MatchFollower(medium.open_bus("friendly", SteppedClock()), details=True)
    order = ActiveOrder(tick=1, time=0.02, order=CoachOrder(sequence=1), acknowledged={"cyan1": True})
    host.publisher(ACTIVE_ORDER, side="cyan").put(order)
    host.publisher(WORLD).put(world(1))
    beliefs = host.publisher(BELIEF, side="cyan", robot="cyan1")
    for role in ("keeper", "striker"):
        beliefs.put(belief(1, role))
    assert outline.update() == MatchNews()
    assert (outline.world, outline.beliefs, outline.events) == (None, {}, [])
    news = details.update()
    assert (news.world, news.beliefs, news.orders) == (True, ["team/cyan/belief/cyan1"], [Side.CYAN])
    assert details.world == world(1)
    assert details.radios == {"cyan1": Radio(role="striker")}
    assert details.orders.active(Side.CYAN) == order
    assert details.events == [goal(1)]


def test_a_world_that_cannot_be_read_leaves_the_one_before() -> None:
    _, host, follower = detailed()
    worlds = host.publisher(WORLD)
    worlds.put(world(1))
    follower.update()
    assert follower.world == world(1)
    worlds.put_payload(b"{")
    follower.update()
    assert [follower.world, follower.world] == [world(1)] * 2
    assert follower.payloads[WORLD.key] == world(1).encode()


def test_with_the_first_message_of_another_host_what_the_host_before_published_is_forgotten() -> None:
    medium, host, follower = detailed()
    host.publisher(EVENT).put(goal(1))
    worlds, states = host.publisher(WORLD), host.publisher(STATE)
    for tick in (1, 2, 3):
        worlds.put(world(tick))
        states.put(state(tick))
    follower.update()
    host.close()
    another = medium.open_bus("friendly", WallClock())
    another.publisher(WORLD).put(world(1))
    news = follower.update()
    assert (news.new_host, follower.host_changes, follower.events) == (True, 1, [])
    assert follower.world == world(1)
    another.publisher(EVENT).put(goal(7))
    assert not follower.update().new_host
    assert follower.events == [goal(7)]


def test_when_a_replay_goes_back_the_events_that_lie_ahead_again_are_forgotten() -> None:
    _, host, follower = detailed()
    states, events = host.publisher(STATE), host.publisher(EVENT)
    for tick in (1, 400):
        states.put(state(tick))
        events.put(goal(tick))
    assert not follower.update().rewound
    states.put(state(200))
    assert follower.update().rewound
    assert follower.events == [goal(1)]


def test_a_host_is_there_from_its_coming_to_its_going() -> None:
    _, host, follower = detailed()
    assert not follower.update().presence_changed
    host.declare_alive("host", "host")
    assert follower.update().presence_changed
    assert (follower.host_present, follower.gone) == (True, False)
    host.close()
    assert follower.update().presence_changed
    assert (follower.host_present, follower.gone) == (False, True)


def test_base_stations_that_connect_to_a_referee_box_are_listed() -> None:
    _, host, follower = detailed()
    host.declare_alive("refbox", "magenta")
    assert follower.update().refboxes_changed
    assert follower.refboxes == ["magenta"]
    host.withdraw_alive("refbox", "magenta")
    assert follower.update().refboxes_changed
    assert follower.refboxes == []
