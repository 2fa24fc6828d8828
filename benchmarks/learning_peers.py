"""A peer of `bench_learn_peers.py` in a process of its own: `python learning_peers.py PEER ROBOTS`.

It prints a line with the peer's version or why it cannot play, and then, for each line that it reads, the CPU time in s
of `SECONDS` of simulated time. It needs nothing of Touchline, so that any Python that has the peer can run it.
"""

import random
import sys
import time
from collections.abc import Callable, Iterator
from importlib import import_module
from importlib.metadata import version
from typing import Any

SECONDS = 5.0
"""Simulated time of a round."""
MARK = "learning-peer:"
"""Before each line that is meant for the reader; peers print lines of their own."""
Peer = tuple[Callable[[], Any], Callable[[Any], Any]]
"""Begin a round anew, and make one decision with what `actions` has drawn."""


def rc_robosim(robots: int) -> tuple[Peer, Iterator[Any]]:
    """The engine of rSoccer: omnidirectional robots of the small-size league and a ball, ODE, steps of 4 ms."""
    blue = (robots + 1) // 2
    home = [[-0.8 * (place + 1), 1.0, 0.0] for place in range(blue)]
    away = [[0.8 * (place + 1), -1.0, 180.0] for place in range(robots - blue)]
    start = [0.0, 0.0, 0.0, 0.0], home, away
    game = import_module("robosim").SSL(0, blue, robots - blue, 20, *start)

    def decide(actions: Any) -> None:
        game.step(actions)
        game.get_state()

    draw = random.Random(1).uniform
    drives = ([[0, draw(-1, 1), draw(-1, 1), draw(-3, 3), 0, 0, 0, 1] for _ in range(robots)] for _ in iter(int, 1))
    return (lambda: game.reset(*start), decide), drives


def dm_control(robots: int) -> tuple[Peer, Iterator[Any]]:
    """Its soccer with box-shaped players, MuJoCo, steps of 5 ms; observations of every player, as it makes them."""
    if robots % 2:
        raise ValueError("its teams have equal sizes")
    soccer = import_module("dm_control.locomotion.soccer")
    walker = soccer.WalkerType.BOXHEAD
    game = soccer.load(team_size=robots // 2, time_limit=1e6, random_state=1, walker_type=walker)
    sizes = [spec.shape[0] for spec in game.action_spec()]
    draw = random.Random(1).uniform
    actions = ([[draw(-1, 1) for _ in range(size)] for size in sizes] for _ in iter(int, 1))
    return (game.reset, game.step), actions


def envpool(robots: int) -> tuple[Peer, Iterator[Any]]:
    """Google Research Football in EnvPool: one player is controlled and sees a small map, the game plays the others."""
    if robots != 10:
        raise ValueError("its game is five against five")
    numpy = import_module("numpy")
    game = import_module("envpool").make("gfootball/5_vs_5-v1", env_type="gymnasium", num_envs=1, seed=1)
    draw = random.Random(1).randrange
    return (game.reset, game.step), (numpy.array([draw(game.action_space.n)]) for _ in iter(int, 1))


def mujoco(robots: int) -> tuple[Peer, Iterator[Any]]:
    """MuJoCo alone: cylinders that slide and turn, a ball on a plane; velocities are set, then four steps of 5 ms."""
    engine = import_module("mujoco")
    joints = '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><joint axis="0 0 1"/>'
    hull = '<geom type="cylinder" size="0.245 0.4" mass="39"/>'
    spots = [(-8 + 4 * (place % 5), -3 + 6 * (place // 5)) for place in range(robots)]
    bodies = "".join(f'<body pos="{x} {y} 0.41">{joints}{hull}</body>' for x, y in spots)
    ball = '<body pos="0 0 0.11"><freejoint/><geom type="sphere" size="0.11" mass="0.41"/></body>'
    plane = '<geom type="plane" size="20 20 1"/>'
    model = engine.MjModel.from_xml_string(
        f'<mujoco><option timestep="0.005"/><worldbody>{plane}{bodies}{ball}</worldbody></mujoco>'
    )
    data = engine.MjData(model)

    def decide(velocities: Any) -> None:
        data.qvel[: 3 * robots] = velocities
        engine.mj_step(model, data, nstep=4)

    draw = random.Random(1).uniform
    drives = ([draw(-1, 1) for _ in range(3 * robots)] for _ in iter(int, 1))
    return (lambda: engine.mj_resetData(model, data), decide), drives


PEERS = {"rc-robosim": rc_robosim, "dm_control": dm_control, "envpool": envpool, "mujoco": mujoco}
"""By the names of their packages."""
PERIODS = {"rc-robosim": 0.02, "dm_control": 0.025, "envpool": 0.1, "mujoco": 0.02}
"""s; control periods: what rSoccer, dm_control's soccer and Google Research Football have; ours for MuJoCo."""


def cpu_time(begin: Callable[[], Any], decide: Callable[[Any], Any], drawn: list[Any]) -> float:
    """CPU time of all threads in s of these decisions, from a fresh beginning."""
    begin()
    began = time.process_time()
    for actions in drawn:
        decide(actions)
    return time.process_time() - began


def main() -> None:
    """Serve one peer."""
    name, robots = sys.argv[1], int(sys.argv[2])
    try:
        (begin, decide), actions = PEERS[name](robots)
        print(MARK, "version", version(name), flush=True)
    except Exception as error:  # whatever a peer raises where it is not installed whole is its reason
        print(MARK, "no", f"{error}".partition("\n")[0] or type(error).__name__, flush=True)
        return
    for _ in sys.stdin:
        drawn = [next(actions) for _ in range(round(SECONDS / PERIODS[name]))]
        print(MARK, cpu_time(begin, decide, drawn), flush=True)


if __name__ == "__main__":
    main()
