"""Systems: by name, from files, texts and Python; errors."""
import fractions
import inspect
import pathlib

import numpy
import pytest
import sympy

import nhsym

t = sympy.Symbol("t")
OSCILLATOR = "name: spring\nparameters: [{name: m, value: 2}, {name: k, value: 8}]\ncoordinates: [x]\nlagrangian: m*x'^2/2 - k*x^2/2\n"


ROBOT = """<robot name="cart"><link name="body"><inertial><mass value="3"/><inertia ixx="0.1" iyy="0.1" izz="0.2"/></inertial></link>
  <link name="left"><inertial><mass value="1"/><inertia ixx="0.003" iyy="0.005" izz="0.003"/></inertial></link>
  <joint name="turn" type="continuous"><origin xyz="0 0.3 0"/><parent link="body"/><child link="left"/><axis xyz="0 1 0"/></joint></robot>"""


def test_robot_descriptions(tmp_path):
    file = tmp_path / "cart.urdf"
    file.write_text(ROBOT)
    assert nhsym.system(file).coordinates == ("turn",)
    rolling = nhsym.system(file, wheels={"left": 0.1})
    assert rolling.coordinates == ("turn", "x", "y", "heading")
    assert rolling.parameters["mass_body"] == 3
    motion = rolling.simulate(initial={"turn'": 2}, until=1, step=1)
    assert abs(motion.table["x"][-1] - 0.2) < 1e-9
    with pytest.raises(nhsym.InputError, match="did you mean `left`"):
        nhsym.system(file, wheels=["leeft"])
    with pytest.raises(nhsym.InputError, match="needs a radius"):
        nhsym.system(str(file), wheels=["left"], base="planar")


def test_by_name_file_and_text(tmp_path):
    file = tmp_path / "mine.yaml"
    file.write_text(OSCILLATOR)
    for source in (file, str(file), OSCILLATOR):
        spring = nhsym.system(source, set={"k": 18})
        assert (spring.name, spring.coordinates, spring.parameters) == ("spring", ("x",), {"m": 2, "k": 18})
    assert nhsym.system("sleigh").coordinates == ("phi", "x", "y")


def test_built_from_strings_and_from_sympy_alike():
    phi, x, y = (sympy.Function(name)(t) for name in ("phi", "x", "y"))
    m, J = sympy.symbols("m J")
    symbols = nhsym.System(coordinates={phi: "angle", x: "length", y: "length"}, parameters={m: 2, J: fractions.Fraction(1, 2)},
                           lagrangian=m / 2 * (x.diff(t)**2 + y.diff(t)**2) + J / 2 * phi.diff(t)**2,
                           constraints=[y.diff(t) * sympy.cos(phi) - x.diff(t) * sympy.sin(phi)], forces={phi: -phi.diff(t) / 10})
    strings = nhsym.System(coordinates={"phi": "angle", "x": "length", "y": "length"}, parameters={"m": 2, "J": 0.5},
                           lagrangian="m/2*(x'^2 + y'^2) + J/2*phi'^2", constraints=["y'*cos(phi) = x'*sin(phi)"], forces={"phi": "-phi'/10"})
    q, v = numpy.array([0.3, 1, 2]), numpy.array([1.1, 0.5 * numpy.cos(0.3), 0.5 * numpy.sin(0.3)])
    assert symbols.accelerations(q, v) == pytest.approx(strings.accelerations(q, v), rel=1e-14)
    assert symbols.accelerations(q, v)[0] == pytest.approx(-1.1 / 10 / 0.5)


def test_parameters_are_changed_in_a_copy():
    spring = nhsym.system(OSCILLATOR)
    other = spring.set(k=18).set(m=1)
    assert spring.set({sympy.Symbol("k"): 18, "m": 1}).parameters == other.parameters
    assert spring.parameters == {"m": 2, "k": 8} and other.parameters == {"m": 1, "k": 18}
    assert nhsym.system(OSCILLATOR, set={"k": fractions.Fraction(1, 4)}).parameters["k"] == 0.25


