"""The referee treats both sides alike: the same story with colours swapped and the field turned is decided the same."""

import pytest

from schemas.side import Side
from schemas.soccer.game import EventKind

STORIES = {
    "goal": [((0.98, 0.1), ["cyan2"]), ((1.02, 0.1), [])],
    "own goal": [((-0.98, 0.1), ["cyan2"]), ((-1.02, 0.1), [])],
    "throw-in": [((0.3, 0.97), ["magenta2"]), ((0.32, 1.05), [])],
    "corner": [((0.98, 0.6), ["magenta4"]), ((1.02, 0.6), [])],
    "goal kick": [((-0.98, -0.2), ["magenta4"]), ((-1.02, -0.25), [])],
    "goal kick, level with the goal": [((-0.98, -0.3), ["magenta4"]), ((-1.02, -0.3), [])],
    "goal kick, between two markers": [((-0.98, -0.25), ["magenta4"]), ((-1.02, -0.25), [])],
    "drop ball": [((0.9, 0.1), []), ((1.02, 0.4), [])],
    "lost": [((0.2, 0.1, 0.1), []), ((0.2, 0.1, -3.0), [])],
}
"""Places as shares of the goal line's x and the touch line's y, with those who touch the ball."""


@pytest.mark.parametrize("profile", ["msl", "paper"])
@pytest.mark.parametrize("story", STORIES.values(), ids=STORIES.keys())
def test_a_mirrored_story_has_mirrored_decisions(new_rig, profile, story):
    told = [tell(new_rig(profile, duration=40.0, dt=0.1, mirrored=mirrored), story) for mirrored in (False, True)]
    assert told[0] == told[1] and len(told[0]) > 8


SET_PIECES = {
    "double touch": [(0.0, ["cyan2"], "cyan2"), (0.2, [], None), (0.2, [], None), (0.3, ["cyan2"], None)],
    "early touch of a mate": [(0.0, ["cyan2"], "cyan2"), (0.3, ["cyan3"], None)],
    "early touch of an opponent": [(0.0, ["cyan2"], "cyan2"), (0.3, ["magenta3"], None)],
    "dragged": [(0.4, ["cyan2"], None)],
}
"""Way of the ball from its spot in m, who touches it, and who kicks."""


@pytest.mark.parametrize("name", ["free_kick", "throw_in", "corner", "penalty"])
@pytest.mark.parametrize("story", SET_PIECES.values(), ids=SET_PIECES.keys())
def test_a_mirrored_set_piece_has_mirrored_decisions(new_rig, name, story):
    told = []
    for mirrored in (False, True):
        rig = new_rig("msl", duration=60.0, dt=0.1, mirrored=mirrored)
        rig.playing()
        rig.ask(name, Side.CYAN)
        rig.robots["magenta4"] = (2.0, 2.0)
        rig.until(lambda state: state.running)
        x, y = rig.ball[:2]
        for way, touches, kicker in story:
            rig.tick((x - way, y), touches, kicked=kicker)
        rig.ask("yellow_card", robot=rig.robot("cyan3"))
        rig.ask("red_card", robot=rig.robot("magenta5"))
        rig.run(20.0)
        told.append(([rig.unmirrored(event) for event in rig.events], rig.robots))
    assert told[0][0] == told[1][0] and any(event[1] is EventKind.FOUL for event in told[0][0])
    for robot, place in told[0][1].items():
        assert told[1][1][robot] == pytest.approx(place)


def tell(rig, story):
    """Every event of the story to the end of the match, as cyan of the story that is not mirrored would tell it."""
    rig.playing((1.0, 0.0), [])
    for (share_x, share_y, *height), touches in story:
        rig.tick((share_x * rig.pitch.goal_line, share_y * rig.pitch.touch_line, *height), touches)
    for _ in range(1500):
        rig.tick()
    return [rig.unmirrored(event) for event in rig.events]
