# SPDX-License-Identifier: BSD-2-Clause
# The FMI 2.0 headers (fmi2Functions.h and what it includes), which every FMU ships in its
# sources. Taken from GM_FMI2_INCLUDE_DIR, or from the Python package fmpy of the
# interpreter GM_PYTHON (python.cmake). Never downloaded. Makes the target FMI2::headers.
set(GM_FMI2_INCLUDE_DIR "" CACHE PATH "Folder with fmi2Functions.h")

set(FMI2_hint "${GM_FMI2_INCLUDE_DIR}")
if(NOT FMI2_hint)
  execute_process(
    COMMAND "${GM_PYTHON}" -c
            "import importlib.util as u; print(u.find_spec('fmpy').submodule_search_locations[0])"
    OUTPUT_VARIABLE FMI2_fmpy OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
    RESULT_VARIABLE FMI2_result)
  if(FMI2_result EQUAL 0)
    set(FMI2_hint "${FMI2_fmpy}/c-code")
  endif()
endif()

set(FMI2_HEADERS fmi2Functions.h fmi2FunctionTypes.h fmi2TypesPlatform.h)
set(FMI2_INCLUDE_DIR "${FMI2_hint}")
foreach(header IN LISTS FMI2_HEADERS)
  if(NOT FMI2_hint OR NOT EXISTS "${FMI2_hint}/${header}")
    set(FMI2_INCLUDE_DIR "FMI2_INCLUDE_DIR-NOTFOUND")
  endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FMI2
  REQUIRED_VARS FMI2_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "set GM_FMI2_INCLUDE_DIR to a folder with fmi2Functions.h, or \
GM_PYTHON to a Python interpreter that has fmpy installed")
if(FMI2_FOUND AND NOT TARGET FMI2::headers)
  add_library(FMI2::headers INTERFACE IMPORTED GLOBAL)
  set_target_properties(FMI2::headers PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${FMI2_INCLUDE_DIR}")
endif()

# Folder of binaries of this platform in an FMI 2.0 FMU, and the ending of its libraries.
set(FMI2_PLATFORM linux64)
set(FMI2_LIBRARY_ENDING "${CMAKE_SHARED_LIBRARY_SUFFIX}")
