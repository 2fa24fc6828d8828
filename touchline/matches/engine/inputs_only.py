"""Recordings of inputs alone: small, and enough to simulate the match again."""

from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import RecordingConfig
from schemas.topics import ACTION, APPLIED, PARAMETERS, SCENE, SETUP

KEYS = tuple(topic.key for topic in (SETUP, APPLIED, ACTION, PARAMETERS, SCENE))
"""What a recording needs so that the match can be simulated again, and no more."""


def with_inputs_only(config: MatchConfig) -> MatchConfig:
    """The match with a recording of its inputs alone."""
    record = RecordingConfig(include=list(KEYS), viz=False, wait=config.record.wait)
    return config.model_copy(update={"record": record})


def has_inputs_only(config: MatchConfig) -> bool:
    """Whether figures cannot be computed from the recording of a match."""
    return tuple(config.record.include) == KEYS
