# SPDX-License-Identifier: MIT
"""Every mutant of a header at once: each place that can be changed asks at run time whether it is the one.

  a < b    becomes  mutants::less(17, a, b)          which is a <= b where mutant 17 is chosen
  a && b   becomes  ((bool(a) != is(17)) && (bool(b) != is(17))) != is(17)     lazy as before; by De Morgan a || b
  T(0)     becomes  (mutants::is(17) ? T(1) : T(0))

The smaller or the larger of two, a < b ? a : b, becomes the other one: of two that are alike either will do.

tests/mutants/mutants.hpp holds what is called. Operands are found by the layout that clang-format gives all headers: a
binary operator stands between spaces, a prefix and the bracket of a template do not.
"""
import re
from dataclasses import dataclass

TOKEN = re.compile(r"""(?P<space>\s+|//[^\n]*)|(?P<text>"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')
    |(?P<number>\.?\d(?:[\w.']|[eEpP][+-])*)|(?P<name>\w+)
    |(?P<sign><<=|>>=|->|\+\+|--|<<|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|::|\.\.\.|.)""", re.X)
# How tightly each binds; 0 for assignments.
BINDS = {"*": 10, "/": 10, "%": 10, "+": 9, "-": 9, "<<": 8, ">>": 8, "<": 7, "<=": 7, ">": 7, ">=": 7, "==": 6,
         "!=": 6, "&": 5, "^": 4, "|": 3, "&&": 2, "||": 1,
         **dict.fromkeys(("=", "+=", "-=", "*=", "/=", "%=", "|=", "&=", "^=", "<<=", ">>="), 0)}
OPERATORS = {"<": ("less", "<="), "<=": ("less_or_equal", "<"), ">": ("greater", ">="), ">=": ("greater_or_equal", ">"),
             "+": ("plus", "-"), "-": ("minus", "+"), "*": ("times", "/"), "/": ("over", "*"), "==": ("equal", "!="),
             "!=": ("unequal", "=="), "+=": ("add", "-="), "-=": ("subtract", "+=")}
CHOICES = {"<": ("less_turned", ">"), "<=": ("less_or_equal_turned", ">="), ">": ("greater_turned", "<"),
           ">=": ("greater_or_equal_turned", "<=")}
LOGIC = {"&&": "||", "||": "&&"}
CONSTANTS = {("T", "(", "0", ")"): "T(1)", ("T", "(", "1", ")"): "T(0)", ("T", "(", "2", ")"): "T(3)",
             ("T", "(", "0.5", ")"): "T(0.25)", ("true",): "false", ("false",): "true"}
FUNCTIONS = {("std", "::", "fmin"): "std::fmax", ("std", "::", "fmax"): "std::fmin", ("glm", "::", "min"): "glm::max",
             ("glm", "::", "max"): "glm::min", ("std", "::", "floor"): "std::ceil", ("std", "::", "ceil"): "std::floor"}
STOPS = {"return", "else", "do", "case", "throw"}
OPENS = {"(": ")", "[": "]", "{": "}", "<": ">"}


@dataclass
class Token:
    text: str
    kind: str
    at: int  # characters before it
    spaced: bool  # before it
    spaced_behind: bool = False
    partner: int = -1  # of a bracket

    @property
    def end(self):
        return self.at + len(self.text)


@dataclass
class Mutant:
    """One change: `at` to `end` of the header would be `instead`. All edits together make it a choice at run time."""
    at: int
    end: int
    instead: str
    edits: list  # (place, how much is replaced, text, +1 for what opens and -1 for what closes, extent)
    number: int = 0
    header: str = ""
    line: int = 0
    was: str = ""
    would_be: str = ""  # the line


