"""libnhsym by ctypes: nhsym.h, declaration by declaration (a test compares the two), and its errors as exceptions."""
import ctypes
import functools
import os
import pathlib
import re
from typing import Optional
from ctypes import POINTER, c_bool, c_char, c_char_p, c_double, c_int, c_size_t, c_void_p

SONAME = "libnhsym.so.1"
TEXT, JSON, HTML, LATEX, CSV, SVG = range(6)      # nh_format
PLAIN, AS_LATEX, AS_MATHML = range(3)   # nh_syntax


class ErrorRecord(ctypes.Structure):
    """nh_error"""
    _fields_ = [("code", c_int), ("where", c_char * 256), ("what", c_char * 768), ("hint", c_char * 512), ("excerpt", c_char * 1024)]


class Question(ctypes.Structure):
    """nh_question"""
    _fields_ = [("system", c_char_p), ("system_text", c_char_p), ("analysis", c_char_p), ("analysis_text", c_char_p), ("no_analysis", c_bool),
                ("set", c_char_p), ("velocities", c_char_p), ("initial", c_char_p), ("until", c_double), ("step", c_double), ("accuracy", c_double),
                ("watch", c_char_p), ("method", c_char_p), ("options", c_char_p), ("project", c_bool)]


class Comparison(ctypes.Structure):
    """nh_comparison"""
    _fields_ = [("seconds", c_double), ("methods", c_char_p), ("robustness", c_bool), ("over", c_char_p)]


class CurrentFacts(ctypes.Structure):
    """nh_current_facts"""
    _fields_ = [("name", c_char_p), ("meaning", c_char_p), ("proved", c_bool), ("for_all", c_bool), ("independent", c_bool), ("digits", c_double),
                ("drift", c_double)]


PROGRESS = ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_double)
_numbers = c_void_p  # of arrays, whose addresses numpy gives
_error = POINTER(ErrorRecord)

