"""Runs the code cells of a notebook, without Jupyter.

    sh tests/python.sh src/python/tests/notebook.py docs/nhsym.ipynb          runs them and stores what they show in the notebook
"""
import ast
import contextlib
import io
import json
import sys

KINDS = (("_repr_svg_", "image/svg+xml"), ("_repr_latex_", "text/latex"), ("_repr_html_", "text/html"))


def shown(value):
    """What a notebook would show of a value: all that it offers at once, or its best form and its text."""
    data = {"text/plain": repr(value)}
    if hasattr(value, "_repr_mimebundle_"):
        return value._repr_mimebundle_()
    for method, kind in KINDS:
        form = getattr(value, method, lambda: None)()
        if form and len(form) < 100000:  # a whole page would swell the file
            return dict(data, **{kind: form})
    return data


def run(notebook):
    """Executes every code cell in one namespace; the notebook with new outputs.  A failing cell raises."""
    space, number = {"__name__": "__main__"}, 0
    for cell in notebook["cells"]:
        if cell["cell_type"] != "code":
            continue
        number += 1
        code = ast.parse("".join(cell["source"]))
        last = ast.Expression(code.body.pop().value) if code.body and isinstance(code.body[-1], ast.Expr) else None
        printed, outputs = io.StringIO(), []
        with contextlib.redirect_stdout(printed):
            exec(compile(code, "cell %d" % number, "exec"), space)
            value = eval(compile(last, "cell %d" % number, "eval"), space) if last else None
        if printed.getvalue():
            outputs.append({"output_type": "stream", "name": "stdout", "text": printed.getvalue().splitlines(True)})
        if value is not None:
            outputs.append({"output_type": "execute_result", "execution_count": number, "metadata": {},
                            "data": {kind: text.splitlines(True) for kind, text in shown(value).items()}})
        cell.update(outputs=outputs, execution_count=number)
    return notebook


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as file:
        result = run(json.load(file))
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1, ensure_ascii=False)
        file.write("\n")