def tokens_of(text):
    """Code alone: without comments, and with the lines of the preprocessor left out."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, text, flags=re.M)
    tokens, stack, spaced = [], [], True
    for match in TOKEN.finditer(text):
        if match.lastgroup == "space":
            if tokens:
                tokens[-1].spaced_behind = True
            spaced = True
            continue
        token = Token(match.group(), match.lastgroup, match.start(), spaced)
        spaced = False
        before = tokens[-1] if tokens else None
        index = len(tokens)
        if token.text == ">" and not token.spaced and before.text == ">" and before.spaced:
            before.text = ">>"  # two brackets of templates are one after the other without a space before
            continue
        if token.text in ("(", "[", "{") or (token.text == "<" and before and (
                before.text == "template" or (not token.spaced and before.text != "operator"))):
            stack.append(index)
        elif token.text in (")", "]", "}") or (token.text == ">" and not token.spaced and stack and
                                               tokens[stack[-1]].text == "<" and before.text != "operator"):
            if tokens[stack[-1]].text == "<" and token.text != ">":
                raise ValueError(f"unmatched < at {text[:token.at].count(chr(10)) + 1}")
            token.partner = stack.pop()
            tokens[token.partner].partner = index
        tokens.append(token)
    return tokens


def is_binary(token):
    return token.kind == "sign" and token.text in BINDS and token.spaced and token.spaced_behind and token.partner < 0


def starts_operand(token):
    return token.kind != "sign"


def ends_operand(token):
    return token.kind != "sign" or token.text in (")", "]", "}") or (token.text == ">" and token.partner >= 0)


def left_of(tokens, i):
    """The first token of what stands left of the operator i."""
    binds, k = BINDS[tokens[i].text], i
    while k > 0:
        token = tokens[k - 1]
        if token.partner > k - 1 or token.text in (",", ";", "?", ":") or token.text in STOPS:
            break  # an opening bracket, or where no operand can go on
        if is_binary(token) and BINDS[token.text] < max(binds, 1):
            break
        if k < i and token.text != "sizeof" and ends_operand(token) and (
                starts_operand(tokens[k]) or is_prefix(tokens[k], token)):
            break  # two words side by side: what is before is no part of the expression
        k = token.partner if token.partner >= 0 else k - 1
    return k


def is_prefix(token, before):
    return token.kind == "sign" and token.text in ("!", "-", "*", "&", "~", "+") and not token.spaced_behind and (
        token.spaced or not ends_operand(before))


def right_of(tokens, i):
    """The last token of what stands right of the operator i."""
    binds, k = BINDS[tokens[i].text], i
    while k + 1 < len(tokens):
        token = tokens[k + 1]
        if token.text in (",", ";") or 0 <= token.partner < k + 1:
            break
        if binds > 0 and (token.text in ("?", ":") or (is_binary(token) and BINDS[token.text] <= binds)):
            break
        k = token.partner if token.partner > k + 1 else k + 1
    return k


def operand_of(tokens, i):
    """The last token of what the prefix i applies to."""
    k = i + 1
    while tokens[k].kind == "sign" and tokens[k].text in ("!", "-", "*", "&", "~", "+", "++", "--"):
        k += 1
    k = max(k, tokens[k].partner)
    while k + 1 < len(tokens):
        token = tokens[k + 1]
        if token.partner > k + 1 and not token.spaced:
            k = token.partner
        elif token.text in ("::", ".", "->"):
            k += 2
        else:
            break
    return k


def is_choice(tokens, i, a, b):
    """Whether the comparison i of a... with ...b chooses between what it compares: the smaller, or the larger."""
    def text_of(first, last):
        return [token.text for token in tokens[first:last + 1]]

    if b + 1 >= len(tokens) or tokens[b + 1].text != "?":
        return False
    compared = [text_of(a, i - 1), text_of(i + 1, b)]
    for first, second in (compared, compared[::-1]):
        colon = b + 2 + len(first)
        if text_of(b + 2, colon + len(second)) == [*first, ":", *second]:
            after = tokens[colon + len(second) + 1].text
            return after in (",", ";", ")", "]", "}")
    return False


def left_alone(tokens, text):
    """The tokens that are no code to be changed: assertions, template heads, aliases, the defaults of members."""
    out = set()
    for i, token in enumerate(tokens):
        if token.text in ("SHADOWMATH_ASSERT", "static_assert") or (token.text == "template" and i + 1 < len(tokens)):
            out.update(range(i, tokens[i + 1].partner + 1))
        if token.text == "using":
            while tokens[i].text != ";":
                out.add(i)
                i += 1
    position = 0
    for line in text.split("\n"):
        code = line.split("//")[0].rstrip()
        is_default = re.match(r"    [\w:<>]+ \w+ = [^(]*(\([\w.]*\))?;$", code) and "const" not in code
        if is_default or re.match(r"    [\w:<>]+ \w+\{.*\};$", code):
            out.update(i for i, token in enumerate(tokens) if position <= token.at < position + len(line))
        position += len(line) + 1
    return out


def mutants_of(header, text, first_number):
    tokens = tokens_of(text)
    alone = left_alone(tokens, text)
    found = []
    for i, token in enumerate(tokens):
        if i in alone:
            continue
        number = first_number + len(found)
        chosen = f"mutants::is({number})"

        def around(a, b, opening, closing, *more):
            extent = tokens[b].end - tokens[a].at
            return [(tokens[a].at, 0, opening, 1, extent), (tokens[b].end, 0, closing, -1, extent), *more]

        if is_binary(token) and (token.text in OPERATORS or token.text in LOGIC or token.text == "|="):
            a, b = left_of(tokens, i), right_of(tokens, i)
            if a == i or b == i:
                continue
            if token.text in LOGIC:
                between = (token.at, len(token.text), f") != {chosen}) {token.text} (bool(", 0, 0)
                edits = around(a, b, "(((bool(", f") != {chosen})) != {chosen})", between)
                instead, end = LOGIC[token.text], token.end
            elif token.text == "|=":
                comma = (token.at, len(token.text), ",", 0, 0)
                edits = around(a, b, f"mutants::unite({number}, ", ")", comma)
                instead, end = "|= {}", min(tokens[b].end, len(text[:token.at]) + len(text[token.at:].split("\n")[0]))
            else:
                chooses = token.text in CHOICES and is_choice(tokens, i, a, b)
                name, instead = (CHOICES if chooses else OPERATORS)[token.text]
                comma = (token.at, len(token.text), ",", 0, 0)
                edits, end = around(a, b, f"mutants::{name}({number}, ", ")", comma), token.end
            found.append(Mutant(token.at, end, instead, edits))
            continue
        if token.text == "!" and not token.spaced_behind:
            edits = around(i, operand_of(tokens, i), f"({chosen} == bool(", "))", (token.at, 1, "", 0, 0))
            found.append(Mutant(token.at, token.end, "", edits))
            continue
        for length, kind in ((4, CONSTANTS), (3, FUNCTIONS), (1, CONSTANTS)):
            words = tuple(part.text for part in tokens[i:i + length])
            if words not in kind or (i and tokens[i - 1].text in ("::", ".")):
                continue
            b = i + length - 1
            if kind is FUNCTIONS:
                call = (token.at, tokens[b].end - token.at, f"mutants::{words[0]}_{words[2]}({number})", 0, 0)
                found.append(Mutant(token.at, tokens[b].end, kind[words], [call]))
            else:
                edits = around(i, b, f"({chosen} ? {kind[words]} : ", ")")
                found.append(Mutant(token.at, tokens[b].end, kind[words], edits))
    for k, mutant in enumerate(found):
        start = text.rfind("\n", 0, mutant.at) + 1
        stop = text.index("\n", mutant.at)
        mutant.number, mutant.header, mutant.line = first_number + k, header, text.count("\n", 0, mutant.at) + 1
        mutant.was = text[start:stop]
        mutant.would_be = text[start:mutant.at] + mutant.instead + text[mutant.end:stop]
    return found


def rewritten(text, mutants):
    """The header in which each of these can be chosen; its lines stay where they are."""
    edits = [edit for mutant in mutants for edit in mutant.edits]
    # At one place: what closes, the inner first; then what opens, the outer first; then what is replaced.
    edits.sort(key=lambda e: (e[0], {-1: 0, 1: 1, 0: 2}[e[3]], e[4] if e[3] < 0 else -e[4]))
    out, position = [], 0
    for place, length, replacement, _, _ in edits:
        out += [text[position:place], replacement]
        position = place + length
    return "".join(out) + text[position:]


def swapped(text, mutant):
    """The header with this one alone, for good."""
    return text[:mutant.at] + mutant.instead + text[mutant.end:]
