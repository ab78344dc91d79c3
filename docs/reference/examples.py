"""An example of every public object: the page of an object shows its cell. `tests/test_docs.py` runs them one by one.

A picture in img/api is the one that its cell saves; `python -m benchmarks.pages api` draws them all.
"""

# %% simulate | swing-up.png: A swing-up in twelve pictures, and the path of pivot and rod
import flypend as fp

vehicle, hanging = fp.vehicle("hehn2011"), fp.State(y=(0, 0, -1))
run = fp.simulate(vehicle, fp.laws.inverted(), hanging, duration=6)
print(run.outcome, run.y[-1].round(3))

# %% simulate_ensemble | api/ensemble.png: Settling time of a hundred flights against the height of the rod at the start
import matplotlib.pyplot as plt

import flypend as fp

vehicle, starts = fp.vehicle("hehn2011"), fp.random_starts(100, seed=1)
runs = fp.simulate_ensemble(vehicle, fp.laws.inverted(), starts, duration=10)
print(runs.success.sum(), "of 100")

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.scatter(starts.y[:, 2], runs.settling)
axes.set(xlabel="height of the rod at the start, y₃", ylabel="settling time (s)")
figure.savefig("ensemble.png")

# %% random_starts | api/starts.png: A thousand random rods seen from the side: points that fill a disc
import matplotlib.pyplot as plt

import flypend as fp

starts = fp.random_starts(1000, seed=7)
print(starts.y.shape, starts[0].y)

figure, axes = plt.subplots(figsize=(3, 3), layout="constrained")
axes.scatter(starts.y[:, 0], starts.y[:, 2], s=4)
axes.set(xlabel="y₁", ylabel="y₃", aspect="equal")
figure.savefig("starts.png")

# %% Flight
import flypend as fp

vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0, 0, 1))
flight = fp.Flight(vehicle=vehicle, law=fp.laws.inverted(), starts=start, duration=2.0)
print(flight.law.gains["rod_bandwidth"])  # the law is bound to the vehicle

# %% Tolerances | api/tolerances.png: A tighter tolerance leaves a smaller error, down to rounding
import matplotlib.pyplot as plt
import numpy as np

import flypend as fp

print(fp.Tolerances(rtol=1e-6, method="dp5"))  # of a Flight

flown = {"vehicle": fp.vehicle("hehn2011"), "law": fp.laws.almost_global()}
flown |= {"start": fp.State(y=(0.6, 0, 0.8)), "duration": 2, "plant": "ideal"}
exact = fp.simulate(**flown, rtol=1e-13).y[-1]
rtol = 10.0 ** np.arange(-12, -2)
errors = [np.linalg.norm(fp.simulate(**flown, rtol=one).y[-1] - exact) for one in rtol]

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.loglog(rtol, errors, "o-")
axes.set(xlabel="rtol", ylabel="error of the rod after 2 s")
figure.savefig("tolerances.png")

# %% Trajectory | replay.png: The page that to_html writes: the flight, and plots of rod, thrust and distance
import flypend as fp

vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0.6, 0, 0.8))
run = fp.simulate(vehicle, fp.laws.inverted(), start, duration=3)
print(run.t.shape, run.x.shape, run.rotor_forces.max())  # s, m, N
run.save("run.nc")
run.to_html("run.html")

# %% load
import flypend as fp

vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0, 0, 1))
fp.simulate(vehicle, fp.laws.inverted(), start, duration=1).save("run.nc")
print(fp.load("run.nc").outcome)

# %% Ensemble | api/lean.png: Under an LQR most rods that lean little are caught, and few of the others
import matplotlib.pyplot as plt

import flypend as fp

vehicle, starts = fp.vehicle("hehn2011"), fp.random_starts(400, seed=1)
runs = fp.simulate_ensemble(vehicle, fp.laws.lqr(), starts, duration=8)
print(runs.rate, runs.interval)  # success, and its 95 % interval
print(runs.cause[~runs.success][:3], runs.settling[runs.success][:3])

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
heights = [starts.y[runs.success, 2], starts.y[~runs.success, 2]]
axes.hist(heights, bins=20, stacked=True, label=["succeeds", "fails"])
axes.set(xlabel="height of the rod at the start, y₃", ylabel="runs")
axes.legend()
figure.savefig("lean.png")

# %% Outcome | cause-collided.svg: The rod swings into an arm, where the flight ends
import flypend as fp

vehicle, hanging = fp.vehicle("hehn2011").replace(mount="hub"), fp.State(y=(0, 0, -1))
run = fp.simulate(vehicle, fp.laws.lqr(), hanging, duration=4)
print(run.outcome.status, run.outcome.time, run.outcome.reason)

# %% Criterion | api/criterion.png: The rod's lean falls below the tolerance and stays there for the time to hold
import matplotlib.pyplot as plt
import numpy as np

import flypend as fp

strict = fp.Criterion(rod=0.02, position=0.05, hold=2.0)  # rad, m, s
vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0.6, 0, 0.8))
run = fp.simulate(vehicle, fp.laws.inverted(), start, duration=8)
print(fp.metrics(run, strict).success)

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.semilogy(run.t, np.linalg.norm(run.y - (0, 0, 1), axis=1))
axes.axhline(strict.rod, color="grey", linestyle="--")
axes.axvspan(run.t[-1] - strict.hold, run.t[-1], alpha=0.2)
axes.set(xlabel="t (s)", ylabel="rod from upright, |y − e₃|")
figure.savefig("criterion.png")

