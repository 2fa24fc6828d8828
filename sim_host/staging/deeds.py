"""The deeds of an operator, one function each: (stage, request, what was begun with) → what it comes to."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import NamedTuple

from schemas.errors import TouchlineError, did_you_mean
from schemas.roster import Placement
from schemas.scene import Scene, SceneDeed, SceneRequest, load_scene
from sim_host.staging.stage import BALL, Rig, Stage, Staged, check, moved, opened, ordered


class Scenes(NamedTuple):
    """What can be gone back to."""

    start: Scene
    """The match's own start."""
    loaded: Scene
    """The scene loaded last, or the start."""


def do(stage: Stage, request: SceneRequest, scenes: Scenes, rig: Rig) -> tuple[Staged, Scenes]:
    """What a request comes to.

    Raises:
        TouchlineError: it cannot be done, and why.
    """
    return DEEDS[request.deed](stage, request, scenes, rig)


def _load(_stage: Stage, request: SceneRequest, scenes: Scenes, rig: Rig) -> tuple[Staged, Scenes]:
    if (request.load is None) == (request.scene is None):
        raise TouchlineError("load takes the name of a scene or the scene itself; give one of them")
    if request.load is not None and request.load.endswith(".toml"):
        raise TouchlineError(f'scene is "{request.load}"; the host reads no files: send what is in it')
    scene = request.scene or load_scene(str(request.load))
    staged = opened(scene, f"loads the scene {scene.name}")
    check(staged.stage, rig, staged.stage.names)
    return staged, scenes._replace(loaded=scene)


def _reset(_stage: Stage, request: SceneRequest, scenes: Scenes, _rig: Rig) -> tuple[Staged, Scenes]:
    if request.to_match:
        return opened(scenes.start, "goes back to the start of the match"), Scenes(scenes.start, scenes.start)
    return opened(scenes.loaded, f"goes back to the start of {scenes.loaded.name}"), scenes


def _place(stage: Stage, request: SceneRequest, scenes: Scenes, rig: Rig) -> tuple[Staged, Scenes]:
    if not request.place:
        raise TouchlineError("nothing is named to be placed; name a robot or the ball")
    movable = [*(entry.name for entry in stage.robots), BALL]
    for one in request.place:
        if one.body not in movable:
            raise TouchlineError(f"{one.body} is no robot and not the ball; {did_you_mean(one.body, movable)}")
        if one.body != BALL and (one.z is not None or one.vz):
            raise TouchlineError(f"{one.body} stands on the ground; z and vz are for the ball")
        if one.body == BALL and one.z is not None and one.z < rig.ball.radius:
            raise TouchlineError(f"the ball's centre would be {one.z:g} m high; its radius is {rig.ball.radius:g} m")
    after = moved(stage, request.place)
    check(after, rig, [one.body for one in request.place])
    where = ", ".join(_where(one) for one in request.place)
    return Staged(after, f"places {where}", list(request.place)), scenes


def _add(stage: Stage, request: SceneRequest, scenes: Scenes, rig: Rig) -> tuple[Staged, Scenes]:
    if not request.robots and not request.obstacles:
        raise TouchlineError("nothing is named to be added; name a robot or an obstacle")
    placements = [robot.placement for robot in request.robots]
    robots = ordered([*stage.robots, *(robot.entry for robot in request.robots)])
    after = replace(moved(stage, placements), robots=robots, obstacles=(*stage.obstacles, *request.obstacles))
    new = [*(robot.name for robot in request.robots), *(one.name for one in request.obstacles)]
    check(after, rig, new)
    return Staged(after, f"adds {', '.join(new)}", placements), scenes


def _remove(stage: Stage, request: SceneRequest, scenes: Scenes, rig: Rig) -> tuple[Staged, Scenes]:
    if not request.remove:
        raise TouchlineError("nothing is named to be removed; name a robot or an obstacle")
    known = [name for name in stage.names if name != BALL]
    for name in request.remove:
        if name not in known:
            raise TouchlineError(f"{name} is no robot and no obstacle; {did_you_mean(name, known)}")
    after = Stage(
        tuple(entry for entry in stage.robots if entry.name not in request.remove),
        tuple(one for one in stage.obstacles if one.name not in request.remove),
        {name: at for name, at in stage.at.items() if name not in request.remove},
    )
    check(after, rig, [])
    return Staged(after, f"removes {', '.join(request.remove)}"), scenes


def _where(one: Placement) -> str:
    name = "the ball" if one.body == BALL else one.body
    return f"{name} at ({one.x:.2f}, {one.y:.2f})"


DEEDS: Mapping[SceneDeed, Callable[[Stage, SceneRequest, Scenes, Rig], tuple[Staged, Scenes]]] = {
    SceneDeed.LOAD: _load,
    SceneDeed.PLACE: _place,
    SceneDeed.ADD: _add,
    SceneDeed.REMOVE: _remove,
    SceneDeed.RESET: _reset,
}
"""Deed → what it comes to."""
