#!/usr/bin/env python3
"""Orders headers into chains, so that each is compiled alone and few compilations do it.

Usage: chain_headers.py ROOT LIST FOLDER
       chain_headers.py --self-test

LIST has a header a line, absolute. FOLDER gets a source a chain, headers_<n>.cpp, that includes them one
after the other. What stands before a header in its chain is only what it includes anyway, by itself or by
others: what it forgets to include is missing as it would be if it stood alone. A chain costs no more
than its last header. Prints the number of chains.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include "([^"]+)"', re.M)


def included_by(texts):
    """{header: all headers of `texts` that it includes, by itself or by others}."""
    known = {}

    def of(header):
        if header not in known:
            known[header] = set()  # ends a circle
            found = set()
            for name in INCLUDE.findall(texts[header]):
                if name in texts:
                    found |= {name} | of(name)
            known[header] = found - {header}
        return known[header]

    for header in texts:
        of(header)
    return known


def chains_of(included):
    """As few chains as there can be: each header goes before one that includes it, where one is free."""
    users = {header: [] for header in included}
    for header in sorted(included, key=lambda h: (len(included[h]), h)):
        for name in included[header]:
            if header not in included[name]:  # no circle
                users[name].append(header)
    after, before = {}, {}

    def place(header, tried):
        for user in users[header]:
            if user not in tried:
                tried.add(user)
                if user not in before or place(before[user], tried):
                    after[header], before[user] = user, header
                    return True
        return False

    for header in sorted(included):
        place(header, set())
    chains = []
    for header in sorted(included):
        if header not in before:
            chain = [header]
            while chain[-1] in after:
                chain.append(after[chain[-1]])
            chains.append(chain)
    return chains


def main(root, listing, folder):
    root, folder = pathlib.Path(root), pathlib.Path(folder)
    lines = pathlib.Path(listing).read_text(encoding="utf-8").split()
    names = [pathlib.Path(line).relative_to(root).as_posix() for line in lines]
    texts = {name: (root / name).read_text(encoding="utf-8") for name in names}
    chains = chains_of(included_by(texts))
    folder.mkdir(parents=True, exist_ok=True)
    for number, chain in enumerate(chains):
        text = "".join(f'#include "{name}"\n' for name in chain)
        path = folder / f"headers_{number}.cpp"
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
    print(len(chains))
    return 0


PLANTED = {"a.h": "", "b.h": '#include "a.h"\n', "c.h": '#include "b.h"\n', "d.h": '#include "a.h"\n',
           "alone.h": "#include <vector>\n", "round.h": '#include "about.h"\n',
           "about.h": '#include "round.h"\n'}


def self_test():
    included = included_by(PLANTED)
    wrong = []
    if included["c.h"] != {"a.h", "b.h"} or included["round.h"] != {"about.h"}:
        wrong.append(f"read {included}")
    chains = chains_of({name: found for name, found in included.items() if "r" not in name[:2]
                        and name != "about.h"})
    if sorted(chains) != [["a.h", "b.h", "c.h"], ["alone.h"], ["d.h"]]:
        wrong.append(f"chained {chains}")
    chains = chains_of(included)
    if sorted(name for chain in chains for name in chain) != sorted(PLANTED):
        wrong.append(f"not each header once, or a circle: {chains}")
    for chain in chains:
        for earlier, later in zip(chain, chain[1:]):
            if earlier not in included[later]:
                wrong.append(f"{earlier} stands before {later}, which does not include it")
    print("\n".join(wrong) or f"{len(PLANTED)} planted headers chained rightly")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(self_test() if sys.argv[1:] == ["--self-test"] else main(*sys.argv[1:]))
