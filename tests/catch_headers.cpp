// Headers shared by all test programs, compiled in advance (CMakeLists.txt).
