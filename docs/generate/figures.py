"""Writes measured figures into docs/simplified.md: `python docs/generate/figures.py`.

A figure stands in a page between `<!--=NAME-->` and `<!--/-->`. Each is measured in a run of profile `msl`, or of the
profile that its function names; none is computed from a formula.
"""

import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np

import physics_runs as runs
from schemas.config.profile import load_profile
from schemas.messages.command import Kick, KickMode
from schemas.messages.radio import BallBelief, Motion, Radio
from schemas.side import Side
from sim_host.match.radio import RadioAir
from sim_host.sensing.perception import Perception
from sim_host.sensing.random_streams import RandomStreams
from sim_host.snapshot import Roster

PAGE = Path(__file__).parents[1] / "simplified.md"
_FIGURE = re.compile(r"<!--=(\w+)-->.*?<!--/-->", re.DOTALL)
_ROBOTS = tuple(f"{side.value}{number}" for side in Side for number in range(1, 6))
_SELF = Motion(x=-3.512, y=2.218, heading=0.713, vx=1.204, vy=-0.385, omega=0.52)
_BALL = BallBelief(x=1.265, y=-0.542, vx=0.31, vy=-0.12, age=0.04)


def top_speed() -> str:
    """Top speed of a run straight ahead."""
    run = runs.play(load_profile("msl"), {"cyan1": (-9.0, 0.0, 0.0)}, lambda _: {"cyan1": runs.told(9.0)}, 3.0)
    return f"{run.robot('cyan1', 'vx').max():.1f} m/s"


@cache
def _step() -> tuple[float, float]:
    """Seconds from rest to 3 m/s, and metres from there to rest."""
    run = runs.step_response("msl")
    x, speed = run.robot("cyan1", "x", "vx").T
    began = int(np.argmax(run.times >= 2.0))
    return float(run.times[np.argmax(speed > 2.99)]), float(x[-1] - x[began])


def time_to_three() -> str:
    """Time from rest to 3 m/s."""
    return f"{_step()[0]:.1f} s"


def stopping_distance() -> str:
    """Distance from 3 m/s to rest."""
    return f"{_step()[1]:.1f} m"


def _sideways(profile: str) -> str:
    """Acceleration of a robot that is told to drive at 4 m/s and to turn at 8 rad/s."""
    told = {"cyan1": runs.told(4.0, omega=8.0)}
    run = runs.play(load_profile(profile), {"cyan1": (0.0, 0.0, 0.0), "ball": (0.0, 6.0, 0.0)}, lambda _: told, 4.0)
    velocity = run.robot("cyan1", "vx", "vy")[-50:]
    change = np.linalg.norm(np.diff(velocity, axis=0), axis=1) / load_profile(profile).time.tick
    return f"{change.mean():.0f} m/s²"


def pirouette() -> str:
    """Sideways acceleration with the drive of profile `msl`."""
    return _sideways("msl")


def pirouette_ideal() -> str:
    """Sideways acceleration with the drive of profile `ideal`."""
    return _sideways("ideal")


def pirouette_omni() -> str:
    """Sideways acceleration on wheels."""
    return _sideways("omni")


def _push(profile: str) -> str:
    """How far a robot that is told to stand is moved by one that runs into it at 2 m/s and pushes on, in 3 s."""
    loaded = load_profile(profile)
    r = loaded.robot.radius
    bodies = {"cyan1": (-2 * r - 0.8, 0.0, 0.0), "magenta1": (0.0, 0.0, 0.0), "ball": (0.0, 6.0, 0.0)}
    run = runs.play(loaded, bodies, lambda _: {"cyan1": runs.told(4.0)}, 3.8)
    return f"{run.robot('magenta1', 'x')[-1, 0]:.1f} m"


def push() -> str:
    """Pushing in profile `msl`."""
    return _push("msl")


def push_ideal() -> str:
    """Pushing in profile `ideal`."""
    return _push("ideal")


def push_omni() -> str:
    """Pushing on wheels."""
    return _push("omni")


def _speed_after(profile: str, distance: float) -> float:
    """Speed of a ball that was kicked at 10 m/s, after this distance."""
    loaded = load_profile(profile)
    start = -9.0
    bodies = {"cyan1": (start - loaded.dribble.gap, 0.0, 0.0), "ball": (start, 0.0, 0.0)}
    kick = {"cyan1": runs.told(kick=Kick(mode=KickMode.GROUND, speed=10.0))}
    run = runs.play(loaded, bodies, runs.at_first(kick), 5.0)
    x, speed = run.ball("x", "vx").T
    return float(speed[np.argmax(x > start + distance)])


def rolling() -> str:
    """A kick of 10 m/s after 15 m."""
    return f"{_speed_after('msl', 15.0):.1f} m/s"


def rolling_ideal() -> str:
    """The same without air."""
    return f"{_speed_after('ideal', 15.0):.1f} m/s"


