"""A study of four matches of one robot a side that last a second and a half."""

from typing import TYPE_CHECKING, Protocol

from support.brisk import BRISK

if TYPE_CHECKING:
    from touchline.matches.study.run_study import StudyResult

SHORT = f"""
seeds = "1-2"
both_sides = false
responses = ["possession_s.difference", "distance"]
[settings]
duration = 1.5
rules = "{BRISK}"
teams.cyan.size = 1
teams.magenta.size = 1
[factors]
radio.loss = [0, 0.4]
"""
ONE_CELL = SHORT.replace("[factors]\nradio.loss = [0, 0.4]\n", "")
"""Two of these matches."""


class Run(Protocol):
    """Plays the study of a text, and adds the labels of the matches that were played to a list."""

    def __call__(self, text: str, played: list[str] | None = None, *, fresh: bool = False) -> "StudyResult": ...
