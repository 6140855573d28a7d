# SPDX-License-Identifier: BSD-2-Clause
# GM_PYTHON: the Python whose packages are used at build time: fmpy (it carries the headers
# of the FMI standard) and pytest. Default: the environment that the scripts make in the
# build folder, else python3. GM_HAVE_PYTEST: the tests in Python can run.
set(GM_PYTHON "" CACHE FILEPATH "Python with fmpy and pytest")
if(NOT GM_PYTHON)
  find_program(GM_PYTHON_FOUND NAMES python python3
    HINTS "${PROJECT_BINARY_DIR}/venv/bin" "${PROJECT_SOURCE_DIR}/build/venv/bin")
  set_property(CACHE GM_PYTHON PROPERTY VALUE "${GM_PYTHON_FOUND}")
  mark_as_advanced(GM_PYTHON_FOUND)
endif()
set(GM_HAVE_PYTEST FALSE)
if(GM_PYTHON)
  execute_process(COMMAND "${GM_PYTHON}" -c "import pytest, fmpy"
    RESULT_VARIABLE gm_python_result OUTPUT_QUIET ERROR_QUIET)
  if(gm_python_result EQUAL 0)
    set(GM_HAVE_PYTEST TRUE)
  endif()
endif()
