#!/usr/bin/env python3
"""Divides the sources of each target into groups that can be compiled as one.

Usage: join_sources.py ROOT LIST OUT.cmake
       join_sources.py --self-test

LIST has a line a target: its name, a tab, its sources, divided by ';'. OUT.cmake sets UNITY_GROUP.

One file after the other in one compilation, two helpers of one name in anonymous namespaces would
clash, and a helper with what another file's headers declare or what another file calls by that name.
Nobody is to rename a helper for that: the names are read here (as clang-format leaves them:
declarations begin in column 0), and files are put into different groups where one's helper has a name
that stands anywhere in the other. It errs on the safe side: a group too many costs seconds.
"""
import pathlib
import re
import sys

MOST_SOURCES = 8
MOST_LINES = 1600  # so that two processors end at about the same time

INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)
KIND = re.compile(r"^(?:struct|class|union|enum(?: class| struct)?)\s+(?:\[\[.*?\]\]\s*)?(\w+)")
ALIAS = re.compile(r"^using (\w+) =")
DEFINE = re.compile(r"^#\s*define (\w+)")
DECLARED = re.compile(r"([\w:~]+)\s*(?:[({=;]|\[)")
WORD = re.compile(r"\b[A-Za-z_]\w*")
COMMENT = re.compile(r"//.*")
ENUM = re.compile(r"^enum (?!class|struct)[^{;]*\{([^}]*)\}", re.M)


def names_of(text):
    """What a file declares: in anonymous namespaces, elsewhere; and its types with their namespace."""
    hidden, shown, types = set(), set(), set()
    depth_hidden = False
    space = ""
    for line in text.splitlines():
        if line.startswith("namespace ") and not line.startswith("namespace {"):
            space = line.split()[1]
        if line.startswith("namespace {"):
            depth_hidden = True
            continue
        if line == "}  // namespace":
            depth_hidden = False
            continue
        define = DEFINE.match(line)
        if define:
            if f"#undef {define[1]}\n" not in text:
                hidden.add(define[1])
            continue
        if not line or not (line[0].isalpha() or line[0] == "_" or line[0] == "["):
            continue
        line = re.sub(r"^template <.*?>\s*(?=\w)", "", re.sub(r"^\[\[.*?\]\]\s*", "", line))
        line = re.sub(r"\[\[.*?\]\]\s*", "", line)
        if line.startswith(("namespace", "template", "TEST", "TYPED_TEST", "INSTANTIATE_",
                            "REGISTER_", "static_assert", "extern")):
            continue
        match = KIND.match(line) or ALIAS.match(line)
        if match is None:
            if line.startswith("using "):
                continue
            # Template arguments may hold brackets: away with them, from the innermost.
            before = None
            while before != line:
                before, line = line, re.sub(r"<[^<>]*>", "", line)
            match = DECLARED.search(line)
        if match is None or "::" in match[1]:
            continue
        (hidden if depth_hidden else shown).add(match[1])
        is_type = (KIND.match(line) or ALIAS.match(line)) and KIND.sub("", line) != ";"
        if is_type and not depth_hidden:
            types.add((space, match[1]))
    for body in ENUM.findall(text):
        hidden |= set(re.findall(r"\b(\w+)\b\s*(?:=[^,]*)?(?:,|$)", body.strip()))
    return hidden, shown, types


class Files:
    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.known = {}

    def read(self, path):
        """Text, hidden and shown names of a file, and the file that defines each of its types; the
        latter two with those of what it includes."""
        path = pathlib.Path(path)
        if path not in self.known:
            self.known[path] = ("", set(), set(), {})  # ends a circle
            text = path.read_text(encoding="utf-8") if path.exists() else ""
            hidden, shown, types = names_of(text)
            defined = dict.fromkeys(types, path)
            for name in INCLUDE.findall(text):
                included = self.read(self.root / name)
                shown |= included[2]
                defined = included[3] | defined
            self.known[path] = (text, hidden, shown, defined)
        return self.known[path]


def groups_of(files, sources):
    groups = []
    for source in sources:
        text, hidden, shown, defined = files.read(source)
        lines = text.count("\n")
        words = set(WORD.findall(COMMENT.sub("", text)))
        for group in groups:
            if len(group["sources"]) >= MOST_SOURCES or group["lines"] + lines > MOST_LINES:
                continue
            if hidden & group["words"] or group["hidden"] & words:
                continue
            if hidden & (group["shown"] - shown) or group["hidden"] & (shown - group["shown"]):
                continue
            if any(group["defined"].get(name, path) != path for name, path in defined.items()):
                continue
            break
        else:
            group = {"sources": [], "lines": 0, "hidden": set(), "words": set(), "shown": set(),
                     "defined": {}}
            groups.append(group)
        group["sources"].append(source)
        group["lines"] += lines
        group["hidden"] |= hidden
        group["words"] |= words
        group["shown"] |= shown
        group["defined"] |= defined
    return [group["sources"] for group in groups]


