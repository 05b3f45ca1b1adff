# What `cmake --install` and `cpack` lay down, in two components: the program with all that it carries, and the libraries.
include(CMakePackageConfigHelpers)

# The program. It finds its data in share/undex beside its own folder, and the library of meshes by its run-time path.
if(UNDEX_WITH_FEM)
  set_target_properties(undex PROPERTIES INSTALL_RPATH $ORIGIN/../lib/undex)
  install(TARGETS undex RUNTIME DESTINATION bin)
  install(TARGETS undex_meshes LIBRARY DESTINATION lib/undex)

  # The program writes its man page and what shells complete it with.
  set(texts ${PROJECT_BINARY_DIR}/installed_texts)
  install(CODE "file(MAKE_DIRECTORY \"${texts}\")
    execute_process(COMMAND \"$<TARGET_FILE:undex>\" manual OUTPUT_FILE \"${texts}/undex.1\" COMMAND_ERROR_IS_FATAL ANY)
    foreach(shell bash zsh fish)
      execute_process(COMMAND \"$<TARGET_FILE:undex>\" completion \${shell} OUTPUT_FILE \"${texts}/\${shell}\" COMMAND_ERROR_IS_FATAL ANY)
    endforeach()")
  install(FILES ${texts}/undex.1 DESTINATION share/man/man1)
  install(FILES ${texts}/bash DESTINATION share/bash-completion/completions RENAME undex)
  install(FILES ${texts}/fish DESTINATION share/fish/vendor_completions.d RENAME undex.fish)
  foreach(folder site-functions vendor-completions)  # zsh reads the first below /usr/local, Debian's the second below /usr
    install(FILES ${texts}/zsh DESTINATION share/zsh/${folder} RENAME _undex)
  endforeach()
endif()
install(DIRECTORY cases DESTINATION share/undex
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.md" PATTERN "*.csv" PATTERN "*.msh" PATTERN "*.stl" PATTERN "*.py"
  PATTERN out EXCLUDE PATTERN __pycache__ EXCLUDE)
install(DIRECTORY docs DESTINATION share/undex)
install(DIRECTORY materials/data DESTINATION share/undex/materials)  # the library of materials, with its sources, to read
set(pages README.md CHANGELOG.md CONTRIBUTING.md)  # the pages of docs/ lead to these
install(FILES ${pages} LICENSE CITATION.cff DESTINATION share/undex)
install(FILES README.md CHANGELOG.md LICENSE cmake/copyright DESTINATION share/doc/undex)

# The libraries: find_package(undex) gives undex::<module> for each.
set(modules core materials exact output sph_fluid sph_solid)
if(UNDEX_WITH_FEM)
  list(APPEND modules fem_structure coupling scene run judge study)
  # dlopen looks for the library of meshes along the run-time path of the program that the module is part of.
  target_link_options(undex_fem_structure INTERFACE $<INSTALL_INTERFACE:LINKER:-rpath,$<INSTALL_PREFIX>/lib/undex>)
endif()
foreach(module IN ITEMS triangle_surface LISTS modules)
  target_compile_features(undex_${module} INTERFACE cxx_std_20)
  set_target_properties(undex_${module} PROPERTIES EXPORT_NAME ${module})
  install(TARGETS undex_${module} EXPORT undexTargets ARCHIVE DESTINATION lib COMPONENT dev INCLUDES DESTINATION include/undex)
endforeach()
foreach(module IN LISTS modules)
  install(DIRECTORY ${module} DESTINATION include/undex COMPONENT dev FILES_MATCHING PATTERN "*.hpp" PATTERN data EXCLUDE)
endforeach()
install(EXPORT undexTargets NAMESPACE undex:: DESTINATION lib/cmake/undex COMPONENT dev)
configure_package_config_file(cmake/undexConfig.cmake.in undexConfig.cmake INSTALL_DESTINATION lib/cmake/undex)
write_basic_package_version_file(undexConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/undexConfig.cmake ${PROJECT_BINARY_DIR}/undexConfigVersion.cmake
  DESTINATION lib/cmake/undex COMPONENT dev)

# Packages of Debian: undex and libundex-dev.
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program dev)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_VENDOR "The undex authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Close-in underwater explosions against deforming structures")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The undex authors <undex@authors.invalid>" CACHE STRING "Maintainer of the Debian packages")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME undex)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Water and explosive gas are smoothed particles (SPH), structures are finite elements, and both are
coupled at every step. With documentation, example scenes and reports.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS  # of reports
  "python3, python3-numpy, python3-matplotlib, python3-h5py, libjs-dygraphs")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libundex-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEV_DESCRIPTION "Static libraries and headers of undex, found by find_package(undex) of CMake.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS  # what undexConfig.cmake looks for
  "undex (= ${PROJECT_VERSION}), libcgal-dev, libeigen3-dev, libhdf5-openmpi-dev, libudunits2-dev, libxxhash-dev, pkg-config")
include(CPack)
