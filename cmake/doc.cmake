# `cmake --build --preset release --target doc`: pages of all public comments, folder by folder, in
# build/release/doc/index.html. A warning is an error.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  add_custom_target(doc
    COMMAND ${CMAKE_COMMAND} -E echo "doc needs doxygen: apt-get install doxygen"
    COMMAND ${CMAKE_COMMAND} -E false)
  return()
endif()

set(DOXYGEN_PROJECT_NAME Plumbline)
set(DOXYGEN_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/doc")
set(DOXYGEN_HTML_OUTPUT .)
set(DOXYGEN_GENERATE_LATEX NO)
set(DOXYGEN_FILE_PATTERNS *.h)
set(DOXYGEN_STRIP_FROM_PATH "${PROJECT_SOURCE_DIR}")
set(DOXYGEN_STRIP_FROM_INC_PATH "${PROJECT_SOURCE_DIR}/lib" "${PROJECT_SOURCE_DIR}")
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_EXTRACT_ALL YES) # names say what the rest is
set(DOXYGEN_WARN_IF_UNDOCUMENTED NO)
set(DOXYGEN_WARN_IF_INCOMPLETE_DOC NO) # parameters whose names say it all go without a word
set(DOXYGEN_WARN_NO_PARAMDOC NO)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
set(DOXYGEN_HIDE_UNDOC_RELATIONS YES)
set(DOXYGEN_BUILTIN_STL_SUPPORT YES)
set(DOXYGEN_MACRO_EXPANSION YES)
set(DOXYGEN_EXCLUDE_SYMBOLS "std" "std::*" "dealii" "dealii::*")
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE "${PROJECT_SOURCE_DIR}/CONTRIBUTING.md")
set(DOXYGEN_QUIET YES)
doxygen_add_docs(doc lib reference meshfree check driver app CONTRIBUTING.md cmake/folders.dox
                 WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
                 COMMENT "Pages of the library in build/*/doc")
