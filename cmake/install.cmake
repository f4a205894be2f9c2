# Install headers, libraries, the command and its scenes, and a package file for find_package(plumbline).
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY PLUMBLINE_MODULES)
install(TARGETS plumbline plumbline_dealii ${modules} EXPORT plumblineTargets
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY lib/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/plumbline FILES_MATCHING PATTERN "*.h")
install(DIRECTORY reference meshfree check driver DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/plumbline
        FILES_MATCHING PATTERN "*.h")
install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/plumbline/scenes)
# the page for man and completions are printed by the command that is installed
foreach(text "man:plumbline.1:${CMAKE_INSTALL_MANDIR}/man1" "completion bash:plumbline:${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
             "completion zsh:_plumbline:${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
  string(REPLACE ":" ";" text ${text})
  list(GET text 0 arguments)
  list(GET text 1 name)
  list(GET text 2 folder)
  string(MAKE_C_IDENTIFIER "${arguments}" file)
  string(REPLACE " " "\" \"" arguments "${arguments}")
  install(CODE "execute_process(COMMAND \"$<TARGET_FILE:plumbline>\" \"${arguments}\" OUTPUT_FILE \"${PROJECT_BINARY_DIR}/${file}\" COMMAND_ERROR_IS_FATAL ANY)")
  install(FILES ${PROJECT_BINARY_DIR}/${file} DESTINATION ${folder} RENAME ${name})
endforeach()
install(EXPORT plumblineTargets NAMESPACE plumbline:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/plumbline)
configure_package_config_file(cmake/plumblineConfig.cmake.in plumblineConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/plumbline)
write_basic_package_version_file(plumblineConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/plumblineConfig.cmake
              ${PROJECT_BINARY_DIR}/plumblineConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/plumbline)

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/plumbline RENAME copyright)

# 'cpack -G DEB' in the build folder makes a package for Debian 12
set(CPACK_PACKAGE_NAME plumbline)
set(CPACK_PACKAGE_CONTACT "The Plumbline developers <plumbline@invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "gmsh, gnuplot-nox | gnuplot, python3-numpy")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
include(CPack)
