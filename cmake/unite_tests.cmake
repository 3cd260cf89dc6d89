# Writes OUTPUT, which compiles the FILES of tests together: what they include is read first, then each
# stands in a namespace of its own, where what it names for itself is its own.
set(includes "")
set(bodies "")
set(number 0)
foreach(file ${FILES})
  file(STRINGS ${file} lines REGEX "^#include ")
  list(APPEND includes ${lines})
  string(APPEND bodies "namespace tests_${number} {\n#include \"${file}\"\n}\n")
  math(EXPR number "${number} + 1")
endforeach()
list(REMOVE_DUPLICATES includes)
list(JOIN includes "\n" includes)
file(WRITE ${OUTPUT} "${includes}\n${bodies}")