# %% metrics, Metrics | api/metrics.png: The pivot's distance over time, with settling time and excursion
import matplotlib.pyplot as plt
import numpy as np

import flypend as fp

vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0.6, 0, 0.8))
run = fp.simulate(vehicle, fp.laws.inverted(), start, duration=6)
found = fp.metrics(run)
print(found.settling, found.excursion)  # s, m

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(run.t, np.linalg.norm(run.x, axis=1))
axes.axvline(found.settling, color="grey", linestyle="--")
axes.axhline(found.excursion, color="grey", linestyle=":")
axes.set(xlabel="t (s)", ylabel="distance of the pivot (m)")
figure.savefig("metrics.png")

# %% recoveries, Recovery | api/recoveries.png: The pivot's distance over time; the recovery is shaded
import matplotlib.pyplot as plt
import numpy as np

import flypend as fp

vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0.6, 0, 0.8))
run = fp.simulate(vehicle, fp.laws.inverted(), start, duration=6)
found = fp.recoveries(run)
for recovery in found:
    print(recovery.time, recovery.distance, recovery.height_lost)  # s, m, m

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(run.t, np.linalg.norm(run.x, axis=1))
for recovery in found:
    axes.axvspan(recovery.begin, recovery.begin + recovery.time, alpha=0.2)
axes.set(xlabel="t (s)", ylabel="distance of the pivot (m)")
figure.savefig("recoveries.png")

# %% State | free-body.svg: The state and the forces: thrust along z at the pivot, tension along the rod y
import flypend as fp

start = fp.State(x=(1, 0, 2), y=(0, 0.6, 0.8), omega=(0, 0, 3))  # m, unit vector, rad/s
print(start.z, start.packed().shape)
print(start.flipped().y)  # the same start with e₃ along gravity

# %% Wrench | free-body.svg: Thrust acts along z at the pivot, the moment about the body axes
import flypend as fp

print(fp.Wrench(thrust=5.4, moment=(0, 0.01, 0)))  # N; N m in the body frame

# %% vehicle | api/crazyflie.png: crazyflie to scale, from above and from the side, with its three mounts
import flypend as fp
from flypend.pictures.machine import machine_figure

vehicle = fp.vehicle("crazyflie")  # or the path of a TOML file
print(vehicle.mass, vehicle.rod_length, vehicle.rotor_limits)  # kg, m, N
machine_figure(vehicle).savefig("crazyflie.png", dpi=100)

# %% Vehicle | machine.png: hehn2011 to scale, from above and from the side, with its three mounts
import flypend as fp

vehicle = fp.vehicle("hehn2011").replace(mass=0.62, rotor_lag=0.035, mount="hub")
print(vehicle.weight, vehicle.l)  # N, m
print(fp.Vehicle(**vehicle.to_dict()) == vehicle)
print(vehicle.to_mjcf().splitlines()[0])  # for MuJoCo
print(vehicle.to_urdf().count("<link"))  # for ROS, Gazebo, Drake, Isaac
print(vehicle.to_sdf().count("<frame"))  # for Gazebo, Drake
parts = {
    "mass": "620 g",
    "arm": "17 cm",
    "propeller": "8x4.5",
    "motor": "920 KV",
    "battery": "3S",
}
mine = fp.Vehicle.estimate(**parts, rod_length="90 cm", rod_mass=0.03, bob_mass=0.04)
print(mine.inertia.diagonal(), mine.bands["inertia"])  # a guess, and its band

# %% Body | machine.png: hehn2011 to scale: discs, arms, and the gaps between them
import flypend as fp

body = fp.Body(disc_radius=0.0635, arm_radius=0.006, hub_radius=0.03)  # m
vehicle = fp.vehicle("hehn2011").replace(mount="hub", body=body)
print(vehicle.body.disc_radius)

# %% Air | api/air.png: The pivot's distance during a swing-up, with air and without
import matplotlib.pyplot as plt
import numpy as np

import flypend as fp

air = fp.Air(rotor_drag=0.05, inflow=0.1, body_drag=(5e-3, 5e-3, 1e-2))
vehicle, start = fp.vehicle("hehn2011").replace(air=air), fp.State(y=(0, 0, -1))

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
for label, plant in {"air": fp.Plant(air="all"), "no air": fp.Plant()}.items():
    run = fp.simulate(vehicle, fp.laws.inverted(), start, 6, plant=plant)
    print(label, fp.metrics(run).success)
    axes.plot(run.t, np.linalg.norm(run.x, axis=1), label=label)
axes.set(xlabel="t (s)", ylabel="distance of the pivot (m)")
axes.legend()
figure.savefig("air.png")

# %% uniform_rod, rod_with_bob | api/rod.png: The more of the mass is in the bob, the longer the equivalent pendulum
import matplotlib.pyplot as plt
import numpy as np

import flypend as fp