def main(root, listing, out):
    files = Files(root)
    written = []
    for line in pathlib.Path(listing).read_text(encoding="utf-8").splitlines():
        target, _, sources = line.partition("\t")
        for number, group in enumerate(groups_of(files, sources.split(";"))):
            if len(group) < 2:
                continue
            names = "\n  ".join(f'"{name}"' for name in group)
            written.append(f"set_source_files_properties(\n  {names}\n  TARGET_DIRECTORY {target}\n"
                           f"  PROPERTIES UNITY_GROUP {target}_{number})\n")
    text = "".join(written)
    path = pathlib.Path(out)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
    return 0


PLANTED = {
    "a.cpp": '#include "a.h"\nnamespace n {\nnamespace {\n\nint rounded(double a) {\n  return 1;\n'
             "}\n\n}  // namespace\n\nint f() {\n  return rounded(1.0);\n}\n}  // namespace n\n",
    "same_helper.cpp": "namespace n {\nnamespace {\ntemplate <class T>\nT rounded(T a) {\n}\n"
                       "}  // namespace\n}  // namespace n\n",
    "same_constant.cpp": "namespace n {\nnamespace {\nconstexpr std::array<int, 3> kSide = {};\n"
                         "}  // namespace\n}  // namespace n\n",
    "constant.cpp": "namespace n {\nnamespace {\nconst int kSide{3};\nenum Use { kDots, kLine };\n"
                    "}  // namespace\n}  // namespace n\n",
    "enumerator.cpp": "namespace n {\nnamespace {\nconstexpr int kDots = 3;\n}  // namespace\n}\n",
    "alias.cpp": "namespace n {\nnamespace {\nusing Row = int;\n}  // namespace\n}\n",
    "header_user.cpp": '#include "row.h"\nint rows() {\n  return 1;\n}\n',
    "row.h": "#pragma once\nnamespace n {\nclass Row {\n};\n}\n",
    "other_row.cpp": '#include "other_row.h"\nint other_rows() {\n}\n',
    "other_row.h": "#pragma once\nnamespace n {\nusing Row = int;\n}\n",
    "a.h": "#pragma once\nnamespace n {\nint f();\n}\n",
    "caller.cpp": "#include \"a.h\"\nnamespace n {\nvoid h() {\n  rounded(1);\n}\n}\n",
    "macro.cpp": "#define ONE 1\nint one() {\n  return ONE;\n}\n",
    "same_macro.cpp": "#define ONE 2\nint two() {\n  return ONE;\n}\n#undef ONE\n",
    "again_macro.cpp": "#define ONE 3\nint three() {\n  return ONE;\n}\n#undef ONE\n",
    "free.cpp": '#include "a.h"\nnamespace n {\nvoid A::rounded() {\n}\nint g() {\n}\n}\n',
}
APART = [("a.cpp", "same_helper.cpp"), ("same_constant.cpp", "constant.cpp"),
         ("constant.cpp", "enumerator.cpp"), ("alias.cpp", "header_user.cpp"),
         ("other_row.cpp", "header_user.cpp"), ("a.cpp", "caller.cpp"),
         ("macro.cpp", "same_macro.cpp")]
TOGETHER = [("a.cpp", "alias.cpp"), ("same_helper.cpp", "constant.cpp"),
            ("header_user.cpp", "free.cpp"), ("same_macro.cpp", "again_macro.cpp")]


def self_test():
    import tempfile
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        for name, text in PLANTED.items():
            pathlib.Path(folder, name).write_text(text, encoding="utf-8")
        for pairs, expected in ((APART, 2), (TOGETHER, 1)):
            for pair in pairs:
                groups = groups_of(Files(folder), [str(pathlib.Path(folder, n)) for n in pair])
                if len(groups) != expected:
                    wrong.append(f"{pair}: {len(groups)} groups, expected {expected}")
        many = groups_of(Files(folder), [str(pathlib.Path(folder, "free.cpp"))] * 9)
        if len(many) != 2:
            wrong.append(f"9 small files in {len(many)} groups, expected 2")
    print("\n".join(wrong) or f"{len(APART) + len(TOGETHER) + 1} planted pairs divided rightly")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(self_test() if sys.argv[1:] == ["--self-test"] else main(*sys.argv[1:]))
