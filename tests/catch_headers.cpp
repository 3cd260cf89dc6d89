// Headers shared by all test programs, compiled in advance (cmake/quick_build.cmake).
