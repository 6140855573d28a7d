# SPDX-License-Identifier: BSD-2-Clause
# Installs the build into a fresh prefix, builds the outside project against it, runs it,
# and reduces the installed example with the installed command. The source and build trees
# are not named to any of them.
# Needs -D BUILD, SOURCE, WORK, COMPILER, FLAGS.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result
    OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGN}\n${output}")
  endif()
  message("${output}")
endfunction()

file(REMOVE_RECURSE "${WORK}")
set(prefix "${WORK}/prefix")
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${prefix}")
run(${CMAKE_COMMAND} -G Ninja -S "${SOURCE}/consumer" -B "${WORK}/consumer"
  "-DCMAKE_PREFIX_PATH=${prefix}" "-DCMAKE_C_COMPILER=${COMPILER}"
  "-DCMAKE_C_FLAGS=${FLAGS}" -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build "${WORK}/consumer")
set(example "${prefix}/share/gearmap/examples/dct7.yaml")
run("${WORK}/consumer/use_core")
run("${WORK}/consumer/use_library" "${example}")
run("${prefix}/bin/gearmap" reduce "${example}" -o "${WORK}/dct7.fmu" --points 50
  --speed-step 800rpm --torque-step 100Nm)
if(NOT EXISTS "${WORK}/dct7.fmu")
  message(FATAL_ERROR "the installed command made no FMU")
endif()
# Nothing may point back into the trees that the installation came from.
get_filename_component(top "${BUILD}" REALPATH)
file(GLOB_RECURSE package "${prefix}/*.cmake")
foreach(file ${package})
  file(READ "${file}" text)
  string(FIND "${text}" "${top}" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${file} names the build tree ${top}")
  endif()
endforeach()
file(REMOVE_RECURSE "${WORK}")
