"""Finds the functions and members of mc that reach a whole study: python3 study_reach.py TREE

A Study or Scene is read in mc/study and mc/plan only. Elsewhere this counts functions that take, return
or use one or a type that holds one, call a function that returns one, and members that hold one. Prints
them and those that answer yes or no. Sources are split by brackets, without a compiler.
"""

import collections
import pathlib
import re
import sys

WHOLE = {"Study", "Scene"}      # types that hold everything that a user wrote
READERS = ("mc/study/", "mc/plan/")
# Functions of Study and Scene; a call obj.study() reaches a study whatever the type of obj is.
ACCESS = re.compile(r"(?:\.|->)study\s*\(")
HIDDEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(?P<mark>[^(\s]{0,16})\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"'
                    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])*'|^[ \t]*#(?:\\\n|[^\n])*", re.S | re.M)
TOKEN = re.compile(r"[A-Za-z_]\w*|::|->|\S")
WORD = re.compile(r"[A-Za-z_]\w*$")
CLOSING = {"(": ")", "{": "}", "[": "]"}
CLASSES = {"class", "struct", "union"}

# `owner` is the class of a member or method, `words` are the identifiers of its declaration.
Function = collections.namedtuple("Function", "file line owner name words result body")
Member = collections.namedtuple("Member", "file line owner name words")


class Source:
    """Declarations of a C++ file."""

    def __init__(self, file, text):
        self.file, self.functions, self.members = file, [], []
        text = HIDDEN.sub(lambda match: "\n" * match.group().count("\n"), text)
        self.tokens = [(match.group(), match.start()) for match in TOKEN.finditer(text)]
        self.starts = [match.start() for match in re.finditer("\n", text)]
        self.scope(0, "")

    def line(self, index):
        position = self.tokens[index][1]
        low, high = 0, len(self.starts)
        while low < high:
            middle = (low + high) // 2
            low, high = (middle + 1, high) if self.starts[middle] < position else (low, middle)
        return low + 1

    def token(self, index):
        return self.tokens[index][0] if index < len(self.tokens) else ""

    def after(self, index):
        """Index after the bracket that opens at `index`."""
        depth = 0
        while index < len(self.tokens):
            token = self.token(index)
            depth += (token in CLOSING) - (token in CLOSING.values())
            index += 1
            if not depth:
                return index
        return index

    def scope(self, index, owner):
        """Reads declarations up to the end of a namespace or class; index after it."""
        start = index
        while index < len(self.tokens):
            token = self.token(index)
            if token == "}":
                return index + 1
            if token == ";":
                self.declaration(start, index, owner, None)
                index = start = index + 1
            elif token == ":" and self.token(index - 1) in ("public", "private", "protected"):
                index = start = index + 1
            elif token == ":" and self.token(index - 1) in (")", "noexcept") \
                    and self.is_function(start, index):
                index = start = self.definition(start, index, self.initialised(index), owner)
            elif token == "{":
                index, start = self.block(start, index, owner)
            elif token in ("(", "["):
                index = self.after(index)
            else:
                index += 1
        return index

    def block(self, start, index, owner):
        """Reads what a brace opens; index after it, and start of the next declaration."""
        head = [self.token(i) for i in range(start, index)]
        if "enum" in head:
            return self.after(index), self.after(index)
        if "namespace" in head or head == ["extern"]:
            end = self.scope(index + 1, owner)
            return end, end
        if CLASSES.intersection(self.without_template(head)) and "(" not in head and "=" not in head:
            name = self.class_name(self.without_template(head))
            end = self.scope(index + 1, name)
            return end, end if self.token(end) == ";" else start
        if self.is_function(start, index):
            end = self.definition(start, index, index, owner)
            return end, end
        return self.after(index), start    # an initialiser

    def definition(self, start, head_end, body, owner):
        end = self.after(body)
        self.declaration(start, head_end, owner,
                         [self.token(i) for i in range(head_end, end)])
        return end

    def initialised(self, index):
        """Index of the body after a constructor's initialisers."""
        while index < len(self.tokens):
            index += 1
            if self.token(index) in ("(", "{"):
                if self.token(index) == "{" and self.token(index - 1) in (")", "}"):
                    return index
                index = self.after(index) - 1
        return index

    @staticmethod
    def without_template(head):
        """Tokens without `template <...>`."""
        if head[:1] != ["template"]:
            return head
        depth = 0
        for i, token in enumerate(head):
            depth += (token == "<") - (token == ">")
            if token == ">" and not depth:
                return Source.without_template(head[i + 1:])
        return head

    @staticmethod
    def class_name(head):
        index = next(i for i, token in enumerate(head) if token in CLASSES)
        names = [token for token in head[index + 1:] if WORD.match(token) and token != "final"]
        return names[0] if names else ""

    def is_function(self, start, end):
        opening = self.parameters(start, end)
        return opening is not None and (WORD.match(self.token(opening - 1))
                                        or "operator" in [self.token(i)
                                                          for i in range(start, opening)])

    def parameters(self, start, end):
        """Index of the bracket that opens the parameters, if this declares a function."""
        depth, index = 0, start
        while index < end:
            token = self.token(index)
            if token == "=" and not depth and self.token(index - 1) != "operator":
                return None
            depth += (token == "<") - (token == ">" and depth > 0)
            if token == "(":
                if index > start and not depth:
                    return index
                index = self.after(index)
            elif token in ("[", "{"):
                index = self.after(index)
            else:
                index += 1
        return None

    def declaration(self, start, end, owner, body):
        words = [self.token(i) for i in range(start, end)]
        if not words or words[0] in ("using", "typedef", "friend", "static_assert", "namespace") \
                or (CLASSES.intersection(words[:1]) and len(words) == 2):
            return
        opening = self.parameters(start, end)
        line = self.line(start)
        if opening is None or (body is None and not WORD.match(self.token(opening - 1))):
            if owner and body is None:
                self.member(line, owner, words)
            return
        name, result = self.token(opening - 1), words[:opening - 1 - start]
        if self.token(opening - 2) == "::":
            owner, result = self.token(opening - 3), result[:-2]
        self.functions.append(Function(self.file, line, owner, name, words, result, body))

    def member(self, line, owner, words):
        """Adds a member unless it is an operator; parameters of function types are left out."""
        words = words[:next((i for i, token in enumerate(words) if token in "={"), len(words))]
        kept, depth = [], 0
        for token in words:
            depth += token == "("
            kept += [token] * (not depth)
            depth -= token == ")"
        names = [token for token in kept if WORD.match(token)]
        if names and "operator" not in names:
            self.members.append(Member(self.file, line, owner, names[-1], kept))


