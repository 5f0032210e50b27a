"""The interfaces for C and Python as Markdown, from the comments of nhsym.h and the docstrings of the package."""
import ast
import inspect
import os
import re
import textwrap


# ---- C ----

def of_c():
    """Sections of nhsym.h as headings, comments as text, declarations as code.  A comment belongs to what follows it."""
    with open("src/nhsym.h", encoding="utf-8") as file:
        text = file.read()
    out = ["# Interface for C", "`#include <nhsym.h>`, and `cc program.c $(pkg-config --cflags --libs nhsym)`. Written from the comments of the header; "
           "nhsym(3) is the same as a manual page. [example.c](docs/example.c) is a whole program."]
    text = text.replace("#ifdef __cplusplus\n}\n#endif\n", "").replace("#ifdef __cplusplus\nextern \"C\" {\n#endif\n", "")
    text = re.sub(r"^#.*\n", "", text, flags=re.M).replace("NH_API ", "")
    for part in re.split(r"^(/\*(?:[^*]|\*(?!/))*\*/)\n", text, flags=re.M):
        section = re.match(r"/\* -+ (.*?) -+ \*/$", part)
        if section:
            out.append("## " + section[1][0].upper() + section[1][1:])
        elif part.startswith("/*"):
            lines = [re.sub(r"^ \* ?", "", line) for line in part[2:-2].strip(" ").split("\n")]
            example = [line for line in lines if line.startswith("    ")]
            words = " ".join(line for line in lines if not line.startswith("    ")).strip()
            out += ["\n".join(example)] if example else []
            out += [prose(re.sub(r"^nhsym: [^.]*[.] *", "", words))] if words else []
        elif part.strip():
            out += [declarations(group) for group in re.split(r"\n\n+", part.strip("\n"))]
    return "\n\n".join(out) + "\n"


def prose(words):
    words = re.sub(r"  +", " ", words).replace("<", "&lt;")
    return re.sub(r"(?<![`\w])(nh_\w+|NH_[A-Z]\w*)", r"`\1`", words)


def declarations(code):
    names = re.findall(r"\b(nh_[a-z_]+)\(", code)
    return "".join('<span id="%s"></span>' % name for name in names) + ("\n\n" if names else "") + "```c\n%s\n```" % code.strip("\n")


# ---- Python ----

FOLDER = "src/python/nhsym"


def of_python():
    """Every public name: its call, what it takes and returns, its example."""
    trees = {name[:-3]: ast.parse(read(os.path.join(FOLDER, name))) for name in sorted(os.listdir(FOLDER)) if name.endswith(".py")}
    package = trees["__init__"]
    public = next(ast.literal_eval(node.value) for node in package.body if isinstance(node, ast.Assign) and node.targets[0].id == "__all__")
    found = {node.name: node for tree in trees.values() for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
    errors = [name for name in public if name.endswith("Error") or name == "Interrupted"]
    order = ["system", "System"] + [name for name in public if name not in ["system", "System"] + errors] + errors
    out = ["# Interface for Python", "Written from the docstrings of the package, which `help(nhsym.System.simulate)` also shows. [Python](docs/python.md) explains how the parts go together."]
    for name in order:
        out += described(name, found[name], "##")
        members = found[name].body if isinstance(found[name], ast.ClassDef) else []
        for node in members:
            if isinstance(node, ast.FunctionDef) and not node.name.startswith("_") and ast.get_docstring(node):
                out += described("%s.%s" % (name, node.name), node, "###")
    return "\n\n".join(out) + "\n"


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def described(name, node, level):
    text = inspect.cleandoc(ast.get_docstring(node) or "")
    head, *sections = re.split(r"^(\w+)\n-{3,}\n", text, flags=re.M)
    property_ = any("property" in ast.unparse(d) for d in getattr(node, "decorator_list", []))
    call = "" if property_ or isinstance(node, ast.ClassDef) and not made_by_call(node) else "```python\n%s\n```" % textwrap.fill(name + arguments(node), 84, subsequent_indent="    ")
    out = ["%s %s" % (level, name)] + ([call] if call else []) + [escaped(head.strip())]
    for title, body in zip(sections[::2], sections[1::2]):
        out += ["```python\n%s\n```" % body.strip()] if title == "Examples" else entries(title, body)
    return out


def made_by_call(node):
    return node.name == "System"


def arguments(node):
    """(q, v, t=0.0), of a class those of its __init__."""
    if isinstance(node, ast.ClassDef):
        node = next(member for member in node.body if getattr(member, "name", "") == "__init__")
    words = node.args
    plain = [a.arg for a in words.posonlyargs + words.args]
    defaults = [None] * (len(plain) - len(words.defaults)) + words.defaults
    shown = [name if value is None else "%s=%s" % (name, ast.unparse(value)) for name, value in zip(plain, defaults) if name not in ("self", "cls")]
    shown += ["*" + words.vararg.arg] if words.vararg else ["*"] if words.kwonlyargs else []
    shown += [a.arg if value is None else "%s=%s" % (a.arg, ast.unparse(value)) for a, value in zip(words.kwonlyargs, words.kw_defaults) if not a.arg.startswith("_")]
    return "(%s)" % ", ".join(shown + (["**" + words.kwarg.arg] if words.kwarg else []))


def entries(title, body):
    """The lines "name : type" with the indented text below them, as a list."""
    items = []
    for line in body.strip("\n").split("\n"):
        if line.startswith("    ") and items:
            items[-1][1].append(line.strip())
        elif line.strip():
            items.append((line.strip(), []))
    if title == "Returns":
        kind, words = items[0]
        return ["Returns *%s*%s" % (escaped(kind), ". " + escaped(" ".join(words)) if words else "")]
    lines = []
    for head, words in items:
        name, colon, kind = head.partition(" : ")
        lines.append("* `%s`%s%s" % (name, " (*%s*)" % escaped(kind) if colon else "", ": " + escaped(" ".join(words)) if words else ""))
    return ["**%s**" % title, "\n".join(lines)]


def escaped(text):
    return re.sub(r"([*_<{}\[\]])", r"\\\1", text)
