"""From the ideal closed loop towards the machine: limits, lag, sampling, delay, noise, wind, and a second engine."""

from flypend.plants.plant import (
    MOTION_CAPTURE,
    PRESETS,
    ROTORS,
    AnyPlant,
    Ideal,
    Noise,
    Plant,
    Sampled,
    Wind,
    plant,
    sampled_plant,
)

__all__ = [
    "MOTION_CAPTURE",
    "PRESETS",
    "ROTORS",
    "AnyPlant",
    "Ideal",
    "Noise",
    "Plant",
    "Sampled",
    "Wind",
    "plant",
    "sampled_plant",
]
