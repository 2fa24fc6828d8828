"""Numbers of simulation_interfaces: results, states, features, categories of entities, scopes of a reset."""

from enum import IntEnum, IntFlag


class Code(IntEnum):
    """`Result.result`; numbers above 100 have the meaning that their service gives them."""

    UNSUPPORTED = 0
    OK = 1
    NOT_FOUND = 2
    INCORRECT_STATE = 3
    FAILED = 4
    ALREADY_IN_TARGET_STATE = 101
    """Of SetSimulationState."""
    INVALID_POSE = 101
    """Of SetEntityState."""
    NAME_NOT_UNIQUE = 101
    """This and the next ones: of SpawnResult, and of SpawnEntity."""
    NAME_INVALID = 102
    UNSUPPORTED_FORMAT = 103
    NO_RESOURCE = 104
    NAMESPACE_INVALID = 105
    RESOURCE_PARSE_ERROR = 106
    INVALID_SPAWN_POSE = 109
    SPAWN_FAILED = 150
    """Of SpawnEntities: at least one of them."""


class State(IntEnum):
    """`SimulationState.state`."""

    STOPPED = 0
    PLAYING = 1
    PAUSED = 2


class Feature(IntEnum):
    """What is implemented here, of `SimulatorFeatures.features`."""

    SPAWNING = 0
    DELETING = 1
    ENTITY_CATEGORIES = 8
    SPAWNING_RESOURCE_STRING = 9
    ENTITY_STATE_GETTING = 10
    ENTITY_STATE_SETTING = 11
    SIMULATION_RESET = 20
    SIMULATION_RESET_STATE = 22
    SIMULATION_RESET_SPAWNED = 23
    SIMULATION_STATE_GETTING = 24
    SIMULATION_STATE_SETTING = 25
    SIMULATION_STATE_PAUSE = 26
    STEP_SIMULATION_SINGLE = 31
    STEP_SIMULATION_MULTIPLE = 32
    STEP_SIMULATION_ACTION = 33
    SPAWNING_ENTITIES = 50


class Category(IntEnum):
    """`EntityCategory.category`."""

    ROBOT = 1
    DYNAMIC_OBJECT = 4
    STATIC_OBJECT = 5


class Bounds(IntEnum):
    """`Bounds.type`."""

    EMPTY = 0
    SPHERE = 3


class Scope(IntFlag):
    """`ResetSimulation.scope`; 0 stands for all."""

    TIME = 1
    STATE = 2
    SPAWNED = 4


class GoalStatus(IntEnum):
    """`GoalStatus.status` of an action."""

    EXECUTING = 2
    CANCELING = 3
    SUCCEEDED = 4
    CANCELED = 5
    ABORTED = 6


class RefusedError(Exception):
    """A request that is not carried out."""

    def __init__(self, code: Code, reason: str) -> None:
        super().__init__(reason)
        self.code = code
