# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Writes a file for CTest with one test for each suite of a GoogleTest program, run after that has been built:
#
#   cmake -DPROGRAM=<file> -DFILTER=<GoogleTest's filter> -DPREFIX=<text> -DPROPERTIES=<list> -DFILE=<to write>
#     -P AddSuites.cmake
#
# Tests of a suite share what takes longest: the libraries that are loaded and the images that several of them look at.
# Those that SCHLIEREN_WITHOUT names, in GoogleTest's words (Suite.Test:Suite.*), are left out.
execute_process(COMMAND "${PROGRAM}" "--gtest_filter=${FILTER}" --gtest_list_tests
  OUTPUT_VARIABLE _list COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n[A-Za-z0-9_/]+[.]" _suites "\n${_list}")
set(_text "")
foreach (_suite IN LISTS _suites)
  string(REGEX REPLACE "[\n.]" "" _suite "${_suite}")
  string(APPEND _text
    "add_test([[${PREFIX}${_suite}]] sh -c [[exec \"$0\" \"--gtest_filter=${_suite}.*-$SCHLIEREN_WITHOUT\"]] [[${PROGRAM}]])\n"
    "set_tests_properties([[${PREFIX}${_suite}]] PROPERTIES ${PROPERTIES} SKIP_REGULAR_EXPRESSION \"Running 0 tests\")\n")
endforeach ()
file(WRITE "${FILE}" "${_text}")
