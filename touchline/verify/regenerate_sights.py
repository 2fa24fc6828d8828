"""Regenerates the sights of a match that were not recorded: simulates it again, with sensors and referee.

A robot's sights follow from the match file, the commands, the orders, and the actions of people. Manual changes of the
pitch are not repeated: later sights would differ from the original ones, so the iteration stops there.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from recordings.reading.recorded_config import config_of
from recordings.reading.recording import Recording
from schemas.errors import TouchlineError
from schemas.messages.applied import Applied
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command
from schemas.messages.parameters import ParameterOperation, ParametersRequest
from schemas.messages.sight import Sight
from schemas.side import Side
from schemas.topics import APPLIED, ORDER
from sim_host.match.simulation import Simulation
from touchline.verify.resim_start import need_scene


@dataclass
class RegeneratedSights:
    """Simulates a recorded match again and yields one robot's sights, while the world equals the recorded one."""

    recording: Recording
    robot: str
    commands: Mapping[str, Mapping[int, Command]]
    """Robot → tick of the sight → the robot's command."""
    until: str = field(default="", init=False)
    """Reason why the sights ended before the recording; empty if they did not."""

    def __iter__(self) -> Iterator[Sight]:
        """Yield the sights in order.

        Raises:
            TouchlineError: the recording lacks its match file or its scene, or does not begin at tick 0.
        """
        config = config_of(self.recording)
        if config is None:
            raise TouchlineError(
                f"{self.recording.path}: it has neither sights nor its match file; record with touchline match --sights"
            )
        need_scene(self.recording)
        simulation = Simulation(config)
        try:
            yield from self._sights(simulation, config.speed is None)
        finally:
            simulation.close()

    def _sights(self, simulation: Simulation, lockstep: bool) -> Iterator[Sight]:
        orders = [(recorded.time, recorded.key, order) for recorded, order in self.recording.decoded(ORDER.fill())]
        for _, applied in self.recording.decoded(APPLIED.key):
            if applied.tick > 0:
                if applied.tick != simulation.now.tick + 1:
                    self.until = f"tick {simulation.now.tick + 1} is not in the recording"
                    return
                if applied.robots is not None or applied.obstacles is not None:
                    self.until = f"at tick {applied.tick} the pitch was changed manually"
                    return
                self._give_orders(simulation, orders)
                self._step(simulation, applied, lockstep)
            if simulation.now.applied["chain"] != applied.chain:
                self.until = f"at tick {applied.tick} the world differs from the recorded one"
                return
            if self.robot in simulation.now.sights:
                yield Sight.decode(simulation.now.sights[self.robot])

    def _step(self, simulation: Simulation, applied: Applied, lockstep: bool) -> None:
        values = {name: value for name, value in applied.parameters.items() if value is not None}
        if values:
            simulation.handle_parameters(ParametersRequest(operation=ParameterOperation.SET, values=values))
        names = [name for name in applied.parameters if name not in values]
        if names:
            simulation.handle_parameters(ParametersRequest(operation=ParameterOperation.RESET, names=names))
        commands = {}
        for name, applied_input in applied.inputs.items():
            answered = (
                applied_input.answers_tick
                if applied_input.answers_tick is not None or not lockstep
                else applied.tick - 1
            )
            command = self.commands.get(name, {}).get(answered) if answered is not None else None
            if command is not None:
                commands[name] = command
        simulation.step(commands, applied.actions, silent=applied.silent)

    def _give_orders(self, simulation: Simulation, orders: list[tuple[float, str, CoachOrder]]) -> None:
        while orders and orders[0][0] <= simulation.now.time:
            _, key, order = orders.pop(0)
            side = Side(key.split("/")[1])
            if not order.refusal_after(simulation.orders.get(side)):
                simulation.orders[side] = order
