"""Results as objects."""
import base64
import re
import sys
import warnings

import numpy
import pytest
import sympy

import nhsym
from nhsym.results import FORMULAS


@pytest.fixture(scope="module")
def sleigh():
    return nhsym.system("sleigh")


@pytest.fixture(scope="module")
def analysis(sleigh):
    return sleigh.analyze()


def states(system, count=300):
    draw = numpy.random.default_rng(3)
    m = len(system.coordinates)
    return draw.uniform(0.1, 1, (m, count)), draw.uniform(0.1, 1, (m, count)), draw.uniform(0, 1, count)


def test_whether_there_is_any_other_integral():
    """The option reaches the library, and the answer is a part of the JSON."""
    question = nhsym.system("damped_oscillator")
    assert "absence" in question.analyze(absence=True, options={"seed": 2}).json
    with pytest.raises(nhsym.Error, match="absence"):
        question.analyze(options={"absence": 2})


def test_currents(analysis):
    assert analysis.verdict == "FOUND" and analysis.independent == 5 and analysis.most == 5
    energy = analysis["Phi1"]
    assert energy is analysis.currents[0] and energy.proved and energy.for_all and "energy" in energy.meaning and energy.case == 1
    assert energy.symmetry.components["t"] == "1"
    assert list(analysis.table["name"]) == [c.name for c in analysis.currents] and analysis.table["drift"].dtype == float
    with pytest.raises(AttributeError, match="did you mean `case`"):
        energy.cas
    with pytest.raises(KeyError, match="there is no `Phi77`; did you mean `Phi"):
        analysis["Phi77"]


@pytest.mark.parametrize("name", ["sleigh", "kepler", "vertical_disk"])
def test_values_are_those_of_the_formula_in_sympy(name):
    system = nhsym.system(name)
    q, v, t = states(system)
    arguments = [sympy.Symbol(word) for word in ["t"] + list(system.coordinates) + [c + "'" for c in system.coordinates]]
    compared = 0
    for current in system.analyze().currents:
        if current.formula is None:
            continue
        function = sympy.lambdify(arguments, current.sympy().subs({sympy.Symbol(p): value for p, value in system.parameters.items()}), "numpy")
        with numpy.errstate(all="ignore"):
            by_hand = numpy.broadcast_to(function(t, *q, *v), t.shape)
        values, good = current(q, v, t), numpy.isfinite(by_hand)
        assert values[good] == pytest.approx(by_hand[good], rel=1e-9, abs=1e-9)
        assert current(q[:, 0], v[:, 0], t[0]) == pytest.approx(values[0], nan_ok=True)
        compared += good.sum()
    assert compared > 300


def test_every_formula_of_a_result_goes_to_sympy(analysis, sleigh):
    def walk(value, inside):
        if isinstance(value, nhsym.Formula):
            value.sympy()
            return 1
        if isinstance(value, (nhsym.Record, dict)):
            return sum(walk(value[key], inside) for key in value.keys())
        return sum(walk(entry, inside) for entry in value) if isinstance(value, list) else 0
    assert sum(walk(nhsym.Record(analysis.json)[key], False) for key in analysis.json if key not in ("motion", "figures")) > 30
    reduction = nhsym.system("vertical_disk").reduce()
    assert sum(walk(reduction[key], False) for key in reduction.json) > 10 and FORMULAS


def test_events_and_section():
    motion = nhsym.system("henon_heiles").simulate(initial={"y": 0.1, "x'": 0.4}, until=60, events=["y, falling", "t = 50, stop"], section="x")
    assert motion.table["t"][-1] == pytest.approx(50, abs=1e-12) and motion.json["events"][1]["time"] == [motion.table["t"][-1]]
    assert len(motion.section_table["t"]) == 8 and abs(motion.section_table["x"]).max() < 1e-12 and (motion.section_table["x'"] > 0).all()


def test_a_motion(sleigh, analysis):
    motion = sleigh.simulate(initial={"omega": 2}, until=2, step=0.1)
    assert len(motion.table["t"]) == 21 and motion.complete and motion["phi"][0] == 0
    for current in analysis.currents[:3]:
        assert numpy.ptp(current.along(motion)) < 1e-6
    assert motion["phi_dot"] is motion["phi'"]
    with pytest.raises(KeyError, match="there is no `omga`; did you mean `omega`"):
        motion["omga"]
    watched = sleigh.simulate(initial="omega=2", until=1, watch={"T": "m/2*v^2"})
    assert set(watched.table) == {"t", "T"}
    with pytest.raises(nhsym.UsageError, match="watch"):
        watched.states()
    assert motion.plot("x", "y")._repr_svg_().startswith("<svg") and motion.plot("t", "x", "y")._repr_html_().count("<img") == 2
    with pytest.raises(nhsym.UsageError, match="zz"):
        motion.plot("zz")
    assert motion.plot("t", "x_dot")._repr_svg_().partition("</title>")[2] == motion.plot("t", "x'")._repr_svg_().partition("</title>")[2]
    with pytest.raises(nhsym.UsageError, match="did you mean `x_dot`"):
        motion.plot("t", "xdot")


