# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs the tracer of the build BUILD in FOLDER/prefix, then configures, builds and tests this folder's program with it.
set(source "${CMAKE_CURRENT_LIST_DIR}")
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
file(REMOVE_RECURSE "${FOLDER}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --component core --prefix "${FOLDER}/prefix")
run("${CMAKE_COMMAND}" -G "${GENERATOR}" -S "${source}" -B "${FOLDER}/build" "-DCMAKE_PREFIX_PATH=${FOLDER}/prefix"
  "-DCMAKE_CXX_COMPILER=${COMPILER}" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=-Werror)
run("${CMAKE_COMMAND}" --build "${FOLDER}/build")
run("${CMAKE_CTEST_COMMAND}" --test-dir "${FOLDER}/build" --no-tests=error --output-on-failure)
