# Places of an installed program and its files. They are independent of the prefix, which may move.
install(TARGETS gearpod RUNTIME)
set(share ${CMAKE_INSTALL_DATADIR}/gearpod)
install(DIRECTORY studies/ DESTINATION ${share}/studies
  FILES_MATCHING PATTERN "*.toml" PATTERN "own_features.py" PATTERN "*.ipynb" PATTERN "figures.json"
  PATTERN "study.schema.json" PATTERN "*.csv")
install(PROGRAMS studies/slurm.sh studies/slurm-array.sh DESTINATION ${share}/studies)
install(DIRECTORY analysis/report/ DESTINATION ${share}/report
  FILES_MATCHING PATTERN "*.py" PATTERN "*.css" PATTERN "__pycache__" EXCLUDE)
# Debian's Python looks there below /usr; elsewhere PYTHONPATH names it.
install(DIRECTORY analysis/python/gearpod DESTINATION lib/python3/dist-packages
  FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
install(FILES ${CMAKE_BINARY_DIR}/gearpod.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${CMAKE_BINARY_DIR}/gearpod.bash RENAME gearpod
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

# Documents: READMEs whose links hold where they are installed, the pages as Markdown, and the site if
# it was built (target docs).
file(RELATIVE_PATH studies_from_documents /${CMAKE_INSTALL_DOCDIR} /${share}/studies)
file(RELATIVE_PATH documents_from_studies /${share}/studies /${CMAKE_INSTALL_DOCDIR})
function(gearpod_relink file target old new)
  file(READ ${CMAKE_SOURCE_DIR}/${file} text)
  string(REPLACE "](${old}" "](${new}" text "${text}")
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/installed/${target} CONTENT "${text}" @ONLY)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${file})
endfunction()
gearpod_relink(README.md README.md studies/ ${studies_from_documents}/)
gearpod_relink(studies/README.md studies-README.md ../docs/ ${documents_from_studies}/docs/)
install(FILES ${CMAKE_BINARY_DIR}/installed/studies-README.md RENAME README.md
  DESTINATION ${share}/studies)
install(FILES ${CMAKE_BINARY_DIR}/installed/README.md LICENSE CITATION.cff CHANGELOG.md CONTRIBUTING.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs
  FILES_MATCHING PATTERN "*.md" PATTERN "*.dot" PATTERN "*.svg" PATTERN "*.png" PATTERN "tools" EXCLUDE)
install(DIRECTORY ${CMAKE_BINARY_DIR}/docs/html DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL
  PATTERN ".buildinfo" EXCLUDE PATTERN "objects.inv" EXCLUDE)

# cpack -G DEB. A package for any x86-64 processor comes from the preset `portable`; another one's
# name says that it is not.
set(CPACK_PACKAGE_NAME gearpod)
set(CPACK_PACKAGE_VENDOR "the gearpod developers")
set(CPACK_PACKAGE_CONTACT "the gearpod developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Monte Carlo study of which gear faults a sensor would find")
set(CPACK_PACKAGE_DESCRIPTION "Simulates thousands of gearboxes that differ the way real ones do, computes features of
what sensors would measure on each, and reports detection rates per fault size.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3, python3-numpy, python3-matplotlib, python3-h5py, python3-lxml, python3-scipy, python3-soundfile")
if(GEARPOD_WITH_MPI)
  string(APPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS ", openmpi-bin")
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
if(NOT GEARPOD_PORTABLE)
  set(CPACK_DEBIAN_PACKAGE_RELEASE native)
endif()
include(CPack)
