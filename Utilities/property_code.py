# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The C++ that follows from Plugin/*.xml: members with their defaults, visits, setters, getters and enumerations.

Filters/*.h.in become headers, in which it takes the place of lines such as

    // members: View             the members of a group of the panel, with their defaults
    // visits: StepSize, Gamma   use("StepSize", &S::StepSize), for these properties
    // values: KMode             the enumeration of a property
    // setters: rest             setters and getters of what no other line of this file has

`members` and `visits` of MediumSettings.h are those of RefractiveIndex.xml; what Schlieren.xml has of the medium, that
file declares itself. What a header declares itself is left out there, and so is what a base class declares: a setter
that does more than store a value is written by hand.
"""

import re
import textwrap

WIDTH = 100
SECTION = re.compile(r"^( *)// (members|visits|setters|values): (.*)\n", re.MULTILINE)
TYPES_OF_RANGES = {"double": "Double", "int": "Int"}
TYPES = {"Double": "double", "Int": "int", "String": "std::string"}


def type_of(item):
    """As C++ writes it; None where no section has the property: objects, arrays, commands, information and
    what a filter has found and keeps."""
    found = re.match(r"(Double|Int|String)VectorProperty", item.element.tag)
    is_found = item.element.get("information_only") == "1" or item.element.find("SchlierenLockDomain") is not None
    if not found or item.is_array or is_found or not item.command:
        return None
    if item.element.find("BooleanDomain") is not None:
        return "bool"
    return TYPES[found.group(1)]


def size_of(item):
    """The number of values: 0 for any number."""
    return 0 if item.element.get("repeat_command") == "1" else int(item.element.get("number_of_elements"))


def literal(item):
    """The default in C++."""
    text = item.element.get("default_values", "")
    if type_of(item) == "bool":
        return "true" if text == "1" else "false"
    if type_of(item) == "std::string":
        return f'"{text}"' if text else ""
    values = text.split()
    return "{ " + ", ".join(values) + " }" if len(values) > 1 else values[0]


def member(item):
    kind, size, name = type_of(item), size_of(item), item.name
    if size == 0:
        return f"std::vector<{kind}> {name};"
    value = literal(item)
    return f"{kind} {name}" + (f"[{size}]" if size > 1 else "") + (f" = {value};" if value else ";")


def constant(prefix, text):
    return prefix + re.sub(r"\W+", "_", text).upper()


def enumeration(item):
    """The lines of the property's enumeration and its first and last value; nothing where the XML names none."""
    domain = item.element.find("EnumerationDomain")
    if domain is None or not domain.get("constants"):
        return [], None
    name, *prefix = domain.get("constants").split()
    values = sorted((int(entry.get("value")), constant("".join(prefix), entry.get("text")))
                    for entry in domain.iter("Entry"))
    lines = [f"/// Values of {item.name}.", f"enum {name}", "{"]
    lines += [f"  {text} = {value}," for value, text in values]
    lines[-1] = lines[-1].rstrip(",")
    return lines + ["};", ""], (values[0][1], values[-1][1])


def limits(item):
    """The first and last value that a setter lets through, which clamps others; None: it takes all."""
    domain = item.element.find(f"{TYPES_OF_RANGES.get(type_of(item))}RangeDomain")
    if domain is None or domain.get("clamp") != "1":
        return None
    return domain.get("min"), domain.get("max", f"VTK_{type_of(item).upper()}_MAX")


def note(item):
    """What the property is: the first sentence of its Documentation, and its default."""
    first = re.split(r"(?<=\w[.)])\s+(?=[A-Z])|(?<=[.])\s+(?=[A-Z])", item.help)[0].rstrip(".")
    shown = item.element.get("default_values", "").strip()
    if type_of(item) == "bool":
        shown = "on" if shown == "1" else "off"
    elif item.element.find("EnumerationDomain") is not None:
        entries = {entry.get("value"): entry.get("text") for entry in item.element.iter("Entry")}
        shown = entries[shown]
    text = f"{first}. Default: {shown or 'none'}."
    return [f"/// {line}" for line in textwrap.wrap(text, WIDTH - 6)]


def setters(item):
    kind, size, name = type_of(item), size_of(item), item.name
    if size == 0:
        one, clear = item.command, item.element.get("clean_command")
        given, kept = ("const char* text", 'text ? text : ""') if kind == "std::string" else (f"{kind} value", "value")
        return [*note(item),
                f"void {one}({given})", "{", f"  this->{name}.emplace_back({kept});", "  this->Modified();", "}",
                f"void {clear}()", "{", f"  this->{name}.clear();", "  this->Modified();", "}"]
    lines, ends = enumeration(item)
    ends = ends or limits(item)
    lines += note(item)
    if kind == "std::string":
        lines += [f"vtkSetStdStringFromCharMacro({name});", f"vtkGetCharFromStdStringMacro({name});"]
    elif size > 1:
        lines += [f"vtkSetVector{size}Macro({name}, {kind});", f"vtkGetVector{size}Macro({name}, {kind});"]
    else:
        lines.append(f"vtkSetClampMacro({name}, {kind}, {', '.join(ends)});" if ends
                     else f"vtkSetMacro({name}, {kind});")
        lines.append(f"vtkGetMacro({name}, {kind});")
        if kind == "bool":
            lines.append(f"vtkBooleanMacro({name}, bool);")
    return lines


def declares(text, item, what):
    """Whether C++ that is written by hand has a property's member, visit or setter."""
    name = item.name
    if what == "members":
        return re.search(rf"^ +[\w:<>, ]+ {name}(\[\d\])?( = .*)?;", text, re.MULTILINE) is not None
    if what == "visits":
        return re.search(rf'use\("{name}"', text) is not None
    return re.search(rf"\bvoid (Set{name}|{item.command})\(|Set\w*Macro\({name},", text) is not None


def header(text, properties, bases=""):
    """The text of a header, generated from its template. `properties`: in order; `bases`: text that it follows."""
    by_hand = SECTION.sub("", text) + bases
    named = set()
    for _, what, chosen in SECTION.findall(text):
        named.update(name.strip() for name in chosen.split(",") if what != "values")

    def replace(match):
        indent, what, chosen = match.groups()
        names = {name.strip() for name in chosen.split(",")}
        blocks = []
        for item in properties.values():
            is_named = item.name in names or item.group in names
            is_rest = "rest" in names and item.name not in named and item.group not in named
            if not (is_named or is_rest) or not (type_of(item) or what == "values"):
                continue
            if what == "values":
                blocks.append(enumeration(item)[0][:-1])
            elif declares(by_hand, item, what):
                blocks.append(enumeration(item)[0][:-1] if what == "setters" and size_of(item) else [])
            elif what == "setters":
                blocks.append(setters(item))
            else:
                blocks.append([member(item) if what == "members" else f'use("{item.name}", &S::{item.name});'])
        lines = []
        for block in filter(None, blocks):
            lines += block + ([""] if what in ("setters", "values") else [])
        body = "".join(f"{indent}{line}\n" if line else "\n" for line in lines)
        return body.rstrip("\n") + "\n"

    return SECTION.sub(replace, text)