vehicle, length = fp.vehicle("hehn2011"), 0.6  # m
print(vehicle.replace(**fp.uniform_rod(0.05, length)).l)  # of a point bob: 2/3 of the rod
rod = fp.rod_with_bob(mass=0.02, length=length, bob_mass=0.04)  # kg, m, kg
print(vehicle.replace(**rod).l)

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
shares = np.linspace(0, 0.95, 40)
rods = [fp.rod_with_bob(0.05 * (1 - share), length, 0.05 * share) for share in shares]
axes.plot(shares, [vehicle.replace(**each).l for each in rods])
axes.axhline(length, color="grey", linestyle="--")
axes.set(xlabel="bob's share of the mass", ylabel="equivalent length l (m)")
figure.savefig("rod.png")

# %% laws.inverted | law-cascade.svg: The cascade of the law: bob, force, thrust axis, moment, rotors
import flypend as fp

law = fp.laws.inverted(rod_bandwidth=7.0)
print(law.gains_for(fp.vehicle("hehn2011"))["rod_bandwidth"])

# %% laws.almost_global | theorem-cascade.svg: The cascade of Theorem B: position, rod, thrust axis, vehicle
import flypend as fp

vehicle, hanging = fp.vehicle("hehn2011"), fp.State(y=(0, 0, -1))
run = fp.simulate(vehicle, fp.laws.almost_global(), hanging, duration=6, plant="ideal")
V = run.signals["V"]
print(V[0], V[-1], (V[1:] <= V[:-1] * (1 + 1e-9)).all())  # it never rises

# %% laws.almost_global_lag | api/lag.png: V falls through the rotors' lag by many powers of ten
import matplotlib.pyplot as plt

import flypend as fp

vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0.6, 0, -0.8))
law, rotors = fp.laws.almost_global_lag(), (3.0, 0.0, 1.0, 2.0)  # N at the start: anything
run = fp.simulate(vehicle, law, start, duration=6, plant=fp.Ideal(lag=True, rotors=rotors))
V = run.signals["V"]
print(V[0], V[-1], (V[1:] <= V[:-1] * (1 + 1e-9)).all())  # it never rises

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.semilogy(run.t, V)
axes.set(xlabel="t (s)", ylabel="V")
figure.savefig("lag.png")

# %% laws.repaired | lyapunov.svg: V along flights under the repaired law falls; under the corrected law it rises first
import flypend as fp

vehicle, start = fp.vehicle("nayak2018"), fp.State(y=(0.8, 0, -0.6))  # e₃ along gravity
run = fp.simulate(vehicle, fp.laws.repaired(), start, duration=8, plant="ideal")
print(run.y[-1].round(3))  # it hangs

# %% laws.supervised | certified-set.svg: Where Theorem B's law takes over: a set around hover, to scale
import flypend as fp

vehicle, hanging = fp.vehicle("hehn2011"), fp.State(y=(0, 0, -1))
law, plant = fp.laws.supervised(first=fp.laws.inverted()), fp.Ideal(limits=True)
run = fp.simulate(vehicle, law, hanging, duration=8, plant=plant)
print(
    fp.metrics(run).success, run.t[run.signals["certified"] == 1][0]
)  # s, at the handover

# %% laws.learned | api/learned.png: The path of the pivot from the side: under the learned law it stays nearer than under the inverted law
import matplotlib.pyplot as plt

import flypend as fp

vehicle, hanging = fp.vehicle("hehn2011"), fp.State(y=(0, 0, -1))

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
for law in (fp.laws.learned(), fp.laws.inverted()):
    run = fp.simulate(vehicle, law, hanging, duration=6)
    print(law.name, fp.metrics(run).success)
    axes.plot(run.x[:, 0], run.x[:, 2], label=law.name)
axes.set(xlabel="x₁ (m)", ylabel="x₃ (m)", aspect="equal")
axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
figure.savefig("learned.png")

# %% laws.lqr | live-lqr.png: An LQR balances a rod that leans a little; lean it further
import flypend as fp

vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0.28, 0, 0.96))  # it leans a little
print(fp.metrics(fp.simulate(vehicle, fp.laws.lqr(), start, duration=6)).success)

# %% laws.corrected | live-carry.png: Under the corrected law the rod comes to rest hanging, and the vehicle falls
import flypend as fp

vehicle, start = fp.vehicle("nayak2018"), fp.State(y=(0.8, 0, 0.6))
run = fp.simulate(vehicle, fp.laws.corrected(), start, duration=6.5, plant="ideal")
print(run.y[-1].round(3))  # e₃ is along gravity: it hangs

# %% laws.printed | live-printed.png: Experiment 3 under the printed law, which becomes singular
import flypend as fp

vehicle, start = fp.vehicle("nayak2018"), fp.State(y=(0.8, 0, 0.6), y_dot=(0, 1, 0))
run = fp.simulate(vehicle, fp.laws.printed(), start, duration=6.5, plant="ideal")
print(run.outcome)

# %% laws.from_function | api/function.png: The vehicle climbs to its place and stays there, with the rod hanging
import matplotlib.pyplot as plt

import flypend as fp


def hover(t, state, vehicle, *, k_p=2.0, k_d=1.5):
    thrust = vehicle.weight - k_p * state.x[2] - k_d * state.x_dot[2]
    return fp.Wrench(thrust, vehicle.I @ (-20.0 * state.omega))


law, below = fp.laws.from_function(hover), fp.State(x=(0, 0, -1), y=(0, 0, -1))
run = fp.simulate(fp.vehicle("hehn2011"), law, below, duration=8)
print(run.outcome)

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(run.t, run.x[:, 2])
axes.axhline(0, color="grey", linestyle="--")
axes.set(xlabel="t (s)", ylabel="height of the pivot (m)")
figure.savefig("function.png")