# name: result, arguments; a string that the caller frees comes as c_void_p.
SIGNATURES = {
    "nh_error_clear": (None, [_error]),
    "nh_error_format": (None, [_error, c_char_p, c_size_t]),
    "nh_version_text": (c_char_p, []),
    "nh_context_create": (c_void_p, []),
    "nh_context_free": (None, [c_void_p]),
    "nh_context_on_progress": (None, [c_void_p, PROGRESS, c_void_p]),
    "nh_context_interrupt": (None, [c_void_p]),
    "nh_systems": (c_void_p, [_error]),
    "nh_problem_open": (c_void_p, [c_void_p, POINTER(Question), _error]),
    "nh_problem_free": (None, [c_void_p]),
    "nh_problem_input": (c_bool, [c_void_p, c_char_p, c_char_p, _error]),
    "nh_problem_name": (c_char_p, [c_void_p]),
    "nh_problem_coordinates": (c_size_t, [c_void_p]),
    "nh_problem_coordinate": (c_char_p, [c_void_p, c_size_t]),
    "nh_problem_parameters": (c_size_t, [c_void_p]),
    "nh_problem_parameter": (c_char_p, [c_void_p, c_size_t, POINTER(c_double)]),
    "nh_analyze": (c_void_p, [c_void_p, _error]),
    "nh_simulate": (c_void_p, [c_void_p, _error]),
    "nh_simulate_zeros": (c_void_p, [c_void_p, c_char_p, c_char_p, _error]),
    "nh_reduce": (c_void_p, [c_void_p, _error]),
    "nh_verify_current": (c_void_p, [c_void_p, c_char_p, _error]),
    "nh_verify_field": (c_void_p, [c_void_p, c_char_p, _error]),
    "nh_classify_over": (c_void_p, [c_void_p, c_char_p, c_bool, _error]),
    "nh_benchmark_methods": (c_void_p, [c_void_p, POINTER(Comparison), _error]),
    "nh_linearize": (c_void_p, [c_void_p, c_char_p, _error]),
    "nh_analysis_free": (None, [c_void_p]),
    "nh_simulation_free": (None, [c_void_p]),
    "nh_reduction_free": (None, [c_void_p]),
    "nh_verification_free": (None, [c_void_p]),
    "nh_classified_free": (None, [c_void_p]),
    "nh_benchmark_free": (None, [c_void_p]),
    "nh_linearized_free": (None, [c_void_p]),
    "nh_export_functions": (c_void_p, [c_void_p, c_char_p, c_char_p, c_char_p, c_char_p, _error]),
    "nh_export_code": (c_void_p, [c_void_p, c_size_t, c_void_p, _error]),
    "nh_export_free": (None, [c_void_p]),
    "nh_analysis_document": (c_void_p, [c_void_p, c_int, _error]),
    "nh_simulation_document": (c_void_p, [c_void_p, c_int, _error]),
    "nh_reduction_document": (c_void_p, [c_void_p, c_int, _error]),
    "nh_verification_document": (c_void_p, [c_void_p, c_int, _error]),
    "nh_classified_document": (c_void_p, [c_void_p, c_int, _error]),
    "nh_benchmark_document": (c_void_p, [c_void_p, c_int, _error]),
    "nh_linearized_document": (c_void_p, [c_void_p, c_int, _error]),
    "nh_string_free": (None, [c_void_p]),
    "nh_analysis_verdict": (c_char_p, [c_void_p]),
    "nh_analysis_search": (c_char_p, [c_void_p]),
    "nh_analysis_currents": (c_size_t, [c_void_p]),
    "nh_analysis_independent": (c_size_t, [c_void_p]),
    "nh_analysis_most": (c_size_t, [c_void_p]),
    "nh_current_describe": (CurrentFacts, [c_void_p, c_size_t]),
    "nh_current_formula": (c_void_p, [c_void_p, c_size_t, c_int]),
    "nh_formula_typeset": (c_void_p, [c_char_p, c_int]),
    "nh_current_value": (c_double, [c_void_p, c_size_t, c_double, _numbers, _numbers]),
    "nh_current_values": (c_bool, [c_void_p, c_size_t, c_size_t, _numbers, _numbers, _numbers, _numbers]),
    "nh_simulation_rows": (c_size_t, [c_void_p]),
    "nh_simulation_columns": (c_size_t, [c_void_p]),
    "nh_simulation_column": (c_char_p, [c_void_p, c_size_t]),
    "nh_simulation_value": (c_double, [c_void_p, c_size_t, c_size_t]),
    "nh_simulation_read": (None, [c_void_p, c_size_t, _numbers]),
    "nh_simulation_svg": (c_void_p, [c_void_p, c_size_t, c_size_t]),
    "nh_verification_holds": (c_bool, [c_void_p]),
    "nh_verification_proved": (c_bool, [c_void_p]),
    "nh_rates_create": (c_void_p, [c_void_p, _error]),
    "nh_rates_free": (None, [c_void_p]),
    "nh_rates_at": (None, [c_void_p, c_size_t, _numbers, _numbers, _numbers, _numbers]),
}


# ---- the library ----

def _candidates():
    """NHSYM_LIBRARY alone where it is set; else the one that a wheel brings, the build of the sources that this package lies in, and what the system's loader finds."""
    given = os.environ.get("NHSYM_LIBRARY")
    if given:
        return [given]
    here = pathlib.Path(__file__).resolve()
    near = [here.parent / "lib" / SONAME] + [parent / "build" / SONAME for parent in here.parents[1:4]]
    return [str(path) for path in near if path.exists()] + [SONAME]


def _blas_as_in_the_program():
    """OpenBLAS's settings of src/cli/archives.c, for the copy that comes with the library: it reads them when it is loaded."""
    settings = {"OPENBLAS_NUM_THREADS": "1"}
    try:
        words = pathlib.Path("/proc/cpuinfo").read_text().split()
    except OSError:
        words = []
    if "avx2" in words and "fma" in words:
        settings["OPENBLAS_CORETYPE"] = "Haswell"
    return {name: value for name, value in settings.items() if name not in os.environ}


