# Installs the library of the build folder BUILD below FOLDER, builds PROGRAM by find_package, by pkg-config and by add_subdirectory, and
# compares what each prints with EXPECTED. That two files of a program may include the sources: .ci/run.
#     cmake -DBUILD= -DFOLDER= -DPROGRAM= -DEXPECTED= -DHALFLIGHT= -DCOMPILER= -DGENERATOR= -P run.cmake
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()

function(check name program)
  message(STATUS ${name})
  run(${CMAKE_COMMAND} -DPROGRAM=${program} -DEXPECTED=${EXPECTED} -P ${HALFLIGHT}/examples/compare.cmake)
endfunction()

function(build name)
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${CMAKE_CURRENT_LIST_DIR} -B ${FOLDER}/${name} -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=
    -DCMAKE_CXX_COMPILER=${COMPILER} -DPROGRAM=${PROGRAM} ${ARGN})
  run(${CMAKE_COMMAND} --build ${FOLDER}/${name} --target two_plates)
  check(${name} ${FOLDER}/${name}/two_plates)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix --component library)
build(find_package -DCMAKE_PREFIX_PATH=${FOLDER}/prefix)
message(STATUS "unit tests against the installed package")
run(${CMAKE_COMMAND} --build ${FOLDER}/find_package --target own_mesh_test)
run(${FOLDER}/find_package/own_mesh_test)
run(${COMPILER} -std=c++20 -fsyntax-only -DHALFLIGHT_HEADER_ONLY -I${FOLDER}/prefix/include/halflight ${PROGRAM})  # all sources are there
build(add_subdirectory -DHALFLIGHT_FOLDER=${HALFLIGHT})

find_program(pkg_config pkg-config)
file(GLOB_RECURSE description ${FOLDER}/prefix/*/halflight.pc)
if(pkg_config)
  get_filename_component(path ${description} DIRECTORY)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${path} ${pkg_config} --cflags --libs halflight
    OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags)
  run(${COMPILER} -std=c++20 ${PROGRAM} ${flags} -o ${FOLDER}/by_pkg_config)
  check(pkg-config ${FOLDER}/by_pkg_config)
endif()
