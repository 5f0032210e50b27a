"""The declarations of the package are those of nhsym.h."""
import ctypes
import pathlib
import re

import nhsym
from nhsym import _library

HEADER = (pathlib.Path(__file__).resolve().parents[2] / "nhsym.h").read_text()
BARE = re.sub(r"/\*.*?\*/", "", HEADER, flags=re.DOTALL)
PLAIN = {"bool": ctypes.c_bool, "size_t": ctypes.c_size_t, "double": ctypes.c_double, "nh_code": ctypes.c_int, "nh_format": ctypes.c_int, "nh_syntax": ctypes.c_int,
         "nh_current_facts": _library.CurrentFacts, "void": None}


def ctype(text, freed=False):
    """The ctypes of a C type: addresses of opaque objects and of arrays are c_void_p, strings c_char_p unless the caller frees them."""
    words, stars = text.replace("const", "").replace("*", " ").split(), text.count("*")
    if stars == 0:
        return PLAIN[words[0]]
    if words[0] == "char":
        return ctypes.c_char_p if "const" in text else ctypes.c_void_p
    special = {"nh_error": ctypes.POINTER(_library.ErrorRecord), "nh_question": ctypes.POINTER(_library.Question),
               "nh_comparison": ctypes.POINTER(_library.Comparison)}
    return special.get(words[0], ctypes.c_void_p)


def test_every_function_is_declared_as_in_the_header():
    found = re.findall(r"NH_API\s+([^;{]*?[\s*])(nh_\w+)\((.*?)\);", BARE, re.DOTALL)
    assert {name for _, name, _ in found} == set(_library.SIGNATURES)
    for result, name, arguments in found:
        given = [] if arguments == "void" else re.split(r",\s*(?![^()]*\))", arguments)
        expected = [ctype(re.sub(r"\w+$", "", a.strip())) if "(*" not in a else _library.PROGRESS for a in given]
        declared, types = _library.SIGNATURES[name]
        assert declared == ctype(result), name
        if name == "nh_error_format":
            expected[1] = ctypes.c_char_p  # our own buffer
        if name == "nh_problem_parameter":
            expected[2] = ctypes.POINTER(ctypes.c_double)
        assert types == expected, name


def test_structures_have_the_fields_of_the_header():
    for name, structure in (("nh_error", _library.ErrorRecord), ("nh_question", _library.Question), ("nh_comparison", _library.Comparison), ("nh_current_facts", _library.CurrentFacts)):
        body = re.search(r"typedef struct \{([^}]*)\} %s;" % name, BARE).group(1)
        fields = []
        for line in filter(None, (line.strip() for line in body.split(";"))):
            kind, names = re.match(r"(.*?[\s*])(\w+(?:\[\d+\])?)$", line, re.DOTALL).groups()
            length = re.search(r"\[(\d+)\]", names)
            fields.append((re.sub(r"\[.*", "", names), ctypes.c_char * int(length.group(1)) if length else ctype(kind)))
        assert fields == list(structure._fields_)


def test_numbers_and_versions_agree():
    for enum, first, values in (("nh_format", "NH_FORMAT_TEXT", (_library.TEXT, _library.JSON, _library.HTML, _library.LATEX, _library.CSV, _library.SVG)),
                                ("nh_syntax", "NH_SYNTAX_PLAIN", (_library.PLAIN, _library.AS_LATEX, _library.AS_MATHML))):
        names = re.search(r"typedef enum \{([^}]*)\} %s;" % enum, BARE).group(1).split(",")
        assert names[0].strip() == first and len(names) == len(values) and list(values) == list(range(len(values)))
    assert nhsym.__version__ == nhsym.library_version()
