"""Scene files: those that ship, and one line for what is wrong with another."""

from pathlib import Path

import pytest

from schemas.config.scene import Scene, load_scene, shipped_scenes
from schemas.errors import TouchlineError
from schemas.side import Side
from schemas.soccer.game import Phase

GOOD = """
description = "Two robots."
[[robots]]
name = "cyan1"
side = "cyan"
x = 0.0
y = 0.0
[[robots]]
name = "magenta1"
side = "magenta"
x = 3.0
y = 0.0
"""


def written(folder: Path, text: str) -> str:
    path = folder / "two.toml"
    path.write_text(text)
    return str(path)


@pytest.mark.parametrize("name", shipped_scenes())
def test_every_shipped_scene_is_valid_and_has_a_description(name: str) -> None:
    scene = load_scene(name)
    assert scene.name == name
    assert scene.description.endswith((".", "?"))


def test_the_papers_two_set_ups_are_among_them() -> None:
    """Section V of the paper: three robots and three static rivals; two moving sides; on the pitch of 18 × 12 m."""
    static, moving = load_scene("paper_static"), load_scene("paper_two_sides")
    for scene in (static, moving):
        assert scene.profile == "paper"
        assert [len(scene.of(side)) for side in Side] == [3, 3]
    assert [robot.agent for robot in static.of(Side.CYAN)] == [True] * 3
    assert [robot.agent for robot in static.of(Side.MAGENTA)] == [False] * 3
    assert all(robot.agent for robot in moving.robots)


def test_the_two_moving_sides_of_the_paper_see_the_same_turned_round() -> None:
    """Section V of the paper: the second side has its reference frame reversed."""
    cyan, magenta = (sorted(load_scene("paper_two_sides").of(side), key=lambda one: one.name) for side in Side)
    assert [(-one.x, -one.y) for one in magenta] == [(one.x, one.y) for one in cyan]


def test_what_a_file_leaves_out_is_play_with_the_ball_at_the_centre(tmp_path: Path) -> None:
    scene = load_scene(written(tmp_path, GOOD))
    assert (scene.name, scene.game.phase, scene.ball.x, scene.ball.z) == ("two", Phase.PLAY, 0.0, None)


WRONG = {
    "an end that is none": (GOOD + '[drill]\nseconds = 5\nsuccess = ["gaol:cyan"]\n', 'did you mean "goal"'),
    "an end of a robot that is none": (
        GOOD + '[drill]\nseconds = 5\nsuccess = ["goal:cyan9"]\n',
        '"goal:cyan9"; known: cyan, magenta,',
    ),
    "a match file": (GOOD + "[teams.cyan]\nsize = 1\n", "two.toml: a match file; give a scene"),
    "a drill without its time": (GOOD + '[drill]\nsuccess = ["goal"]\n', "drill.seconds is missing; simulated time"),
    "a drill of no time": (GOOD + "[drill]\nseconds = 0\n", "drill.seconds"),
    "a body that is none": (GOOD + '[[vary]]\nbody = "bal"\nx = 1\n', 'did you mean "ball"'),
    "a heading of the ball": (GOOD + '[[vary]]\nbody = "ball"\nheading = 1\n', "the ball has no heading"),
    "a key that is not known": ("descritpion = 1\n" + GOOD, 'descritpion is not known; did you mean "description"'),
    "a key of a robot": (GOOD + "hedaing = 1.0\n", 'robots.1.hedaing is not known; did you mean "heading"'),
    "no sentence": (GOOD.replace('description = "Two robots."', ""), "description is missing; one sentence"),
    "no place": (GOOD.replace("y = 0.0", "", 1), "robots.0.y is missing"),
    "a side that is none": (GOOD.replace('"magenta"', '"red"'), "robots.1.side is 'red'; write cyan or magenta"),
    "two of one name": (GOOD.replace('"magenta1"', '"cyan1"'), 'two bodies are named "cyan1"'),
    "a robot named ball": (GOOD.replace('"cyan1"', '"ball"'), 'a body is named "ball"'),
    "a phase that is none": (GOOD + '[game]\nphase = "paly"\n', "game.phase is 'paly'; one of pre_game, stopped"),
    "a phase without a beginning": (GOOD + '[game]\nphase = "half_time"\n', "no scene begins in the phase half_time"),
    "a restart of nobody": (GOOD + '[game]\nphase = "corner"\n', "corner belongs to a side; name cyan or magenta"),
    "a side in play": (GOOD + '[game]\nphase = "play"\nside = "cyan"\n', "play belongs to no side"),
    "a goal too many": (GOOD + "[game]\nscore = { cyan = -1 }\n", "game.score.cyan is -1"),
    "two goalkeepers": (
        GOOD.replace('side = "magenta"', 'side = "cyan"').replace("x = ", "keeper = true\nx = "),
        "cyan1 and magenta1 are goalkeepers of cyan",
    ),
    "an obstacle that is half one": (
        GOOD + '[[obstacles]]\nname = "wall"\nshape = "box"\nplace = [1.0, 1.0]\n',
        "a box has size",
    ),
    "no TOML": ("description = ", "not TOML"),
}


@pytest.mark.parametrize("text, said", WRONG.values(), ids=WRONG)
def test_a_wrong_file_is_reported_with_file_key_value_and_remedy(tmp_path: Path, text: str, said: str) -> None:
    path = written(tmp_path, text)
    with pytest.raises(TouchlineError) as error:
        load_scene(path)
    assert str(error.value).startswith(f"{path}: ")
    assert said in str(error.value)
    assert "\n" not in str(error.value)


def test_a_missing_scene_is_reported_with_the_existing_ones() -> None:
    with pytest.raises(TouchlineError, match=r'"penlty"; give a name, .*; did you mean "penalty"'):
        load_scene("penlty")
    with pytest.raises(TouchlineError, match=r"no\.toml"):
        load_scene("no.toml")


def test_a_scene_crosses_the_bus_as_it_stands_in_its_file() -> None:
    scene = load_scene("lob_practice")
    assert Scene.model_validate_json(scene.model_dump_json()) == scene