# %% laws.law_from_dict
import flypend as fp

print(fp.laws.law_from_dict({"name": "inverted", "gains": {"rod_bandwidth": 7.0}}))

# %% laws.law_names
import flypend as fp

print(fp.laws.law_names())

# %% laws.Control
import flypend as fp

control = fp.laws.Control(wrench=fp.Wrench(5.4, (0, 0, 0)), signals={"mode": 1.0})
print(control.wrench.thrust, control.signals)

# %% laws.Guard | cause-singular.svg: Where a guarded quantity vanishes, the law is undefined and the flight ends
import flypend as fp

guard = fp.laws.Guard(signal="domain", threshold=1e-12, reason="outside the domain")
print(guard.reason)

# %% laws.Computer | api/lead.png: Force of a rotor after a step of the demand: with a lead it arrives sooner
import matplotlib.pyplot as plt
import numpy as np

import flypend as fp

lag, t = fp.vehicle("hehn2011").rotor_lag, np.linspace(0, 0.1, 200)  # s
figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
for lead in (1.0, 1.5, 2.5):
    computer = fp.laws.Computer(lead=lead, latency=0.008)
    force = 1 - np.exp(-computer.lead * t / lag)  # share of the demand
    axes.plot(1e3 * t, force, label=f"lead {lead}")
axes.set(xlabel="time after the step (ms)", ylabel="force over demand")
axes.legend()
figure.savefig("lead.png")

# %% laws.Bounds
import flypend as fp

print(fp.laws.Bounds(low=0.0, open_low=True))

# %% laws.LawError
import flypend as fp


def broken(t, state, vehicle):
    return fp.Wrench(vehicle.wieght, (0, 0, 0))


try:
    fp.simulate(
        fp.vehicle("hehn2011"), fp.laws.from_function(broken), fp.State(y=(0, 0, 1)), 1
    )
except (fp.laws.LawError, fp.InputError) as error:
    print(error)

# %% Law | law-cascade.svg: The cascade of the law: bob, force, thrust axis, moment, rotors
import flypend as fp

law = fp.laws.inverted()
print(law.name, law.e3, len(law.gains))

# %% BoundLaw
import flypend as fp

bound = fp.laws.almost_global().bind(fp.vehicle("hehn2011"))
print(bound.gains["axis_weight"], bound.guarantee(fp.State(y=(0, 0, -1))).covered)

# %% Controller
import flypend as fp

plan = fp.plan(fp.vehicle("hehn2011"), fp.State(y=(0.6, 0, 0.8)))
controller = fp.track(plan)
print(controller.name, controller.rate)  # Hz

# %% Gain
import flypend as fp

gain = fp.Gain("k_p", 4.0, "1/s²", "Stiffness of the rod", fp.laws.Bounds(low=0.0))
print(gain.name, gain.default, gain.unit)

# %% linearise | api/eigenvalues.png: Eigenvalues of the closed loop at hover: all but yaw's lie left of the imaginary axis
import matplotlib.pyplot as plt

import flypend as fp

hover = fp.linearise(fp.laws.inverted(), fp.vehicle("hehn2011"))
print(sorted(hover.eigenvalues.real)[:3])  # 1/s

figure, axes = plt.subplots(figsize=(4, 3), layout="constrained")
axes.axvline(0, color="grey", linewidth=0.8)
axes.plot(hover.eigenvalues.real, hover.eigenvalues.imag, "x")
axes.set(xlabel="real part (1/s)", ylabel="imaginary part (rad/s)")
figure.savefig("eigenvalues.png")

# %% references.hover | api/hover.png: The pivot goes to another place; it first moves away, to lean the rod
import matplotlib.pyplot as plt

import flypend as fp
from flypend.laws.references import hover

law = fp.laws.inverted(hover((1.0, 0.0, 0.5)))
run = fp.simulate(fp.vehicle("hehn2011"), law, fp.State(y=(0, 0, 1)), duration=8)
print(run.x[-1].round(2))

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(run.t, run.x[:, [0, 2]], label=["x₁", "x₃"])
axes.set(xlabel="t (s)", ylabel="position of the pivot (m)")
axes.legend()
figure.savefig("hover.png")

# %% references.line | api/line.png: The pivot catches up with a reference that moves away, and stays with it
import matplotlib.pyplot as plt

import flypend as fp
from flypend.laws.references import line

law = fp.laws.inverted(line(velocity=(0.5, 0, 0)))  # m/s
run = fp.simulate(fp.vehicle("hehn2011"), law, fp.State(y=(0, 0, 1)), duration=6)
print(run.x[-1].round(2))

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(run.t, run.x[:, 0], label="pivot")
axes.plot(run.t, run.x_ref[:, 0], "--", label="reference")
axes.set(xlabel="t (s)", ylabel="x₁ (m)")
axes.legend()
figure.savefig("line.png")

# %% references.circle | api/circle.png: The vehicle's path from above: from the centre onto the circle; the bob leans inwards
import matplotlib.pyplot as plt

import flypend as fp
from flypend.laws.references import circle

