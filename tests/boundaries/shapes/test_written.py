"""Shapes as they are written on a command line are those of Python; whatever else is written is one sentence."""

from __future__ import annotations

import pytest

from sphear.boundaries.shapes import Circle, HalfPlane, Polygon, Rectangle, Shape, written
from sphear.errors import SphearError

CIRCLE, BOX = Circle((0.3, 0.5), 0.1), Rectangle((0.6, 0.2), (0.8, 0.4))
SHAPES: dict[str, Shape] = {
    "Circle((0.3, 0.5), 0.1)": CIRCLE,
    "Circle(centre=(0.3, 0.5), radius=1e-1, spin=-2)": Circle((0.3, 0.5), 0.1, spin=-2.0),
    " Circle((0.3, 0.5), 0.1) | Rectangle((0.6, 0.2), (0.8, 0.4))": CIRCLE | BOX,
    "~(Circle((0.3, 0.5), 0.1) & HalfPlane((0, 0.5), (0, 1)))": ~(CIRCLE & HalfPlane((0, 0.5), (0, 1))),
    "Rectangle((0, 0), (1, 1), {'upper': (1, 0)}) - Polygon([(0.2, 0.2), (0.4, 0.2), (0.3, 0.4)])": Rectangle(
        (0, 0), (1, 1), {"upper": (1, 0)}
    )
    - Polygon(((0.2, 0.2), (0.4, 0.2), (0.3, 0.4))),
}


@pytest.mark.parametrize("text", SHAPES)
def test_a_text_is_the_shape_that_python_makes_of_it(text: str) -> None:
    assert written(text) == SHAPES[text]


WRONG = {
    "circle at (1, 2)": "a shape is written as in Circle((0.3, 0.5), 0.1)",
    "": "a shape is written as in",
    "1 + 2": "not as '1 + 2'",
    "CIRCLE": "not as 'CIRCLE'",
    "Circle((0.3, 0.5), 0.1) + Circle((0.3, 0.5), 0.2)": "a shape is written as in",
    "Circl((0.3, 0.5), 0.1)": "there is no shape named 'Circl': did you mean Circle?",
    "Circle((0.3, 0.5))": "has missing a required argument: 'radius': it takes centre, radius, spin",
    "Circle((0.3, 0.5), 0.1, colour=2)": "unexpected keyword argument 'colour': it takes centre, radius",
    "Circle((0.3, 0.5), open('x'))": "are to be numbers",
    "Circle((0.3, 0.5), -1)": "the radius of a circle is positive, not -1",
    "Circle((0.3, 0.5), " + "1" * 400 + ")": "the radius of a circle is a finite number",
    "Circle((0.3, " + "1" * 400 + "), 1)": "the centre of a circle has two finite numbers",
    "Circle((0.3, 0.5), True)": "the radius of a circle is a finite number, not True",
    "Circle((0.3, 0.5), radius=0.1, radius=0.2)": "each argument is given once",
    "Polygon([(0, 0), (1, 0), (0, 1)], {True: (1, 0)})": "the edges of the polygon are numbered 0 to 2, not True",
    "Polygon([(0, 0), (1, 0), (0, 1)], ((([],), (1, 0)),))": "are given by name",
    "(" * 500: "a shape is",
    " | ".join(["Circle((0.3, 0.5), 0.1)"] * 5000): "of these there are more than can be joined",
}


@pytest.mark.parametrize("text", WRONG)
def test_what_is_no_shape_is_one_sentence(text: str) -> None:
    with pytest.raises(SphearError) as told:
        written(text)
    assert WRONG[text] in str(told.value)
    assert len(str(told.value).splitlines()) == 1
