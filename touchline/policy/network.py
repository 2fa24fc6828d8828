"""A small network of NumPy, for policies that evolution finds: layers with tanh, in a file without other libraries."""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from schemas.errors import TouchlineError

Layer = tuple[NDArray[np.float32], NDArray[np.float32]]
"""Weights of shape (outputs, inputs), and offsets of shape (outputs,)."""


class Network:
    """A `touchline.policy.policy.Policy`: layers of tanh units, also the last, so that actions are within ±1."""

    def __init__(self, layers: Sequence[Layer]) -> None:
        self._layers = list(layers)
        self.observations = self._layers[0][0].shape[1]
        """Numbers in an observation."""
        self.actions = self._layers[-1][0].shape[0]
        """Numbers in an action."""

    @staticmethod
    def size(sizes: Sequence[int]) -> int:
        """How many parameters a network with these numbers of units has, from observation to action."""
        return sum((before + 1) * after for before, after in pairwise(sizes))

    @classmethod
    def of(cls, parameters: NDArray[np.floating], sizes: Sequence[int]) -> Self:
        """The network with these parameters, shape (size,): weights and offsets layer by layer.

        Raises:
            TouchlineError: another number of parameters.
        """
        if parameters.shape != (cls.size(sizes),):
            raise TouchlineError(
                f"a network of {'-'.join(map(str, sizes))} units has {cls.size(sizes)} parameters, in one row; "
                f"given are {parameters.shape}"
            )
        layers, rest = [], parameters.astype(np.float32)
        for before, after in pairwise(sizes):
            weights, offsets, rest = np.split(rest, [before * after, (before + 1) * after])
            layers.append((weights.reshape(after, before), offsets))
        return cls(layers)

    def action(self, observation: NDArray[np.float32]) -> NDArray[np.float32]:
        """The action for an observation."""
        units = observation
        for weights, offsets in self._layers:
            units = np.tanh(weights @ units + offsets)
        return units

    def save(self, path: Path) -> None:
        """Write the network into a file, whose name gets the ending `.npz` where it has another."""
        arrays: dict[str, Any] = {}
        for number, (weights, offsets) in enumerate(self._layers):
            arrays |= {f"weights{number}": weights, f"offsets{number}": offsets}
        np.savez(path, allow_pickle=False, **arrays)

    @classmethod
    def load(cls, path: Path) -> Self:
        """The network in a file.

        Raises:
            TouchlineError: the file holds something else.
        """
        try:
            with np.load(path, allow_pickle=False) as arrays:
                count = len(arrays.files) // 2
                layers = [(arrays[f"weights{number}"], arrays[f"offsets{number}"]) for number in range(count)]
            fit = all(w.ndim == 2 and b.shape == w.shape[:1] and w.dtype == b.dtype == np.float32 for w, b in layers)
            chained = all(before.shape[0] == after.shape[1] for (before, _), (after, _) in pairwise(layers))
            if not layers or not fit or not chained:
                raise ValueError("its layers do not fit")
            if not all(np.isfinite(array).all() for layer in layers for array in layer):
                raise ValueError("it has numbers that are not finite")
        except Exception as error:  # whatever NumPy and zipfile raise at bytes of another form
            raise TouchlineError(f"{path} is no saved network ({' '.join(str(error).split())})") from None
        return cls(layers)
