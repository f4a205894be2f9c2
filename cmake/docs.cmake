# `cmake --build --preset release --target docs`: the documentation site, in build/release/docs/html/index.html
find_package(Python3 REQUIRED)
find_program(SPHINX sphinx-build)
if(SPHINX)
  add_custom_target(docs
    COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/docs/build.py $<TARGET_FILE:plumbline> ${PROJECT_BINARY_DIR}/docs
    DEPENDS plumbline
    COMMENT "Documentation in build/*/docs/html/index.html"
    USES_TERMINAL)
  if(TARGET plumbline_python) # whose functions are listed
    add_dependencies(docs plumbline_python)
  endif()
else()
  add_custom_target(docs
    COMMAND ${CMAKE_COMMAND} -E echo
            "docs needs Sphinx: apt-get install python3-sphinx python3-myst-parser furo libjs-mathjax"
    COMMAND ${CMAKE_COMMAND} -E false)
endif()
