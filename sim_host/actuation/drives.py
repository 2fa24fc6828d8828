"""The table of drives: which class moves the robots of each drive model."""

from sim_host.actuation.differential_drive import DifferentialDrive
from sim_host.actuation.drive_model import DriveModel
from sim_host.actuation.omni_drive import OmniDrive
from sim_host.actuation.traction_drive import TractionDrive
from sim_host.actuation.velocity_drive import VelocityDrive

DRIVES: dict[str, type[DriveModel]] = {
    "velocity": VelocityDrive,
    "traction": TractionDrive,
    "omni": OmniDrive,
    "differential": DifferentialDrive,
}
"""Word of `schemas.config.sections.DriveLimits.model` → its drive."""