def test_right_hand_side_on_arrays():
    spring = nhsym.system(OSCILLATOR)
    y = numpy.random.default_rng(1).normal(size=(2, 5, 7))
    assert spring.right_hand_side(0.0, y) == pytest.approx(numpy.array([y[1], -4 * y[0]]))
    assert spring.right_hand_side(0.0, y[:, 0, 0]).shape == (2,)
    assert numpy.isnan(spring.accelerations([numpy.nan], [0.0])).all()
    for wrong in (lambda: spring.right_hand_side(0, [1, 2, 3]), lambda: spring.accelerations([1, 2], [1, 2]), lambda: spring.accelerations(numpy.zeros((1, 3)), numpy.zeros((1, 4)))):
        with pytest.raises(nhsym.UsageError) as error:
            wrong()
        assert "shape" in error.value.what and error.value.hint


def test_runge_kutta_with_them_keeps_a_constraint():
    """The rolling disk of the shipped systems: y' of any method stays on the constraint submanifold to the method's order."""
    disk = nhsym.system("vertical_disk")
    motion = disk.simulate(initial={"p'": 1.5, "h'": 0.7}, until=1, step=0.01, accuracy=1e-9)
    q, v = motion.states()
    y, h = numpy.concatenate([q[:, 0], v[:, 0]]), 0.01
    for i in range(100):
        k1 = disk.right_hand_side(i * h, y)
        k2 = disk.right_hand_side(i * h + h / 2, y + h / 2 * k1)
        k3 = disk.right_hand_side(i * h + h / 2, y + h / 2 * k2)
        k4 = disk.right_hand_side(i * h + h, y + h * k3)
        y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    assert y == pytest.approx(numpy.concatenate([q[:, -1], v[:, -1]]), abs=1e-7)


def test_errors_carry_place_cause_and_cure():
    with pytest.raises(nhsym.InputError) as error:
        nhsym.System(coordinates=["x"], lagrangian="x'^2/2 - kk*x", parameters={"k": 1}, name="mine")
    assert error.value.where.startswith("mine:") and "kk" in error.value.what and "k" in error.value.hint and "^" in error.value.excerpt and error.value.code == 3
    with pytest.raises(nhsym.InputError) as error:
        nhsym.system("sleihg")
    assert "sleigh" in error.value.hint
    for wrong in (dict(options={"seeed": 3}), dict(velocities="fast"), dict(set={"q": 1})):
        with pytest.raises(nhsym.Error) as error:
            nhsym.system(OSCILLATOR, **wrong)
        assert error.value.code in (2, 3) and str(error.value)
    with pytest.raises(TypeError):
        nhsym.system(OSCILLATOR, velocites="quasi")
    with pytest.raises(nhsym.UsageError):
        nhsym.System(lagrangian="x'^2")
    with pytest.raises(nhsym.UsageError):
        nhsym.system(7)
    with pytest.raises(nhsym.InputError):
        nhsym.system(pathlib.Path("nowhere.yaml"))
    spring = nhsym.system(OSCILLATOR)
    for settings in (dict(until=-1), dict(until="x"), dict(step=0), dict(accuracy=float("nan"))):
        with pytest.raises(nhsym.UsageError, match="positive"):
            spring.simulate(initial={"x": 1}, **settings)
    with pytest.raises(nhsym.InputError) as error:
        spring.simulate(initial={"xx": 1})
    assert error.value.where.startswith("initial:") and "--" not in str(error.value)