def kick_scatter() -> str:
    """Spread of the direction of ten equal kicks."""
    loaded = load_profile("msl")
    ends = []
    for number in range(10):
        y = -4.0 + 0.8 * number
        bodies = {"cyan1": (0.0, y, 0.0), "ball": (loaded.dribble.gap, y, 0.0)}
        kick = {"cyan1": runs.told(kick=Kick(mode=KickMode.GROUND, speed=6.0))}
        vx, vy = runs.play(loaded, bodies, runs.at_first(kick), 0.2).ball("vx", "vy")[-1]
        ends.append(math.degrees(math.atan2(vy, vx)))
    return f"{np.std(ends):.2f}°"


def rebound() -> str:
    """Height that a ball reaches after a fall of 2 m."""
    z = runs.bounce(2.0).ball("z")[:, 0]
    low = int(np.argmin(z[:60]))
    return f"{z[low:].max() - load_profile('msl').ball.radius:.2f} m"


@cache
def _dribble_turns() -> float:
    """The turn rate, rad/s, at which a robot at 3 m/s loses the ball."""
    run = runs.dribble("force", speed=3.0, turn_gain=1.5, seconds=5.0)
    holding = run.robot("cyan1", "holding")[:, 0]
    omega = run.robot("cyan1", "omega")[:, 0]
    lost = int(np.argmax((holding == 0.0) & (run.times > 1.0)))
    return float(omega[lost])


def dribble_turn() -> str:
    """Turn rate at which a robot at 3 m/s loses the ball."""
    return f"{_dribble_turns():.1f} rad/s"


def _camera(distance: float) -> str:
    along, across = runs.errors(distance, 400).std(axis=0)
    return f"{100 * along:.0f} cm along and {100 * across:.0f} cm across"


def ball_error() -> str:
    """Standard deviations of a ball 6 m away in one picture."""
    return _camera(6.0)


def own_error() -> str:
    """Root mean square error of a robot's own place over ten minutes."""
    profile = load_profile("msl")
    snapshot = runs.play(profile, {"cyan1": (-2.0, 1.0, 0.0)}, runs.nothing, 0.1).snapshots[-1]
    perception = Perception(profile.sensing, snapshot.roster, RandomStreams(3), profile.time.tick)
    errors = []
    for tick in range(30_000):
        own = next(perception.at(replace(snapshot, tick=tick), 1)).own
        errors.append((own[0] + 2.0) ** 2 + (own[1] - 1.0) ** 2)
    return f"{100 * math.sqrt(np.mean(errors)):.0f} cm"


def _ages(model: str) -> tuple[float, float]:
    """Mean and standard deviation, s, of the ages at which messages are first read; ten robots send at once."""
    profile = load_profile("msl")
    roster = Roster(_ROBOTS, (Side.CYAN,) * 5 + (Side.MAGENTA,) * 5, {}, ())
    radio = RadioAir(replace(profile.radio, model=model), roster, profile.time.tick, RandomStreams(5))
    newest, ages = -1, []
    for tick in range(1, 4001):
        if tick % 4 == 0:  # no message overtakes another
            radio.send(tick, dict.fromkeys(_ROBOTS, _message(tick)))
        heard = list(radio.receive(tick))[1].get("cyan1")
        if heard is not None and heard.extra["n"] != newest:
            newest = int(heard.extra["n"])
            ages.append(heard.age)
    return float(np.mean(ages)), float(np.std(ages))


def _message(tick: int) -> Radio:
    """The message of one tick, as the shipped teams send it."""
    return Radio(self=_SELF, ball=_BALL, role="supporter", intention="cover the left side", extra={"n": tick})


def radio_age() -> str:
    """Age of a message in the first sight that has it."""
    mean, deviation = _ages("separate")
    return f"{1e3 * mean:.0f} ± {1e3 * deviation:.0f} ms"


def radio_shared() -> str:
    """The same where ten robots share one channel."""
    mean, deviation = _ages("shared")
    return f"{1e3 * mean:.0f} ± {1e3 * deviation:.0f} ms"


def fall() -> str:
    """How much lower than on the parabola a falling ball is after half a second."""
    run = runs.play(
        load_profile("paper"), {"ball": (0.0, 0.0, 0.0)}, runs.nothing, 0.6, launch=(0.0, 0.0, 0.0), height=2.0
    )
    at = int(np.argmax(run.times >= 0.5))
    time = float(run.times[at])
    z = run.ball("z")[:, 0]
    return f"{1e3 * (z[0] - 9.81 * time**2 / 2 - z[at]):.0f} mm"


FIGURES: dict[str, Callable[[], str]] = {
    one.__name__: one
    for one in (
        top_speed,
        time_to_three,
        stopping_distance,
        pirouette,
        pirouette_ideal,
        pirouette_omni,
        push,
        push_ideal,
        push_omni,
        rolling,
        rolling_ideal,
        kick_scatter,
        rebound,
        dribble_turn,
        ball_error,
        own_error,
        radio_age,
        radio_shared,
        fall,
    )
}
"""Name → function that measures the figure."""


@cache
def figure(name: str) -> str:
    """The text of a figure."""
    return FIGURES[name]()


def filled(text: str) -> str:
    """The text with all figures filled in."""
    return _FIGURE.sub(lambda found: f"<!--={found[1]}-->{figure(found[1])}<!--/-->", text)


if __name__ == "__main__":
    PAGE.write_text(filled(PAGE.read_text("utf-8")), "utf-8")
