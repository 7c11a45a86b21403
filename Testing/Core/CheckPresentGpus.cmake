# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# What a build compiles for, with programs in place of nvidia-smi and nvcc that answer for machines of all kinds.
#   cmake -DMODULE=PresentGpus.cmake -DFOLDER=folder -P CheckPresentGpus.cmake
include(${MODULE})
set(ENV{PATH} ${FOLDER}:$ENV{PATH})

function(write_program name code)
  file(WRITE ${FOLDER}/${name} "#!/bin/sh\n${code}\n")
  file(CHMOD ${FOLDER}/${name} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endfunction()

function(expect nvidiaSmi expected)
  write_program(nvidia-smi "${nvidiaSmi}")
  find_present_gpus(found ${FOLDER}/nvcc)
  if(NOT "${found}" STREQUAL "${expected}")
    message(SEND_ERROR "\"${found}\" instead of \"${expected}\" where nvidia-smi is: ${nvidiaSmi}")
  endif()
endfunction()

write_program(nvcc "printf 'compute_75\\ncompute_80\\ncompute_86\\ncompute_90\\ncompute_100\\n'")
expect("echo 9.0" "90-real")
expect("printf '9.0\\n9.0\\n8.6\\n'" "90-real;86-real")
expect("echo 10.0" "100-real")
expect("echo 12.0" "100-virtual") # newer than nvcc
expect("printf '6.1\\n8.0\\n'" "80-real") # older than nvcc
expect("echo 6.1" "")
expect("echo 'No devices were found'; exit 6" "")
expect("echo 'No devices were found'" "")
file(REMOVE ${FOLDER}/nvidia-smi)
set(ENV{PATH} ${FOLDER})
find_present_gpus(found ${FOLDER}/nvcc)
if(found)
  message(SEND_ERROR "\"${found}\" without nvidia-smi")
endif()
