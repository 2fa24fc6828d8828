"""What both ball-out rules say: over which line, where, last touched by whom, and how the game goes on."""

from schemas.game import EventKind, Phase
from schemas.side import Side
from sim_host.referee.decision import Decision
from sim_host.referee.scene import Crossing, Scene
from sim_host.referee.spots import restart_at
from sim_host.referee.wording import at, touched


def ball_out(scene: Scene, crossing: Crossing, phase: Phase, taker: Side | None) -> Decision:
    """The restart of `taker`, or a drop ball when nobody touched the ball since START."""
    robot = scene.state.last_touch
    place = (crossing.x, crossing.y)
    return Decision(
        kind=EventKind.BALL_OUT,
        text=f"ball out over the {crossing.line.value} at {at(place)}, {touched(robot)}",
        restart=restart_at(scene.match, scene.state, phase, taker, place),
        side=scene.match.roster.side_of(robot) if robot is not None else None,
        robot=robot,
        place=place,
    )
