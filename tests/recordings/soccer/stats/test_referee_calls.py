"""Goals, fouls, cards and restarts, as the referee called them."""

from recordings.soccer.stats.table import headline, side_rows
from schemas.side import Side
from schemas.soccer.game import Card, EventKind, Phase, Score


def test_the_score_is_the_states_and_goals_are_the_events(script) -> None:
    script.goal(Side.CYAN, "cyan2")
    script.goal(Side.CYAN, "magenta1")
    script.goal(Side.MAGENTA, "magenta2")
    figures = script.figures()
    assert [figures.sides[side].goals for side in Side] == [2, 1]
    assert [(goal.side, goal.robot) for goal in figures.goals] == [
        (Side.CYAN, "cyan2"),
        (Side.CYAN, "magenta1"),
        (Side.MAGENTA, "magenta2"),
    ]
    assert [robot.goals for robot in figures.robots] == [0, 1, 0, 1]


def test_a_goal_that_was_taken_back_is_not_in_the_score(script) -> None:
    script.goal(Side.CYAN, "cyan2")
    script.shot(score=Score())
    assert script.figures().sides[Side.CYAN].goals == 0


def test_penalties_of_a_shoot_out_are_beside_the_goals(script) -> None:
    script.goal(Side.CYAN, "cyan2")
    assert script.figures().sides[Side.CYAN].shoot_out is None
    script.shot(shoot_out=Score(cyan=3, magenta=4))
    figures = script.figures()
    assert [(figures.sides[side].goals, figures.sides[side].shoot_out) for side in Side] == [(1, 3), (0, 4)]
    assert ("penalties", "3", "4") in side_rows(figures)
    assert "penalties 3 : 4" in headline(figures)


def test_fouls_are_counted_by_rule_and_offender_and_cards_by_colour(script) -> None:
    foul = {"kind": EventKind.FOUL, "side": Side.MAGENTA, "robot": "magenta2"}
    script.shot(events=[foul, {"kind": EventKind.CARD, "side": Side.MAGENTA, "robot": "magenta2", "card": Card.YELLOW}])
    script.shot(events=[foul])
    script.shot(events=[{"kind": EventKind.FOUL, "side": Side.CYAN, "robot": "cyan1"}])
    figures = script.figures()
    assert figures.sides[Side.MAGENTA].fouls == {"rule": 2}
    assert figures.sides[Side.CYAN].fouls == {"rule": 1}
    assert figures.sides[Side.MAGENTA].cards == {"yellow": 1, "red": 0}
    assert [robot.fouls for robot in figures.robots] == [1, 0, 0, 2]
    assert figures.robots[3].cards == {"yellow": 1, "red": 0}


def test_a_restart_is_counted_when_it_is_signalled_and_not_when_its_state_is_repeated(script) -> None:
    for side, phase in ((Side.CYAN, Phase.THROW_IN), (Side.CYAN, Phase.THROW_IN), (Side.MAGENTA, Phase.CORNER)):
        script.out()
        script.shot(phase=phase, side=side, running=False)
        script.shot(phase=phase, side=side, running=False)
        for _ in range(3):
            script.shot(phase=phase, side=side, running=True)
        script.shot(phase=Phase.PLAY, side=None, running=True)
    script.out()
    script.shot(phase=Phase.DROP_BALL, side=None, running=False)
    figures = script.figures()
    assert figures.sides[Side.CYAN].restarts == {"throw_in": 2}
    assert figures.sides[Side.MAGENTA].restarts == {"corner": 1}
    assert figures.drop_balls == 1
