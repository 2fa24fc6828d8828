"""The start of a scene, which differs from seed to seed as its `vary` allows."""

from random import Random
from typing import TypeVar

from schemas.config.obstacle import ObstacleConfig
from schemas.config.scene import Scene, SceneBall, SceneRobot
from schemas.config.soccer.drill import Variation

Body = TypeVar("Body", SceneBall, SceneRobot)


def varied(scene: Scene, seed: int, attempt: int = 0) -> Scene:
    """The scene as it starts with this seed: equal seeds give equal starts.

    `attempt` counts the starts of a seed that could not be used, because bodies overlapped.
    """
    random = Random(f"{seed}/{attempt}" if attempt else f"{seed}")
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
    obstacles = [_moved_obstacle(one, shifts) if one.name == body else one for one in scene.obstacles]
    return scene.model_copy(update={"robots": robots, "obstacles": obstacles})


def _moved(body: Body, shifts: dict[str, float]) -> Body:
    changed = {name: getattr(body, name) + shift for name, shift in shifts.items()}
    return body.model_copy(update=changed)


def _moved_obstacle(obstacle: ObstacleConfig, shifts: dict[str, float]) -> ObstacleConfig:
    (x, y), turn = obstacle.place, shifts.get("heading", 0.0)
    place = [x + shifts.get("x", 0.0), y + shifts.get("y", 0.0)]
    return obstacle.model_copy(update={"place": place, "heading": obstacle.heading + turn})
