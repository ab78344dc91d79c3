"""Plants: from the ideal closed loop to rotor limits, lag, sampling, delay, noise, wind and a second engine."""

from flypend.plants.noise import MOTION_CAPTURE, Noise
from flypend.plants.plant import (
    PRESETS,
    ROTORS,
    AnyPlant,
    Ideal,
    Plant,
    Sampled,
    Wind,
    as_sampled,
    plant,
)
from flypend.plants.sensors import SUITES, Sensor, Sensors

__all__ = [
    "MOTION_CAPTURE",
    "PRESETS",
    "ROTORS",
    "SUITES",
    "AnyPlant",
    "Ideal",
    "Noise",
    "Plant",
    "Sampled",
    "Sensor",
    "Sensors",
    "Wind",
    "as_sampled",
    "plant",
]
