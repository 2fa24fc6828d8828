"""What each service of simulation_interfaces does that is answered at once: all but steps."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from robot_agent.ros2.simulation.codes import Code, Feature, RefusedError, Scope, State
from robot_agent.ros2.simulation.entities import Entity, chosen, named, plane_pose
from robot_agent.ros2.simulation.match_client import MatchClient
from robot_agent.ros2.simulation.spawning import FORMAT, spawn_request
from runtime.ros2.message_builder import MessageBuilder
from schemas.frames import BALL, MAP
from schemas.messages.pace import PaceOperation
from schemas.messages.scene import SceneOperation
from schemas.messages.world import World

PACKAGE = "simulation_interfaces"
_ABOUT = "Touchline: changes take effect with the next tick, and simulated time is never reset"
_RESETS = "simulated time goes on after a reset, which also removes what was spawned: ask for the scope STATE | SPAWNED"

Fields = Mapping[str, Any]
"""Fields of a response; the others are zero or empty, and the result is `OK`."""
Handler = Callable[[Any], Fields]
"""Request → response. It raises `RefusedError` where it is not carried out."""


class SimulationServices:
    """Answers requests one after the other."""

    def __init__(self, match: MatchClient) -> None:
        self._match = match
        self._build = MessageBuilder()
        self._spawned: set[str] = set()
        """Bodies that nodes have spawned, and not deleted again."""
        self._reset_at: World | None = None
        """The newest world at the newest reset, which says nothing of the state of bodies after it."""
        self.handlers: Mapping[str, Handler] = {
            "GetSimulatorFeatures": self._features,
            "GetEntities": lambda asked: {"entities": [one.name for one in self._chosen(asked)]},
            "GetEntityState": lambda asked: {"state": self._state(named(match.entities(), asked.entity))},
            "GetEntitiesStates": self._states,
            "SetEntityState": self._set_state,
            "SpawnEntity": lambda asked: {"entity_name": self._spawn(asked)},
            "SpawnEntities": self._spawn_all,
            "DeleteEntity": self._delete,
            "ResetSimulation": self._reset,
            "GetSimulationState": self._simulation_state,
            "SetSimulationState": self._set_simulation_state,
        }
        """Service → what it does."""

    def result(self, code: Code = Code.OK, reason: str = "") -> Any:
        """A `Result`."""
        return self._build.make(f"{PACKAGE}/msg/Result", int(code), reason)

    def _features(self, _: Any) -> Fields:
        features = np.array(list(Feature), np.uint16)
        return {"features": self._build.make(f"{PACKAGE}/msg/SimulatorFeatures", features, [FORMAT], _ABOUT)}

    def _chosen(self, asked: Any) -> list[Entity]:
        return chosen(self._match.entities(), asked.filters)

    def _states(self, asked: Any) -> Fields:
        found = self._chosen(asked)
        return {"entities": [one.name for one in found], "states": [self._state(one) for one in found]}

    def _state(self, one: Entity) -> Any:
        """The state of a body; its accelerations are not known."""
        build, world = self._build, self._match.world()
        stamp = build.stamp(round(world.time * 1e9) if world is not None else 0)
        moves = build.pose(one.x, one.y, one.z, one.heading), build.twist(one.vx, one.vy, one.vz, one.omega)
        still = build.make("geometry_msgs/msg/Accel", build.vector(0.0, 0.0, 0.0), build.vector(0.0, 0.0, 0.0))
        return build.make(f"{PACKAGE}/msg/EntityState", build.header(stamp, MAP), *moves, still)

    def _set_state(self, asked: Any) -> Fields:
        """Set pose and velocity, or what the flags of 2.1 name; what is not set stays as it is."""
        one, state = named(self._match.coming(), asked.entity), asked.state
        if getattr(asked, "set_acceleration", False):
            raise RefusedError(Code.UNSUPPORTED, "accelerations follow from forces; they cannot be set")
        sets_pose, sets_twist = getattr(asked, "set_pose", True), getattr(asked, "set_twist", True)
        if self._match.world() is self._reset_at and not (sets_pose and sets_twist):
            raise RefusedError(Code.INCORRECT_STATE, "after a reset, set pose and velocity together, or step first")
        if sets_pose:
            x, y, heading = plane_pose(state.pose, state.header.frame_id, Code.INVALID_POSE)
            one = one._replace(x=x, y=y, z=state.pose.position.z, heading=heading)
        if sets_twist:
            speed, omega = state.twist.linear, state.twist.angular.z
            one = one._replace(vx=speed.x, vy=speed.y, vz=speed.z, omega=omega)
        place = {"body": one.name, "x": one.x, "y": one.y, "vx": one.vx, "vy": one.vy}
        if one.name == BALL:
            # lower ones are those of a ball on the ground
            place |= {"z": one.z if one.z > one.radius else None, "vz": one.vz}
        else:
            place |= {"heading": one.heading, "omega": one.omega}
        self._match.change({one.name: one}, operation=SceneOperation.PLACE, place=[place])
        return {}

    def _spawn(self, asked: Any) -> str:
        """Spawn a body; its name."""
        resource = getattr(asked, "entity_resource", asked)  # in 1.x the fields of the request itself
        one, request = spawn_request(asked, resource.uri, resource.resource_string, self._match.coming())
        self._match.change({one.name: one}, **request)
        self._spawned.add(one.name)
        return one.name

    def _spawn_all(self, asked: Any) -> Fields:
        results = []
        for one in asked.spawn_requests:
            try:
                name, result = self._spawn(one), self.result()
            except RefusedError as error:
                name, result = "", self.result(error.code, str(error))
            results.append(self._build.make(f"{PACKAGE}/msg/SpawnResult", result, name))
        failed = [one for one in results if one.result.result != Code.OK]
        if not failed:
            return {"results": results}
        reason = f"{len(failed)} of {len(results)} bodies were not spawned: {failed[0].result.error_message}"
        return {"results": results, "result": self.result(Code.SPAWN_FAILED, reason)}

    def _delete(self, asked: Any) -> Fields:
        name = asked.entity
        if name == BALL:
            raise RefusedError(Code.UNSUPPORTED, "the ball of a game cannot be deleted")
        named(self._match.coming(), name)
        self._match.change({name: None}, operation=SceneOperation.REMOVE, remove=[name])
        self._spawned.discard(name)
        return {}

    def _reset(self, asked: Any) -> Fields:
        """Go back to the start of the match; with the scope SPAWNED alone, remove what nodes have spawned."""
        scope = asked.scope
        if scope == Scope.SPAWNED:
            there = sorted(self._spawned & set(self._match.coming()))
            if there:
                self._match.change(dict.fromkeys(there), operation=SceneOperation.REMOVE, remove=there)
        elif scope in (Scope.STATE, Scope.STATE | Scope.SPAWNED):
            changed = self._match.entities() | dict.fromkeys(self._spawned)
            self._match.change(changed, operation=SceneOperation.RESET, to_match=True)
            self._reset_at = self._match.world()
        else:
            raise RefusedError(Code.UNSUPPORTED, f"scope is {scope}; {_RESETS}")
        self._spawned.clear()
        return {}

    def _simulation_state(self, _: Any) -> Fields:
        reply = self._match.pace(PaceOperation.SHOW)
        if not reply.accepted:
            raise RefusedError(Code.FAILED, reply.reason)
        state = State.PAUSED if reply.paused else State.PLAYING
        return {"state": self._build.make(f"{PACKAGE}/msg/SimulationState", int(state))}

    def _set_simulation_state(self, asked: Any) -> Fields:
        wanted = asked.state.state
        operations = {State.PLAYING: PaceOperation.RUN, State.PAUSED: PaceOperation.PAUSE}
        if wanted not in operations:
            raise RefusedError(Code.UNSUPPORTED, f"state is {wanted}; a match is set to 1 (playing) or 2 (paused)")
        before = self._match.pace(PaceOperation.SHOW)
        if before.accepted and before.paused is (wanted == State.PAUSED) and (before.until is None or before.paused):
            raise RefusedError(Code.ALREADY_IN_TARGET_STATE, "the match is in this state")
        reply = self._match.pace(operations[wanted])
        if not reply.accepted:
            raise RefusedError(Code.FAILED, reply.reason)
        return {}
