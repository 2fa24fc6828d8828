"""The sections of a profile as frozen data with units: pitch, bodies, drive, ball handling, sensing and radio."""

import math
from dataclasses import dataclass
from typing import Annotated

from schemas.config.quantity import Choice, Quantity
from schemas.config.wheels import Wheels


@dataclass(frozen=True, slots=True)
class TimeSteps:
    """Lengths of the physics step and the control tick."""

    physics_step: Annotated[float, Quantity("s", "one step of the physics engine", 1e-4, 0.02)]
    steps_per_tick: Annotated[int, Quantity("1", "physics steps in one control tick", 1, 100)]

    @property
    def tick(self) -> float:
        """Length of a control tick in s."""
        return self.physics_step * self.steps_per_tick


@dataclass(frozen=True, slots=True)
class Pitch:
    """The pitch, in the field frame; lines belong to the area that they bound."""

    length: Annotated[float, Quantity("m", "goal line to goal line, outer edges, along x", 4, 120)]
    width: Annotated[float, Quantity("m", "touch line to touch line, outer edges, along y", 3, 90)]
    border: Annotated[float, Quantity("m", "ground from the lines to the boundary", 0.3, 10)]
    boundary_height: Annotated[
        float, Quantity("m", "height of the boundary around the border, including the net on it", 0.05, 200)
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
        """x of the goal line that the side attacking +x shoots at, in m."""
        return self.length / 2

    @property
    def touch_line(self) -> float:
        """y of the left touch line, in m."""
        return self.width / 2

    @property
    def penalty_area_width(self) -> float:
        """Goal width + 2 × depth, the formula of the rule book, in m."""
        return self.goal_width + 2 * self.penalty_area_depth

    @property
    def goal_area_width(self) -> float:
        """Goal width + 2 × depth, in m."""
        return self.goal_width + 2 * self.goal_area_depth

    @property
    def restart_spots(self) -> tuple[tuple[float, float], ...]:
        """The nine restart spots: centre mark, penalty marks, and midway to the touch lines beside each of them."""
        mark, beside = self.goal_line - self.penalty_mark, self.touch_line / 2
        return tuple((x, y) for x in (-mark, 0.0, mark) for y in (-beside, 0.0, beside))


@dataclass(frozen=True, slots=True)
class RobotBody:
    """The rigid body of a robot: an upright cylinder, and optionally a box-shaped frame of its height at its front.

    The front face of the frame touches the cylinder where the kick axis leaves it, so that the ball is held in the same
    place with and without a frame.
    """

    radius: Annotated[float, Quantity("m", "radius of the cylinder", 0.05, 0.6)]
    height: Annotated[float, Quantity("m", "height of the cylinder", 0.1, 1.5)]
    mass: Annotated[float, Quantity("kg", "mass", 0.5, 100)]
    inertia_xx: Annotated[float, Quantity("kg·m²", "moment of inertia about x and y", 0, 50)]
    inertia_zz: Annotated[float, Quantity("kg·m²", "moment of inertia about z", 1e-3, 50)]
    friction: Annotated[float, Quantity("1", "Coulomb coefficient of the hull", 0, 2)]
    restitution: Annotated[
        float, Quantity("1", "share of its normal speed that a ball keeps when it hits the hull", 0, 1)
    ]
    frame_width: Annotated[float, Quantity("m", "width of the frame across the front; 0 without one", 0, 2)] = 0.0
    frame_depth: Annotated[float, Quantity("m", "depth of the frame, from the front backward", 0, 1)] = 0.0

    @property
    def reach(self) -> float:
        """Largest distance of the hull from the body's axis in m: the radius of the circle around it."""
        if not self.frame_width:
            return self.radius
        return math.hypot(max(self.radius, self.frame_depth - self.radius), self.frame_width / 2)


@dataclass(frozen=True, slots=True)
class Ball:
    """The ball."""

    radius: Annotated[float, Quantity("m", "radius", 0.02, 0.2)]
    mass: Annotated[float, Quantity("kg", "mass", 0.02, 2)]
    inertia: Annotated[float, Quantity("kg·m²", "moment of inertia about any axis", 1e-6, 0.1)]
    friction: Annotated[float, Quantity("1", "Coulomb coefficient between ball and ground", 0, 2)]
    restitution: Annotated[float, Quantity("1", "share of the normal speed kept on ground and goal frame", 0, 1)]
    rolling_deceleration: Annotated[float, Quantity("m/s²", "loss of speed of a ball that rolls freely", 0, 10)]
    net_deceleration: Annotated[float, Quantity("m/s²", "loss of speed of a ball that rolls in the net", 0, 50)]
    air_density: Annotated[float, Quantity("kg/m³", "density of the air", 0, 2)] = 0.0
    drag_coefficient: Annotated[
        float, Quantity("1", "drag over ½·density·π·radius²·speed², of a ball in flight", 0, 2)
    ] = 0.0
    magnus_coefficient: Annotated[
        float, Quantity("1", "lift over the same, of a ball that spins as if it rolled; proportional to the spin", 0, 2)
    ] = 0.0
    rolling_drag_coefficient: Annotated[float, Quantity("1", "drag over the same, of a ball on the ground", 0, 2)] = 0.0
    touch_tie: Annotated[
        float, Quantity("1", "touches of one step are level if their forces differ by this share of the larger", 0, 0.9)
    ] = 0.0


@dataclass(frozen=True, slots=True)
class DriveLimits:
    """Limits of a robot's drive, in its body frame."""

    max_speed: Annotated[float, Quantity("m/s", "top speed in any direction", 0.1, 20)]
    max_turn_rate: Annotated[float, Quantity("rad/s", "top turn rate", 0.1, 50)]
    acceleration: Annotated[float, Quantity("m/s²", "change of velocity that gains speed", 0.1, 50)]
    deceleration: Annotated[float, Quantity("m/s²", "change of velocity that loses speed", 0.1, 50)]
    turn_acceleration: Annotated[float, Quantity("rad/s²", "change of the turn rate", 0.1, 200)]
    model: Annotated[
        str,
        Choice(
            "velocity sets the velocity, its change limited in the turning body frame; traction limits the change as a "
            "vector in the field frame; omni drives wheels toward it; differential has two wheels and no sideways "
            "motion",
            ("velocity", "traction", "omni", "differential"),
        ),
    ] = "velocity"
    stuck_window: Annotated[float, Quantity("s", "time over which progress is compared with demand", 0.02, 5)] = 0.5

    @property
    def sideways(self) -> bool:
        """The drive moves the robot in any direction, whatever its heading."""
        return self.model != "differential"


@dataclass(frozen=True, slots=True)
class Dribble:
    """When a robot holds the ball, and how a held ball moves. With `force`, bounded forces draw it and can lose it."""

    distance: Annotated[float, Quantity("m", "largest distance from centre to centre of a held ball", 0.05, 2)]
    cone: Annotated[
        float, Quantity("rad", "total angle of the cone around the kick axis, half of it on either side", 0.01, 6.3)
    ]
    gap: Annotated[float, Quantity("m", "distance from centre to centre of a carried ball", 0.05, 2)]
    max_ball_height: Annotated[float, Quantity("m", "largest height of the centre of a held ball", 0, 2)]
    method: Annotated[str, Choice("how a held ball is moved", ("pose", "velocity", "force"))]
    stiffness: Annotated[float, Quantity("N/m", "method `force`: stiffness toward the gap", 0, 2000)] = 0.0
    damping: Annotated[float, Quantity("N·s/m", "method `force`: damping of motion relative to the gap", 0, 50)] = 0.0
    max_pull: Annotated[float, Quantity("N", "method `force`: largest force along the kick axis", 0, 100)] = 0.0
    max_side: Annotated[float, Quantity("N", "method `force`: largest force across the kick axis", 0, 100)] = 0.0
    contest: Annotated[
        str,
        Choice("method `force`: which of several robots that reach the ball draw it to themselves", ("nearest", "all")),
    ] = "nearest"


@dataclass(frozen=True, slots=True)
class Kicker:
    """Limits of the kicking device."""

    max_ground_speed: Annotated[float, Quantity("m/s", "top exit speed of a ground kick", 0.5, 40)]
    max_lob_speed: Annotated[float, Quantity("m/s", "top horizontal speed of a lob", 0.5, 40)]
    lob_margin: Annotated[float, Quantity("m", "gap between ball and bar for which a lob is solved", 0, 0.5)]
    max_air_speed: Annotated[float, Quantity("m/s", "top exit speed of a kick that leaves the ground", 0.5, 60)] = 60.0
    loft: Annotated[float, Quantity("rad", "angle above the ground of a kick with fixed loft", 0.01, 1.5)] = 0.6435
    charge_time: Annotated[float, Quantity("s", "time to charge for the next kick, after the cooldown", 0, 60)] = 0.0
    cooldown: Annotated[float, Quantity("s", "time after a kick before charging begins", 0, 60)] = 0.0
    kick_spin: Annotated[
        float,
        Quantity("1", "share of the spin of rolling that a kick along the ground gives; 1: it rolls at once", 0, 1),
    ] = 1.0


@dataclass(frozen=True, slots=True)
class CameraView:
    """What a robot's camera has in view."""

    field_of_view: Annotated[
        float, Quantity("rad", "total angle about the kick axis in which ball and obstacles are seen", 0.01, math.tau)
    ] = math.tau


@dataclass(frozen=True, slots=True)
class Sensing:
    """What robots perceive: sensors of their own motion, and a camera.

    Noise is Gaussian and given as standard deviations. That of the camera grows with the distance d: along the line of
    sight it is √(near² + (range_noise·d)²), across it √(near² + (bearing_noise·d)²).
    """

    own_position: Annotated[float, Quantity("m", "noise of the own x and y", 0, 2)]
    own_heading: Annotated[float, Quantity("rad", "noise of the own heading", 0, 1)]
    own_velocity: Annotated[float, Quantity("m/s", "noise of the own vx and vy", 0, 2)]
    own_turn_rate: Annotated[float, Quantity("rad/s", "noise of the own turn rate", 0, 2)]
    drift_position: Annotated[float, Quantity("m", "drift of the measured x and y", 0, 2)]
    drift_heading: Annotated[float, Quantity("rad", "drift of the measured heading", 0, 1)]
    drift_time: Annotated[
        float, Quantity("s", "time after which the drift is independent of its earlier value", 0.1, 1e4)
    ]
    ball_position: Annotated[float, Quantity("m", "noise of a near ball's x, y and height", 0, 2)]
    ball_velocity: Annotated[float, Quantity("m/s", "noise of a near ball's vx and vy", 0, 2)]
    ball_velocity_growth: Annotated[
        float, Quantity("1/s", "noise of the ball's vx and vy for each m of distance", 0, 2)
    ]
    obstacle_position: Annotated[float, Quantity("m", "noise of a near obstacle's x and y", 0, 2)]
    range_noise: Annotated[
        float, Quantity("1", "noise of the distance of a detected body, as a share of the distance", 0, 1)
    ]
    bearing_noise: Annotated[float, Quantity("rad", "noise of the direction of a detected body", 0, 1)]
    noise_rate: Annotated[float, Quantity("1", "share of readings that have noise; the others are exact", 0, 1)]
    ball_range: Annotated[float, Quantity("m", "largest distance at which a ball is detected", 0, 1000)]
    obstacle_range: Annotated[float, Quantity("m", "largest distance at which an obstacle is detected", 0, 1000)]
    ball_dropout: Annotated[float, Quantity("1", "share of pictures in which a ball in view is not detected", 0, 1)]
    obstacle_dropout: Annotated[
        float, Quantity("1", "share of pictures in which an obstacle in view is not detected", 0, 1)
    ]
    occlusion: Annotated[str, Choice("what hides the bodies behind it", ("nothing", "hulls"))]
    camera_rate: Annotated[float, Quantity("Hz", "pictures per second; at most one in each tick", 0.1, 1000)]
    latency: Annotated[
        float, Quantity("s", "from taking a picture to the sight that has its content, in whole ticks", 0, 2)
    ]


@dataclass(frozen=True, slots=True)
class RadioChannel:
    """The radio between teammates, which the host simulates."""

    delay: Annotated[float, Quantity("s", "least simulated time from sending to arrival", 0, 5)]
    jitter: Annotated[float, Quantity("s", "longest further time until arrival, uniformly distributed", 0, 5)]
    loss: Annotated[float, Quantity("1", "share of deliveries that never arrive", 0, 1)]
    budget: Annotated[float, Quantity("bit/s", "most that a team may send, averaged over one second", 0, 1e9)]
    model: Annotated[
        str,
        Choice(
            "separate gives each side its own channel, with exact times; shared makes messages of both sides wait for "
            "each other; ticks counts whole ticks from the end of the tick",
            ("separate", "shared", "ticks"),
        ),
    ] = "ticks"
    bit_rate: Annotated[float, Quantity("bit/s", "bits of a message per second on the shared channel", 1e4, 1e9)] = 3e6
    frame_time: Annotated[
        float, Quantity("s", "further time on the shared channel that each message takes", 0, 0.1)
    ] = 4e-4
    queue: Annotated[
        float, Quantity("s", "longest wait for the shared channel; beyond it a message is refused", 0, 5)
    ] = 0.1


@dataclass(frozen=True, slots=True)
class Safety:
    """Protection from agents that have stopped answering."""

    watchdog: Annotated[float, Quantity("s", "age of a command at which the robot brakes", 0.01, 10)]
    silence: Annotated[
        float, Quantity("s", "time since the last new command at which the robot brakes, whatever its age", 0.01, 10)
    ] = 10.0


SECTIONS: dict[str, type] = {
    "time": TimeSteps,
    "field": Pitch,
    "robot": RobotBody,
    "ball": Ball,
    "drive": DriveLimits,
    "wheels": Wheels,
    "dribble": Dribble,
    "kicker": Kicker,
    "camera": CameraView,
    "sensing": Sensing,
    "radio": RadioChannel,
    "safety": Safety,
}
"""Section name in the file → the dataclass that holds it."""
TYPE_SECTIONS: dict[str, type] = {
    name: SECTIONS[name] for name in ("robot", "drive", "wheels", "dribble", "kicker", "camera")
}
"""The sections whose numbers a type of robot may change."""
