#!/usr/bin/env python3
"""Manual page and bash completion name the commands and options that the program tells, and no others.

Usage: manual.py PROGRAM PAGE COMPLETION | manual.py --self-test

Also: an option has the same argument in the page as in --help; the page is rendered without warnings;
the completion offers the right files, and the words of options that take one of a few.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

from source_text import report

CHOICES = [("replay", "--scalar"), ("pose", "--method"), ("pose", "--edge")]
FILES = ["a.toml", "b.y4m", "c.y4m.xz", "d.png", "e.pgm", "f.csv", "g.txt", "h.pdf"]
# What is typed, and what is offered beside the folder.
OFFERED = [
    ("new s.toml --from ", "b.y4m c.y4m.xz d.png e.pgm"),
    ("new s.toml --camera ", "a.toml"),
    ("new s.toml --lattice ", "square triangular"),
    ("new s.toml --scan ", "even-first odd-first progressive"),
    ("replay ", "a.toml"),
    ("replay a.toml ", "b.y4m c.y4m.xz"),
    ("replay --overlay-estimates a.toml ", "b.y4m c.y4m.xz"),
    ("replay --scalar fixed a.toml b", "b.y4m"),
    ("replay a.toml b.y4m ", ""),
    ("replay a.toml b.y4m --fields ", "f.csv"),
    ("replay a.toml b.y4m --overlay ", "b.y4m"),
    ("pose a.toml ", "b.y4m c.y4m.xz d.png e.pgm"),
    ("pose a.toml d.png ", "b.y4m c.y4m.xz d.png e.pgm"),
    ("pose a.toml d.png --overlay ", "d.png"),
    ("look ", "b.y4m c.y4m.xz d.png e.pgm"),
    ("look d.png --csv ", "f.csv"),
    ("look d.png --overlay ", "d.png"),
    ("calibrate camera ", "a.toml"),
    ("calibrate camera a.toml --out ", "a.toml"),
    ("calibrate base ", "f.csv"),
    ("calibrate base f.csv --picture ", "d.png"),
    ("calibrate template ", "h.pdf"),
    ("calibrate template h.pdf --lattice ", "square staggered"),
    ("calibrate template h.pdf --dots ", "dark bright"),
    ("budget ", "a.toml"),
    ("budget a.toml --plot ", "d.png"),
    ("simulate ", "a.toml"),
    ("campaign --moves ", ""),
    ("campaign --resume ", "f.csv"),
    ("campaign --merge f.csv ", "f.csv"),
]
WITHOUT_FOLDER = {"new s.toml --lattice ", "new s.toml --scan ", "calibrate template h.pdf --lattice ", "calibrate template h.pdf --dots ",
                  "replay a.toml b.y4m ", "campaign --moves ", "replay --scalar fixed a.toml b"}
# The same of the other programs; one without commands offers files at once.
OTHERS = {
    "tubesightd": [("", "a.toml")],
    "tubesightctl": [("--socket ", " ".join(FILES)), ("start --socket x --field ", "")],
}
OTHERS_WITHOUT_FOLDER = {"new s.toml --lattice ", "new s.toml --scan ", "start --socket x --field "}


class Program:
    """What --help tells: {command or "": {option: argument or ""}}."""

    def __init__(self, program):
        self.program = program
        text = self.run("--help")
        self.options = {"": self.options_in(text)}
        commands = text.partition("Subcommands:")[2]
        for command in re.findall(r"^  ([\w-]+) ", commands, re.MULTILINE):
            self.options[command] = self.options_in(self.run(command, "--help"))

    def run(self, *arguments):
        done = subprocess.run([self.program, *arguments], capture_output=True, text=True, check=False)
        return done.stdout + done.stderr

    @staticmethod
    def options_in(text):
        found = {}
        for names, rest in re.findall(r"^  (-[\w,-]+)(.*)$", text, re.MULTILINE):
            argument = re.match(r" ([^ ]+)  ", rest)
            for name in names.split(","):
                found[name] = argument.group(1) if argument else ""
        return found

    def choices(self, command, option):
        words = re.search(r"\{(.*)\}", self.run(command, "x", "x", option, "?"))
        return set(words.group(1).split(",")) if words else set()


def page_options(page):
    """The same as Program.options from the source of the page."""
    found, part, command = {"": {}}, "", ""
    after_tag = False
    for line in page.splitlines():
        macro, _, rest = line.partition(" ")
        if macro == ".SH":
            part, command = rest, ""
        elif macro == ".SS" and part == "COMMANDS":
            command = rest.replace("\\-", "-")
            found[command] = {}
        elif after_tag and macro in (".B", ".BI", ".BR"):
            words = [quoted.replace('""', '"') if quoted else plain for quoted, plain in
                     re.findall(r'"((?:[^"]|"")*)"|(\S+)', rest)]
            text = "".join(words).replace("\\-", "-")
            if text.startswith("-"):
                name, _, argument = text.partition(" ")
                names = text.split(", ") if ", " in text else [name]
                found[command].update({each: "" if len(names) > 1 else argument for each in names})
        after_tag = macro == ".TP"
    return found


def offered(completion, typed, folder, name="tubesight"):
    """What the completion offers for the last word of the line."""
    script = ('source "$1"; read -ra COMP_WORDS <<< "$3 $2"; [[ $2 == *" " || -z $2 ]] && '
              'COMP_WORDS+=(""); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); "_$3"; '
              'printf "%s\\n" "${COMPREPLY[@]}"')
    done = subprocess.run(["bash", "--norc", "-c", script, "bash", completion, typed, name],
                          cwd=folder, capture_output=True, text=True, check=False)
    return set(done.stdout.split()) | ({done.stderr} if done.stderr else set())


def differences(what, found, expected):
    return ([f"{what}: '{name}' is missing" for name in sorted(expected - found)] +
            [f"{what}: '{name}' is not the program's" for name in sorted(found - expected)])


def check_page(told, page_path):
    page = page_options(page_path.read_text(encoding="utf-8"))
    problems = differences("page", set(page), set(told))
    for command in sorted(set(page) & set(told)):
        what = f"page, {command or 'options'}"
        problems += differences(what, set(page[command]), set(told[command]))
        problems += [f"{what}: {name} {page[command][name]}, --help says '{argument}'"
                     for name, argument in sorted(told[command].items())
                     if page[command].get(name, argument) != argument]
    rendered = subprocess.run(["groff", "-ww", "-man", "-Tutf8", "-z", str(page_path)],
                              capture_output=True, text=True, check=False)
    return problems + [f"page: {line}" for line in rendered.stderr.splitlines()]


def check_completion(told, choices, completion, program="tubesight"):
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        for name in FILES:
            pathlib.Path(folder, name).touch()
        pathlib.Path(folder, "folder").mkdir()
        ask = lambda typed: offered(completion, typed, folder, program)
        if set(told) != {""}:
            problems += differences("completion", ask(""), set(told) - {""})
        for command, options in told.items():
            typed = f"{command} -" if command else "-"
            problems += differences(f"completion of '{typed}'", ask(typed), set(options))
        for (command, option), words in choices.items():
            typed = f"{command} {option} "
            problems += differences(f"completion of '{typed}'", ask(typed), words)
        alone = WITHOUT_FOLDER | OTHERS_WITHOUT_FOLDER
        for typed, names in OTHERS.get(program, OFFERED):
            expected = set(names.split()) | (set() if typed in alone else {"folder"})
            problems += differences(f"completion of '{typed}'", ask(typed), expected)
    return problems


def check(program_path, page, completion):
    program = Program(program_path)
    name = pathlib.Path(program_path).name
    choices = {} if name in OTHERS else {
        (command, option): program.choices(command, option) for command, option in CHOICES}
    return (check_page(program.options, pathlib.Path(page)) +
            check_completion(program.options, choices, completion, name))


def self_test():
    told = {"": {"-h": "", "--help": ""}, "run": {"-h": "", "--help": "", "--to": "FILE", "--new": ""}}
    page = ('.TH X 1\n.SH OPTIONS\n.TP\n.BR \\-h ", " \\-\\-help\nHelps.\n.SH COMMANDS\n.SS run\n'
            '.TP\n.BR \\-h ", " \\-\\-help\nHelps.\n.TP\n.BI "\\-\\-to " F\nTo.\n'
            ".TP\n.B \\-\\-old\nOld.\n.SS gone\n.bad\n")
    completion = ("_tubesight() { case $COMP_CWORD in 1) COMPREPLY=(run -h) ;; "
                  "*) COMPREPLY=(-h --help --to --old) ;; esac; }\n")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "page")
        path.write_text(page, encoding="utf-8")
        script = pathlib.Path(folder, "completion")
        script.write_text(completion, encoding="utf-8")
        found = check_page(told, path)
        found += check_completion(told, {("run", "--to"): {"left"}}, str(script))
    expected = ["page: 'gone' is not", "page, run: '--new' is missing", "page, run: '--old' is not",
                "page, run: --to F, --help says 'FILE'", "page: ",
                "completion: '-h' is not", "completion of '-': '--help' is missing",
                "completion of '-': 'run' is not", "completion of 'run -': '--new' is missing",
                "completion of 'run -': '--old' is not", "completion of 'run --to ': 'left' is missing"]
    wrong = []
    for begin in expected:
        if not any(problem.startswith(begin) for problem in found):
            wrong.append(f"not caught: {begin}; reported: {found}")
    return report("manual --self-test", wrong, f"{len(expected)} planted mistakes")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test())
    sys.exit(report("manual", check(*sys.argv[1:4]), "page and completion"))