def test_a_motion_that_ends_early_says_so():
    fall = nhsym.System(coordinates=["r"], lagrangian="r'^2/2 + 1/r")
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        motion = fall.simulate(initial={"r": 1, "r'": 0}, until=5)
    assert not motion.complete and any("ended early" in str(w.message) for w in seen)


def test_verification(sleigh):
    yes, no = sleigh.verify("m*(v^2 + a^2*k^2*omega^2)"), sleigh.verify("m*v")
    assert yes and yes.holds and yes.proved and not no and no.counterexample.rate != 0
    assert sleigh.verify(field={"Z0": 1, "phi": "phi'", "x": "x'", "y": "y'"}).json["schema"] == 1
    with pytest.raises(nhsym.UsageError):
        sleigh.verify()


def test_reduction_classification_and_benchmark():
    reduction = nhsym.system("vertical_disk").reduce()
    assert reduction.group.dimension == 4 and reduction.stages[0].kind == "chaplygin" and len(reduction.table["kind"]) == len(reduction.stages)
    two = nhsym.System(coordinates=["x", "y"], parameters={"k": 3}, lagrangian="(x'^2 + y'^2)/2 - (x^2 + k*y^2)/2")
    special = two.classify(sympy.Symbol("k"), options={"degree": 2})
    assert 1.0 in special.table["value"] and "k = 1" in special.table["where"] and special.special[0].currents[0].current.sympy() and "k = 1" in special.text and "<iframe" in special._repr_html_() and "end{document}" in special.latex
    benchmark = two.benchmark(0.2, initial={"x": 1}, until=2)
    assert len(benchmark.table["method"]) > 5 and benchmark.table["error"].dtype == float


def test_a_benchmark_takes_what_the_command_takes(sleigh, tmp_path):
    benchmark = sleigh.benchmark(0.3, method=["rk8pd", "dalembert"], initial={"phi'": 1, "x'": 1, "y'": 0.1}, project=True)
    assert {m.partition(",")[0] for m in benchmark.table["method"]} == {"GSL rk8pd", "Lagrange-d'Alembert"} and benchmark.csv.startswith("method,formulation,")
    by_steps = benchmark.table["method"] == "Lagrange-d'Alembert"
    observed = benchmark.table["observed_order"][by_steps]
    observed = observed[numpy.isfinite(observed)]  # a slow machine may have made one run
    assert (benchmark.table["order"][by_steps] == 2).all() and (not len(observed) or abs(numpy.median(observed) - 2) < 0.3)
    benchmark.save(tmp_path / "runs.csv")
    benchmark.save(tmp_path / "runs.svg")
    assert (tmp_path / "runs.csv").read_text() == benchmark.csv and "</svg>" in (tmp_path / "runs.svg").read_text() and "</svg>" in benchmark.plot()._repr_svg_()
    assert sleigh.benchmark(0.4, over={"a": "1:2:2"}).stress[0].axes == ["a"]
    with pytest.raises(nhsym.UsageError, match="dalembert"):
        sleigh.benchmark(method="dalembrt")
    with pytest.raises(nhsym.UsageError, match="over"):
        sleigh.benchmark(method="rk8pd", over="a=1:2")
    with pytest.raises(nhsym.UsageError, match="no picture"):
        sleigh.verify("m*v").save(tmp_path / "no.svg")


def test_columns_have_the_kind_of_their_values(analysis):
    table = analysis.table
    assert table["proved"].dtype == bool and (~table["proved"]).sum() == 0 and table["digits"].dtype == float and table["name"].dtype == object


def test_tables_make_data_frames(analysis):
    pandas = pytest.importorskip("pandas")
    assert list(pandas.DataFrame(analysis.table).columns)[0] == "name"
    frame = pandas.DataFrame(analysis.currents)
    assert list(frame["formula"]) == [current.formula for current in analysis.currents]
    assert set(frame.columns) == set(analysis.currents[0]) and "drift" in frame
    assert list(frame["name"]) == [current.name for current in analysis.currents]


def test_documents(analysis, sleigh, tmp_path):
    assert "FOUND" in analysis.text and analysis.latex.startswith("%")
    assert 'srcdoc="&lt;!DOCTYPE' in analysis._repr_html_() and analysis._repr_latex_().count("&=") == len(analysis.currents)
    for ending in ("html", "tex", "json", "txt"):
        analysis.save(tmp_path / ("result." + ending))
        assert (tmp_path / ("result." + ending)).stat().st_size > 1000
    with pytest.raises(nhsym.UsageError, match="doc"):
        analysis.save(tmp_path / "result.doc")
    assert sleigh.verify("m*v").latex.startswith("%")
    assert "currents" in dir(analysis) and "verdict" in repr(nhsym.Record(analysis.json))


