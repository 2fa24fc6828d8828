"""Goals, fouls, cards and restarts, as the referee called them."""

from schemas.game import Card, EventKind, Phase, Score
from schemas.side import Side


def test_the_score_is_the_states_and_goals_are_the_events(film) -> None:
    film.goal(Side.CYAN, "cyan2")
    film.goal(Side.CYAN, "magenta1")
    film.goal(Side.MAGENTA, "magenta2")
    figures = film.figures()
    assert [figures.sides[side].goals for side in Side] == [2, 1]
    assert [(goal.side, goal.robot) for goal in figures.goals] == [
        (Side.CYAN, "cyan2"),
        (Side.CYAN, "magenta1"),
        (Side.MAGENTA, "magenta2"),
    ]
    assert [robot.goals for robot in figures.robots] == [0, 1, 0, 1]


def test_a_goal_that_was_taken_back_is_not_in_the_score(film) -> None:
    film.goal(Side.CYAN, "cyan2")
    film.shot(score=Score())
    assert film.figures().sides[Side.CYAN].goals == 0


def test_fouls_are_counted_by_rule_and_offender_and_cards_by_colour(film) -> None:
    foul = {"kind": EventKind.FOUL, "side": Side.MAGENTA, "robot": "magenta2"}
    film.shot(events=[foul, {"kind": EventKind.CARD, "side": Side.MAGENTA, "robot": "magenta2", "card": Card.YELLOW}])
    film.shot(events=[foul])
    film.shot(events=[{"kind": EventKind.FOUL, "side": Side.CYAN, "robot": "cyan1"}])
    figures = film.figures()
    assert figures.sides[Side.MAGENTA].fouls == {"rule": 2}
    assert figures.sides[Side.CYAN].fouls == {"rule": 1}
    assert figures.sides[Side.MAGENTA].cards == {"yellow": 1, "red": 0}
    assert [robot.fouls for robot in figures.robots] == [1, 0, 0, 2]
    assert figures.robots[3].cards == {"yellow": 1, "red": 0}


def test_a_restart_is_counted_when_it_is_signalled_and_not_when_it_is_said_again(film) -> None:
    for side, phase in ((Side.CYAN, Phase.THROW_IN), (Side.CYAN, Phase.THROW_IN), (Side.MAGENTA, Phase.CORNER)):
        film.out()
        film.shot(phase=phase, side=side, running=False)
        film.shot(phase=phase, side=side, running=False)
        film.shot(phase=phase, side=side, running=True)
        film.shot(phase=Phase.PLAY, side=None, running=True)
    film.out()
    film.shot(phase=Phase.DROP_BALL, side=None, running=False)
    figures = film.figures()
    assert figures.sides[Side.CYAN].restarts == {"throw_in": 2}
    assert figures.sides[Side.MAGENTA].restarts == {"corner": 1}
    assert figures.drop_balls == 1
