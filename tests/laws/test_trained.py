"""A policy of one's own as a law: it sees and commands what it did in its environment, from weights and from ONNX."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.envs import VectorWorlds
from flypend.laws.own import from_function
from flypend.laws.trained import ACTIVATIONS, MOST_WEIGHTS, Network, read_onnx
from flypend.settings.laws import absolute, law_from, law_named, relative

onnx = pytest.importorskip("onnx")
helper, tensor = onnx.helper, onnx.numpy_helper.from_array

VEHICLE = fp.vehicle("hehn2011")
START = fp.State(y=(0.28, 0, 0.96))


def weights(inputs=24, outputs=4, hidden=16):
    rng = np.random.default_rng(0)
    return [rng.standard_normal(shape) / 10 for shape in ((hidden, inputs), hidden, (outputs, hidden), outputs)]


def regulator():
    """The linear-quadratic regulator as weights of a single layer: rotor forces of a law that balances."""
    symbol = ca.SX.sym("s", 24)
    wrench = fp.laws.lqr().bind(VEHICLE).upright(ca.SX(0), symbol)
    forces = ca.mtimes(ca.DM(VEHICLE.unmixing()), wrench)
    at = ca.Function("at", [symbol], [ca.jacobian(forces, symbol), forces])
    hover = fp.State(y=(0, 0, 1)).packed()
    slope, level = (np.array(part) for part in at(hover))
    low, high = VEHICLE.rotor_limits
    by_columns = np.r_[0:6, 6, 9, 12, 7, 10, 13, 8, 11, 14, 15:24]  # a packed state has R by rows
    W = 2 / (high - low) * slope
    b = 2 * (level.ravel() - low) / (high - low) - 1 - W @ hover
    return W[:, by_columns], b


def saved(path, nodes, constants, inputs=24, last="out"):
    rows = {"seen": (1, inputs), last: None}
    shapes = [helper.make_tensor_value_info(name, onnx.TensorProto.DOUBLE, rows[name]) for name in rows]
    held = [tensor(np.asarray(value), name) for name, value in constants.items()]
    onnx.save(helper.make_model(helper.make_graph(nodes, "policy", shapes[:1], shapes[1:], held)), path)
    return path


def chain(*steps):
    """Nodes one after the other, each (operator, names of constants, attributes)."""
    nodes, name = [], "seen"
    for i, (kind, constants, attributes) in enumerate(steps):
        after = "out" if i == len(steps) - 1 else f"v{i}"
        nodes.append(helper.make_node(kind, [name, *constants], [after], **attributes))
        name = after
    return nodes


def mlp(path, **changes):
    """Weights as PyTorch exports them, behind a normalisation of the observations."""
    W1, b1, W2, b2 = weights()
    constants = {"mean": np.full(24, 0.1), "size": np.full(24, 2.0), "W1": W1, "b1": b1, "W2": W2.T.copy(), "b2": b2}
    steps = [("Sub", ["mean"], {}), ("Div", ["size"], {}), ("Gemm", ["W1", "b1"], {"transB": 1}), ("Tanh", [], {}),
             ("MatMul", ["W2"], {}), ("Add", ["b2"], {}), ("Tanh", [], {})]  # fmt: skip
    return saved(path, chain(*steps), constants | changes)


def test_activations_are_what_they_are_called():
    """By NumPy, at numbers of all sizes: tanh is 3e-13 off at most, and what is made of it."""
    v = np.concatenate([sign * np.geomspace(1e-12, 1e3, 400) for sign in (-1, 1)])
    below = np.minimum(v, 0)
    wanted = {
        "tanh": np.tanh(v), "sigmoid": np.exp(-np.logaddexp(-v, 0)), "elu": v - below + 0.7 * np.expm1(below),
        "softplus": np.logaddexp(v, 0), "relu": v - below, "softsign": v / (1 + abs(v)),
        "leaky_relu": v - below + 0.7 * below, "identity": v,
    }  # fmt: skip
    assert wanted.keys() == ACTIVATIONS.keys()
    for name, values in wanted.items():
        found = np.array(ca.DM(ACTIVATIONS[name](ca.DM(v), 0.7))).ravel()
        assert np.allclose(found, values, rtol=1e-12, atol=1e-12), name


def test_a_network_sees_and_commands_what_it_did_in_its_environment():
    """Its first action in worlds, computed by NumPy from observations there, and its wrench in flight."""
    W1, b1, W2, b2 = weights()
    worlds = VectorWorlds("balance", 5, observe="state")
    seen, _ = worlds.reset(seed=3)
    actions = np.clip(5 * (W2 @ np.tanh(W1 @ seen.T.astype(float) + b1[:, None]) + b2[:, None]), -1, 1)
    assert (abs(actions) == 1).any()  # one is limited
    low, high = VEHICLE.rotor_limits
    wrenches = VEHICLE.mixing() @ (low + (high - low) * (actions + 1) / 2)
    bound = fp.laws.trained([(W1, b1, "tanh"), (5 * W2, 5 * b2)]).bind(VEHICLE)
    symbol = ca.SX.sym("s", 24)
    found = ca.Function("w", [symbol], [bound.upright(ca.SX(0), symbol)])(worlds.worlds.states[:, :24].T)
    assert np.allclose(np.array(found), wrenches, rtol=1e-5, atol=1e-5)  # observations are of single precision


def test_all_forms_of_the_attitude_are_known():
    """A network on R's first two columns flies as one on all three that ignores the last.

    One on the body frame commands what it does in its environment.
    """
    W, b = regulator()
    W[:, 12:15] = 0
    short = np.delete(W, [12, 13, 14], axis=1)
    long, brief = (fp.simulate(VEHICLE, fp.laws.trained([(one, b)]), START, 0.5).packed for one in (W, short))
    assert np.array_equal(long, brief)
    assert VectorWorlds("balance", 2, observe="state", attitude="6d").reset(seed=0)[0].shape == (2, 21)
    W, b = np.random.default_rng(0).normal(size=(4, 18)) / 20, np.zeros(4)
    worlds, symbol = VectorWorlds("balance", 5, observe="state", attitude="body"), ca.SX.sym("s", 24)
    seen, _ = worlds.reset(seed=3)
    bound = fp.laws.trained([(W, b)]).bind(VEHICLE)
    found = np.array(ca.Function("w", [symbol], [bound.upright(ca.SX(0), symbol)])(worlds.worlds.states[:, :24].T))
    low, high = VEHICLE.rotor_limits
    wrenches = VEHICLE.mixing() @ (low + (high - low) * (np.clip(W @ seen.T, -1, 1) + 1) / 2)
    assert np.allclose(found, wrenches, rtol=1e-5, atol=1e-5)  # observations are of single precision


def test_a_regulator_in_a_layer_balances_and_follows():
    law = fp.laws.trained([regulator()])
    run = fp.simulate(VEHICLE, law, START, 8.0)
    assert fp.metrics(run).success
    place = fp.laws.trained([regulator()], fp.laws.references.hover((1.0, -0.5, 0.5)))
    moved = fp.simulate(VEHICLE, place, fp.State(x=(0.8, -0.5, 0.5), y=(0, 0, 1)), 8.0)
    assert np.allclose(moved.x[-1], (1.0, -0.5, 0.5), atol=0.02)


def test_thrust_and_moments_are_those_of_the_environment():
    """Against the world's own command, which is the allocation of this wrench."""
    from flypend.envs import environment
    from flypend.envs.problem import Parts

    b, wrench = np.array([0.1, 0.02, -0.03, 0.01]), ca.SX.sym("s", 24)
    law = fp.laws.trained([(np.zeros((4, 24)), b)], action="wrench").bind(VEHICLE)
    own = np.array(ca.Function("w", [wrench], [law.upright(ca.SX(0), wrench)])(START.packed())).ravel()
    forces = np.array(Parts(environment("balance", action="wrench")).command()(b)).ravel()
    assert np.allclose(VEHICLE.mixing() @ forces, own, rtol=0, atol=1e-12)


