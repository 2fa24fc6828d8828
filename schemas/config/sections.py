"""The sections of a profile as frozen data: pitch, bodies, drive, ball handling, sensing, radio; numbers with units."""

import math
from dataclasses import dataclass
from typing import Annotated

from schemas.config.quantity import Choice, Quantity


@dataclass(frozen=True, slots=True)
class TimeSteps:
    """How time is cut."""

    physics_step: Annotated[float, Quantity("s", "one step of the physics engine", 1e-4, 0.02)]
    steps_per_tick: Annotated[int, Quantity("1", "physics steps in one control tick", 1, 100)]

    @property
    def tick(self) -> float:
        """One control tick in s."""
        return self.physics_step * self.steps_per_tick


@dataclass(frozen=True, slots=True)
class Pitch:
    """The pitch, in the field frame; lines belong to the area they bound."""

    length: Annotated[float, Quantity("m", "goal line to goal line, outer edges, along x", 4, 120)]
    width: Annotated[float, Quantity("m", "touch line to touch line, outer edges, along y", 3, 90)]
    border: Annotated[float, Quantity("m", "ground outside the lines, up to the boundary", 0.3, 10)]
    boundary_height: Annotated[
        float, Quantity("m", "height of the boundary around the border, and of the net that stands on it", 0.05, 200)
    ]
    goal_width: Annotated[float, Quantity("m", "between the inner faces of the posts", 0.5, 8)]
    goal_height: Annotated[float, Quantity("m", "ground to the lower face of the bar", 0.3, 3)]
    goal_depth: Annotated[float, Quantity("m", "goal line to the back of the net box", 0.3, 3)]
    post: Annotated[float, Quantity("m", "edge of the square posts and bar", 0.02, 0.3)]
    penalty_area_depth: Annotated[float, Quantity("m", "goal line to the front of the penalty area", 0.3, 20)]
    goal_area_depth: Annotated[float, Quantity("m", "goal line to the front of the goal area", 0.2, 10)]
    centre_circle_radius: Annotated[float, Quantity("m", "radius of the centre circle", 0.3, 12)]
    corner_arc_radius: Annotated[float, Quantity("m", "radius of the corner arcs", 0.1, 2)]
    penalty_mark: Annotated[float, Quantity("m", "goal line to the penalty mark", 0.5, 20)]
    line_width: Annotated[float, Quantity("m", "width of the lines", 0.01, 0.3)]

    @property
    def goal_line(self) -> float:
        """x of the goal line that the side attacking +x shoots at."""
        return self.length / 2

    @property
    def touch_line(self) -> float:
        """y of the left touch line."""
        return self.width / 2

    @property
    def penalty_area_width(self) -> float:
        """The league's one formula for both years: goal width + 2 × depth."""
        return self.goal_width + 2 * self.penalty_area_depth

    @property
    def goal_area_width(self) -> float:
        """Goal width + 2 × depth."""
        return self.goal_width + 2 * self.goal_area_depth

    @property
    def restart_spots(self) -> tuple[tuple[float, float], ...]:
        """The nine marked spots: centre, penalty marks, and midway to the touch lines beside each of them."""
        mark = self.goal_line - self.penalty_mark
        beside = self.touch_line / 2
        return tuple((x, y) for x in (-mark, 0.0, mark) for y in (-beside, 0.0, beside))


@dataclass(frozen=True, slots=True)
class RobotBody:
    """The rigid body of a robot: an upright cylinder, and perhaps a box-shaped frame as high, flush with its front.

    The frame's front face touches the cylinder where the kick axis leaves it, so that ball and gap lie as without.
    """

    radius: Annotated[float, Quantity("m", "radius of the cylinder", 0.05, 0.6)]
    height: Annotated[float, Quantity("m", "height of the cylinder", 0.1, 1.5)]
    mass: Annotated[float, Quantity("kg", "mass", 0.5, 100)]
    inertia_xx: Annotated[float, Quantity("kg·m²", "moment of inertia about x and y", 0, 50)]
    inertia_zz: Annotated[float, Quantity("kg·m²", "moment of inertia about z", 1e-3, 50)]
    friction: Annotated[float, Quantity("1", "Coulomb coefficient of the hull", 0, 2)]
    restitution: Annotated[float, Quantity("1", "share of the normal speed a ball keeps that hits the hull", 0, 1)]
    frame_width: Annotated[float, Quantity("m", "width of the frame across the front; 0 without one", 0, 2)] = 0.0
    frame_depth: Annotated[float, Quantity("m", "depth of the frame, from the front backward", 0, 1)] = 0.0

    @property
    def reach(self) -> float:
        """The largest distance of the hull from the body's axis, on the ground, m."""
        if not self.frame_width:
            return self.radius
        return math.hypot(max(self.radius, self.frame_depth - self.radius), self.frame_width / 2)


