# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Where this is imported, sessions begin and plugins load in a tenth of the time: paraview.simple describes all of its
functions each time anew, and searches all proxies for the description of each; here they get none."""

from paraview import servermanager

servermanager.ProxyNamespace.getDocumentation = lambda _namespace, _name: ""
