# The documentation site: the target `docs` builds it in <build>/docs/html. It needs the packages
# that docs/tools/build_docs.py names, and is not part of the default build.
set(gearpod_docs_command /usr/bin/python3 -Bs ${CMAKE_SOURCE_DIR}/docs/tools/build_docs.py
  $<TARGET_FILE:gearpod> ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/docs)
add_custom_target(docs COMMAND ${gearpod_docs_command} USES_TERMINAL VERBATIM)
add_dependencies(docs gearpod)