def test_every_call_names_the_argument_that_was_meant():
    spring = nhsym.system(OSCILLATOR)
    seen = 0
    for kind in (nhsym.System, nhsym.Analysis, nhsym.Current, nhsym.Simulation, nhsym.Benchmark, nhsym.Record, nhsym.Formula):
        for name, method in vars(kind).items():
            names = [p.name for p in inspect.signature(method).parameters.values() if p.name != "self" and p.kind != p.VAR_POSITIONAL] if inspect.isfunction(method) and not name.startswith("_") else []
            if not names or name == "set":
                continue
            with pytest.raises(nhsym.ArgumentError, match="did you mean `%s`" % names[-1]):
                method(None, **{names[-1] + "x": 1})
            seen += 1
    assert seen > 9
    for call in (lambda: spring.analyze(acuracy=1), lambda: nhsym.system(OSCILLATOR, velocites="quasi"), lambda: spring.classify(), lambda: spring.analyze(1, 2, 3, 4, 5)):
        with pytest.raises(TypeError) as error:
            call()
        assert isinstance(error.value, nhsym.UsageError) and error.value.hint and error.value.code == 2
    with pytest.raises(nhsym.ArgumentError, match="did you mean `until`"):
        nhsym.system(OSCILLATOR).simulate(t_end=5)
    with pytest.raises(nhsym.ArgumentError, match="options={..}"):
        spring.analyze(tolerance=1e-9)
    with pytest.raises(AttributeError, match=r'did you mean `export\("c"\)`'):
        spring.to_c("c")
    with pytest.raises(AttributeError, match="did you mean `analyze`"):
        spring.analyse()


def test_exported_code_runs_without_the_package(tmp_path):
    """The functions in Python against the library's accelerations; C as text and as files."""
    driven = nhsym.system("name: driven\nparameters: [{name: m, value: 2}, {name: k, value: 8}, {name: u, value: 0}]\ncoordinates: [x]\n"
                          "lagrangian: m*x'^2/2 - k*x^2/2\nforces: [x = u]\n")
    code = {}
    exec(driven.export("python", of=["equations", "currents"]), code)
    q, v = numpy.random.default_rng(1).normal(size=(2, 1, 6))
    assert code["accelerations"](0.0, q, v) == pytest.approx(driven.accelerations(q, v), rel=1e-14)
    assert code["currents"](0.0, q, v)[0].ravel() == pytest.approx(driven.analyze(options={"seed": 1})["Phi1"](q, v), rel=1e-14)
    assert "const double inputs[1]" in driven.export("c", of="equations", input="u")
    paths = driven.export("c", tmp_path / "code", name="spring_2")
    assert [path.name for path in paths] == ["spring_2.c", "spring_2.h"] and '#include "spring_2.h"' in paths[0].read_text()
    assert "spring_2_parameters" in paths[1].read_text()
    for wrong, said in ((lambda: driven.export("numpy"), "did you mean `python`"), (lambda: driven.export("c", of="equation"), "did you mean `equations`"),
                        (lambda: driven.export("c", input="uu"), "did you mean `u`"), (lambda: driven.export(3), "give a language"),
                        (lambda: driven.export("c", inputs="u"), "did you mean `input`"), (lambda: driven.export("c", name="2nd"), "a name is a letter")):
        with pytest.raises(nhsym.UsageError, match=said):
            wrong()


def test_the_shipped_systems_are_listed():
    listed = nhsym.systems()
    assert listed["sleigh"] == "Chaplygin sleigh" and len(listed) > 60
    assert nhsym.system(next(iter(listed))).name == next(iter(listed))


def test_arguments_of_another_kind_are_refused_kindly():
    spring = nhsym.system(OSCILLATOR)
    wrong = [lambda: spring.simulate(watch=7), lambda: spring.simulate(events=7), lambda: spring.simulate(initial=[1, 2]), lambda: spring.simulate(progress=3),
             lambda: spring.verify(field=3), lambda: spring.accelerations(["a"], [0]), lambda: nhsym.system(OSCILLATOR, analysis=7), lambda: spring.analyze(options=["seed=3"]),
             lambda: nhsym.System(coordinates=7, lagrangian="x'^2"), lambda: nhsym.System(coordinates=["x"], lagrangian="x'^2", parameters={"m": None}),
             lambda: nhsym.System(coordinates=["x"], lagrangian="x'^2", quasi_velocities=["u"]), lambda: nhsym.System(coordinates=["x"], lagrangian="x'^2", domain={"x": 3})]
    for call in wrong:
        with pytest.raises(nhsym.UsageError) as error:
            call()
        assert error.value.hint


