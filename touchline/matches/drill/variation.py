"""The start of a drill, which differs from seed to seed."""

from random import Random
from typing import TypeVar

from schemas.config.scene import Scene, SceneBall, SceneRobot
from schemas.config.soccer.drill import Variation

Body = TypeVar("Body", SceneBall, SceneRobot)


def varied(scene: Scene, seed: int) -> Scene:
    """The scene as it starts with this seed: equal seeds give equal starts."""
    random = Random(f"{seed}")
    for variation in scene.vary:
        shifts = {
            name: random.uniform(-width, width)
            for name in Variation.model_fields
            if name != "body" and (width := getattr(variation, name))
        }
        scene = _shifted(scene, variation.body, shifts)
    return scene


def _shifted(scene: Scene, body: str, shifts: dict[str, float]) -> Scene:
    if body == "ball":
        return scene.model_copy(update={"ball": _moved(scene.ball, shifts)})
    robots = [_moved(robot, shifts) if robot.name == body else robot for robot in scene.robots]
    return scene.model_copy(update={"robots": robots})


def _moved(body: Body, shifts: dict[str, float]) -> Body:
    changed = {name: getattr(body, name) + shift for name, shift in shifts.items()}
    return body.model_copy(update=changed)
