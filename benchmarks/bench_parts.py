"""CPU time of each part of a host's tick with 10 to 100 robots, without a network.

Robots drive circles, spread over the pitch as in `bench_physics`, and send a radio message in every fifth tick. Raw is
the physics of the same steps in the loop of any PyBullet program. With the profile `msl`, a picture is taken in every
second tick.
"""

import argparse
import statistics
import time
from collections.abc import Callable
from typing import Any

from bench_physics import TickRig
from rich.console import Console
from rich.table import Table

from schemas.messages.applied import AppliedInput
from schemas.messages.command import Command, Drive
from schemas.messages.radio import BallBelief, Motion, Radio
from schemas.messages.record_batch import BatchEntry, RecordBatch
from schemas.wire.message import VERSION
from schemas.wire.part import encode
from sim_host.match.world_fields import world_fields

SIZES = (10, 22, 50, 100)
ROUNDS = 5
TICKS = 256
"""In a round; random numbers are drawn for as many ticks at once."""
BATCH_TICKS = 8
"""Ticks in a record batch."""


class Stopwatch:
    """Adds up the CPU time of parts; time in a part within another counts for the inner one alone."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._inner = [0.0]

    def timed(self, part: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """The function, whose calls count for this part."""
        self.seconds[part] = 0.0

        def call(*given: Any) -> Any:
            self._inner.append(0.0)
            began = time.thread_time()
            result = function(*given)
            spent = time.thread_time() - began
            self.seconds[part] += spent - self._inner.pop()
            self._inner[-1] += spent
            return result

        return call

    def watch(self, part: str, owner: Any, method: str) -> None:
        """Count the calls of a method of one object for this part."""
        setattr(owner, method, self.timed(part, getattr(owner, method)))


class PartsRig(TickRig):
    """A tick with the messages of a host and its robots."""

    def __init__(self, profile: str, count: int) -> None:
        super().__init__(profile, count)
        self.entries: list[BatchEntry] = []
        self.inputs = {
            name: AppliedInput(Drive(vx=0.4, omega=1.0), dribble=place == 0)
            for place, name in enumerate(self.roster.names)
        }
        self.content = Radio(self=Motion(x=1, y=2, heading=0.1), ball=BallBelief(x=1, y=2), role="striker")
        self.stopwatch = watch = Stopwatch()
        self.decode = watch.timed("commands: decode, validate", self._decode)
        self.send_radio = watch.timed("radio: send", self._send_radio)
        self.write_messages = watch.timed("messages: world, inputs", self._write_messages)
        self.record = watch.timed("record batch", self._record)
        self.step_raw_tick = watch.timed("raw", self._step_raw_tick)
        watch.watch("world: actuation, physics, contacts", self.world, "advance")
        watch.watch("hash chain", self.world, "chain")
        watch.watch("radio: receive", self.radio, "receive")
        watch.watch("referee", self.referee, "step")
        perceive = self.perception.at
        self.perception.at = watch.timed("own motion, percepts", lambda *given: iter(list(perceive(*given))))
        watch.watch("pictures", self.perception, "develop")
        watch.watch("sights: build, encode", self.sights, "at")

    def host_tick(self) -> None:
        """One tick of a host."""
        tick = self.snapshot.tick
        self.decode(
            [
                Command(
                    answers_tick=tick,
                    drive=Drive(vx=0.4, omega=1.0),
                    radio=self.content if (tick + place) % 5 == 0 else None,
                ).encode()
                for place in range(len(self.roster.names))
            ]
        )
        self.send_radio(tick)
        self.tick()
        self.record(self.write_messages())

    def _decode(self, payloads: list[bytes]) -> None:
        for payload in payloads:
            Command.decode(payload)

    def _send_radio(self, tick: int) -> None:
        senders = [name for place, name in enumerate(self.roster.names) if (tick + place) % 5 == 0]
        self.radio.send(tick, dict.fromkeys(senders, self.content))

    def _write_messages(self) -> list[bytes]:
        world = world_fields(self.snapshot, self.advance.stuck, self.state, 1, {})
        return [encode({"version": VERSION, **world}), encode(self.inputs)]

    def _record(self, payloads: list[bytes]) -> None:
        self.entries += [BatchEntry.of("host/world", payload) for payload in payloads]
        if self.snapshot.tick % BATCH_TICKS == 0:
            RecordBatch(
                stream=1, number=self.snapshot.tick, tick=self.snapshot.tick, sent_ns=1, entries=self.entries
            ).encode()
            self.entries = []

    def _step_raw_tick(self) -> None:
        for _ in range(self.profile.time.steps_per_tick):
            self.step_raw()


def measure(profile: str, count: int) -> tuple[dict[str, float], float]:
    """Median CPU time of each part in a tick, s; and the mean number of bodies that a robot sees."""
    rig = PartsRig(profile, count)
    rig.host_tick()
    rig.ready()
    rows, seen = [], 0
    for _ in range(ROUNDS):
        rig.stopwatch.seconds = dict.fromkeys(rig.stopwatch.seconds, 0.0)
        for _ in range(TICKS):
            rig.host_tick()
            rig.step_raw_tick()
        rows.append({part: spent / TICKS for part, spent in rig.stopwatch.seconds.items()})
        seen = sum(len(one.obstacles) for one in rig.perception.at(rig.snapshot, 1))
    rig.close()
    return {part: statistics.median(row[part] for row in rows) for part in rows[0]}, seen / count


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--profile", default="msl", help="the profile, by default msl")
    options = parser.parse_args()
    columns = [measure(options.profile, count) for count in SIZES]
    table = Table(title=f"CPU time in a tick of a host, us, profile {options.profile}", box=None)
    for name in ("part", *[f"{count} robots" for count in SIZES]):
        table.add_column(name, justify="left" if name == "part" else "right")
    parts = [part for part in columns[0][0] if part != "raw"]
    for part in sorted(parts, key=lambda part: -columns[-1][0][part]):
        table.add_row(part, *[f"{costs[part] * 1e6:.0f}" for costs, _ in columns])
    sums = [sum(costs[part] for part in parts) for costs, _ in columns]
    table.add_row("sum", *[f"{total * 1e6:.0f}" for total in sums])
    table.add_row("raw physics", *[f"{costs['raw'] * 1e6:.0f}" for costs, _ in columns])
    table.add_row(
        "sum / raw", *[f"{total / costs['raw']:.2f}" for total, (costs, _) in zip(sums, columns, strict=True)]
    )
    table.add_row("bodies that a robot sees", *[f"{seen:.1f}" for _, seen in columns])
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
