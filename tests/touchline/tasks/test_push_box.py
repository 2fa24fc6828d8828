"""The box of push_box: it is too heavy for two robots, and what it comes nearer to the dock is the score."""

import pytest
from pytest import approx

from schemas.messages.command import Command, Drive
from schemas.messages.sight import Sight
from support.task_moment import scored, task_config
from touchline.play.play_match import InProcessMatch


def test_the_score_is_the_way_that_the_box_has_come_nearer() -> None:
    first = scored("push_box", {}, moved={"box": (-1.5, 0.0)})
    later = scored("push_box", {}, moved={"box": (0.5, 0.0)}, memory=first.memory)
    lost = scored("push_box", {}, moved={"box": (-2.5, 0.0)}, memory=first.memory)
    assert (first.value, later.value, lost.value) == (0.0, approx(2.0), approx(-1.0))
    assert not later.over


def test_the_task_ends_when_the_middle_of_the_box_is_in_the_dock() -> None:
    assert scored("push_box", {}, moved={"box": (3.2, 0.1)}, memory=5.0).over


@pytest.mark.slow
def test_three_robots_move_the_box_and_two_do_not() -> None:
    assert pushed(["mover1", "mover3"]) < 0.2
    assert pushed(["mover1", "mover2", "mover3"]) > 1.0


def pushed(movers: list[str]) -> float:
    """m by which the box comes nearer in 4 s, when these robots drive ahead at its long side and the others stand."""
    config = task_config("push_box", duration=4.0)
    assert config.scene is not None
    places = {"mover1": -0.65, "mover2": 0.0, "mover3": 0.65}
    robots = [one.model_copy(update={"x": -2.3, "y": places[one.name]}) for one in config.scene.robots]
    scene = config.scene.model_copy(update={"robots": robots, "vary": []})
    brains = {name: Ahead(1.0 if name in movers else 0.0) for name in places}
    match = InProcessMatch(config.model_copy(update={"scene": scene}), brains)
    while not match.simulation.over:
        match.step()
    match.close()
    value: float = match.simulation.state.value
    return value


class Ahead:
    """Drives ahead."""

    def __init__(self, speed: float) -> None:
        """`speed` in m/s."""
        self.drive = Drive(vx=speed)

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick, drive=self.drive)
