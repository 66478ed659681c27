# Installs the library of the build folder BUILD below FOLDER. Builds PROGRAM with the library by find_package, by pkg-config and by
# add_subdirectory, SMALL_PROGRAM without it by header_only and by -I alone, and C_PROGRAM, if it is given, by find_package and by
# pkg-config; compares what each prints with the .expected file beside it. That all headers with their sources make a program: .ci/run.
#     cmake -DBUILD= -DFOLDER= -DPROGRAM= -DSMALL_PROGRAM= -DC_PROGRAM= -DHALFLIGHT= -DCOMPILER= -DLAUNCHER= -DGENERATOR= -P run.cmake
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()

# What a program built from `source` prints.
function(check name program source)
  message(STATUS ${name})
  string(REGEX REPLACE "[.][a-z]+$" ".expected" expected ${source})
  run(${CMAKE_COMMAND} -DPROGRAM=${program} -DEXPECTED=${expected} -P ${HALFLIGHT}/examples/compare.cmake)
endfunction()

function(configure name)
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${CMAKE_CURRENT_LIST_DIR} -B ${FOLDER}/${name} -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DPROGRAM=${PROGRAM}
    -DSMALL_PROGRAM=${SMALL_PROGRAM} ${ARGN})
endfunction()

function(build name target source)
  run(${CMAKE_COMMAND} --build ${FOLDER}/${name} --target ${target})
  check("${name}: ${target}" ${FOLDER}/${name}/${target} ${source})
endfunction()

# The flags of a package, from the installed description.
function(flags_of package to)
  file(GLOB_RECURSE description ${FOLDER}/prefix/*/${package}.pc)
  get_filename_component(path ${description} DIRECTORY)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${path} ${pkg_config} --cflags --libs ${package}
    OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags)
  set(${to} ${flags} PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix --component library)
find_program(pkg_config pkg-config)

configure(find_package -DCMAKE_PREFIX_PATH=${FOLDER}/prefix)
build(find_package two_plates ${PROGRAM})
message(STATUS "unit tests against the installed package")
run(${CMAKE_COMMAND} --build ${FOLDER}/find_package --target own_mesh_test)
run(${FOLDER}/find_package/own_mesh_test)
if(pkg_config)
  flags_of(halflight flags)
  run(${COMPILER} -std=c++20 ${PROGRAM} ${flags} -o ${FOLDER}/by_pkg_config)
  check(pkg-config ${FOLDER}/by_pkg_config ${PROGRAM})
endif()

if(C_PROGRAM)
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${CMAKE_CURRENT_LIST_DIR}/c -B ${FOLDER}/c -DCMAKE_PREFIX_PATH=${FOLDER}/prefix -DPROGRAM=${C_PROGRAM})
  run(${CMAKE_COMMAND} --build ${FOLDER}/c)
  check("find_package from C" ${FOLDER}/c/bake_from_c ${C_PROGRAM})
  find_program(c_compiler NAMES cc gcc clang)
  if(pkg_config AND c_compiler)
    flags_of(halflight_c flags)
    run(${c_compiler} -std=c99 -Wall -Wextra -Wpedantic -Werror ${C_PROGRAM} ${flags} -o ${FOLDER}/c_by_pkg_config)
    file(GLOB_RECURSE library ${FOLDER}/prefix/*/libhalflight_c.so)
    get_filename_component(path ${library} DIRECTORY)
    set(ENV{LD_LIBRARY_PATH} ${path})
    check("pkg-config from C" ${FOLDER}/c_by_pkg_config ${C_PROGRAM})
    unset(ENV{LD_LIBRARY_PATH})
  endif()
endif()

set(by_folder ${COMPILER} -std=c++20 -DHALFLIGHT_HEADER_ONLY -I${FOLDER}/prefix/include/halflight)
file(GLOB_RECURSE files RELATIVE ${HALFLIGHT} ${HALFLIGHT}/brep/* ${HALFLIGHT}/raycast/* ${HALFLIGHT}/radiosity/*)
foreach(file ${files})
  if(NOT EXISTS ${FOLDER}/prefix/include/halflight/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
run(${by_folder} -pthread ${SMALL_PROGRAM} -o ${FOLDER}/by_folder)
check("-I alone" ${FOLDER}/by_folder ${SMALL_PROGRAM})

configure(add_subdirectory -DHALFLIGHT_FOLDER=${HALFLIGHT})
build(add_subdirectory one_ray ${SMALL_PROGRAM})
build(add_subdirectory two_plates ${PROGRAM})
