"""The action SimulateSteps, as the three services and two topics that actions of ROS 2 are."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from robot_agent.ros2.simulation.codes import Code, GoalStatus, RefusedError
from robot_agent.ros2.simulation.services import PACKAGE
from robot_agent.ros2.simulation.steps import Outcome, Steps
from runtime.ros2.graph import Graph, Request
from runtime.ros2.message_builder import MessageBuilder
from runtime.ros2.message_types import typestore
from runtime.ros2.topic_type import TopicType

_ACTION = f"{PACKAGE}/action/SimulateSteps"
_SEND, _GET = TopicType(f"{_ACTION}_SendGoal"), TopicType(f"{_ACTION}_GetResult")
_CANCEL = TopicType("action_msgs/srv/CancelGoal")
_FEEDBACK = TopicType(f"{_ACTION}_FeedbackMessage")
_STATUS = TopicType("action_msgs/msg/GoalStatusArray", depth=1, latched=True)
_MOST_GOALS = 32
"""Newest goals whose results are kept."""
_UNKNOWN_GOAL, _GOAL_ENDED = 2, 3
"""Codes of a goal that cannot be canceled."""
_ACTIVE = (GoalStatus.EXECUTING, GoalStatus.CANCELING)


@dataclass
class _Goal:
    info: Any
    """The `GoalInfo`."""
    status: GoalStatus = GoalStatus.EXECUTING
    result: Any = None
    steps: Steps | None = None
    waiting: list[Request] = field(default_factory=list)
    """Clients that wait for the result."""


class StepAction:
    """All its methods but the first run on the thread that handles requests."""

    def __init__(
        self,
        graph: Graph,
        prefix: str,
        put: Callable[[Callable[[], None]], None],
        begin: Callable[[int, Callable[[Outcome], None], Callable[[int, int], None]], Steps],
        result: Callable[[Code, str], Any],
    ) -> None:
        """`put` runs a task on the thread that handles requests, `begin` begins steps, `result` makes a `Result`."""
        self._begin, self._result, self._clock = begin, result, graph.clock
        self._build, self._store = MessageBuilder(), typestore()
        self._goals: dict[bytes, _Goal] = {}
        place = f"{prefix}/simulate_steps/_action"
        self._feedback = graph.publisher(f"{place}/feedback", _FEEDBACK)
        self._status = graph.publisher(f"{place}/status", _STATUS)
        for name, topic_type, handle in (
            ("send_goal", _SEND, self._send_goal),
            ("cancel_goal", _CANCEL, self._cancel_goal),
            ("get_result", _GET, self._get_result),
        ):
            graph.serve(f"{place}/{name}", topic_type, self._receiver(topic_type, put, handle))

    def _receiver(
        self, topic_type: TopicType, put: Callable[[Callable[[], None]], None], handle: Callable[[Request, Any], None]
    ) -> Callable[[Request], None]:
        def receive(request: Request) -> None:
            try:
                asked = self._store.deserialize_cdr(request.payload, f"{topic_type.message}_Request")
            except Exception:  # whatever rosbags raises at bytes of another form: no reply is one to them
                return
            put(lambda: handle(request, asked))

        return receive

    def _send_goal(self, request: Request, asked: Any) -> None:
        goal_id = bytes(asked.goal_id.uuid)
        is_new = goal_id not in self._goals
        stamp = self._build.stamp(self._clock.unix_ns())
        self._reply(request, _SEND, accepted=is_new, stamp=stamp)
        if not is_new:
            return
        info = self._build.make("action_msgs/msg/GoalInfo", asked.goal_id, stamp)
        goal = self._goals[goal_id] = _Goal(info)
        for old in [one for one, other in self._goals.items() if other.status not in _ACTIVE][:-_MOST_GOALS]:
            del self._goals[old]

        def tell(done: int, left: int) -> None:
            if self._feedback.is_read:
                feedback = self._build.make(f"{_ACTION}_Feedback", done, left)
                message = self._build.make(_FEEDBACK.message, asked.goal_id, feedback)
                self._feedback.put(self._build.encode(message, _FEEDBACK))

        try:
            goal.steps = self._begin(int(asked.goal.steps), lambda outcome: self._end(goal, outcome), tell)
        except RefusedError as error:
            self._end(goal, Outcome(error.code, str(error)))
        else:
            self._publish_status()

    def _end(self, goal: _Goal, outcome: Outcome) -> None:
        ended = GoalStatus.SUCCEEDED if outcome.code == Code.OK else GoalStatus.ABORTED
        goal.status = GoalStatus.CANCELED if outcome.is_canceled else ended
        goal.result = self._build.make(f"{_ACTION}_Result", self._result(outcome.code, outcome.reason))
        for request in goal.waiting:
            self._reply(request, _GET, status=int(goal.status), result=goal.result)
        goal.waiting.clear()
        self._publish_status()

    def _get_result(self, request: Request, asked: Any) -> None:
        goal = self._goals.get(bytes(asked.goal_id.uuid))
        if goal is None:
            self._reply(request, _GET)  # status 0: unknown
        elif goal.result is None:
            goal.waiting.append(request)
        else:
            self._reply(request, _GET, status=int(goal.status), result=goal.result)

    def _cancel_goal(self, request: Request, asked: Any) -> None:
        """Cancel a goal, or with the id 0 all of them."""
        goal_id = bytes(asked.goal_info.goal_id.uuid)
        named = [goal for one, goal in self._goals.items() if one == goal_id or not any(goal_id)]
        active = [goal for goal in named if goal.status in _ACTIVE and goal.steps is not None]
        for goal in active:
            goal.status = GoalStatus.CANCELING
            assert goal.steps is not None
            goal.steps.cancel()
        code = 0 if active or not any(goal_id) else _GOAL_ENDED if named else _UNKNOWN_GOAL
        self._reply(request, _CANCEL, return_code=code, goals_canceling=[goal.info for goal in active])
        self._publish_status()

    def _publish_status(self) -> None:
        rows = [
            self._build.make("action_msgs/msg/GoalStatus", goal.info, int(goal.status)) for goal in self._goals.values()
        ]
        self._status.put(self._build.encode(self._build.make(_STATUS.message, rows), _STATUS))

    def _reply(self, request: Request, topic_type: TopicType, **fields: Any) -> None:
        response = f"{topic_type.message}_Response"
        request.reply(self._build.encode(self._build.filled(response, fields), TopicType(response)))
