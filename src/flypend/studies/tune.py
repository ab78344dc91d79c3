"""Gains tuned on a study by CMA-ES, with many flights per generation; the report uses held-out starts."""

from __future__ import annotations

import hashlib
import json
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend import errors, signals
from flypend.errors import InputError
from flypend.files.reading import parse_json, read_bytes
from flypend.files.schema import Field, check_arrays
from flypend.flight.ensemble import fly_many
from flypend.flight.metrics import Count
from flypend.laws import BoundLaw, Controller
from flypend.model import State
from flypend.model.state import SHAPES
from flypend.plants import AnyPlant, Sampled
from flypend.plants.bands import check_bands
from flypend.settings.laws import law_from
from flypend.settings.runfile import record_at
from flypend.studies.bands import worlds_within
from flypend.studies.sweep import cube
from flypend.studies.sweep.chunk import program_digest
from flypend.studies.sweep.design import design
from flypend.studies.sweep.study import Study, canonical
from flypend.studies.sweep.study import study as study_from

KEYS = ("gains", "objective", "bands", "runs", "generations", "population", "seed", "step")
# What is tuned of a law that has them and no study names others, and how far each may go either way.
STANDARD = ("position_bandwidth", "height_bandwidth", "rod_bandwidth", "attitude_bandwidth", "throw_speed",
            "flip_speed", "catch_time")  # fmt: skip
SPAN = 1.6
# The settling time of a failed run counts as LATE durations; excursion (m) and effort are capped at FAR.
LATE, FAR = 2.0, 100.0
MOST_REPORTED = 20_000
DRAWN, MOST_DRAWN = 32, 64  # vehicles; gains tuned on eight fit those eight, and are no better on others
# The file of the costs: this word, and bytes, of which a generation takes some 300.
KIND, MOST_BYTES = "flypend tune 2", 2**26
GENERATION = {"costs": Field(("point",))}


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Objective:
    """The objective that tuning minimises: a weighted sum of means over the runs.

    Parameters
    ----------
    failure : float
        Weight of the failure rate.
    settling : float
        Weight of the settling time over the duration; a failed run counts as 2.
    excursion : float
        Weight of the largest distance from the reference, m, capped at 100 m.
    effort : float
        Weight of the effort, capped at 100.
    """

    failure: float = 1.0
    settling: float = 1.0
    excursion: float = 0.0
    effort: float = 0.0

    def __post_init__(self) -> None:
        for entry in fields(self):
            errors.number(f"tune.objective.{entry.name}", getattr(self, entry.name), at_least=0)

    def cost(self, columns: Mapping[str, Any], duration: float) -> Any:
        """Return the cost of each run (n,) of `duration` s, from the fields of `Metrics` in `columns`."""
        success = columns["success"]
        settling = np.where(success, columns["settling"], LATE * duration) / duration
        excursion, effort = (np.fmin(columns[name], FAR) for name in ("excursion", "effort"))  # FAR for NaN, too
        whole = self.failure * ~success + self.settling * settling + self.excursion * excursion
        return whole + self.effort * effort


@errors.named_arguments
@dataclass(frozen=True, eq=False)
class Tuned:
    """The result of tuning.

    Parameters
    ----------
    study : Study
        The study.
    gains : dict
        The best gains.
    before, after : dict
        Of the law as it was and with the tuned gains given, as a run file of `settings` flies it: cost, success rate
        with its Wilson interval (None for starts of a Sobol sequence), settling time and excursion, on the starts of
        the study (at most 20 000), held out from tuning.
    history : list of dict
        By generation: runs flown so far, best and median cost on the tuning starts, and the centre of the search.
    """

    study: Study
    gains: dict[str, float]
    before: dict[str, Any]
    after: dict[str, Any]
    history: list[dict[str, Any]]

    def settings(self) -> dict[str, Any]:
        """Return the content of a run file with the tuned gains, for `flypend run`: the first flight of `after`."""
        from_study = self.study.settings
        start = State.trusted(design(self.study, 0, 1, cube.REPORTED).packed[0])
        kept = {key: from_study[key] for key in ("duration", "rtol", "plant", "vehicle")}
        return {
            **kept,
            "law": _law_with(self.study, self.gains),
            "start": {name: getattr(start, name).tolist() for name in SHAPES},
        }


