"""Lines on the state of a match."""

from coach_gateway.match.lines import discipline_phrases
from schemas.messages.soccer.game import DisciplinaryRecord, GameState
from schemas.soccer.game import OffField, Phase


def test_a_robot_has_a_phrase_for_the_cards_that_it_has_and_for_why_it_is_off_the_field() -> None:
    robots = {
        "cyan1": DisciplinaryRecord(),
        "cyan2": DisciplinaryRecord(yellow=1),
        "cyan3": DisciplinaryRecord(yellow=2, red=1, off_field=OffField.RED_CARD),
        "magenta1": DisciplinaryRecord(off_field=OffField.REPAIR, left=12.3),
    }
    state = GameState(tick=0, time=0.0, phase=Phase.PLAY, robots=robots)
    assert discipline_phrases(state) == [
        "cyan2 1 yellow",
        "cyan3 2 yellow, 1 red, off: red card",
        "magenta1 off: repair 12 s",
    ]
