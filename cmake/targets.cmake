# One library target per folder. The targets a folder links are the folders that it may include, and
# tests/house walks the includes to say so by name.

# deal.II with the flags that users of it need; its own macro would add -g to every file
include(${DEAL_II_TARGET_CONFIG})
add_library(plumbline_dealii INTERFACE)
set_target_properties(plumbline_dealii PROPERTIES EXPORT_NAME dealii)
target_include_directories(plumbline_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
target_include_directories(plumbline_dealii BEFORE INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/cmake/without>)
target_compile_definitions(plumbline_dealii INTERFACE ${DEAL_II_USER_DEFINITIONS}
  $<$<CONFIG:Debug>:${DEAL_II_USER_DEFINITIONS_DEBUG}>
  OMPI_SKIP_MPICXX) # MPI's C++ of old, which each file would compile anew
target_link_libraries(plumbline_dealii INTERFACE
  $<IF:$<CONFIG:Debug>,${DEAL_II_TARGET_DEBUG},${DEAL_II_TARGET_RELEASE}>)
target_link_options(plumbline_dealii INTERFACE -fuse-ld=gold)

# Half of a compiler's time goes into these headers. Sources include what they use all the same:
# cmake -D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without
if(NOT EXISTS ${PROJECT_BINARY_DIR}/precompiled.cc) # touched, it would be compiled again, and all else
  file(WRITE ${PROJECT_BINARY_DIR}/precompiled.cc "")
endif()
set(PLUMBLINE_PRECOMPILED
  <deal.II/base/point.h> <deal.II/base/quadrature_lib.h>
  <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <iomanip> <iostream> <limits> <map>
  <memory> <numeric> <optional> <set> <sstream> <string> <vector>)
function(plumbline_precompile target)
  add_library(${target} OBJECT ${PROJECT_BINARY_DIR}/precompiled.cc)
  target_link_libraries(${target} PRIVATE plumbline_dealii)
  target_precompile_headers(${target} PRIVATE ${ARGN} ${PLUMBLINE_PRECOMPILED})
  plumbline_compile_options(${target})
endfunction()

# plumbline_module(<name> [UNITY] SOURCES <files> [VECTORS <files>] [LINK <targets>] [PRIVATE <targets>])
# VECTORS: sources that see deal.II's vectors, elements or meshes. Those headers take a second to
# read, and a third of one from precompiled ones, which all other sources are spared.
# UNITY: see plumbline_unity
function(plumbline_module name)
  cmake_parse_arguments(ARG "UNITY" "" "SOURCES;VECTORS;LINK;PRIVATE" ${ARGN})
  set(target plumbline_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(plumbline::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/lib>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/plumbline>)
  target_link_libraries(${target} PUBLIC plumbline_dealii ${ARG_LINK} PRIVATE ${ARG_PRIVATE})
  plumbline_compile_options(${target})
  if(ARG_VECTORS)
    add_library(${target}_vectors OBJECT ${ARG_VECTORS})
    target_link_libraries(${target}_vectors PRIVATE plumbline_dealii ${ARG_LINK} ${ARG_PRIVATE})
    plumbline_compile_options(${target}_vectors plumbline_precompiled_vectors)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_vectors>)
    if(ARG_UNITY)
      plumbline_unity(${target}_vectors)
    endif()
  endif()
  if(ARG_UNITY)
    plumbline_unity(${target})
  endif()
  set_property(GLOBAL APPEND PROPERTY PLUMBLINE_MODULES ${target})
endfunction()

# plumbline_unity(<target>): compile four sources as one, which takes about a third of the time
function(plumbline_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${PLUMBLINE_UNITY} UNITY_BUILD_BATCH_SIZE 4)
endfunction()
# plumbline_alone(<files>): except these, whose unnamed namespaces define names that other sources define, too
function(plumbline_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# plumbline_has_no_loops(<target>): nothing in it takes a run's time, so it is compiled in less
function(plumbline_has_no_loops target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# plumbline_compile_options(<target> [<target whose precompiled headers it takes>])
function(plumbline_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic)
  if(PLUMBLINE_SANITIZE)
    # vptr: CGAL's arrangements cast down to iterators' own types, which is theirs to mend
    target_compile_options(${target} PUBLIC -fsanitize=address,undefined -fno-sanitize=vptr
                                            -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
  if(ARGC GREATER 1)
    target_precompile_headers(${target} REUSE_FROM ${ARGV1})
  elseif(NOT target MATCHES "_precompiled")
    target_precompile_headers(${target} REUSE_FROM plumbline_precompiled)
  endif()
endfunction()
plumbline_precompile(plumbline_precompiled)
plumbline_precompile(plumbline_precompiled_vectors <deal.II/base/parallel.h> <deal.II/lac/vector.h>)

# plumbline_templates(<folder> <namespace>): its templates as templates.cc in the binary folder
function(plumbline_templates folder namespace)
  file(GLOB files CONFIGURE_DEPENDS ${folder}/*.mustache ${folder}/*.css ${folder}/*.js)
  set(script ${PROJECT_SOURCE_DIR}/cmake/templates.cmake)
  add_custom_command(OUTPUT templates.cc DEPENDS ${files} ${script}
    COMMAND ${CMAKE_COMMAND} -D FOLDER=${CMAKE_CURRENT_SOURCE_DIR}/${folder} -D NAMESPACE=${namespace}
            -D DYGRAPHS=${DYGRAPHS} -D OUT=${CMAKE_CURRENT_BINARY_DIR}/templates.cc -P ${script})
endfunction()