@errors.named_arguments
@signals.defer()
def tune(
    study: Study | str | Path | Mapping[str, Any],
    *,
    workers: int | None = None,
    costs: str | Path | None = None,
    progress: Callable[[int, int], Any] = lambda *_: None,
) -> Tuned:
    """Tune gains on the objective of a study, by CMA-ES in the logarithm of the gains.

    The table `tune` of the study has the keys `gains`, a table of [low, high] (for `inverted` by default the bandwidths
    and speeds in `STANDARD`, up to `SPAN` times larger or smaller); `objective`, the weights of `Objective`; `bands`,
    how many vehicles are drawn from the vehicle's bands to be flown beside it in turn (default 0; the report draws
    others); `runs` per gain vector (default 200); `generations` (30); `population` (default that of CMA-ES); `step`
    (0.2, the initial standard deviation over the range); and `seed` (1). Every gain vector flies the same starts.

    Parameters
    ----------
    study : Study, path or dict
        As in `sweep`. Its runs serve for the report only.
    workers : int, optional
        Threads; default one per core.
    costs : path, optional
        File that keeps the costs of every generation as it is flown. With the same file and study, an interrupted
        search resumes, with the same result.
    progress : callable
        Called with `(generation, generations)`.

    Raises
    ------
    InputError
        If the study is invalid, varies gains or a grid, or asks for bands that its vehicle lacks; if `costs` belongs
        to another search, or cannot be written.
    """
    errors.require("cma", extra="studies", for_="tune")
    made = study if isinstance(study, Study) else study_from(study)
    task = _Task(made)
    search = _search(task)
    bands = made.flight.vehicle.bands if task.bands else ""
    identity = f"{canonical({**made.settings, 'tune': made.tune})}{program_digest(made)}{bands}"
    kept = _Costs(None if costs is None else Path(costs), identity)
    history: list[dict[str, Any]] = []
    best, least = task.start, np.inf
    progress(min(kept.generations, task.generations), task.generations)
    for generation in range(task.generations):
        points = np.clip(search.ask(), 0.0, 1.0)
        found = kept.of(generation, len(points))
        if found is None:
            found = task.costs(points, workers)
            kept.keep(generation, found)
        search.tell(list(points), found.tolist())
        if found.min() < least:
            least, best = float(found.min()), points[np.argmin(found)]
        flown = (generation + 1) * len(points) * task.runs
        centre = task.gains(np.clip(search.mean, 0, 1))
        history.append({"runs": flown, "best": least, "median": float(np.median(found)), "centre": centre})
        progress(generation + 1, task.generations)
        if search.stop():
            break
    gains = task.gains(best)
    own = {name: made.law.numbers[name] for name in gains}
    tuned = law_from(_law_with(made, gains)).bind(made.flight.vehicle)
    return Tuned(made, gains, task.report(made.law, own, workers), task.report(tuned, gains, workers), history)


def _law_with(study: Study, gains: Mapping[str, float]) -> dict[str, Any]:
    """The table of the law of `study` with these `gains`."""
    law: dict[str, Any] = study.settings["law"]
    return {**law, "gains": {**law.get("gains", {}), **gains}}


