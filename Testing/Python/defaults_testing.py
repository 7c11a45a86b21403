# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Whether proxies and classes have the defaults of the XML."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Utilities"))
import property_tables  # noqa: E402


def check_defaults(proxy, made, files):
    """The properties in `files` whose defaults a proxy and an object of its class have. Lists begin empty; Quality is a name for
    values of other properties, of which TargetError is another one in C++."""
    checked = []
    for item in property_tables.read(files).values():
        if item.group in ("Inputs", "Commands", "Information") or item.default is None or item.is_array:
            continue
        value = getattr(proxy, item.name)
        assert (list(value) if isinstance(item.default, list) else value) == item.default, (item.name, value)
        if item.default == [] or item.name in ("Quality", "TargetError"):
            continue
        inside = getattr(made, item.command.replace("Set", "Get", 1))()
        inside = list(inside) if isinstance(inside, tuple) else inside
        expected = item.entries[item.default] if item.entries else item.default
        assert inside == expected, f"{item.name} is {inside} in C++, {expected} in the XML"
        checked.append(item)
    return checked
