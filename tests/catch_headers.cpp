// Compiles the headers that all test programs share (cmake/quick_build.cmake).