class _Costs:
    """The costs of a search by generation, in a file from which it resumes if it was interrupted; None keeps none.

    The points of a generation follow from the seed and from earlier costs, so only costs are kept. `identity` is all
    that the search depends on. Raises InputError if the file belongs to another search or cannot be read.
    """

    def __init__(self, path: Path | None, identity: str) -> None:
        self._path = path
        self._head = f"{KIND} {hashlib.sha256(identity.encode()).hexdigest()}"
        self._known = [] if path is None else self._read(path)

    def _read(self, path: Path) -> list[NDArray[np.float64]]:
        try:
            head, *lines = read_bytes(path, MOST_BYTES).decode("utf-8").split("\n")
        except FileNotFoundError:
            return []
        except InputError:
            raise
        except (OSError, ValueError) as error:
            raise InputError(str(path), "a file of costs that can be read", error) from None
        if head != self._head:
            wanted = "the costs of this search (remove the file to start over)"
            raise InputError(str(path), wanted, "those of another study, or another file")
        found: list[NDArray[np.float64]] = []
        for line in lines:  # up to the first one that was not written to its end, or holds other than costs
            try:
                values, check = parse_json(line)
                costs = check_arrays(GENERATION, {"costs": values})["costs"]
            except (ValueError, TypeError):
                break
            if check != _check(costs):
                break
            found.append(costs)
        return found

    @property
    def generations(self) -> int:
        """Number of generations that are known."""
        return len(self._known)

    def of(self, generation: int, size: int) -> NDArray[np.float64] | None:
        """Return the costs (size,) of a generation; None if they are not known."""
        known = self._known[generation] if generation < len(self._known) else None
        return known if known is not None and known.shape == (size,) else None

    def keep(self, generation: int, costs: NDArray[np.float64]) -> None:
        """Keep the costs of a generation. Raises InputError if the file cannot be written."""
        self._known = [*self._known[:generation], costs]
        if self._path is None:
            return
        lines = [self._head, *(json.dumps([each.tolist(), _check(each)]) for each in self._known)]
        partial = self._path.with_name(f".{self._path.name}.partial")
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            partial.write_text("\n".join(lines) + "\n", encoding="utf-8")
            partial.replace(self._path)
        except OSError as error:
            wanted = "a file that can be written (rerun to resume)"
            raise InputError(str(self._path), wanted, error.strerror or error) from None


def _check(costs: NDArray[np.float64]) -> str:
    return hashlib.sha256(costs.tobytes()).hexdigest()[:16]


