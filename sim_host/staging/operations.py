"""The operations on the layout, one function each: (layout, request, scenes, specs) → (change, scenes)."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import NamedTuple

from schemas.config.roster import Placement
from schemas.config.scene import MAX_HEIGHT, MAX_SPEED, Scene, load_scene
from schemas.errors import TouchlineError, did_you_mean
from schemas.messages.scene import SceneOperation, SceneRequest
from sim_host.snapshot import BALL
from sim_host.staging.layout import (
    Layout,
    LayoutChange,
    Specs,
    check_layout,
    in_roster_order,
    scene_layout,
    with_placements,
)


class ResetScenes(NamedTuple):
    """The scenes that a reset can return to."""

    start: Scene
    """The start of the match."""
    loaded: Scene
    """The scene loaded last, or the start."""


def apply_request(
    layout: Layout, request: SceneRequest, scenes: ResetScenes, specs: Specs
) -> tuple[LayoutChange, ResetScenes]:
    """The change that a request asks for, and the scenes for later resets.

    Raises:
        TouchlineError: the request is impossible, with the reason.
    """
    return OPERATIONS[request.operation](layout, request, scenes, specs)


def _load(
    _layout: Layout, request: SceneRequest, scenes: ResetScenes, specs: Specs
) -> tuple[LayoutChange, ResetScenes]:
    if (request.load is None) == (request.scene is None):
        raise TouchlineError("load takes the name of a scene or the scene itself; give one of them")
    if request.load is not None and request.load.endswith(".toml"):
        raise TouchlineError(f'scene is "{request.load}"; the host reads no files: send the scene itself')
    scene = request.scene or load_scene(str(request.load))
    change = scene_layout(scene, specs.furniture, f"loads the scene {scene.name}")
    check_layout(change.layout, specs, change.layout.names)
    return change, scenes._replace(loaded=scene)


def _reset(
    _layout: Layout, request: SceneRequest, scenes: ResetScenes, specs: Specs
) -> tuple[LayoutChange, ResetScenes]:
    if request.to_match:
        scenes, back = ResetScenes(scenes.start, scenes.start), "the start of the match"
    else:
        back = f"the start of {scenes.loaded.name}"
    return scene_layout(scenes.loaded, specs.furniture, f"goes back to {back}"), scenes


def _place(
    layout: Layout, request: SceneRequest, scenes: ResetScenes, specs: Specs
) -> tuple[LayoutChange, ResetScenes]:
    if not request.place:
        raise TouchlineError("no body to place is named; name a robot or the ball")
    movable = layout.movable
    other = "the ball" if BALL in movable else "an obstacle that can be pushed"
    for one in request.place:
        if one.body not in movable:
            raise TouchlineError(f"{one.body} is neither a robot nor {other}; {did_you_mean(one.body, movable)}")
        if one.body != BALL and (one.z is not None or one.vz):
            raise TouchlineError(f"{one.body} stands on the ground; z and vz are for the ball")
        if max(map(abs, (one.vx, one.vy, one.vz, one.omega))) > MAX_SPEED or (one.z or 0.0) > MAX_HEIGHT:
            raise TouchlineError(
                f"{one.body}: at most {MAX_SPEED:g} m/s or rad/s in each direction, and {MAX_HEIGHT:g} m high"
            )
        if one.body == BALL and one.z is not None and one.z < specs.ball.radius:
            raise TouchlineError(f"the ball's centre would be {one.z:g} m high; its radius is {specs.ball.radius:g} m")
    after = with_placements(layout, request.place)
    check_layout(after, specs, [one.body for one in request.place])
    where = ", ".join(_where(one) for one in request.place)
    return LayoutChange(after, f"places {where}", list(request.place)), scenes


def _add(layout: Layout, request: SceneRequest, scenes: ResetScenes, specs: Specs) -> tuple[LayoutChange, ResetScenes]:
    if not request.robots and not request.obstacles:
        raise TouchlineError("no body to add is named; name a robot or an obstacle")
    placements = [robot.placement for robot in request.robots]
    placements += [one.placement for one in request.obstacles if one.mass is not None]
    robots = in_roster_order([*layout.robots, *(robot.entry for robot in request.robots)])
    after = replace(
        with_placements(layout, placements), robots=robots, obstacles=(*layout.obstacles, *request.obstacles)
    )
    new = [*(robot.name for robot in request.robots), *(one.name for one in request.obstacles)]
    check_layout(after, specs, new)
    return LayoutChange(after, f"adds {', '.join(new)}", placements), scenes


def _remove(
    layout: Layout, request: SceneRequest, scenes: ResetScenes, specs: Specs
) -> tuple[LayoutChange, ResetScenes]:
    if not request.remove:
        raise TouchlineError("no body to remove is named; name a robot or an obstacle")
    known = [name for name in layout.names if name != BALL]
    for name in request.remove:
        if name not in known:
            raise TouchlineError(f"{name} is neither a robot nor an obstacle; {did_you_mean(name, known)}")
    after = Layout(
        tuple(entry for entry in layout.robots if entry.name not in request.remove),
        tuple(one for one in layout.obstacles if one.name not in request.remove),
        {name: at for name, at in layout.at.items() if name not in request.remove},
    )
    check_layout(after, specs, [])
    return LayoutChange(after, f"removes {', '.join(request.remove)}"), scenes


def _where(one: Placement) -> str:
    name = "the ball" if one.body == BALL else one.body
    return f"{name} at ({one.x:.2f}, {one.y:.2f})"


OPERATIONS: Mapping[
    SceneOperation, Callable[[Layout, SceneRequest, ResetScenes, Specs], tuple[LayoutChange, ResetScenes]]
] = {
    SceneOperation.LOAD: _load,
    SceneOperation.PLACE: _place,
    SceneOperation.ADD: _add,
    SceneOperation.REMOVE: _remove,
    SceneOperation.RESET: _reset,
}
"""Operation → its function."""
