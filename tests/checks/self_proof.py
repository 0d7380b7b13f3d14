#!/usr/bin/env python3
"""No box can link the tracker without its margin check: scans libraries for its symbols.

Usage: self_proof.py NM SELF_PROOF_ARCHIVE ARCHIVE... | self_proof.py --self-test NM COMPILER

The first archive must hold such symbols, or the names looked for are not the right ones any more;
the others, those of a box, may neither define nor need one.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

from source_text import report

UNCHECKED = re.compile(r"unchecked", re.IGNORECASE)


def symbols_of(nm, archive):
    """All symbols of an archive or object, defined or needed."""
    text = subprocess.run([nm, str(archive)], check=True, capture_output=True, text=True).stdout
    return [line.split()[-1] for line in text.splitlines() if len(line.split()) >= 2]


def check(nm, archive):
    symbols = symbols_of(nm, archive)
    name = pathlib.Path(archive).name
    if not symbols:
        return [f"{name}: has no symbols, so nothing was checked"]
    return [f"{name}: {symbol} belongs to the self-proof" for symbol in symbols
            if UNCHECKED.search(symbol)]


def check_all(nm, self_proof, archives):
    problems = [problem for archive in archives for problem in check(nm, archive)]
    if not any(UNCHECKED.search(symbol) for symbol in symbols_of(nm, self_proof)):
        problems.append(f"{pathlib.Path(self_proof).name}: has no symbol of the self-proof: what "
                        "this check looks for is not what it is called")
    if not archives:
        problems.append("no archive given")
    return problems


COMMON = ("struct MarginChecked { static constexpr bool kChecked = true; };\n"
          "struct MarginUnchecked { static constexpr bool kChecked = false; };\n"
          "template <class M> struct Tracker { int step(int a); int follow_unchecked(int a); };\n"
          "template <class M> int Tracker<M>::step(int a) {\n"
          "  if constexpr (!M::kChecked) { return follow_unchecked(a); } else { return a; }\n}\n")
SELF_PROOF = (COMMON + "template <class M> int Tracker<M>::follow_unchecked(int a) { return a; }\n"
              "template struct Tracker<MarginUnchecked>;\n")
PLANTED = [
    (COMMON + "template struct Tracker<MarginChecked>;\n", None),
    (SELF_PROOF, "belongs to the self-proof"),
    (COMMON + "extern template struct Tracker<MarginUnchecked>;\n"
     "int f(Tracker<MarginUnchecked>& t) { return t.step(1); }\n", "belongs to the self-proof"),
    ("struct B { bool a; };\nvoid disable_check_unchecked(B& b) { b.a = false; }\n",
     "belongs to the self-proof"),
]


def self_test(nm, compiler):
    wrong = []
    with tempfile.TemporaryDirectory() as folder:

        def compiled(name, text):
            source, obj = pathlib.Path(folder, name + ".cpp"), pathlib.Path(folder, name + ".o")
            source.write_text(text, encoding="utf-8")
            subprocess.run([compiler, "-std=c++20", "-O2", "-c", source, "-o", obj], check=True)
            return obj

        proof = compiled("proof", SELF_PROOF)
        for number, (text, expected) in enumerate(PLANTED):
            problems = check_all(nm, proof, [compiled(f"planted{number}", text)])
            if (expected is None) != (not problems) or (expected and expected not in problems[0]):
                wrong.append(f"expected '{expected}', reported {problems}, in: {text}")
        clean = compiled("clean", PLANTED[0][0])
        if not any("is not what it is called" in problem
                   for problem in check_all(nm, clean, [clean])):
            wrong.append("a self-proof without its symbols was not noticed")
    return report("self_proof --self-test", wrong, f"{len(PLANTED) + 1} planted objects")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test(*sys.argv[2:4]))
    sys.exit(report("self_proof", check_all(sys.argv[1], sys.argv[2], sys.argv[3:]),
                    f"{len(sys.argv) - 3} archives"))
