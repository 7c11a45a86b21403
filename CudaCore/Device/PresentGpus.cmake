# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Sets RESULT to the CMAKE_CUDA_ARCHITECTURES of the GPUs of this machine, of those that nvcc can compile for: empty where
# there are none.
function(find_present_gpus result nvcc)
  set(${result} "" PARENT_SCOPE)
  execute_process(COMMAND nvidia-smi --query-gpu=compute_cap --format=csv,noheader
    OUTPUT_VARIABLE present RESULT_VARIABLE code ERROR_QUIET)
  string(REGEX MATCHALL "[0-9]+\\.[0-9]+" present "${present}")
  if(NOT code EQUAL 0 OR NOT present)
    return()
  endif()
  execute_process(COMMAND ${nvcc} --list-gpu-arch OUTPUT_VARIABLE known ERROR_QUIET)
  string(REGEX MATCHALL "[0-9]+" known "${known}")
  list(SORT known COMPARE NATURAL)
  list(REMOVE_DUPLICATES present)
  set(architectures)
  foreach(gpu IN LISTS present)
    string(REPLACE "." "" gpu ${gpu})
    set(older ${known})
    # A GPU that is newer than nvcc runs what is compiled for it from the PTX of the newest one that nvcc knows.
    list(FILTER older EXCLUDE REGEX "^${gpu}$")
    list(LENGTH known all)
    list(LENGTH older left)
    if(left LESS all)
      list(APPEND architectures ${gpu}-real)
    elseif(known)
      list(GET known -1 newest)
      if(gpu GREATER newest)
        list(APPEND architectures ${newest}-virtual)
      endif()
    endif()
  endforeach()
  list(REMOVE_DUPLICATES architectures)
  set(${result} "${architectures}" PARENT_SCOPE)
endfunction()
