# SPDX-License-Identifier: GPL-3.0-or-later
"""Mutation points of a C source: operators and constants of its statements and initialisers, each with what may stand there instead.

Comments, strings, preprocessor lines, types, declarators and assertions at compile time are left alone, and what no test can tell:
how much memory is asked for, which is enough where it is more and for the sanitizers to notice where it is less, and what is said
when there is none."""
import collections
import re

# at: offset of text in the source; kernel: whether it is in one
Point = collections.namedtuple("Point", "path line column at text others kernel")
Token = collections.namedtuple("Token", "kind text at")

TOKEN = re.compile(r"""
    (?P<skip>\s+ | //[^\n]* | /\*.*?\*/ | ^[ \t]*\#(?:\\\n|/\*.*?\*/|[^\n])*)
  | (?P<string>"(?:\\.|[^"\\])*" | '(?:\\.|[^'\\])*')
  | (?P<number>(?:0[xX][\da-fA-F.]+(?:[pP][+-]?\d+)? | (?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)[uUlLfF]*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<sign>->|\+\+|--|<<=|>>=|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|\.\.\.|.)
""", re.X | re.S | re.M)

PAIRS = [("+", "-"), ("*", "/"), ("<", "<="), (">", ">="), ("==", "!="), ("&&", "||"), ("+=", "-="), ("*=", "/="),
         ("fmin", "fmax"), ("sin", "cos"), ("true", "false")]
SWAPS = {a: b for pair in PAIRS for a, b in (pair, pair[::-1])}
COULD_BE_UNARY = set("+-*")
TYPES = set("void char short int long float double signed unsigned bool const volatile restrict static struct union enum FILE".split())
KERNELS = set("GX_CORE GX_CLONES GX_SPLINE_CORE GX_SPLINE_CLONES inline".split())
METHODS = ("src/bases/", "src/clocks/", "src/materials/")
QUIET = set("_Static_assert static_assert __attribute__ _Alignas alignas calloc malloc realloc fftw_malloc".split())
QUIET |= set("gx_aligned_zeros gx_large_zeros gx_arena_take".split())
STATEMENTS = set("return case sizeof else do goto".split())  # a sign after one of these is unary


def is_type(tokens, i):
    name = tokens[i].text
    return name in TYPES or name.endswith("_t") or (i > 0 and tokens[i - 1].text in ("struct", "union", "enum"))


def opening(tokens, i):
    """Where the parenthesis that closes at i opens."""
    depth = 0
    for k in range(i, -1, -1):
        depth += (tokens[k].text == ")") - (tokens[k].text == "(")
        if depth == 0:
            return k
    return 0


def closing(tokens, i):
    """Where the parenthesis that opens at i closes."""
    depth = 0
    for k in range(i, len(tokens)):
        depth += (tokens[k].text == "(") - (tokens[k].text == ")")
        if depth == 0:
            return k
    return len(tokens)


def is_quiet(tokens, i):
    """Whether nothing is changed within the parenthesis that opens at i."""
    if tokens[i - 1].text in QUIET:
        return True
    told = tokens[i - 1].text in ("gx_status_set", "gx_spline_error_set")
    return told and any(t.kind == "string" and t.text.startswith('"out of memory') for t in tokens[i:closing(tokens, i)])


def is_kernel(path, head):
    """Kernels are functions that are compiled into loops over points or for several instruction sets, tables of coefficients, and
    all of bases, clocks and materials. head: what stands before a brace at the top."""
    names = [t.text for t in head]
    return path.startswith(METHODS) or not KERNELS.isdisjoint(names) or "(" not in names or "=" in names


def is_binary(tokens, i):
    """Whether the +, - or * at i stands between two operands."""
    before, after = tokens[i - 1], tokens[i + 1]
    if before.kind == "name":
        return before.text not in STATEMENTS and not is_type(tokens, i - 1) and after.text not in (")", ",", ";", "*", "const", "restrict")
    if before.text == ")":
        inside = range(opening(tokens, i - 1) + 1, i - 1)
        cast = all(tokens[k].text == "*" or is_type(tokens, k) for k in inside)
        return not cast
    return before.kind == "number" or before.text == "]"


def of_number(text):
    """What may stand for a number: another integer, half of a number, a coefficient of many digits by 0.1 %, a far looser tolerance."""
    digits = re.match(r"[\d.]+(?:[eE][+-]?\d+)?", text).group()
    suffix = text[len(digits):]
    if text[:2] in ("0x", "0X"):
        return []
    if digits.isdigit():
        return [other + suffix for other in {"0": ["1"], "1": ["0", "2"]}.get(digits, [str(int(digits) + 1)])]
    value = float(digits)
    if value == 0:
        return ["1.0" + suffix]
    if value < 1e-5:
        return [repr(value**0.5) + suffix]
    slightly = [repr(value * 1.001) + suffix] if len(digits) > 7 else []
    return [repr(value / 2) + suffix, *slightly]


def points(path, source):
    tokens = [Token(m.lastgroup, m.group(), m.start()) for m in TOKEN.finditer(source) if m.lastgroup != "skip"]
    found, braces, brackets = [], [], []
    first, value, quiet = 0, False, None  # first token of the statement; an = was seen in it; parenthesis depth at which silence ends
    depth, head, kernel = 0, 0, False  # head: first token of what stands at the top
    for i, token in enumerate(tokens):
        text = token.text
        if not braces and text in (";", "{"):
            kernel = is_kernel(path, tokens[head:i])
        if text == "{":
            begins = [t.text for t in tokens[max(0, i - 2):i]]
            braces.append(bool({"struct", "union", "enum"} & set(begins)))
        elif text == "}" and braces:
            braces.pop()
        elif text == "[":
            brackets.append(is_type(tokens, first) and not value)
        elif text == "]" and brackets:
            brackets.pop()
        elif text == "(":
            depth += 1
            if quiet is None and is_quiet(tokens, i):
                quiet = depth
        elif text == ")":
            quiet = None if quiet == depth else quiet
            depth -= 1
        if text == "=":
            value = True
        inside = not any(braces) and (braces or value) and quiet is None and not any(brackets)
        if inside:
            others = []
            if token.kind == "number":
                others = of_number(text)
            elif token.kind in ("name", "sign") and text in SWAPS and (text not in COULD_BE_UNARY or is_binary(tokens, i)):
                others = [SWAPS[text]]
            if others:
                line = source.count("\n", 0, token.at) + 1
                column = token.at - (source.rfind("\n", 0, token.at) + 1) + 1
                found.append(Point(path, line, column, token.at, text, others, kernel))
        if not braces and text in (";", "}"):
            head = i + 1
        if text in (";", "{", "}") and depth == 0:
            first = i + 1 if i + 1 < len(tokens) else i
            value = value and text != ";" and bool(braces)
    return found
