"""Cards and repairs that name a side and no robot: the side names it in time, otherwise a default is taken."""

from typing import Any

import pytest

from schemas.messages.soccer.game import GameState, RobotQuestion
from schemas.side import Side
from schemas.soccer.game import REFBOX, Card, EventKind, OffField, OfficiatingMode
from support.referee_rig import RefereeRig

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA


@pytest.fixture
def box() -> RefereeRig:
    """A match in manual officiating, under a referee box, with the first kick-off signalled."""
    rig = RefereeRig("msl", mode=OfficiatingMode.MANUAL)
    rig.refbox = True
    say(rig, "kick_off", CYAN)
    return rig


def say(rig: RefereeRig, name: str, side: Side | None = None, **more: Any) -> str:
    """An action of the box; the reason of its refusal, or nothing."""
    (reply,) = rig.ask(name, side, **{"source": REFBOX, **more}).replies
    assert reply.accepted is not bool(reply.reason)
    return reply.reason


def answer(rig: RefereeRig, robot: str) -> str:
    (reply,) = rig.ask("name_robot", robot=robot, source="coach").replies
    return reply.reason


def published(rig: RefereeRig) -> GameState:
    return rig.state.game_state(1, 0.0)


def away(rig: RefereeRig) -> dict[str, OffField]:
    return {name: absence.why for name, absence in rig.state.participation.absences.items()}


def cards(rig: RefereeRig) -> list[tuple[str | None, Card | None]]:
    return [(event.robot, event.card) for event in rig.events if event.kind is EventKind.CARD]


def test_a_card_without_a_robot_asks_the_side_and_the_answer_gets_it(box: RefereeRig) -> None:
    assert say(box, "yellow_card", CYAN) == ""
    mine = [f"cyan{number}" for number in range(1, 6)]
    (question,) = published(box).questions
    assert question == RobotQuestion(action="yellow_card", side=CYAN, left=10.0, robots=mine, default="cyan5")
    box.run(5.0)
    assert published(box).questions[0].left == pytest.approx(5.0) and not cards(box)
    assert answer(box, "cyan3") == ""
    assert cards(box) == [("cyan3", Card.YELLOW)] and not published(box).questions
    box.run(10.0)
    assert len(cards(box)) == 1


def test_after_ten_seconds_the_highest_number_that_is_no_keeper_gets_the_card(box: RefereeRig) -> None:
    say(box, "red_card", MAGENTA)
    box.run(9.98)
    assert not cards(box)
    box.run(0.04)
    assert cards(box) == [("magenta5", Card.RED)] and away(box) == {"magenta5": OffField.RED_CARD}
    assert any("magenta has not named a robot within 10 s" in event.text for event in box.events)
    say(box, "red_card", MAGENTA)
    box.run(10.1)
    assert cards(box)[-1] == ("magenta4", Card.RED)


def test_the_last_offender_of_the_side_gets_the_card_by_default(box: RefereeRig) -> None:
    """Nobody calls a foul in manual officiating, and the referee has seen it all the same."""
    while not box.state.running:
        say(box, "start")
    box.playing()
    box.robots["cyan3"] = (box.pitch.goal_line - 0.3, 0.0)
    box.run(2.0)
    assert box.state.running and box.state.offender == "cyan3"
    say(box, "stop")
    for side in Side:
        say(box, "yellow_card", side)
    assert [question.default for question in published(box).questions] == ["cyan3", "magenta5"]
    box.run(10.1)
    assert cards(box) == [("cyan3", Card.YELLOW), ("magenta5", Card.YELLOW)]


@pytest.mark.parametrize(
    ("name", "why"),
    [("repair", OffField.REPAIR), ("substitute", OffField.SUBSTITUTION), ("double_yellow", OffField.SECOND_YELLOW)],
)
def test_a_robot_that_leaves_is_named_by_its_side_too(box: RefereeRig, name: str, why: OffField) -> None:
    assert say(box, name, CYAN) == ""
    assert answer(box, "cyan2") == ""
    assert away(box) == {"cyan2": why}
    assert say(box, name, MAGENTA) == ""
    box.run(10.1)
    assert away(box)["magenta5"] is why