def _open():
    reasons = []
    for path in _candidates():
        try:
            return ctypes.CDLL(path)
        except OSError as reason:
            reasons.append(str(reason))
    raise ImportError("the library %s cannot be loaded: %s\nhint: install it (`make install`, or the package libnhsym1), or let NHSYM_LIBRARY name it"
                      % (SONAME, "; ".join(reasons)))


@functools.lru_cache(maxsize=None)
def library():
    """libnhsym with the signatures of its functions; loaded when it is needed first."""
    added = _blas_as_in_the_program()
    os.environ.update(added)
    try:
        loaded = _open()
    finally:
        for name in added:
            del os.environ[name]
    for name, (result, arguments) in SIGNATURES.items():
        try:
            function = getattr(loaded, name)
        except AttributeError:
            raise ImportError("%s has no %s: it is older than this package\nhint: install both from the same sources" % (loaded._name, name)) from None
        function.restype = result
        function.argtypes = arguments
    return loaded


def library_version() -> str:
    """The version of libnhsym.

    Returns
    -------
    str

    Examples
    --------
    >>> nhsym.library_version() == nhsym.__version__
    True
    """
    return library().nh_version_text().decode()


def taken(address):
    """The text at an address, which is freed; None for none."""
    if not address:
        return None
    try:
        return ctypes.string_at(address).decode()
    finally:
        library().nh_string_free(address)


# ---- errors ----

class Error(Exception):
    """What went wrong.

    Attributes
    ----------
    where : str
        "file:line:column", or "".
    what, hint : str
        The cause and the cure.
    excerpt : str
        The line of a file, with a caret below it, or "".
    code : int
        The exit code of the program.

    Examples
    --------
    >>> try:
    ...     nhsym.system("sleihg")
    ... except nhsym.Error as error:
    ...     print(error.hint)
    did you mean `sleigh`?
    """

    def __init__(self, what: str, hint: str = "", where: str = "", excerpt: str = "", code: int = 2, text: Optional[str] = None) -> None:
        super().__init__(text or (what + ("\nhint: " + hint if hint else "")))
        self.what, self.hint, self.where, self.excerpt, self.code = what, hint, where, excerpt, code


class UsageError(Error, ValueError):
    """An invalid question: a name, an option, a number.

    Examples
    --------
    >>> try:
    ...     nhsym.system("sleigh").simulate(until=-1)
    ... except nhsym.UsageError as error:
    ...     print(error.what)
    until needs a positive number, found -1
    """


class InputError(Error, ValueError):
    """An error in a system file or an analysis file.

    Examples
    --------
    >>> try:
    ...     nhsym.System(coordinates=["x"], lagrangian="x'^2/2 - kk*x", parameters={"k": 1}, name="mine")
    ... except nhsym.InputError as error:
    ...     print(error.where, error.what, error.hint, sep="; ")
    mine:6:23; unknown name `kk`; did you mean `k`?
    """


class NumericalError(Error, ArithmeticError):
    """A numerical failure, with its reason.

    Examples
    --------
    >>> issubclass(nhsym.NumericalError, ArithmeticError)
    True
    """


class LimitError(Error, RuntimeError):
    """A limit of time, memory or iterations was reached.

    Examples
    --------
    >>> issubclass(nhsym.LimitError, RuntimeError)
    True
    """


_classes = {2: UsageError, 3: InputError, 4: NumericalError, 5: LimitError}


def _here(said):
    """An option of the program is an argument here."""
    return re.sub(r'--([a-z_]+)\b', r"\1", re.sub(r'--([a-z_]+) "', r'\1="', said))


def error_of(record):
    """The exception of an nh_error."""
    text = ctypes.create_string_buffer(4096)
    library().nh_error_format(ctypes.byref(record), text, len(text))
    words = [getattr(record, name).decode(errors="replace") for name in ("what", "hint", "where", "excerpt")]
    words, whole = [_here(said) for said in words], _here(text.value.decode(errors="replace"))
    return _classes.get(record.code, Error)(*words, code=record.code, text=whole)