@dataclass(frozen=True, slots=True)
class Ball:
    """The ball; numbers with a default are newer than the oldest recordings, which were played with the default."""

    radius: Annotated[float, Quantity("m", "radius", 0.02, 0.2)]
    mass: Annotated[float, Quantity("kg", "mass", 0.02, 2)]
    inertia: Annotated[float, Quantity("kg·m²", "moment of inertia about any axis", 1e-6, 0.1)]
    friction: Annotated[float, Quantity("1", "Coulomb coefficient between ball and ground", 0, 2)]
    restitution: Annotated[float, Quantity("1", "share of the normal speed kept on ground and goal frame", 0, 1)]
    rolling_deceleration: Annotated[float, Quantity("m/s²", "loss of speed of a ball that rolls freely", 0, 10)]
    net_deceleration: Annotated[float, Quantity("m/s²", "loss of speed of a ball that rolls in the net", 0, 50)]
    air_density: Annotated[float, Quantity("kg/m³", "density of the air", 0, 2)] = 0.0
    drag_coefficient: Annotated[float, Quantity("1", "drag over ½·density·π·radius²·speed²", 0, 2)] = 0.0
    magnus_coefficient: Annotated[
        float, Quantity("1", "lift over the same, of a ball that spins as if it rolled; less spin, less lift", 0, 2)
    ] = 0.0


@dataclass(frozen=True, slots=True)
class DriveLimits:
    """What the drive of a robot can do, in its body frame."""

    max_speed: Annotated[float, Quantity("m/s", "top speed in any direction", 0.1, 20)]
    max_turn_rate: Annotated[float, Quantity("rad/s", "top turn rate", 0.1, 50)]
    acceleration: Annotated[float, Quantity("m/s²", "change of velocity that gains speed", 0.1, 50)]
    deceleration: Annotated[float, Quantity("m/s²", "change of velocity that loses speed", 0.1, 50)]
    turn_acceleration: Annotated[float, Quantity("rad/s²", "change of the turn rate", 0.1, 200)]
    model: Annotated[
        str, Choice("velocity sets what the limits allow, omni drives wheels toward it", ("velocity", "omni"))
    ] = "velocity"


@dataclass(frozen=True, slots=True)
class Wheels:
    """The wheels of a robot whose drive is `omni`: evenly spaced, axles toward the centre, rollers that roll freely."""

    count: Annotated[int, Quantity("1", "number of wheels", 3, 4)]
    angle: Annotated[float, Quantity("rad", "kick axis to the first wheel; the others follow evenly", -3.2, 3.2)]
    arm: Annotated[float, Quantity("m", "centre of the robot to the wheels", 0.05, 0.6)]
    radius: Annotated[float, Quantity("m", "radius of a wheel", 0.01, 0.2)]
    inertia: Annotated[float, Quantity("kg·m²", "moment of inertia of a wheel about its axle", 0, 0.1)]
    gear: Annotated[float, Quantity("1", "turns of the motor for one of the wheel", 0.5, 200)]
    stall_torque: Annotated[
        float, Quantity("N·m", "torque of a motor at rest; it falls linearly with speed", 1e-3, 100)
    ]
    no_load_speed: Annotated[float, Quantity("rad/s", "speed of a motor at which no torque is left", 1, 1e4)]
    rotor_inertia: Annotated[float, Quantity("kg·m²", "moment of inertia of a motor's rotor", 1e-7, 0.01)]
    max_speed: Annotated[float, Quantity("m/s", "rim speed that a wheel is told at most", 0.1, 30)]
    gain: Annotated[float, Quantity("N·m·s/rad", "motor torque for each rad/s that the motor is too slow", 1e-4, 10)]
    traction: Annotated[float, Quantity("1", "grip: largest force along the rim by weight on the wheel", 0, 3)]
    slip_stiffness: Annotated[float, Quantity("s/m", "grip in use for each m/s of slip, until all is", 0.1, 200)]

    @property
    def no_load_rim_speed(self) -> float:
        """Rim speed in m/s at which the motors have no torque left."""
        return self.no_load_speed * self.radius / self.gear


@dataclass(frozen=True, slots=True)
class Dribble:
    """When a robot holds the ball, and how the ball follows: `force` draws it with bounded forces, and can lose it."""

    distance: Annotated[float, Quantity("m", "centre to centre, at most this far to hold", 0.05, 2)]
    cone: Annotated[float, Quantity("rad", "total cone about the kick axis; half of it to either side", 0.01, 6.3)]
    gap: Annotated[float, Quantity("m", "centre to centre while the ball is carried", 0.05, 2)]
    max_ball_height: Annotated[float, Quantity("m", "a ball whose centre is higher cannot be held", 0, 2)]
    method: Annotated[str, Choice("how a held ball is moved", ("pose", "velocity", "force"))]
    stiffness: Annotated[float, Quantity("N/m", "way `force`: draws the ball to the gap", 0, 2000)] = 0.0
    damping: Annotated[float, Quantity("N·s/m", "way `force`: against motion relative to the gap", 0, 50)] = 0.0
    max_pull: Annotated[float, Quantity("N", "way `force`: the most along the kick axis", 0, 100)] = 0.0
    max_side: Annotated[float, Quantity("N", "way `force`: the most across the kick axis", 0, 100)] = 0.0