def test_linear_equations_at_a_state_and_along_a_family():
    pendulum = nhsym.system("double_pendulum")
    up = pendulum.linearize({"p": "pi", "q": "pi"})
    assert up.verdict == "unstable" and up.velocities == ["p'", "q'"]
    n = len(up.M)
    A = numpy.block([[numpy.zeros((n, n)), numpy.eye(n)], [-numpy.linalg.solve(up.M, up.K), -numpy.linalg.solve(up.M, up.C)]])
    assert numpy.allclose(A, up.A, atol=1e-12)
    assert numpy.allclose(sorted(numpy.linalg.eigvals(A).real), sorted(up.eigenvalues.real), atol=1e-12)
    assert (up.errors < 1e-13).all() and up.plot()._repr_svg_().startswith("<svg") and up.csv.startswith("re,im")
    family = pendulum.linearize({"p": "pi", "q": "pi"}, over={"g": "-1,1"})
    assert [change["positive_after"] for change in family.changes] == [2] and len(family.at(0)["eigenvalues"]) == 4
    assert list(family.table["verdict"]) == ["marginal", "unstable"]


def test_columns_have_the_names_of_the_csv_and_of_the_language(tmp_path):
    """Also where expressions are watched, and where two columns have one name."""
    sleigh = nhsym.system("sleigh")
    for settings in ({}, {"watch": ["x'", "x'^2 + 1", "sin(phi)"]}, {"watch": {"E": "v"}}):
        motion = sleigh.simulate(initial={"omega": 2}, until=1, step=0.5, **settings)
        motion.save(tmp_path / "motion.csv")
        header, *rows = (tmp_path / "motion.csv").read_text().splitlines()
        assert list(motion.table) == header.split(",")
        values = numpy.array([[float(cell) for cell in row.split(",")] for row in rows])
        assert (values == numpy.array(list(motion.table.values())).T).all()
        names = [nhsym._library.library().nh_simulation_column(motion._address, i).decode() for i in range(len(motion.table))]
        assert all(name in motion.table and motion.table.get(name) is motion[name] for name in names)
    frame = pytest.importorskip("pandas").DataFrame(sleigh.simulate(until=1).table)
    assert "phi_dot" in frame and "phi'" not in frame
    with pytest.raises(KeyError, match="did you mean `x_dot`"):
        motion = sleigh.simulate(until=1).table["dx"]


def test_what_is_printed_is_short(sleigh, analysis):
    motion, crowd = sleigh.simulate(until=5), nhsym.system("isotropic_oscillator")
    for result in (analysis, motion, sleigh.verify("m*v"), nhsym.system("knife_edge").reduce(), crowd.analyze(options={"degree": 1}), crowd.simulate(until=1), nhsym.system("double_pendulum").linearize()):
        assert 2 <= len(str(result).splitlines()) <= 12 and max(map(len, str(result).splitlines())) <= 120 and "\n" not in repr(result)
        assert "`text`" in str(result) or str(result) == result.text.rstrip()
    assert analysis["Phi1"].formula in str(analysis) and "101 rows" in str(motion) and "3.5" not in repr(motion)


class Axes:
    """As Matplotlib's: what was drawn."""

    def __init__(self):
        self.drawn = []

    def plot(self, x, y, *more, **words):
        self.drawn.append((len(x), len(y)))

    def __getattr__(self, name):
        return lambda *given: None


def test_pictures_survive_and_matplotlib_draws(sleigh, monkeypatch):
    motion = sleigh.simulate(initial={"omega": 2}, until=1)
    bundle = motion.plot("x", "y")._repr_mimebundle_()
    assert set(bundle) == {"text/plain", "text/html", "image/svg+xml"} and "<script" not in str(bundle) and "<svg" not in bundle["text/html"]
    inside = re.search('base64,([^"]*)"', bundle["text/html"]).group(1)
    assert base64.b64decode(inside).decode() == bundle["image/svg+xml"]
    assert set(motion.plot("x", "y")._repr_mimebundle_(include=["text/plain"])) == {"text/plain"}
    axes, pendulum = Axes(), nhsym.system("double_pendulum")
    assert motion.plot("t", "x", "x'", ax=axes) is axes and axes.drawn == [(101, 101)] * 2
    for result in (pendulum.linearize(), pendulum.linearize(over={"g": "1:9:3"}), sleigh.benchmark(0.1, method="rk8pd")):
        drawn = len(axes.drawn)
        assert result.plot(ax=axes) is axes and len(axes.drawn) > drawn
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(nhsym.UsageError, match="python3-matplotlib"):
        motion.plot(ax=True)
    with pytest.raises(nhsym.UsageError, match="axes of Matplotlib"):
        motion.plot(ax=7)


def test_a_part_whose_key_is_a_formula_elsewhere_has_attributes(analysis):
    assert analysis.constraint.type == "linear" and analysis.constraint.growth_vector == [2, 3]