def test_integrators_by_name():
    spring = nhsym.system(OSCILLATOR)
    motions = [spring.simulate(initial={"x": 1}, until=1, method=method) for method in ("adams", "rk8pd")]
    assert len({motion.json["method"] for motion in motions}) == 2 and motions[0]["x"][-1] == pytest.approx(motions[1]["x"][-1], abs=1e-7)
    with pytest.raises(nhsym.UsageError, match="adams"):
        spring.simulate(initial={"x": 1}, method="adam")
    with pytest.raises(nhsym.UsageError, match="method"):
        spring.simulate(initial={"x": 1}, method="adams", accuracy=1e-6)


def test_initial_velocities_from_sympy():
    x = sympy.Function("x")(t)
    motion = nhsym.system(OSCILLATOR).simulate(initial={x: 1, x.diff(t): sympy.Rational(1, 2)}, until=0.1)
    assert (motion["x"][0], motion["x'"][0]) == (1, 0.5)


def test_a_singular_lagrangian_is_refused_where_it_matters(recwarn):
    frozen = nhsym.System(coordinates=["x", "y"], lagrangian="x'^2/2 + y")
    with pytest.raises(nhsym.InputError, match="inertia"):
        frozen.accelerations([1, 2], [0, 0])
    del frozen
    assert not recwarn.list


def test_definitions_domain_and_quasi_velocities():
    skate = nhsym.System(coordinates={"phi": "angle", "x": {"type": "length"}, "y": "length"}, parameters={"m": 2, "J": 0.5}, definitions={"T": "m/2*(x'^2 + y'^2)"},
                         lagrangian="T + J/2*phi'^2", constraints="y'*cos(phi) = x'*sin(phi)", domain={"phi": (-1, 1)}, title="A skate: on ice",
                         quasi_velocities={"names": ["omega", "v"], "map": {"phi'": "omega", "x'": "v*cos(phi)", "y'": "v*sin(phi)"}})
    assert set(skate.analyze().equations) == {"omega", "v"}


def test_the_readme_of_the_package():
    words = (pathlib.Path(nhsym.__file__).parents[1] / "README.md").read_text()
    printed = []
    exec(words.split("```python\n")[1].split("```")[0], {"print": lambda *given: printed.append(given)})
    assert any("sin(phi/k)" in line[1] and line[2] == "proved" for line in printed)


DRIVEN = "name: driven\nparameters: [{name: m, value: 2}, {name: k, value: 8}, {name: u, value: 0}]\ncoordinates: [x]\nlagrangian: m*x'^2/2 - k*x^2/2\nforces: [x = u]\n"


def test_inputs_over_time():
    """2 x'' + 8 x = u from rest at 0.  u = 2 sin t: x = (sin(t) - sin(2t)/2)/3; u = 8 from t = 0 on: x = 1 - cos(2t); a ramp u = 8t: x = t - sin(2t)/2."""
    driven = nhsym.system(DRIVEN)
    rest, cases = {"x": 0, "x'": 0}, [
        ("2*sin(t)", lambda t: (numpy.sin(t) - numpy.sin(2 * t) / 2) / 3, 1e-9), (2 * sympy.sin(t), lambda t: (numpy.sin(t) - numpy.sin(2 * t) / 2) / 3, 1e-9),
        (lambda t: 2 * numpy.sin(t), lambda t: (numpy.sin(t) - numpy.sin(2 * t) / 2) / 3, 1e-5), (8, lambda t: 1 - numpy.cos(2 * t), 1e-9),
        (([0, 3], [0, 24]), lambda t: t - numpy.sin(2 * t) / 2, 1e-9), (([0], [8]), lambda t: 1 - numpy.cos(2 * t), 1e-9)]
    for u, exact, error in cases:
        motion = driven.simulate(initial=rest, until=3, step=0.5, inputs={"u": u})
        assert motion.complete and len(motion["t"]) == 7 and motion["x"] == pytest.approx(exact(motion["t"]), abs=error)
    late = driven.simulate(initial=rest, until=3, step=0.5, inputs={"u": ([1, 1.5, 2], [0, 8, 0])})
    assert abs(late["x"][late["t"] <= 1]).max() < 1e-12 and abs(late["x"][-1]) > 0.1
    assert driven.simulate(initial=rest, until=1)["x"][-1] == 0  # the system itself remains as it was
    early = driven.simulate(initial=dict(rest, t=-2), until=1, inputs={"u": lambda t: 8 * (t + 2)})
    assert early["x"][-1] == pytest.approx(3 - numpy.sin(6) / 2, abs=1e-9)


