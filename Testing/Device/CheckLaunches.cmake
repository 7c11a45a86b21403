# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Every kernel that is compiled is launched by the tests that compare host and device.
#   cmake -DNM=nm -DTESTS=SchlierenCoreTests -DFOLDER=CudaCore -DSOURCES=a.cu;b.cu -P CheckLaunches.cmake
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
set(kernel "[A-Za-z]+Kernel")
string(REGEX MATCHALL
  "[0-9a-f]+ [tTwW] void schlieren::\\(anonymous namespace\\)::${kernel}<[^\n]*"
  compiled "${symbols}")
foreach(source IN LISTS SOURCES)
  file(STRINGS ${FOLDER}/${source} declarations REGEX "__global__ void")
  foreach(declaration IN LISTS declarations)
    string(REGEX REPLACE ".*__global__ void ([A-Za-z]+)\\(.*" "\\1" name "${declaration}")
    if(NOT "${compiled}" MATCHES "::${name}<")
      message(SEND_ERROR "${name} of ${source} was not found among the symbols of ${TESTS}.")
    endif()
  endforeach()
endforeach()

list(LENGTH compiled count)
foreach(symbol IN LISTS compiled)
  string(REGEX MATCH "^[0-9a-f]+" address "${symbol}")
  if(NOT launched MATCHES "${address}")
    string(REGEX REPLACE ".*::(${kernel}<.*)" "\\1" name "${symbol}")
    message(SEND_ERROR "Never launched: ${name}")
  endif()
endforeach()
message(STATUS "${count} kernels were compiled.")
