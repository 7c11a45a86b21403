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


def open_file(path, q):
    """A reader proxy, all of its arrays switched on."""
    if q:
        reader = pv.PLOT3DReader(FileName=path, QFileName=q, FunctionFileName="")
        reader.Functions = [100]  # density
        return reader
    try:
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
        copy = os.path.join(scratch, os.path.basename(path))
        with open(path, "rb") as stream:
            xml = b"<VTKFile" in stream.read(1000)
        if xml and inline_appended_data(path, copy):
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


def choose_array(source, options):
    arrays = arrays_of(source)
    listing = ", ".join(dict.fromkeys(name for _, name in arrays)) or "none with one component"
    if options.array:
        for association, name in arrays:
            if name == options.array:
                return association, name
        raise DemoError(f"There is no array '{options.array}' in '{options.file}'. "
                        f"Its arrays: {listing}.")
    _, names = MODELS[options.model]
    for wanted in names:
        for association, name in arrays:
            if name.lower() == wanted:
                return association, name
    for association, name in arrays:
        if any(len(wanted) > 2 and wanted in name.lower() for wanted in names):
            return association, name
    raise DemoError(f"No array of '{options.file}' is named like a {names[1]}: choose one with "
                    f"--array, or compute it with --formula. Its arrays: {listing}.")


def evaluate(source, options, messages):
    """The source with a further array that follows from the user's formula, and that array."""
    arrays = arrays_of(source)
    for association, kind in (("POINTS", "Point Data"), ("CELLS", "Cell Data")):
        if not any(place == association for place, _ in arrays):
            continue
        calculator = pv.Calculator(Input=source, AttributeType=kind, Function=options.formula,
                                   ResultArrayName=options.formula)
        calculator.UpdatePipeline()
        if (association, options.formula) in arrays_of(calculator):
            return calculator, (association, options.formula)
        pv.Delete(calculator)
    listing = ", ".join(dict.fromkeys(name for _, name in arrays)) or "none with one component"
    raise DemoError(f"The formula '{options.formula}' gives no values. {messages.last_error()} "
                    f"The arrays of '{options.file}': {listing}.")
