"""Learning environments side by side with rSoccer's engine, dm_control's soccer, EnvPool's football and bare MuJoCo.

All do the same simulated time with random actions in one run, in turns, at the control period of the peer: one
decision of every robot a period. Ours twice: the environment, with sensors and their noise, radio, referee, and an
observation of every robot; and with all of these off, the world alone (drives, ball, collisions), whose states are the
truth, as rSoccer's engine has them. Figures are CPU time, so that other work on the machine matters little.

Peers are looked for in the interpreters given by `--python`, and in this one; what is missing is named.
"""

import argparse
import statistics
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path

import numpy as np
from bench_learn import environment
from learning_peers import MARK, PERIODS, SECONDS, cpu_time
from rich.console import Console
from rich.table import Table

from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from schemas.config.roster import Placement
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Drive
from schemas.side import Side
from sim_host.match.world import World
from sim_host.snapshot import Roster
from sim_host.soccer.game import ARENA
from touchline.learn import TaskEnv

SIZES = (1, 4, 10)
STEPS = {0.02: (4, 1), 0.025: (5, 1), 0.1: (4, 5)}
"""Control period → physics steps of 5 ms in a control tick, and control ticks."""
PROFILE = 'extends = "msl"\n[time]\nsteps_per_tick = {{ value = {}, unit = "1", origin = "a peer\'s period" }}\n'
TARGETS = {"rc-robosim": (5.0, 7.0), "dm_control": (30.0, None)}
"""Peer → how many times faster environment and world have to be with ten robots."""
MISSING = "No module named"
Round = Callable[[], float]
"""CPU time in s of a round."""


class Child:
    """A peer in a process of its own; `reason` says why it cannot play."""

    def __init__(self, pythons: list[str], peer: str, robots: int) -> None:
        self.reason, self.version = "", ""
        for python in pythons:
            self._process = subprocess.Popen(
                [python, str(Path(__file__).with_name("learning_peers.py")), peer, str(robots)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                text=True,
            )
            kind, _, text = self._answer().partition(" ")
            if kind == "version":
                self.reason, self.version = "", text
                return
            self.close()
            self.reason = text if not self.reason or MISSING in self.reason else self.reason

    def _answer(self) -> str:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            if line.startswith(MARK):
                return line.removeprefix(MARK).strip()
        return "no it ended"

    def round(self) -> float:
        """CPU time in s of a round."""
        assert self._process.stdin is not None
        self._process.stdin.write("\n")
        self._process.stdin.flush()
        return float(self._answer())

    def close(self) -> None:
        """End the process."""
        self._process.communicate()


def profile_file(folder: Path, steps: int) -> str:
    """The path of a profile with control ticks of as many physics steps."""
    file = folder / f"steps{steps}.toml"
    file.write_text(PROFILE.format(steps))
    return str(file)


def environment_round(folder: Path, robots: int, period: float) -> Round:
    """Rounds of the environment."""
    steps, ticks = STEPS[period]
    environment(folder, robots).close()
    task, overrides = str(folder / f"robots{robots}.toml"), {"profile": profile_file(folder, steps)}
    env = TaskEnv(task, parameters={"decision_ticks": ticks}, overrides=overrides)
    random = np.random.default_rng(1)

    def go() -> float:
        actions = [
            {agent: random.uniform(-0.4, 0.4, 6).astype(np.float32) for agent in env.possible_agents}
            for _ in range(round(SECONDS / period))
        ]
        return cpu_time(lambda: env.reset(1), env.step, actions)

    return go


def world_round(folder: Path, robots: int, period: float) -> Round:
    """Rounds of the world alone."""
    steps, ticks = STEPS[period]
    profile = load_profile(profile_file(folder, steps))
    names = tuple(f"r{place}" for place in range(robots))
    world = World(profile, Roster(names, (Side.CYAN,) * robots, {}, (RobotModel.standard(profile),) * robots), ARENA)
    spots = [Placement(body=name, x=-8 + 4 * (n % 5), y=-3 + 6 * (n // 5)) for n, name in enumerate(names)]
    random = np.random.default_rng(1)

    def begin() -> None:
        world.place([*spots, Placement(body="ball", x=0, y=0)])
        world.make_checkpoint()

    def decide(inputs: dict[str, AppliedInput]) -> None:
        for _ in range(ticks):
            world.advance(inputs)

    def go() -> float:
        drawn = [
            {
                name: AppliedInput(Drive(vx=vx, vy=vy, omega=2 * omega), dribble=True)
                for name, (vx, vy, omega) in zip(names, random.uniform(-1.6, 1.6, (robots, 3)).tolist(), strict=True)
            }
            for _ in range(round(SECONDS / period))
        ]
        return cpu_time(begin, decide, drawn)

    return go


def times(ratios: list[float], target: float | None) -> str:
    """Median and range of ratios, with the target where there is one."""
    text = f"{statistics.median(ratios):.2g} × ({min(ratios):.2g} to {max(ratios):.2g})"
    return text if target is None else f"{text}, target {target:g} ×"


def row(peer: str, robots: int, rounds: list[tuple[float, float, float]]) -> list[str]:
    """A row of the table from CPU times of environment, world and peer."""
    decisions = round(SECONDS / PERIODS[peer])
    rates = [f"{decisions / statistics.median(column):.0f}" for column in zip(*rounds, strict=True)]
    wanted = TARGETS.get(peer, (None, None)) if robots == SIZES[-1] else (None, None)
    env = times([theirs / ours for ours, _, theirs in rounds], wanted[0])
    world = times([theirs / ours for _, ours, theirs in rounds], wanted[1])
    return [f"{robots}", peer, f"{PERIODS[peer] * 1e3:g}", *rates, env, world]


def main() -> None:
    """Print the table, and what is missing."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--python", action="append", default=[], help="an interpreter that has peers installed")
    parser.add_argument("--rounds", type=int, default=9)
    args = parser.parse_args()
    heads = ("robots", "peer", "period ms", "environment/s", "world/s", "peer/s", "environment / peer", "world / peer")
    table, console, notes = Table(*heads, box=None), Console(width=150), defaultdict[str, list[str]](list)
    with tempfile.TemporaryDirectory() as folder:
        for robots in SIZES:
            for peer, period in PERIODS.items():
                child = Child([*args.python, sys.executable], peer, robots)
                notes[f"{peer} {child.version or 'does not play: ' + child.reason}"].append(str(robots))
                if child.reason:
                    continue
                where = Path(folder), robots, period
                turns = environment_round(*where), world_round(*where), child.round
                rounds = [(turns[0](), turns[1](), turns[2]()) for _ in range(args.rounds + 1)][1:]
                child.close()
                table.add_row(*row(peer, robots, rounds))
    console.print(table)
    console.print(f"decisions per s of CPU time, medians of {args.rounds} rounds of {SECONDS:g} s each; ratios: range")
    for note, sizes in sorted(notes.items()):
        console.print(f"{note} (robots: {', '.join(sizes)})", highlight=False)


if __name__ == "__main__":
    main()
