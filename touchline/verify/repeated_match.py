"""A recorded match played again from its commands, with sensors and referee, up to where it cannot be repeated.

A robot's sights follow from the match file, the commands, the orders, and the actions of people. Of the operators'
changes, parameters and resets are repeated. Others change the pitch by hand: the world would differ from then on.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

from recordings.reading.recording import Recording
from schemas.messages.applied import Applied
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command
from schemas.messages.parameters import ParameterOperation, ParametersRequest
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.side import Side
from schemas.topics import APPLIED, COMMAND, ORDER
from sim_host.match.simulation import Simulation, TickResult

Observe = Callable[[TickResult, Mapping[str, Command]], None]


def commands_of(recording: Recording) -> dict[str, dict[int, Command]]:
    """Robot → tick of the sight → the robot's command; of two for one sight the first, which the host applied."""
    commands: dict[str, dict[int, Command]] = {}
    for recorded, command in recording.decoded(COMMAND.fill()):
        commands.setdefault(recorded.key.split("/")[1], {}).setdefault(command.answers_tick, command)
    return commands


@dataclass
class RepeatedMatch:
    """Steps a simulation that is at tick 0 through a recorded match, while its world equals the recorded one."""

    recording: Recording
    simulation: Simulation
    """Of the recorded match file."""
    commands: Mapping[str, Mapping[int, Command]]
    """Robot → tick of the sight → the robot's command."""
    observe: Observe = field(default=lambda _tick, _commands: None)
    """Receives each tick after the first, with the commands that led to it."""
    until: str = field(default="", init=False)
    """Reason why the match ended before the recording; empty if it did not."""

    def ticks(self) -> Iterator[int]:
        """Yield each tick, from 0, when the simulation has reached it."""
        simulation = self.simulation
        orders = [(recorded.time, recorded.key, order) for recorded, order in self.recording.decoded(ORDER.fill())]
        for _, applied in self.recording.decoded(APPLIED.key):
            if applied.tick > 0:
                if applied.tick != simulation.now.tick + 1:
                    self.until = f"tick {simulation.now.tick + 1} is not in the recording"
                    return
                if applied.robots is not None or applied.obstacles is not None:
                    self.until = f"at tick {applied.tick} the pitch was changed manually"
                    return
                self._give_orders(orders)
                self._step(applied)
            if simulation.now.applied["chain"] != applied.chain:
                self.until = f"at tick {applied.tick} the world differs from the recorded one"
                return
            yield applied.tick

    def _step(self, applied: Applied) -> None:
        simulation, is_lockstep = self.simulation, self.simulation.config.speed is None
        values = {name: value for name, value in applied.parameters.items() if value is not None}
        if values:
            simulation.handle_parameters(ParametersRequest(operation=ParameterOperation.SET, values=values))
        names = [name for name in applied.parameters if name not in values]
        if names:
            simulation.handle_parameters(ParametersRequest(operation=ParameterOperation.RESET, names=names))
        if applied.remade and any(change.rule == SceneOperation.RESET for change in applied.changes):
            simulation.handle_scene(SceneRequest(operation=SceneOperation.RESET))
        commands = {}
        for name, applied_input in applied.inputs.items():
            answered = (
                applied_input.answers_tick
                if applied_input.answers_tick is not None or not is_lockstep
                else applied.tick - 1
            )
            command = self.commands.get(name, {}).get(answered) if answered is not None else None
            if command is not None:
                commands[name] = command
        tick = simulation.step(commands, applied.actions, silent=applied.silent, refbox=applied.refbox)
        self.observe(tick, commands)

    def _give_orders(self, orders: list[tuple[float, str, CoachOrder]]) -> None:
        simulation = self.simulation
        while orders and orders[0][0] <= simulation.now.time:
            _, key, order = orders.pop(0)
            side = Side(key.split("/")[1])
            if not order.refusal_after(simulation.orders.get(side)):
                simulation.orders[side] = order
