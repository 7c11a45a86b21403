# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads what the user names: any file of ParaView's, PLOT3D pairs, and chooses the array."""

import base64
import os
import re
import struct

import paraview.simple as pv

from arguments import MODELS, DemoError
from messages import say


def plot3d_solution(path):
    """The solution file beside a PLOT3D grid file: xyz -> q in the name, or .x, .g, .grid -> .q."""
    folder, name = os.path.split(path)
    guesses = [name.replace("xyz", "q"), name.replace("XYZ", "Q")]
    guesses += [re.sub(r"\.(x|g|grid|grd)(?=\.|$)", ".q", name)]
    for guess in guesses:
        if guess != name and os.path.isfile(os.path.join(folder, guess)):
            return os.path.join(folder, guess)
    return None


def inline_appended_data(source, target):
    """Copies a VTK XML file, its appended data moved into the elements that they belong to.

    VTK 9.2 cannot read appended data with an expat library that has reparse deferral (2.6, and
    distributions' security updates of older ones); data inside the elements it can.
    Returns False where there are no appended data.
    """
    with open(source, "rb") as stream:
        data = stream.read()
    tag = re.search(rb'<AppendedData\s+encoding="(raw|base64)"\s*>\s*_', data)
    if tag is None:
        return False
    head, start, raw = data[:tag.start()], tag.end(), tag.group(1) == b"raw"
    word = ">" if b'byte_order="BigEndian"' in head else "<"
    word += "Q" if b'header_type="UInt64"' in head else "I"
    width = struct.calcsize(word)
    offsets = sorted({int(offset) for offset in re.findall(rb'offset="(\d+)"', head)})

    def number(position):
        return struct.unpack_from(word, data, position)[0]

    def block(offset):
        begin = start + offset
        if not raw:
            later = [other for other in offsets if other > offset]
            return data[begin:start + later[0] if later else data.index(b"<", begin)].strip()
        if b"compressor=" not in head:
            return base64.b64encode(data[begin:begin + width + number(begin)])
        blocks = number(begin)
        body = begin + width * (3 + blocks)
        end = body + sum(number(begin + width * (3 + i)) for i in range(blocks))
        return base64.b64encode(data[begin:body]) + base64.b64encode(data[body:end])

    def element(match):
        opening = match.group(1).replace(b'"appended"', b'"binary"')
        return b"%s>\n%s\n</%s>" % (opening, block(int(match.group(3))), match.group(2))

    head = re.sub(rb'(<(\w+)\b[^<>]*?)\s+offset="(\d+)"\s*/>', element, head)
    with open(target, "wb") as stream:
        stream.write(head + b"</VTKFile>\n")
    return True


def inline_all(source, folder):
    """Copies a VTK XML file and those that it names, such as the parts of a .pvtu, into a folder, without appended
    data. Returns the copy, or None where nothing has such data."""
    with open(source, "rb") as stream:
        text = stream.read()
    target = os.path.join(folder, os.path.basename(source))
    if b"<AppendedData" in text:
        return target if inline_appended_data(source, target) else None
    changed = False
    for number, name in enumerate(dict.fromkeys(re.findall(rb'\b(?:file|Source)="([^"]+)"', text))):
        part = os.path.join(os.path.dirname(source), os.fsdecode(name))
        if not os.path.isfile(part):
            continue
        own = os.path.join(folder, f"{os.path.basename(target)}_{number}")
        os.makedirs(own)
        copy = inline_all(part, own)
        changed = changed or copy is not None
        text = text.replace(b'"%s"' % name, b'"%s"' % os.fsencode(copy or os.path.abspath(part)))
    if not changed:
        return None
    with open(target, "wb") as stream:
        stream.write(text)
    return target


def file_of_folder(path):
    """What to open of a folder: of OpenFOAM's cases a file, of AMReX's plotfiles the folder itself."""
    control = os.path.join(path, "system", "controlDict")
    if os.path.isfile(control):
        return control
    with_foam = sorted(name for name in os.listdir(path) if name.lower().endswith(".foam"))
    return os.path.join(path, with_foam[0]) if with_foam else path


def is_amrex(path):
    header = os.path.join(path, "Header")
    if not os.path.isfile(header):
        return False
    with open(header, encoding="ascii", errors="replace") as stream:
        lines = stream.read().splitlines()
    if not lines or not lines[0].startswith("HyperCLaw-"):
        return False
    # ParaView's reader ends ParaView where there is less than it expects.
    count = int(lines[1]) if len(lines) > 1 and lines[1].strip().isdigit() else 0
    if count == 0 or len(lines) < count + 10 or not os.path.isdir(os.path.join(path, "Level_0")):
        raise DemoError(f"The AMReX plotfile '{path}' is not complete: copy all of its folder.")
    return True