class Reach:
    """Functions and members of mc outside the readers that reach a whole study."""

    def __init__(self, texts):
        sources = [Source(file, text) for file, text in texts.items()]
        self.functions = [f for source in sources for f in source.functions]
        self.members = [m for source in sources for m in source.members]
        # Types that hold a whole study, or that hold a holder: of all files, and of a source file.
        self.holders = collections.defaultdict(set, {"": set(WHOLE)})
        held, known = [], None
        while known != len(held):
            known = len(held)
            held = [member for member in self.members if self.holds(member.file, member.words)]
            for member in held:
                local = member.file if member.file.endswith(".cpp") else ""
                self.holders[local].add(member.owner)
        self.held = collections.defaultdict(set)    # names of such members by class
        for member in held:
            self.held[member.owner].add(member.name)
        # Functions that return a whole study, where all functions of the name do.
        self.makers = {f.name for f in self.functions if self.holders[""].intersection(f.result)} \
            - {f.name for f in self.functions if self.holders[""].isdisjoint(f.result)}
        self.found, self.questions = self.search(held)

    def holds(self, file, words):
        return not (self.holders[""].isdisjoint(words) and self.holders[file].isdisjoint(words))

    def reaches(self, function):
        if self.holds(function.file, function.words) or function.owner in WHOLE:
            return True
        body = function.body or []
        called = (word for word, bracket in zip(body, body[1:]) if bracket == "(")
        return bool(self.holds(function.file, body) or self.makers.intersection(called)
                    or (function.owner and self.holds(function.file, [function.owner])
                        and self.held[function.owner].intersection(body))
                    or ACCESS.search("".join(body)))

    def search(self, held):
        """One line for each function and member, and those of functions that return bool."""
        found = {(member.owner, member.name, member.file):
                 f"{member.file}:{member.line} holds {member.owner}::{member.name}"
                 for member in held if not member.file.startswith(READERS)}
        questions = {}
        for function in self.functions:
            if function.file.startswith(READERS) or not self.reaches(function):
                continue
            key = function.owner, function.name, self.signature(function)
            name = f"{function.owner}::{function.name}" if function.owner else function.name
            # The definition replaces the declaration.
            if key not in found or function.body is not None:
                found[key] = f"{function.file}:{function.line} {name}"
            if "bool" in function.result and "<" not in function.result:
                questions[key] = found[key]
        return sorted(found.values()), sorted(questions.values())

    @staticmethod
    def signature(function):
        """Types of the parameters, the same for a declaration and its definition."""
        text = " ".join(function.words[len(function.result):])
        text = re.sub(r"= [^,)]*", "", text.partition("(")[2])
        return tuple(re.sub(r"(?<=[&*> ]) ?\w+ ?$", "", part.strip())
                     for part in text.rpartition(")")[0].split(","))


def reach_of(root):
    root = pathlib.Path(root)
    return Reach({path.relative_to(root).as_posix(): path.read_text(encoding="utf-8")
                  for path in sorted((root / "mc").rglob("*.?pp"))})


if __name__ == "__main__":
    reach = reach_of(sys.argv[1])
    print("\n".join(reach.found))
    print("\nreturn bool:\n" + "\n".join(reach.questions))
    print(f"\n{len(reach.found)} functions and members reach a whole study, {len(reach.questions)} "
          "of them return bool")
