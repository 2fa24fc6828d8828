"""Policies in files: what the brain `policy:FILE` plays."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from schemas.errors import TouchlineError
from touchline.policy.network import Network


class Policy(Protocol):
    """A function from an observation to an action, both vectors of 32-bit numbers."""

    observations: int
    """Numbers in an observation."""
    actions: int
    """Numbers in an action."""

    def action(self, observation: NDArray[np.float32]) -> NDArray[np.float32]:
        """The action for an observation; equal observations have equal actions."""


class StableBaselinesPolicy:
    """A policy that Stable-Baselines3 has saved; its most likely action is taken."""

    def __init__(self, path: Path) -> None:
        """PyTorch is imported here.

        Raises:
            TouchlineError: Stable-Baselines3 is not installed, or the file is none of its models.
        """
        try:
            import torch
            from stable_baselines3.common.save_util import load_from_zip_file
        except ImportError as error:
            raise TouchlineError(f"{path} needs {error.name}; run pip install stable-baselines3") from None
        torch.set_num_threads(1)  # a network of this size is slower on more, and robots share the machine
        try:
            data, parameters, _ = load_from_zip_file(path, device="cpu")
            assert data is not None and parameters is not None
            make, settings = data["policy_class"], data.get("policy_kwargs", {})
            spaces = data["observation_space"], data["action_space"]
            settings |= {"use_sde": True} if data.get("use_sde") else {}  # not all kinds of policies take it
            self._policy: Any = make(*spaces, lr_schedule=lambda _: 0.0, **settings)
            self._policy.load_state_dict(parameters["policy"])
            (self.observations,), (self.actions,) = (space.shape for space in spaces)
        except Exception as error:
            reason = " ".join(f"{type(error).__name__}: {error}".split())
            raise TouchlineError(f"{path} is no model of Stable-Baselines3 of vectors ({reason})") from None
        self._policy.set_training_mode(False)

    def action(self, observation: NDArray[np.float32]) -> NDArray[np.float32]:
        """The most likely action."""
        action: NDArray[np.float32] = self._policy.predict(observation, deterministic=True)[0]
        return action


FORMATS: dict[str, Callable[[Path], Policy]] = {".npz": Network.load, ".zip": StableBaselinesPolicy}
"""Suffix → how a policy is read from such a file."""


def load_policy(path: Path) -> Policy:
    """The policy in a file: `.npz` of a `touchline.policy.network.Network`, or `.zip` of Stable-Baselines3.

    Raises:
        TouchlineError: there is no such file, or it holds no policy.
    """
    if path.suffix not in FORMATS:
        raise TouchlineError(f"{path} is no policy; its name ends in {' or '.join(FORMATS)}")
    if not path.is_file():
        raise TouchlineError(f"there is no policy {path}")
    return FORMATS[path.suffix](path)
