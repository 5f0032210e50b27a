"""Threads, Ctrl-C, progress, the end of the interpreter."""
import gc
import multiprocessing
import os
import signal
import subprocess
import sys
import threading

import pytest

import nhsym

OSCILLATOR = "name: spring\nparameters: [{name: m, value: 2}, {name: k, value: 8}]\ncoordinates: [x]\nlagrangian: m*x'^2/2 - k*x^2/2\n"


def test_progress_is_told():
    said = []
    nhsym.system(OSCILLATOR).analyze(progress=lambda doing, part: said.append((doing, part)))
    assert said and all(isinstance(doing, str) and (part is None or 0 <= part <= 1) for doing, part in said)


def test_an_exception_of_the_callback_ends_the_computation():
    class Enough(Exception):
        pass

    def enough(doing, part):
        raise Enough
    spring = nhsym.system(OSCILLATOR)
    with pytest.raises(Enough):
        spring.analyze(progress=enough)
    assert spring.analyze().search == "complete"


def test_control_c_ends_the_computation_and_leaves_what_there_is(monkeypatch):
    real, asked, sent = nhsym._calls.library(), threading.Event(), []

    class Watched:
        def __getattr__(self, name):
            return getattr(real, name)

        def nh_context_interrupt(self, address):
            real.nh_context_interrupt(address)
            asked.set()

    def press(doing, part):
        if not sent:
            sent.append(doing)
            os.kill(os.getpid(), signal.SIGINT)
            sent.append(asked.wait(60))  # is the main thread reached while this one computes?

    monkeypatch.setattr(nhsym._calls, "library", Watched)
    spring = nhsym.system(OSCILLATOR)
    with pytest.raises(nhsym.Interrupted) as stop:
        spring.benchmark(600, initial={"x": 1}, progress=press)
    assert isinstance(stop.value, KeyboardInterrupt) and sent[1]
    assert stop.value.partial is None or stop.value.partial.partial
    assert spring.analyze().search == "complete"


def test_threads_work_at_once_and_agree():
    alone, beside = [c.formula for c in nhsym.system("kepler").analyze().currents], []
    threads = [threading.Thread(target=lambda: beside.append([c.formula for c in nhsym.system("kepler").analyze().currents])) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert beside == [alone, alone]


def test_a_shared_result_is_used_by_several_threads():
    analysis, wrong = nhsym.system(OSCILLATOR).analyze(), []

    def evaluate():
        for i in range(200):
            values = [c([1.0], [0.5], 0.1) for c in analysis.currents]
            if values != expected:
                wrong.append(values)
    expected = [c([1.0], [0.5], 0.1) for c in analysis.currents]
    threads = [threading.Thread(target=evaluate) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def child(k):
    return nhsym.system(OSCILLATOR, set={"k": k}).analyze().independent


def test_forked_processes_compute():
    nhsym.system(OSCILLATOR).analyze()  # the parent has its thread already
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map(child, [1, 2, 3]) == [2, 2, 2]


def test_results_outlive_their_system():
    analysis = nhsym.system(OSCILLATOR).analyze()
    gc.collect()
    assert analysis.currents[0]([1.0], [0.0]) and analysis.text


@pytest.mark.parametrize("last", ["", "sys.exit(3)", "raise RuntimeError"])
def test_the_interpreter_ends_with_results_alive(last):
    code = "import sys, nhsym\ns = nhsym.system(%r)\na = s.analyze()\nc = a.currents[0]\ns.accelerations([1.0], [0.0])\nprint(a.verdict)\n%s\n" % (OSCILLATOR, last)
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=100)
    assert run.stdout == "FOUND\n" and run.returncode == {"": 0, "sys.exit(3)": 3}.get(last, 1)


def test_a_missing_library_is_explained():
    run = subprocess.run([sys.executable, "-c", "import nhsym; nhsym.library_version()"], capture_output=True, text=True, env=dict(os.environ, NHSYM_LIBRARY="/nowhere/lib.so"))
    assert "ImportError" in run.stderr and "/nowhere/lib.so" in run.stderr and "hint: install it" in run.stderr