def test_an_onnx_file_flies_as_the_same_law_by_hand(tmp_path):
    W1, b1, W2, b2 = weights()
    low, high = VEHICLE.rotor_limits

    def by_hand(t, state, vehicle):
        seen = ca.vertcat(state.x, state.x_dot, ca.vec(state.R), state.omega, state.y, state.y_dot)
        action = ca.tanh(W2 @ ca.tanh(W1 @ ((seen - 0.1) / 2) + b1) + b2)
        wrench = vehicle.mixing() @ (low + (high - low) * (action + 1) / 2)
        return fp.Wrench(wrench[0], wrench[1:])

    law = law_named(str(mlp(tmp_path / "mine.onnx")))
    read, written = (fp.simulate(VEHICLE, each, START, 1.0) for each in (law, from_function(by_hand)))
    assert np.allclose(read.packed, written.packed, rtol=0, atol=1e-12)
    assert law.name == "mine"
    alike = law_named(str(mlp(tmp_path / "one.onnx", mean=np.array(0.1), size=np.array(2.0))))  # a number for all
    assert np.array_equal(fp.simulate(VEHICLE, alike, START, 1.0).packed, read.packed)


@pytest.mark.parametrize("operator", ["Relu", "Sigmoid", "Softplus", "Softsign", "Elu", "LeakyRelu"])
def test_an_activation_is_that_of_onnx(operator, tmp_path):
    """By the reference implementation that comes with the standard."""
    from onnx.reference import ReferenceEvaluator

    W = weights(outputs=4, hidden=4)[0].astype(np.float32)
    path = saved(tmp_path / "one.onnx", chain(("Gemm", ["W"], {"transB": 1}), (operator, [], {})), {"W": W})
    seen, symbol = np.linspace(-9, 9, 24, dtype=np.float32), ca.SX.sym("v", 24)
    own = ca.Function("f", [symbol], [read_onnx(path)(symbol)])(seen)
    wanted = ReferenceEvaluator(onnx.load(path)).run(None, {"seen": seen[None]})[0]
    assert np.allclose(np.array(own).ravel(), wanted.ravel(), rtol=1e-5, atol=1e-6)  # single precision there
    assert len(ACTIVATIONS) == 8


