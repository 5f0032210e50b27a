"""Measures the Python package: sh tests/python.sh tests/bench_python.py prints the table of docs/python.md."""
import resource
import subprocess
import sys
import time

import numpy
import sympy

import nhsym


def best(function, repetitions=7, clock=time.process_time):
    """Processor time, so that it may be measured on a busy machine."""
    seconds = []
    for _ in range(repetitions):
        begin = clock()
        function()
        seconds.append(clock() - begin)
    return min(seconds)


def of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def fresh(statement):
    return best(lambda: subprocess.run([sys.executable, "-c", statement], check=True), clock=of_children)


def row(what, seconds, states=None):
    print("| %s | %s |" % (what, "%.3g ms" % (1e3 * seconds) if states is None else "%.3g ns" % (1e9 * seconds / states) if states > 1 else "%.3g us" % (1e6 * seconds)))


print("| | processor time |\n|---|---|")
row("import numpy, in a new interpreter", fresh("import numpy"))
row("import nhsym", fresh("import nhsym"))
row("import nhsym, and load the library", fresh("import nhsym; nhsym.library_version()"))

sleigh = nhsym.system("sleigh")
current = sleigh.analyze()["Phi2"]
q, v = [0.1, 0.2, 0.3], [1.0, 0.5, 0.0]
row("one value of a current of the sleigh, one call", best(lambda: [current(q, v) for _ in range(1000)]) / 1000, 1)
row("one right-hand side of the sleigh, one call", best(lambda: [sleigh.right_hand_side(0, q + v) for _ in range(1000)]) / 1000, 1)
spring = nhsym.system("name: s\ncoordinates: [x]\nlagrangian: x'^2/2 - x^2/2\n")
row("verify a current of an oscillator, one call", best(lambda: spring.verify("x'^2 + x^2")))

count = 1000000
draw = numpy.random.default_rng(1)
Q, V = draw.normal(size=(3, count)), draw.normal(size=(3, count))
m, a, k = (sleigh.parameters[name] for name in "mak")


def by_hand():
    phi, _, _ = Q
    omega, x, y = V
    return m * ((x * numpy.cos(phi) + y * numpy.sin(phi)) * numpy.sin(phi / k) + a * k * omega * numpy.cos(phi / k))


names = [sympy.Symbol(name) for name in sleigh.coordinates + tuple(c + "'" for c in sleigh.coordinates)]
lambdified = sympy.lambdify(names, current.sympy().subs(sleigh.parameters), "numpy")
assert numpy.allclose(current(Q, V), by_hand(), rtol=1e-12, atol=1e-12) and numpy.allclose(lambdified(*Q, *V), by_hand(), rtol=1e-12, atol=1e-12)
row("that current at 1e6 states, per state", best(lambda: current(Q, V)), count)
row("the same by NumPy, written by hand", best(by_hand), count)
row("the same by SymPy's lambdify", best(lambda: lambdified(*Q, *V)), count)
row("accelerations of the sleigh at 1e6 states, per state", best(lambda: sleigh.accelerations(Q, V), 3), count)
