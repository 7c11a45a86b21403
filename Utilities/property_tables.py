#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the tables of Documentation/properties.md, photograph.md and wavefront.md, or the headers of Filters/*.h.in (see
property_code.py), from Plugin/*.xml.

    Utilities/property_tables.py                     # write the tables
    Utilities/property_tables.py --check             # fail where a page differs from them
    Utilities/property_tables.py --headers FOLDER    # write the headers into a folder

A table stands between <!-- table: GROUP --> and <!-- end -->, with what is too long for its cells below it; GROUP is the label of a property group, or its attribute table, or one of
Inputs, Commands, Information and Others, the properties in no group. The rest of the page is written by hand.
"""

import collections
import difflib
import os
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

import property_code

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE = os.path.join(ROOT, "Documentation", "properties.md")
FILES = [os.path.join(ROOT, "Plugin", name) for name in ("RefractiveIndex.xml", "Schlieren.xml")]
PHOTOGRAPH_FILES = [os.path.join(ROOT, "Plugin", "Photograph.xml")]
WAVEFRONT_FILES = [os.path.join(ROOT, "Plugin", "Wavefront.xml")]

Property = collections.namedtuple("Property", "element name label command is_array entries default help group")


def words(element):
    return " ".join((element.text or "").split())


def entries_of(element):
    """The values of an enumeration, by their texts."""
    return {entry.get("text"): int(entry.get("value")) for entry in element.iter("Entry")}


def default_of(element):
    """The default as the XML has it: numbers, names of entries, bools; None where it is an object or an array."""
    attributes = element.attrib
    text = attributes.get("default_values")
    if "element_types" in attributes:
        return "None" if (text or "").endswith(" None") else None
    if attributes.get("repeat_command") == "1":
        return []
    if not element.tag.endswith("VectorProperty") or text is None:
        return None
    for entry in element.iter("Entry"):
        if entry.get("value") == text:
            return entry.get("text")
    if element.find("BooleanDomain") is not None:
        return text == "1"
    if element.tag.startswith("String"):
        return text
    kind = float if element.tag.startswith("Double") else int
    values = [kind(value) for value in text.split()]
    return values if len(values) > 1 else values[0]


def group_of(element, groups):
    if element.tag == "InputProperty":
        return "Inputs"
    if element.tag == "Property":
        return "Commands"
    if element.get("information_only") == "1":
        return "Information"
    return groups.get(element.get("name"), "Others")


def read(files=None):
    """All properties, by name; where both filters describe one, as Schlieren does."""
    found = {}
    groups = {}
    for path in files or FILES:
        proxy = ElementTree.parse(path).getroot().find(".//SourceProxy")
        for group in proxy.findall("PropertyGroup"):
            groups.update({member.get("name"): group.get("table", group.get("label"))
                           for member in group.findall("Property")})
        for element in proxy:
            name, help_element = element.get("name"), element.find("Documentation")
            if element.tag != "Property" and not element.tag.endswith("Property"):
                continue
            if help_element is None:
                sys.exit(f"{path}: {name} has no Documentation.")
            if re.search(r"\bdefault", words(help_element), re.IGNORECASE):
                sys.exit(f"{path}: the Documentation of {name} repeats its default, which its attribute states.")
            found[name] = Property(element, name, element.get("label", name), element.get("command"),
                                   "element_types" in element.attrib, entries_of(element), default_of(element),
                                   words(help_element), group_of(element, groups))
    return found


def shown(item):
    """A default as a cell of a table: numbers as they are written in the XML."""
    value = item.default
    if value is None:
        return ""
    if isinstance(value, bool):
        return "on" if value else "off"
    if value in ("", []):
        return "none"
    if isinstance(value, str):
        return f"`{value}`"
    return ", ".join(item.element.get("default_values").split()).replace("-", "−").replace("e−", "e-")


def range_of(element):
    names = list(entries_of(element)) or [entry.get("value") for entry in element.iter("String")]
    if names:
        return ", ".join(f"`{name}`" for name in names[:4]) + (", …" if len(names) > 4 else "")
    for tag in ("DoubleRangeDomain", "IntRangeDomain"):
        domain = element.find(tag)
        if domain is not None:
            low, high = (domain.get(end, "").split(" ")[0].replace("-", "−") for end in ("min", "max"))
            return f"{low} to {high}" if high else f"≥ {low}" if low else ""
    return "on, off" if element.find("BooleanDomain") is not None else ""


def split(text, most=40):
    """What a cell of a table holds, at most so many words, if it can be whole sentences, and what is left."""
    for mark in ".;:":
        pieces = re.split(rf"(?<=\{mark}) ", text)
        count = len(pieces)
        while count > 1 and sum(len(piece.split()) for piece in pieces[:count]) > most:
            count -= 1
        cell, rest = " ".join(pieces[:count]), " ".join(pieces[count:])
        if len(cell.split()) <= most:
            break
    return re.sub("[;:]$", ".", cell), rest[:1].upper() + rest[1:]


def table(group, properties):
    """The rows of a group, in the order of the XML, and below them a list of what is too long for them."""
    members = [item for item in properties.values() if item.group == group]
    if not members:
        sys.exit(f"{PAGE}: there is no property in a group '{group}'.")
    labels = {item.label: item.name for item in properties.values() if " " in item.label}
    known = re.compile(r"\b(" + "|".join(sorted(labels, key=len, reverse=True)) + r")\b(?!:)")

    def linked(text):
        return known.sub(lambda found: f"`{labels[found.group(1)]}`", text).replace("|", "\\|")

    plain = group in ("Inputs", "Commands", "Information")
    columns = ("name", "meaning") if plain else ("property", "default", "values", "meaning")
    rows, notes = [columns], []
    for item in members:
        meaning, rest = split(item.help)
        between = [] if plain else [shown(item), range_of(item.element)]
        rows.append([f"`{item.name}`", *between, linked(meaning)])
        if item.entries:
            rest = re.sub(rf"(?<=\.) (?=({'|'.join(map(re.escape, item.entries))}): )", "\n  - ", rest)
        if rest:
            notes.append(f"- `{item.name}`: {linked(rest)}")
    lines = ["| " + " | ".join(cells) + " |" for cells in rows]
    lines.insert(1, "|" + "---|" * len(columns))
    return lines + [""] * bool(notes) + notes


def page(text, properties):
    """The page with its tables as they should be."""
    made = []

    def replace(match):
        made.append(match.group(1))
        return "\n".join([f"<!-- table: {match.group(1)} -->", *table(match.group(1), properties), "<!-- end -->"])

    result = re.sub(r"<!-- table: ([\w ]+) -->\n.*?<!-- end -->", replace, text, flags=re.DOTALL)
    missing = {item.group for item in properties.values()} - set(made)
    if missing or len(made) != len(set(made)):
        sys.exit(f"{PAGE}: tables that are missing: {sorted(missing)}; all tables: {made}.")
    return result


def pages():
    """What each page should be, by its name in the project."""
    made = {}
    for files, name in ((FILES, "properties"), (PHOTOGRAPH_FILES, "photograph"), (WAVEFRONT_FILES, "wavefront")):
        name = f"Documentation/{name}.md"
        with open(os.path.join(ROOT, name), encoding="utf-8") as file:
            made[name] = page(file.read(), read(files))
    return made


def write_headers(folder):
    """Makes the headers of Filters/*.h.in; leaves those alone that are there."""
    medium = read(FILES[:1])
    image = {name: item for name, item in read(FILES[1:]).items() if name not in medium}
    bases = ""
    for name, properties in (("MediumSettings", medium), ("vtkFlowAlgorithm", medium), ("SchlierenSettings", image),
                             ("vtkSchlierenFilter", image), ("PhotographSettings", read(PHOTOGRAPH_FILES)),
                             ("vtkCompareWithPhotograph", read(PHOTOGRAPH_FILES)),
                             ("WavefrontSettings", read(WAVEFRONT_FILES)), ("vtkWavefront", read(WAVEFRONT_FILES))):
        with open(os.path.join(ROOT, "Filters", f"{name}.h.in"), encoding="utf-8") as file:
            made = property_code.header(file.read(), properties, bases if properties is image else "")
        bases += made if properties is medium else ""
        path = pathlib.Path(folder, f"{name}.h")
        if not path.exists() or path.read_text(encoding="utf-8") != made:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(made, encoding="utf-8")


def main():
    if sys.argv[1:2] == ["--headers"]:
        write_headers(sys.argv[2])
        return
    differ = []
    for name, text in pages().items():
        path = os.path.join(ROOT, name)
        with open(path, encoding="utf-8") as file:
            there = file.read()
        if text == there:
            continue
        differ.append(name)
        if "--check" not in sys.argv[1:]:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        else:
            sys.stdout.writelines(difflib.unified_diff(there.splitlines(True), text.splitlines(True), name,
                                                       "what Plugin/*.xml says"))
    if differ and "--check" in sys.argv[1:]:
        sys.exit(f"{', '.join(differ)}: not what Plugin/*.xml says: run Utilities/property_tables.py.")


if __name__ == "__main__":
    main()