law = fp.laws.inverted(circle(radius=0.5, rate=1.5))  # m, rad/s
run = fp.simulate(fp.vehicle("hehn2011"), law, fp.State(y=(0, 0, 1)), duration=8)
print(run.x[-1].round(2))

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
bob = run.x + run.vehicle.l * run.y
axes.plot(run.x[:, 0], run.x[:, 1], label="pivot")
axes.plot(bob[:, 0], bob[:, 1], label="bob")
axes.set(xlabel="x₁ (m)", ylabel="x₂ (m)", aspect="equal")
axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
figure.savefig("circle.png")

# %% references.lemniscate | api/lemniscate.png: The vehicle's path from above: a figure of eight, and the path of the bob inside it
import matplotlib.pyplot as plt

import flypend as fp
from flypend.laws.references import lemniscate

law = fp.laws.inverted(lemniscate(size=1.0, rate=1.2))  # m, rad/s
run = fp.simulate(fp.vehicle("hehn2011"), law, fp.State(y=(0, 0, 1)), duration=8)
print(abs(run.x).max())

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
bob = run.x + run.vehicle.l * run.y
axes.plot(run.x[:, 0], run.x[:, 1], label="pivot")
axes.plot(bob[:, 0], bob[:, 1], label="bob")
axes.set(xlabel="x₁ (m)", ylabel="x₂ (m)", aspect="equal")
axes.legend()
figure.savefig("lemniscate.png")

# %% plan | plan-front.png: Excursion of plans against the time until hover
import flypend as fp

plan = fp.plan(fp.vehicle("hehn2011"), fp.State(y=(0, 0, -1)), objective="excursion")
print(plan.status, plan.excursion, plan.duration)  # m, s

# %% Plan | api/plan.png: A plan from a leaning rod: it swings through below the vehicle and comes to rest upright
import matplotlib.pyplot as plt

import flypend as fp

plan = fp.plan(fp.vehicle("hehn2011"), fp.State(y=(0.6, 0, 0.8)))
print(plan.t.shape, plan.x.shape, plan.rotor_forces.shape)
plan.save("plan.nc")

figure, (rod, force) = plt.subplots(1, 2, figsize=(7, 2.8), layout="constrained")
rod.plot(plan.t, plan.y[:, 2])
rod.set(xlabel="t (s)", ylabel="height of the rod, y₃")
force.plot(plan.t, plan.rotor_forces)
force.set(xlabel="t (s)", ylabel="rotor forces (N)")
figure.savefig("plan.png")

# %% load_plan
import flypend as fp

fp.plan(fp.vehicle("hehn2011"), fp.State(y=(0.6, 0, 0.8))).save("plan.nc")
print(fp.load_plan("plan.nc").excursion)

# %% track | api/track.png: The tracked flight lies on its plan
import matplotlib.pyplot as plt

import flypend as fp

vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0.6, 0, 0.8))
plan = fp.plan(vehicle, start)
run = fp.simulate(vehicle, fp.track(plan), start, plan.duration + 2)
print(fp.metrics(run).success)

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(run.t, run.y[:, 2], label="flown")
axes.plot(plan.t, plan.y[:, 2], "--", label="planned")
axes.set(xlabel="t (s)", ylabel="height of the rod, y₃")
axes.legend()
figure.savefig("track.png")

# %% plan_and_track | plan-map.png: Excursion of law, nmpc and plan over the sphere of the rod
import flypend as fp

vehicle, starts = fp.vehicle("hehn2011"), fp.random_starts(2, seed=1)
runs = fp.simulate_ensemble(vehicle, fp.plan_and_track(), starts, duration=8)
print(runs.success)

# %% plan_ensemble, PlanEnsemble | plan-map.png: Excursion of plans over the sphere of the rod
import flypend as fp

plans = fp.plan_ensemble(fp.vehicle("hehn2011"), fp.random_starts(2, seed=1))
print([plan.excursion for plan in plans])

# %% Constraints | plan-under-the-bar.png: A plan that keeps a bar above the rod
import flypend as fp

keep = fp.Constraints(floor=-1.0, speed=4.0)  # m, m/s
plan = fp.plan(fp.vehicle("hehn2011"), fp.State(y=(0.6, 0, 0.8)), constraints=keep)
print(plan.status, plan.x[:, 2].min())

# %% Window | plan-window.png: A plan that flies through a window lower than the rod is long
import flypend as fp

gap = fp.Window(centre=(0, 0, 0.6), width=0.9, height=0.6)  # m, of a wall across e₁
print(gap)

# %% export_plan
import flypend as fp

plan = fp.plan(fp.vehicle("hehn2011"), fp.State(y=(0.6, 0, 0.8)))
fp.export_plan(plan, "table")  # flypend_plan.c and .h

# %% export_nmpc
import flypend as fp

plan = fp.plan(fp.vehicle("hehn2011"), fp.State(y=(0, 0, -1)))
fp.export_nmpc(plan, "nmpc")  # flypend_nmpc.c and .h

# %% nmpc | planning-phases.svg: Who flies when: waiting, planned, hovering
import flypend as fp

vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0.6, 0, 0.8))
print(fp.metrics(fp.simulate(vehicle, fp.nmpc(vehicle), start, duration=4)).success)

# %% Plant | api/plant.png: The rod comes up with delay and a heavier bob almost as on the ideal plant
import matplotlib.pyplot as plt

import flypend as fp

