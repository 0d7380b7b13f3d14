#!/usr/bin/env python3
"""Writes the software bill of materials of the package, as SPDX 2.3 in JSON.

Usage: bill_of_materials.py --version V --architecture A [--sysroot S] --source TREE --root ROOT --out FILE

Names the package, its programs with their digests, and each Debian package that is compiled in, linked
with or loaded, with the very version that was there. SOURCE_DATE_EPOCH is the time it bears.
"""
import argparse
import datetime
import hashlib
import json
import os
import pathlib
import subprocess

import debian_packages

# Source package -> (licence, what the programs do with it). A package that is not listed is an error:
# a new dependency must be weighed.
MATERIALS = {
    "aravis": ("LGPL-2.1-or-later", "loaded"),
    "cli11": ("BSD-3-Clause", "compiled"),
    "eigen3": ("MPL-2.0", "compiled"),
    "gcc-12": ("GPL-3.0-or-later WITH GCC-exception-3.1", "linked"),
    "glib2.0": ("LGPL-2.1-or-later", "loaded"),
    "glibc": ("LGPL-2.1-or-later", "linked"),
    "gmp": ("LGPL-3.0-or-later OR GPL-2.0-or-later", "linked"),
    "gnutls28": ("LGPL-2.1-or-later", "linked"),
    "libffi": ("MIT", "linked"),
    "libgpiod": ("LGPL-2.1-or-later", "linked"),
    "libidn2": ("LGPL-3.0-or-later OR GPL-2.0-or-later", "linked"),
    "libjpeg-turbo": ("BSD-3-Clause AND IJG AND Zlib", "linked"),
    "libmicrohttpd": ("LGPL-2.1-or-later", "linked"),
    "libmodbus": ("LGPL-2.1-or-later", "linked"),
    "libpng1.6": ("libpng-2.0", "linked"),
    "libtasn1-6": ("LGPL-2.1-or-later", "linked"),
    "libunistring": ("LGPL-3.0-or-later OR GPL-2.0-or-later", "linked"),
    "libxcrypt": ("LGPL-2.1-or-later", "linked"),
    "libyaml": ("MIT", "linked"),
    "nettle": ("LGPL-3.0-or-later OR GPL-2.0-or-later", "linked"),
    "nlohmann-json3": ("MIT", "compiled"),
    "openssl": ("Apache-2.0", "linked"),
    "p11-kit": ("BSD-3-Clause", "linked"),
    "sqlite3": ("blessing", "linked"),
    "tomlplusplus": ("MIT", "compiled"),
    "xz-utils": ("LicenseRef-Public-Domain", "linked"),
    "zlib": ("Zlib", "linked"),
}
RELATION = {"compiled": "STATIC_LINK", "linked": "DYNAMIC_LINK", "loaded": "OPTIONAL_DEPENDENCY_OF"}


def element(kind, name):
    """An identifier of SPDX: letters, digits, dots and dashes."""
    return f"SPDXRef-{kind}-" + "".join(c if c.isalnum() or c in ".-" else "-" for c in name)


def commit_of(tree):
    done = subprocess.run(["git", "--no-optional-locks", "-C", tree, "rev-parse", "HEAD"],
                          capture_output=True, text=True, check=False)
    return done.stdout.strip() or "unknown"


def material(name, version, source, architecture):
    licence, _ = MATERIALS[source]
    return {
        "SPDXID": element("Package", name),
        "name": name,
        "versionInfo": version,
        "supplier": "Organization: Debian",
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": licence,
        "licenseDeclared": licence,
        "copyrightText": "NOASSERTION",
        "externalRefs": [{
            "referenceCategory": "PACKAGE-MANAGER",
            "referenceType": "purl",
            "referenceLocator": f"pkg:deb/debian/{name.replace('+', '%2B')}"
                                f"@{version.replace('+', '%2B').replace(':', '%3A')}"
                                f"?arch={architecture}&distro=bookworm"}],
    }


def program(root, path):
    digest = {name: hashlib.new(name, path.read_bytes()).hexdigest() for name in ("sha1", "sha256")}
    return {
        "SPDXID": element("File", path.name),
        "fileName": "./" + path.relative_to(root).as_posix(),
        "fileTypes": ["BINARY"],
        "checksums": [{"algorithm": name.upper(), "checksumValue": value}
                      for name, value in digest.items()],
        "licenseConcluded": "Apache-2.0",
        "copyrightText": "2026 The Tubesight engineers",
    }


def relations(materials):
    box = element("Package", "tubesight")
    yield {"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES",
           "relatedSpdxElement": box}
    for name, _, source in materials:
        relation = RELATION[MATERIALS[source][1]]
        ends = (box, element("Package", name))
        if relation.endswith("_OF"):
            ends = ends[::-1]
        yield {"spdxElementId": ends[0], "relationshipType": relation, "relatedSpdxElement": ends[1]}


def document(arguments):
    commit = commit_of(arguments.source)
    materials = debian_packages.packages(arguments.sysroot)
    unknown = sorted({source for _, _, source in materials} - set(MATERIALS))
    if unknown:
        raise SystemExit(f"bill_of_materials.py: no licence is known of {', '.join(unknown)}")
    created = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc)
    name = f"tubesight-{arguments.version}-{arguments.architecture}"
    root = pathlib.Path(arguments.root)
    files = [program(root, path) for path in sorted((root / "usr/bin").iterdir())]
    return {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": name,
        "documentNamespace": f"urn:tubesight:spdx:{name}:{commit}",
        "creationInfo": {"created": created.strftime("%Y-%m-%dT%H:%M:%SZ"),
                         "creators": ["Tool: tubesight-bill_of_materials.py"]},
        "packages": [{
            "SPDXID": element("Package", "tubesight"),
            "name": "tubesight",
            "versionInfo": arguments.version,
            "sourceInfo": f"commit {commit}",
            "downloadLocation": "NOASSERTION",
            "filesAnalyzed": False,
            "licenseConcluded": "Apache-2.0",
            "licenseDeclared": "Apache-2.0",
            "copyrightText": "2026 The Tubesight engineers",
            "primaryPackagePurpose": "APPLICATION",
        }] + [material(*row, arguments.architecture) for row in materials],
        "files": files,
        "relationships": list(relations(materials)) + [
            {"spdxElementId": element("Package", "tubesight"), "relationshipType": "CONTAINS",
             "relatedSpdxElement": file["SPDXID"]} for file in files],
        "hasExtractedLicensingInfos": [{
            "licenseId": "LicenseRef-Public-Domain",
            "extractedText": "Public domain, as the authors of XZ Utils declare of liblzma."}],
    }


def main():
    parser = argparse.ArgumentParser()
    for name in ("version", "architecture", "source", "root", "out"):
        parser.add_argument(f"--{name}", required=True)
    parser.add_argument("--sysroot", default="")
    arguments = parser.parse_args()
    text = json.dumps(document(arguments), indent=2) + "\n"
    pathlib.Path(arguments.out).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
