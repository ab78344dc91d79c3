"""The command that learns a law."""

from __future__ import annotations

from pathlib import Path

import click

from flypend.cli.options import bands_option, out_option, plant_asked, sensors_option, vehicle_option, within_bands
from flypend.cli.terminal import bold, console, counter, resumable

CHECKPOINT = "checkpoint.npz"
OFTEN = 100  # updates between checkpoints
HELD_OUT = 10**6  # added to the seed: the starts of the judgement are none of the training


@click.command()
@vehicle_option
@out_option("learn-out")
@click.option("--seed", type=click.IntRange(min=0), default=0, help="Seed of the initial weights and of the starts.")
@click.option("--mount", help="What carries the rod: gimbal or hub; default the vehicle's own.")
@bands_option
@sensors_option
@click.option("--updates", type=click.IntRange(min=1), help="Gradient updates; default 1500, on a hub 1200.")
@click.option("--runs", type=click.IntRange(min=1), default=500, help="Number of flights that evaluate the result.")
def learn(
    vehicle: str, out: Path, seed: int, mount: str | None, bands: bool, sensors: str, updates: int | None, runs: int
) -> None:
    """Learn a law for VEHICLE: a small network that imitates the inverted law and then improves on it.

    Writes the training curve and the policy. To fly the policy, use its file as --law. After an interruption, the same
    command resumes, with the same result.

    With --bands, training flies machines drawn from the bands of VEHICLE, with late commands; with --sensors, the
    network sees states with the errors of an estimator. The result is compared with the inverted law on other such
    machines, with these sensors.
    """
    from flypend import model
    from flypend.files.staging import check_writable
    from flypend.laws import inverted, learned, lqr
    from flypend.learning.training import Learner, usual
    from flypend.plants import as_sampled
    from flypend.report.learning import write_learned
    from flypend.report.studies import comparison_table
    from flypend.settings.runfile import plant_of
    from flypend.studies import compare, random_starts
    from flypend.studies.advice import best_of
    from flypend.studies.starts import check_starts

    machine = model.vehicle(vehicle)
    if mount is not None:
        machine = machine.replace(mount=mount)
    check_starts(runs, HELD_OUT + seed)
    asked = plant_asked("rotors", sensors)
    world = as_sampled(plant_of(asked))
    learner = Learner(usual(machine, seed, updates, bands, world.sensors))
    check_writable(out)
    out.mkdir(parents=True, exist_ok=True)
    checkpoint = out / CHECKPOINT
    with resumable(), counter() as tell:
        if not learner.resume(checkpoint):
            learner.imitate(lambda entry: tell("imitation", int(entry.update), learner.training.rounds))
            learner.save(checkpoint)
        while learner.done < learner.training.updates:
            learner.descend()
            tell("descent", learner.done, learner.training.updates)
            if learner.done % OFTEN == 0 or learner.done == learner.training.updates:
                learner.save(checkpoint)
    policy = write_learned(learner, out)
    console.print(f"The policy is {bold(policy)}, its training {bold(out / 'curve.png')}.")
    laws, starts = [learned(policy=str(policy)), inverted()], random_starts(runs, HELD_OUT + seed)
    if not bands:  # LQR flies few of these starts as written, too, and a machine takes long to compile
        laws.append(lqr())
    worlds = list(within_bands(machine, asked, HELD_OUT + seed).values()) if bands else [world]
    comparison = compare(machine, laws, starts, plant=worlds)
    console.print(comparison_table(comparison))
    best = best_of(comparison.ensembles)
    console.print(f"The best law here is {best}." if best else "None of these laws succeeds from 90 % of the starts.")
