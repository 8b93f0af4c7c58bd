"""What the measures of the house need to know of C++: files, includes, scopes and types.

No compiler: tokens and brackets alone, which is enough for code that clang-format has laid out."""
import bisect
import collections
import functools
import pathlib
import re
import subprocess

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.M)
NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\((?:.*?)\)\1"|"(?:\\.|[^"\\\n])*"'
                   r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'", re.S)
TOKEN = re.compile(r"[A-Za-z_]\w*|\.?\d(?:[\w.']|(?<=[eEpP])[+-])*|::|->|\+\+|--|<<=|>>=|<<|<=|>=|==|!="
                   r"|&&|\|\||[-+*/%&|^]=|\S")
NAME = re.compile(r"[A-Za-z_]\w*$")
TYPES = ("struct", "class", "union", "enum")

Type = collections.namedtuple("Type", "kind name namespace line")  # namespace: "a::b"; "(file)" for an anonymous one


def tracked(root, *folders):
    """The C++ files of git below the folders, relative to the root."""
    out = subprocess.run(["git", "-C", str(root), "ls-files", "--", *folders], capture_output=True, text=True, check=True)
    return [pathlib.Path(name) for name in out.stdout.splitlines() if name.endswith((".h", ".cpp"))]


@functools.lru_cache(maxsize=None)
def text_of(path):
    return pathlib.Path(path).read_text(encoding="utf-8")


def bare(text):
    """Without comments, texts and preprocessor lines; every line stays where it is."""
    def blank(match):
        found = match[0]
        return ("" if found.startswith("/") else "0") + "\n" * found.count("\n")

    return DIRECTIVE.sub(lambda match: "\n" * match[0].count("\n"), NOISE.sub(blank, text))


def partners(tokens):
    """{bracket: the bracket that belongs to it}, both ways."""
    partner, opened = {}, []
    for i, token in enumerate(tokens):
        if token in "([{":
            opened.append(i)
        elif token in ")]}" and opened:
            partner[i] = opened[-1]
            partner[opened.pop()] = i
    return partner


def outside_of_brackets(words):
    """The words of a declaration that stand in no parentheses and in no parameters of a template."""
    plain, depth = [], 0
    for word in words:
        depth -= word in (")", ">")
        if depth <= 0:
            plain.append(word)
        depth += word == "(" or (word == "<" and plain[:1] == ["template"] and depth == 0)
    return plain


def declared(words):
    """The words without `template <>` and what else may stand before the kind of a declaration."""
    plain = outside_of_brackets(words)
    if plain[:1] == ["template"]:
        plain = plain[3:] if plain[2:3] == [">"] else plain[1:]
    while plain[:1] and plain[0] in ("static", "constexpr", "inline", "typedef", "friend"):
        plain = plain[1:]
    return plain


class Code:
    """The tokens of a file with their lines and matching brackets."""

    def __init__(self, path):
        text = bare(text_of(path))
        starts = [0] + [match.end() for match in re.finditer("\n", text)]
        found = list(TOKEN.finditer(text))
        self.tokens = [match[0] for match in found]
        self.lines = [bisect.bisect_right(starts, match.start()) for match in found]
        self.partner = partners(self.tokens)

    def types(self):
        """Those of namespace scope: types inside of other types cannot be taken for one another."""
        for kind, first, brace, namespace in self.declarations():
            if kind in TYPES and "." not in namespace:
                yield Type(kind, self.type_name(first, brace), namespace, self.lines[first])

    def declarations(self):
        """(kind, first, brace, namespace) of everything with a body that stands outside of functions."""
        todo = [(0, len(self.tokens), "")]
        while todo:
            i, end, namespace = todo.pop()
            while i < end:
                if self.tokens[i] == "{" and i in self.partner:
                    kind, first = self.kind_of(i)
                    yield kind, first, i, namespace
                    inner = self.inner_namespace(kind, first, i, namespace)
                    if inner is not None:
                        todo.append((i + 1, self.partner[i], inner))
                if self.tokens[i] in "([{":
                    i = self.partner.get(i, i)
                i += 1

    def kind_of(self, brace):
        """What begins with this brace, and where its declaration begins."""
        first = self.head(brace)
        words = self.tokens[first:brace]
        if "namespace" in words[:2]:
            return "namespace", first

        plain = declared(words)
        if plain[:1] and plain[0] in TYPES and "(" not in plain:
            return plain[0], first
        if self.is_member_list(brace) or ("=" in plain and "operator" not in plain):
            return "list", first
        return ("function" if ")" in words else "list"), first

    def head(self, brace):
        """First token of the declaration that a brace belongs to."""
        i = brace - 1
        while i >= 0 and self.tokens[i] not in (";", "{", "}"):
            i = self.partner.get(i, i) if self.tokens[i] == ")" else i
            i -= 1
            if i >= 0 and self.tokens[i] == "}" and self.is_member_list(self.partner.get(i, 0)):
                i = self.partner[i] - 1

        i += 1
        while self.tokens[i] in ("public", "private", "protected") and self.tokens[i + 1] == ":":
            i += 2
        return i

    def is_member_list(self, brace):
        """a_{1} among a constructor's initialisers."""
        return brace >= 2 and bool(NAME.match(self.tokens[brace - 1])) and self.tokens[brace - 2] in (",", ":")

    def inner_namespace(self, kind, first, brace, namespace):
        """Where what stands in these braces lives; None when nothing is declared there that others can name."""
        if kind == "namespace":
            name = "".join(self.tokens[first + 1:brace]).replace("inlinenamespace", "") or "(file)"
            return f"{namespace}::{name}".strip(":")
        if kind in TYPES and kind != "enum":
            return f"{namespace}::{self.type_name(first, brace)}.".strip(":")
        return None

    def type_name(self, first, brace):
        """"" for what is no name of its own: an inner type defined outside of its type, a specialisation."""
        t = self.tokens
        i = next(i for i in range(first, brace) if t[i] in TYPES and t[i - 1] not in ("<", ","))
        i += 1 + (t[i + 1] in ("struct", "class"))
        return t[i] if NAME.match(t[i]) and t[i + 1] not in ("::", "<") else ""