def test_accelerations_with_inputs():
    driven = nhsym.system(DRIVEN)
    times = numpy.array([[0.0, 1.0, 2.0], [0.5, 1.5, 1.0]])
    q, v = numpy.full((1, 2, 3), 0.25), numpy.zeros((1, 2, 3))
    for u in ("3*t", 3 * t, lambda x: 3 * x, ([0, 4], [0, 12]), ([0, 1, 4], [0, 3, 12])):
        assert driven.accelerations(q, v, times, inputs={"u": u})[0] == pytest.approx((3 * times - 2) / 2, abs=1e-12)
        assert driven.right_hand_side(1.0, [0.25, 0.0], inputs={"u": u}) == pytest.approx([0, 0.5], abs=1e-12)
    assert driven.accelerations(q, v, times)[0] == pytest.approx(numpy.full((2, 3), -1))
    assert driven.accelerations(q, v, times, inputs={"u": "3*t"})[0][0, 0] == pytest.approx(-1) and driven.accelerations([0.25], [0.0]) == pytest.approx([-1])


def test_inputs_that_do_not_fit_are_refused_kindly():
    driven = nhsym.system(DRIVEN)
    for inputs, said in (({"uu": "sin(t)"}, "`uu`"), ({"u": "sin(tt)"}, "`tt`"), ({"u": ([0, 0], [1, 2])}, "rising times"), ({"u": ([0, 1], [1])}, "rising times"), ({"u": [1, 2, 3]}, "cannot be"),
                         ({"u": ([0, float("nan")], [1, 2])}, "rising times"), ({"u": None}, "expression is needed"), ("u=1", "cannot be"), ({"u": (numpy.arange(1001), numpy.arange(1001))}, "1000 are allowed")):
        for ask in (lambda: driven.simulate(initial={"x": 1}, until=1, inputs=inputs), lambda: driven.accelerations([1], [0], inputs=inputs)):
            with pytest.raises(nhsym.Error, match=said) as error:
                ask()
            assert error.value.hint and "--" not in str(error.value), str(error.value)
    with pytest.raises(nhsym.UsageError, match="end of the motion"):
        driven.simulate(inputs={"u": abs})
    with pytest.raises(nhsym.UsageError, match="1000 are allowed"):
        driven.accelerations(numpy.zeros((1, 1001)), numpy.zeros((1, 1001)), numpy.arange(1001), inputs={"u": abs})
    with pytest.raises(ZeroDivisionError):
        driven.simulate(until=1, inputs={"u": lambda t: 1 / 0})
    with pytest.raises(nhsym.ArgumentError, match="did you mean `inputs`"):
        driven.simulate(input={"u": "t"})
    assert driven.accelerations([1], [0]) == pytest.approx([-4])


def test_a_scan_asks_at_every_point():
    spring = nhsym.system(OSCILLATOR)
    table = spring.scan({"k": "0.1:0.5:5", "m": [1, fractions.Fraction(1, 2)]}, {"rate": lambda s: s.accelerations([1.0], [0.0])[0], "name": lambda s: s.name})
    assert list(table) == ["k", "m", "rate", "name"] and list(table["k"][::2]) == [0.1, 0.2, 0.3, 0.4, 0.5]
    assert table["rate"] == pytest.approx(-table["k"] / table["m"]) and set(table["name"]) == {"spring"}
    assert list(spring.scan({"k": "1, 5/2"}, lambda s: s.parameters["k"])["number"]) == [1, 2.5]
    for over, number in (({"k": "1:2"}, abs), ({"k": "1:2:1"}, abs), ({"k": "a:b:3"}, abs), ({"k": 7}, abs), ("k=1", abs), ({"k": [1]}, "independent"), ({"q": [1]}, abs)):
        with pytest.raises(nhsym.Error) as error:
            spring.scan(over, number)
        assert error.value.hint
