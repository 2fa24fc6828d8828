"""How the messages of a recording become moments."""

from pytest import approx

from recordings.stats.table import remarks
from schemas.game import EventKind, Phase
from schemas.side import Side
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


def test_what_was_not_recorded_is_missing_and_in_no_figure(film) -> None:
    film.held_by = "cyan2"
    film.rest(50)
    lost = {round(tick * 0.1 * 1e9) for tick in range(11, 41)}
    film.messages = [(time, message) for time, message in film.messages if time not in lost]
    figures = film.figures()
    assert (figures.duration, figures.evidence.missing) == (approx(5.0), approx(3.1))
    assert figures.in_play_s == approx(1.9)
    assert figures.sides[Side.CYAN].with_ball_s == approx(1.8)  # held since the end of the first tick
    assert "3.1 s were not recorded" in remarks(figures)[-1]
