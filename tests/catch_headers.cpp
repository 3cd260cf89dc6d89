// Compiles the headers that all test programs share (cmake/precompiled.cmake).
