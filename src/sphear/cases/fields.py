"""Scalar fields whose Laplacian is known exactly: a few by name, any other by its expression."""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import combinations_with_replacement

from sphear.cases.expressions import COORDINATES, Expression
from sphear.errors import SphearError

GOLDEN_RATIO = (1.0 + math.sqrt(5.0)) / 2.0


@dataclass(frozen=True)
class Field:
    """A scalar field f of the positions with its derivatives; each expression takes positions, shape (N, dimension).

    name: the name it was asked for by, which for an unnamed field is its text.
    text: f in the language of `sphear.cases.expressions`.
    value, laplacian: f and the sum of its second derivatives.
    gradient: df/dx, df/dy, df/dz, as many as there are dimensions.
    """

    name: str
    text: str
    value: Expression
    laplacian: Expression
    gradient: tuple[Expression, ...]

    @property
    def dimension(self) -> int:
        """The number of coordinates: 1, 2 or 3."""
        return self.value.dimension


def quartic(names: tuple[str, ...]) -> str:
    """x^4 + y^4 + z^4, the field of Zheng, Ma & Shao (2018), section 4."""
    return " + ".join(f"{name}**4" for name in names)


def sine(names: tuple[str, ...]) -> str:
    """sin(2 pi x) sin(2 pi y) sin(2 pi z), periodic over a unit length."""
    return "*".join(f"sin(2*pi*{name})" for name in names)


def gaussian(names: tuple[str, ...]) -> str:
    """exp(-r^2 / (2 s^2)), with r the distance from the middle (0.5, 0.5, 0.5) and s = 0.15."""
    squares = " + ".join(f"({name} - 0.5)**2" for name in names)
    return f"exp(-({squares})/(2*0.15**2))"


def polynomial(names: tuple[str, ...], degree: int) -> str:
    """The sum of c_k m_k over all monomials m_k of total degree 0 to `degree`.

    The monomials are numbered by degree, and within a degree in the order of combinations: 1, x, y, x^2, x y, y^2,
    x^3, ... The coefficients have no symmetry by which errors could cancel, no zeros, and similar sizes,

        c_k = (-1)^k (1/2 + fraction of k phi), rounded to 3 decimals, with the golden ratio phi,

    and do not depend on `degree`: each polynomial is the next one without its highest monomials.
    """
    text = ""
    monomials = [m for d in range(degree + 1) for m in combinations_with_replacement(names, d)]
    for k, monomial in enumerate(monomials):
        powers = [(name, monomial.count(name)) for name in names if name in monomial]
        factors = [name if power == 1 else f"{name}**{power}" for name, power in powers]
        sign = "" if k == 0 else " - " if k % 2 else " + "
        text += sign + "*".join([f"{0.5 + k * GOLDEN_RATIO % 1.0:.3f}", *factors])
    return text


# each makes the text of a field from the names of its coordinates
_TEXTS: dict[str, Callable[[tuple[str, ...]], str]] = {
    "quartic": quartic,
    "sine": sine,
    "gaussian": gaussian,
    **{f"polynomial-{n}": partial(polynomial, degree=n) for n in range(1, 7)},
}

FIELDS = tuple(_TEXTS)


def field(name_or_expression: str, dimension: int) -> Field:
    """The field of a name in `FIELDS`, whatever the case and with '_' read as '-', else of an expression in x, y, z.

    Raises SphearError, naming the known fields, for what is neither, and for a dimension other than 1, 2 or 3.
    """
    name = name_or_expression.strip()
    known = name.lower().replace("_", "-")
    if known in _TEXTS:
        name, text = known, _TEXTS[known](COORDINATES[:dimension])
        value = Expression.parse(text, dimension)
    else:
        text = name
        try:
            value = Expression.parse(text, dimension)
        except SphearError as error:
            is_word = known.replace("-", "").isalnum()  # so that a slip in "sine+1" is not taken for a name
            near = difflib.get_close_matches(known, FIELDS, n=1) if is_word else []
            hint = f", did you mean {near[0]}?" if near else ""
            raise SphearError(f"{error}; known fields are {', '.join(FIELDS)}{hint}") from None
    return Field(name, text, value, value.laplacian(), value.gradient())
