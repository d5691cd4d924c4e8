# Debian packages (.ci/package): `pastefit`, the program with its data, `libpastefit-dev`, what other programs need, and,
# where it is built, `python3-pastefit`.

# What Debian asks of the documentation of a package: licence and changelog, compressed without a date.
set(documents ${CMAKE_CURRENT_BINARY_DIR}/documents)
file(WRITE ${documents}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: pastefit

Files: *
Copyright: 2026 the pastefit authors
License: Apache-2.0
 On Debian systems, the full text of the Apache License, Version 2.0, is in
 /usr/share/common-licenses/Apache-2.0.
")
file(WRITE ${documents}/changelog "pastefit (${PROJECT_VERSION}) unstable; urgency=medium

  * What is new stands in the history of the sources.

 -- The pastefit authors <authors@pastefit.org>  Sun, 22 Nov 2026 12:00:00 +0000
")
find_program(gzip gzip)
if(gzip)
  execute_process(COMMAND ${gzip} -9nkf changelog WORKING_DIRECTORY ${documents})
  foreach(package IN ITEMS pastefit:program libpastefit-dev:library python3-pastefit:python)
    string(REPLACE ":" ";" package ${package})
    list(GET package 0 name)
    list(GET package 1 part)
    if(part STREQUAL python AND NOT PASTEFIT_PYTHON)
      continue()
    endif()
    install(FILES ${documents}/copyright ${documents}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
            COMPONENT ${part})
  endforeach()
  install(CODE "file(GLOB pages \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1/pastefit*.1)
                execute_process(COMMAND ${gzip} -9nf \${pages})" COMPONENT program)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The pastefit authors <authors@pastefit.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program library)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME pastefit)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "calibrates DEM contact models for pasty material
 Finds the contact parameters with which spheres slump as a paste, concrete or
 wet granular material does in the laboratory, and writes them as a material
 card for LAMMPS, LIGGGHTS, Yade, MercuryDPM and others.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libpastefit-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "calibration of DEM contact models, as a library
 The mechanics and the calibration of pastefit as static libraries with their
 headers and CMake package files.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
    "libeigen3-dev, libnlopt-cxx-dev, libceres-dev, libsqlite3-dev, nlohmann-json3-dev, libboost-dev, zlib1g-dev")
if(PASTEFIT_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-pastefit)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "calibration of DEM contact models, from Python
 The simulation, calibration and search of pastefit as a Python package: a
 study in, a material card out, with any simulator behind the search.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "pastefit (= ${PROJECT_VERSION}), python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-tqdm, python3-pandas, python3-matplotlib")
endif()
include(CPack)
