"""What tests of exported boards share: what Python's board commands, and a vehicle unlike the others."""

import numpy as np

from flypend.board.program import initial_memory
from flypend.export import records, vectors
from flypend.plants.loop import Loop
from flypend.plants.plant import Sampled


def commands(vehicle, law, states, targets, rate=500.0):
    """Rotor forces (n, 4) of Python's board that began at hover and sees these states, each with a place to hold."""
    loop, path = Loop(vehicle, law.bind(vehicle), Sampled(rate=rate)), np.zeros(records.PATH.length)
    memory, found = initial_memory(loop, np.full(4, vehicle.weight / 4)), []
    for state, path[:3] in zip(states, targets, strict=True):
        answer = vectors.board_step(loop)(memory, np.append(0.0, state.packed()), path, [], [])
        memory, command = (np.array(value).ravel() for value in answer)
        found.append(command)
    return np.array(found)


def hexarotor(vehicle):
    """`vehicle` with six rotors and a full inertia matrix."""
    angles = np.deg2rad([30, 90, 150, 210, 270, 330])
    return vehicle.replace(
        inertia=((4e-3, 2e-4, -1e-4), (2e-4, 5e-3, 3e-4), (-1e-4, 3e-4, 7e-3)),
        rotor_positions=np.stack([0.2 * np.cos(angles), 0.2 * np.sin(angles), 0 * angles], axis=1),
        rotor_spins=(1, -1, 1, -1, 1, -1),
    )
