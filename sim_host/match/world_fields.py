"""The true state of one tick as the plain fields of `schemas.messages.world.World`."""

from typing import Any

from sim_host.game.judging import PlayState
from sim_host.snapshot import ObstacleState, Snapshot

Fields = dict[str, Any]
"""The fields of a message as plain values, as its model defines them."""


def world_fields(snapshot: Snapshot, stuck: list[bool], state: PlayState, episode: int, readings: Fields) -> Fields:
    """The whole message: the bodies, the fields that the game and the operator determine, and `Sights.readings`."""
    fields, away = bodies_fields(snapshot, stuck), state.absences
    for name, robot in fields["robots"].items():
        robot["off_field"] = away[name].why if name in away else None
    return {**fields, "clock": state.clock, "episode": episode, **readings}


def bodies_fields(snapshot: Snapshot, stuck: list[bool]) -> Fields:
    """The fields that the world alone determines: all but `clock`, `episode`, and each robot's `off_field`."""
    fields = {
        "tick": snapshot.tick,
        "time": snapshot.time,
        "robots": {
            name: {
                "x": robot.x,
                "y": robot.y,
                "z": robot.z,
                "heading": robot.heading,
                "vx": robot.vx,
                "vy": robot.vy,
                "omega": robot.omega,
                "holding": robot.holding,
                "stuck": is_stuck,
            }
            for name, robot, is_stuck in zip(snapshot.roster.names, snapshot.robots, stuck, strict=True)
        },
        "ball": snapshot.ball_state._asdict() if snapshot.ball_state is not None else None,
        "possession": snapshot.possession,
    }
    if snapshot.touches:
        fields["touches"] = list(snapshot.touches)
    if snapshot.level:
        fields["level"] = list(snapshot.level)
    if snapshot.kicked is not None:
        fields["kicked"] = snapshot.kicked
    if snapshot.obstacles:
        fields["obstacles"] = {obstacle.name: _obstacle_fields(obstacle) for obstacle in snapshot.obstacles}
    return fields


def _obstacle_fields(obstacle: ObstacleState) -> Fields:
    fields = obstacle._asdict()
    del fields["name"]
    if obstacle.pushed is None:
        del fields["pushed"]
    else:
        fields["pushed"] = obstacle.pushed._asdict()
    return fields
