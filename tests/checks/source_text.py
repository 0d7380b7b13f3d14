"""What several checks share: finding our sources, reading them without comments and strings, planting
files for a self-test."""
import pathlib
import re

SUFFIXES = (".h", ".cpp")


def sources(root, folders):
    """All headers and sources below the folders, in a stable order."""
    return sorted(path for folder in folders for path in (pathlib.Path(root) / folder).rglob("*")
                  if path.suffix in SUFFIXES)


_COMMENT_OR_STRING = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"([^()\s]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|'
    r"(?<![0-9A-Za-z_])'(?:\\.|[^'\\\n])+'", re.DOTALL)


def code_only(text):
    """The text with comments blanked and string contents removed; line numbers stay."""
    def blank(match):
        found = match.group(0)
        keep = '""' if found[0] in 'R"' else "0" if found[0] == "'" else " "
        return keep + "\n" * found.count("\n")
    return _COMMENT_OR_STRING.sub(blank, text)


def plant(root, files):
    """Writes (name, text) pairs below a folder, with the folders between."""
    for name, text in files:
        path = pathlib.Path(root) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def report(name, problems, what):
    """Prints the problems and the verdict; returns the exit status."""
    for problem in problems:
        print(problem)
    print(f"{name}: {len(problems)} problems in {what}")
    return 1 if problems else 0