FAULTS = {
    "another shape": ((("Gemm", ["W"], {"transB": 1}),), {"W": np.zeros((4, 30))}),
    "layers that do not fit": ((("Gemm", ["W"], {"transB": 1}), ("Tanh", [], {}), ("MatMul", ["V"], {})),
                               {"W": np.zeros((4, 24)), "V": np.zeros((5, 4))}),
    "NaN": ((("Gemm", ["W"], {"transB": 1}),), {"W": np.full((4, 24), np.nan)}),
    "an operator": ((("Gemm", ["W"], {"transB": 1}), ("Softmax", [], {})), {"W": np.zeros((4, 24))}),
    "no linear operator": ((("Tanh", [], {}),), {}),
    "too few biases": ((("Gemm", ["W", "b"], {"transB": 1}),), {"W": np.zeros((4, 24)), "b": np.zeros(3)}),
    "what is computed": ((("Gemm", ["W"], {"transB": 1}), ("Add", ["seen"], {})), {"W": np.zeros((24, 24))}),
    "a limit in between": ((("Gemm", ["W"], {"transB": 1}), ("Clip", ["l", "h"], {}), ("Tanh", [], {})),
                           {"W": np.zeros((4, 24)), "l": -1.0, "h": 1.0}),
    "a product with itself": ((("Gemm", ["W"], {"transB": 1}), ("Mul", ["v0"], {})), {"W": np.zeros((24, 24))}),
    "nothing to add": ((("Gemm", ["W"], {"transB": 1}), ("Add", [], {})), {"W": np.zeros((24, 24))}),
    "whole numbers": ((("Cast", [], {"to": 6}), ("Gemm", ["W"], {"transB": 1})), {"W": np.zeros((4, 24))}),
    "complex weights": ((("Gemm", ["W"], {"transB": 1}),), {"W": np.zeros((4, 24), dtype=complex)}),
    "empty limits": ((("Gemm", ["W"], {"transB": 1}), ("Clip", ["l", "h"], {})),
                     {"W": np.zeros((4, 24)), "l": np.zeros(0), "h": 1.0}),
    "other limits": ((("Gemm", ["W"], {"transB": 1}), ("Clip", ["l", "h"], {})),
                     {"W": np.zeros((4, 24)), "l": -2.0, "h": 1.0}),
    "too many": ((("Gemm", ["W"], {"transB": 1}), ("Tanh", [], {}), ("Gemm", ["V"], {"transB": 1})),
                 {"W": np.zeros((MOST_WEIGHTS // 24, 24)), "V": np.zeros((4, MOST_WEIGHTS // 24))}),
}  # fmt: skip


@pytest.mark.parametrize("fault", FAULTS)
def test_a_file_that_holds_anything_else_is_refused_in_a_line(fault, tmp_path):
    steps, constants = FAULTS[fault]
    with pytest.raises(fp.InputError, match=r"^network") as told:
        fp.laws.trained(saved(tmp_path / "wrong.onnx", chain(*steps), constants))
    assert "\n" not in str(told.value)


def test_a_constant_that_is_no_tensor_is_refused_in_a_line(tmp_path):
    nodes = [helper.make_node("Constant", [], ["two"], value_float=2.0), *chain(("Mul", ["two"], {}))]
    with pytest.raises(fp.InputError, match=r"^network: expected constants that are tensors, got .* value_float$"):
        fp.laws.trained(saved(tmp_path / "wrong.onnx", nodes, {}))


def test_what_is_no_onnx_file_is_refused_in_a_line(tmp_path):
    (tmp_path / "text.onnx").write_text("no network")
    for name in ("text.onnx", "missing.onnx"):
        with pytest.raises(fp.InputError, match=r"^network: "):
            fp.laws.trained(tmp_path / name)


def test_layers_and_rotors_must_fit():
    for layers in (
        [],
        "mine",
        [np.zeros(3)],
        [(np.zeros((4, 24)), np.zeros(3))],
        [(1j * np.ones((4, 24)), np.zeros(4))],
    ):
        with pytest.raises(fp.InputError, match=r"^network"):
            Network(layers)
    with pytest.raises(fp.InputError, match=r"^network: "):
        fp.laws.trained([(np.zeros((6, 24)), np.zeros(6))]).bind(VEHICLE)


def test_its_file_travels_with_results(tmp_path):
    path = mlp(tmp_path / "mine.onnx")
    table = absolute({"function": "mine.onnx", "gains": {"lead": 1.5}}, tmp_path)
    assert table["function"] == str(path)
    assert relative(table, tmp_path)["function"] == "mine.onnx"
    assert law_from(table).given["lead"] == 1.5
