"""How the messages of a recording become ticks of a match."""

from pytest import approx

from recordings.soccer.stats.table import remarks
from schemas.messages.world import World
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase


def test_the_state_of_a_tick_holds_from_the_next_one_on(script) -> None:
    script.rest(1)
    script.shot(phase=Phase.STOPPED, running=False)
    script.rest(1)
    assert [match_tick.in_play for match_tick in script.match_ticks()] == [False, True, True, False]
    assert [match_tick.state.running for match_tick in script.match_ticks()] == [True, True, False, False]


def test_messages_of_a_tick_without_a_world_belong_to_the_next_tick(script) -> None:
    script.shot(events=[{"kind": EventKind.BALL_OUT}], placed=["cyan1"])
    script.rest(1)
    script.messages = [
        (time, message) for time, message in script.messages if not (isinstance(message, World) and message.tick == 1)
    ]
    first, second = script.match_ticks()
    assert (first.events, first.placed) == ((), frozenset())
    assert [event.kind for event in second.events] == [EventKind.BALL_OUT]
    assert second.placed == {"cyan1"}
    assert second.dt == 2 * 0.1


def test_the_kick_is_what_the_kicker_had_asked_for(script) -> None:
    script.shot(touches=["cyan2"], kicked="cyan2", speed=(5.0, 0.0, 0.0))
    assert [match_tick.kick.speed if match_tick.kick else None for match_tick in script.match_ticks()] == [None, 5.0]


def test_what_was_not_recorded_is_missing_and_in_no_figure(script) -> None:
    script.held_by = "cyan2"
    script.rest(50)
    lost = {round(tick * 0.1 * 1e9) for tick in range(11, 41)}
    script.messages = [(time, message) for time, message in script.messages if time not in lost]
    figures = script.figures()
    assert (figures.duration, figures.coverage.missing) == (approx(5.0), approx(3.1))
    assert figures.in_play_s == approx(1.9)
    assert figures.sides[Side.CYAN].with_ball_s == approx(1.8)  # held since the end of the first tick
    assert "3.1 s were not recorded" in remarks(figures)[-1]
