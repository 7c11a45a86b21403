# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Files that are compiled for instructions which not every processor has must define nothing that others
# define, too: the linker could choose theirs for all. What works on packs is theirs alone.
#   cmake -DNM=nm -DOBJECTS=a.o;b.o -DCOUNT=2 -P CheckSimdSymbols.cmake
set(looked 0)
foreach(object IN LISTS OBJECTS)
  if(object MATCHES "SimdMarchAvx")
    execute_process(COMMAND ${NM} -C --defined-only ${object}
      OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE ";" "," symbols "${symbols}")
    string(REPLACE "\n" ";" symbols "${symbols}")
    math(EXPR looked "${looked} + 1")
    foreach(symbol IN LISTS symbols)
      if(symbol MATCHES " [WVu] " AND NOT symbol MATCHES "__vector" AND NOT symbol MATCHES "Dv[0-9]+_" AND NOT symbol MATCHES "simd(March|Advance)"
        AND NOT symbol MATCHES "DW.ref.__gxx_personality")
        message(SEND_ERROR "${object} defines what others may use: ${symbol}")
      endif()
    endforeach()
  endif()
endforeach()
if(NOT looked EQUAL COUNT)
  message(FATAL_ERROR "Expected ${COUNT} files for AVX, found ${looked}.")
endif()