real = fp.Plant(
    rate=200.0, delay=0.01, mismatch={"bob_mass": 1.1}
)  # Hz, s, true over believed
vehicle, law, hanging = fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, -1))
print(fp.metrics(fp.simulate(vehicle, law, hanging, 8, plant=real)).success)

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
for name, plant in {"real": real, "ideal": "ideal"}.items():
    run = fp.simulate(vehicle, law, hanging, 5, plant=plant)
    axes.plot(run.t, run.y[:, 2], label=name)
axes.set(xlabel="t (s)", ylabel="height of the rod, y₃")
axes.legend()
figure.savefig("plant.png")

# %% Ideal | lyapunov.svg: V along flights on the ideal plant
import flypend as fp

vehicle, hanging = fp.vehicle("hehn2011"), fp.State(y=(0, 0, -1))
run = fp.simulate(vehicle, fp.laws.almost_global(), hanging, 6, plant=fp.Ideal())
print(run.outcome)

# %% Noise | api/noise.png: With noisy measurements the rod trembles about upright
import matplotlib.pyplot as plt

import flypend as fp

noisy = fp.Plant(noise=fp.Noise(x=1e-3, y=3.5e-3, omega=0.02), seed=3)  # m, rad, rad/s
vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0, 0, 1))
run = fp.simulate(vehicle, fp.laws.inverted(), start, 4, plant=noisy)
print(run.y[-1].round(3))

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(run.t, run.y[:, :2], label=["y₁", "y₂"])
axes.set(xlabel="t (s)", ylabel="lean of the rod (rad)")
axes.legend()
figure.savefig("noise.png")

# %% Sensors | sensor-timing.svg: When readings are taken and when they arrive
import flypend as fp

mine = fp.Sensors(
    position=fp.Sensor(rate=120.0, noise=2e-3, latency=0.015),
    attitude=fp.Sensor(rate=120.0, noise=5e-3, latency=0.015),
    rod=fp.Sensor(rate=120.0, noise=5e-3, latency=0.015),
    gyro=fp.Sensor(rate=1000.0, noise=1e-2),
)
vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0, 0, 1))
print(
    fp.simulate(vehicle, fp.laws.inverted(), start, 4, plant=fp.Plant(sensors=mine)).y[-1]
)

# %% Sensor | sensor-timing.svg: When readings are taken and when they arrive
import flypend as fp

print(fp.Sensor(rate=120.0, noise=2e-3, latency=0.015, dropouts=0.05))  # Hz, m, s, share

# %% Wind | api/wind.png: Gusts move the vehicle to and fro by a few centimetres
import matplotlib.pyplot as plt

import flypend as fp

windy = fp.Plant(wind=fp.Wind(on_vehicle=(0.3, 0, 0), gust_on_vehicle=0.1))  # N
vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0, 0, 1))
run = fp.simulate(vehicle, fp.laws.inverted(), start, 10, plant=windy)
print(run.x[-1].round(2))

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(run.t, run.x, label=["x₁", "x₂", "x₃"])
axes.set(xlabel="t (s)", ylabel="position of the pivot (m)")
axes.legend()
figure.savefig("wind.png")

# %% compare, Comparison | api/compare.png: How many runs of each law have settled by a time, and within a distance
import flypend as fp
from flypend.pictures.studies import comparison_figure

laws, starts = [fp.laws.inverted(), fp.laws.lqr()], fp.random_starts(50, seed=7)
found = fp.compare(fp.vehicle("hehn2011"), laws, starts, duration=8)
for row in found.rows():
    print(row["law"], row["success"])
comparison_figure(found).savefig("compare.png", dpi=100)

# %% sweep | map.png: Success, settling time, excursion and cause of failure over the sphere of the rod
import flypend as fp

study = {"vehicle": "hehn2011", "law": {"name": "lqr"}, "runs": 200, "duration": 6.0}
runs = fp.sweep(study | {"vary": {"start": {"y": "uniform"}}}, "small.zarr")
print(float(runs.success.mean()))

# %% check, Check | check.png: Success of the inverted law against delay, lag, length, mass and noise
import flypend as fp

found = fp.check(fp.vehicle("hehn2011"), runs=20, margins=False)
print(found.feasibility.agility)
print({name: int(runs.success.sum()) for name, runs in found.tasks.items()})

# %% trial, Trial | api/trial.png: Share of flights that succeed, by number of the model and its true over believed value
import matplotlib.pyplot as plt

import flypend as fp

found = fp.trial(fp.vehicle("hehn2011"), runs=4, seed=1)
print(found.uptime)

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
factors = list(next(iter(found.sweeps.values())))
shares = [
    [good / runs for good, runs in counts.values()] for counts in found.sweeps.values()
]
image = axes.imshow(shares, vmin=0, vmax=1, cmap="cividis", aspect="auto")
axes.set_xticks(range(len(factors)), factors)
axes.set_yticks(range(len(shares)), found.sweeps)
axes.set_xlabel("true over believed value")
figure.colorbar(image, label="share that succeeds")
figure.savefig("trial.png")

# %% study, Study | map.png: What a study of random starts shows: success, settling time and excursion over the sphere of the rod
import flypend as fp

settings = {"vehicle": "hehn2011", "law": {"name": "lqr"}, "runs": 100, "duration": 6.0}
found = fp.study(settings | {"vary": {"start": {"y": "uniform"}}})
print(found.samples, found.seed, found.axes)

