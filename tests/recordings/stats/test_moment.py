"""How the messages of a recording become moments."""

from schemas.game import EventKind, Phase
from schemas.world import World


def test_the_state_of_a_tick_holds_from_the_next_one_on(film) -> None:
    film.rest(1)
    film.shot(phase=Phase.STOPPED, running=False)
    film.rest(1)
    assert [moment.in_play for moment in film.moments()] == [False, True, True, False]
    assert [moment.state.running for moment in film.moments()] == [True, True, False, False]


def test_what_is_said_in_a_tick_without_a_world_belongs_to_the_next(film) -> None:
    film.shot(events=[{"kind": EventKind.BALL_OUT}], placed=["cyan1"])
    film.rest(1)
    film.messages = [
        (time, message) for time, message in film.messages if not (isinstance(message, World) and message.tick == 1)
    ]
    first, second = film.moments()
    assert (first.events, first.placed) == ((), frozenset())
    assert [event.kind for event in second.events] == [EventKind.BALL_OUT]
    assert second.placed == {"cyan1"}
    assert second.dt == 2 * 0.1


def test_the_kick_is_what_the_kicker_had_asked_for(film) -> None:
    film.shot(touches=["cyan2"], kicked="cyan2", speed=(5.0, 0.0, 0.0))
    assert [moment.kick.speed if moment.kick else None for moment in film.moments()] == [None, 5.0]
