"""The brain that plays a policy: `brain = "policy:FILE"` in a match file."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from robot_agent.sdk.contract import Brain, Briefing
from schemas.errors import TouchlineError
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from touchline.policy.control import Control
from touchline.policy.interface import Interface
from touchline.policy.observation import Observation
from touchline.policy.policy import Policy, load_policy


class PolicyBrain:
    """Observes, decides and acts exactly as the environment does in which the policy was trained."""

    def __init__(self, briefing: Briefing, policy: Policy, corrected: Brain | None = None) -> None:
        """Plays the policy for the robot of this briefing, or corrects a brain by it.

        Raises:
            TouchlineError: the policy is for other observations or actions than this robot has.
        """
        self._observation, self._control, self._policy = Observation(briefing), Control(briefing), policy
        for what, has, needs in (
            ("observations", len(self._observation.entries), policy.observations),
            ("actions", len(self._control.entries), policy.actions),
        ):
            if has != needs:
                raise TouchlineError(
                    f"the policy is for {what} of {needs} numbers; {briefing.robot} has {has} in this match: "
                    "play it in its task, with the [teams.*.parameters] that it was trained with"
                )
        self._corrected = corrected
        self._action: NDArray[np.float32] = np.zeros(policy.actions, np.float32)
        self._decided = -1

    @classmethod
    def of_file(cls, briefing: Briefing, path: Path, load: Callable[[str], Brain]) -> "PolicyBrain":
        """The brain of a policy in a file; `load` makes the brain that it corrects, where a parameter names one.

        Raises:
            TouchlineError: there is no policy in it that suits this robot, or no brain for it to correct.
        """
        corrects = Interface.of(briefing.parameters).corrects
        return cls(briefing, load_policy(path), load(corrects) if corrects else None)

    def act(self, sight: Sight) -> Command:
        """The command for one tick; a new action is decided every `decision_ticks`, and after a sight was missed.

        Raises:
            ValueError: the policy's action is not finite.
        """
        period = sight.tick // self._control.decision_ticks
        is_new = period != self._decided
        if is_new:
            self._decided = period
            self._action = self._policy.action(self._observation.observe(sight))
            if not np.isfinite(self._action).all():
                raise ValueError(f"the policy's action is {self._action.tolist()}; robots move by finite numbers")
        record = sight.game.robots.get(sight.robot)
        return self._control.command(
            self._action,
            sight.tick,
            off_field=record is not None and record.off_field is not None,
            can_kick=sight.holding and sight.kicker_ready,
            radio=self._control.message(sight) if is_new else None,
            corrected=self._corrected.act(sight) if self._corrected is not None else None,
        )
