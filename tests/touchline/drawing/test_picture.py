"""Pictures of a match, as environments show them."""

from schemas.config.task import Zone
from schemas.messages.setup import TaskSetup
from support.messages import make_setup, make_world
from touchline.drawing.picture import drawn


def test_zones_of_a_task_are_drawn_on_the_pitch_of_soccer() -> None:
    setup = make_setup()
    square = Zone(name="square", place=[1.0, 2.0], size=[4.0, 3.0])
    _, plain, _ = drawn(setup, [make_world(1)], 4.0)
    _, axes, _ = drawn(setup.replace(task=TaskSetup(score="a:b", zones=[square])), [make_world(1)], 4.0)
    assert [(text.get_text(), text.get_position()) for text in axes.texts if text.get_text() == "square"] == [
        ("square", (1.0, 2.0))
    ]
    assert len(axes.patches) == len(plain.patches) + 1
