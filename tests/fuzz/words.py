"""Wrong words: numbers that are none, names that nothing has, expressions and shapes that cannot be read."""

from __future__ import annotations

import random

Draw = random.Random

NO_FLOATS = (  # of a setting that is positive and finite
    "nan", "inf", "-inf", "-1", "0", "-0.0", "1e999", "-1e-3", "1e-400", "one", "", "0x10", "1,5", "½", "1e", "--",
    "True", "None", "1 2", "1;2", "∞", "3.0.0", "[1]", "(1)", "1j", "1e5e5", "+-1", "Ⅷ", "NaN", "Infinity",
)  # fmt: skip
NO_INTS = (  # of a setting that is at least 1
    "0", "-3", "1.5", "1e3e", "nan", "inf", "many", "", "0x10", "½", "True", "10 20", "-1e30", "[1]", "1j", "None",
    "--1", "²",
)  # fmt: skip
LETTERS = "abcdefghijklmnopqrstuvwxyz_-0123456789ÄßéΩ中"
TEXTS = (
    "\x01\x02", "a\nb", "\x1b[31mred\x1b[0m", "\udcff\udcfe", "'; drop", "$(id)", "`id`", "%s%n", "../..",
    "{0.__class__}", "[bold]x[/bold]", "\u202eabc", "😀", "\t", "__import__('os')", "\r", "é\u0301", "a\u200bb",
)  # fmt: skip
SHAPES = (
    "Circle((0.3, 0.5), 0.1)",
    "Rectangle((0.2, 0.2), (0.4, 0.4))",
    "Polygon(((0.4, 0.4), (0.6, 0.4), (0.5, 0.6)))",
)
BROKEN_SHAPES = (
    "", "Circle", "Circle()", "Circle((0.3, 0.5))", "Circle((0.3, 0.5), -0.1)", "Circle((0.3, 0.5), 0)",
    "Circle((0.3, 0.5), nan)", "Circle((0.3, 0.5), inf)", "Circle((0.3, 0.5), 1e999)", "Circle((0.3,), 0.1)",
    "Circle((0.3, 0.5, 0.1), 0.1)", "Circle(0.3, 0.1)", "Circle((0.3, 0.5), '0.1')",
    "Circle((0.3, 0.5), 0.1, 0.2, 0.3)",
    "Circle((0.3, 0.5), 0.1, colour=1)", "Circle((0.3, 0.5), 0.1)()", "Circle((0.3, 0.5), 0.1).radius", "print(1)",
    "Circle((0.3, 0.5), 0.1) + 1", "Circle((0.3, 0.5), 0.1) and 1", "lambda: 1", "[Circle((0.3, 0.5), 0.1)]",
    "1", "None",
    "Rectangle((0.4, 0.4), (0.2, 0.2))", "Rectangle((0.2, 0.2), (0.2, 0.4))", "Rectangle((0.2, 0.2))",
    "Sphere((0, 0), 1)",
    "Polygon(())", "Polygon(((0.4, 0.4), (0.6, 0.4)))", "Polygon(((0, 0), (1, 1), (2, 2)))", "Polygon((1, 2, 3))",
    "Polygon(((0.4, 0.4), (0.6, 0.4), (0.5, 0.6)), {7: (1, 0)})", "__import__('os').system('id')",
    "Circle((5, 5), 0.1)",
    "Polygon(((0.4, 0.4), (0.6, 0.4), (0.5, 0.6)), {'a': (1, 0)})", "Circle((0.3, 0.5), 10**400)",
    "Circle((0.3, 0.5), 3)",
    "Circle((0.3, 0.5), True)", "Circle(('a', 0.5), 0.1)", "HalfPlane((0, 0), (0, 0))", "~",
    "Circle((0.3, 0.5), 0.1) &",
    "(" * 300 + "1" + ")" * 300, "~" * 500 + "Circle((0.3, 0.5), 0.1)", "Circle((0.3, 0.5), 0.1, spin=nan)",
    "Polygon(((0.2, 0.2), (0.8, 0.8), (0.8, 0.2), (0.2, 0.8)))", "eval('1')", "Circle(*((0.3, 0.5), 0.1))",
    "x := 1",
)  # fmt: skip
BROKEN_EXPRESSIONS = (
    "", " ", "x +", "x*y*w", "sin", "sin()", "sin(x, y)", "sin(x", ")x(", "x ** ** y", "1/0", "x/0", "0/0", "1e999*x",
    "sqrt(x)", "log(-1)", "log(x-1)", "x.real", "x[0]", "__import__('os')", "lambda: x", "x if y else x", "f(x)", "x y",
    "x = y", "x == y", "x and y", "not x", "'x'", "[x]", "{x}", "nan", "inf", "nan*x", "x @ y", "x // y", "x; y",
    "1j*x",
    "exp(1000)", "exp(exp(exp(10)))*x", "z", "tan(x", "x^", "x $ y", "x!", "½x", "10**400*x", "x**10**10**10", "cos[x]",
    "(" * 400 + "x" + ")" * 400, "abs", "open('a')", "x*\n*", "1e308*10*x", "sqrt(-1)*x", "quartik", "if", "yield x",
)  # fmt: skip


def no_float(draw: Draw) -> str:
    """Text that is no positive finite number."""
    if draw.random() < 0.2:
        return f"-{draw.uniform(1e-3, 1e3):g}"
    return draw.choice(NO_FLOATS)


def no_int(draw: Draw) -> str:
    """Text that is no whole number of at least 1."""
    if draw.random() < 0.2:
        return draw.choice((f"-{draw.randrange(1, 10**6)}", f"{draw.randrange(100)}.{draw.randrange(1, 10)}"))
    return draw.choice(NO_INTS)


def no_name(draw: Draw, names: tuple[str, ...]) -> str:
    """A name that nothing has: a right one with letters that no name has, letters at random, or odd text."""
    kind = draw.randrange(4)
    if kind == 0:
        name = draw.choice(names)
        place = draw.randrange(len(name))
        return f"{name[:place]}q{name[place:]}q"
    if kind == 1:
        return "q" + "".join(draw.choice(LETTERS) for _ in range(draw.randrange(1, 40))) + "q"
    if kind == 2:
        return f"{draw.choice(names)}{draw.choice(('.', '!', '/', '1e3', 'ß', '😀', '()', '%'))}"
    return f"q{no_text(draw)}q"


def no_text(draw: Draw) -> str:
    """Control characters, bytes that are no UTF-8, what shells and formats take for their own; sometimes long."""
    text = draw.choice(TEXTS)
    return text * draw.choice((10, 1000, 20_000)) if draw.random() < 0.2 else text


def broken_shape(draw: Draw) -> str:
    """Text that is no shape: one of a list, or one whose brackets do not match."""
    if draw.random() < 0.3:
        shape = draw.choice(SHAPES)
        place = draw.choice([number for number, letter in enumerate(shape) if letter in "()"])
        return shape[:place] + shape[place + 1 :]
    return draw.choice(BROKEN_SHAPES)


def broken_expression(draw: Draw) -> str:
    """Text that is no field on the square, or has no value there."""
    if draw.random() < 0.2:
        return f"{draw.choice(('sin', 'cos', 'exp', 'sqrt'))}(x*{draw.random():.3f}" + "(" * draw.randrange(5)
    return draw.choice(BROKEN_EXPRESSIONS)
