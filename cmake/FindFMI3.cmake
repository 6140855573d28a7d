# SPDX-License-Identifier: BSD-2-Clause
# The FMI 3.0 headers (fmi3Functions.h and what it includes), for FMUs of others. Taken from GM_FMI3_INCLUDE_DIR, or from the Python package fmpy of the
# interpreter GM_PYTHON (python.cmake). Never downloaded. Makes the target FMI3::headers.
set(GM_FMI3_INCLUDE_DIR "" CACHE PATH "Folder with fmi3Functions.h")

set(FMI3_hint "${GM_FMI3_INCLUDE_DIR}")
if(NOT FMI3_hint)
  execute_process(
    COMMAND "${GM_PYTHON}" -c
            "import importlib.util as u; print(u.find_spec('fmpy').submodule_search_locations[0])"
    OUTPUT_VARIABLE FMI3_fmpy OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
    RESULT_VARIABLE FMI3_result)
  if(FMI3_result EQUAL 0)
    set(FMI3_hint "${FMI3_fmpy}/c-code")
  endif()
endif()

set(FMI3_HEADERS fmi3Functions.h fmi3FunctionTypes.h fmi3PlatformTypes.h)
set(FMI3_INCLUDE_DIR "${FMI3_hint}")
foreach(header IN LISTS FMI3_HEADERS)
  if(NOT FMI3_hint OR NOT EXISTS "${FMI3_hint}/${header}")
    set(FMI3_INCLUDE_DIR "FMI3_INCLUDE_DIR-NOTFOUND")
  endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FMI3
  REQUIRED_VARS FMI3_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "set GM_FMI3_INCLUDE_DIR to a folder with fmi3Functions.h, or \
GM_PYTHON to a Python interpreter that has fmpy installed")
if(FMI3_FOUND AND NOT TARGET FMI3::headers)
  add_library(FMI3::headers INTERFACE IMPORTED GLOBAL)
  set_target_properties(FMI3::headers PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${FMI3_INCLUDE_DIR}")
endif()

# Folder of binaries of this platform in an FMI 3.0 FMU.
set(FMI3_PLATFORM "${CMAKE_SYSTEM_PROCESSOR}-linux")