class _Task:
    """What the table `tune` of a study asks for. A point of the unit cube maps to gains, evenly in the logarithm."""

    def __init__(self, study: Study) -> None:
        table, self.study = study.tune, study
        errors.only_known("tune", table, KEYS)
        if study.grid or study.gains:
            raise InputError("vary", "starts that are drawn, where gains are tuned", "a grid, or gains")
        if study.sampling == "latin":
            raise InputError("sampling", "'uniform' or 'sobol', where gains are tuned", "'latin'")
        limits = _limits(study)
        self.names, (self.low, self.high) = tuple(limits), np.array(list(limits.values())).T
        self.objective = record_at(table, "objective", Objective, "tune.objective")
        self.bands = errors.integer("tune.bands", table.get("bands", 0), 0, MOST_DRAWN)
        if self.bands and not isinstance(study.flight.plant, Sampled):
            raise InputError("tune.bands", "a sampled plant, such as rotors", "the ideal plant")
        if self.bands:
            check_bands(study.flight.vehicle)
        self.runs = errors.integer("tune.runs", table.get("runs", 200), 1)
        self.generations = errors.integer("tune.generations", table.get("generations", 30), 1)
        population = table.get("population")
        self.population = None if population is None else errors.integer("tune.population", population, 2)
        self.step = errors.number("tune.step", table.get("step", 0.2), above=0)
        self.seed = errors.integer("tune.seed", table.get("seed", 1), 1)

    @property
    def start(self) -> Any:
        """The initial gains as a point."""
        own = np.array([self.study.law.numbers[name] for name in self.names])
        return np.clip(np.log(own / self.low) / np.log(self.high / self.low), 0.0, 1.0)

    def gains(self, point: Any) -> dict[str, float]:
        """Return the gains at a point, rounded to six significant digits."""
        values = self.low * (self.high / self.low) ** np.asarray(point)
        return {name: float(f"{value:.6g}") for name, value in zip(self.names, values, strict=True)}

    def costs(self, points: Any, workers: int | None) -> Any:
        """Return the mean cost of each of `points`, all flown in one call from the tuning starts."""
        values = np.array([list(self.gains(point).values()) for point in points])
        columns = self._fly(self.study.law, self.names, values, self.runs, cube.TUNED, workers)
        return self.objective.cost(columns, self.study.flight.duration).mean(axis=1)

    def report(self, law: BoundLaw | Controller, gains: dict[str, float], workers: int | None) -> dict[str, Any]:
        """Return the statistics of a `law` with these `gains` on the first `MOST_REPORTED` starts of the study."""
        runs = min(self.study.samples, MOST_REPORTED)
        columns = self._fly(law, (), np.empty((1, 0)), runs, cube.REPORTED, workers)
        success = columns["success"]
        independent = self.study.sampling == "uniform"
        worlds = np.array_split(success[0], self.bands + 1)  # as `_fly` returns them
        count = Count.together(Count(int(part.sum()), len(part)) for part in worlds)
        low, high = count.interval if independent else (None, None)
        settled = columns["settling"][success]
        return {
            "gains": gains,
            "cost": float(self.objective.cost(columns, self.study.flight.duration).mean()),
            "runs": runs,
            "success": float(success.mean()),
            "wilson_low": low,
            "wilson_high": high,
            "settling_p50": float(np.median(settled)) if len(settled) else None,
            "excursion_p95": float(np.percentile(np.nan_to_num(columns["excursion"], nan=np.inf), 95)),
        }

    def _fly(
        self, law: BoundLaw | Controller, names: Sequence[str], values: Any, runs: int, stream: int, workers: int | None
    ) -> dict[str, Any]:
        """Metrics (k, runs) of `runs` runs of a `law` under each of k rows of `values` of the gains `names`.

        The runs fly on each world in turn.
        """
        flight = self.study.flight.replace(law=law)
        worlds: list[AnyPlant] = [flight.plant]
        if self.bands and isinstance(flight.plant, Sampled):  # those of vehicles drawn, others for the report
            seed = 2 * self.seed + (stream == cube.REPORTED)
            worlds = list(worlds_within(flight.vehicle, flight.plant, seed, self.bands).values())
        if stream == cube.TUNED:  # its own noise, too
            flight = flight.replace(seed=(flight.seed or 0) + 2**32)
        starts = design(self.study, 0, runs, stream).packed
        found = []
        for i, world in enumerate(worlds[:runs]):
            own, seed = starts[i :: len(worlds)], (flight.seed or 0) + i * runs * len(values)
            gains = dict(zip(names, np.repeat(values, len(own), axis=0).T, strict=True))
            packed = State.trusted(np.tile(own, (len(values), 1)))
            one = flight.replace(starts=packed, gains=gains, plant=world, seed=seed)
            flown = fly_many(one, workers=workers).columns
            found.append({name: column.reshape(len(values), len(own)) for name, column in flown.items()})
        return {name: np.concatenate([one[name] for one in found], axis=1) for name in found[0]}


def _limits(made: Study) -> dict[str, tuple[float, float]]:
    """Return the range of each gain to be tuned, in the order of the law's gains. Raises InputError."""
    bounds = made.tune.get("gains")
    if bounds is None and set(STANDARD) <= made.law.numbers.keys():
        bounds = {name: [made.law.numbers[name] / SPAN, made.law.numbers[name] * SPAN] for name in STANDARD}
    if not isinstance(bounds, Mapping) or not bounds:
        raise InputError("tune.gains", "a table of gains, each [least, largest]", repr(bounds))
    errors.only_known("tune.gains", bounds, made.law.numbers)
    limits = {}
    for name, value in bounds.items():
        low, high = errors.array(f"tune.gains.{name}", value, (2,)).tolist()
        made.law.check_gain(name, (low, high), "tune.gains")
        if not 0 < low < high:
            raise InputError(f"tune.gains.{name}", "0 < least < largest", [low, high])
        if not low <= made.law.numbers[name] <= high:
            raise InputError(f"tune.gains.{name}", f"a range around {made.law.numbers[name]:g}", [low, high])
        limits[name] = (low, high)
    return {name: limits[name] for name in made.law.numbers if name in limits}


def _search(task: _Task) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # cma warns about missing optional packages
        import cma
    options = {"bounds": [0.0, 1.0], "seed": task.seed, "verbose": -9, "verb_log": 0}
    if task.population is not None:
        options["popsize"] = task.population
    return cma.CMAEvolutionStrategy(list(task.start), task.step, options)
