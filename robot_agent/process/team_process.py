"""All robots of a team in one process: one thread and one session of the bus, on which each sight is answered in turn.

A match needs a session for each process, and most of its CPU time goes to them: five robots in one process cost a third
of five processes. A brain that raises ends the process, and with it its teammates.
"""

import gc
from collections.abc import Callable, Sequence

from robot_agent.process.runner import Member
from robot_agent.process.timing import IDLE_S
from runtime.bus.contract import Bus, Subscription
from schemas.topics import SIGHT


def serve_team(
    bus: Bus,
    robots: Sequence[str],
    member: Callable[[str, Subscription], Member],
    is_ready: Callable[[str], bool] = lambda _: True,
) -> int:
    """Run these robots until one of them ends, or the bus is closed; the status of the process, as of `Member.go_on`.

    Each joins once it `is_ready`, as `member(robot, sights)`, whose runner does not read the sights itself.

    Raises:
        TouchlineError: as `Member`.
    """
    sights = bus.subscribe_each(SIGHT, robot=robots)
    members: dict[str, Member] = {}
    waiting = list(robots)
    while not bus.closed:
        ready = {SIGHT.fill(robot=robot): member(robot, sights) for robot in waiting if is_ready(robot)}
        if ready:
            members |= ready
            waiting = [robot for robot in waiting if SIGHT.fill(robot=robot) not in members]
            for one in ready.values():
                one.note = f"{one.robot} has failed, and with it the process of its team"
                one.join()
            gc.collect()
            gc.freeze()
        received = sights.receive(IDLE_S)
        awaited = members if received is None else [received.key] if received.key in members else []
        for key in awaited:
            one = members[key]
            status = one.go_on(one.runner.read(received.payload) if received is not None else None)
            if status is not None:
                return status
    return 0