@dataclass(frozen=True, slots=True)
class Kicker:
    """What the kicking device can do."""

    max_ground_speed: Annotated[float, Quantity("m/s", "top exit speed of a ground kick", 0.5, 40)]
    max_lob_speed: Annotated[float, Quantity("m/s", "top horizontal speed of a lob", 0.5, 40)]
    lob_margin: Annotated[float, Quantity("m", "air between the ball and the bar when a lob is solved", 0, 0.5)]
    max_air_speed: Annotated[float, Quantity("m/s", "top exit speed of a ball that leaves the ground", 0.5, 60)] = 60.0
    loft: Annotated[float, Quantity("rad", "angle above the ground of a kick with fixed loft", 0.01, 1.5)] = 0.6435
    charge_time: Annotated[float, Quantity("s", "charging before the next kick, after the cooldown", 0, 60)] = 0.0
    cooldown: Annotated[float, Quantity("s", "dead time after a kick, in which nothing charges", 0, 60)] = 0.0


@dataclass(frozen=True, slots=True)
class Sensing:
    """What robots perceive: sensors of their own motion, and a camera that looks all around.

    Noise is Gaussian, and numbers of it are standard deviations. A camera's grows with the distance d: along the line
    of sight it is √(near² + (range_noise·d)²), across it √(near² + (bearing_noise·d)²).
    """

    own_position: Annotated[float, Quantity("m", "noise of the own x and y", 0, 2)]
    own_heading: Annotated[float, Quantity("rad", "noise of the own heading", 0, 1)]
    own_velocity: Annotated[float, Quantity("m/s", "noise of the own vx and vy", 0, 2)]
    own_turn_rate: Annotated[float, Quantity("rad/s", "noise of the own turn rate", 0, 2)]
    drift_position: Annotated[float, Quantity("m", "how far the believed x and y wander from the true ones", 0, 2)]
    drift_heading: Annotated[float, Quantity("rad", "how far the believed heading wanders from the true one", 0, 1)]
    drift_time: Annotated[float, Quantity("s", "after this time the drift has become another one", 0.1, 1e4)]
    ball_position: Annotated[float, Quantity("m", "noise of a near ball's x, y and height", 0, 2)]
    ball_velocity: Annotated[float, Quantity("m/s", "noise of a near ball's vx and vy", 0, 2)]
    ball_velocity_growth: Annotated[
        float, Quantity("1/s", "noise of the ball's vx and vy for each m of distance", 0, 2)
    ]
    obstacle_position: Annotated[float, Quantity("m", "noise of a near obstacle's x and y", 0, 2)]
    range_noise: Annotated[float, Quantity("1", "noise of a seen thing's distance, as a share of it", 0, 1)]
    bearing_noise: Annotated[float, Quantity("rad", "noise of the direction in which a thing is seen", 0, 1)]
    noise_rate: Annotated[float, Quantity("1", "share of readings that have noise; the others are exact", 0, 1)]
    ball_range: Annotated[float, Quantity("m", "a ball farther away than this is not seen", 0, 1000)]
    obstacle_range: Annotated[float, Quantity("m", "an obstacle farther away than this is not seen", 0, 1000)]
    ball_dropout: Annotated[float, Quantity("1", "share of pictures in which a ball in view is not found", 0, 1)]
    obstacle_dropout: Annotated[float, Quantity("1", "likewise for each obstacle in view", 0, 1)]
    occlusion: Annotated[str, Choice("what hides the things behind it", ("nothing", "hulls"))]
    camera_rate: Annotated[float, Quantity("Hz", "pictures taken in a second; at most one in each tick", 0.1, 1000)]
    latency: Annotated[float, Quantity("s", "from taking a picture to knowing what is in it, in whole ticks", 0, 2)]


@dataclass(frozen=True, slots=True)
class RadioChannel:
    """The air between teammates, which the host stands in for."""

    delay: Annotated[float, Quantity("s", "least simulated time from the word to a teammate's ear", 0, 5)]
    jitter: Annotated[float, Quantity("s", "a word takes up to this much longer, each time alike", 0, 5)]
    loss: Annotated[float, Quantity("1", "share of deliveries that never arrive", 0, 1)]
    budget: Annotated[float, Quantity("bit/s", "what a team may say per second, averaged over one second", 0, 1e9)]


@dataclass(frozen=True, slots=True)
class Safety:
    """What protects the field from an agent that has stopped answering."""

    watchdog: Annotated[float, Quantity("s", "a command older than this brakes the robot", 0.01, 10)]


SECTIONS: dict[str, type] = {
    "time": TimeSteps,
    "field": Pitch,
    "robot": RobotBody,
    "ball": Ball,
    "drive": DriveLimits,
    "wheels": Wheels,
    "dribble": Dribble,
    "kicker": Kicker,
    "sensing": Sensing,
    "radio": RadioChannel,
    "safety": Safety,
}
"""Section name in the file → the dataclass that holds it."""
TYPE_SECTIONS: dict[str, type] = {name: SECTIONS[name] for name in ("robot", "drive", "wheels", "dribble", "kicker")}
"""The sections whose numbers a type of robot may change."""
