"""Names of types in the hints."""
from typing import Any, Callable, Iterable, Mapping, Optional, Protocol, Sequence, SupportsFloat, Tuple, Union



class Symbolic(Protocol):
    """An expression of SymPy."""

    @property
    def free_symbols(self) -> Any: ...


Expression = Union[str, SupportsFloat, Symbolic]          # a text in the language of system files, a number, SymPy
Pairs = Union[str, Mapping[Any, Expression]]              # "m=2, k=3" or {"m": 2, "k": 3}
Expressions = Union[str, Symbolic, Iterable[Expression], Mapping[str, Expression]]
Names = Union[str, Symbolic, Iterable[Any]]
Progress = Callable[[str, Optional[float]], object]       # (what is done, its part in [0, 1] or None)
Numbers = Any                                             # what numpy.asarray takes
Input = Union[Expression, Callable[[float], SupportsFloat], Tuple[Sequence[float], Sequence[float]]]