def test_the_end_of_a_repair_needs_no_answer_while_one_robot_is_in_repair(box: RefereeRig) -> None:
    """The box's repair is over when the box ends it, however long ours takes."""
    say(box, "repair", robot="cyan4")
    assert away(box) == {"cyan4": OffField.REPAIR}
    assert say(box, "enter", CYAN) == ""
    assert not away(box) and not published(box).questions
    assert "allowed for no robot of cyan" in say(box, "enter", CYAN)


def test_of_two_robots_in_repair_the_side_names_the_one_that_comes_back(box: RefereeRig) -> None:
    for robot in ("cyan2", "cyan4"):
        say(box, "repair", robot=robot)
    say(box, "enter", CYAN)
    (question,) = published(box).questions
    assert (question.robots, question.default) == (["cyan2", "cyan4"], "cyan4")
    assert "cyan3 is on the field" in answer(box, "cyan3")
    assert answer(box, "cyan2") == ""
    assert list(away(box)) == ["cyan4"]


def test_a_repair_that_the_box_ends_in_play_is_over_at_the_next_stoppage(box: RefereeRig) -> None:
    say(box, "repair", robot="cyan4")
    while not box.state.running:
        say(box, "start")
    assert say(box, "enter", robot="cyan4") == ""
    assert "cyan4" in away(box)
    say(box, "stop")
    box.run(0.1)
    assert not away(box)


def test_an_answer_that_no_question_waits_for_is_refused(box: RefereeRig) -> None:
    assert "cyan is not asked" in answer(box, "cyan2")
    say(box, "yellow_card", CYAN)
    assert "magenta is not asked" in answer(box, "magenta2")
    assert "does not take part" in answer(box, "cyan9")
    assert len(published(box).questions) == 1


def test_several_questions_are_answered_in_their_order(box: RefereeRig) -> None:
    say(box, "repair", CYAN)
    say(box, "yellow_card", CYAN)
    assert answer(box, "cyan2") == "" and answer(box, "cyan3") == ""
    assert away(box) == {"cyan2": OffField.REPAIR} and cards(box) == [("cyan3", Card.YELLOW)]


def test_under_a_box_two_yellow_cards_suspend_no_robot_and_the_second_yellow_does(box: RefereeRig) -> None:
    for _ in range(3):
        say(box, "yellow_card", robot="cyan2")
    assert not away(box)
    say(box, "double_yellow", robot="cyan3")
    assert away(box) == {"cyan3": OffField.SECOND_YELLOW}
    assert rig_suspension(box) == box.book.discipline.suspension


def rig_suspension(rig: RefereeRig) -> float | None:
    return rig.state.participation.absences["cyan3"].left


def test_a_default_that_has_left_meanwhile_is_replaced(box: RefereeRig) -> None:
    say(box, "repair", CYAN)
    say(box, "red_card", robot="cyan5")
    box.run(10.1)
    assert away(box) == {"cyan5": OffField.RED_CARD, "cyan4": OffField.REPAIR}


def test_a_question_for_which_no_robot_is_left_is_closed_with_the_reason(box: RefereeRig) -> None:
    for robot in ("cyan2", "cyan4"):
        say(box, "repair", robot=robot)
    say(box, "enter", CYAN)
    for robot in ("cyan2", "cyan4"):
        say(box, "enter", robot=robot)
    box.run(10.1)
    event = next(event for event in box.events if event.text.startswith("no enter for cyan"))
    assert (event.rule, event.side, event.robot) == ("enter", CYAN, None)
    assert not published(box).questions


def test_a_question_ends_with_the_match(box: RefereeRig) -> None:
    say(box, "yellow_card", CYAN)
    say(box, "end_game")
    box.run(15.0)
    assert not published(box).questions and not cards(box)


def test_people_who_officiate_may_ask_a_side_too(box: RefereeRig) -> None:
    box.refbox = False
    (reply,) = box.ask("yellow_card", CYAN, source="coach").replies
    assert reply.accepted and len(published(box).questions) == 1


def test_an_undone_answer_is_asked_for_again(box: RefereeRig) -> None:
    say(box, "yellow_card", CYAN)
    answer(box, "cyan2")
    assert say(box, "undo") == ""
    assert not box.state.participation.cards and len(published(box).questions) == 1