# %% tune, Tuned | api/tuned.png: The cost of the best gains found falls from generation to generation
import matplotlib.pyplot as plt

import flypend as fp

study = {
    "vehicle": "nayak2018",
    "law": {"name": "corrected"},
    "plant": "ideal",
    "duration": 6.5,
    "criterion": {"target": "e3", "position": float("inf")},
    "runs": 50,
    "vary": {"start": {"y": "uniform"}},
    "tune": {
        "runs": 20,
        "generations": 4,
        "gains": {"k_d": [0.3, 5.0], "k_1": [3.0, 100.0]},
    },
}
found = fp.tune(study)
print(found.gains, found.before, found.after)

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
runs = [entry["runs"] for entry in found.history]
axes.plot(runs, [entry["best"] for entry in found.history], marker="o")
axes.set(xlabel="runs flown", ylabel="cost of the best gains so far")
figure.savefig("tuned.png")

# %% Objective | api/objective.png: Two objectives over a gain: failures alone, and failures, settling time and excursion
import matplotlib.pyplot as plt
import numpy as np

import flypend as fp

vehicle, starts = fp.vehicle("hehn2011"), fp.random_starts(16, seed=1)
failures = fp.Objective(failure=1.0, settling=0.0, excursion=0.0)
brisk = fp.Objective(failure=1.0, settling=0.5, excursion=0.2)
values = np.linspace(0.2, 1.2, 6)
costs = []
for damping in values:
    law = fp.laws.inverted(rod_damping=damping)
    runs = fp.simulate_ensemble(vehicle, law, starts, duration=8)
    found = {
        name: getattr(runs, name) for name in ("success", "settling", "excursion", "effort")
    }
    costs.append([each.cost(found, 8.0).mean() for each in (failures, brisk)])

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(values, costs, marker="o", label=["failures", "failures, settling, excursion"])
axes.set(xlabel="gain rod_damping", ylabel="mean cost")
axes.legend()
figure.savefig("objective.png")

# %% identify, Identified | api/identified.png: Numbers of the vehicle, found over true, with their bands
import matplotlib.pyplot as plt

import flypend as fp
from flypend.identification.manoeuvre import rehearsal_of, write_log

true = fp.vehicle("hehn2011")
guess, flown = rehearsal_of(true, duration=11)  # your own log would be here
write_log("flight.csv", flown.columns)
found = fp.identify("flight.csv", guess)
print(found.vehicle, found.bands["rod_length"])  # m

figure, axes = plt.subplots(figsize=(6, 2.4), layout="constrained")
names = ["mass", "bob_mass", "rod_length"]
for row, name in enumerate(names):
    low, high = (end / getattr(true, name) for end in found.bands[name])
    axes.plot([low, high], [row, row], linewidth=3)
    axes.plot(getattr(found.vehicle, name) / getattr(true, name), row, "ko")
axes.axvline(1, color="grey", linestyle="--")
axes.set(xlabel="found / true", yticks=range(3), yticklabels=names)
figure.savefig("identified.png")

# %% sensitivity, Sensitivity | api/sensitivity.png: The derivative predicts the end of flights with other gains: the tangent of the curve
import matplotlib.pyplot as plt
import numpy as np

import flypend as fp

vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0, 0.6, 0.8))
law, name = fp.laws.inverted, "rod_bandwidth"
found = fp.sensitivity(vehicle, law(), start, 2.0, gains=(name,))
print(found.by_start.shape, found.by_gains.shape, found.on_manifold[0].shape)

end, gain = found.final, found.gains[name]
slope = found.by_gains[end.packed() == end.x[1], 0]  # of x₂
others = gain * np.linspace(0.8, 1.2, 15)
runs = [fp.simulate(vehicle, law(**{name: k}), start, 2.0, plant="ideal") for k in others]
figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(others, [run.x[-1, 1] for run in runs], "o", label="flown")
axes.plot(others, end.x[1] + slope * (others - gain), label="predicted")
axes.set(xlabel="rod bandwidth (1/s)", ylabel="x₂ after 2 s (m)")
axes.legend()
figure.savefig("sensitivity.png")

# %% InputError
import flypend as fp

try:
    fp.laws.inverted(rod_bandwith=7.0)
except fp.InputError as error:
    print(error)

# %% export_app | compiler-pipeline.svg: From equations to C: the app is the last stage, with what the firmware calls
import flypend as fp

fp.export_app("crazyflie", fp.laws.inverted(), fp.vehicle("crazyflie"), "app")

# %% export_c | compiler-pipeline.svg: From equations to C
import flypend as fp

fp.export_c(fp.laws.inverted(), fp.vehicle("hehn2011"), "computer", precision="float")

# %% export.compiled | compiler-pipeline.svg: From equations to C
import flypend as fp
from flypend.export import compiled

vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0.28, 0, 0.96))
controller = compiled(fp.laws.inverted(), vehicle)  # needs a C compiler
print(fp.simulate(vehicle, controller, start, duration=2).outcome)

# %% laws.trained
import numpy as np

import flypend as fp

rng = np.random.default_rng(0)
hidden = rng.normal(size=(32, 24)), np.zeros(32), "tanh"  # weights, biases, activation
law = fp.laws.trained([hidden, (0.01 * rng.normal(size=(4, 32)), np.zeros(4))])
print(law, fp.simulate(fp.vehicle("hehn2011"), law, fp.State(y=(0, 0, 1)), 0.1).outcome)

