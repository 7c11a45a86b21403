# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Every kernel that is compiled is launched by the tests that compare host and device.
#   cmake -DNM=nm -DTESTS=SchlierenCoreTests -DFOLDER=CudaCore -P CheckLaunches.cmake
# Blocks and threads run in a shuffled order.
set(launches ${TESTS}.launches)
file(REMOVE ${launches})
set(ENV{EMULATED_LAUNCHES} ${launches})
set(ENV{EMULATED_ORDER} 1)
execute_process(COMMAND ${TESTS} --gtest_filter=HostAndDevice*:EmulatedDevice.* --gtest_brief=1
  COMMAND_ERROR_IS_FATAL ANY)
file(READ ${launches} launched)

execute_process(COMMAND ${NM} -C --defined-only ${TESTS}
  OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
set(ofKernel "(void )?schlieren::(\\(anonymous namespace\\)::)?([A-Za-z]+Kernel)[<(]")
string(REGEX MATCHALL "[0-9a-f]+ [tTwW] ${ofKernel}[^\n]*" compiled "${symbols}")
file(GLOB_RECURSE sources ${FOLDER}/*.cu ${FOLDER}/*.inl)
foreach(source IN LISTS sources)
  file(READ ${source} code)
  string(REGEX MATCHALL "__global__[^{;]+" declarations "${code}")
  foreach(declaration IN LISTS declarations)
    string(REGEX REPLACE ".*[^A-Za-z]([A-Za-z]+Kernel)\\(.*" "\\1" name "${declaration}")
    if(NOT "${compiled}" MATCHES "::${name}[<(]")
      message(SEND_ERROR "${name} of ${source} was not found among the symbols of ${TESTS}.")
    endif()
  endforeach()
endforeach()

list(FILTER compiled EXCLUDE REGEX "::{lambda|::launchKernel<") # within kernels, and what launches them
list(LENGTH compiled count)
foreach(symbol IN LISTS compiled)
  string(REGEX MATCH "^[0-9a-f]+" address "${symbol}")
  if(NOT launched MATCHES "${address}")
    string(REGEX REPLACE "^[0-9a-f]+ . " "" name "${symbol}")
    message(SEND_ERROR "Never launched: ${name}")
  endif()
endforeach()
message(STATUS "${count} kernels were compiled.")
