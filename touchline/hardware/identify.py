"""Finds the numbers of a robot from its commands and poses: those with which the simplest model moves as it did.

The model is that of the drives: demands act after a latency, the velocity in the body frame follows them within top
speed and accelerations. Its motion over short stretches is compared with that of the poses, so that errors do not add
up; what is left is the noise of the poses. The delay of the camera is the one at which bodies that stand still do so.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize, minimize_scalar

from robot_agent.hardware.limits import toward, within_limits
from schemas.config.robot_model import RobotModel
from schemas.errors import TouchlineError
from schemas.messages.command import Drive
from touchline.hardware.robot_track import RobotTrack

Floats = NDArray[np.float64]
Vectors = NDArray[np.complex128]

_DT = 0.01
"""s of a step of the integration."""
_STRETCH = 0.3
"""s over which motions are compared."""
_SHORT = 0.1
"""s over which what is left is noise: errors of the model have not added up."""
_LEAST = 10.0
"""s of a recording with commands that is enough."""
_REACHED = 0.97
"""Share of the largest demand; a top speed above it was not reached."""
_LONGEST_DELAY = 0.4
"""s; of commands and of the camera."""
_SLOW = 0.5
"""rad/s; a robot that turns no faster sees bodies near where they are, whatever the delay."""
_OFTEN = 0.3
"""Share of the pictures of the body that is seen most, from which on a body counts."""
_SAME_BODY = 1.0
"""m within which a body in two pictures is the same."""


class RobotNumbers(NamedTuple):
    """The numbers of a robot; None where the recording does not show it."""

    max_speed: float | None
    """m/s; None if no demand was beyond it."""
    acceleration: float
    """m/s² that gains speed."""
    deceleration: float
    """m/s² that loses speed."""
    latency: float
    """s from a sight to the motion that its command causes."""
    max_turn_rate: float | None
    """rad/s; None if no demand was beyond it."""
    turn_acceleration: float
    """rad/s²."""
    position_noise: float
    """m; standard deviation of x and of y."""
    heading_noise: float
    """rad; standard deviation."""
    camera_delay: float | None
    """s from a picture to its arrival; None without bodies that stand still."""


def identify(track: RobotTrack, model: RobotModel) -> RobotNumbers:
    """The numbers of the robot of a track, whose demands were kept within the limits of `model`.

    Raises:
        TouchlineError: the recording is too short, or the robot hardly moves in it.
    """
    times = np.array([sight.time for sight in track.sights])
    times -= times[0]
    pose = np.array([(sight.self.x, sight.self.y, sight.self.heading) for sight in track.sights])
    if times[-1] < _LEAST or track.commands.count(None) > len(times) / 2:
        raise TouchlineError(f"{times[-1]:.1f} s of sights with commands; {_LEAST:g} s are needed, and 60 s are better")
    grid = np.arange(0.0, times[-1] + _DT, _DT)
    nodes = np.sort(np.concatenate((times, (times[1:] + times[:-1]) / 2)))  # demands change there, however late
    demands = _sent(track, model)[np.searchsorted(times, nodes, side="right") - 1]
    move, turn = demands[:, 0] + 1j * demands[:, 1], demands[:, 2]
    spin: Vectors = turn.astype(complex)
    follow = _Follower(nodes, grid)
    heading = np.interp(grid, times, np.unwrap(pose[:, 2]))
    if np.abs(move).std() < 0.2 or turn.std() < 0.2:
        raise TouchlineError("the demands hardly change; let the robot start, stop and turn often, up to its limits")
    turned = np.exp(1j * heading)
    driven = _Comparison(times, grid, pose[:, 0] + 1j * pose[:, 1])
    spun = _Comparison(times, grid, np.unwrap(pose[:, 2]) + 0j)

    def moved(top: float, gain: float, loss: float, latency: float) -> Vectors:
        return driven.residual(follow(move, top, gain, loss, latency) * turned)

    top, gain, loss, latency = _fitted(moved, (np.abs(move).max() * 0.8, 2.0, 2.0, 0.04))

    def rotated(top: float, change: float, latency: float) -> Vectors:
        return spun.residual(follow(spin, top, change, change, latency))

    turn_top, turn_change, _ = _fitted(rotated, (np.abs(turn).max() * 0.8, 8.0, latency))
    scales = [np.std(moved(top, gain, loss, latency)), np.std(rotated(turn_top, turn_change, latency))]

    def both(latency: float) -> Vectors:
        residuals = moved(top, gain, loss, latency), rotated(turn_top, turn_change, latency)
        return np.concatenate([one / scale for one, scale in zip(residuals, scales, strict=True)])

    (latency,) = _fitted(both, (latency,))
    left = driven.residual(follow(move, top, gain, loss, latency) * turned, _SHORT)
    left_turn = spun.residual(follow(spin, turn_top, turn_change, turn_change, latency), _SHORT)
    return RobotNumbers(
        max_speed=_reached(top, float(np.abs(move).max())),
        acceleration=gain,
        deceleration=loss,
        latency=latency,
        max_turn_rate=_reached(turn_top, float(np.abs(turn).max())),
        turn_acceleration=turn_change,
        position_noise=_noise(np.concatenate((left.real, left.imag))),
        heading_noise=_noise(left_turn.real),
        camera_delay=_camera_delay(track, times, pose),
    )


def _sent(track: RobotTrack, model: RobotModel) -> Floats:
    """Per sight: vx, vy, omega of the demand that a guard sends on."""
    sent, before, rows = Drive(), track.sights[0].time, []
    for sight, command in zip(track.sights, track.commands, strict=True):
        if command is not None:
            sent = toward(sent, within_limits(command.drive, model), model, min(0.05, sight.time - before))
        before = sight.time
        rows.append((sent.vx, sent.vy, sent.omega))
    return np.array(rows)


def profile_text(numbers: RobotNumbers, profile: str, origin: str) -> str:
    """A profile, TOML, that extends another one by the numbers of a robot; `origin` says where they come from."""
    sections = {
        "drive": {
            "max_speed": (numbers.max_speed, "m/s"),
            "acceleration": (numbers.acceleration, "m/s²"),
            "deceleration": (numbers.deceleration, "m/s²"),
            "max_turn_rate": (numbers.max_turn_rate, "rad/s"),
            "turn_acceleration": (numbers.turn_acceleration, "rad/s²"),
        },
        "sensing": {
            "own_position": (numbers.position_noise, "m"),
            "own_heading": (numbers.heading_noise, "rad"),
            "latency": (numbers.camera_delay, "s"),
        },
    }
    lines = [f'extends = "{profile}"', f"# latency of commands: {numbers.latency:.3f} s, which no profile has"]
    for section, values in sections.items():
        lines += ["", f"[{section}]"]
        for key, (value, unit) in values.items():
            known = (
                f'{key} = {{ value = {value:.4g}, unit = "{unit}", origin = "{origin}" }}' if value is not None else ""
            )
            lines.append(known or f"# {key}: the recording does not show it")
    return "\n".join(lines) + "\n"


class _Comparison:
    """The motion of poses over short stretches, against that of a model."""

    def __init__(self, times: Floats, grid: Floats, place: Vectors) -> None:
        self._times, self._grid, self._place = times, grid, place

    def residual(self, velocity: Vectors, stretch: float = _STRETCH) -> Vectors:
        """Per stretch: how much farther the poses moved than a model with this velocity at each time of the grid."""
        ends = np.searchsorted(self._times, self._times + stretch)
        begin = np.flatnonzero(ends < len(self._times))
        end = ends[begin]
        way = np.concatenate(([0.0], np.cumsum((velocity[1:] + velocity[:-1]) * (_DT / 2))))
        at = np.interp(self._times, self._grid, way.real) + 1j * np.interp(self._times, self._grid, way.imag)
        residual: Vectors = self._place[end] - self._place[begin] - (at[end] - at[begin])
        return residual


class _Follower:
    """What follows a demand within top speed and accelerations, some time later.

    The demand changes at the nodes, times of sights among them, so that a sight that was late moves nothing else.
    """

    def __init__(self, nodes: Floats, grid: Floats) -> None:
        self._nodes, self._grid = nodes, grid
        self._steps = np.diff(nodes, append=nodes[-1] + _DT).tolist()

    def __call__(self, demand: Vectors, top: float, gain: float, loss: float, latency: float) -> Vectors:
        """The velocity at each time of the grid; the demand is given per node."""
        wanted = demand * np.minimum(1.0, top / np.maximum(np.abs(demand), 1e-9))
        now, velocities = 0j, []
        for goal, step in zip(wanted.tolist(), self._steps, strict=True):
            velocities.append(now)
            change = goal - now
            most = (loss if abs(goal) < abs(now) else gain) * step
            now = goal if abs(change) <= most else now + change * (most / abs(change))
        velocity: Vectors = np.interp(self._grid - latency, self._nodes, np.array(velocities), left=0.0)
        return velocity


def _fitted(residual: Callable[..., Vectors], start: tuple[float, ...]) -> tuple[float, ...]:
    """The numbers, all positive, with the least squares of the residual."""

    def loss(logs: Floats) -> float:
        return float(np.mean(np.abs(residual(*np.exp(logs))) ** 2))

    best = np.log(start)
    for _ in range(2):  # the simplex collapses at times, and begins anew
        best = minimize(loss, best, method="Nelder-Mead", options={"xatol": 1e-3, "fatol": 1e-10}).x
    return tuple(map(float, np.exp(best)))


def _reached(top: float, demanded: float) -> float | None:
    return top if top < _REACHED * demanded else None


def _noise(residual: Floats) -> float:
    """The standard deviation of one pose from differences of two: half of the middle 68 %, without outliers."""
    low, high = np.percentile(residual, (15.865, 84.135))
    return float((high - low) / 2 / np.sqrt(2.0))


def _camera_delay(track: RobotTrack, times: Floats, pose: Floats) -> float | None:
    """The delay of the camera beside what the sights state, plus what they state."""
    stated = np.array([sight.obstacles_age for sight in track.sights])
    fresh = np.flatnonzero((np.diff(times - stated, prepend=-np.inf) > 1e-4) & (times > _LONGEST_DELAY))
    taken = times - stated
    heading = np.unwrap(pose[:, 2])

    def placed(at: Floats) -> tuple[Vectors, Vectors]:
        place = np.interp(at, times, pose[:, 0]) + 1j * np.interp(at, times, pose[:, 1])
        return place, np.exp(1j * np.interp(at, times, heading))

    seen = [(number, complex(body.x, body.y)) for number in fresh for body in track.sights[number].obstacles]
    rows, places = np.array([row for row, _ in seen], dtype=int), np.array([place for _, place in seen])
    turn_rates = np.abs(np.interp(times, times, np.gradient(heading, times)))
    bodies = _bodies(places[turn_rates[rows] < _SLOW])
    if not bodies.size:
        return None
    then, turned = placed(taken[rows])
    in_body = (places - then) * turned.conj()

    def spread(delay: float) -> float:
        """Mean square of the distances of bodies from where they are on average, with another delay."""
        then, turned = placed(taken[rows] - delay)
        found = then + in_body * turned
        away = np.abs(found[:, None] - bodies)
        names = away.argmin(axis=1)
        near = away.min(axis=1) < _SAME_BODY
        means = np.array(
            [found[near & (names == name)].mean() if name in names[near] else 0 for name in range(len(bodies))]
        )
        return float((np.minimum(np.abs(found - means[names]), _SAME_BODY) ** 2).mean())

    coarse = min(np.arange(-_LONGEST_DELAY / 4, _LONGEST_DELAY, 0.01), key=spread)
    best = minimize_scalar(spread, bounds=(coarse - 0.01, coarse + 0.01), method="bounded").x
    return max(0.0, float(best) + float(stated[fresh].min()))  # others have waited for their sight


def _bodies(places: Vectors) -> Vectors:
    """Where bodies stand that most pictures show, by the places in pictures of a robot that hardly turned."""
    found: list[list[complex]] = []
    for place in places.tolist():
        one = next((one for one in found if abs(one[0] - place) < _SAME_BODY), None)
        if one is None:
            found.append([place])
        else:
            one.append(place)
    often = [np.mean(one) for one in found if len(one) >= _OFTEN * max(map(len, found))]
    bodies: Vectors = np.array(often, dtype=complex)
    return bodies