# %% envs.environment | env-swing-up.svg: The rod is thrown from hanging and caught upright
import flypend.envs

world = flypend.envs.environment("swing_up", vehicle="hehn2011", mount="hub")
print(world.vehicle.mount, world.rate)

# %% envs.Environment | env-balance.svg: The rod is kept up and brought home
import flypend.envs

print(flypend.envs.environment("balance", action="rates").action)

# %% envs.Randomisation | api/randomisation.png: Climb rate of thirty worlds under one action: it fans out with mass and thrust
import gymnasium
import matplotlib.pyplot as plt
import numpy as np

import flypend.envs

spread = flypend.envs.Randomisation(mass=(0.9, 1.1), thrust=(0.9, 1.1))  # ratios
worlds = gymnasium.make_vec(
    "flypend/Balance-v0",
    30,
    vectorization_mode="vector_entry_point",
    action="rates",
    randomise=spread,
)
worlds.reset(seed=1)
action, rates = np.zeros(worlds.action_space.shape), []
for _ in range(30):
    worlds.step(action)
    rates.append(worlds.unwrapped.worlds.states[:, 5])

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(np.arange(1, 31) / 100, np.array(rates) - rates[0], linewidth=1)
axes.set(xlabel="t (s)", ylabel="change of the climb rate (m/s)")
figure.savefig("randomisation.png")

# %% envs.World | env-balance.svg: The rod is kept up and brought home
import gymnasium

import flypend.envs

world = gymnasium.make("flypend/Balance-v0")
seen, _ = world.reset(seed=0)
seen, reward, terminated, truncated, _ = world.step(world.action_space.sample())
print(seen.shape, reward)

# %% envs.World.save_state, envs.World.restore_state
import gymnasium

import flypend.envs

world = gymnasium.make("flypend/Balance-v0")
world.reset(seed=0)
state = world.unwrapped.save_state()
first = world.step(world.action_space.low)[0]
world.unwrapped.restore_state(state)
print((first == world.step(world.action_space.low)[0]).all())

# %% envs.VectorWorlds | env-swing-up.svg: The rod is thrown from hanging and caught upright
import gymnasium

import flypend.envs

worlds = gymnasium.make_vec(
    "flypend/SwingUp-v0", 64, vectorization_mode="vector_entry_point"
)
seen, _ = worlds.reset(seed=1)
seen, rewards, _, _, _ = worlds.step(worlds.action_space.sample())
print(seen.shape, rewards.mean())

# %% envs.DifferentiableWorlds | env-balance.svg: The rod is kept up and brought home
import numpy as np

import flypend.envs

worlds = flypend.envs.DifferentiableWorlds("balance")
memory, seen = worlds.begin(range(64))  # seeds
actions = np.zeros((64, 4))
after = worlds.step(memory, actions)
to_memory, to_actions = worlds.pullback(
    memory, actions, np.zeros_like(memory), np.zeros_like(seen), np.ones(64)
)
print(after.rewards.mean(), to_actions.shape)  # of the sum of the rewards

# %% envs.SavedState
import pickle

import gymnasium

import flypend.envs

world = gymnasium.make("flypend/Balance-v0")
world.reset(seed=0)
state = world.unwrapped.save_state()
print(pickle.loads(pickle.dumps(state)) == state)

# %% envs.Task | env-swing-up.svg: The rod is thrown from hanging and caught upright
import dataclasses

import flypend.envs

longer = dataclasses.replace(flypend.envs.swing_up(), duration=20.0)
print(flypend.envs.environment(longer).task.duration)

# %% envs.Moment | env-balance.svg: The rod is kept up and brought home
import dataclasses

import flypend.envs


def upright(moment):
    return moment.state.y[2] - 0.01 * (moment.error.x[0] ** 2 + moment.error.x[1] ** 2)


task = dataclasses.replace(flypend.envs.balance(), reward=upright)
world = flypend.envs.World(task)
world.reset(seed=0)
print(world.step(world.action_space.sample())[1])

# %% envs.balance | env-balance.svg: The rod is kept up and brought home
import flypend.envs

print(flypend.envs.balance().name, flypend.envs.balance().duration)

# %% envs.swing_up | env-swing-up.svg: The rod is thrown from hanging and caught upright
import flypend.envs

print(flypend.envs.swing_up().name, flypend.envs.swing_up().duration)

# %% envs.track | env-track.svg: The rod stands while the vehicle follows a circle
import flypend.envs

print(flypend.envs.track(shape="lemniscate", size=0.8, turn_rate=1.2).name)

# %% envs.catch_in_cup | env-catch-in-cup.svg: A rod that topples is caught in a cup
import flypend.envs

print(flypend.envs.catch_in_cup().name, flypend.envs.catch_in_cup().duration)

# %% sb3.make_vec_env | env-balance.svg: The rod is kept up and brought home
from flypend.envs.sb3 import make_vec_env

worlds = make_vec_env("flypend/Balance-v0", n_envs=64, seed=0)
print(worlds.reset().shape)

# %% sb3.VecWorlds | env-track.svg: The rod stands while the vehicle follows a circle
from flypend.envs import VectorWorlds
from flypend.envs.sb3 import VecWorlds

worlds = VecWorlds(VectorWorlds("track", 64, shape="lemniscate"))
print(worlds.reset().shape)