def is_decomposed(path):
    """Whether an OpenFOAM case has its fields in the folders of processes alone."""
    folder = os.path.dirname(path)
    folder = os.path.dirname(folder) if os.path.basename(folder) == "system" else folder
    names = os.listdir(folder or ".")
    has_mesh = os.path.isdir(os.path.join(folder, "constant", "polyMesh"))
    has_fields = any(re.fullmatch(r"\d*\.?\d+(e[+-]?\d+)?", name) and float(name) > 0 for name in names)
    return any(re.fullmatch(r"processors?\d+.*", name) for name in names) and not (has_mesh and has_fields)


def open_file(path, q):
    """A reader proxy, all of its arrays switched on; None where ParaView has none."""
    if q:
        reader = pv.PLOT3DReader(FileName=path, QFileName=q, FunctionFileName="")
        reader.Functions = [100]  # density
        return reader
    is_foam = path.lower().endswith(".foam") or os.path.basename(path) == "controlDict"
    try:
        if is_foam:
            reader = pv.OpenFOAMReader(FileName=path)
            if is_decomposed(path):
                reader.CaseType = "Decomposed Case"
        elif is_amrex(path):
            reader = pv.AMReXBoxLibGridReader(FileNames=[path])
        else:
            reader = pv.OpenDataFile(path)
    except RuntimeError:
        reader = None
    if reader is None:
        return None
    for name in reader.ListProperties():
        selection = reader.GetProperty(name)
        if hasattr(selection, "SelectAll"):
            selection.SelectAll()
    return reader


def update(reader, moment):
    times = list(getattr(reader, "TimestepValues", None) or [])
    if moment is None and times:
        moment = times[-1]
    if moment is None:
        reader.UpdatePipeline()
    else:
        reader.UpdatePipeline(moment)
        pv.GetAnimationScene().AnimationTime = moment
    return moment if len(times) > 1 else None


def read(options, scratch, messages):
    path = os.path.abspath(options.file)
    if os.path.isdir(path):
        path = file_of_folder(path)
    q = options.q or plot3d_solution(path)
    if q:
        say(f"Reading {path} (PLOT3D, solution in {os.path.basename(q)})")
    else:
        say(f"Reading {path}")
    reader = open_file(path, q)
    if reader is None:
        hint = ""
        if "xyz" in path.lower():
            hint = " If it is a PLOT3D grid, give its solution file with --q."
        raise DemoError(f"ParaView has no reader for '{options.file}'.{hint}")
    moment = update(reader, options.time)
    if empty(reader):
        copy = inline_all(path, scratch) if is_vtk_xml(path) else None
        if copy:
            say("This system's XML library cannot read appended data: reading a re-encoded copy")
            messages.last_error()
            pv.Delete(reader)
            reader = open_file(copy, None)
            moment = update(reader, options.time)
    if empty(reader):
        raise DemoError(f"ParaView finds no data in '{options.file}'. {messages.last_error()}")
    if moment is not None:
        say(f"Time {moment:g}")
    return reader


def is_vtk_xml(path):
    if not os.path.isfile(path):
        return False
    with open(path, "rb") as stream:
        return b"<VTKFile" in stream.read(1000)


def empty(source):
    return source.GetDataInformation().GetNumberOfPoints() == 0


def arrays_of(source):
    """(association, name) of each array with one component, points before cells."""
    information = source.GetDataInformation()
    found = []
    for association, attributes in (("POINTS", information.GetPointDataInformation()),
                                    ("CELLS", information.GetCellDataInformation())):
        for index in range(attributes.GetNumberOfArrays()):
            array = attributes.GetArrayInformation(index)
            if array.GetNumberOfComponents() == 1 and not array.GetName().startswith("vtk"):
                found.append((association, array.GetName()))
    return found


def listing(source):
    return ", ".join(dict.fromkeys(name for _, name in arrays_of(source))) or "none with one component"


def choose_array(source, options):
    """The array that the user has named; None: the filter chooses."""
    if not options.array:
        return None
    for association, name in arrays_of(source):
        if name == options.array:
            return association, name
    raise DemoError(f"There is no array '{options.array}' in '{options.file}'. "
                    f"Its arrays: {listing(source)}.")


def evaluate(source, options, messages):
    """The source with a further array that follows from the user's formula, and that array. Its name says what it is:
    the filter warns of a density that is named like another quantity."""
    arrays = arrays_of(source)
    result = MODELS[options.model]
    for association, kind in (("POINTS", "Point Data"), ("CELLS", "Cell Data")):
        if not any(place == association for place, _ in arrays):
            continue
        calculator = pv.Calculator(Input=source, AttributeType=kind, Function=options.formula,
                                   ResultArrayName=result)
        calculator.UpdatePipeline()
        if (association, result) in arrays_of(calculator):
            return calculator, (association, result)
        pv.Delete(calculator)
    raise DemoError(f"The formula '{options.formula}' gives no values. {messages.last_error()} "
                    f"The arrays of '{options.file}': {listing(source)}.")
